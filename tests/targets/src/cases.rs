//! Rays and spheres, ordinary and hard, made from a number alone: the same on every target.
//!
//! Only bits, sums, products, quotients and roots make them, which every target rounds alike.

use spherule_kernel::{Lanes, Ray, Sphere, Vec3};

/// A ray and its sphere.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// The ray.
    pub ray: Ray,
    /// The sphere.
    pub sphere: Sphere,
}

/// The most expensive cases, those that doubles cannot decide: a tangent where the coordinates are zero, and steps of spawned rays least; a
/// tie; and the most expensive case of the kernel's cost test.
pub static HARD: [Case; 3] = [
    of_numbers([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], 1.0),
    of_numbers([0.0; 3], [1.0, 0.0, 0.0], [16_777_220.0, 0.0, 0.0], 1.0),
    of_numbers(
        [4.304_508_3e17, 8.930_645_5e-30, 8_205.748],
        [594.441_3, -6.914_829e26, 7.052_379e-36],
        [-6_261.860_4, 2_136.177, -3.241_990_3e-26],
        1.324_018_2e38,
    ),
];

const fn of_numbers(o: [f32; 3], d: [f32; 3], c: [f32; 3], radius: f32) -> Case {
    let ray = Ray::new(Vec3::from_array(o), Vec3::from_array(d));
    Case { ray, sphere: Sphere { center: Vec3::from_array(c), radius } }
}

/// How many cases there are.
pub const CASES: u32 = 20_480;
/// How many kinds of cases there are; they take turns.
const KINDS: u32 = 8;

/// Random numbers: `SplitMix64`.
#[derive(Clone, Copy, Debug)]
pub struct Random(pub u64);

impl Random {
    /// Any bits.
    pub fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 32) as u32
    }

    /// A number in [-1, 1), of 24 bits.
    pub fn number(&mut self) -> f32 {
        ((self.bits() >> 8) as i32 - (1 << 23)) as f32 / (1 << 23) as f32
    }

    /// One of the integers from `-limit` to `limit`.
    fn integer(&mut self, limit: i32) -> f32 {
        (self.bits() % (2 * limit as u32 + 1)) as f32 - limit as f32
    }

    /// 2 to a power from `-limit` to `limit`, at most 126.
    fn power(&mut self, limit: i32) -> f32 {
        let exponent = (self.bits() % (2 * limit as u32 + 1)) as i32 - limit;
        f32::from_bits(((exponent + 127) as u32) << 23)
    }

    /// A point whose coordinates are in [-1, 1).
    pub fn point(&mut self) -> Vec3 {
        let (x, y) = (self.number(), self.number());
        Vec3::new(x, y, self.number())
    }

    fn lattice(&mut self) -> Vec3 {
        let (x, y) = (self.integer(4), self.integer(4));
        Vec3::new(x, y, self.integer(4))
    }

    fn any(&mut self) -> f32 {
        f32::from_bits(self.bits())
    }

    fn any_point(&mut self) -> Vec3 {
        let (x, y) = (self.any(), self.any());
        Vec3::new(x, y, self.any())
    }
}

/// Case `number`.
#[must_use]
pub fn case(number: u32) -> Case {
    let mut random = Random(u64::from(number) << 20);
    let random = &mut random;
    let (origin, direction) = (random.point() * 3.0, random.point());
    let aim = origin + direction * (random.number() + 1.5) * 4.0;
    let near = Case {
        ray: Ray::new(origin, direction),
        sphere: Sphere { center: aim + random.point(), radius: 0.25 + random.number().abs() },
    };
    match number % KINDS {
        0 => near,
        1 => grazing(random, near),
        2 => on_a_lattice(random),
        3 => with_any_bits(random),
        4 => from_afar(random, near),
        5 => of_any_size(random, near),
        6 => from_the_surface(random, near),
        _ => with_an_interval(random, near),
    }
}

/// A line whose distance from the centre is the radius, give or take some ulp.
fn grazing(random: &mut Random, Case { ray, sphere }: Case) -> Case {
    let away = ray.direction.cross(random.point());
    let away = away / Lanes::sqrt(away.dot(away));
    let radius = f32::from_bits(sphere.radius.to_bits() + random.bits() % 9 - 4);
    let center = ray.origin + ray.direction * 3.0 + away * sphere.radius;
    Case { ray, sphere: Sphere { center, radius } }
}

/// Small integers: tangents, ties, rays that start on the surface.
fn on_a_lattice(random: &mut Random) -> Case {
    let ray = Ray::new(random.lattice(), random.lattice());
    Case { ray, sphere: Sphere { center: random.lattice(), radius: random.integer(4).abs() } }
}

/// Subnormal numbers, infinities and NaN among them.
fn with_any_bits(random: &mut Random) -> Case {
    let ray = Ray { origin: random.any_point(), ..Ray::new(Vec3::ZERO, random.any_point()) };
    let ray = Ray { t_min: random.any(), t_max: random.any(), ..ray };
    Case { ray, sphere: Sphere { center: random.any_point(), radius: random.any() } }
}

/// A sphere that is small for its distance.
fn from_afar(random: &mut Random, Case { ray, sphere }: Case) -> Case {
    let far = 1024.0 * random.power(9).max(1.0);
    let center = ray.origin + ray.direction * far + random.point() * sphere.radius;
    Case { ray, sphere: Sphere { center, ..sphere } }
}

/// Any size from subnormal to too large, and a direction of another length.
fn of_any_size(random: &mut Random, Case { ray, sphere }: Case) -> Case {
    let (size, length) = (random.power(126), random.power(126));
    let ray = Ray { origin: ray.origin * size, direction: ray.direction * length, ..ray };
    Case { ray, sphere: Sphere { center: sphere.center * size, radius: sphere.radius * size } }
}

/// A ray that starts where another one hits, inside or outside by a rounding.
fn from_the_surface(random: &mut Random, Case { ray, sphere }: Case) -> Case {
    let away = random.point();
    let origin = sphere.center + away * (sphere.radius / Lanes::sqrt(away.dot(away)));
    let t_min = random.number() * f32::EPSILON;
    Case { ray: Ray { origin, t_min, ..ray }, sphere }
}

/// An interval that may begin or end between the roots, or hold neither.
fn with_an_interval(random: &mut Random, Case { ray, sphere }: Case) -> Case {
    let t_min = random.number() * 8.0;
    Case { ray: Ray { t_min, t_max: t_min + random.number() * 4.0 + 3.0, ..ray }, sphere }
}
