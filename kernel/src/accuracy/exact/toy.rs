//! The double-precision stage over toy floats, against integers: D and t within their bounds, what is decided right,
//! and two hits in their order.
//!
//! Rays and spheres have 3 or 4 bits, as integers, and the doubles twice as many and five more, as `f64` has: so that, as
//! the proof assumes, products of two inputs are exact, and p = c - o is rounded where c and o are far apart. Twice as many
//! bits are enough, too.

extern crate std;

use super::Brackets;
use super::estimate::{Constants, Estimate};
use crate::accuracy::RayLanes;
use crate::exact::{QuadraticTerms, Root, compare_roots};
use crate::testing::toy::{Format, Toy, power_of_two};
use core::cmp::Ordering;
use std::println;
use std::vec::Vec;

macro_rules! formats {
    ($($name:ident $bits:literal $double:ident $margin:literal),* $(,)?) => {$(
        #[derive(Clone, Copy, Debug)]
        struct $name;
        impl Format for $name {
            const BITS: u32 = $bits;
            const MARGIN: f64 = $margin;
            type Double = $double;
        }
    )*};
}

formats! {
    Single3 3 Double11 1.0, Double11 11 Double11 1.0,
    Single4 4 Double13 1.0, Double13 13 Double13 1.0,
    Short 3 Double6 1.0, Double6 6 Double6 1.0,
    Control 3 ControlDouble 0.125, ControlDouble 6 ControlDouble 0.125,
}

/// o, d, c, r.
#[derive(Clone, Copy, Debug)]
struct Case {
    o: [i64; 3],
    d: [i64; 3],
    c: [i64; 3],
    r: i64,
}

/// a, b and D of a case, exactly.
#[derive(Clone, Copy, Debug)]
struct Truth {
    a: i64,
    b: i64,
    discriminant: i64,
}

impl Case {
    fn truth(&self) -> Truth {
        let Self { o, d, c, r } = *self;
        let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
        let x = [d[1] * p[2] - d[2] * p[1], d[2] * p[0] - d[0] * p[2], d[0] * p[1] - d[1] * p[0]];
        let dot = |v: [i64; 3], w: [i64; 3]| v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
        let a = dot(d, d);
        Truth { a, b: dot(d, p), discriminant: a * r * r - dot(x, x) }
    }

    fn terms(&self) -> QuadraticTerms {
        let single = |v: [i64; 3]| v.map(|x| x as f32);
        QuadraticTerms::new(single(self.o), single(self.d), single(self.c), self.r as f32)
    }

    fn estimate<F: Format>(&self, constants: &Constants) -> Estimate<Toy<F>> {
        let lanes = |v: [i64; 3]| [lane(v[0]), lane(v[1]), lane(v[2])];
        Estimate::new(lanes(self.o), lanes(self.d), lanes(self.c), lane(self.r), constants)
    }
}

fn lane<F: Format>(x: i64) -> Toy<F> {
    Toy::new(x as f64)
}

impl Truth {
    /// How `t` compares with a root, both being real numbers: t a - b with -+sqrt D.
    fn compare(&self, t: f64, root: Root) -> Ordering {
        // t = fraction 2^-scale
        let exponent = (t.to_bits() >> 52 & 0x7ff) as i32 - 1075;
        if t == 0.0 || !t.is_finite() {
            return match t {
                0.0 => self.compare_scaled(0, 0, root),
                _ if t > 0.0 => Ordering::Greater,
                _ => Ordering::Less,
            };
        }
        let magnitude = i128::from(t.to_bits() & ((1 << 52) - 1) | 1 << 52);
        let zeros = magnitude.trailing_zeros() as i32;
        let (fraction, exponent) = (magnitude >> zeros, exponent + zeros);
        let fraction = if t < 0.0 { -fraction } else { fraction };
        match exponent {
            0.. => self.compare_scaled(fraction << exponent, 0, root),
            _ => self.compare_scaled(fraction, -exponent as u32, root),
        }
    }

