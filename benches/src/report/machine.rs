//! Where figures come from: CPU, compiler, flags, commit and date.

use std::process::Command;

/// The head of a report.
#[derive(Clone, Debug)]
pub struct Machine {
    /// The CPU's own name for itself, and how many of its threads this machine has.
    pub cpu: String,
    /// What `rustc --version` says.
    pub rustc: &'static str,
    /// The flags that choose instructions; empty in a plain build.
    pub flags: &'static str,
    /// The instructions that matter here and that the build may use anywhere.
    pub features: String,
    /// The commit that was built, and whether there were changes.
    pub commit: String,
    /// When, in UTC.
    pub date: String,
}

impl Machine {
    /// This one, now.
    #[must_use]
    pub fn this() -> Self {
        let features = [
            ("sse2", cfg!(target_feature = "sse2")),
            ("avx2", cfg!(target_feature = "avx2")),
            ("fma", cfg!(target_feature = "fma")),
            ("avx512f", cfg!(target_feature = "avx512f")),
            ("neon", cfg!(target_feature = "neon")),
        ];
        let features: Vec<_> = features.iter().filter(|(_, has)| *has).map(|(f, _)| *f).collect();
        Self {
            cpu: cpu(),
            rustc: env!("SPHERULE_RUSTC"),
            flags: env!("SPHERULE_TARGET_FLAGS"),
            features: features.join(", "),
            commit: output_of("git", &["describe", "--always", "--exclude=*", "--dirty=+changes"]),
            date: output_of("date", &["-u", "+%Y-%m-%d %H:%M UTC"]),
        }
    }

    /// A word for the build: the `target-cpu`, `plain` without flags.
    #[must_use]
    pub fn build(&self) -> String {
        let cpu = self.flags.split(' ').find_map(|flag| flag.strip_prefix("target-cpu="));
        let other = if self.flags.is_empty() { "plain" } else { "other" };
        cpu.unwrap_or(other).to_owned()
    }
}

fn cpu() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let values = |key: &str| -> Vec<_> {
        let lines = info.lines().filter_map(|line| line.split_once(':'));
        lines.filter(|(k, _)| k.trim() == key).map(|(_, value)| value.trim()).collect()
    };
    let models = values("model name");
    let Some(model) = models.first() else { return "unknown".to_owned() };
    // Cloud machines hide the model's name, not these two.
    let numbers =
        [values("cpu family"), values("model")].map(|v| v.first().copied().unwrap_or("?"));
    format!("{model} (family {}, model {}), {} threads", numbers[0], numbers[1], models.len())
}

/// The first line that a program prints, `unknown` where it cannot be asked.
fn output_of(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output().ok().filter(|o| o.status.success());
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    text.filter(|text| !text.is_empty()).unwrap_or_else(|| "unknown".to_owned())
}
