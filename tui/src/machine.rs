//! What figures were measured on.

use std::fs;

/// The compiler that built the program.
pub const RUSTC: &str = env!("SPHERULE_RUSTC");

/// The name of the CPU; `unknown` if the system does not tell.
#[must_use]
pub fn cpu() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    model_name(&text).unwrap_or("unknown").to_owned()
}

/// From the text of `/proc/cpuinfo`.
fn model_name(text: &str) -> Option<&str> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    let (_, name) = line.split_once(':')?;
    Some(name.trim()).filter(|name| !name.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_is_found_or_not() {
        let text = "processor\t: 0\nmodel name\t: Intel(R) Xeon(R) @ 2.90GHz\nflags\t: fpu\n";
        assert_eq!(model_name(text), Some("Intel(R) Xeon(R) @ 2.90GHz"));
        assert_eq!(model_name("model name\t:\n"), None);
        assert_eq!(model_name("Processor: ARM\n"), None);
        assert!(RUSTC.starts_with("rustc ") || RUSTC == "unknown");
    }
}
