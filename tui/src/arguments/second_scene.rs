//! What is wrong with a word behind others: it is a second scene, or a command, or the first word was to be one.

use crate::scene::builtin::{builtin, shipped_file};
use crate::scene::file_name::FileName;
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
    if error.kind() != ErrorKind::ArgumentConflict {
        return None;
    }
    if is_command(second, program) {
        return Some(comes_first(second));
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

/// The message about a command behind options, which is read as the scene; `None` if there is none. The first of `words` is the name of
/// the program.
pub(super) fn late_command(program: &Command, words: &[OsString]) -> Option<String> {
    // Behind `--` no word is a command.
    let is_open = |place: &usize| words.get(place - 1).is_some_and(|word| word != "--");
    (2..words.len()).take_while(is_open).find_map(|place| {
        let word = words.get(place)?.to_str()?;
        if !is_command(word, program) {
            return None;
        }
        // Whether it is the scene or an option's value, the words up to it tell.
        let program = program.clone().ignore_errors(true);
        let matches = program.try_get_matches_from(words.get(..=place)?).ok()?;
        let scene = matches.try_get_one::<FileName>("name").ok()??;
        (matches.subcommand_name().is_none() && *scene == word).then(|| comes_first(word))
    })
}

fn comes_first(command: &str) -> String {
    format!("{command} is a command; it comes first, its options behind it")
}

/// Whether a word is the name of a command, and not also that of a scene.
fn is_command(word: &str, program: &Command) -> bool {
    let command = program.find_subcommand(word);
    command.is_some_and(|command| !command.is_hide_set()) && !is_scene(word)
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
