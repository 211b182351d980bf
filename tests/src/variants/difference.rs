//! Where a variant does not answer as it should.

use super::answers::Answers;
use super::memory::{Memory, Structures, viewpoint_of};
use super::table::{Layer, Structure, Variant, brute, variants};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Viewpoint};
use spherule_referee::case::HexRay;
use spherule_referee::scene::Scene;

/// The bits of a hit: here -0 differs from 0, and a NaN equals itself.
#[must_use]
pub fn bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// Asserts that every variant that `is_asked` finds these closest hits, bit for bit, and any hit where there is one. The depth list is
/// sorted from the first ray's origin.
///
/// # Panics
/// If one does not.
#[track_caller]
pub fn assert_hits(
    expected: &[Option<Hit>],
    rays: &[Ray],
    spheres: &[Sphere],
    is_asked: &dyn Fn(&Variant) -> bool,
) {
    let ask = |structures: Structures<'_>| difference(expected, structures, rays, is_asked);
    if let Some(difference) = Memory::new(spheres).sorted(viewpoint_of(rays), ask) {
        let spheres = spheres.iter().take(100).copied().collect();
        let rays = rays.iter().take(100).copied().collect();
        panic!("{difference}{:?}", Scene { rays, spheres });
    }
}

/// Asserts that every tree and depth list of one of `tiers` answers, bit for bit, as brute force does. The depth list is sorted from the
/// first ray's origin.
///
/// In large scenes only variants with loops of their own are asked.
///
/// # Panics
/// If one does not.
#[track_caller]
pub fn assert_same(tiers: &[Tier], rays: &[Ray], spheres: &[Sphere]) {
    assert_same_from(viewpoint_of(rays), tiers, rays, spheres);
}

/// [`assert_same`] with a depth list sorted from `viewpoint`.
///
/// # Panics
/// If there is a difference.
#[track_caller]
pub fn assert_same_from(viewpoint: Viewpoint, tiers: &[Tier], rays: &[Ray], spheres: &[Sphere]) {
    let of_tier = |structures: Structures<'_>, tier: Tier| {
        let Answers { hits: expected, .. } = brute(tier).ask(structures, rays);
        let is_asked = |variant: &Variant| match variant.layer {
            _ if variant.tier != tier || variant.structure == Structure::List => false,
            // This structure is traversed by one lane only.
            Layer::Lanes(1) if variant.structure == Structure::Bvh4 => true,
            Layer::Ray | Layer::SliceAt(_) => rays.len() * spheres.len() < 20_000,
            // The same loops as the baseline's, in another width.
            Layer::Lanes(1) => tier == Tier::Exact,
            _ => true,
        };
        difference(&expected, structures, rays, &is_asked)
    };
    let difference = Memory::new(spheres)
        .sorted(viewpoint, |structures| tiers.iter().find_map(|&tier| of_tier(structures, tier)));
    if let Some(difference) = difference {
        panic!("{viewpoint:?}: {difference}");
    }
}

/// The first ray for which a variant that `is_asked` does not find what is expected.
fn difference(
    expected: &[Option<Hit>],
    structures: Structures<'_>,
    rays: &[Ray],
    is_asked: &dyn Fn(&Variant) -> bool,
) -> Option<String> {
    let count = structures.list.spheres().len();
    for variant in variants().filter(|variant| variant.holds(count) && is_asked(variant)) {
        let Answers { hits, occluded } = variant.ask(structures, rays);
        let counts = [hits.len(), occluded.len(), expected.len()];
        assert_eq!(counts, [rays.len(); 3], "{variant:?}");
        for (i, ray) in rays.iter().enumerate() {
            let (hit, occluded, expected) = (hits[i], occluded[i], expected[i]);
            if bits(hit) != bits(expected) || occluded != expected.is_some() {
                let rays = rays.len();
                return Some(format!(
                    "{variant:?}, ray {i} of {rays}, {count} spheres: {hit:?} any {occluded}, not {expected:?}; {}",
                    HexRay(ray)
                ));
            }
        }
    }
    None
}
