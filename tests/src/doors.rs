//! Every door of the kernel: each tier in each lane width, as plain functions, so that a test
//! can say "all of them" in one loop.

use crate::case::Case;
use spherule_kernel::{
    Accuracy, Exact, Fast, Hit, HitPacket, Lanes, Ray, RayPacket, Sphere, SpherePacket, Spheres,
    Stable, any, f32x4, f32x8, f32x16, nearest, pairs, roots,
};

/// A tier in a lane width.
#[derive(Clone, Copy, Debug)]
pub struct Door {
    /// The tier's name.
    pub tier: &'static str,
    /// How many lanes.
    pub lanes: usize,
    /// The nearest hit of each ray, ray `i` in lane `i % lanes` of packet `i / lanes`.
    pub nearest: fn(&[Ray], &[Sphere]) -> Vec<Option<Hit>>,
    /// Whether each ray meets anything.
    pub any: fn(&[Ray], &[Sphere]) -> Vec<bool>,
    /// The t of each case on its own, a case a lane.
    pub pairs: fn(&[Case]) -> Vec<Option<f32>>,
    /// Both roots of the line; the same for every width.
    pub roots: fn(&Ray, &Sphere) -> Option<[f32; 2]>,
}

/// All of them; of each tier the one-lane form, which is the reference, first.
pub const DOORS: [Door; 12] = [
    door::<Fast, f32>(),
    door::<Fast, f32x4>(),
    door::<Fast, f32x8>(),
    door::<Fast, f32x16>(),
    door::<Stable, f32>(),
    door::<Stable, f32x4>(),
    door::<Stable, f32x8>(),
    door::<Stable, f32x16>(),
    door::<Exact, f32>(),
    door::<Exact, f32x4>(),
    door::<Exact, f32x8>(),
    door::<Exact, f32x16>(),
];

const fn door<A: Accuracy, L: Lanes<Token = ()>>() -> Door {
    Door {
        tier: A::NAME,
        lanes: L::COUNT,
        nearest: nearest_of::<A, L>,
        any: any_of::<A, L>,
        pairs: pairs_of::<A, L>,
        roots: roots::<A>,
    }
}

impl Door {
    /// The one-lane form of the same tier.
    ///
    /// # Panics
    /// Never: every tier has one.
    #[must_use]
    pub fn reference(&self) -> Self {
        let same = |door: &Self| door.tier == self.tier && door.lanes == 1;
        DOORS.into_iter().find(same).expect("one lane of every tier")
    }

    /// The one-lane form of every tier.
    pub fn references() -> impl Iterator<Item = Self> {
        DOORS.into_iter().filter(|door| door.lanes == 1)
    }

    /// The nearest hit of one ray, in the first lane, the others inactive.
    #[must_use]
    pub fn nearest_one(&self, ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
        (self.nearest)(&[*ray], spheres)[0]
    }
}

/// Spheres as the kernel borrows them.
#[derive(Clone, Debug)]
pub struct Columns([Vec<f32>; 4]);

impl Columns {
    /// Coordinate by coordinate.
    #[must_use]
    pub fn new(spheres: &[Sphere]) -> Self {
        let column = |get: fn(&Sphere) -> f32| spheres.iter().map(get).collect();
        Self([
            column(|s| s.center.x),
            column(|s| s.center.y),
            column(|s| s.center.z),
            column(|s| s.radius),
        ])
    }

    /// The list.
    ///
    /// # Panics
    /// Never: the columns are equally long.
    #[must_use]
    pub fn spheres(&self) -> Spheres<'_> {
        let [x, y, z, r] = &self.0;
        Spheres::new(x, y, z, r).expect("equal lengths")
    }
}

fn packets<L: Lanes>(rays: &[Ray]) -> Vec<RayPacket<L>> {
    rays.chunks(L::COUNT).map(RayPacket::<L>::new).collect()
}

fn nearest_of<A: Accuracy, L: Lanes<Token = ()>>(
    rays: &[Ray],
    spheres: &[Sphere],
) -> Vec<Option<Hit>> {
    let packets = packets::<L>(rays);
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    nearest::<A, L>((), &packets, Columns::new(spheres).spheres(), &mut hits);
    (0..rays.len()).map(|index| hits[index / L::COUNT].hit(index % L::COUNT)).collect()
}

fn any_of<A: Accuracy, L: Lanes<Token = ()>>(rays: &[Ray], spheres: &[Sphere]) -> Vec<bool> {
    let packets = packets::<L>(rays);
    // Stale bits must not show.
    let mut met = vec![u32::MAX; packets.len()];
    any::<A, L>((), &packets, Columns::new(spheres).spheres(), &mut met);
    (0..rays.len()).map(|index| met[index / L::COUNT] >> (index % L::COUNT) & 1 == 1).collect()
}

fn pairs_of<A: Accuracy, L: Lanes<Token = ()>>(cases: &[Case]) -> Vec<Option<f32>> {
    let packet = |cases: &[Case]| {
        let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
        let spheres: Vec<Sphere> = cases.iter().map(|case| case.sphere).collect();
        let hits =
            pairs::<A, L>((), &RayPacket::<L>::new(&rays), &SpherePacket::<L>::new(&spheres));
        let answer = |lane: usize| {
            let hit = hits.hit(lane)?;
            assert_eq!(hit.sphere as usize, lane, "a pair's sphere is its lane");
            Some(hit.t)
        };
        (0..cases.len()).map(answer).collect::<Vec<_>>()
    };
    cases.chunks(L::COUNT).flat_map(packet).collect()
}
