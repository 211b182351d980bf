//! What the machine's arithmetic can do at best, in registers: brute force is measured by it.
//!
//! A test of a ray against a sphere by the textbook discriminant costs [`TEXTBOOK`] operations. The probe [`FUSED`]
//! runs one fused operation a test. The **FMA limit** of a test is `TEXTBOOK` times its time, as if every operation
//! took the slot of a fused one. On CPUs where all vector arithmetic shares two ports (Intel) the limit is a floor for
//! the time. On AMD's Zen, sums, differences and comparisons have ports of their own, so that a share above 1 is
//! possible. The probe [`MIX`] runs the operations of a test without memory: what a kernel would cost if its loads,
//! stores, counts and branches were free. If the target has no fused operation (a plain x86-64 build), a product and a
//! sum replace it.

use super::{Engine, Label, Promise, Query, Run};
use spherule_kernel::{Hit, LaneMask, Lanes, f32x4, f32x8, f32x16};
use std::hint::black_box;

/// Operations of a test by the textbook discriminant: 3 sub + 8 mul or fma + 1 max + 1/4 compare.
pub(crate) const TEXTBOOK: f64 = 12.25;
/// Operations of a test by the kernel's miss filter: 7 fma + 1 max + 1/4 compare.
pub(crate) const FILTER: f64 = 8.25;
/// The name of the probe of fused operations.
pub(crate) const FUSED: &str = "fused operation";
/// The name of the probe of the operations of a textbook test.
pub(crate) const MIX: &str = "operations of a test";
/// Chains of fused operations: enough to hide a latency of 4 at 2 a cycle, and few enough for 16 registers.
const CHAINS: usize = 12;
/// Tests under one comparison.
const GROUP: usize = 4;

/// Both probes in every width, with one operation for every ray and sphere. The best of the widths is the peak, since a
/// plain build has no register of 16 lanes.
pub(crate) fn probes(spheres: usize) -> [Engine; 6] {
    let probe = |name, lanes, run: fn(usize)| Engine {
        label: Label { way: "", name, lanes },
        promise: Promise::Nothing,
        most_rays: usize::MAX,
        ready: Box::new(move |rays| Box::new(Probe { operations: rays.list.len() * spheres, run })),
    };
    [
        probe(FUSED, "f32x4", fused::<f32x4>),
        probe(FUSED, "f32x8", fused::<f32x8>),
        probe(FUSED, "f32x16", fused::<f32x16>),
        probe(MIX, "f32x4", mix::<f32x4>),
        probe(MIX, "f32x8", mix::<f32x8>),
        probe(MIX, "f32x16", mix::<f32x16>),
    ]
}

struct Probe {
    operations: usize,
    run: fn(usize),
}

impl Run for Probe {
    fn run(&mut self, _: Query) {
        (self.run)(self.operations);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        Vec::new()
    }
}

/// Runs about `operations` fused operations in lanes.
#[inline(never)]
fn fused<L: Lanes<Token = ()>>(operations: usize) {
    // Values that the optimiser cannot know and that stay normal: x -> x * factor + addend.
    let factor = L::splat((), black_box(0.999));
    let addend = L::splat((), black_box(0.001));
    let mut chains = [0; CHAINS].map(|_: i32| L::splat((), black_box(1.5)));
    for _ in 0..operations.div_ceil(CHAINS * L::COUNT) {
        for chain in &mut chains {
            *chain = chain.filter_mul_add(factor, addend);
        }
    }
    for chain in chains {
        black_box(chain.store());
    }
}

/// Runs the arithmetic of about `tests` tests in lanes.
#[inline(never)]
fn mix<L: Lanes<Token = ()>>(tests: usize) {
    let unknown = |value: f32| L::splat((), black_box(value));
    let origin = [unknown(1e-3), unknown(-2e-3), unknown(1.5e-3)];
    let [dx, dy, dz] = [unknown(0.6), unknown(-0.3), unknown(0.7)];
    let (a, minus_r2, threshold) = (unknown(0.94), unknown(-0.25), unknown(1e30));
    // Each test starts where the last one ended, so that the compiler can share no subtraction.
    let [mut x, mut y, mut z] = [unknown(1.0), unknown(2.0), unknown(3.0)];
    let mut candidates = 0;
    for _ in 0..tests.div_ceil(GROUP * L::COUNT) {
        let mut largest: Option<L> = None;
        for _ in 0..GROUP {
            (x, y, z) = (x - origin[0], y - origin[1], z - origin[2]);
            let b = z.filter_mul_add(dz, y.filter_mul_add(dy, x * dx));
            let c = z.filter_mul_add(z, y.filter_mul_add(y, x.filter_mul_add(x, minus_r2)));
            let discriminant = b.filter_mul_add(b, -(a * c));
            largest = Some(largest.map_or(discriminant, |l| l.filter_max(discriminant)));
        }
        if largest.is_some_and(|l| threshold.le(l).any()) {
            candidates += 1;
        }
    }
    black_box(candidates);
}
