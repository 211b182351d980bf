//! Pictures in cells against the truth: whether the scorer is right, and what the program reaches.

mod drawn;
mod floors;
mod ink;
mod measures;
mod motion;
mod scenes;
mod scorer;
mod spin;
mod turning;
