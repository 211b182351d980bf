//! What is wrong with a word behind the scene: it is a second scene, or the first word was to be a command.

use crate::scene::builtin::{builtin, shipped_file};
use clap::Command;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;
use std::path::Path;

/// So many letters of a command are no accident.
const ALIKE: usize = 4;

/// The message about a word behind the scene, which clap takes for a subcommand; `None` if `error` is another one.
/// `words` follow the name of the program.
pub(super) fn second_scene(
    error: &clap::Error,
    program: &Command,
    words: &[OsString],
) -> Option<String> {
    let Some(ContextValue::String(second)) = error.get(ContextKind::InvalidSubcommand) else {
        return None;
    };
    if error.kind() != ErrorKind::ArgumentConflict || program.find_subcommand(second).is_some() {
        return None;
    }
    let first = words.first().and_then(|word| word.to_str()).filter(|word| !is_scene(word));
    let meant = first.and_then(|first| Some((first, command_like(first, program)?)));
    Some(meant.map_or_else(
        || format!("'{second}' is a second scene; one is shown"),
        |(first, command)| {
            format!("'{first}' is neither a scene nor a command; {command} is a command")
        },
    ))
}

fn is_scene(word: &str) -> bool {
    Path::new(word).exists() || builtin(word).is_some() || shipped_file(word).is_some()
}

/// The command that begins as `word` does.
fn command_like<'a>(word: &str, program: &'a Command) -> Option<&'a str> {
    let alike = |name: &str| word.bytes().zip(name.bytes()).take_while(|(a, b)| a == b).count();
    let commands = program.get_subcommands().filter(|command| !command.is_hide_set());
    let nearest = commands.map(Command::get_name).max_by_key(|name| alike(name));
    nearest.filter(|name| alike(name) >= ALIKE)
}
