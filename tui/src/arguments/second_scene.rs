//! Messages about a word behind the scene, which is a second scene or a command, and about a first word that was to be a command.

use crate::scene::builtin::{builtin, shipped_file};
use crate::scene::file_name::FileName;
use clap::Command;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;
use std::path::Path;

/// So many letters of a command are no accident.
const ALIKE: usize = 4;

/// The message about a word behind the scene, which clap takes for a subcommand, or about options of a command that the first word was
/// to be; `None` if `error` is another one. `words` follow the name of the program.
pub(super) fn second_scene(
    error: &clap::Error,
    program: &Command,
    words: &[OsString],
) -> Option<String> {
    let second = match (error.kind(), error.get(ContextKind::InvalidSubcommand)) {
        (ErrorKind::ArgumentConflict, Some(ContextValue::String(second))) => Some(second),
        (ErrorKind::UnknownArgument, _) => None,
        _ => return None,
    };
    if let Some(second) = second.filter(|second| is_command(second, program)) {
        return Some(comes_first(second));
    }
    let first = words.first().and_then(|word| word.to_str());
    let meant = first.and_then(|first| Some((first, meant(first, program)?)));
    meant
        .map(|(first, meant)| format!("'{first}' is neither a scene nor a command; {meant}"))
        .or_else(|| second.map(|second| format!("'{second}' is a second scene; one is shown")))
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

/// What says which command, or `--help`, was meant by a word that is neither a scene nor a command; `None` if it is like neither.
pub(super) fn meant(word: &str, program: &Command) -> Option<String> {
    // Others are names of files.
    let is_word = word.bytes().all(|byte| byte.is_ascii_alphabetic());
    if !is_word || is_scene(word) || program.find_subcommand(word).is_some() {
        return None;
    }
    if word == "help" {
        return Some("--help is an option".to_owned());
    }
    command_like(word, program).map(|command| format!("{command} is a command"))
}

/// The command of which `word` is the beginning, or which is a slip of the hand away from it, or begins as it does.
fn command_like<'a>(word: &str, program: &'a Command) -> Option<&'a str> {
    let commands = program.get_subcommands().filter(|command| !command.is_hide_set());
    let names: Vec<&str> = commands.map(Command::get_name).collect();
    let whole = names.iter().find(|name| word.len() >= ALIKE && name.starts_with(word));
    let slip = names.iter().find(|name| is_slip(word.as_bytes(), name.as_bytes()));
    let nearest = names.iter().max_by_key(|name| alike(word.bytes(), name.bytes()));
    let nearest = nearest.filter(|name| alike(word.bytes(), name.bytes()) >= ALIKE);
    whole.or(slip).or(nearest).copied()
}

/// Whether one letter is another, missing or too many, or two neighbours have changed places.
fn is_slip(word: &[u8], name: &[u8]) -> bool {
    let first = alike(word.iter(), name.iter());
    let (word, name) = (&word[first..], &name[first..]);
    let last = alike(word.iter().rev(), name.iter().rev());
    match (&word[..word.len() - last], &name[..name.len() - last]) {
        ([a, b], [c, d]) => (a, b) == (d, c),
        (word, name) => word.len() <= 1 && name.len() <= 1,
    }
}

/// How many are the same before the first that differ.
fn alike<T: PartialEq>(a: impl Iterator<Item = T>, b: impl Iterator<Item = T>) -> usize {
    a.zip(b).take_while(|(a, b)| a == b).count()
}
