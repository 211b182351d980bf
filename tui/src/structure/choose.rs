//! Which structure is likely the fastest.
//!
//! # Method
//!
//! A model of the costs, in units of one test of brute force, a ray against a sphere: brute force
//! costs rays x spheres; an order costs a sort for every picture, by the sphere, and the tiles, by
//! the ray and, less and less, by both; a tree costs a build, by the sphere, and a walk, by the ray.
//! The walk grows by the logarithm of the number of spheres, which is left out: where that matters,
//! brute force is out of the question. What is cheapest is chosen.

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

/// Tests that a sphere in a tree is worth: its part of the build.
const BUILD: f64 = 1500.0;
/// Tests that a walk of a tree is worth, to a coherent ray and to another one.
const WALK: [f64; 2] = [40.0, 200.0];
/// Tests that a sphere in an order is worth: its part of the sort.
const SORT: f64 = 100.0;
/// Tests that tiles are worth to a ray, and to a ray and a sphere.
const TILES: (f64, f64) = (35.0, 0.002);

/// More spheres than this to a ray, and the rays of a picture lie so far apart that what is between
/// them costs more than what they share.
const SPARSE: usize = 64;

/// What so many rays of one picture have in common against so many spheres.
#[must_use]
pub fn picture_kind(spheres: usize, rays: usize) -> RaysKind {
    if spheres / SPARSE > rays { RaysKind::Incoherent } else { RaysKind::Coherent }
}

/// The structure that costs the least for `workload` against so many spheres.
#[must_use]
pub fn choose(spheres: usize, workload: &Workload) -> Structure {
    let (rays, spheres) = (workload.rays as f64, spheres as f64);
    let coherent = workload.kind == RaysKind::Coherent;
    let brute = rays * spheres;
    let tree = rays * WALK[usize::from(!coherent)] + spheres * BUILD / workload.pictures;
    let tiles = rays * (TILES.0 + spheres * TILES.1) + spheres * SORT;
    let tiles = if coherent { tiles } else { f64::INFINITY };
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
            assert_eq!(chosen(1_000_000, 20, 1.0, kind), Structure::Brute);
            assert_eq!(chosen(1_000_000, 100, f64::INFINITY, kind), Structure::Bvh);
            assert_eq!(chosen(1_000_000, 1_000_000, 1.0, kind), Structure::Bvh);
        }
    }

    #[test]
    fn one_picture_is_not_worth_a_tree() {
        assert_eq!(chosen(1_000_000, 7680, 1.0, RaysKind::Coherent), Structure::Tiles);
        assert_eq!(chosen(1_000_000, 7680, 1.0, RaysKind::Incoherent), Structure::Bvh);
    }
}
