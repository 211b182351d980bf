//! The miss filter: eight operations a ray and sphere that rule out nearly every miss, and
//! nothing else.
//!
//! # Method
//!
//! Scale space by a power of two, shift it by some point K near the spheres and scale the direction to
//! unit length. With c = centre - K, o = origin - K and e = d.o, f = 2 o, all known before the loop, the
//! discriminant over d.d is
//!
//! ```text
//! D/a = (d.(c - o))^2 - (|c - o|^2 - r^2) = (d.c - e)^2 + (f.c + w) - |o|^2,   w = r^2 - |c|^2
//! ```
//!
//! so that seven multiply-adds give D/a + |o|^2, and a miss is ruled out where the largest of
//! four such numbers lies below |o|^2. The subtractions c - o, and the multiplication by a, have
//! left the loop. Widening covers what this form cancels: w is raised by kappa (|c|^2 + r^2), once a sphere, and |o|^2
//! is lowered by kappa |o|^2, once a ray. So the bound costs the loop no operation, and a huge or far sphere widens no
//! bound but its own.
//!
//! The bound, kappa = 114 u, and the sizes for which it holds, are proven in `docs/numerics.md`;
//! `tests/proofs` climbs towards it. Sizes are those in the units of a block of spheres. Where a tier's own squares
//! underflow, the filter leaves the decision to the tier. A sphere outside of those sizes passes always (w = +inf), as
//! does a ray (threshold -inf). An invalid sphere passes only with such a ray, and the group's test leaves it out; an inactive ray
//! passes only beside a sphere out of range.
//! Within those rules no NaN can arise, so the maximum of four means what it says.

pub(crate) mod ball;
pub(crate) mod block;
pub(crate) mod frame;
pub(crate) mod rays;

/// How many spheres share one branch.
pub(crate) const GROUP: usize = 4;
/// How many groups are prepared at a time: 2 KiB of stack, and 3 % of the loop spent on rays.
const BLOCK: usize = 32;
/// How many spheres are prepared at a time.
pub(crate) const BLOCK_SPHERES: usize = BLOCK * GROUP;

/// 114 u.
pub(crate) const KAPPA: f32 = 114.0 / 16_777_216.0;
/// 2^-60: no sphere counts as smaller.
pub(crate) const LEAST_SIZE: f32 = 1.0 / (1_u64 << 60) as f32;
