//! The binary tree of `bvh`.
//!
//! The search does not use the best hit so far. For the closest hit, boxes come in the order in which the ray enters
//! them, and the search ends at the first box entered behind a hit. For any hit, boxes come in the tree's order, which
//! is faster.

use super::one_by_one::{PreparedRay, corners, engine};
use crate::engine::Engine;
use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::ray::Ray as TreeRay;
use nalgebra::{Point3, Vector3};
use spherule_kernel::{Hit, Ray, Sphere, Spheres};

struct Boxed {
    sphere: Sphere,
    index: u32,
    node: usize,
}

impl Bounded<f32, 3> for Boxed {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [low, high] = corners(&self.sphere).map(|corner| Point3::from(corner.to_array()));
        Aabb::with_bounds(low, high)
    }
}

impl BHShape<f32, 3> for Boxed {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

pub(crate) fn build(spheres: Spheres<'_>) -> Engine {
    let boxed = |(index, sphere)| Boxed { sphere, index, node: 0 };
    let mut boxed: Vec<_> = (0..).zip(spheres.iter()).map(boxed).collect();
    let tree: Bvh<f32, 3> = Bvh::build(&mut boxed);
    // The tree makes directions unit length; the last is what they had.
    let prepare = |ray: &Ray| {
        let origin = Point3::from(ray.origin.to_array());
        let direction = Vector3::from(ray.direction.to_array());
        (PreparedRay::new(ray), TreeRay::new(origin, direction), ray.direction.length())
    };
    engine(
        "bvh",
        (tree, boxed),
        prepare,
        |(tree, boxed), (prepared, ray, length)| {
            let mut best = Hit { t: f32::INFINITY, sphere: 0 };
            for boxed in tree.nearest_traverse_iterator(ray, boxed) {
                let entered = ray.intersection_slice_for_aabb(&boxed.aabb());
                if entered.is_some_and(|(entered, _)| entered > best.t * length) {
                    break;
                }
                let t = prepared.first_root(&boxed.sphere);
                if t < best.t {
                    best = Hit { t, sphere: boxed.index };
                }
            }
            (best.t < f32::INFINITY).then_some(best)
        },
        |(tree, boxed), (prepared, ray, _)| {
            let met = |boxed: &Boxed| prepared.first_root(&boxed.sphere) < f32::INFINITY;
            tree.traverse_iterator(ray, boxed).any(met)
        },
    )
}
