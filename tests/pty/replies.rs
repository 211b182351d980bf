//! A terminal's answers are no keys, however they come.

use super::picture::first;
use super::viewer::Viewer;
use std::thread;
use std::time::Duration;

/// Answers that hold letters which are keys: `q` quits, a space spins, `c` changes the characters.
const ANSWERS: [&str; 10] = [
    "\x1bP>|tmux 3.3a\x1b\\",
    "\x1bP1$r2 q\x1b\\",
    "\x1bP1$r0;48:2:1:2:3m\x1b\\",
    "\x1b]11;rgb:cccc/cccc/cccc\x1b\\",
    "\x1b]11;rgb:cccc/cccc/cccc\x07",
    "\x1b_Gi=1;OK q\x1b\\",
    "\x1b^q a privacy message\x1b\\",
    "\x1bXq a string\x1b\\",
    "\x1b[?62;4;22c",
    "\x1b[?2026;2$y",
];

#[test]
fn no_answer_is_a_key_wherever_it_is_split() {
    let mut viewer = Viewer::start();
    viewer.session.wait_for_peace();
    let sent = viewer.session.output().sent.len();
    for answer in ANSWERS {
        for at in 1..answer.len() {
            viewer.session.type_in(&answer[..at]);
            // Long enough for the parts to be read separately, too short for an escape to count as
            // the key.
            thread::sleep(Duration::from_millis(2));
            viewer.session.type_in(&answer[at..]);
        }
    }
    viewer.session.wait_for_peace();
    assert_eq!(viewer.session.output().text_after(sent), "");
    viewer.wait_for_picture("the first picture still", first());
    viewer.quit();
}

/// Half an answer that holds keys, with nothing after it.
#[test]
fn half_a_string_is_no_key_and_keys_act_afterwards() {
    let begun = ["\x1b]11;rgb:q c", "\x1b_Gi=1;q c", "\x1bP1$rq c", "\x1b^q c", "\x1bXq c\x1b"];
    // All of them wait at once.
    thread::scope(|scope| {
        for begun in begun {
            scope.spawn(move || {
                let mut viewer = Viewer::start();
                viewer.session.wait_for_peace();
                let sent = viewer.session.output().sent.len();
                viewer.session.type_in(begun);
                viewer.session.wait_for_peace();
                thread::sleep(Duration::from_millis(600));
                assert_eq!(viewer.session.output().sent.len(), sent, "{begun:?}");
                viewer.quit();
            });
        }
    });
}

#[test]
fn ctrl_c_ends_it_also_in_a_string() {
    let mut viewer = Viewer::start();
    viewer.session.quit("\x1b]11;rgb:\x03");
}
