//! Chafa's pictures of the same pixels.

use super::cache::Cache;
use super::image;
use super::modes::{Mode, SIZE};
use spherule_tests::art::light::Light;
use std::error::Error;
use std::fs;
use std::process::{Command, Stdio};

/// Chafa, if it is installed.
pub(crate) struct Chafa {
    /// The first line of its `--version`.
    pub(crate) version: String,
}

impl Chafa {
    pub(crate) fn find() -> Option<Self> {
        let said = output(Command::new("chafa").arg("--version")).ok()?;
        let version = String::from_utf8_lossy(&said).lines().next()?.to_owned();
        Some(Self { version })
    }

    /// Chafa's pictures of `truth`: without dither and, where colours are few, also with dither.
    pub(crate) fn pictures(
        &self,
        cache: &Cache,
        truth: &Light,
        mode: &Mode,
    ) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
        let (columns, rows) = SIZE;
        let size = format!("{columns}x{rows}");
        let colors = truth.colors();
        let picture = |dither: &str| -> Result<Vec<u8>, Box<dyn Error>> {
            let file = cache.file((&colors, &self.version, mode.chafa, dither, &size), "ans");
            if let Ok(known) = fs::read(&file) {
                return Ok(known);
            }
            let png = cache.file(&colors, "png");
            if !png.exists() {
                image::write_png(truth, &png)?;
            }
            let mut chafa = Command::new("chafa");
            chafa.args(["--format", "symbols", "--stretch", "--work", "9", "--size", &size]);
            chafa.args(["--dither", dither]).args(mode.chafa.split_whitespace()).arg(png);
            let bytes = output(&mut chafa)?;
            fs::write(file, &bytes)?;
            Ok(bytes)
        };
        ["none"].into_iter().chain(mode.dither).map(picture).collect()
    }
}

/// Returns what a program prints.
pub(crate) fn output(command: &mut Command) -> Result<Vec<u8>, String> {
    // The options alone decide, not the terminal that this runs in.
    for variable in ["NO_COLOR", "COLORTERM", "COLUMNS", "LINES"] {
        command.env_remove(variable);
    }
    command.env("TERM", "xterm-256color").stdin(Stdio::null());
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    if !output.status.success() {
        return Err(format!("{command:?}: {}", String::from_utf8_lossy(&output.stderr)));
    }
    Ok(output.stdout)
}
