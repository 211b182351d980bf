//! The pictures: drawn by the programs, scored.

use super::modes::{Mode, SIZE};
use spherule_tests::art::figures::{Figures, Truth};
use spherule_tests::art::palette::sixteen;
use spherule_tests::art::score;
use spherule_tests::binary::spherule;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs, io, process};

/// What a mode reaches of a scene.
pub(crate) struct Scores {
    pub(crate) ours: Figures,
    pub(crate) chafa: Option<Figures>,
    pub(crate) dithered: Option<Figures>,
}

/// Draws and scores.
pub(crate) fn scores(
    scene: &str,
    png: &Path,
    truth: &Truth,
    mode: &Mode,
    has_chafa: bool,
) -> Result<Scores, String> {
    let palette = sixteen(mode.palette).ok_or("no such palette")?;
    let figures = |picture: Vec<u8>| {
        let scored = score(&picture, truth, &palette, mode.font);
        scored.map_err(|error| format!("{} of {scene}: {error}", mode.name))
    };
    let chafas = |dither: &str| {
        let Some(options) = mode.chafa.filter(|_| has_chafa) else { return Ok(None) };
        let mut chafa = Command::new("chafa");
        chafa.args(["--format", "symbols", "--stretch", "--work", "9", "--size", SIZE]);
        chafa.args(["--dither", dither]).args(options.split_whitespace()).arg(png);
        figures(output(&mut chafa)?).map(Some)
    };
    let mut ours = Command::new(spherule());
    ours.args([scene, "--once", "--size", SIZE]).args(mode.ours.split_whitespace());
    Ok(Scores {
        ours: figures(output(&mut ours)?)?,
        chafa: chafas("none")?,
        dithered: mode.dither.map_or(Ok(None), chafas)?,
    })
}

/// The first line of what chafa says about itself, if it is there.
pub(crate) fn chafa_version() -> Option<String> {
    let said = output(Command::new("chafa").arg("--version")).ok()?;
    String::from_utf8_lossy(&said).lines().next().map(str::to_owned)
}

/// What a program prints.
pub(crate) fn output(command: &mut Command) -> Result<Vec<u8>, String> {
    // The options alone decide, not the terminal at hand.
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

/// A folder for pictures, as long as it is in use.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new() -> io::Result<Self> {
        let path = env::temp_dir().join(format!("spherule-art-{}", process::id()));
        fs::create_dir(&path)?;
        Ok(Self(path))
    }

    /// The scene in pixels.
    pub(crate) fn truth(&self, scene: &str) -> Result<PathBuf, String> {
        let path = self.0.join(format!("{scene}.png"));
        output(Command::new(spherule()).args([scene, "--size", SIZE, "--png"]).arg(&path))?;
        Ok(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
