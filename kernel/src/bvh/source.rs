//! Where spheres lie until a tier tests them.

use crate::geometry::sphere::{Sphere, Spheres};
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::{LaneArray, Lanes};
use crate::numeric::axes::axes;
use crate::scale::scene::SceneScale;

/// Where spheres lie until a tier tests them: by place in a structure, each as it was given, with its index.
pub(crate) trait SphereSource {
    /// The list that the structure is made of.
    fn spheres(&self) -> Spheres<'_>;
    /// Whether spheres have boxes along the axes of what the rays are in.
    fn is_tree(&self) -> bool;
    /// The sphere at a place, and its index.
    fn sphere_at(&self, place: u32) -> Option<(Sphere, u32)>;
}

/// Some spheres of a list, by rising index.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SomeSpheres<'a> {
    pub(crate) spheres: Spheres<'a>,
    pub(crate) which: Which<'a>,
}

/// Which spheres of a list.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Which<'a> {
    /// Those that bounds see at this scale; the places of others are empty.
    Inside(SceneScale),
    /// Those with these indices.
    Indices(&'a [u32]),
    /// Those with these indices, as bits.
    IndexBits(&'a [f32]),
}

impl SphereRun for SomeSpheres<'_> {
    #[inline(always)]
    fn list(&self) -> Spheres<'_> {
        self.spheres
    }

    #[inline(always)]
    fn count(&self) -> usize {
        match self.which {
            Which::Inside(_) => self.spheres.len(),
            Which::Indices(indices) => indices.len(),
            Which::IndexBits(indices) => indices.len(),
        }
    }

    #[inline(always)]
    fn index(&self, number: usize) -> u32 {
        let index = match self.which {
            Which::Inside(scale) => match self.spheres.get(number) {
                Some(sphere) if scale.scaled(&sphere).is_some() => Some(number as u32),
                _ => None,
            },
            Which::Indices(indices) => indices.get(number).copied(),
            Which::IndexBits(indices) => indices.get(number).copied().map(f32::to_bits),
        };
        index.unwrap_or(u32::MAX)
    }
}

/// One sphere a lane.
pub(crate) struct SphereLanes<L: Lanes> {
    pub(crate) center: [L; 3],
    pub(crate) radius: L,
    /// The index, as bits.
    pub(crate) index: L,
}

impl<L: Lanes> SphereLanes<L> {
    /// The spheres whose places are the bits of `places`, or the `shared` one.
    #[inline(always)]
    pub(crate) fn gather(source: &impl SphereSource, places: L, shared: Option<u32>) -> Self {
        let token = places.token();
        if let Some(place) = shared
            && let Some((sphere, index)) = source.sphere_at(place)
        {
            return Self {
                center: axes!(i => L::splat(token, sphere.center[i])),
                radius: L::splat(token, sphere.radius),
                index: L::splat(token, f32::from_bits(index)),
            };
        }

        let places = places.store();
        let none = L::Array::filled(0.0);
        let (mut center, mut radius, mut index) = ([none; 3], none, none);
        for lane in 0..L::COUNT {
            let place = places.get(lane).to_bits();
            let Some((sphere, number)) = source.sphere_at(place) else { continue };
            for axis in 0..3 {
                center[axis].set(lane, sphere.center[axis]);
            }
            radius.set(lane, sphere.radius);
            index.set(lane, f32::from_bits(number));
        }
        Self {
            center: axes!(i => L::load(token, &center[i])),
            radius: L::load(token, &radius),
            index: L::load(token, &index),
        }
    }
}
