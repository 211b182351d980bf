//! Which structure is likely the fastest.
//!
//! # Method
//!
//! A model of the costs, in units of one test of brute force, a coherent ray against a sphere: 0.155
//! ns by the AVX-512 level of an EPYC (family 25, model 17), where `tui/examples/crossover.rs` timed
//! clouds of 1 to 2^20 spheres that fill a seventh of a cube, one thread, `Exact`. What is cheapest
//! by the model is chosen. Against 65,536 rays, a ray, where structures take about as long:
//!
//! | rays | spheres | brute | tiles | bvh |
//! |---|--:|--:|--:|--:|
//! | a camera's | 16 | 6.7 ns | 8.1 ns | 8.1 ns |
//! | | 32 | 11 ns | 9.5 ns | 9.4 ns |
//! | | 512 | 83 ns | 13 ns | 13 ns |
//! | | 16,384 | | 55 ns | 38 ns |
//! | | 131,072 | | 195 ns | 73 ns |
//! | others | 4 | 16 ns | | 17 ns |
//! | | 8 | 27 ns | | 19 ns |
//! | | 128 | 131 ns | | 68 ns |
//!
//! To sort a sphere for tiles took 17 to 70 ns, to build it into a tree 190 to 350 ns. So a tree is
//! for many pictures, or for many rays: of a scene that is drawn once tiles take less, but where
//! there are so many spheres to a ray that what is between the rays costs more than what they share.
//! (Seen from very far away tiles are slower than this by four times: their margins grow with the
//! distance. The model does not know.)

use super::{RaysKind, Structure};

/// What is to be asked of the spheres, before there are others.
#[derive(Clone, Copy, Debug)]
pub struct Workload {
    /// Rays a picture.
    pub rays: usize,
    /// Pictures: infinitely many in the viewer.
    pub pictures: f64,
    /// What the rays have in common.
    pub kind: RaysKind,
}

/// What building a sphere into a tree costs.
const BUILD: f64 = 1600.0;
/// What sorting a sphere costs.
const SORT: f64 = 150.0;

/// What brute force costs a ray: where rays have nothing in common they meet more candidates.
fn brute(spheres: f64, kind: RaysKind) -> f64 {
    match kind {
        RaysKind::Coherent => 25.0 + spheres,
        RaysKind::Incoherent => 60.0 * spheres.sqrt() + spheres,
    }
}

/// What tiles cost a coherent ray: what a tree does, and the way to the lists.
fn tiles(spheres: f64) -> f64 {
    1.0 + walk(spheres, RaysKind::Coherent) + 0.006 * spheres
}

/// What the walk of a tree costs a ray; up to 64 spheres rays that have nothing in common look at all.
fn walk(spheres: f64, kind: RaysKind) -> f64 {
    match kind {
        RaysKind::Coherent => 50.0_f64.max(20.0 + 5.5 * spheres.powf(0.38)),
        RaysKind::Incoherent if spheres <= 64.0 => 120.0 + 2.0 * spheres,
        RaysKind::Incoherent => 140.0 * spheres.powf(0.2375),
    }
}

/// More spheres than this to a ray, and the rays of a picture lie so far apart that what is between
/// them costs more than what they share: a million spheres in 160 x 48 rays took bundles about twice
/// as long as single rays.
const SPARSE: usize = 64;

/// What so many rays of one picture have in common against so many spheres.
#[must_use]
pub fn picture_kind(spheres: usize, rays: usize) -> RaysKind {
    if spheres / SPARSE > rays { RaysKind::Incoherent } else { RaysKind::Coherent }
}

/// The structure that costs the least for `workload` against so many spheres.
#[must_use]
pub fn choose(spheres: usize, workload: &Workload) -> Structure {
    let Workload { rays, pictures, kind } = *workload;
    let (rays, spheres) = (rays as f64, spheres as f64);
    let brute = rays * brute(spheres, kind);
    let tree = rays * walk(spheres, kind) + spheres * BUILD / pictures;
    let tiles = match kind {
        RaysKind::Coherent => rays * tiles(spheres) + spheres * SORT,
        RaysKind::Incoherent => f64::INFINITY,
    };
    if brute <= tree.min(tiles) {
        Structure::Brute
    } else if tiles < tree {
        Structure::Tiles
    } else {
        Structure::Bvh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(spheres: usize, rays: usize, pictures: f64, kind: RaysKind) -> Structure {
        choose(spheres, &Workload { rays, pictures, kind })
    }

    #[test]
    fn few_spheres_and_few_rays_need_nothing_built() {
        use RaysKind::{Coherent, Incoherent};
        for kind in [Coherent, Incoherent] {
            assert_eq!(chosen(0, 0, 1.0, kind), Structure::Brute);
            assert_eq!(chosen(1, usize::MAX, f64::INFINITY, kind), Structure::Brute);
            assert_eq!(chosen(1_000_000, 100, 1.0, kind), Structure::Brute);
            assert_eq!(chosen(1_000_000, 100, f64::INFINITY, kind), Structure::Bvh);
            assert_eq!(chosen(1_000_000, 1_000_000, 1.0, kind), Structure::Bvh);
        }
    }

    #[test]
    fn one_picture_is_not_worth_a_tree() {
        assert_eq!(chosen(100_000, 7680, 1.0, RaysKind::Coherent), Structure::Tiles);
        assert_eq!(chosen(100_000, 7680, f64::INFINITY, RaysKind::Coherent), Structure::Bvh);
        assert_eq!(chosen(100_000, 7680, 1.0, RaysKind::Incoherent), Structure::Bvh);
    }
}
