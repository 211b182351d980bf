//! Options that ask for what is not there outside the viewer: they are refused, not ignored.

use crate::arguments::PictureArguments;
use crate::error::Error;
use crate::terminal::Abilities;

/// Refuses `--frames` and `--legend` beside options whose output has neither.
///
/// # Errors
/// [`Error::Input`], which names both options.
pub(super) fn refuse(arguments: &PictureArguments) -> Result<(), Error> {
    let PictureArguments { png, pick, show, output, crowd, scene, .. } = arguments;
    let show = ("--show", show.is_some());
    let pixels = ("--output", output.protocol(&Abilities::default()).is_some());
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
    if crowd.legend
        && let Some(other) = first(&[show, pixels])
    {
        return Err(Error::Input(format!("--legend: there is none with {other}")));
    }
    Ok(())
}
