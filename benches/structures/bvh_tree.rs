//! The binary tree of `bvh`.
//!
//! It does not take the best hit so far; boxes come in the order in which they are entered, and
//! the search ends at the first that is entered behind a hit. For any hit they come as they come,
//! which is faster.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::ray::Ray as TreeRay;
use nalgebra::{Point3, Vector3};
use spherule_benches::structures::peer::{Line, Peer, corners};
use spherule_kernel::{Hit, Ray, Sphere, Spheres};

pub(crate) struct Binary {
    tree: Bvh<f32, 3>,
    shapes: Vec<Shape>,
}

struct Shape {
    sphere: Sphere,
    index: u32,
    node: usize,
}

impl Bounded<f32, 3> for Shape {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [low, high] = corners(&self.sphere).map(|corner| Point3::from(corner.to_array()));
        Aabb::with_bounds(low, high)
    }
}

impl BHShape<f32, 3> for Shape {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

/// The tree makes directions unit length; `length` is what they had.
pub(crate) struct Rays {
    line: Line,
    ray: TreeRay<f32, 3>,
    length: f32,
}

impl Peer for Binary {
    const NAME: &'static str = "bvh";
    type Ray = Rays;

    fn build(spheres: Spheres<'_>) -> Self {
        let shape = |(index, sphere)| Shape { sphere, index, node: 0 };
        let mut shapes: Vec<_> = (0..).zip(spheres.iter()).map(shape).collect();
        Self { tree: Bvh::build(&mut shapes), shapes }
    }

    fn ray(ray: &Ray) -> Self::Ray {
        let origin = Point3::from(ray.origin.to_array());
        let direction = Vector3::from(ray.direction.to_array());
        let length = ray.direction.length();
        Rays { line: Line::new(ray), ray: TreeRay::new(origin, direction), length }
    }

    fn nearest(&self, rays: &Self::Ray) -> Option<Hit> {
        let mut best = Hit { t: f32::INFINITY, sphere: 0 };
        for shape in self.tree.nearest_traverse_iterator(&rays.ray, &self.shapes) {
            let entered = rays.ray.intersection_slice_for_aabb(&shape.aabb());
            if entered.is_some_and(|(entered, _)| entered > best.t * rays.length) {
                break;
            }
            let t = rays.line.first_root(shape.sphere.center, shape.sphere.radius);
            if t < best.t {
                best = Hit { t, sphere: shape.index };
            }
        }
        (best.t < f32::INFINITY).then_some(best)
    }

    fn any(&self, rays: &Self::Ray) -> bool {
        let met = |shape: &Shape| {
            rays.line.first_root(shape.sphere.center, shape.sphere.radius) < f32::INFINITY
        };
        self.tree.traverse_iterator(&rays.ray, &self.shapes).any(met)
    }
}