    fn compare_scaled(&self, fraction: i128, scale: u32, root: Root) -> Ordering {
        let past_middle = fraction * i128::from(self.a) - (i128::from(self.b) << scale);
        let squares =
            (past_middle * past_middle).cmp(&(i128::from(self.discriminant) << (2 * scale)));
        match root {
            Root::Near if past_middle > 0 => Ordering::Greater,
            Root::Near if past_middle == 0 => 0.cmp(&self.discriminant).reverse(),
            Root::Near => squares.reverse(),
            Root::Far if past_middle < 0 => Ordering::Less,
            Root::Far if past_middle == 0 => 0.cmp(&self.discriminant),
            Root::Far => squares,
        }
    }

    /// A root, near enough for figures.
    fn about(&self, root: Root) -> f64 {
        let [a, b, d] = [self.a, self.b, self.discriminant].map(|x| x as f64);
        match root {
            Root::Near => (b - d.sqrt()) / a,
            Root::Far => (b + d.sqrt()) / a,
        }
    }

    /// A root, correctly rounded: from a number near it by steps to neighbours, across midpoints.
    fn rounded<F: Format>(&self, root: Root) -> f64 {
        if self.compare(0.0, root).is_eq() {
            return 0.0;
        }
        let mut t = F::round(self.about(root));
        loop {
            let (below, above) = (neighbour::<F>(t, -1.0), neighbour::<F>(t, 1.0));
            let (low, high) = ((below + t) / 2.0, (t + above) / 2.0);
            let even = t.to_bits() >> (53 - F::BITS) & 1 == 0;
            match (self.compare(low, root), self.compare(high, root)) {
                (Ordering::Greater, _) => t = below,
                (_, Ordering::Less) => t = above,
                (Ordering::Equal, _) if !even => t = below,
                (_, Ordering::Equal) if !even => t = above,
                _ => return t,
            }
        }
    }
}

/// The next number of a format, up or down.
fn neighbour<F: Format>(t: f64, direction: f64) -> f64 {
    if t == 0.0 {
        return direction * power_of_two(-200);
    }
    let step = t.abs() * direction;
    let (near, far) = (F::round(t + step * F::U * 0.75), F::round(t + step * F::U * 1.5));
    if near == t { far } else { near }
}

/// The largest part of E and T that is used, and how many cases there were.
#[derive(Clone, Copy, Debug, Default)]
struct Used {
    d: f64,
    t: f64,
    cases: u64,
    /// Where the line surely meets the sphere.
    meet: u64,
    /// Roots that are not in [t - T, t + T], as computed.
    outside: u64,
}

impl Used {
    fn take<F: Format>(&mut self, case: &Case, constants: &Constants) {
        let truth = case.truth();
        let Estimate { discriminant, error, near, far } = case.estimate::<F>(constants);
        self.cases += 1;
        let off = (discriminant.get() - truth.discriminant as f64).abs();
        if off > 0.0 {
            self.d = self.d.max(off / error.get());
        }
        if discriminant.get() <= error.get() || truth.discriminant < 0 {
            return;
        }
        self.meet += 1;
        for ((t, bound), root) in [(near, Root::Near), (far, Root::Far)] {
            let (low, high) = ((t - bound).get(), (t + bound).get());
            let outside = truth.compare(low, root).is_gt() || truth.compare(high, root).is_lt();
            self.outside += u64::from(outside);
            self.t = self.t.max((t.get() - truth.about(root)).abs() / bound.get());
        }
    }
}

/// Integers of at most so many bits times a power of two, from 0 to `end`.
fn short_integers(bits: u32, end: i64) -> Vec<i64> {
    let short = |x: &i64| *x == 0 || 64 - x.leading_zeros() - x.trailing_zeros() <= bits;
    (0..=end).filter(short).collect()
}

fn signed(numbers: &[i64]) -> Vec<i64> {
    numbers.iter().filter(|x| **x != 0).map(|x| -x).chain(numbers.iter().copied()).collect()
}

