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
    match arguments::parse(std::env::args_os())? {
        Request::Print(text) => write_stdout(text.as_bytes()),
        Request::Run(arguments) => match &arguments.command {
            None => {
                machine::check_floats(arguments.picture.accuracy)?;
                show::show(&arguments.picture)
            }
            Some(Command::Trace(arguments)) => {
                machine::check_floats(arguments.accuracy)?;
                trace::trace(arguments)
            }
            Some(Command::Tradeoff(arguments)) => {
                // An answer is wrong if it differs from that of `exact`.
                machine::check_floats(Tier::Exact)?;
                tradeoff::tradeoff(arguments)
            }
            Some(Command::Lecture(arguments)) => {
                machine::check_floats(Tier::Exact)?;
                lecture::lecture(arguments)
            }
            Some(Command::Cases(arguments)) => {
                machine::check_floats(Tier::Exact)?;
                cases::cases(arguments)
            }
            Some(Command::Judge(arguments)) => {
                machine::check_floats(Tier::Exact)?;
                judge::judge(arguments)
            }
            Some(Command::Generate { folder }) => manual::generate(folder),
            Some(Command::Scenes) => write_stdout(show::scenes().as_bytes()),
        },
    }
}
