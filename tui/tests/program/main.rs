//! The program, run as its users run it; and what of its library needs the kernel's answers.
#![forbid(unsafe_code)]

mod bad_input;
mod cargo;
mod judge;
mod lecture;
mod light;
mod orders;
mod output;
mod pick;
mod png;
mod run;
mod scenes;
mod shadows;
mod show;
mod structures;
mod table;
mod trace;
mod traced;
mod tradeoff;