/// All cases in a plane, of numbers of `bits` bits: centres up to `end`, radii up to half as much again, and origins `far`
/// from them.
fn plane(bits: u32, far: &[i64], end: i64, mut work: impl FnMut(&Case)) {
    let top = 1 << bits;
    let directions = short_integers(bits, 2 * top - 2);
    let (centers, origins) = (signed(&short_integers(bits, end)), signed(far));
    let radii = short_integers(bits, end + end / 2);
    for &dx in directions.iter().filter(|x| **x >= top) {
        for &dy in directions.iter().filter(|y| **y <= dx) {
            for (&cx, &cy) in pairs(&centers, &centers) {
                for (&ox, &oy) in pairs(&origins, &origins) {
                    // The other half is this one from behind.
                    if (cx - ox, cy - oy) >= (0, 0) {
                        for &r in &radii {
                            work(&Case { o: [ox, oy, 0], d: [dx, dy, 0], c: [cx, cy, 0], r });
                        }
                    }
                }
            }
        }
    }
}

/// All cases in space, of numbers of `bits` bits up to `end`, from the coordinates' origin.
fn space(bits: u32, end: i64, mut work: impl FnMut(&Case)) {
    let numbers = short_integers(bits, end);
    let both = signed(&numbers);
    for &dx in numbers.iter().filter(|x| **x > end / 2) {
        for (&dy, &dz) in pairs(&numbers, &numbers).filter(|(y, z)| **y <= dx && z <= y) {
            for (&cx, &cy) in pairs(&both, &both) {
                for (&cz, &r) in pairs(&numbers, &numbers) {
                    work(&Case { o: [0; 3], d: [dx, dy, dz], c: [cx, cy, cz], r });
                }
            }
        }
    }
}

fn pairs<'a>(one: &'a [i64], other: &'a [i64]) -> impl Iterator<Item = (&'a i64, &'a i64)> {
    one.iter().flat_map(move |x| other.iter().map(move |y| (x, y)))
}

/// What is used of the bounds by all cases of a set.
fn used<F: Format>(constants: &Constants, set: impl FnOnce(&mut dyn FnMut(&Case))) -> Used {
    let mut used = Used::default();
    set(&mut |case| used.take::<F>(case, constants));
    used
}

#[test]
fn discriminants_and_roots_are_within_their_bounds() {
    let of = Constants::of;
    let (three, four) = (of(Double11::U), of(Double13::U));
    let near = |work: &mut dyn FnMut(&Case)| plane(3, &[0], 40, work);
    let all = [
        ("3 bits in a plane", used::<Double11>(&three, near)),
        ("from afar", used::<Double11>(&three, |work| plane(3, &[0, 1024, 2560], 16, work))),
        ("in space", used::<Double11>(&three, |work| space(3, 7, work))),
        ("4 bits in a plane", used::<Double13>(&four, |work| plane(4, &[0], 32, work))),
        // Doubles that barely hold a product.
        ("3 bits in 6", used::<Double6>(&of(Double6::U), near)),
        ("3 bits in 6, in space", used::<Double6>(&of(Double6::U), |work| space(3, 7, work))),
    ];
    for (name, used) in all {
        println!("{name}: {used:?}");
        assert!(used.d <= 1.0 && used.t <= 1.0 && used.outside == 0, "{name}: {used:?}");
        assert!(used.d > 0.25 && used.t > 0.125, "{name} finds nothing hard: {used:?}");
        assert!(used.meet > 10_000, "{name}: {used:?}");
    }
    let control = used::<Double11>(&of(Double11::U / 8.0), near);
    assert!(control.d > 1.0 && control.t > 1.0 && control.outside > 0, "{control:?}");
}

