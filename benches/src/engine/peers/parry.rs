//! The binary tree of `parry3d`, called as its own composite shapes call it.

use super::one_by_one::{PreparedRay, corners, engine};
use crate::engine::Engine;
use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhNode, TraversalAction};
use parry3d::query::Ray as TreeRay;
use spherule_kernel::{Hit, Ray, Spheres, Vec3};

/// The limit for t, which the tree also returns for a box that is missed: with an infinite limit
/// every box would count as met.
const AT_MOST: f32 = f32::MAX;

pub(crate) fn build(spheres: Spheres<'_>) -> Engine {
    let vector = |v: Vec3| Vector::new(v.x, v.y, v.z);
    let spheres: Vec<_> = spheres.iter().collect();
    let boxes = spheres.iter().map(|sphere| {
        let [low, high] = corners(sphere).map(vector);
        Aabb::new(low, high)
    });
    let tree = Bvh::from_iter(BvhBuildStrategy::Binned, boxes.enumerate());
    engine(
        "parry3d, Bvh",
        (tree, spheres),
        move |ray: &Ray| {
            (PreparedRay::new(ray), TreeRay::new(vector(ray.origin), vector(ray.direction)))
        },
        |(tree, spheres), (prepared, ray)| {
            let root = |index: u32, best: f32| {
                let t = prepared.first_root(&spheres[index as usize]);
                (t < best).then_some(t)
            };
            tree.cast_ray(ray, AT_MOST, root).map(|(sphere, t)| Hit { t, sphere })
        },
        |(tree, spheres), (prepared, ray)| {
            let mut occluded = false;
            tree.traverse(|node: &BvhNode| {
                if node.cast_ray(ray, AT_MOST) >= AT_MOST {
                    return TraversalAction::Prune;
                }
                let Some(index) = node.leaf_data() else { return TraversalAction::Continue };
                if prepared.first_root(&spheres[index as usize]) < f32::INFINITY {
                    occluded = true;
                    return TraversalAction::EarlyExit;
                }
                TraversalAction::Continue
            });
            occluded
        },
    )
}
