//! Texts of others, such as names of files, in cells: one character in each.

/// The first character that may be two columns wide.
const FIRST_WIDE: char = '\u{1100}';

/// `text` with escapes for what may be wide, and for what is not seen.
pub(super) fn in_cells(text: &str) -> String {
    let mut letters = String::new();
    for letter in text.chars() {
        match letter {
            // Escaped, they would name another file.
            '"' | '\'' | '\\' => letters.push(letter),
            FIRST_WIDE.. => letters.extend(letter.escape_unicode()),
            _ => letters.extend(letter.escape_debug()),
        }
    }
    letters
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_is_seen_and_one_column_wide() {
        for (text, expected) in [
            (r#"'a"b\'c.xyz'"#, r#"'a"b\'c.xyz'"#),
            ("caf\u{e9} \u{3b1}.xyz", "caf\u{e9} \u{3b1}.xyz"),
            ("\u{539f}\u{5b50}.xyz", r"\u{539f}\u{5b50}.xyz"),
            ("a\n\x1b[31m", r"a\n\u{1b}[31m"),
            ("e\u{301}", r"e\u{301}"),
            ("\u{1f600}", r"\u{1f600}"),
        ] {
            assert_eq!(in_cells(text), expected, "{text:?}");
        }
    }
}
