//! The command line that shows what is seen now.

use crate::length::length;
use crate::view::{Lens, LensKind, View};
use glam::DVec3;
use spherule_kernel::Vec3;

/// `spherule` with the scene called `scene`, whose zero is at `origin` in its file, and all that `view` needs.
pub(super) fn command_line(scene: &str, view: &View, origin: DVec3) -> String {
    let place = |point: Vec3| {
        // The digits of single precision, where they are the file's own.
        if origin == DVec3::ZERO {
            return format!("{},{},{}", point.x, point.y, point.z);
        }
        let DVec3 { x, y, z } = origin + point.as_dvec3();
        format!("{x},{y},{z}")
    };
    let (fov, projection) = match view.lens {
        Lens::Perspective { fov } => (fov, LensKind::Perspective),
        // The angle under which the eye sees the height of the picture at the target.
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
        place(view.eye),
        place(view.target)
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

    #[test]
    fn it_has_all_digits() {
        let view = View { eye: Vec3::new(0.1, -2.0, 1e-7), ..View::FRONT };
        assert_eq!(
            command_line("a b's.toml", &view, DVec3::ZERO),
            r"spherule 'a b'\''s.toml' --eye 0.1,-2,0.0000001 --target 0,0,0 --fov 40 --projection perspective"
        );
        let parallel = View { lens: Lens::Parallel { height: 10.0 }, ..View::FRONT };
        assert!(
            command_line("unit", &parallel, DVec3::ZERO)
                .ends_with(" --fov 90 --projection parallel")
        );
    }

    #[test]
    fn it_is_in_the_coordinates_of_the_file() {
        let view = View { eye: Vec3::new(0.5, -2.0, 1e-7), ..View::FRONT };
        let line = command_line("map", &view, DVec3::new(5e5, 5.4e6, 0.0));
        assert!(line.starts_with("spherule map --eye 500000.5,5399998,0.0000001"), "{line}");
        assert!(line.contains(" --target 500000,5400000,0 "), "{line}");
    }
}
