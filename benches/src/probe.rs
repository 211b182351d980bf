//! What the machine's arithmetic can do at best, in registers: the mark for brute force.
//!
//! A test of a ray against a sphere by the textbook discriminant costs 3 subtractions, 8 products (6
//! of them fused with a sum), 1 maximum and a quarter of a comparison: [`TEXTBOOK`]. That is the
//! mark, whatever the kernel does; its own filter needs fewer operations, [`FILTER`], so that it
//! may pass the mark, and its own floor is told beside. Two probes say what an operation is worth:
//!
//! * [`fused`]: nothing but independent fused operations. The **FMA limit** of a test is
//!   `TEXTBOOK * time of one`: what a test would cost if every operation took the slot of a
//!   fused one. On CPUs where all vector arithmetic shares two ports (Intel) it is a floor for the
//!   time. On AMD's Zen it is not: sums, differences and comparisons have ports of their own, so
//!   that a share above 1 is possible, and 512-bit operations are passed in two halves on Zen 4.
//! * [`mix`]: the operations of a textbook test themselves, without memory: what a kernel would cost that
//!   loads, stores, counts and branches for nothing. It knows the ports of the machine.
//!
//! Where the target has no fused operation (a plain x86-64 build) a fused one is a product and a
//! sum, and costs as both; the formula is the same.

use spherule_kernel::{LaneMask, Lanes};
use std::hint::black_box;

/// Operations of a test by the textbook discriminant: 3 sub + 8 mul or fma + 1 max + 1/4 compare.
pub const TEXTBOOK: f64 = 12.25;
/// Operations of a test by the kernel's miss filter: 7 fma + 1 max + 1/4 compare.
pub const FILTER: f64 = 8.25;
/// Chains of fused operations: enough to hide a latency of 4 at 2 a cycle, and few enough for 16
/// registers.
const CHAINS: usize = 12;
/// Tests under one comparison.
const GROUP: usize = 4;

/// Runs `rounds * 12` fused operations of `L` and answers how many lane operations that was.
#[inline(never)]
pub fn fused<L: Lanes<Token = ()>>(rounds: usize) -> usize {
    // Values that the optimiser cannot know and that stay normal: x -> x * factor + addend.
    let factor = L::splat((), black_box(0.999));
    let addend = L::splat((), black_box(0.001));
    let mut chains = [0; CHAINS].map(|_: i32| L::splat((), black_box(1.5)));
    for _ in 0..rounds {
        for chain in &mut chains {
            *chain = chain.filter_mul_add(factor, addend);
        }
    }
    for chain in chains {
        black_box(chain.store());
    }
    rounds * CHAINS * L::COUNT
}

/// Runs the arithmetic of `groups * 4` sphere tests of `L` and answers how many lane tests that was.
#[inline(never)]
pub fn mix<L: Lanes<Token = ()>>(groups: usize) -> usize {
    let unknown = |value: f32| L::splat((), black_box(value));
    let origin = [unknown(1e-3), unknown(-2e-3), unknown(1.5e-3)];
    let direction = [unknown(0.6), unknown(-0.3), unknown(0.7)];
    let (a, minus_r2, threshold) = (unknown(0.94), unknown(-0.25), unknown(1e30));
    let [dx, dy, dz] = direction;
    // Each test starts where the last one ended, so that no subtraction can be shared.
    let [mut x, mut y, mut z] = [unknown(1.0), unknown(2.0), unknown(3.0)];
    let mut candidates = 0;
    for _ in 0..groups {
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
    groups * GROUP * L::COUNT
}
