//! Limits of a scene, so that its parser takes no memory that is out of proportion: 48 bytes a word or sign, and a kilobyte a table.

/// The most signs that are between keys and values. The shortest scenes of 64 MiB have fewer.
const MOST_SIGNS: usize = 1 << 25;

/// The most keys, of which any may be the only one in its table. The shortest scenes of 64 MiB have fewer.
const MOST_KEYS: usize = 6 << 20;

/// Refuses a text that is beyond a limit.
///
/// # Errors
/// What is wrong.
pub(super) fn check(text: &str) -> Result<(), String> {
    let (mut signs, mut keys, mut has_dot) = (0, 0, false);
    for byte in text.bytes() {
        match byte {
            // A number has one dot, and each part of a dotted key is a table.
            b'.' => {
                keys += usize::from(has_dot);
                has_dot = true;
            }
            b'\n' | b',' | b'[' | b']' | b'{' | b'}' | b'=' => {
                signs += 1;
                if byte == b'=' {
                    keys += 1 + usize::from(has_dot);
                }
                has_dot = false;
            }
            _ => {}
        }
    }
    // The first dot of a header makes a table, too.
    let has_tables = |line: &&str| line.trim_start().starts_with('[') && line.contains('.');
    keys += text.lines().filter(has_tables).count();
    if signs > MOST_SIGNS {
        return Err(format!("a scene of more than {MOST_SIGNS} lines, values and brackets"));
    }
    if keys > MOST_KEYS {
        return Err(format!("a scene of more than {MOST_KEYS} keys"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LONGEST: usize = 64 << 20;

    fn of_length(part: &str) -> String {
        part.repeat(LONGEST / part.len())
    }

    #[test]
    fn no_scene_is_short_enough_to_be_beyond_them() {
        for sphere in [
            "{center=[0,0,0],radius=1},",
            "{center=[0,0,0],radius=1,label=''},",
            "[[sphere]]\ncenter=[\n0,\n0,\n0,\n]\nradius=1\n\n",
            "[[sphere]]\ncenter = [1.25, 2.5, 3.75]\nradius = 0.5\nlabel = \"A.12.CA\"\n",
        ] {
            assert_eq!(check(&of_length(sphere)), Ok(()), "{sphere}");
        }
    }

    #[test]
    fn what_takes_more_memory_is_beyond_them() {
        for (part, what) in [
            ("\n", "a scene of more than 33554432 lines, values and brackets"),
            ("{a = 1},", "a scene of more than 6291456 keys"),
            ("a.a.a.a.a.a.a.a=1\n", "a scene of more than 6291456 keys"),
            ("{1.1=1},", "a scene of more than 6291456 keys"),
            ("[aa.b]\n", "a scene of more than 6291456 keys"),
        ] {
            assert_eq!(check(&of_length(part)), Err(what.to_owned()), "{part}");
        }
    }
}
