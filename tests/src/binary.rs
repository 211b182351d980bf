//! The program itself, in the profile of the test or example that asks for it.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::time::SystemTime;

/// The path of `spherule`. Builds it if it is older than its sources. Cargo names the binaries of
/// another package to no one, but it puts them two levels above a test or an example:
/// `target/PROFILE/deps/main-HASH`.
///
/// # Panics
/// If `spherule` cannot be built.
#[must_use]
pub fn spherule() -> PathBuf {
    static BINARY: OnceLock<PathBuf> = OnceLock::new();
    BINARY.get_or_init(find).clone()
}

fn find() -> PathBuf {
    let test = env::current_exe().expect("the test knows its own path");
    let profile_directory = test.parent().and_then(|deps| deps.parent()).expect("in target");
    let binary = profile_directory.join(format!("spherule{}", env::consts::EXE_SUFFIX));
    // `cargo test` of the workspace has built the program; `cargo test -p spherule-tests` builds no
    // other package's binary, and an old one is worse than none. Outside cargo nothing is built.
    let fresh = modified(&binary) > newest_source();
    if let Some(cargo) = env::var_os("CARGO").filter(|_| !fresh) {
        let target = profile_directory.parent().expect("in target");
        let profile = match profile_directory.file_name().and_then(|name| name.to_str()) {
            // Not `dev`: that would be another binary in the same place, built each time.
            Some("debug") | None => "test",
            Some(name) => name,
        };
        let built = Command::new(cargo)
            .args(["build", "--quiet", "--package", "spherule", "--bin", "spherule"])
            .args(["--profile", profile])
            .arg("--target-dir")
            .arg(target)
            .status()
            .expect("cargo runs");
        assert!(built.success(), "spherule does not build");
    }
    assert!(binary.is_file(), "{} is not built", binary.display());
    binary
}

fn modified(path: &Path) -> SystemTime {
    path.metadata().and_then(|data| data.modified()).unwrap_or(SystemTime::UNIX_EPOCH)
}

/// When a source of the binary was last changed.
fn newest_source() -> SystemTime {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut pending = vec![
        workspace.join("Cargo.toml"),
        workspace.join("Cargo.lock"),
        workspace.join("kernel"),
        workspace.join("tui"),
    ];
    let mut newest = SystemTime::UNIX_EPOCH;
    while let Some(path) = pending.pop() {
        match path.read_dir() {
            Ok(entries) => pending.extend(entries.flatten().map(|entry| entry.path())),
            Err(_) => newest = newest.max(modified(&path)),
        }
    }
    newest
}
