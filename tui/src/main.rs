//! The program `spherule`: arguments in, exit code out. Everything else is in the library.
#![forbid(unsafe_code)]

use spherule::arguments::{self, Command, Request};
use spherule::error::{Error, write_stdout};
use spherule::{cases, judge, lecture, machine, manual, show, trace, tradeoff};
use spherule_kernel::Tier;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => error.report(),
    }
}

fn run() -> Result<(), Error> {
    let arguments = match arguments::parse(std::env::args_os())? {
        Request::Print(text) => return write_stdout(text.as_bytes()),
        Request::Run(arguments) => arguments,
    };
    let tier = match &arguments.command {
        None => Some(arguments.picture.accuracy),
        Some(Command::Trace(arguments)) => Some(arguments.accuracy),
        Some(Command::Generate { .. } | Command::Scenes) => None,
        // An answer is wrong if it differs from that of `exact`.
        Some(_) => Some(Tier::Exact),
    };
    tier.map_or(Ok(()), machine::check_floats)?;
    match &arguments.command {
        None => show::show(&arguments.picture),
        Some(Command::Trace(arguments)) => trace::trace(arguments),
        Some(Command::Tradeoff(arguments)) => tradeoff::tradeoff(arguments),
        Some(Command::Lecture(arguments)) => lecture::lecture(arguments),
        Some(Command::Cases(arguments)) => cases::cases(arguments),
        Some(Command::Judge(arguments)) => judge::judge(arguments),
        Some(Command::Generate { folder }) => manual::generate(folder),
        Some(Command::Scenes) => write_stdout(show::scenes().as_bytes()),
    }
}
