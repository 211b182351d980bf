//! Cases of the program that are rows of files: what it refuses, and which commands write the same.

use crate::run::{file, refusal, refuses, run_with_input, writes};

const REFUSALS: &str = include_str!("rows/refusals.txt");
const ALIKE: &str = include_str!("rows/alike.txt");

/// The rows of a file. A remark is none.
fn rows(text: &'static str) -> impl Iterator<Item = &'static str> {
    text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'))
}

/// The lines that a shell would make of one with braces.
fn expanded(line: &str) -> Vec<String> {
    let Some((before, rest)) = line.split_once('{') else { return vec![line.to_owned()] };
    let (choices, after) = rest.split_once('}').expect("the end of braces");
    let lines = choices.split(',').map(|choice| format!("{before}{choice}{after}"));
    lines.flat_map(|line| expanded(&line)).collect()
}

/// Whether a message is as expected, where a `*` is anything.
fn is_like(message: &str, expected: &str) -> bool {
    let Some((begin, others)) = expected.split_once('*') else { return message == expected };
    message.strip_prefix(begin).is_some_and(|rest| {
        let mut starts = rest.char_indices().map(|(start, _)| start).chain([rest.len()]);
        starts.any(|start| is_like(&rest[start..], others))
    })
}

/// The refusal of a command, and of the text that it reads.
fn refusal_of(command: &str) -> String {
    let Some((words, text)) = command.split_once(" <") else { return refuses(command) };
    let text = text.trim_start().replace("\\n", "\n");
    if words.starts_with('-') {
        return refusal(&run_with_input(words, text.as_bytes()));
    }
    let (name, options) = words.split_once(' ').unwrap_or((words, ""));
    let path = file(&format!("row-{name}"), text);
    refuses(&format!("{path} {options}")).replace(&path, name)
}

#[test]
fn what_is_refused() {
    let mut wrong = String::new();
    for row in rows(REFUSALS) {
        let (commands, expected) = row.split_once(" => ").expect("a message");
        for command in expanded(commands) {
            println!("{command}");
            let message = refusal_of(&command);
            if !is_like(&message, expected) {
                wrong += &format!("{command}: {message}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn what_is_alike() {
    let (mut first, mut usual, mut wrong) = ("", Vec::new(), String::new());
    for row in rows(ALIKE) {
        let Some(words) = row.strip_prefix(['=', '!']) else {
            (first, usual) = (row, writes(row));
            assert!(!usual.trim_ascii().is_empty(), "{row}: nothing");
            continue;
        };
        for words in expanded(words) {
            println!("{words}");
            if (writes(&words) == usual) != row.starts_with('=') {
                wrong += &format!("{first} beside {words}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
