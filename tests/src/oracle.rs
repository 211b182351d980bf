//! The answers, from big integers: slow, obvious, and without a float in any decision.
//!
//! Every finite `f32` is an integer multiple of 2^-149, so origin, direction, centre and radius
//! become integers in that unit, and with p = c - o
//!
//! ```text
//! a = d.d    b = d.p    D = b^2 - a (p.p - r^2)    t = (b -+ sqrt D) / a
//! ```
//!
//! the first three are integers too. The unit cancels in t. How a real number rounds to `f32` depends only on its place
//! among the multiples of 2^-150, since every `f32` and every midpoint between two is such a multiple. So the largest
//! multiple not above t, and whether t exceeds it, say everything.
//!
//! The rules are those of the contract: 1 invalid input hits nothing; 2 D = 0 is a hit; 3 a root counts if its rounded
//! value T is finite and in `[t_min, t_max]`; 4 the smaller such T is the answer; 5 over several spheres the smallest
//! root as a real number wins, then the lowest index.

use num_bigint::{BigInt, Sign};
use num_traits::{One, Zero};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Vec3};
use std::cmp::Ordering;

/// Roots are cut to multiples of 2^-150.
const CUT: u32 = 150;

/// The line and the sphere as a quadratic with integer coefficients.
struct Quadratic {
    a: BigInt,
    b: BigInt,
    discriminant: BigInt,
}

impl Quadratic {
    /// `None` if rule 1 applies.
    fn new(ray: &Ray, sphere: &Sphere) -> Option<Self> {
        let finite = ray.origin.is_finite()
            && ray.direction.is_finite()
            && sphere.center.is_finite()
            && sphere.radius.is_finite();
        if !finite {
            return None;
        }
        let (o, d, c) = (units3(ray.origin), units3(ray.direction), units3(sphere.center));
        let r = units(sphere.radius);
        if d.iter().all(BigInt::is_zero) || r.sign() == Sign::Minus {
            return None;
        }
        let p = [&c[0] - &o[0], &c[1] - &o[1], &c[2] - &o[2]];
        let (a, b) = (dot(&d, &d), dot(&d, &p));
        let discriminant = &b * &b - &a * (dot(&p, &p) - &r * &r);
        Some(Self { a, b, discriminant })
    }

    /// Rule 2.
    fn meets(&self) -> bool {
        self.discriminant.sign() != Sign::Minus
    }

    /// Both roots, the smaller first, for a line that meets the sphere.
    fn roots(&self) -> [CutRoot; 2] {
        let b = &self.b << CUT;
        let square = &self.discriminant << (2 * CUT);
        let root = square.sqrt();
        let root_is_cut = &root * &root != square;
        // Cutting b - sqrt downwards means cutting the square root upwards.
        let near = b.clone() - &root - i32::from(root_is_cut);
        let far = b + root;
        [near, far].map(|numerator| CutRoot::quotient(&numerator, &self.a, root_is_cut))
    }
}

/// A real number in halves of 2^-150. It is even for a multiple of 2^-150, else the odd number between the two
/// multiples around the real number.
struct CutRoot(BigInt);

impl CutRoot {
    fn quotient(numerator: &BigInt, positive: &BigInt, numerator_is_cut: bool) -> Self {
        let truncated = numerator / positive;
        let remainder = numerator - &truncated * positive;
        let floor = if remainder.sign() == Sign::Minus { truncated - 1 } else { truncated };
        Self(floor * 2 + i32::from(numerator_is_cut || !remainder.is_zero()))
    }

    /// Rounds to nearest even, and says whether it was a tie. Subnormals are kept, -0 becomes +0, and the result is
    /// infinite if the magnitude is 2^128 - 2^103 or more.
    fn round(&self) -> (f32, bool) {
        let magnitude = self.0.magnitude();
        // A significand has 24 bits, and its last bit is never worth less than 2^-149: four of the halves of 2^-150.
        let dropped = magnitude.bits().saturating_sub(24).max(2);
        let kept = magnitude >> dropped;
        let rest = magnitude - (&kept << dropped);
        let against_half = (rest << 1u32).cmp(&(num_bigint::BigUint::one() << dropped));
        let odd = kept.bit(0);
        let up = against_half == Ordering::Greater || (against_half == Ordering::Equal && odd);
        let significand = u64::try_from(kept).expect("at most 24 bits") + u64::from(up);
        // The leading bit of the significand, if there is one, adds one to the exponent; a carry out of the significand
        // adds another.
        let bits = ((dropped - 2) << 23).saturating_add(significand).min(0x7f80_0000);
        let value = f32::from_bits(u32::try_from(bits).expect("at most infinity"));
        let negative = self.0.sign() == Sign::Minus && bits != 0;
        (if negative { -value } else { value }, against_half == Ordering::Equal)
    }
}

