//! What terminals send for keys and mouse, as far as the viewer has a use for it. What it has no
//! use for is taken in whole, so that its parts are not mistaken for keys.

use crossterm::event::{
    Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};

const ESCAPE: u8 = 0x1b;
/// No sequence that means something is longer.
const LONGEST_SEQUENCE: usize = 64;

/// What the first bytes are.
#[derive(Debug, PartialEq)]
pub(super) enum Parsed {
    /// So many bytes, and what they mean.
    Taken(usize, Option<Event>),
    /// Nothing, or the beginning of something.
    Unfinished,
}

/// Takes one key, or one report of the mouse, from the front of `bytes`.
pub(super) fn parse(bytes: &[u8], more_may_come: bool) -> Parsed {
    let parsed = match bytes {
        [] => return Parsed::Unfinished,
        [ESCAPE] => Parsed::Unfinished,
        [ESCAPE, b'[', rest @ ..] => control_sequence(rest),
        [ESCAPE, b'O'] => Parsed::Unfinished,
        [ESCAPE, b'O', key, ..] => Parsed::Taken(3, arrow(*key)),
        [ESCAPE, ESCAPE, ..] => Parsed::Taken(1, Some(key(KeyCode::Esc))),
        // A key with Alt.
        [ESCAPE, _, ..] => Parsed::Taken(2, None),
        [b'\r', ..] => Parsed::Taken(1, Some(key(KeyCode::Enter))),
        [control @ 1..=26, ..] => {
            let letter = KeyCode::Char(char::from(control + b'a' - 1));
            Parsed::Taken(1, Some(Event::Key(KeyEvent::new(letter, KeyModifiers::CONTROL))))
        }
        [printable @ b' '..=b'~', ..] => {
            Parsed::Taken(1, Some(key(KeyCode::Char(char::from(*printable)))))
        }
        [_, ..] => Parsed::Taken(1, None),
    };
    match parsed {
        Parsed::Unfinished if bytes.len() > LONGEST_SEQUENCE => Parsed::Taken(bytes.len(), None),
        Parsed::Unfinished if !more_may_come => {
            Parsed::Taken(bytes.len(), (bytes == [ESCAPE]).then(|| key(KeyCode::Esc)))
        }
        parsed => parsed,
    }
}

/// What follows `ESC [`: parameters, and a final byte that says what they are for.
fn control_sequence(rest: &[u8]) -> Parsed {
    let Some(end) = rest.iter().position(|byte| !matches!(byte, b' '..=b'?')) else {
        return Parsed::Unfinished;
    };
    let event = match rest[end] {
        // Not a final byte: the sequence is broken off, and another thing begins.
        0..=0x1f => return Parsed::Taken(2 + end, None),
        last @ (b'M' | b'm') if rest[0] == b'<' => mouse(&rest[1..end], last == b'm'),
        b'~' => page(&rest[..end]),
        // Parameters of an arrow are modifiers.
        last => arrow(last),
    };
    Parsed::Taken(2 + end + 1, event)
}

fn key(code: KeyCode) -> Event {
    Event::Key(KeyEvent::new(code, KeyModifiers::NONE))
}

fn arrow(last: u8) -> Option<Event> {
    Some(key(match last {
        b'A' => KeyCode::Up,
        b'B' => KeyCode::Down,
        b'C' => KeyCode::Right,
        b'D' => KeyCode::Left,
        _ => return None,
    }))
}

/// `number ; modifiers` of the keys that have numbers.
fn page(parameters: &[u8]) -> Option<Event> {
    Some(key(match parameters.split(|&byte| byte == b';').next()? {
        b"5" => KeyCode::PageUp,
        b"6" => KeyCode::PageDown,
        _ => return None,
    }))
}

