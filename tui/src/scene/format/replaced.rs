//! Whether a file that a picture would replace is a scene.

use super::Format;
use super::recognise::recognise;
use crate::scene::input::Input;
use std::fs::{self, File};
use std::path::Path;

/// The format of the scene that is in `file`; `None` if there is none.
pub(crate) fn format_of(file: &Path) -> Option<Format> {
    // Opening a pipe would wait for whoever writes to it.
    if !fs::metadata(file).is_ok_and(|data| data.is_file()) {
        return None;
    }
    let mut input = Input::of_file(File::open(file).ok()?, file.to_owned(), "").ok()?;
    let head = input.head(|_| true);
    // An older recording, which is JSON, has commas as a table has.
    if head.starts_with(b"{") { None } else { recognise(head).ok() }
}
