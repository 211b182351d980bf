//! Which structure is likely the fastest.
//!
//! # Method
//!
//! A model of the costs, in units of one test of brute force, a coherent ray against a sphere: 0.12 ns by the AVX-512
//! level of a Zen 5, 0.2 by AVX2, 0.67 by the baseline, where `tui/examples/crossover.rs` timed clouds of 1 to 2^20
//! spheres that fill a seventh of a cube, one thread, `Exact`. The model's cheapest structure is chosen: at each
//! of the levels it takes at most 1.1 times as long as the best. Nanoseconds a ray, of 65,536, by AVX-512:
//!
//! | rays | spheres | brute | depth list | bvh |
//! |---|--:|--:|--:|--:|
//! | a camera's, which it makes | 16 | 6.1 | 12 | 6.9 |
//! | | 32 | 8.3 | 13 | 7.9 |
//! | | 64 | 12 | 13 | 8.8 |
//! | | 512 | 64 | 19 | 17 |
//! | | 16,384 | | 37 | 33 |
//! | | 131,072 | | 129 | 70 |
//! | | 1,048,576 | | 920 | 190 |
//! | others, as streams | 4 | 14 | | 16 |
//! | | 8 | 21 | | 15 |
//! | | 128 | 110 | | 45 |
//! | | 1,048,576 | | | 780 |
//!
//! To sort a sphere by depth took 31 ns of 1,024 to 16,384, 56 ns of 131,072 and 119 ns of 1,048,576; to build it
//! into a tree 135 to 210 ns. A list is sorted for the eye and for each light at infinity that casts shadows, one after
//! another; a tree serves all, and all threads build it. So a tree is for many pictures, many rays or many
//! spheres; a scene that is drawn once takes less time by depth lists, unless there are so many spheres to a ray
//! that what is between the rays costs more than what they share.
//! What the model does not know: from very far away a depth list is four times slower than this, since its margins grow
//! with the distance; among spheres that overlap tenfold it is four times faster than a tree.

use super::Structure;
use crate::scene::{Light, Source};
use spherule_kernel::Coherence;

/// The rays to be traced, before the spheres change.
#[derive(Clone, Copy, Debug)]
pub struct Workload {
    /// Rays a picture from its eye, and as many at most to each light.
    pub rays: usize,
    /// Pictures: infinitely many in the viewer.
    pub pictures: f64,
    /// How often the same spheres move on, and are drawn so often again: a tree is built once, and then refitted.
    pub moves: f64,
    /// Whether rays that follow each other lie close together.
    pub coherent: bool,
    /// Lights at infinity that cast shadows: a depth list each.
    pub distant_lights: usize,
    /// Those at a place of the scene: a depth list is of no use to their rays, and brute force takes its place.
    pub near_lights: usize,
}

impl Workload {
    /// `pictures` of so many camera rays each, against so many spheres.
    #[must_use]
    pub fn of_pictures(pictures: f64, rays: usize, spheres: usize) -> Self {
        let coherent = spheres / SPARSE <= rays;
        Self { rays, pictures, moves: 0.0, coherent, distant_lights: 0, near_lights: 0 }
    }

    /// The same for each of the frames of a trajectory, of which so many follow.
    #[must_use]
    pub fn with_moves(self, moves: f64) -> Self {
        Self { moves, ..self }
    }

    /// The same with rays to these lights.
    #[must_use]
    pub fn with_shadows(self, lights: &[Light]) -> Self {
        let is_near = |light: &&Light| matches!(light.source, Source::Position(_));
        let near_lights = lights.iter().filter(is_near).count();
        Self { distant_lights: lights.len() - near_lights, near_lights, ..self }
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
/// The cost of refitting a sphere that has moved in a tree: one thread does it.
const REFIT: f64 = 300.0;
/// Threads beyond so many no longer shorten a build.
const BUILDERS: usize = 8;

/// What it costs to begin with a tree or a list, however few spheres there are: memory.
const BEGIN: f64 = 14_000.0;

/// The cost of building one of so many spheres into a tree, the less in caches the more.
fn build(spheres: f64) -> f64 {
    900.0 + 0.45 * spheres.sqrt()
}

/// The cost of sorting one of so many spheres by depth.
fn sort(spheres: f64) -> f64 {
    220.0 + 0.5 * spheres.sqrt()
}

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

/// The structure that costs the least for `workload` against so many spheres, with so many threads, if a tree
/// over them is there already or not.
#[must_use]
pub fn choose(spheres: usize, workload: &Workload, threads: usize, has_tree: bool) -> Structure {
    let Workload { rays, pictures, moves, coherent, distant_lights, near_lights } = *workload;
    let (rays, spheres) = (rays as f64, spheres as f64);
    let (distant, near) = (1.0 + distant_lights as f64, near_lights as f64);

    // All threads trace, so what one of them does alone counts as often.
    let alone = threads as f64;
    let building = if has_tree {
        0.0
    } else {
        let built = spheres * build(spheres) * alone / threads.min(BUILDERS) as f64;
        // Of moves without end the first build is none.
        let refits = spheres * REFIT * alone;
        BEGIN + refits + (built - refits) / (1.0 + moves)
    };
    let brute_force = brute(spheres, coherent);
    let brute = rays * brute_force * (distant + near);
    let tree = rays * tree(spheres, coherent) * (distant + near) + building / pictures;
    let depth_list = if coherent {
        let sorted = BEGIN + rays * depth_list(spheres) + spheres * sort(spheres) * alone;
        distant * sorted + near * rays * brute_force
    } else {
        f64::INFINITY
    };
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
        let workload = Workload::of_pictures(pictures, rays, spheres);
        choose(spheres, &Workload { coherent, ..workload }, 1, false)
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
    fn lights_that_cast_shadows_are_worth_a_tree() {
        let workload = Workload::of_pictures(1.0, 30_000, 20_000);
        assert!(workload.coherent);
        let lit = |distant_lights, near_lights| {
            choose(20_000, &Workload { distant_lights, near_lights, ..workload }, 1, false)
        };
        assert_eq!(lit(0, 0), Structure::DepthList);
        assert_eq!(lit(0, 1), Structure::Bvh);
        assert_eq!(lit(4, 0), Structure::Bvh);
    }

    #[test]
    fn a_tree_that_is_there_or_follows_its_spheres_is_worth_it() {
        let workload = Workload::of_pictures(1.0, 16_000, 200_000);
        let chosen = |moves, has_tree| choose(200_000, &workload.with_moves(moves), 1, has_tree);
        assert_eq!(chosen(0.0, false), Structure::DepthList);
        assert_eq!(chosen(0.0, true), Structure::Bvh);
        assert_eq!(chosen(100.0, false), Structure::Bvh);
        assert_eq!(chosen(f64::INFINITY, false), Structure::Bvh);
    }

    #[test]
    fn pictures_with_few_rays_are_incoherent() {
        assert!(Workload::of_pictures(1.0, 7680, 100_000).coherent);
        assert!(!Workload::of_pictures(1.0, 7680, 1_000_000).coherent);
    }
}
