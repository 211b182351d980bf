//! The program `spherule`: arguments in, exit code out. Everything else is in the library.
#![forbid(unsafe_code)]

use spherule::arguments::{self, Command, Request};
use spherule::error::{Error, write_stdout};
use spherule::{show, trace, tradeoff};
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
            None => show::show(&arguments.picture),
            Some(Command::Trace(trace)) => trace::trace(trace),
            Some(Command::Tradeoff(arguments)) => tradeoff::tradeoff(arguments),
            Some(Command::Scenes) => write_stdout(show::scenes().as_bytes()),
        },
    }
}
