//! Files of unit tests.

use std::path::PathBuf;
use tempfile::TempDir;

thread_local! {
    /// A test has a thread of its own, at whose end the folder is removed.
    static FOLDER: TempDir = tempfile::tempdir().expect("a folder");
}

/// The path of a file of this test, which need not be there.
pub(crate) fn path(name: &str) -> PathBuf {
    FOLDER.with(|folder| folder.path().join(name))
}

/// Writes a file of this test. Returns its path.
pub(crate) fn written(name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = path(name);
    std::fs::write(&path, bytes).expect("a file");
    path
}
