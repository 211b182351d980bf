//! The trees of other crates, ray by ray. All test spheres by the same function: what differs is the tree.

use crate::engine::{Engine, Label, Promise, Query, Rays, Run, SOME_RAYS};
use spherule_kernel::{Hit, Ray, Sphere, Vec3};
use std::rc::Rc;

/// A ray, and what can be computed of it before any sphere is known.
#[derive(Clone, Copy)]
pub(super) struct PreparedRay {
    ray: Ray,
    /// 1 / the square of the direction's length.
    inverse_square: f32,
}

impl PreparedRay {
    pub(super) fn new(ray: &Ray) -> Self {
        Self { ray: *ray, inverse_square: 1.0 / ray.direction.length_squared() }
    }

    /// The first root in the ray's interval, infinite if there is none: closest point first (Haines), in `f32`.
    #[inline]
    pub(super) fn first_root(&self, &Sphere { center, radius }: &Sphere) -> f32 {
        let f = center - self.ray.origin;
        let middle = f.dot(self.ray.direction) * self.inverse_square;
        let off = f - middle * self.ray.direction;
        let discriminant = radius * radius - off.length_squared();
        if discriminant < 0.0 {
            return f32::INFINITY;
        }
        let half = (discriminant * self.inverse_square).sqrt();
        let near = middle - half;
        let t = if near >= self.ray.t_min { near } else { middle + half };
        if t >= self.ray.t_min && t <= self.ray.t_max { t } else { f32::INFINITY }
    }
}

/// The corners of a sphere's box.
pub(super) fn corners(sphere: &Sphere) -> [Vec3; 2] {
    [sphere.center - sphere.radius, sphere.center + sphere.radius]
}

/// The engine of a tree: `prepare` makes a ray as the tree wants it; the tree answers.
pub(super) fn engine<T: 'static, R: 'static>(
    name: &'static str,
    tree: T,
    prepare: impl Fn(&Ray) -> R + 'static,
    closest_hit: impl Fn(&T, &R) -> Option<Hit> + Copy + 'static,
    any_hit: impl Fn(&T, &R) -> bool + Copy + 'static,
) -> Engine {
    let tree = Rc::new(tree);
    let ready = move |rays: &Rays| -> Box<dyn Run> {
        let (tree, hits) = (Rc::clone(&tree), vec![None; rays.list.len()]);
        let rays = rays.list.iter().map(&prepare).collect();
        Box::new(OneByOne { tree, rays, closest_hit, any_hit, hits })
    };
    Engine {
        label: Label { way: "", name, lanes: "" },
        promise: Promise::OTHERS,
        most_rays: SOME_RAYS,
        ready: Box::new(ready),
    }
}

struct OneByOne<T, R, C, A> {
    tree: Rc<T>,
    rays: Vec<R>,
    closest_hit: C,
    any_hit: A,
    hits: Vec<Option<Hit>>,
}

impl<T, R, C: Fn(&T, &R) -> Option<Hit>, A: Fn(&T, &R) -> bool> Run for OneByOne<T, R, C, A> {
    fn run(&mut self, query: Query) {
        let answers = self.rays.iter().zip(&mut self.hits);
        match query {
            Query::ClosestHit => {
                answers.for_each(|(ray, hit)| *hit = (self.closest_hit)(&self.tree, ray));
            }
            Query::AnyHit => answers.for_each(|(ray, hit)| {
                *hit = (self.any_hit)(&self.tree, ray).then_some(Hit { t: 0.0, sphere: 0 });
            }),
        }
        std::hint::black_box(&self.hits);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        self.hits.clone()
    }

    fn forget(&mut self) {
        let every_second =
            (0..).map(|ray| (ray % 2 == 0).then_some(Hit { t: f32::NAN, sphere: 0 }));
        self.hits.iter_mut().zip(every_second).for_each(|(hit, wrong)| *hit = wrong);
    }
}
