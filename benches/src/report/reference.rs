//! Two forms that are no tier, for the report alone: what their users pay, and what they get.
//!
//! * `lecture`: the geometric form with a unit direction, in `f32`: t_m = d.p, l^2 = p.p - t_m^2,
//!   dt = sqrt(r^2 - l^2), t = t_m -+ dt. Directions are made unit before the clock starts; t is
//!   divided by their length where a line hits.
//! * `plain f64`: the textbook form in double precision, nothing proven: a = d.d, b = d.p,
//!   D = b^2 - a (p.p - r^2), t = (b -+ sqrt D) / a.
//!
//! Both run in the same brute-force loop: four spheres under one branch, roots only behind it and
//! out of line. What can be done before the clock starts is done before: rays widened, radii
//! squared. Products and sums are fused where the build has that instruction.

use crate::check::Tolerance;
use crate::report::contender::{Contender, Engine, Run};
use core::ops::{Add, BitAnd, Div, Mul, Sub};
use spherule_kernel::{Hit, Ray, Sphere, Spheres};
use wide::{f32x4, f32x8, f32x16, f64x4, f64x8};

/// The two forms in their lanes.
#[must_use]
pub fn contenders() -> Vec<Contender> {
    let lecture = |lanes, count, ready| {
        let engine = Engine { level: Engine::BUILD, lanes, count };
        let tolerance = Tolerance::TEXTBOOK;
        let over_ground = Tolerance::TEXTBOOK_OVER_GROUND;
        Contender { name: LECTURE, is_tier: false, engine, tolerance, over_ground, ready }
    };
    let double = |lanes, count, ready| {
        let tolerance = Tolerance::EXACT;
        Contender {
            name: DOUBLE,
            tolerance,
            over_ground: tolerance,
            ..lecture(lanes, count, ready)
        }
    };
    vec![
        lecture("f32x4", 4, ready::<Geometric, f32x4>),
        lecture("f32x8", 8, ready::<Geometric, f32x8>),
        lecture("f32x16", 16, ready::<Geometric, f32x16>),
        double("f64x4", 4, ready::<Textbook, f64x4>),
        double("f64x8", 8, ready::<Textbook, f64x8>),
    ]
}

/// The lecture's form with a unit direction.
pub const LECTURE: &str = "lecture";
/// The textbook form in double precision.
pub const DOUBLE: &str = "plain f64";
/// Spheres under one branch.
const GROUP: usize = 4;

/// What the forms need of lanes, in either precision.
trait Vector:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + BitAnd<Output = Self>
{
    const COUNT: usize;
    type Element: Copy;
    /// Exact.
    fn element(value: f32) -> Self::Element;
    fn square(value: Self::Element) -> Self::Element;
    fn splat(value: Self::Element) -> Self;
    fn load(of: impl Fn(usize) -> f32) -> Self;
    /// Rounded to single precision.
    fn lane(self, index: usize) -> f32;
    fn sqrt(self) -> Self;
    fn mul_add(self, factor: Self, addend: Self) -> Self;
    fn max(self, other: Self) -> Self;
    /// All bits of a lane set where `self <= other`.
    fn le(self, other: Self) -> Self;
    /// All bits of a lane set where `self < other`.
    fn lt(self, other: Self) -> Self;
    fn any(self) -> bool;
    fn select(mask: Self, yes: Self, no: Self) -> Self;

    #[inline(always)]
    fn like(value: f32) -> Self {
        Self::splat(Self::element(value))
    }
}

