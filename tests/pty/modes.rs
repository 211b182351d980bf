//! The states that a program can leave behind in a terminal, and the check that it has left none.

use rustix::termios::{LocalModes, Termios};
use std::collections::BTreeMap;
use vt100::{MouseProtocolMode, Screen};

/// Modes of the kernel's side of a terminal, as text: every flag and control character.
pub(crate) fn line_discipline(modes: &Termios) -> String {
    format!(
        "{:?} {:?} {:?} {:?} {:?}",
        modes.input_modes,
        modes.output_modes,
        modes.control_modes,
        modes.local_modes,
        modes.special_codes
    )
}

/// Whether the terminal shows typed text and gives it to programs line by line.
pub(crate) fn is_cooked(modes: &Termios) -> bool {
    modes.local_modes.contains(LocalModes::ECHO | LocalModes::ICANON)
}

/// All differences from a fresh terminal; empty if all is well. There are two witnesses: vt100's
/// model of the terminal, and the bytes, since the model does not know every mode.
pub(crate) fn left_behind(screen: &Screen, sent: &[u8]) -> Vec<String> {
    let mut found = Vec::new();
    let mut complain = |is_wrong: bool, what: &str| {
        if is_wrong {
            found.push(what.to_owned());
        }
    };
    complain(screen.alternate_screen(), "alternate screen");
    complain(screen.hide_cursor(), "hidden cursor");
    complain(screen.mouse_protocol_mode() != MouseProtocolMode::None, "mouse");
    complain(screen.application_cursor(), "application cursor keys");
    complain(screen.application_keypad(), "application keypad");
    complain(screen.bracketed_paste(), "bracketed paste");
    complain(screen.fgcolor() != vt100::Color::Default, "foreground colour");
    complain(screen.bgcolor() != vt100::Color::Default, "background colour");
    for (mode, is_set) in private_modes(sent) {
        complain(is_set != is_set_at_first(mode), &format!("mode {mode}"));
    }
    found
}

/// In a fresh terminal, wrapping and the cursor are on, and everything else is off.
fn is_set_at_first(mode: u16) -> bool {
    matches!(mode, 7 | 25)
}

/// The last state of every mode that `CSI ? ... h` or `l` has named.
fn private_modes(sent: &[u8]) -> BTreeMap<u16, bool> {
    let mut modes = BTreeMap::new();
    for start in 0..sent.len() {
        let Some(rest) = sent[start..].strip_prefix(b"\x1b[?") else { continue };
        let Some(end) = rest.iter().position(|byte| !matches!(byte, b'0'..=b'9' | b';')) else {
            continue;
        };
        let is_set = match rest[end] {
            b'h' => true,
            b'l' => false,
            _ => continue,
        };
        let parameters = String::from_utf8_lossy(&rest[..end]);
        modes.extend(parameters.split(';').filter_map(|mode| Some((mode.parse().ok()?, is_set))));
    }
    modes
}
