//! Spheres in a terminal.

pub mod cells;
pub mod draw;
pub mod scene;
pub mod view;
