//! What one ray of a picture meets, and how every tier found that: pure data, of scene, view and cell.

pub mod report;

use crate::scene::Scene;
use crate::structure::picture_search::PictureSearch;
use crate::structure::search::{Scratch, Tracing};
use crate::style::Style;
use crate::view::View;
use glam::DVec3;
use spherule_kernel::{
    ClosestHit, Hit, HitPacket, Level, Ray, RayPacket, Sphere, SphereList, Tier, discriminant,
    roots, stages,
};
use std::borrow::Cow;

/// The ray through the middle of a cell, and its hits.
#[derive(Clone, Debug, PartialEq)]
pub struct Pick<'a> {
    /// Its origin is the eye or, for parallel rays, in the plane through the eye; it goes through the middle of the
    /// cell.
    pub ray: Ray,
    /// The place, in the coordinates of the scene's file, of the zero of all positions here.
    pub origin: DVec3,
    /// The closest hit by every tier, in the order of [`Tier::ALL`].
    pub hits: [Option<Hit>; Tier::ALL.len()],
    /// The sphere that is hit; `None` if no tier hits any.
    pub sphere: Option<PickedSphere<'a>>,
}

/// The sphere that `Exact` hits. If `Exact` hits none, it is the sphere of the last tier that hits one.
#[derive(Clone, Debug, PartialEq)]
pub struct PickedSphere<'a> {
    /// Its place in the scene.
    pub index: u32,
    /// What the scene calls it.
    pub label: Option<Cow<'a, str>>,
    /// The sphere.
    pub sphere: Sphere,
    /// The roots of the line, entry and exit, by every tier, in the order of [`Tier::ALL`]; `None` for tiers that find
    /// none.
    pub roots: [Option<[f32; 2]>; Tier::ALL.len()],
    /// The discriminant in double precision, and a bound of its error.
    pub discriminant: (f64, f64),
    /// The stage that decided whether, and at which t, `Exact` hits it.
    pub decided_by: Stage,
}

/// How far `Exact` goes until it knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The miss filter.
    Filter,
    /// Double precision.
    Double,
    /// Exact sums.
    Expansions,
}

impl Stage {
    /// The name in reports.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Filter => "filter",
            Self::Double => "f64",
            Self::Expansions => "expansion",
        }
    }

    /// The stage that decides one ray and one sphere.
    fn of(ray: &Ray, sphere: &Sphere) -> Self {
        let alone = SphereList::from([*sphere]);
        let counted = stages(ClosestHit, &[RayPacket::new(&[*ray])], alone.spheres());
        match (counted.double, counted.expansions) {
            (0, _) => Self::Filter,
            (_, 0) => Self::Double,
            _ => Self::Expansions,
        }
    }
}

/// The ray through the middle of a cell, column and row from 0, of a picture of `columns` x `rows`. Returns `None` if
/// the picture has no such cell.
#[must_use]
pub fn cell_ray(
    view: &View,
    style: &Style,
    (columns, rows): (u16, u16),
    (column, row): (u16, u16),
) -> Option<Ray> {
    let inside = column < columns && row < rows;
    let aspect = style.picture_aspect(columns, rows);
    let camera = || view.camera(columns.into(), rows.into(), aspect);
    inside.then(|| camera().get_ray(column.into(), row.into()))
}

impl<'a> Pick<'a> {
    /// Traces `ray`, one of a picture, in `scene`, in the way of the rays of that picture.
    #[must_use]
    pub fn new(scene: &'a Scene, search: &PictureSearch<'_>, level: Level, ray: Ray) -> Self {
        let packet = [RayPacket::new(&[ray])];
        let mut scratch = Scratch::default();
        let hits = Tier::ALL.map(|tier| {
            let tracing = Tracing { tier, level, coherence: search.coherence };
            let mut hits = [HitPacket::none()];
            search.camera.closest_hits(tracing, &mut scratch, &packet, &mut hits);
            hits[0].hit(0)
        });
        let hit = hits.into_iter().rev().flatten().next();
        let sphere = hit.and_then(|hit| PickedSphere::new(scene, &ray, hit.sphere));
        Self { ray, origin: scene.origin, hits, sphere }
    }
}

impl<'a> PickedSphere<'a> {
    fn new(scene: &'a Scene, ray: &Ray, index: u32) -> Option<Self> {
        let sphere = scene.spheres().get(index as usize)?;
        Some(Self {
            index,
            label: scene.label(index as usize),
            sphere,
            roots: Tier::ALL.map(|tier| roots(tier, ray, &sphere)),
            discriminant: discriminant(ray, &sphere)?,
            decided_by: Stage::of(ray, &sphere),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Srgb;
    use crate::draw::brute_force;
    use crate::view::Lens;
    use spherule_kernel::Vec3;

    const VIEW: View =
        View { eye: Vec3::new(0.0, 0.0, 3.0), lens: Lens::Parallel { height: 4.0 }, ..View::FRONT };

    fn pick(scene: &Scene, ray: Ray) -> Pick<'_> {
        Pick::new(scene, &brute_force(scene, &VIEW), Level::best(), ray)
    }

    fn unit() -> Scene {
        let mut scene = Scene::new();
        scene.push(Sphere { center: Vec3::ZERO, radius: 1.0 }, Srgb([255; 3]), Some("one"));
        scene
    }

    /// Rows are one unit high, four of them, and columns half as wide.
    #[test]
    fn the_ray_goes_through_the_middle_of_the_cell() {
        let ray = |cell| cell_ray(&VIEW, &Style::PLAIN, (8, 4), cell);
        let at = |x, y| Some(Ray::new(Vec3::new(x, y, 3.0), Vec3::NEG_Z));
        assert_eq!(ray((0, 0)), at(-1.75, 1.5));
        assert_eq!(ray((7, 3)), at(1.75, -1.5));
        assert_eq!((ray((8, 0)), ray((0, 4)), ray((u16::MAX, u16::MAX))), (None, None, None));
    }

    /// The unit sphere is worked by hand in `tui/tests/program/pick.rs`.
    #[test]
    fn of_nothing_nothing_is_told() {
        let nothing = Scene::new();
        assert_eq!(pick(&nothing, Ray::new(VIEW.eye, Vec3::NEG_Z)).sphere, None);
    }

    /// A thousand radii away `Fast` sees a sphere where there is none; the filter knows better.
    #[test]
    fn a_sphere_that_fast_alone_hits_is_told_of() {
        let scene = unit();
        let miss = |i: u16| {
            let height = 1.0 + f32::from(i) / 4096.0;
            pick(&scene, Ray::new(Vec3::new(0.3, height, 9e3), Vec3::new(0.0, 0.0, -0.7)))
        };
        let pick = (0..400).map(miss).find(|pick| pick.hits[0].is_some()).expect("a false hit");
        let sphere = pick.sphere.expect("the sphere of the false hit");
        assert_eq!((pick.hits[3], sphere.roots[3]), (None, None));
        assert!(sphere.roots[0].is_some() && sphere.discriminant.0 < -sphere.discriminant.1);
    }
}
