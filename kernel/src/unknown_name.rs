//! A name that is none of a tier or a level.

use core::fmt;

/// No [`Tier`](crate::Tier), or no [`LevelName`](crate::LevelName), has this name.
///
/// ```
/// use spherule_kernel::LevelName;
///
/// let error = "avx".parse::<LevelName>().expect_err("no level");
/// assert_eq!(error.to_string(), "no level has this name; levels: baseline, avx2, avx512");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// What was to be named: a tier, a level.
    pub(crate) kind: &'static str,
    /// The names that there are.
    pub(crate) names: &'static [&'static str],
}

impl fmt::Display for UnknownName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, names } = self;
        write!(formatter, "no {kind} has this name; {kind}s: ")?;
        for (number, name) in names.iter().enumerate() {
            let comma = if number == 0 { "" } else { ", " };
            write!(formatter, "{comma}{name}")?;
        }
        Ok(())
    }
}

impl core::error::Error for UnknownName {}

#[cfg(all(test, proofs))]
mod tests {
    use crate::{LevelName, Tier};
    use std::format;
    use std::string::ToString;

    #[test]
    fn an_error_lists_every_name() {
        let tiers = Tier::ALL.map(Tier::as_str).join(", ");
        let error = "Exact".parse::<Tier>().expect_err("no tier");
        assert_eq!(error.to_string(), format!("no tier has this name; tiers: {tiers}"));

        let levels = LevelName::ALL.map(LevelName::as_str).join(", ");
        let error = "avx".parse::<LevelName>().expect_err("no level");
        assert_eq!(error.to_string(), format!("no level has this name; levels: {levels}"));
    }
}
