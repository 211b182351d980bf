//! Limits of a scene, so that its parser takes no memory that is out of proportion: 48 bytes a word or sign, and a kilobyte a table.

use toml_parser::Source;
use toml_parser::parser::{Event, EventKind, RecursionGuard, parse_document};

/// The most signs that are between keys and values. The shortest scenes of 64 MiB have fewer.
const MOST_SIGNS: usize = 1 << 25;

/// The most parts of each kind. The shortest scenes of 64 MiB have fewer keys, tables and arrays. Each dot of a key makes a table, and
/// only a camera can have some.
const LIMITS: [(usize, &str); 4] =
    [(6 << 20, "keys"), (1 << 16, "dots in keys"), (3 << 20, "tables"), (3 << 20, "arrays")];

/// How deep the parser goes into arrays and tables.
const DEPTH: u32 = 80;

/// Refuses a text that is beyond a limit.
///
/// # Errors
/// The byte where it is, and what is wrong.
pub(super) fn check(text: &str) -> Result<(), (usize, String)> {
    if let Some(byte) = signs(text).nth(MOST_SIGNS) {
        return Err((
            byte,
            format!("a scene of more than {MOST_SIGNS} lines, values and brackets"),
        ));
    }
    match count(text) {
        (_, Some((byte, part))) => {
            let (most, what) = LIMITS[part];
            Err((byte, format!("a scene of more than {most} {what}")))
        }
        (_, None) => Ok(()),
    }
}

/// Where signs are.
fn signs(text: &str) -> impl Iterator<Item = usize> {
    let is_sign = |byte: u8| matches!(byte, b'\n' | b',' | b'[' | b']' | b'{' | b'}' | b'=');
    text.bytes().enumerate().filter(move |&(_, byte)| is_sign(byte)).map(|(at, _)| at)
}

/// How many parts of each kind the parser makes of a text, and byte and kind of the first that is beyond its limit. Errors do not stop the
/// parser: it makes parts of a text that is no TOML, too.
fn count(text: &str) -> ([usize; 4], Option<(usize, usize)>) {
    let (mut counts, mut beyond) = ([0; 4], None);
    let mut receive = |event: Event| {
        let part = match event.kind() {
            EventKind::SimpleKey => 0,
            EventKind::KeySep => 1,
            EventKind::StdTableOpen | EventKind::ArrayTableOpen | EventKind::InlineTableOpen => 2,
            EventKind::ArrayOpen => 3,
            _ => return,
        };
        counts[part] += 1;
        if counts[part] > LIMITS[part].0 {
            beyond.get_or_insert((event.span().start(), part));
        }
    };
    let tokens = Source::new(text).lex().into_vec();
    parse_document(&tokens, &mut RecursionGuard::new(&mut receive, DEPTH), &mut ());
    (counts, beyond)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LONGEST: usize = 64 << 20;

    #[test]
    fn no_scene_is_short_enough_to_be_beyond_them() {
        for (head, sphere) in [
            ("sphere=[", "{center=[0,0,0],radius=1},"),
            ("sphere=[", "{center=[0,0,0],radius=1,label=''},"),
            ("", "[[sphere]]\ncenter=[0,0,0]\nradius=1\n"),
            ("", "[[sphere]]\ncenter=[0,0,0]\nradius=1\nlabel=''\n"),
            ("", "[[sphere]]\ncenter=[0,0,0]\nradius=1\ncolor=\"#d04020\"\n"),
            ("", "[[sphere]]\ncenter=[\n0,\n0,\n0,\n]\nradius=1\n\n"),
            ("", "[[sphere]]\ncenter = [1.25, 2.5, 3.75]\nradius = 0.5\nlabel = \"A.12.CA\"\n"),
        ] {
            let text = format!("{head}{}", sphere.repeat(1000));
            let of_longest = |count: usize| count * LONGEST / text.len();
            assert!(of_longest(signs(&text).count()) <= MOST_SIGNS, "{sphere}");
            let (counts, _) = count(&text);
            assert!(counts[2] >= 1000 && counts[3] >= 1000, "{sphere}: {counts:?}");
            for (count, (most, what)) in counts.into_iter().zip(LIMITS) {
                assert!(of_longest(count) <= most, "{sphere}: {count} {what}");
            }
        }
    }

    #[test]
    fn dots_of_keys_are_beyond_them() {
        for (head, part) in [
            ("", "a.a.a.a.a.a.a.a=1\n"),
            ("", "[aa.b]\n"),
            ("", "[aa.b]\r"),
            ("a={", "a.a 1,"),
            ("a=[", "{1.1=1},"),
        ] {
            let found = check(&format!("{head}{}", part.repeat(70_000)));
            let what = "a scene of more than 65536 dots in keys".to_owned();
            assert_eq!(found.map_err(|(_, what)| what), Err(what), "{part}");
        }
    }

    #[test]
    fn what_takes_memory_is_counted_even_if_it_is_wrong() {
        for (head, part, counts) in [
            ("", "a=1\n", [1000, 0, 0, 0]),
            ("", "[a]\r", [1000, 0, 1000, 0]),
            ("a=[", "{a}", [1001, 0, 1000, 1]),
            ("a=[", "[1]", [1, 0, 0, 1001]),
        ] {
            assert_eq!(count(&format!("{head}{}", part.repeat(1000))), (counts, None), "{part}");
        }
        // `toml` makes arrays 80 deep; the one that is too deep is counted, too.
        let deep = format!("a={}", "[".repeat(100));
        assert_eq!(count(&deep).0, [1, 0, 0, 81]);
    }

    #[test]
    fn dots_of_numbers_strings_and_comments_are_no_tables() {
        for (head, part, tail) in [
            ("a=[", "1.5,\n", "]"),
            ("a='", "a.", "'"),
            ("a=\"\\\"", "a.", "\""),
            ("a='''", "a.\n'", "\n'''"),
            ("a=\"\"\"", "\\\"a.\n", "\"\"\""),
            ("#", "a.", ""),
        ] {
            let text = format!("{head}{}{tail}", part.repeat(70_000));
            assert_eq!(check(&text), Ok(()), "{head}");
        }
    }
}