macro_rules! vector {
    ($vector:ident, $element:ident, $count:literal) => {
        impl Vector for $vector {
            const COUNT: usize = $count;
            type Element = $element;
            #[inline(always)]
            fn element(value: f32) -> $element {
                $element::from(value)
            }
            #[inline(always)]
            fn square(value: $element) -> $element {
                value * value
            }
            #[inline(always)]
            fn splat(value: $element) -> Self {
                $vector::splat(value)
            }
            fn load(of: impl Fn(usize) -> f32) -> Self {
                $vector::new(std::array::from_fn(|lane| $element::from(of(lane))))
            }
            fn lane(self, index: usize) -> f32 {
                self.to_array()[index] as f32
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $vector::sqrt(self)
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                $vector::mul_add(self, factor, addend)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.fast_max(other)
            }
            #[inline(always)]
            fn le(self, other: Self) -> Self {
                self.simd_le(other)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> Self {
                self.simd_lt(other)
            }
            #[inline(always)]
            fn any(self) -> bool {
                $vector::any(self)
            }
            #[inline(always)]
            fn select(mask: Self, yes: Self, no: Self) -> Self {
                mask.select(yes, no)
            }
        }
    };
}

vector!(f32x4, f32, 4);
vector!(f32x8, f32, 8);
vector!(f32x16, f32, 16);
vector!(f64x4, f64, 4);
vector!(f64x8, f64, 8);

#[inline(always)]
fn dot<V: Vector>(v: [V; 3], w: [V; 3]) -> V {
    v[2].mul_add(w[2], v[1].mul_add(w[1], v[0] * w[0]))
}

/// A sphere in the precision of the lanes, its radius squared.
#[derive(Clone, Copy)]
struct Prepared<V: Vector> {
    center: [V::Element; 3],
    square: V::Element,
}

/// Rays in lanes: the direction as the form wants it, and a number beside it that depends on the
/// direction alone.
struct Rays<V> {
    origin: [V; 3],
    direction: [V; 3],
    beside: V,
    t_min: V,
    t_max: V,
}

/// A way to solve the quadratic.
trait Form {
    /// The direction that the form reckons with, and what it keeps beside it.
    fn direction<V: Vector>(d: [V; 3]) -> ([V; 3], V);
    /// For p = c - o: the middle of the roots, and what their difference is the root of; negative
    /// where the line misses.
    fn middle_and_discriminant<V: Vector>(rays: &Rays<V>, p: [V; 3], square: V) -> [V; 2];
    /// A root in multiples of the ray's own direction.
    fn t<V: Vector>(rays: &Rays<V>, root: V) -> V;
}

struct Geometric;

impl Form for Geometric {
    fn direction<V: Vector>(d: [V; 3]) -> ([V; 3], V) {
        let length = dot(d, d).sqrt();
        (d.map(|x| x / length), length)
    }

    #[inline(always)]
    fn middle_and_discriminant<V: Vector>(rays: &Rays<V>, p: [V; 3], square: V) -> [V; 2] {
        let middle = dot(rays.direction, p);
        let off_square = dot(p, p) - middle * middle;
        [middle, square - off_square]
    }

    #[inline(always)]
    fn t<V: Vector>(rays: &Rays<V>, root: V) -> V {
        root / rays.beside
    }
}

struct Textbook;

impl Form for Textbook {
    fn direction<V: Vector>(d: [V; 3]) -> ([V; 3], V) {
        (d, dot(d, d))
    }

    #[inline(always)]
    fn middle_and_discriminant<V: Vector>(rays: &Rays<V>, p: [V; 3], square: V) -> [V; 2] {
        let b = dot(rays.direction, p);
        [b, b.mul_add(b, V::like(0.0) - rays.beside * (dot(p, p) - square))]
    }

    #[inline(always)]
    fn t<V: Vector>(rays: &Rays<V>, root: V) -> V {
        root / rays.beside
    }
}

/// The nearest hit so far: t, infinite where there is none, and the sphere's index as a number.
#[derive(Clone, Copy)]
struct Nearest<V> {
    t: V,
    sphere: V,
}

struct Brute<F, V: Vector> {
    rays: Vec<Rays<V>>,
    groups: Vec<[Prepared<V>; GROUP]>,
    nearest: Vec<Nearest<V>>,
    count: usize,
    form: core::marker::PhantomData<F>,
}

fn ready<'a, F: Form + 'static, V: Vector + 'static>(
    rays: &[Ray],
    spheres: Spheres<'a>,
) -> Box<dyn Run + 'a> {
    let count = rays.len();
    let rays: Vec<_> = rays.chunks(V::COUNT).map(|chunk| rays_of::<F, V>(chunk)).collect();
    let spheres: Vec<_> = spheres.iter().map(prepared).collect();
    // Nothing hits a sphere whose radius squared is -inf.
    let nothing = Prepared { center: [V::element(0.0); 3], square: V::element(f32::NEG_INFINITY) };
    let group = |chunk: &[Prepared<V>]| {
        std::array::from_fn(|slot| chunk.get(slot).copied().unwrap_or(nothing))
    };
    let groups = spheres.chunks(GROUP).map(group).collect();
    let none = Nearest { t: V::like(f32::INFINITY), sphere: V::like(0.0) };
    let nearest = vec![none; rays.len()];
    Box::new(Brute::<F, V> { rays, groups, nearest, count, form: core::marker::PhantomData })
}

