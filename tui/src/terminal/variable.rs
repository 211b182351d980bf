//! A variable of the environment.

use std::env;

/// The text of a variable; empty if there is none.
pub(crate) fn variable(name: &str) -> String {
    env::var_os(name).unwrap_or_default().to_string_lossy().into_owned()
}
