//! What a file is called on the command line: bytes, which need not be text.

use std::ffi::{OsStr, OsString};
use std::fmt;
use std::ops::Deref;
use std::path::Path;

/// A name that opens a file. Everywhere else it is the text that people see: bytes that are no UTF-8 are replaced.
#[derive(Clone, Debug)]
pub struct FileName {
    name: OsString,
    shown: String,
}

impl FileName {
    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        Path::new(&self.name)
    }
}

impl From<OsString> for FileName {
    fn from(name: OsString) -> Self {
        let shown = name.to_string_lossy().into_owned();
        Self { name, shown }
    }
}

impl AsRef<OsStr> for FileName {
    fn as_ref(&self) -> &OsStr {
        &self.name
    }
}

impl Deref for FileName {
    type Target = str;

    fn deref(&self) -> &str {
        &self.shown
    }
}

impl fmt::Display for FileName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.shown)
    }
}

impl PartialEq<&str> for FileName {
    fn eq(&self, other: &&str) -> bool {
        self.name == **other
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::ffi::OsStringExt;

    #[test]
    fn a_name_that_is_no_text_is_shown_as_near_as_can_be() {
        let name = FileName::from(OsString::from_vec(b"mol\xff.xyz".to_vec()));
        assert_eq!((&*name, name.to_string()), ("mol\u{fffd}.xyz", "mol\u{fffd}.xyz".to_owned()));
        assert_eq!(name.path().as_os_str().as_encoded_bytes(), b"mol\xff.xyz");
        assert_ne!(name, "mol\u{fffd}.xyz");
        let standard_input = FileName::from(OsString::from("-"));
        assert_eq!(standard_input, "-");
    }
}
