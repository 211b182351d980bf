//! Rays and spheres two by two: the roots within what the tier promises, and the same t at every layer.

use crate::promise;
use spherule_kernel::{Ray, Tier, roots};
use spherule_referee::bytes::AimedScene;
use spherule_referee::case::Case;
use spherule_tests::oracle::accepted;
use spherule_tests::variants::{pair_layers, pairs_of};

/// Judges each ray with the sphere that it was aimed at.
///
/// # Panics
/// If an answer is wrong.
pub fn check(tier: Tier, AimedScene { rays, aims, spheres }: &AimedScene) {
    let case = |(&ray, &aim): (&Ray, &usize)| Case { ray, sphere: spheres[aim] };
    let cases: Vec<Case> = rays.iter().zip(aims).map(case).collect();
    let answer = |case: &Case| {
        let roots = roots(tier, &case.ray, &case.sphere);
        promise::judge(tier, &case.ray, &case.sphere, roots);
        roots.and_then(|roots| accepted(&case.ray, roots)).map(f32::to_bits)
    };
    let expected: Vec<_> = cases.iter().map(answer).collect();
    for layer in pair_layers() {
        let found: Vec<_> =
            pairs_of(tier, layer, &cases).into_iter().map(|t| t.map(f32::to_bits)).collect();
        assert_eq!(found, expected, "pairs: {tier:?}, {layer:?}: {cases:?}");
    }
}
