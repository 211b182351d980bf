//! Options that ask for what is not there outside the viewer: they are refused, not ignored.

use super::written::protocol;
use crate::arguments::PictureArguments;
use crate::error::Error;
use crate::pixels::Output;

/// Refuses `--frames` and `--legend` beside options whose output has neither, and `--output` beside `--png`.
///
/// # Errors
/// [`Error::Input`], which names both options.
pub(super) fn refuse(arguments: &PictureArguments, is_terminal: bool) -> Result<(), Error> {
    let PictureArguments { png, pick, show, crowd, scene, .. } = arguments;
    let show = ("--show", show.is_some());
    let pixels = ("--output", protocol(arguments, is_terminal).is_some());
    let first = |options: &[(&'static str, bool)]| {
        options.iter().find(|(_, is_asked_for)| *is_asked_for).map(|(name, _)| *name)
    };
    if scene.file.frames.is_some()
        && let Some(other) =
            first(&[("--png", png.is_some()), ("--pick", pick.is_some()), show, pixels])
    {
        let what = format!("--frames writes pictures of cells; with {other} say --frame N");
        return Err(Error::Input(what));
    }
    // (`auto` is no wish for pixels.)
    if png.is_some() && pixels.1 && arguments.output != Output::Auto {
        return Err(Error::Input(
            "--png writes a file; without it --output writes pixels".to_owned(),
        ));
    }
    if crowd.legend && show.1 {
        let what = "--legend cannot be written with --show; the viewer takes both";
        return Err(Error::Input(what.to_owned()));
    }
    if crowd.legend && pixels.1 {
        return Err(Error::Input("--legend cannot be drawn in pixels (--output)".to_owned()));
    }
    Ok(())
}
