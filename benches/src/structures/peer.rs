//! What a tree of someone else must offer to be compared: to be built, and to be asked ray by ray.
//!
//! All peers test spheres by the same function, [`Line::first_root`]; what differs is the tree.

use crate::rounds::busy;
use spherule_kernel::{Hit, Question, Ray, Sphere, Spheres, Vec3};

/// A tree over spheres.
pub trait Peer: Sized {
    /// Crate and structure.
    const NAME: &'static str;
    /// A ray as the tree wants it; made outside the clock, as the kernel's packets are.
    type Ray;

    /// A tree over these.
    fn build(spheres: Spheres<'_>) -> Self;
    /// A ray for it.
    fn ray(ray: &Ray) -> Self::Ray;
    /// What a ray meets first.
    fn nearest(&self, ray: &Self::Ray) -> Option<Hit>;
    /// Whether a ray meets anything.
    fn any(&self, ray: &Self::Ray) -> bool;
}

/// A peer of whatever type, with rays.
pub trait Ready {
    /// Crate and structure.
    fn name(&self) -> &'static str;
    /// How many nanoseconds the build took.
    fn build_nanoseconds(&self) -> f64;
    /// Takes other rays.
    fn take_rays(&mut self, rays: &[Ray]);
    /// Finds what they meet: as many answers as there is room for. Of a question for any hit,
    /// which and where mean nothing.
    fn pass(&self, question: Question, hits: &mut [Option<Hit>]);
}

/// Who builds a peer's tree.
#[derive(Clone, Copy, Debug)]
pub struct Builder {
    /// Crate and structure.
    pub name: &'static str,
    /// Builds it.
    pub build: fn(Spheres<'_>) -> Box<dyn Ready>,
}

/// The builder of a peer.
#[must_use]
pub const fn builder<P: Peer + 'static>() -> Builder {
    Builder {
        name: P::NAME,
        build: |spheres| {
            let start = busy();
            let tree = P::build(spheres);
            Box::new(Entry { tree, rays: Vec::new(), build_nanoseconds: busy() - start })
        },
    }
}

struct Entry<P: Peer> {
    tree: P,
    rays: Vec<P::Ray>,
    build_nanoseconds: f64,
}

impl<P: Peer> Ready for Entry<P> {
    fn name(&self) -> &'static str {
        P::NAME
    }

    fn build_nanoseconds(&self) -> f64 {
        self.build_nanoseconds
    }

    fn take_rays(&mut self, rays: &[Ray]) {
        self.rays = rays.iter().map(P::ray).collect();
    }

    fn pass(&self, question: Question, hits: &mut [Option<Hit>]) {
        let answers = self.rays.iter().zip(hits);
        match question {
            Question::Nearest => answers.for_each(|(ray, hit)| *hit = self.tree.nearest(ray)),
            Question::Any => answers.for_each(|(ray, hit)| {
                *hit = self.tree.any(ray).then_some(Hit { t: 0.0, sphere: 0 });
            }),
        }
    }
}

/// A ray, and what can be known of it before a sphere is.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// The ray.
    pub ray: Ray,
    /// By the square of the direction's length.
    inverse_square: f32,
}

impl Line {
    /// Of a ray.
    #[must_use]
    pub fn new(ray: &Ray) -> Self {
        Self { ray: *ray, inverse_square: 1.0 / ray.direction.length_squared() }
    }

    /// The first root in the ray's interval, infinite where there is none: closest point first
    /// (Haines), in `f32`.
    #[must_use]
    #[inline]
    pub fn first_root(&self, center: Vec3, radius: f32) -> f32 {
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
#[must_use]
pub fn corners(sphere: &Sphere) -> [Vec3; 2] {
    [sphere.center - sphere.radius, sphere.center + sphere.radius]
}
