//! Spheres in a terminal.
#![forbid(unsafe_code)]

pub mod cells;
pub mod color;
pub mod draw;
pub mod encode;
pub mod palette;
pub mod picture;
pub mod samples;
pub mod scene;
pub mod shade;
pub mod terminal;
pub mod view;
pub mod viewer;
