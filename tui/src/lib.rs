//! Spheres in a terminal.

pub mod cells;
pub mod draw;
pub mod encode;
pub mod scene;
pub mod terminal;
pub mod view;
