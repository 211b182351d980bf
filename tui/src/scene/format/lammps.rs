//! LAMMPS: dumps, which are trajectories, and data files, which are what a simulation begins with.

mod cell;
pub(super) mod data;
pub(super) mod dump;
mod style;
