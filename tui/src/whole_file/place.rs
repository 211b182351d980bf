//! Where a file is, however it is named.

use std::fs;
use std::path::{Path, PathBuf};

/// As many symbolic links as Linux follows.
const MOST_LINKS: usize = 40;

/// The place of the file called `name`, behind all symbolic links, whether there is a file or is to be one; `name` itself, as far as
/// its links lead, if there is no folder for it.
pub(super) fn place(name: &Path) -> PathBuf {
    if let Ok(place) = fs::canonicalize(name) {
        return place;
    }
    let mut name = name.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(target) = fs::read_link(&name) else { break };
        name = folder(&name).join(target);
    }
    match (fs::canonicalize(folder(&name)), name.file_name()) {
        (Ok(folder), Some(file)) => folder.join(file),
        _ => name,
    }
}

fn folder(name: &Path) -> &Path {
    match name.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