/// Decided cases, undecided ones, and those that are decided wrong.
fn decided<F: Format>(bits: u32, end: i64) -> [u64; 3] {
    let mut counts = [0; 3];
    plane(bits, &[0], end, |case| {
        let truth = case.truth();
        let roots = (truth.discriminant >= 0)
            .then(|| [Root::Near, Root::Far].map(|root| truth.rounded::<F>(root)));
        let [near, far] = roots.unwrap_or([-1.0, 1.0]);
        let infinity = f64::INFINITY;
        for [t_min, t_max, limit] in [
            [-infinity, infinity, infinity],
            [neighbour::<F>(near, 1.0), far, infinity],
            [0.0, infinity, near],
        ] {
            let lanes = |v: [i64; 3]| v.map(lane::<F>);
            let rays = RayLanes {
                origin: lanes(case.o),
                direction: lanes(case.d),
                t_min: Toy::new(t_min),
                t_max: Toy::new(t_max),
                live: true,
            };
            let brackets = Brackets::new(&rays, lanes(case.c), lane(case.r), true);
            let (t, decided) = brackets.decide(&rays, Toy::new(limit));
            let accepted = |t: &f64| t_min <= *t && *t <= t_max;
            let answer = roots.into_iter().flatten().find(accepted).unwrap_or(infinity);
            let right = t.get() == answer || t.get() == infinity && answer > limit;
            counts[if !decided {
                1
            } else if right {
                0
            } else {
                2
            }] += 1;
        }
    });
    counts
}

#[test]
fn what_is_decided_is_right() {
    for (name, [right, open, wrong]) in [
        ("3 bits in 11", decided::<Single3>(3, 28)),
        ("4 bits in 13", decided::<Single4>(4, 14)),
        ("3 bits in 6", decided::<Short>(3, 28)),
    ] {
        println!("{name}: {right} right, {open} left to exact sums");
        assert!(wrong == 0, "{name}: {wrong} are decided wrong");
        assert!(right > 100_000 && open > 1_000, "{name}: {right}, {open}");
    }
    let [_, _, wrong] = decided::<Control>(3, 28);
    println!("with an eighth of the bounds {wrong} are decided wrong");
    assert!(wrong > 0, "no case is hard");
}

/// Of pairs of roots of one ray and two spheres: in the order that the brackets tell, not told, told wrong.
fn ordered<F: Format>(constants: &Constants) -> [u64; 3] {
    let mut counts = [0; 3];
    let both = signed(&short_integers(3, 8));
    for d in [[5, 3, 0], [7, 6, 0]] {
        let mut roots: Vec<(Case, Truth, Root, f64, f64)> = Vec::new();
        for (&cx, &cy) in pairs(&both, &both) {
            for r in short_integers(3, 12) {
                let case = Case { o: [0; 3], d, c: [cx, cy, 0], r };
                let Estimate { discriminant, error, near, far } = case.estimate::<F>(constants);
                if discriminant.get() > error.get() && case.truth().discriminant >= 0 {
                    for ((t, bound), root) in [(near, Root::Near), (far, Root::Far)] {
                        roots.push((
                            case,
                            case.truth(),
                            root,
                            (t - bound).get(),
                            (t + bound).get(),
                        ));
                    }
                }
            }
        }
        for (one, truth, root, _, high) in &roots {
            for (other, other_truth, other_root, low, _) in &roots {
                let told = high < low;
                let apart = other_truth.about(*other_root) - truth.about(*root);
                // Doubles know it, unless the roots are the same or nearly.
                let less = if apart.abs() > 1e-9 {
                    apart > 0.0
                } else {
                    told && compare_roots((&one.terms(), *root), (&other.terms(), *other_root))
                        .is_lt()
                };
                counts[if !told {
                    1
                } else if less {
                    0
                } else {
                    2
                }] += 1;
            }
        }
    }
    counts
}

#[test]
fn two_hits_are_told_apart_right() {
    for (name, [right, open, wrong]) in [
        ("11 bits", ordered::<Double11>(&Constants::of(Double11::U))),
        ("6 bits", ordered::<Double6>(&Constants::of(Double6::U))),
    ] {
        println!("{name}: {right} pairs in order, {open} left to exact sums or in the other order");
        assert!(wrong == 0, "{name}: {wrong} wrong");
        assert!(right > 100_000 && open > right, "{name}: {right}, {open}");
    }
    let [_, _, wrong] = ordered::<Double6>(&Constants::of(Double6::U / 64.0));
    println!("with a sixty-fourth of the bounds {wrong} are wrong");
    assert!(wrong > 0, "no pair is hard");
}
