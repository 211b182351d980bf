//! Spheres in a terminal: the program's parts, for its own tests and benches. Only the command line is promised, not
//! these.
#![forbid(unsafe_code)]

#[cfg(not(unix))]
compile_error!("spherule needs a Unix terminal; spherule-kernel builds anywhere");

pub mod arguments;
pub mod cases;
pub mod cast;
pub mod cells;
pub mod choice;
pub mod color;
pub mod coloring;
pub mod compare;
mod counted;
pub mod draw;
pub mod encode;
pub mod error;
mod harmless;
pub mod ink;
pub mod judge;
pub mod lecture;
mod length;
pub mod machine;
pub mod manual;
pub mod npy;
pub mod palette;
pub mod pick;
pub mod picture;
pub mod pixels;
pub mod png_file;
pub mod progress;
pub mod samples;
pub mod scene;
pub mod shade;
pub mod show;
pub mod structure;
pub mod style;
pub mod tally;
pub mod terminal;
#[cfg(test)]
mod test_file;
pub mod threads;
pub mod trace;
pub mod tradeoff;
pub mod view;
pub mod viewer;
pub mod whole_file;
