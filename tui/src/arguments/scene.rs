//! Which scene, how large its spheres are, and from where it is seen.

use super::files::{FileArguments, Subject};
use super::values::{field_of_view, orbit, point, samples};
use crate::choice::{Auto, size};
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::builtin::DEFAULT;
use crate::scene::file_name::FileName;
use crate::scene::radii::{RadiusBy, set_radii};
use crate::structure::Order;
use crate::view::{Lens, LensKind, View, orbited, with_projection};
use clap::Args;
use glam::DVec3;

/// A scene, and the rays of a picture of it.
#[derive(Args, Clone, Debug)]
pub struct SceneArguments {
    /// A built-in scene, a file, or - for standard input; --format lists the formats that are told by content
    #[arg(value_name = "SCENE", default_value = DEFAULT)]
    pub name: FileName,
    /// Size of a picture in cells, each 1 to 4096; the viewer does not open [default: 80x24; on a terminal all rows but the last]
    #[arg(long, value_name = "COLSxROWS", value_parser = size)]
    pub size: Option<(u16, u16)>,
    /// Rays a cell, 1 to 256; auto: more where they are needed
    #[arg(long, value_name = "N", default_value = "auto", value_parser = samples, allow_negative_numbers = true)]
    pub samples: Auto<u32>,
    /// The projection, whatever the scene says
    #[arg(long, value_name = "KIND")]
    pub projection: Option<LensKind>,
    /// Where the eye is, whatever the scene says
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    pub eye: Option<DVec3>,
    /// The point looked at, whatever the scene says
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    pub target: Option<DVec3>,
    /// The vertical field of view in degrees; in parallel projection, the angle at which the eye sees the height at the target
    #[arg(long, value_name = "DEGREES", value_parser = field_of_view, allow_negative_numbers = true)]
    pub fov: Option<f64>,
    /// Turn the eye around the target, after --eye and --target: degrees right, degrees up
    #[arg(long, value_name = "RIGHT,UP", value_parser = orbit, allow_hyphen_values = true)]
    pub orbit: Option<[f32; 2]>,
    /// Which loop is the outer one, over rays or spheres; object excludes --structure
    #[arg(long, value_name = "ORDER", default_value = "image")]
    pub order: Order,
    /// What is to know of a file.
    #[command(flatten)]
    pub file: FileArguments,
    /// How large spheres are: van-der-waals, covalent, a number, or a column of numbers [default: as the scene says]
    #[arg(long, value_name = "WHAT", allow_hyphen_values = true)]
    pub radius: Option<RadiusBy>,
}

impl SceneArguments {
    /// Opens the scene, and the file that it is from.
    ///
    /// # Errors
    /// [`Error::Input`] if there is no such scene, it cannot be read, or the eye is its target.
    pub fn open(&self) -> Result<Subject, Error> {
        let mut subject = self.file.open(&self.name)?;
        let set = self.set_radii(&mut subject.scene);
        set.and_then(|()| self.check_eye(&subject.scene))
            .map_err(|error| Error::Input(format!("{}: {error}", self.name)))?;
        let Subject { scene, frames, .. } = &mut subject;
        if let Some(frames) = frames
            && scene.spheres().iter().all(|sphere| sphere.radius == 0.0)
        {
            frames
                .note("every radius is 0, so no sphere is seen; --radius sets another".to_owned());
            frames.report();
        }
        Ok(subject)
    }

    /// Gives a scene the radii that are asked for.
    ///
    /// # Errors
    /// If it does not have them.
    pub fn set_radii(&self, scene: &mut Scene) -> Result<(), String> {
        self.radius.as_ref().map_or(Ok(()), |radius| set_radii(scene, radius))
    }

    /// Refuses an eye that is asked for where it looks.
    fn check_eye(&self, scene: &Scene) -> Result<(), String> {
        // The shape of the picture only moves an eye that no one has placed.
        let view = self.placed(scene, 1.0);
        if (self.eye.is_some() || self.target.is_some()) && view.eye == view.target {
            return Err("the camera's target is its eye; give another --eye or --target".to_owned());
        }
        Ok(())
    }

    /// The scene's first view, with eye and target where they are asked for.
    fn placed(&self, scene: &Scene, aspect: f64) -> View {
        let view = scene.first_view(aspect as f32);
        let place = |point: DVec3| (point - scene.origin).as_vec3();
        let eye = self.eye.map_or(view.eye, place);
        let target = self.target.map_or(view.target, place);
        View { eye, target, ..view }
    }

    /// Where the scene is first seen from, in a picture of `aspect`, width over height.
    #[must_use]
    pub fn view(&self, scene: &Scene, aspect: f64) -> View {
        let mut view = self.placed(scene, aspect);
        let kind = self.projection.unwrap_or(view.lens_kind());
        view.lens = self.fov.map_or(view.lens, |fov| Lens::Perspective { fov: fov as f32 });
        if let Some([right, up]) = self.orbit {
            view = orbited(&view, right.to_radians(), up.to_radians());
        }
        match self.fov {
            // As high as asked for: an angle of single precision would be another height.
            Some(fov) if kind == LensKind::Parallel => {
                View { lens: Lens::Parallel { height: view.height_under(fov) }, ..view }
            }
            _ => with_projection(&view, kind),
        }
    }
}
