//! Cases whose roots are known in integers: tangents, ties, origins on the surface.
//!
//! An integer quaternion (w, x, y, z) of norm n = w^2 + x^2 + y^2 + z^2 gives three integer vectors
//! of length n, at right angles to each other. Let d be one of them and h another. Then p = s d + m
//! h is at distance |m| n from the line along d. So a sphere of radius |m| n is a tangent, and a
//! sphere of radius 5 m n / 4 has its roots at s -+ 3 m / 4, all exactly.

use crate::case::Case;
use crate::random::{Random, power_of_two};
use crate::ulp::step;
use spherule_kernel::{Ray, Sphere, Vec3};

/// Three orthogonal integer vectors of one integer length.
struct Frame {
    columns: [[i64; 3]; 3],
    length: i64,
}

impl Frame {
    /// Draws quaternions with entries up to `reach`, so lengths up to 4 `reach`^2.
    fn draw(random: &mut Random, reach: i64) -> Self {
        loop {
            let [w, x, y, z] = [(); 4].map(|()| random.integer(-reach, reach));
            let length = w * w + x * x + y * y + z * z;
            if length == 0 {
                continue;
            }
            let mut columns = [
                [w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)],
                [2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)],
                [2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z],
            ];
            let turn = random.integer(0, 2) as usize;
            columns.rotate_left(turn);
            return Self { columns, length };
        }
    }

    /// `along` times the first vector and `across` times the second.
    fn point(&self, along: i64, across: i64) -> [i64; 3] {
        core::array::from_fn(|i| along * self.columns[0][i] + across * self.columns[1][i])
    }
}

/// The case with these integers: lengths in units of `unit`, directions in units of `step`.
fn scaled(o: [i64; 3], d: [i64; 3], c: [i64; 3], r: i64, unit: f64, step: f64) -> Case {
    let single = |x: i64, unit: f64| {
        let value = (x as f64 * unit) as f32;
        assert!(f64::from(value) == x as f64 * unit, "{x} * {unit:e} is no f32");
        value
    };
    let vector = |v: [i64; 3], unit| Vec3::from_array(v.map(|x| single(x, unit)));
    Case {
        ray: Ray::new(vector(o, unit), vector(d, step)),
        sphere: Sphere { center: vector(c, unit), radius: single(r, unit) },
    }
}

/// D = 0, in many sizes. In one of four cases the subtraction of origin and centre is not exact.
pub(super) fn tangent(random: &mut Random) -> Case {
    let frame = Frame::draw(random, 12);
    let (along, across) = (random.integer(-200, 2000), random.integer(-2000, 2000));
    let p = frame.point(along, across);
    let reach = if random.one_in(4) { 1 << 23 } else { 1 << 12 };
    let o = [(); 3].map(|()| random.integer(-reach, reach));
    let c = core::array::from_fn(|i| o[i] + p[i]);
    let (unit, step) =
        (power_of_two(random.integer(-40, 20)), power_of_two(random.integer(-20, 20)));
    scaled(o, frame.columns[0], c, across.abs() * frame.length, unit, step)
}

/// A tangent with one of its numbers one to three ulp off.
pub(super) fn next_to_tangent(random: &mut Random) -> Case {
    let mut numbers = tangent(random).numbers();
    // Origin, direction, centre and radius; not the interval. The radius more often.
    let which = random.pick(&[0, 1, 2, 3, 4, 5, 8, 9, 10, 11, 11, 11]);
    numbers[which] = step(numbers[which], random.pick(&[-3, -2, -1, 1, 2, 3]));
    Case::from_numbers(numbers)
}

/// The origin exactly on the surface.
pub(super) fn on_surface(random: &mut Random) -> Case {
    let frame = Frame::draw(random, 12);
    let across = random.integer(1, 2000);
    let p = frame.point(0, across);
    let c = [(); 3].map(|()| random.integer(-1 << 12, 1 << 12));
    let o = core::array::from_fn(|i| c[i] - p[i]);
    let d = match random.integer(0, 3) {
        // Along the surface, down through the centre, or in any direction.
        0 => frame.columns[0],
        1 => p,
        _ => [(); 3].map(|()| random.integer(-1 << 20, 1 << 20)),
    };
    let d = if d == [0; 3] { p } else { d };
    let unit = power_of_two(random.integer(-40, 20));
    scaled(o, d, c, across * frame.length, unit, power_of_two(random.integer(-30, 0)))
}

/// A root midway between two neighbouring `f32`: the near one, the far one, or a tangent's.
pub(super) fn tie(random: &mut Random) -> Case {
    loop {
        // 25 bits, the last one set: such a number is midway between two significands of 24 bits.
        let midway = random.integer(1 << 23, (1 << 24) - 1) * 2 + 1;
        let fourth = if random.one_in(3) { 0 } else { 1 << random.integer(0, 12) };
        let root = random.sign() as i64 * midway;
        // Each root lies 3 fourths from the middle.
        let middle = root + 3 * fourth * random.sign() as i64;
        let frame = Frame::draw(random, 3);
        let (across, radius) = match fourth {
            0 => (random.integer(1, 500), None),
            _ => (4 * fourth, Some(5 * fourth * frame.length)),
        };
        let p = frame.point(middle, across);
        // p needs more bits than 24: the centre takes the upper, the origin the rest.
        let c = p.map(|x| (x as f64 as f32) as i64);
        let o = core::array::from_fn(|i| c[i] - p[i]);
        let lost = |v: [i64; 3]| v.iter().any(|&x| (x as f32) as i64 != x);
        if lost(c) || lost(o) {
            continue;
        }
        let unit = power_of_two(random.integer(-40, 20));
        let step = unit * power_of_two(random.integer(-20, 20));
        let radius = radius.unwrap_or(across * frame.length);
        let mut case = scaled(o, frame.columns[0], c, radius, unit, step);
        if root < 0 || random.one_in(4) {
            case.ray.t_min = f32::NEG_INFINITY;
        }
        // The far root is the answer only if the interval excludes the near one.
        if middle < root {
            case.ray.t_min = (f64::from(middle as f32) * (unit / step)) as f32;
        }
        return case;
    }
}
