//! Keys by their codes: terminals that are set up so, or were left so by another program, send Ctrl-C and Escape in no
//! other way.
//!
//! Sources: kitty's "Comprehensive keyboard handling in terminals"; xterm's "Control Sequences", "Alt and Meta Keys".

/// Bits of modifiers, of which 1 more is sent.
const SHIFT: u16 = 1;
const CONTROL: u16 = 4;
/// Caps Lock and Num Lock.
const LOCKS: u16 = 64 | 128;
const ENTER: u8 = b'\r';
const ESCAPE: u8 = 0x1b;

/// `code : shifted ; modifiers : event`: the byte that other terminals send for the key, if it is one.
pub(super) fn of_u(parameters: &[u8]) -> Option<u8> {
    let mut parameters = str::from_utf8(parameters).ok()?.split(';');
    byte(parameters.next()?, parameters.next().unwrap_or_default())
}

/// `27 ; modifiers ; code`: the same.
pub(super) fn of_27(parameters: &[u8]) -> Option<u8> {
    let mut parameters = str::from_utf8(parameters).ok()?.split(';');
    let (27, modifiers) = (number(parameters.next()?)?, parameters.next()?) else { return None };
    byte(parameters.next()?, modifiers)
}

/// Whether a key is let go, by the event that is told with its modifiers.
pub(super) fn is_let_go(parameters: &[u8]) -> bool {
    let modifiers = parameters.split(|&byte| byte == b';').nth(1);
    modifiers.is_some_and(|modifiers| modifiers.ends_with(b":3"))
}

fn byte(code: &str, modifiers: &str) -> Option<u8> {
    let held = match modifiers.split(':').next()? {
        "" => 0,
        sent => number(sent)?.checked_sub(1)? & !LOCKS,
    };
    let has_shift = held & SHIFT != 0;
    let mut codes = code.split(':');
    let own = number(codes.next()?)?;
    let shifted = codes.next().and_then(number).filter(|_| has_shift);
    let code = u8::try_from(shifted.unwrap_or(own)).ok()?;
    match (held & !SHIFT, code) {
        (0, code) => Some(if has_shift { code.to_ascii_uppercase() } else { code }),
        (CONTROL, ENTER | ESCAPE) => Some(code),
        (CONTROL, b'@'..=b'_' | b'a'..=b'z') => Some(code & 0x1f),
        // With Alt, it would be two bytes.
        _ => None,
    }
}

fn number(text: &str) -> Option<u16> {
    text.parse().ok()
}
