//! Which structure is likely the fastest.
//!
//! # Method
//!
//! A model of the costs, in units of one test of brute force, a coherent ray against a sphere: 0.155
//! ns by the AVX-512 level of an EPYC (family 25, model 17), where `tui/examples/crossover.rs` timed
//! clouds of 1 to 2^20 spheres that fill a seventh of a cube, one thread, `Exact`. The model's cheapest
//! structure is chosen. Nanoseconds a ray, of 65,536, where structures take about as long:
//!
//! | rays | spheres | brute | depth list | bvh |
//! |---|--:|--:|--:|--:|
//! | a camera's | 16 | 6.7 | 8.1 | 8.1 |
//! | | 32 | 11 | 9.5 | 9.4 |
//! | | 512 | 83 | 13 | 13 |
//! | | 16,384 | | 55 | 38 |
//! | | 131,072 | | 195 | 73 |
//! | others | 4 | 16 | | 17 |
//! | | 8 | 27 | | 19 |
//! | | 128 | 131 | | 68 |
//!
//! To sort a sphere by depth took 17 to 70 ns, to build it into a tree 190 to 350 ns. So a tree is for
//! many pictures, or for many rays; for a scene that is drawn once a depth list takes less time, unless
//! there are so many spheres to a ray that what is between the rays costs more than what they share.
//! (From very far away a depth list is four times slower than this: its margins grow with the distance.
//! The model does not know.)

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
        if self.coherent { Coherence::Coherent } else { Coherence::Incoherent }
    }
}

/// More spheres than this to a ray, and the rays of a picture lie so far apart that what is between
/// them costs more than what they share: a million spheres in 160 x 48 rays took packets about twice
/// as long as single rays.
const SPARSE: usize = 64;
/// The cost of building a sphere into a tree.
const BUILD: f64 = 1600.0;
/// The cost of sorting a sphere by depth.
const SORT: f64 = 150.0;

/// The cost of a ray by brute force: incoherent rays meet more candidates.
fn brute(spheres: f64, coherent: bool) -> f64 {
    spheres + if coherent { 25.0 } else { 60.0 * spheres.sqrt() }
}

/// The cost of a coherent ray in a depth list: that in a tree, and the way to the spheres.
fn depth_list(spheres: f64) -> f64 {
    1.0 + tree(spheres, true) + 0.006 * spheres
}

/// The cost of a ray in a tree; of up to 64 spheres an incoherent ray tests all.
fn tree(spheres: f64, coherent: bool) -> f64 {
    if coherent {
        50.0_f64.max(20.0 + 5.5 * spheres.powf(0.38))
    } else if spheres <= 64.0 {
        120.0 + 2.0 * spheres
    } else {
        140.0 * spheres.powf(0.2375)
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