/// `button ; column ; row` of a press, a movement or a release, counted from 1.
fn mouse(parameters: &[u8], is_release: bool) -> Option<Event> {
    let mut numbers = str::from_utf8(parameters).ok()?.split(';').map(str::parse::<u16>);
    let mut next = || numbers.next()?.ok();
    let (button, column, row) = (next()?, next()?, next()?);
    // Bits 2 to 4 are modifiers.
    let kind = match (button & !0b1_1100, is_release) {
        (0, false) => MouseEventKind::Down(MouseButton::Left),
        (0, true) => MouseEventKind::Up(MouseButton::Left),
        (2, false) => MouseEventKind::Down(MouseButton::Right),
        (32, false) => MouseEventKind::Drag(MouseButton::Left),
        (34, false) => MouseEventKind::Drag(MouseButton::Right),
        (64, false) => MouseEventKind::ScrollUp,
        (65, false) => MouseEventKind::ScrollDown,
        _ => return None,
    };
    Some(Event::Mouse(MouseEvent {
        kind,
        column: column.saturating_sub(1),
        row: row.saturating_sub(1),
        modifiers: KeyModifiers::NONE,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn taken(bytes: &str) -> (usize, Option<Event>) {
        match parse(bytes.as_bytes(), true) {
            Parsed::Taken(count, event) => (count, event),
            Parsed::Unfinished => (0, None),
        }
    }

    #[test]
    fn keys() {
        assert_eq!(taken("q!"), (1, Some(key(KeyCode::Char('q')))));
        assert_eq!(taken("\x1b[Cq"), (3, Some(key(KeyCode::Right))));
        assert_eq!(taken("\x1b[1;5Cq"), (6, Some(key(KeyCode::Right))));
        assert_eq!(taken("\x1bOAq"), (3, Some(key(KeyCode::Up))));
        assert_eq!(taken("\r\r"), (1, Some(key(KeyCode::Enter))));
        assert_eq!(taken("\x1b[5~q"), (4, Some(key(KeyCode::PageUp))));
        assert_eq!(taken("\x1b[6;2~q"), (6, Some(key(KeyCode::PageDown))));
        let control = KeyEvent::new(KeyCode::Char('z'), KeyModifiers::CONTROL);
        assert_eq!(taken("\x1a"), (1, Some(Event::Key(control))));
    }

    #[test]
    fn an_escape_is_a_key_when_nothing_follows() {
        assert_eq!(parse(b"\x1b", true), Parsed::Unfinished);
        assert_eq!(parse(b"\x1b", false), Parsed::Taken(1, Some(key(KeyCode::Esc))));
        assert_eq!(parse(b"\x1b[1;", true), Parsed::Unfinished);
        assert_eq!(parse(b"\x1b[1;", false), Parsed::Taken(4, None));
        assert_eq!(taken("\x1b\x1b"), (1, Some(key(KeyCode::Esc))));
    }

    #[test]
    fn the_mouse() {
        let report = |kind, column, row| {
            let modifiers = KeyModifiers::NONE;
            Some(Event::Mouse(MouseEvent { kind, column, row, modifiers }))
        };
        let down = MouseEventKind::Down(MouseButton::Left);
        assert_eq!(taken("\x1b[<0;11;6M"), (10, report(down, 10, 5)));
        let drag = MouseEventKind::Drag(MouseButton::Left);
        // With Ctrl held.
        assert_eq!(taken("\x1b[<48;300;8M"), (12, report(drag, 299, 7)));
        assert_eq!(taken("\x1b[<65;1;1M"), (10, report(MouseEventKind::ScrollDown, 0, 0)));
        assert_eq!(
            taken("\x1b[<0;11;6m"),
            (10, report(MouseEventKind::Up(MouseButton::Left), 10, 5))
        );
        let pull = MouseEventKind::Drag(MouseButton::Right);
        assert_eq!(taken("\x1b[<34;11;6M"), (11, report(pull, 10, 5)));
        let press = MouseEventKind::Down(MouseButton::Right);
        assert_eq!(taken("\x1b[<2;11;6M"), (10, report(press, 10, 5)));
        assert_eq!(taken("\x1b[<2;11;6m"), (10, None));
        assert_eq!(taken("\x1b[<64;11;6m"), (11, None));
        assert_eq!(taken("\x1b[<0;99999;6M"), (13, None));
    }

    #[test]
    fn what_means_nothing_is_taken_whole() {
        assert_eq!(taken("\x1b[200~q"), (6, None));
        assert_eq!(taken("\x1b[?1;2cq"), (7, None));
        assert_eq!(taken("\x1bq"), (2, None));
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
}
