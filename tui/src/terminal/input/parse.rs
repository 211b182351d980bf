//! What terminals send: keys, the mouse and answers, as far as the program has a use for them. What it has no use for
//! is taken in whole, so that its parts are not mistaken for keys.

mod coded;

use super::super::reply::{self, Reply};
use crossterm::event::{
    Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};

const ESCAPE: u8 = 0x1b;
const CTRL_C: u8 = 3;
const CTRL_Z: u8 = 26;
/// Ends an operating system command as the string terminator does.
const BELL: u8 = 0x07;
/// The longest sequence that means something.
const LONGEST_SEQUENCE: usize = 64;

/// What comes from the terminal.
#[derive(Clone, Debug, PartialEq)]
pub enum Incoming {
    /// Of the user: keys, the mouse, another size.
    User(Event),
    /// Of the terminal itself, which was asked.
    Reply(Reply),
}

/// What the first bytes are.
#[derive(Debug, PartialEq)]
pub(super) enum Parsed {
    /// So many bytes, and what they mean.
    Taken(usize, Option<Incoming>),
    /// Nothing, or the beginning of something.
    Unfinished,
}

/// Takes one key, one report of the mouse, or one answer from the front of `bytes`.
pub(super) fn parse(bytes: &[u8], more_may_come: bool) -> Parsed {
    let parsed = match bytes {
        [] => return Parsed::Unfinished,
        [ESCAPE] => Parsed::Unfinished,
        [ESCAPE, b'[', rest @ ..] => control_sequence(rest),
        [ESCAPE, kind @ (b']' | b'P' | b'_' | b'^' | b'X'), rest @ ..] => string(*kind, rest),
        [ESCAPE, b'O'] => Parsed::Unfinished,
        // Not the end of that key: it is broken off, and another thing begins.
        [ESCAPE, b'O', 0..=0x1f, ..] => Parsed::Taken(2, None),
        [ESCAPE, b'O', last, ..] => Parsed::Taken(3, arrow(*last).map(user)),
        [ESCAPE, sequence @ ..] if matches!(sequence, [ESCAPE, b'[' | b'O', ..]) => {
            after_escape(sequence, more_may_come)
        }
        // Whoever types Ctrl-C or Ctrl-Z after it means it.
        [ESCAPE, ESCAPE | CTRL_C | CTRL_Z, ..] => Parsed::Taken(1, Some(user(key(KeyCode::Esc)))),
        // A key with Alt.
        [ESCAPE, _, ..] => Parsed::Taken(2, None),
        [byte, ..] => Parsed::Taken(1, of_byte(*byte).map(user)),
    };
    match parsed {
        Parsed::Unfinished if !more_may_come => {
            Parsed::Taken(bytes.len(), (bytes == [ESCAPE]).then(|| user(key(KeyCode::Esc))))
        }
        parsed => parsed,
    }
}

/// What an escape and the `sequence` behind it are: some terminals send an arrow with Alt so, which is the arrow as it is elsewhere.
/// Behind the key Escape come answers, the mouse, and letters by their codes: whoever types Ctrl-C means it.
fn after_escape(sequence: &[u8], more_may_come: bool) -> Parsed {
    match parse(sequence, more_may_come) {
        Parsed::Taken(count, of) if is_named_key(&sequence[..count]) => {
            Parsed::Taken(1 + count, of)
        }
        Parsed::Taken(..) => Parsed::Taken(1, Some(user(key(KeyCode::Esc)))),
        Parsed::Unfinished => Parsed::Unfinished,
    }
}

/// Whether a whole sequence is a key that is no letter: an arrow, one for pages, F1 and the like.
fn is_named_key(sequence: &[u8]) -> bool {
    match sequence {
        [ESCAPE, b'O', last] => last.is_ascii_alphabetic(),
        [ESCAPE, b'[', parameters @ .., last] => {
            is_plain(parameters)
                && matches!(last, b'A'..=b'H' | b'~')
                && coded::of_27(parameters).is_none()
        }
        _ => false,
    }
}

/// Whether `bytes`, which are unfinished, are the beginning of a string, which may be of any length.
pub(super) fn is_string(bytes: &[u8]) -> bool {
    matches!(bytes, [ESCAPE, b']' | b'P' | b'_' | b'^' | b'X', ..])
}

/// Whether `bytes`, which are unfinished, may be a key: an escape that nothing follows.
pub(super) fn may_be_a_key(bytes: &[u8]) -> bool {
    bytes == [ESCAPE]
}

