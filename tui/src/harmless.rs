//! Texts of others, such as names of files and names in them, as a terminal may get them.

use serde_json::Value;
use std::borrow::Cow;

/// The most characters of a line that are kept.
pub(crate) const LONGEST_LINE: usize = 1000;

/// Whether a terminal may obey a character in place of showing it: it controls the terminal, ends a line, or turns the direction of what
/// stands around it.
#[inline]
pub(crate) fn is_obeyed(letter: char) -> bool {
    let turns = matches!(
        letter,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    turns || letter.is_control()
}

/// At most [`LONGEST_LINE`] characters of `text` in one line, with escapes for what a terminal may obey.
pub(crate) fn line(text: &str) -> String {
    let mut line = String::new();
    for letter in cut(text, LONGEST_LINE).chars() {
        if is_obeyed(letter) {
            line.extend(letter.escape_default());
        } else {
            line.push(letter);
        }
    }
    line
}

/// `text` without its middle if it has more than `most` characters: a message begins with a name, and ends with what is wrong.
pub(crate) fn cut(text: &str, most: usize) -> Cow<'_, str> {
    let half = most / 2;
    let (first, last) = (text.char_indices().nth(half), text.char_indices().nth_back(half - 1));
    match (first, last) {
        (Some((head, _)), Some((tail, _))) if head < tail => {
            Cow::Owned(format!("{}...{}", &text[..head], &text[tail..]))
        }
        _ => Cow::Borrowed(text),
    }
}

/// `value` as JSON, with escapes for what a terminal may obey.
pub(crate) fn json(value: &Value) -> String {
    let mut text = String::new();
    // Outside of strings there is none, and none needs more than four digits.
    for letter in value.to_string().chars() {
        if is_obeyed(letter) {
            text += &format!("\\u{:04x}", u32::from(letter));
        } else {
            text.push(letter);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// One of each kind, and what they are as escapes of Rust and of JSON.
    const OBEYED: [(char, &str, &str); 8] = [
        ('\n', "\\n", "\\n"),
        ('\u{7f}', "\\u{7f}", "\\u007f"),
        ('\u{9b}', "\\u{9b}", "\\u009b"),
        ('\u{61c}', "\\u{61c}", "\\u061c"),
        ('\u{200f}', "\\u{200f}", "\\u200f"),
        ('\u{2028}', "\\u{2028}", "\\u2028"),
        ('\u{202e}', "\\u{202e}", "\\u202e"),
        ('\u{2069}', "\\u{2069}", "\\u2069"),
    ];

    #[test]
    fn what_a_terminal_may_obey_is_escaped() {
        for (letter, of_rust, of_json) in OBEYED {
            assert_eq!(line(&format!("a{letter}b")), format!("a{of_rust}b"));
            let value = json!({ "key": format!("a{letter}b") });
            let text = json(&value);
            assert_eq!(text, format!("{{\"key\":\"a{of_json}b\"}}"));
            assert_eq!(serde_json::from_str::<Value>(&text).expect("JSON"), value);
        }
        let others = "caf\u{e9} \u{3b1} \u{539f}\u{5b50} \\n \u{2027}\u{202f}";
        assert_eq!(line(others), others);
    }

    #[test]
    fn what_is_long_loses_its_middle() {
        assert_eq!(cut("abcdef", 4), "ab...ef");
        assert_eq!(cut("\u{e9}\u{e8}c\u{ea}\u{eb}", 4), "\u{e9}\u{e8}...\u{ea}\u{eb}");
        for short in ["", "a", "abc", "abcd"] {
            assert_eq!(cut(short, 4), short);
        }
        assert_eq!(line(&"x".repeat(LONGEST_LINE + 1)).len(), LONGEST_LINE + "...".len());
    }
}
