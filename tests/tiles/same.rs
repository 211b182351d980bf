//! The comparison with brute force.

use super::ways::{WAYS, brute};
use spherule_kernel::{DepthOrder, Hit, Ray, Sphere, Viewpoint};
use spherule_tests::doors::Columns;

pub(crate) fn bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// The first ray for which a way of one of `tiers` does not answer as brute force does, with lists
/// as long as they can be, and with too short ones.
pub(crate) fn difference(
    tiers: &[&str],
    rays: &[Ray],
    spheres: &[Sphere],
    viewpoint: Viewpoint,
) -> Option<String> {
    let columns = Columns::new(spheres);
    let mut memory = vec![0xdead_beef; DepthOrder::needed(spheres.len())];
    let order = DepthOrder::new(columns.spheres(), viewpoint, &mut memory).expect("enough memory");
    let full = DepthOrder::lists(spheres.len());
    for tier in tiers {
        let door = brute(tier);
        let (expected, met) = ((door.nearest)(rays, spheres), (door.any)(rays, spheres));
        for way in WAYS.iter().filter(|way| way.tier == *tier) {
            for words in [full, full / 7] {
                let mut lists = vec![0xdead_beef; words];
                let (hits, found) = (way.go)(rays, &columns, &order, &mut lists);
                for (i, ray) in rays.iter().enumerate() {
                    if bits(hits[i]) != bits(expected[i]) || met[i] != found[i] {
                        return Some(format!(
                            "{tier}, {}, {words} words, ray {i} of {}, {} spheres, {viewpoint:?}: \
                             {:?} any {}, by brute force {:?} any {}; {ray:?}",
                            way.name,
                            rays.len(),
                            spheres.len(),
                            hits[i],
                            found[i],
                            expected[i],
                            met[i],
                        ));
                    }
                }
            }
        }
    }
    None
}

#[track_caller]
pub(crate) fn assert_same(tiers: &[&str], rays: &[Ray], spheres: &[Sphere], viewpoint: Viewpoint) {
    if let Some(difference) = difference(tiers, rays, spheres, viewpoint) {
        panic!("{difference}");
    }
}
