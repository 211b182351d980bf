//! The double-precision stage over toy floats, against integers: D and t within their bounds, what is decided right,
//! and two hits in their order.
//!
//! Rays and spheres have 3 or 4 bits, as integers, and the doubles twice as many and five more, as `f64` has: so
//! that, as the proof assumes, products of two inputs are exact, and p = c - o is rounded where c and o are far
//! apart. Twice as many bits are enough, too.

mod cases;

use self::cases::{neighbour, plane, short_integers, signed, space};
use super::case::Case;
use super::pairs;
use crate::accuracy::constants::Constants;
use crate::accuracy::exact::Brackets;
use crate::accuracy::exact::estimate::Estimate;
use crate::exact::{Root, compare_roots};
use crate::proofs::toy::floats::{Format, Toy};
use std::println;
use std::vec::Vec;

formats! {
    Single3: 3, Double11;
    Double11: 11, Self;
    Single4: 4, Double13;
    Double13: 13, Self;
    Short: 3, Double6;
    Double6: 6, Self;
    Control: 3, ControlDouble, MARGIN: f64 = 0.125;
    ControlDouble: 6, Self, MARGIN: f64 = 0.125;
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

/// Counts cases that are decided right, decided wrong, and not decided.
fn decided<F: Format>(bits: u32, end: i64) -> [u64; 3] {
    let mut counts = [0; 3];
    plane(bits, &[0], end, |case| {
        let truth = case.truth();
        let roots = truth.roots(|root| truth.rounded::<F>(root));
        let [near, far] = roots.unwrap_or([-1.0, 1.0]);
        let infinity = f64::INFINITY;
        for [t_min, t_max, limit] in [
            [-infinity, infinity, infinity],
            [neighbour::<F>(near, 1.0), far, infinity],
            [0.0, infinity, near],
        ] {
            let (rays, (center, radius)) = (case.rays::<F>([t_min, t_max]), case.sphere());
            let brackets = Brackets::new(&rays, center, radius, true);
            let (t, decided) = brackets.decide(&rays, Toy::new(limit));
            let accepted = |t: &f64| t_min <= *t && *t <= t_max;
            let answer = roots.into_iter().flatten().find(accepted).unwrap_or(infinity);
            let right = t.get() == answer || t.get() == infinity && answer > limit;
            counts[if decided { usize::from(!right) } else { 2 }] += 1;
        }
    });
    counts
}

#[test]
fn what_is_decided_is_right() {
    for (name, [right, wrong, open]) in [
        ("3 bits in 11", decided::<Single3>(3, 28)),
        ("4 bits in 13", decided::<Single4>(4, 14)),
        ("3 bits in 6", decided::<Short>(3, 28)),
    ] {
        println!("{name}: {right} right, {open} left to exact sums");
        assert!(wrong == 0, "{name}: {wrong} are decided wrong");
        assert!(right > 100_000 && open > 1_000, "{name}: {right}, {open}");
    }
    let [_, wrong, _] = decided::<Control>(3, 28);
    println!("with an eighth of the bounds {wrong} are decided wrong");
    assert!(wrong > 0, "no case is hard");
}

/// Counts pairs of roots of one ray and two spheres: in the order that the brackets tell, told wrong, not told.
fn ordered<F: Format>(constants: &Constants) -> [u64; 3] {
    let mut counts = [0; 3];
    let both = signed(&short_integers(3, 8));
    for d in [[5, 3], [7, 6]] {
        let mut roots: Vec<(Case, Root, f64, [f64; 2])> = Vec::new();
        for (cx, cy) in pairs(&both, &both) {
            for r in short_integers(3, 12) {
                let case = Case::in_plane([0, 0], d, [cx, cy], r);
                let (truth, estimate) = (case.truth(), case.estimate::<F>(constants));
                let Estimate { discriminant, error, near, far } = estimate;
                if discriminant.get() > error.get() && truth.discriminant >= 0 {
                    for ((t, bound), root) in [(near, Root::Near), (far, Root::Far)] {
                        let bracket = [(t - bound).get(), (t + bound).get()];
                        roots.push((case, root, truth.about(root), bracket));
                    }
                }
            }
        }
        for (one, root, t, [_, high]) in &roots {
            for (other, other_root, other_t, [low, _]) in &roots {
                let (told, apart) = (high < low, other_t - t);
                // Doubles know it, unless the roots are the same or nearly.
                let less = if apart.abs() > 1e-9 {
                    apart > 0.0
                } else {
                    told && compare_roots((&one.terms(), *root), (&other.terms(), *other_root))
                        .is_lt()
                };
                counts[if told { usize::from(!less) } else { 2 }] += 1;
            }
        }
    }
    counts
}

#[test]
fn two_hits_are_told_apart_right() {
    for (name, [right, wrong, open]) in [
        ("11 bits", ordered::<Double11>(&Constants::of(Double11::U))),
        ("6 bits", ordered::<Double6>(&Constants::of(Double6::U))),
    ] {
        println!("{name}: {right} pairs in order, {open} left to exact sums or in the other order");
        assert!(wrong == 0, "{name}: {wrong} wrong");
        assert!(right > 100_000 && open > right, "{name}: {right}, {open}");
    }
    let [_, wrong, _] = ordered::<Double6>(&Constants::of(Double6::U / 64.0));
    println!("with a sixty-fourth of the bounds {wrong} are wrong");
    assert!(wrong > 0, "no pair is hard");
}
