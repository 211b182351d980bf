//! LAMMPS: dumps, which are trajectories, and data files, which are what a simulation begins with.

pub(super) mod data;
pub(super) mod dump;
