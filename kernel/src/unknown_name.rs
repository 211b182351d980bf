//! A name that is none of a tier or a level.

use core::fmt;

/// No [`Tier`](crate::Tier), or no [`LevelName`](crate::LevelName), has this name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownName;

impl UnknownName {
    /// What was found, or this error.
    pub(crate) fn or<T>(found: Option<T>) -> Result<T, Self> {
        found.ok_or(Self)
    }
}

impl fmt::Display for UnknownName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("unknown name")
    }
}

impl core::error::Error for UnknownName {}
