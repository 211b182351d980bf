use super::*;
use crate::color::Srgb;
use proptest::prelude::*;

fn taken(bytes: &str) -> (usize, Option<Incoming>) {
    match parse(bytes.as_bytes(), true) {
        Parsed::Taken(count, event) => (count, event),
        Parsed::Unfinished => (0, None),
    }
}

fn pressed(code: KeyCode) -> Option<Incoming> {
    Some(Incoming::User(key(code)))
}

fn control(letter: char) -> Incoming {
    Incoming::User(Event::Key(KeyEvent::new(KeyCode::Char(letter), KeyModifiers::CONTROL)))
}

#[test]
fn keys_are_told_whatever_follows_them() {
    let letter = |letter| pressed(KeyCode::Char(letter));
    for (bytes, expected) in [
        ("q", letter('q')),
        ("\r", pressed(KeyCode::Enter)),
        ("\x1a", Some(control('z'))),
        ("\x1b[C", pressed(KeyCode::Right)),
        ("\x1b[1;5C", pressed(KeyCode::Right)),
        ("\x1bOA", pressed(KeyCode::Up)),
        ("\x1b[5~", pressed(KeyCode::PageUp)),
        ("\x1b[6;2~", pressed(KeyCode::PageDown)),
        // With Alt, where that is an escape before the key.
        ("\x1b\x1b[A", pressed(KeyCode::Up)),
        ("\x1b\x1bOC", pressed(KeyCode::Right)),
        ("\x1b\x1b[6~", pressed(KeyCode::PageDown)),
        ("\x1b\x1b[3~", None),
        ("\x1b\x1bOP", None),
        // By their codes: some terminals send no other Ctrl-C, Ctrl-Z or Escape than these.
        ("\x1b[99;5u", Some(control('c'))),
        ("\x1b[27;5;99~", Some(control('c'))),
        ("\x1b[122;5u", Some(control('z'))),
        ("\x1b[27;5;122~", Some(control('z'))),
        // With Num Lock, with Shift, and held down.
        ("\x1b[99;133u", Some(control('c'))),
        ("\x1b[99:67;6u", Some(control('c'))),
        ("\x1b[99;5:1u", Some(control('c'))),
        ("\x1b[99;5:2u", Some(control('c'))),
        ("\x1b[27u", pressed(KeyCode::Esc)),
        ("\x1b[27;1u", pressed(KeyCode::Esc)),
        ("\x1b[27;5u", pressed(KeyCode::Esc)),
        ("\x1b[91;5u", pressed(KeyCode::Esc)),
        ("\x1b[27;1;27~", pressed(KeyCode::Esc)),
        ("\x1b[13;2u", pressed(KeyCode::Enter)),
        ("\x1b[113u", letter('q')),
        ("\x1b[113;;113u", letter('q')),
        ("\x1b[107;2u", letter('K')),
        ("\x1b[47:63;2u", letter('?')),
        ("\x1b[27;2;63~", letter('?')),
        ("\x1b[27;2;75~", letter('K')),
        ("\x1b[1;1:1A", pressed(KeyCode::Up)),
        ("\x1b[5;1:2~", pressed(KeyCode::PageUp)),
        // Let go, with Alt, of no byte, or no key at all.
        ("\x1b[99;5:3u", None),
        ("\x1b[1;1:3A", None),
        ("\x1b[5;1:3~", None),
        ("\x1b[113;3u", None),
        ("\x1b[27;3;113~", None),
        ("\x1b[57361u", None),
        ("\x1b[113;0u", None),
        ("\x1b[113;99999u", None),
        ("\x1b[27;5~", None),
        ("\x1b[?1u", None),
        ("\x1b[u", None),
    ] {
        for next in ["", "q", "\r"] {
            let (count, key) = taken(&format!("{bytes}{next}"));
            assert_eq!((count, &key), (bytes.len(), &expected), "{bytes:?} before {next:?}");
        }
    }
}

#[test]
fn function_keys_of_the_console_are_no_letters() {
    for letter in 'A'..='E' {
        assert_eq!(taken(&format!("\x1b[[{letter}q")), (4, None), "{letter}");
    }
    assert_eq!(parse(b"\x1b[[", true), Parsed::Unfinished);
    assert_eq!(taken("\x1b[[q"), (3, None));
}

