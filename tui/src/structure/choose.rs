//! Which structure is likely the fastest.
//!
//! # Method
//!
//! A model of the costs, in units of one test of brute force, a coherent ray against a sphere: 0.12 ns by the AVX-512
//! level of a Zen 5, 0.2 by AVX2, 0.67 by the baseline, where `tui/examples/crossover.rs` timed clouds of 1 to 2^20
//! spheres that fill a seventh of a cube, one thread, `Exact`. The model's cheapest structure is chosen: at each
//! of the levels it takes at most 1.2 times as long as the best. Nanoseconds a ray, of 65,536, by AVX-512:
//!
//! | rays | spheres | brute | depth list | bvh |
//! |---|--:|--:|--:|--:|
//! | a camera's, which it makes | 16 | 6.1 | 12 | 6.9 |
//! | | 32 | 8.3 | 13 | 7.9 |
//! | | 64 | 12 | 13 | 8.8 |
//! | | 512 | 64 | 19 | 17 |
//! | | 16,384 | | 37 | 33 |
//! | | 131,072 | | 129 | 70 |
//! | others, as streams | 4 | 14 | | 16 |
//! | | 8 | 21 | | 15 |
//! | | 128 | 110 | | 45 |
//! | | 1,048,576 | | | 780 |
//!
//! To sort a sphere by depth took 24 to 110 ns, to build it into a tree 130 to 230 ns. So a tree is for
//! many pictures, or for many rays; for a scene that is drawn once a depth list takes less time, unless
//! there are so many spheres to a ray that what is between the rays costs more than what they share.
//! What the model does not know: from very far away a depth list is four times slower than this, since its margins grow
//! with the distance; among spheres that overlap tenfold it is four times faster than a tree.

use super::Structure;
use spherule_kernel::Coherence;

/// The rays to be traced, before the spheres change.
#[derive(Clone, Copy, Debug)]
pub struct Workload {
    /// Rays a picture.
    pub rays: usize,
    /// Pictures: infinitely many in the viewer.
    pub pictures: f64,
    /// Whether rays that follow each other lie close together.
    pub coherent: bool,
}

impl Workload {
    /// `pictures` of so many camera rays each, against so many spheres.
    #[must_use]
    pub fn of_pictures(pictures: f64, rays: usize, spheres: usize) -> Self {
        Self { rays, pictures, coherent: spheres / SPARSE <= rays }
    }

    /// As the kernel is told.
    #[must_use]
    pub fn coherence(&self) -> Coherence {
        if self.coherent { Coherence::Coherent } else { Coherence::Detect }
    }
}

/// More spheres than this to a ray, and the rays of a picture lie so far apart that what is between
/// them costs more than what they share: a million spheres in 160 x 48 rays took packets about twice
/// as long as single rays.
const SPARSE: usize = 64;
/// The cost of building a sphere into a tree.
const BUILD: f64 = 2000.0;
/// The cost of sorting a sphere by depth.
const SORT: f64 = 300.0;

/// The cost of a ray by brute force: incoherent rays meet more candidates.
fn brute(spheres: f64, coherent: bool) -> f64 {
    spheres + if coherent { 25.0 } else { 60.0 * spheres.sqrt() }
}

/// The cost of a coherent ray in a depth list: that in a tree, and the way to the spheres.
fn depth_list(spheres: f64) -> f64 {
    20.0 + tree(spheres, true) + 0.0045 * spheres
}

/// The cost of a ray in a tree; of up to 64 spheres an incoherent ray tests all.
fn tree(spheres: f64, coherent: bool) -> f64 {
    if coherent {
        50.0_f64.max(20.0 + 5.5 * spheres.powf(0.38))
    } else if spheres <= 64.0 {
        120.0 + 2.0 * spheres
    } else {
        79.0 * spheres.powf(0.316)
    }
}

/// The structure that costs the least for `workload` against so many spheres.
#[must_use]
pub fn choose(spheres: usize, workload: &Workload) -> Structure {
    let Workload { rays, pictures, coherent } = *workload;
    let (rays, spheres) = (rays as f64, spheres as f64);
    let brute = rays * brute(spheres, coherent);
    let tree = rays * tree(spheres, coherent) + spheres * BUILD / pictures;
    let depth_list =
        if coherent { rays * depth_list(spheres) + spheres * SORT } else { f64::INFINITY };
    if brute <= tree.min(depth_list) {
        Structure::Brute
    } else if depth_list < tree {
        Structure::DepthList
    } else {
        Structure::Bvh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(spheres: usize, rays: usize, pictures: f64, coherent: bool) -> Structure {
        choose(spheres, &Workload { rays, pictures, coherent })
    }

    #[test]
    fn few_spheres_and_few_rays_need_nothing_built() {
        for coherent in [true, false] {
            assert_eq!(chosen(0, 0, 1.0, coherent), Structure::Brute);
            assert_eq!(chosen(1, usize::MAX, f64::INFINITY, coherent), Structure::Brute);
            assert_eq!(chosen(1_000_000, 100, 1.0, coherent), Structure::Brute);
            assert_eq!(chosen(1_000_000, 100, f64::INFINITY, coherent), Structure::Bvh);
            assert_eq!(chosen(1_000_000, 1_000_000, 1.0, coherent), Structure::Bvh);
        }
    }

    #[test]
    fn one_picture_is_not_worth_a_tree() {
        assert_eq!(chosen(100_000, 7680, 1.0, true), Structure::DepthList);
        assert_eq!(chosen(100_000, 7680, f64::INFINITY, true), Structure::Bvh);
        assert_eq!(chosen(100_000, 7680, 1.0, false), Structure::Bvh);
    }

    #[test]
    fn pictures_with_few_rays_are_incoherent() {
        assert!(Workload::of_pictures(1.0, 7680, 100_000).coherent);
        assert!(!Workload::of_pictures(1.0, 7680, 1_000_000).coherent);
    }
}
