//! One ray, one sphere: a case is drawn, kept, shrunk and, if a test fails, printed.
//!
//! Decimal digits hide the last bit, so numbers are printed as hexadecimal floats, with their bits
//! beside them: read the value, paste the bits into a test.

use spherule_kernel::{Ray, Sphere, Vec3};
use std::fmt;

/// A ray and a sphere for it.
#[derive(Clone, Copy, PartialEq)]
pub struct Case {
    /// The ray, interval included.
    pub ray: Ray,
    /// The sphere.
    pub sphere: Sphere,
}

impl Case {
    /// How many numbers make a case.
    pub const NUMBERS: usize = 12;

    /// From origin, direction, `t_min`, `t_max`, centre and radius, in this order.
    #[must_use]
    pub const fn from_numbers(numbers: [f32; Self::NUMBERS]) -> Self {
        let [ox, oy, oz, dx, dy, dz, t_min, t_max, cx, cy, cz, radius] = numbers;
        Self {
            ray: Ray {
                origin: Vec3::new(ox, oy, oz),
                direction: Vec3::new(dx, dy, dz),
                t_min,
                t_max,
            },
            sphere: Sphere { center: Vec3::new(cx, cy, cz), radius },
        }
    }

    /// The inverse of [`Case::from_numbers`], bit for bit.
    #[must_use]
    pub fn numbers(&self) -> [f32; Self::NUMBERS] {
        let ([ox, oy, oz], [dx, dy, dz]) =
            (self.ray.origin.to_array(), self.ray.direction.to_array());
        let [cx, cy, cz] = self.sphere.center.to_array();
        let Ray { t_min, t_max, .. } = self.ray;
        [ox, oy, oz, dx, dy, dz, t_min, t_max, cx, cy, cz, self.sphere.radius]
    }

    /// The bits of [`Case::numbers`].
    #[must_use]
    pub fn bits(&self) -> [u32; Self::NUMBERS] {
        self.numbers().map(f32::to_bits)
    }

    /// The inverse of [`Case::bits`].
    #[must_use]
    pub fn from_bits(bits: [u32; Self::NUMBERS]) -> Self {
        Self::from_numbers(bits.map(f32::from_bits))
    }
}

impl fmt::Debug for Case {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}\n  {}", HexRay(&self.ray), HexSphere(&self.sphere))
    }
}

/// A number as a hexadecimal float with its bits.
#[derive(Clone, Copy, Debug)]
pub struct Hex(pub f32);

impl fmt::Display for Hex {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (value, bits) = (self.0, self.0.to_bits());
        let sign = if value.is_sign_negative() { "-" } else { "" };
        let (exponent, fraction) = (i64::from(bits >> 23 & 0xff), bits & 0x007f_ffff);
        match (exponent, fraction) {
            (255, 0) => write!(formatter, "{sign}inf")?,
            (255, _) => write!(formatter, "{sign}nan")?,
            (0, 0) => write!(formatter, "{sign}0")?,
            // Six hexadecimal digits hold one bit more than the 23 bits of the fraction.
            (0, _) => write!(formatter, "{sign}0x0.{:06x}p-126", fraction << 1)?,
            _ => write!(formatter, "{sign}0x1.{:06x}p{}", fraction << 1, exponent - 127)?,
        }
        write!(formatter, " [{bits:08x}]")
    }
}

/// A ray, number by number.
#[derive(Clone, Copy, Debug)]
pub struct HexRay<'a>(pub &'a Ray);

impl fmt::Display for HexRay<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Ray { origin, direction, t_min, t_max } = self.0;
        write!(formatter, "ray from {} along {}", HexPoint(*origin), HexPoint(*direction))?;
        write!(formatter, " in [{}, {}]", Hex(*t_min), Hex(*t_max))
    }
}

/// A sphere, number by number.
#[derive(Clone, Copy, Debug)]
pub struct HexSphere<'a>(pub &'a Sphere);

impl fmt::Display for HexSphere<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Sphere { center, radius } = self.0;
        write!(formatter, "sphere at {} of radius {}", HexPoint(*center), Hex(*radius))
    }
}

struct HexPoint(Vec3);

impl fmt::Display for HexPoint {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.to_array().map(Hex);
        write!(formatter, "({x}, {y}, {z})")
    }
}