fn prepared<V: Vector>(sphere: Sphere) -> Prepared<V> {
    let center = sphere.center.to_array().map(V::element);
    Prepared { center, square: V::square(V::element(sphere.radius)) }
}

/// Lanes past the last ray repeat it.
fn rays_of<F: Form, V: Vector>(chunk: &[Ray]) -> Rays<V> {
    let lanes = |of: &dyn Fn(&Ray) -> f32| V::load(|lane| of(&chunk[lane.min(chunk.len() - 1)]));
    let (direction, beside) = F::direction([0, 1, 2].map(|axis| lanes(&|ray| ray.direction[axis])));
    Rays {
        origin: [0, 1, 2].map(|axis| lanes(&|ray| ray.origin[axis])),
        direction,
        beside,
        t_min: lanes(&|ray| ray.t_min),
        t_max: lanes(&|ray| ray.t_max),
    }
}

#[inline(always)]
fn solved<F: Form, V: Vector>(rays: &Rays<V>, sphere: &Prepared<V>) -> [V; 2] {
    let [x, y, z] = sphere.center;
    let [ox, oy, oz] = rays.origin;
    let p = [V::splat(x) - ox, V::splat(y) - oy, V::splat(z) - oz];
    F::middle_and_discriminant(rays, p, V::splat(sphere.square))
}

impl<F: Form, V: Vector> Run for Brute<F, V> {
    fn run(&mut self) {
        for (rays, nearest) in self.rays.iter().zip(&mut self.nearest) {
            nearest.t = V::like(f32::INFINITY);
            for (index, group) in self.groups.iter().enumerate() {
                let [one, two, three, four] = group;
                let [_, one] = solved::<F, V>(rays, one);
                let [_, two] = solved::<F, V>(rays, two);
                let [_, three] = solved::<F, V>(rays, three);
                let [_, four] = solved::<F, V>(rays, four);
                let largest = one.max(two).max(three.max(four));
                if V::like(0.0).le(largest).any() {
                    resolve::<F, V>(rays, group, index * GROUP, nearest);
                }
            }
        }
        std::hint::black_box(&self.nearest);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        let lanes = (0..self.count).map(|ray| (&self.nearest[ray / V::COUNT], ray % V::COUNT));
        lanes
            .map(|(nearest, lane)| {
                let t = nearest.t.lane(lane) + 0.0;
                t.is_finite().then(|| Hit { t, sphere: nearest.sphere.lane(lane) as u32 })
            })
            .collect()
    }
}

#[inline(never)]
fn resolve<F: Form, V: Vector>(
    rays: &Rays<V>,
    group: &[Prepared<V>; GROUP],
    first: usize,
    nearest: &mut Nearest<V>,
) {
    for (slot, sphere) in group.iter().enumerate() {
        let [middle, discriminant] = solved::<F, V>(rays, sphere);
        let meets = V::like(0.0).le(discriminant);
        if meets.any() {
            let root = discriminant.sqrt();
            let [near, far] = [F::t(rays, middle - root), F::t(rays, middle + root)];
            let accepted = |t: V| meets & rays.t_min.le(t) & t.le(rays.t_max);
            let t = V::select(accepted(far), far, V::like(f32::INFINITY));
            let t = V::select(accepted(near), near, t);
            let nearer = t.lt(nearest.t);
            nearest.t = V::select(nearer, t, nearest.t);
            nearest.sphere = V::select(nearer, V::like((first + slot) as f32), nearest.sphere);
        }
    }
}
