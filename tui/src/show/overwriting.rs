//! Pictures and recordings in place of a scene: they are refused, since a scene is often all that there is of it.

use crate::arguments::PictureArguments;
use crate::choice::name;
use crate::error::Error;
use crate::scene::format::replaced::format_of;
use crate::whole_file::check_outputs;
use std::path::Path;

/// Refuses `--png` and `--cast` to a file that is a scene, whether it is the one that is shown, which `is_file` or not.
///
/// # Errors
/// [`Error::Input`], which names the file.
pub(super) fn refuse(arguments: &PictureArguments, is_file: bool) -> Result<(), Error> {
    let PictureArguments { png, cast, scene, .. } = arguments;
    let topology = scene.file.reading.topology.as_ref().map(|file| ("--topology", file.path()));
    let inputs = [is_file.then(|| ("the scene", scene.name.path())), topology];
    // Standard input has no place.
    let inputs: Vec<(&str, &Path)> =
        inputs.into_iter().flatten().filter(|(_, file)| *file != Path::new("-")).collect();
    for (option, file) in [("--png", png), ("--cast", cast)] {
        let Some(file) = file.as_deref().filter(|file| *file != Path::new("-")) else { continue };
        check_outputs(&[(option, file)], &inputs)?;
        if let Some(format) = format_of(file) {
            let what = format!("it is a scene ({}); name another file", name(&format));
            return Err(Error::Input(format!("{option} {}: {what}", file.display())));
        }
    }
    Ok(())
}