/// `x` in units of 2^-149.
///
/// # Panics
/// If `x` is NaN or infinite.
#[must_use]
pub fn units(x: f32) -> BigInt {
    assert!(x.is_finite(), "{x} is no multiple of anything");
    let bits = x.to_bits();
    let (exponent, fraction) = (bits >> 23 & 0xff, bits & 0x007f_ffff);
    let magnitude = match exponent {
        0 => BigInt::from(fraction),
        _ => BigInt::from(fraction | 0x0080_0000) << (exponent - 1),
    };
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// [`units`] of each coordinate.
#[must_use]
pub fn units3(v: Vec3) -> [BigInt; 3] {
    v.to_array().map(units)
}

/// The sum of the products of coordinates.
#[must_use]
pub fn dot(v: &[BigInt; 3], w: &[BigInt; 3]) -> BigInt {
    &v[0] * &w[0] + &v[1] * &w[1] + &v[2] * &w[2]
}

/// D in units of 2^-596, the fourth power of the unit of lengths. `None` for invalid input.
#[must_use]
pub fn discriminant(ray: &Ray, sphere: &Sphere) -> Option<BigInt> {
    Quadratic::new(ray, sphere).map(|quadratic| quadratic.discriminant)
}

/// How the distance of a point from the centre compares with the radius. Both must be finite.
#[must_use]
pub fn side(point: Vec3, sphere: &Sphere) -> Ordering {
    let (x, c, r) = (units3(point), units3(sphere.center), units(sphere.radius));
    let q = [0, 1, 2].map(|i| &x[i] - &c[i]);
    dot(&q, &q).cmp(&(&r * &r))
}

/// The bits of two roots: here -0 differs from 0, and a NaN equals itself.
#[must_use]
pub fn root_bits(roots: Option<[f32; 2]>) -> Option<[u32; 2]> {
    roots.map(|roots| roots.map(f32::to_bits))
}

/// How D compares with zero: `Less` is a miss, `Equal` a tangent. `None` for invalid input.
#[must_use]
pub fn discriminant_sign(ray: &Ray, sphere: &Sphere) -> Option<Ordering> {
    discriminant(ray, sphere).map(|discriminant| discriminant.cmp(&BigInt::zero()))
}

/// The unit normal that points out of the sphere, and the point relative to its centre, where the line enters the
/// sphere or, if `leaves`, leaves it; both correctly rounded. `None` for invalid input, a line that misses, and a point
/// sphere.
///
/// With a t = b -+ sqrt D the point is t d - p = (d b - a p -+ d sqrt D) / a.
#[must_use]
pub fn surface(ray: &Ray, sphere: &Sphere, leaves: bool) -> Option<[[f32; 3]; 2]> {
    const BITS: u32 = 2000;
    let Quadratic { a, b, discriminant } = Quadratic::new(ray, sphere)?;
    if discriminant.sign() == Sign::Minus || sphere.radius == 0.0 {
        return None;
    }
    let square = discriminant << (2 * BITS);
    let root = square.sqrt();
    let is_cut = &root * &root != square;
    let (o, d, c) = (units3(ray.origin), units3(ray.direction), units3(sphere.center));
    let r = units(sphere.radius);
    let coordinate = |i: usize, of_normal: bool| {
        let whole: BigInt = (&d[i] * &b - &a * (&c[i] - &o[i])) << BITS;
        let along = if leaves { d[i].clone() } else { -d[i].clone() };
        // Cuts downwards: where the square root is subtracted, the root is cut upwards.
        let up = is_cut && along.sign() == Sign::Minus;
        let numerator = whole + along * (&root + i32::from(up));
        let is_cut = is_cut && d[i].sign() != Sign::NoSign;
        // A point is in units of 2^-149, a normal in units of one.
        let (numerator, scale) =
            if of_normal { (numerator << CUT, &a * &r) } else { (numerator << 1_u32, a.clone()) };
        CutRoot::quotient(&numerator, &(scale << BITS), is_cut).round().0
    };
    let all = |of_normal| [0, 1, 2].map(|i| coordinate(i, of_normal));
    Some([all(true), all(false)])
}

/// Rules 1 and 2: whether the line (not only the ray's interval) meets the sphere.
#[must_use]
pub fn meets(ray: &Ray, sphere: &Sphere) -> bool {
    Quadratic::new(ray, sphere).is_some_and(|quadratic| quadratic.meets())
}

/// Rules 1 and 2, and both roots of the line, correctly rounded, the smaller first.
///
/// The interval does not matter. A root that overflows is infinite.
#[must_use]
pub fn roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
    roots_and_ties(ray, sphere).map(|roots| roots.map(|(root, _)| root))
}

