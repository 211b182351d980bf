//! The compressed wide tree of `obvhs`: eight children a node, their boxes in bytes.

use super::one_by_one::{PreparedRay, corners, engine};
use crate::engine::Engine;
use obvhs::aabb::Aabb;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::{Ray as TreeRay, RayHit};
use obvhs::{Boundable, BvhBuildParams};
use spherule_kernel::{Hit, Ray, Sphere, Spheres, Vec3};
use std::time::Duration;

struct Boxed(Sphere);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        let [low, high] = corners(&self.0);
        Aabb::new(low.into(), high.into())
    }
}

pub(crate) fn build(spheres: Spheres<'_>) -> Engine {
    let list: Vec<_> = spheres.iter().map(Boxed).collect();
    let mut time_of_core = Duration::ZERO;
    let tree = build_cwbvh(&list, BvhBuildParams::medium_build(), &mut time_of_core);
    // The spheres in the order of the tree, so that the search looks up no index.
    let in_order = tree.primitive_indices.iter().map(|&index| list[index as usize].0);
    let spheres: Vec<_> = in_order.collect();
    let prepare = |ray: &Ray| {
        let [origin, direction] = [ray.origin, ray.direction].map(Vec3::to_vec3a);
        (PreparedRay::new(ray), TreeRay::new(origin, direction, ray.t_min, ray.t_max))
    };
    engine(
        "obvhs, cwbvh",
        (tree, spheres),
        prepare,
        |(tree, spheres), (prepared, ray)| {
            let mut hit = RayHit::none();
            let root = |_: &TreeRay, place: usize| prepared.first_root(&spheres[place]);
            let found = tree.ray_traverse(*ray, &mut hit, root);
            let sphere = || tree.primitive_indices[hit.primitive_id as usize];
            found.then(|| Hit { t: hit.t, sphere: sphere() })
        },
        |(tree, spheres), (prepared, ray)| {
            let root = |_: &TreeRay, place: usize| prepared.first_root(&spheres[place]);
            !tree.ray_traverse_miss(*ray, root)
        },
    )
}
