//! What the machine is, and whether it computes as `exact` needs.

use crate::error::Error;
use spherule_kernel::{Tier, float_environment_is_sound};
use std::fs;

/// The compiler that built the program.
pub const RUSTC: &str = env!("SPHERULE_RUSTC");

/// The name of the CPU; `unknown` if the system does not tell.
#[must_use]
pub fn cpu() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    model_name(&text).unwrap_or("unknown").to_owned()
}

/// Refuses `exact` where floats do not behave as it needs.
///
/// # Errors
/// [`Error::Running`] if this process rounds in another way, or takes subnormals for zero.
pub fn check_floats(tier: Tier) -> Result<(), Error> {
    check(tier, float_environment_is_sound())
}

fn check(tier: Tier, is_sound: bool) -> Result<(), Error> {
    if tier != Tier::Exact || is_sound {
        return Ok(());
    }
    let why =
        "this process does not round to nearest, or takes subnormals for zero: exact would not be";
    Err(Error::Running(format!("{why}; --accuracy stable needs neither")))
}

/// The name of the CPU in the text of `/proc/cpuinfo`.
fn model_name(text: &str) -> Option<&str> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    let (_, name) = line.split_once(':')?;
    Some(name.trim()).filter(|name| !name.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_is_refused_where_floats_are_not_sound() {
        assert_eq!(check(Tier::Exact, true), Ok(()));
        assert_eq!(check(Tier::Stable, false), Ok(()));
        assert!(
            matches!(check(Tier::Exact, false), Err(Error::Running(line)) if line.contains("subnormals"))
        );
        assert_eq!(check_floats(Tier::Exact), Ok(()));
    }

    #[test]
    fn the_name_is_found_or_not() {
        let text = "processor\t: 0\nmodel name\t: Intel(R) Xeon(R) @ 2.90GHz\nflags\t: fpu\n";
        assert_eq!(model_name(text), Some("Intel(R) Xeon(R) @ 2.90GHz"));
        assert_eq!(model_name("model name\t:\n"), None);
        assert_eq!(model_name("Processor: ARM\n"), None);
        assert!(RUSTC.starts_with("rustc ") || RUSTC == "unknown");
    }
}
