//! A file that has become shorter since it was read.

use super::Input;

impl Input {
    /// Whether the file is shorter than what has been read of it; of a compressed one that is not known.
    pub(in crate::scene) fn was_cut(&self) -> bool {
        let read = self.before + self.end as u64;
        let path = self.file.as_ref().filter(|_| self.size.is_some());
        path.and_then(|path| path.metadata().ok()).is_some_and(|metadata| metadata.len() < read)
    }
}
