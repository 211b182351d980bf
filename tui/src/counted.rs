//! Numbers of things, in the singular or the plural.

/// Formats a count with its noun: 1 atom, 2 atoms.
pub(crate) fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
