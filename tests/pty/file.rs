//! Files of the tests' own.

use std::fs;
use std::path::PathBuf;
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};

/// A temporary file, which is removed at the end.
pub(crate) struct TestFile {
    path: PathBuf,
}

impl TestFile {
    /// Writes a file with this ending of its name.
    pub(crate) fn new(ending: &str, bytes: impl AsRef<[u8]>) -> Self {
        let file = Self::not_yet(ending);
        fs::write(&file.path, bytes).expect("a temporary file");
        file
    }

    /// The place of a file that is not there yet.
    pub(crate) fn not_yet(ending: &str) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("spherule-{}-{number}.{ending}", process::id());
        Self { path: std::env::temp_dir().join(name) }
    }

    pub(crate) fn path(&self) -> &str {
        self.path.to_str().expect("a path that is text")
    }
}

impl Drop for TestFile {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}
