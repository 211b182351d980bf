//! The program, run as its users run it; and what of its library needs the kernel's answers.
#![forbid(unsafe_code)]

mod bad_input;
mod cargo;
mod cast;
mod crowd;
mod far;
mod files;
mod judge;
mod lecture;
mod light;
mod orders;
mod output;
mod pick;
mod pixels;
mod png;
mod rows;
mod run;
mod scales;
mod scenes;
mod shadows;
mod show;
mod structures;
mod table;
mod trace;
mod traced;
mod tradeoff;
mod whole_files;
