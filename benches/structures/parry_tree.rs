//! The binary tree of `parry3d`, asked as its own composite shapes ask it.

use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhNode, TraversalAction};
use parry3d::query::Ray as TreeRay;
use spherule_benches::structures::peer::{Line, Peer, corners};
use spherule_kernel::{Hit, Ray, Sphere, Spheres, Vec3};

/// What the tree says of a box that is missed; with infinity for a limit every box would be met.
const AT_MOST: f32 = f32::MAX;

pub(crate) struct Parry {
    tree: Bvh,
    spheres: Vec<Sphere>,
}

impl Peer for Parry {
    const NAME: &'static str = "parry3d, Bvh";
    type Ray = (Line, TreeRay);

    fn build(spheres: Spheres<'_>) -> Self {
        let spheres: Vec<_> = spheres.iter().collect();
        let boxes = spheres.iter().map(|sphere| {
            let [low, high] = corners(sphere).map(vector);
            Aabb::new(low, high)
        });
        let tree = Bvh::from_iter(BvhBuildStrategy::Binned, boxes.enumerate());
        Self { tree, spheres }
    }

    fn ray(ray: &Ray) -> Self::Ray {
        (Line::new(ray), TreeRay::new(vector(ray.origin), vector(ray.direction)))
    }

    fn nearest(&self, (line, ray): &Self::Ray) -> Option<Hit> {
        let root = |index: u32, best: f32| {
            let Sphere { center, radius } = self.spheres[index as usize];
            let t = line.first_root(center, radius);
            (t < best).then_some(t)
        };
        let (sphere, t) = self.tree.cast_ray(ray, AT_MOST, root)?;
        Some(Hit { t, sphere })
    }

    fn any(&self, (line, ray): &Self::Ray) -> bool {
        let mut met = false;
        self.tree.traverse(|node: &BvhNode| {
            if node.cast_ray(ray, AT_MOST) >= AT_MOST {
                return TraversalAction::Prune;
            }
            let Some(index) = node.leaf_data() else { return TraversalAction::Continue };
            let Sphere { center, radius } = self.spheres[index as usize];
            if line.first_root(center, radius) < f32::INFINITY {
                met = true;
                return TraversalAction::EarlyExit;
            }
            TraversalAction::Continue
        });
        met
    }
}

fn vector(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