/// What follows `ESC` and `kind`, the introducer of an operating system command (OSC), a device control string (DCS), an
/// application program command (APC), a privacy message (PM) or a string (SOS): all up to the string terminator.
///
/// Another escape begins something else and breaks the string off. So does a control character that no string holds:
/// whoever types Ctrl-C means it, whatever the terminal has begun to say.
fn string(kind: u8, rest: &[u8]) -> Parsed {
    for (at, &byte) in rest.iter().enumerate() {
        let ended = |length| {
            Parsed::Taken(2 + at + length, reply::of_string(kind, &rest[..at]).map(Incoming::Reply))
        };
        match (byte, rest.get(at + 1)) {
            (BELL, _) if kind == b']' => return ended(1),
            (ESCAPE, Some(b'\\')) => return ended(2),
            (ESCAPE, None) => return Parsed::Unfinished,
            // Backspace to carriage return are those that ECMA-48 has in strings.
            (ESCAPE | 0..0x08 | 0x0e..0x20, _) => return Parsed::Taken(2 + at, None),
            _ => {}
        }
    }
    Parsed::Unfinished
}

/// What follows `ESC [`: parameters, and a final byte that says what they are for.
fn control_sequence(rest: &[u8]) -> Parsed {
    // F1 to F5 of Linux's console have a second bracket, and then a letter.
    match rest {
        [b'['] => return Parsed::Unfinished,
        [b'[', b'A'..=b'E', ..] => return Parsed::Taken(4, None),
        [b'M', report @ ..] => return bytes_of_mouse(report),
        _ => {}
    }
    let Some(end) = rest.iter().position(|byte| !matches!(byte, b' '..=b'?')) else {
        let is_overlong = rest.len() > LONGEST_SEQUENCE;
        return if is_overlong { Parsed::Taken(2 + rest.len(), None) } else { Parsed::Unfinished };
    };
    let (parameters, last) = (&rest[..end], rest[end]);
    let of_user = match last {
        // Not a final byte: the sequence is broken off, and another thing begins.
        0..=0x1f => return Parsed::Taken(2 + end, None),
        b'M' | b'm' if parameters.first() == Some(&b'<') => mouse(&parameters[1..], last == b'm'),
        _ if !is_plain(parameters) || coded::is_let_go(parameters) => None,
        b'u' => coded::of_u(parameters).and_then(of_byte),
        b'~' => page(parameters).or_else(|| coded::of_27(parameters).and_then(of_byte)),
        // Parameters of an arrow are modifiers.
        _ => arrow(last),
    };
    let of_terminal = || reply::of_sequence(parameters, last).map(Incoming::Reply);
    Parsed::Taken(2 + end + 1, of_user.map(user).or_else(of_terminal))
}

/// Whether parameters are numbers. Behind a colon is more about the number before it.
fn is_plain(parameters: &[u8]) -> bool {
    parameters.iter().all(|byte| matches!(byte, b'0'..=b'9' | b';' | b':'))
}

/// What follows `ESC [ M`: button, column and row in a byte each, with 32 added, from terminals that know no decimal
/// coordinates. A control character breaks it off, except 0, which is a place too far away.
fn bytes_of_mouse(report: &[u8]) -> Parsed {
    let report = &report[..report.len().min(3)];
    match report.iter().position(|byte| matches!(byte, 1..=0x1f)) {
        Some(end) => Parsed::Taken(3 + end, None),
        None if report.len() < 3 => Parsed::Unfinished,
        None => Parsed::Taken(6, None),
    }
}

fn user(event: Event) -> Incoming {
    Incoming::User(event)
}

fn key(code: KeyCode) -> Event {
    Event::Key(KeyEvent::new(code, KeyModifiers::NONE))
}

/// A key that is sent as one byte.
fn of_byte(byte: u8) -> Option<Event> {
    match byte {
        b'\r' => Some(key(KeyCode::Enter)),
        ESCAPE => Some(key(KeyCode::Esc)),
        1..=26 => {
            let letter = KeyCode::Char(char::from(byte + b'a' - 1));
            Some(Event::Key(KeyEvent::new(letter, KeyModifiers::CONTROL)))
        }
        b' '..=b'~' => Some(key(KeyCode::Char(char::from(byte)))),
        _ => None,
    }
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
    let code = button & !0b1_1100;
    let held = match code & 0b11 {
        0 => MouseButton::Left,
        1 => MouseButton::Middle,
        2 => MouseButton::Right,
        _ => return None,
    };
    let kind = match (code, is_release) {
        (0..=2, false) => MouseEventKind::Down(held),
        (0..=2, true) => MouseEventKind::Up(held),
        (32..=34, false) => MouseEventKind::Drag(held),
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
mod tests;
