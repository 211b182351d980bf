//! Which structure is likely the fastest.
//!
//! # Method
//!
//! A model estimates the costs, in units of one test of brute force of a coherent ray against a sphere: 0.12 ns at the
//! AVX-512 level of a Zen 5, 0.2 at AVX2, 0.67 at the baseline. `tui/examples/crossover.rs` timed clouds of 1 to 2^20
//! spheres that fill a seventh of a cube, one thread, `Exact`. The model's cheapest structure is chosen; at each of the
//! levels it takes at most 1.1 times as long as the best. Nanoseconds a ray, of 65,536 rays, at AVX-512:
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
//! Sorting by depth took 31 ns a sphere for 1,024 to 16,384 spheres, 56 ns for 131,072 and 119 ns for 1,048,576;
//! building a tree took 135 to 210 ns a sphere. A list is sorted for the eye and for each light at infinity that casts
//! shadows, one after another. A tree serves all of them, and all threads build it. So a tree is for many pictures,
//! many rays or many spheres. A scene that is drawn once takes less time by depth lists, unless there are so many
//! spheres to a ray that the spheres between the rays cost more than the rays share.
//! The model does not know two cases. From very far away a depth list is four times slower than this, since its margins
//! grow with the distance. Among spheres that overlap tenfold it is four times faster than a tree.

use super::Structure;
use crate::scene::{Light, Source};
use spherule_kernel::Coherence;

/// The rays that are traced before the spheres change.
#[derive(Clone, Copy, Debug)]
pub struct Workload {
    /// Rays from the eye a picture; at most as many go to each light.
    pub rays: usize,
    /// How many pictures are drawn: infinitely many in the viewer.
    pub pictures: f64,
    /// How often the spheres move on; after each move as many pictures are drawn again. A tree is built once, and then
    /// refitted.
    pub moves: f64,
    /// Whether rays that follow each other lie close together.
    pub coherent: bool,
    /// Lights at infinity that cast shadows: a depth list each.
    pub distant_lights: usize,
    /// Lights at a place of the scene. A depth list is of no use to their rays, so brute force replaces it.
    pub near_lights: usize,
}

impl Workload {
    /// So many `pictures` of `rays` camera rays each, against so many `spheres`.
    #[must_use]
    pub fn of_pictures(pictures: f64, rays: usize, spheres: usize) -> Self {
        let coherent = spheres / SPARSE <= rays;
        Self { rays, pictures, moves: 0.0, coherent, distant_lights: 0, near_lights: 0 }
    }

    /// The same work for each frame of a trajectory, in which so many frames follow the first.
    #[must_use]
    pub fn with_moves(self, moves: f64) -> Self {
        Self { moves, ..self }
    }

    /// The same work, with rays to these lights.
    #[must_use]
    pub fn with_shadows(self, lights: &[Light]) -> Self {
        let is_near = |light: &&Light| matches!(light.source, Source::Position(_));
        let near_lights = lights.iter().filter(is_near).count();
        Self { distant_lights: lights.len() - near_lights, near_lights, ..self }
    }

    /// The coherence that the kernel is told.
    #[must_use]
    pub fn coherence(&self) -> Coherence {
        if self.coherent { Coherence::Coherent } else { Coherence::Detect }
    }
}

/// With more spheres than this to a ray, the rays of a picture lie so far apart that the spheres between them cost more
/// than the rays share: with a million spheres in 160 x 48 rays, packets took about twice as long as single rays.
const SPARSE: usize = 64;
/// The cost of refitting a sphere that has moved in a tree: one thread does it.
const REFIT: f64 = 300.0;
/// Threads beyond so many no longer shorten a build.
const BUILDERS: usize = 8;

/// What it costs to begin with a tree or a list, however few spheres there are: memory.
const BEGIN: f64 = 14_000.0;

/// The cost a sphere of building a tree over so many: it grows as fewer of them are in caches.
fn build(spheres: f64) -> f64 {
    900.0 + 0.45 * spheres.sqrt()
}

/// The cost a sphere of sorting so many by depth.
fn sort(spheres: f64) -> f64 {
    220.0 + 0.5 * spheres.sqrt()
}

/// The cost of a ray by brute force: incoherent rays meet more candidates.
fn brute(spheres: f64, coherent: bool) -> f64 {
    spheres + if coherent { 25.0 } else { 60.0 * spheres.sqrt() }
}

/// The cost of a coherent ray in a depth list: its cost in a tree, and that of reaching the spheres.
fn depth_list(spheres: f64) -> f64 {
    20.0 + tree(spheres, true) + 0.0045 * spheres
}

/// The cost of a ray in a tree. Up to 64 spheres, an incoherent ray tests all.
fn tree(spheres: f64, coherent: bool) -> f64 {
    if coherent {
        50.0_f64.max(20.0 + 5.5 * spheres.powf(0.38))
    } else if spheres <= 64.0 {
        120.0 + 2.0 * spheres
    } else {
        79.0 * spheres.powf(0.316)
    }
}

/// Returns the structure that costs the least for `workload` against so many spheres, with so many threads. `has_tree`
/// says whether a tree over them is built already.
#[must_use]
pub fn choose(spheres: usize, workload: &Workload, threads: usize, has_tree: bool) -> Structure {
    let Workload { rays, pictures, moves, coherent, distant_lights, near_lights } = *workload;
    let (rays, spheres) = (rays as f64, spheres as f64);
    let (distant, near) = (1.0 + distant_lights as f64, near_lights as f64);

    // All threads trace, so work that one thread does alone counts once for each.
    let alone = threads as f64;
    let building = if has_tree {
        0.0
    } else {
        let built = spheres * build(spheres) * alone / threads.min(BUILDERS) as f64;
        // Over endless moves the first build costs nothing.
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
