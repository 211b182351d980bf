//! The line x(t) = o + t d and the surface |x - c| = r, exactly.
//!
//! # Method
//!
//! With p = c - o, a = d.d, b = d.p and the power of the origin k = p.p - r^2, the line meets the
//! sphere where a t^2 - 2 b t + k = 0: at t = (b -+ sqrt D) / a with
//! D = b^2 - a k = a r^2 - |d x p|^2 (Lagrange). The second form has fewer terms.
//!
//! The sign of D, as an expansion, decides whether there are roots. A root is then estimated to
//! 16 u (u = 2^-53), which leaves one `f32` it can round to, or two neighbours. Which of two is
//! told by the side of their midpoint m that the root lies on, for which no root need be taken:
//! with v = m d - p, f = |v|^2 - r^2 and g = d.v, half the slope of f along the line,
//!
//! ```text
//! m < t1  iff f > 0 and g < 0        m > t2  iff f > 0 and g > 0
//! m = t1  iff f = 0 and g <= 0       m = t2  iff f = 0 and g >= 0
//! ```
//!
//! Every partial result is a multiple of 2^-598 and below 2^520, so no double over- or underflows:
//! `docs/numerics.md` counts the terms and exponents.

use super::expansion::{Expansion, Float};
use core::cmp::Ordering;
use core::marker::PhantomData;

/// Which of the two roots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Root {
    /// t1, the smaller.
    Near,
    /// t2.
    Far,
}

/// A line that meets a sphere, and estimates of its quadratic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quadratic<F> {
    origin: [f32; 3],
    direction: [f32; 3],
    center: [f32; 3],
    radius: f32,
    float: PhantomData<F>,
    /// t1 and t2, each within 10 u of itself.
    estimates: [f64; 2],
}

impl<F: Float> Quadratic<F> {
    /// `None` if the line misses the sphere; a tangent does not miss it.
    ///
    /// Domain: a valid ray and a valid sphere. Anything else returns too, with no meaning.
    pub(crate) fn new(
        origin: [f32; 3],
        direction: [f32; 3],
        center: [f32; 3],
        radius: f32,
    ) -> Option<Self> {
        let line =
            Self { origin, direction, center, radius, float: PhantomData, estimates: [0.0; 2] };
        let discriminant = line.discriminant()?;

        // q = b + sign(b) sqrt D does not cancel: 4 u of b, 3.5 u of the root, 1 u of the sum.
        // a is within 2 u, k within 4 u; so q / a within 9 u, k / q within 10 u.
        let root = libm::sqrt(discriminant);
        let (b, k) = (line.half_slope(), line.power());
        let a: f64 = direction.iter().map(|&d| f64::from(d) * f64::from(d)).sum();
        let q = if b < 0.0 { b - root } else { b + root };
        // q is zero only where b and D are, and then so is k: both roots are zero.
        let other = if k == 0.0 { 0.0 } else { k / q };
        let estimates = if b < 0.0 { [q / a, other] } else { [other, q / a] };
        Some(Self { estimates, ..line })
    }

    /// The correctly rounded root; +0 for zero, infinite where it rounds so.
    pub(crate) fn rounded(&self, root: Root) -> f32 {
        let estimate = self.estimates[usize::from(root == Root::Far)];
        let error = estimate.abs() * (16.0 * f64::EPSILON / 2.0);
        let (low, high) = ((estimate - error) as f32, (estimate + error) as f32);
        let rounded = if low == high {
            low
        } else {
            match self.compare_with(midpoint(low, high), root) {
                Ordering::Less => low,
                Ordering::Greater => high,
                // The one with an even last bit.
                Ordering::Equal if low.to_bits() & 1 == 0 => low,
                Ordering::Equal => high,
            }
        };
        // Adding zero turns -0 into +0.
        rounded + 0.0
    }

    /// c and o, axis by axis.
    fn center_and_origin(&self) -> impl Iterator<Item = (F, F)> {
        self.center.into_iter().zip(self.origin).map(|(c, o)| (exactly(c), exactly(o)))
    }