/// [`roots`], each with whether the real root lies midway between two neighbouring `f32`.
#[must_use]
pub fn roots_and_ties(ray: &Ray, sphere: &Sphere) -> Option<[(f32, bool); 2]> {
    let quadratic = Quadratic::new(ray, sphere)?;
    quadratic.meets().then(|| quadratic.roots().map(|root| root.round()))
}

/// Rules 1 to 4: the t of the hit.
#[must_use]
pub fn intersect(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    accepted(ray, roots(ray, sphere)?)
}

/// Rules 3 and 4: which of the rounded roots the ray's interval accepts.
#[must_use]
pub fn accepted(ray: &Ray, roots: [f32; 2]) -> Option<f32> {
    // Comparing two given floats rounds nothing; a comparison with NaN accepts nothing.
    let accepted = |t: &f32| t.is_finite() && ray.t_min <= *t && *t <= ray.t_max;
    roots.into_iter().find(accepted)
}

/// Rules 1 to 5: the closest hit as real numbers, the lowest index among equals.
///
/// # Panics
/// If there are 2^32 spheres or more.
#[must_use]
pub fn closest(ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
    let mut closest: Option<Hit> = None;
    for (index, sphere) in spheres.iter().enumerate() {
        let Some(t) = intersect(ray, sphere) else { continue };
        let hit = Hit { t, sphere: u32::try_from(index).expect("a 32-bit index") };
        if closest.is_none_or(|known| is_closer(Tier::Exact, ray, spheres, hit, known)) {
            closest = Some(hit);
        }
    }
    closest
}

/// Rule 5 for a hit whose index is above that of the closest hit so far, by as much as the tier has to tell.
#[must_use]
pub fn is_closer(tier: Tier, ray: &Ray, spheres: &[Sphere], hit: Hit, known: Hit) -> bool {
    if hit.t != known.t || tier != Tier::Exact {
        // Rounding may make two roots equal, but never swaps them.
        return hit.t < known.t;
    }
    compare(ray, hit.t, [hit, known].map(|hit| &spheres[hit.sphere as usize])).is_lt()
}

/// How the roots of two spheres that `ray` hits, both at T = `t`, compare as real numbers.
///
/// In integers, the roots of one line are (b -+ sqrt D) / a with one a. The product of the four differences of all
/// conjugates of two roots is an integer, and no difference is above 2^560. So numerators that differ do so by 2^-1700
/// or more, and 2000 bits after the point tell.
///
/// # Panics
/// If a sphere is not hit at t.
#[must_use]
pub fn compare(ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
    const BITS: u32 = 2000;
    let numerators = spheres.map(|sphere| {
        let quadratic = Quadratic::new(ray, sphere).expect("a valid ray and sphere");
        let root = (&quadratic.discriminant << (2 * BITS)).sqrt();
        let b = &quadratic.b << BITS;
        if quadratic.roots()[0].round().0 == t { b - root } else { b + root }
    });
    let difference = &numerators[0] - &numerators[1];
    // Each root is cut by less than one.
    if difference.magnitude().bits() <= 2 {
        Ordering::Equal
    } else {
        difference.cmp(&BigInt::zero())
    }
}
