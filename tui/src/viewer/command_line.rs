//! The command line that shows what is seen now.

use crate::length::length;
use crate::view::{Lens, LensKind, View};

/// `spherule` with the scene called `scene` and all that `view` needs.
pub(super) fn command_line(scene: &str, view: &View) -> String {
    let vector = |vector: spherule_kernel::Vec3| format!("{},{},{}", vector.x, vector.y, vector.z);
    let (fov, projection) = match view.lens {
        Lens::Perspective { fov } => (fov, LensKind::Perspective),
        // From the eye the picture is as high at the target as by this angle.
        Lens::Parallel { height } => {
            let distance = f64::from(length(view.eye - view.target));
            let fov = 2.0 * (f64::from(height) / 2.0 / distance).atan().to_degrees();
            (fov as f32, LensKind::Parallel)
        }
    };
    let projection = crate::choice::name(&projection);
    format!(
        "spherule {} --eye {} --target {} --fov {fov} --projection {projection}",
        quoted(scene),
        vector(view.eye),
        vector(view.target)
    )
}

/// A word of a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;

    #[test]
    fn it_has_all_digits() {
        let view = View { eye: Vec3::new(0.1, -2.0, 1e-7), ..View::FRONT };
        assert_eq!(
            command_line("a b's.toml", &view),
            r"spherule 'a b'\''s.toml' --eye 0.1,-2,0.0000001 --target 0,0,0 --fov 40 --projection perspective"
        );
        let parallel = View { lens: Lens::Parallel { height: 10.0 }, ..View::FRONT };
        assert!(command_line("unit", &parallel).ends_with(" --fov 90 --projection parallel"));
    }
}
