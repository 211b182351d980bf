//! Exact sums are for what is asked.

use crate::proofs::work::{Kind, Work};
use crate::{Exact, Intersect, Ray, SphereList, SphereTree, Vec3};

/// Rays through the centres of five spheres, which they meet half-way between two floats.
fn rays() -> [Ray; 40] {
    core::array::from_fn(|number| Ray::new(Vec3::new((number % 5) as f32, 0.0, -1.2), Vec3::Z))
}

#[test]
fn any_hit_needs_no_rounded_root() {
    for count in [1, 4, 5] {
        let list: SphereList = (0..count).map(|x| (Vec3::X * x as f32, 0.4)).collect();
        let (tree, rays) = (SphereTree::new(&list), rays());
        let (mut hits, mut occluded) = ([None; 40], [false; 40]);
        let sums = |work: Work| work.count(Kind::ExactRoot);
        assert!(sums(Work::of(|| tree.closest_hits(Exact, &rays, &mut hits))) > 0, "ties");
        assert_eq!(sums(Work::of(|| tree.any_hits(Exact, &rays, &mut occluded))), 0, "{count}");
        assert_eq!(hits.map(|hit| hit.is_some()), occluded);
        assert_eq!(sums(Work::of(|| list.any_hits(Exact, &rays, &mut occluded))), 0, "a list");
        assert_eq!(hits.map(|hit| hit.is_some()), occluded);
    }
}

/// Where the interval ends between the numbers that a root may round to, it must be rounded.
#[test]
fn any_hit_is_true_exactly_if_there_is_a_closest_one() {
    let list: SphereList = (0..5).map(|x| (Vec3::X * x as f32, 0.4)).collect();
    let tree = SphereTree::new(&list);
    for root in [0.8_f32, 1.6] {
        let mut end = root.next_down().next_down().next_down();
        for _ in 0..7 {
            for (t_min, t_max) in [(0.0, end), (end, end), (end, f32::INFINITY)] {
                let rays = rays().map(|ray| Ray { t_min, t_max, ..ray });
                let (mut hits, mut occluded) = ([None; 40], [false; 40]);
                tree.closest_hits(Exact, &rays, &mut hits);
                tree.any_hits(Exact, &rays, &mut occluded);
                assert_eq!(hits.map(|hit| hit.is_some()), occluded, "{t_min} to {t_max}");
            }
            end = end.next_up();
        }
    }
}