    /// D = a r^2 - |d x p|^2, estimated; `None` if it is negative.
    #[inline(never)]
    fn discriminant(&self) -> Option<f64> {
        let mut sum = Expansion::<F, 66>::zero();
        // Each component of d x p from two axes of d, c and o, those after the component's own.
        let ([x, y, z], [cx, cy, cz], [ox, oy, oz]) = (self.direction, self.center, self.origin);
        for (d, c, o) in [
            ([y, z], [cy, cz], [oy, oz]),
            ([z, x], [cz, cx], [oz, ox]),
            ([x, y], [cx, cy], [ox, oy]),
        ] {
            let (d, c, o) = (d.map(exactly::<F>), c.map(exactly::<F>), o.map(exactly::<F>));
            let mut component = Expansion::<F, 4>::zero();
            component.add(d[0] * c[1]);
            component.add(-(d[0] * o[1]));
            component.add(-(d[1] * c[0]));
            component.add(d[1] * o[0]);
            sum.add_square(component.terms());
        }
        let r = exactly::<F>(self.radius);
        for d in self.direction {
            let d = exactly::<F>(d);
            sum.add_product(d * d, -(r * r));
        }
        // So far the sum is -D.
        (sum.sign() != Ordering::Greater).then(|| -sum.estimate())
    }

    /// b = d.p.
    #[inline(never)]
    fn half_slope(&self) -> f64 {
        let mut sum = Expansion::<F, 6>::zero();
        for (d, (c, o)) in self.direction.into_iter().zip(self.center_and_origin()) {
            let d = exactly::<F>(d);
            sum.add(d * c);
            sum.add(-(d * o));
        }
        sum.estimate()
    }

    /// k = p.p - r^2.
    #[inline(never)]
    fn power(&self) -> f64 {
        let mut sum = Expansion::<F, 19>::zero();
        for (c, o) in self.center_and_origin() {
            let mut component = Expansion::<F, 2>::zero();
            component.add(c);
            component.add(-o);
            sum.add_square(component.terms());
        }
        sum.add(-(exactly::<F>(self.radius) * exactly::<F>(self.radius)));
        sum.estimate()
    }

    /// How a root compares with `t`, a number of at most 25 significant bits.
    #[inline(never)]
    fn compare_with(&self, t: f64, root: Root) -> Ordering {
        let r = exactly::<F>(self.radius);
        let (mut f, mut g) = (Expansion::<F, 37>::zero(), Expansion::<F, 18>::zero());
        f.add(-(r * r));
        for (d, (c, o)) in self.direction.into_iter().zip(self.center_and_origin()) {
            let d = exactly::<F>(d);
            let mut component = Expansion::<F, 3>::zero();
            component.add(F::from(t) * d);
            component.add(-c);
            component.add(o);
            f.add_square(component.terms());
            for &term in component.terms() {
                g.add_product(d, term);
            }
        }
        let outward = if root == Root::Near { Ordering::Less } else { Ordering::Greater };
        match (f.sign(), g.sign()) {
            (Ordering::Greater, slope) if slope == outward => outward.reverse(),
            (Ordering::Equal, slope) if slope == outward || slope == Ordering::Equal => {
                Ordering::Equal
            }
            _ => outward,
        }
    }
}

fn exactly<F: Float>(single: f32) -> F {
    F::from(f64::from(single))
}

/// The number half-way between neighbours, exactly; an infinity stands for the `f32` that would
/// come next, 2^128, as it does in rounding.
fn midpoint(low: f32, high: f32) -> f64 {
    let end = |single: f32| {
        if single.is_finite() { f64::from(single) } else { TWO_128.copysign(f64::from(single)) }
    };
    (end(low) + end(high)) * 0.5
}

const TWO_128: f64 = 2.0 * (1u128 << 127) as f64;

#[cfg(test)]
mod by_hand;
#[cfg(test)]
mod flops;
