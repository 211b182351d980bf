//! Limits of a robot's XML: beyond them its parser takes the square of a file's time, or memory for what is not there.

use memchr::{memchr2_iter, memchr3, memmem};
use std::collections::HashSet;

/// The most attributes of an element, each of which the parser compares with those before it. The most namespaces, in which it looks for
/// that of each element.
const MOST: usize = 64;

/// The longest name of a namespace, in bytes: the parser compares attributes by it, too.
const LONGEST: usize = 256;

/// The most signs of elements and attributes, for which the parser reserves memory.
const MOST_SIGNS: usize = 1 << 23;

/// Passages without elements, by how they begin and end.
const PASSAGES: [(&[u8], &[u8]); 3] = [(b"<!--", b"-->"), (b"<![CDATA[", b"]]>"), (b"<?", b"?>")];

/// Refuses a text that is beyond a limit.
///
/// # Errors
/// The byte where it is, and what is wrong.
pub(super) fn check(text: &str) -> Result<(), (usize, String)> {
    let bytes = text.as_bytes();
    if memchr2_iter(b'<', b'=', bytes).count() > MOST_SIGNS {
        return Err((0, format!("more than {MOST_SIGNS} elements and attributes")));
    }
    let (mut at, mut namespaces) = (0, HashSet::new());
    while let Some(length) = memchr::memchr(b'<', &bytes[at..]) {
        let start = at + length;
        let rest = &bytes[start..];
        if let Some((begin, end)) = PASSAGES.iter().find(|(begin, _)| rest.starts_with(begin)) {
            // One that does not end is the parser's to refuse.
            let Some(length) = memmem::find(&rest[begin.len()..], end) else { break };
            at = start + begin.len() + length;
            continue;
        }
        at = start + 1;
        let tag = &bytes[at..];
        let tag = &tag[..memchr::memchr(b'<', tag).unwrap_or(tag.len())];
        for (before, (name, value)) in attributes(tag).enumerate() {
            if before == MOST {
                return Err((start, format!("an element of more than {MOST} attributes")));
            }
            let Some(begin) = memmem::find(name, b"xmlns") else { continue };
            // Declared again, it is the same.
            namespaces.insert((&name[begin..], value));
            if namespaces.len() > MOST {
                return Err((start, format!("more than {MOST} namespaces")));
            }
            if value.len() > LONGEST {
                return Err((start, format!("a namespace of more than {LONGEST} bytes")));
            }
        }
    }
    Ok(())
}

/// Names and values of a tag's attributes. What stands before a name belongs to it.
fn attributes(tag: &[u8]) -> impl Iterator<Item = (&[u8], &[u8])> {
    let mut rest = tag;
    std::iter::from_fn(move || {
        // The tag ends outside of values.
        let open = memchr3(b'"', b'\'', b'>', rest).filter(|&open| rest[open] != b'>')?;
        let (name, value) = (&rest[..open], &rest[open + 1..]);
        let length = memchr::memchr(rest[open], value)?;
        rest = &value[length + 1..];
        Some((name, &value[..length]))
    })
}