#[test]
fn an_escape_is_a_key_when_nothing_follows() {
    assert_eq!(parse(b"\x1b", true), Parsed::Unfinished);
    assert_eq!(parse(b"\x1b", false), Parsed::Taken(1, pressed(KeyCode::Esc)));
    assert_eq!(parse(b"\x1b[1;", true), Parsed::Unfinished);
    assert_eq!(parse(b"\x1b[1;", false), Parsed::Taken(4, None));
    assert_eq!(taken("\x1b\x1b"), (1, pressed(KeyCode::Esc)));
    for control in ["\x1b\x03", "\x1b\x1a"] {
        assert_eq!(taken(control), (1, pressed(KeyCode::Esc)), "{control:?}");
    }
}

/// The beginning of an arrow with Alt is waited for; what is none leaves the key that was typed before it.
#[test]
fn an_escape_before_another_sequence_than_a_key_is_the_key() {
    for begun in ["\x1b\x1b[", "\x1b\x1bO", "\x1b\x1b[1;"] {
        assert_eq!(parse(begun.as_bytes(), true), Parsed::Unfinished, "{begun:?}");
        let given_up = parse(begun.as_bytes(), false);
        assert_eq!(given_up, Parsed::Taken(1, pressed(KeyCode::Esc)), "{begun:?}");
    }
    let letters = ["[99;5u", "[27;5;99~", "[\x03"];
    let others = ["[0n", "]11;q\x07", "[<0;11;6M", "[M q~", "\x1b[A"];
    for next in letters.into_iter().chain(others) {
        let (count, key) = taken(&format!("\x1b\x1b{next}"));
        assert_eq!((count, key), (1, pressed(KeyCode::Esc)), "{next:?}");
    }
}

/// Else an answer, or Ctrl-C, would be lost.
#[test]
fn alt_and_o_take_nothing_that_follows_them() {
    for next in ["\x1b[0n", "\x03", "\r"] {
        assert_eq!(taken(&format!("\x1bO{next}")), (2, None), "{next:?}");
    }
}

#[test]
fn the_mouse() {
    let report = |kind, column, row| {
        let modifiers = KeyModifiers::NONE;
        Some(Incoming::User(Event::Mouse(MouseEvent { kind, column, row, modifiers })))
    };
    let down = MouseEventKind::Down(MouseButton::Left);
    assert_eq!(taken("\x1b[<0;11;6M"), (10, report(down, 10, 5)));
    let drag = MouseEventKind::Drag(MouseButton::Left);
    // With Ctrl held.
    assert_eq!(taken("\x1b[<48;300;8M"), (12, report(drag, 299, 7)));
    assert_eq!(taken("\x1b[<65;1;1M"), (10, report(MouseEventKind::ScrollDown, 0, 0)));
    let pull = MouseEventKind::Drag(MouseButton::Right);
    assert_eq!(taken("\x1b[<34;11;6M"), (11, report(pull, 10, 5)));
    let buttons = [MouseButton::Left, MouseButton::Middle, MouseButton::Right];
    for (code, button) in buttons.into_iter().enumerate() {
        let (pressed, let_go) = (format!("\x1b[<{code};11;6M"), format!("\x1b[<{code};11;6m"));
        assert_eq!(taken(&pressed), (10, report(MouseEventKind::Down(button), 10, 5)));
        assert_eq!(taken(&let_go), (10, report(MouseEventKind::Up(button), 10, 5)));
    }
    assert_eq!(taken("\x1b[<64;11;6m"), (11, None));
    assert_eq!(taken("\x1b[<3;11;6M"), (10, None));
    assert_eq!(taken("\x1b[<0;99999;6M"), (13, None));
}

/// The bytes of a report may be letters that are keys.
#[test]
fn the_mouse_in_three_bytes_is_no_key() {
    assert_eq!(taken("\x1b[M q!k"), (6, None));
    assert_eq!(taken("\x1b[M\0\0\0k"), (6, None));
    for begun in ["\x1b[M", "\x1b[M ", "\x1b[M q"] {
        assert_eq!(parse(begun.as_bytes(), true), Parsed::Unfinished, "{begun:?}");
        assert_eq!(parse(begun.as_bytes(), false), Parsed::Taken(begun.len(), None), "{begun:?}");
    }
    // What breaks it off acts.
    assert_eq!(taken("\x1b[M\x03"), (3, None));
    assert_eq!(taken("\x1b[M q\x1b[C"), (5, None));
}

