//! `Exact` in every lane width, by its two ways: pairs, which meet no filter, and lists, which do.

use crate::case::Case;
use crate::doors::Columns;
use spherule_kernel::{
    Exact, Hit, HitPacket, Lanes, Ray, RayPacket, Sphere, SpherePacket, f32x4, f32x8, f32x16,
    nearest, pairs,
};

/// A lane width.
#[derive(Clone, Copy, Debug)]
pub struct Width {
    /// How many lanes.
    pub lanes: usize,
    /// The t of each case on its own, a case a lane, consecutive cases in a packet.
    pub pairs: fn(&[Case]) -> Vec<Option<f32>>,
    /// The nearest hit of each ray, consecutive rays in a packet.
    pub nearest: fn(&[Ray], &[Sphere]) -> Vec<Option<Hit>>,
}

/// All of them, one lane first.
pub const WIDTHS: [Width; 4] =
    [width::<f32>(), width::<f32x4>(), width::<f32x8>(), width::<f32x16>()];

const fn width<L: Lanes<Token = ()>>() -> Width {
    Width { lanes: L::COUNT, pairs: pairs_of::<L>, nearest: nearest_of::<L> }
}

fn pairs_of<L: Lanes<Token = ()>>(cases: &[Case]) -> Vec<Option<f32>> {
    let mut answers = Vec::with_capacity(cases.len());
    for cases in cases.chunks(L::COUNT) {
        let mut rays = RayPacket::<L>::inactive();
        let mut spheres = Vec::with_capacity(L::COUNT);
        for (lane, case) in cases.iter().enumerate() {
            rays.set(lane, &case.ray);
            spheres.push(case.sphere);
        }
        let hits = pairs::<Exact, L>((), &rays, &SpherePacket::<L>::new(&spheres));
        answers.extend((0..cases.len()).map(|lane| hits.hit(lane).map(|hit| hit.t)));
    }
    answers
}

fn nearest_of<L: Lanes<Token = ()>>(rays: &[Ray], spheres: &[Sphere]) -> Vec<Option<Hit>> {
    let packets: Vec<_> = rays.chunks(L::COUNT).map(RayPacket::<L>::new).collect();
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    nearest::<Exact, L>((), &packets, Columns::new(spheres).spheres(), &mut hits);
    (0..rays.len()).map(|index| hits[index / L::COUNT].hit(index % L::COUNT)).collect()
}
