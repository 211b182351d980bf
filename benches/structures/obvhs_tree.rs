//! The compressed wide tree of `obvhs`: eight children a node, their boxes in bytes.

use obvhs::aabb::Aabb;
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh};
use obvhs::ray::{Ray as TreeRay, RayHit};
use obvhs::{Boundable, BvhBuildParams};
use spherule_benches::structures::peer::{Line, Peer, corners};
use spherule_kernel::{Hit, Ray, Sphere, Spheres, Vec3};
use std::time::Duration;

pub(crate) struct Obvhs {
    tree: CwBvh,
    /// In the order of the tree, so that no index is looked up on the way.
    spheres: Vec<Sphere>,
}

struct Boxed(Sphere);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        let [low, high] = corners(&self.0);
        Aabb::new(low.into(), high.into())
    }
}

impl Peer for Obvhs {
    const NAME: &'static str = "obvhs, cwbvh";
    type Ray = (Line, TreeRay);

    fn build(spheres: Spheres<'_>) -> Self {
        let list: Vec<_> = spheres.iter().map(Boxed).collect();
        let params = BvhBuildParams::medium_build();
        let mut time_of_core = Duration::ZERO;
        let tree = build_cwbvh(&list, params, &mut time_of_core);
        let spheres = tree.primitive_indices.iter().map(|&index| list[index as usize].0).collect();
        Self { tree, spheres }
    }

    fn ray(ray: &Ray) -> Self::Ray {
        let [origin, direction] = [ray.origin, ray.direction].map(Vec3::to_vec3a);
        (Line::new(ray), TreeRay::new(origin, direction, ray.t_min, ray.t_max))
    }

    fn nearest(&self, (line, ray): &Self::Ray) -> Option<Hit> {
        let mut hit = RayHit::none();
        let found = self.tree.ray_traverse(*ray, &mut hit, |_, place| {
            let Sphere { center, radius } = self.spheres[place];
            line.first_root(center, radius)
        });
        let sphere = || self.tree.primitive_indices[hit.primitive_id as usize];
        found.then(|| Hit { t: hit.t, sphere: sphere() })
    }

    fn any(&self, (line, ray): &Self::Ray) -> bool {
        !self.tree.ray_traverse_miss(*ray, |_, place| {
            let Sphere { center, radius } = self.spheres[place];
            line.first_root(center, radius)
        })
    }
}