#[test]
fn what_means_nothing_is_taken_whole() {
    assert_eq!(taken("\x1b[200~q"), (6, None));
    assert_eq!(taken("\x1b[?1;2Dq"), (7, None));
    assert_eq!(taken("\x1b[>0;95;0cq"), (10, None));
    assert_eq!(taken("\x1bq"), (2, None));
    let overlong = format!("\x1b[{}", "1;".repeat(40));
    assert_eq!(taken(&overlong), (overlong.len(), None));
}

/// Answers with letters that are keys, as terminals send them, and what is understood of them.
fn answers() -> Vec<(String, Option<Reply>)> {
    let truecolor = Reply::Truecolor(true);
    [
        ("\x1bP>|tmux 3.3a\x1b\\", None),
        ("\x1bP>|kitty(0.43.1)\x1b\\", None),
        ("\x1b]11;rgb:2828/2c2c/3434\x1b\\", Some(Reply::Background(Srgb([0x28, 0x2c, 0x34])))),
        ("\x1b]11;rgb:eeee/eeee/eeee\x07", Some(Reply::Background(Srgb([0xee; 3])))),
        ("\x1b_Gi=1;OK\x1b\\", Some(Reply::Image(1, true))),
        ("\x1b_Gi=31,p=1;ENOENT:no such q\x1b\\", Some(Reply::Image(31, false))),
        ("\x1bP1$r0;48:2:1:2:3m\x1b\\", Some(truecolor)),
        ("\x1bP1$r0;48:2::1:2:3m\x1b\\", Some(truecolor)),
        ("\x1bP1+r524742=38\x1b\\", None),
        ("\x1bP0$r\x1b\\", None),
        ("\x1b^q is a privacy message\x1b\\", None),
        ("\x1bXqqq\x1b\\", None),
        ("\x1b]52;c;cXE=\x1b\\", None),
        ("\x1b[?62;4;22c", Some(Reply::Attributes { sixel: true })),
        ("\x1b[?62;22c", Some(Reply::Attributes { sixel: false })),
        ("\x1b[?2026;2$y", Some(Reply::Synchronized(true))),
        ("\x1b[6;20;10t", Some(Reply::CellPixels(10, 20))),
        ("\x1b[0n", Some(Reply::Status)),
        ("\x1b[1;1R", None),
    ]
    .map(|(bytes, reply)| (bytes.to_owned(), reply))
    .into()
}

/// However much is read at a time, an answer is one event or none, and the key that follows it is that key.
#[test]
fn answers_are_no_keys_wherever_they_are_split() {
    for (answer, reply) in answers() {
        let bytes = format!("{answer}q");
        for split in 0..=bytes.len() {
            let (mut pending, mut events) = (Vec::new(), Vec::new());
            for part in [&bytes[..split], &bytes[split..]] {
                pending.extend_from_slice(part.as_bytes());
                let mut start = 0;
                while let Parsed::Taken(count, event) = parse(&pending[start..], true) {
                    start += count;
                    events.extend(event);
                }
                pending.drain(..start);
            }
            let expected: Vec<_> =
                reply.map(Incoming::Reply).into_iter().chain(pressed(KeyCode::Char('q'))).collect();
            assert_eq!(events, expected, "{answer:?} at {split}");
            assert!(pending.is_empty());
        }
    }
}

#[test]
fn a_string_without_an_end_is_dropped_whole() {
    for begun in ["\x1b]11;rgb:q", "\x1bP1$rq", "\x1b_Gq\x1b", "\x1b^q", "\x1bXq"] {
        assert_eq!(parse(begun.as_bytes(), true), Parsed::Unfinished, "{begun:?}");
        assert_eq!(parse(begun.as_bytes(), false), Parsed::Taken(begun.len(), None), "{begun:?}");
    }
}

/// Else a terminal that begins a string and never ends it could not be left.
#[test]
fn an_escape_or_a_control_key_breaks_a_string_off() {
    assert_eq!(taken("\x1b]11;rgb:q\x1b[A"), (10, None));
    assert_eq!(taken("\x1b]11;rgb:q\x03"), (10, None));
    assert_eq!(taken("\x1b]11;rgb:q\x1a"), (10, None));
    // Not a bell, which ends operating system commands alone, nor what strings may hold.
    assert_eq!(taken("\x1bPq\x07"), (3, None));
    assert_eq!(taken("\x1bPq\r\nq\x1b\\"), (8, None));
}

proptest! {
    #[test]
    fn any_bytes_come_to_an_end(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut rest = &bytes[..];
        while let Parsed::Taken(count, _) = parse(rest, false) {
            prop_assert!(count > 0);
            rest = &rest[count..];
        }
        prop_assert!(rest.is_empty());
    }
}
