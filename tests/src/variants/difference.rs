//! Where a structure does not answer as brute force does.

use super::answers::Answers;
use super::memory::{Memory, Structures, viewpoint_of};
use super::table::{Layer, Structure, Variant, brute, variants};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Viewpoint};
use spherule_referee::case::HexRay;

/// The bits of a hit: here -0 differs from 0, and a NaN equals itself.
#[must_use]
pub fn bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// The first ray for which a tree or depth list of one of `tiers` does not answer, bit for bit, as brute force does.
///
/// In large scenes only variants with loops of their own are asked.
#[must_use]
pub fn difference(
    tiers: &[Tier],
    rays: &[Ray],
    spheres: &[Sphere],
    viewpoint: Viewpoint,
) -> Option<String> {
    let different = |structures: Structures<'_>, tier: Tier| {
        let Answers { hits: expected, .. } = brute(tier).ask(structures, rays);
        let asked = |variant: &Variant| match variant.layer {
            _ if variant.tier != tier || variant.structure == Structure::List => false,
            _ if !variant.holds(spheres.len()) => false,
            // This structure has loops of one lane only.
            Layer::Lanes(1) if variant.structure == Structure::Bvh4 => true,
            Layer::Ray | Layer::SliceAt(_) => rays.len() * spheres.len() < 20_000,
            // The same loops as the baseline's, in another width.
            Layer::Lanes(1) => tier == Tier::Exact,
            _ => true,
        };
        for variant in variants().filter(asked) {
            let Answers { hits, occluded } = variant.ask(structures, rays);
            for (i, ray) in rays.iter().enumerate() {
                if bits(hits[i]) != bits(expected[i]) || occluded[i] != expected[i].is_some() {
                    let (hit, occluded, expected) = (hits[i], occluded[i], expected[i]);
                    let (rays, spheres) = (rays.len(), spheres.len());
                    return Some(format!(
                        "{variant:?}, ray {i} of {rays}, {spheres} spheres, {viewpoint:?}: {hit:?} \
                         any {occluded}, by brute force {expected:?}; {}",
                        HexRay(ray)
                    ));
                }
            }
        }
        None
    };
    Memory::new(spheres)
        .sorted(viewpoint, |structures| tiers.iter().find_map(|&tier| different(structures, tier)))
}

/// [`difference`] as a panic, the depth list sorted from the first ray's origin.
///
/// # Panics
/// If there is a difference.
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
    if let Some(difference) = difference(tiers, rays, spheres, viewpoint) {
        panic!("{difference}");
    }
}
