//! A fuzzer's bytes become geometry. Most numbers are bounded, so that lines do meet spheres, and single ulps lead from
//! there to hard decisions. Raw random bits would be huge or NaN.

use spherule_kernel::{Ray, Sphere, Vec3};

/// Rays, each with the sphere that it is aimed at, and the list of spheres.
///
/// With the feature `arbitrary` a fuzz target can take this type.
#[derive(Clone, Debug)]
pub struct AimedScene {
    /// 1 to 16 rays.
    pub rays: Vec<Ray>,
    /// For every ray the index, in `spheres`, of the sphere that it is aimed at.
    pub aims: Vec<usize>,
    /// 1 to 20 spheres.
    pub spheres: Vec<Sphere>,
}

impl AimedScene {
    /// Makes a scene of any bytes; missing bytes are zero.
    #[must_use]
    pub fn from_bytes(bytes: &[u8]) -> Self {
        let mut bytes = Bytes(bytes);
        let counts = bytes.next();
        let spheres: Vec<_> = (0..=counts % 20).map(|_| bytes.sphere()).collect();
        let (mut rays, mut aims) = (Vec::new(), Vec::new());
        for _ in 0..=counts / 16 {
            let aim = usize::from(bytes.next()) % spheres.len();
            let last = rays.last().copied();
            rays.push(bytes.ray(&spheres[aim], last));
            aims.push(aim);
        }
        Self { rays, aims, spheres }
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> arbitrary::Arbitrary<'a> for AimedScene {
    fn arbitrary(bytes: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
        let all = bytes.len();
        Ok(Self::from_bytes(bytes.bytes(all)?))
    }

    fn arbitrary_take_rest(bytes: arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
        Ok(Self::from_bytes(bytes.take_rest()))
    }
}

/// The bytes that are left.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn next(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    fn signed(&mut self) -> i32 {
        i32::from(i8::from_ne_bytes([self.next()]))
    }

    /// A number: most often one with few bits and a small exponent.
    fn number(&mut self) -> f32 {
        match self.next() {
            0..=95 => self.signed() as f32 / 16.0,
            96..=159 => {
                let significand = self.signed() * 256 + i32::from(self.next());
                significand as f32 * power(self.signed() % 24 - 15)
            }
            160..=207 => {
                let number = self.number_of_few_bits();
                ulps(number, self.signed() % 16)
            }
            208..=231 => self.signed() as f32 * power(self.signed() / 3),
            232..=243 => f32::from_bits(u32::from_be_bytes([(); 4].map(|()| self.next()))),
            special => SPECIAL[usize::from(special - 244)],
        }
    }

    fn number_of_few_bits(&mut self) -> f32 {
        self.signed() as f32 * power(self.signed() % 8)
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::from_array([(); 3].map(|()| self.number()))
    }

    fn sphere(&mut self) -> Sphere {
        let center = self.vector();
        let radius = self.number();
        // One in eight keeps its sign: a negative radius is a case of its own, but only one.
        let radius = if self.next().is_multiple_of(8) { radius } else { radius.abs() };
        Sphere { center, radius }
    }

    fn ray(&mut self, aim: &Sphere, last: Option<Ray>) -> Ray {
        let Sphere { center, radius } = *aim;
        let mut ray = match (self.next() % 8, last) {
            // Beside the sphere, parallel to an axis: an exact tangent, and its neighbours.
            (0 | 1, _) => {
                let (along, across) = self.axes();
                let origin = center + across * radius + along * self.number();
                Ray::new(self.walked(origin), along * self.number())
            }
            // Towards a point near the surface.
            (2 | 3, _) => {
                let origin = self.vector();
                let (along, across) = self.axes();
                let target = center + across * radius + along * self.number();
                Ray::new(origin, self.walked(target - origin))
            }
            // From the surface, or the centre.
            (4, _) => {
                let (along, across) = self.axes();
                let origin =
                    if self.next().is_multiple_of(4) { center } else { center + along * radius };
                Ray::new(self.walked(origin), across * self.number() + along * self.number())
            }
            // The neighbour of the ray before.
            (5, Some(last)) => Ray {
                origin: self.walked(last.origin),
                direction: self.walked(last.direction),
                ..last
            },
            // From the origin of the ray before, or beside that ray: depth lists and coherent packets are for such
            // rays.
            (7, Some(last)) => match self.next() % 2 {
                0 => Ray::new(last.origin, self.vector()),
                _ => Ray::new(self.vector(), last.direction),
            },
            _ => Ray::new(self.vector(), self.vector()),
        };
        match self.next() % 8 {
            0 => ray.t_min = self.number(),
            1 => ray.t_max = self.number(),
            2 => (ray.t_min, ray.t_max) = (f32::NEG_INFINITY, self.number()),
            3 => (ray.t_min, ray.t_max) = (self.number(), self.number()),
            _ => {}
        }
        ray
    }

    /// Two different coordinate axes.
    fn axes(&mut self) -> (Vec3, Vec3) {
        let byte = self.next();
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let (first, further) = (usize::from(byte % 3), usize::from(byte / 3 % 2));
        (axes[first], axes[(first + 1 + further) % 3])
    }

    /// One coordinate a few ulps off.
    fn walked(&mut self, mut v: Vec3) -> Vec3 {
        let axis = usize::from(self.next() % 3);
        v[axis] = ulps(v[axis], self.signed() / 8);
        v
    }
}

const SPECIAL: [f32; 12] = [
    0.0,
    -0.0,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    f32::MAX,
    f32::MIN,
    f32::MIN_POSITIVE,
    1e-45,
    -1e-45,
    1.0,
    16_777_216.0,
];

/// 2^exponent.
fn power(exponent: i32) -> f32 {
    2.0_f32.powi(exponent)
}

/// The number that lies `steps` further among all floats.
fn ulps(mut number: f32, steps: i32) -> f32 {
    for _ in 0..steps.unsigned_abs() {
        number = if steps > 0 { number.next_up() } else { number.next_down() };
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_bytes_make_a_scene() {
        for bytes in [&[][..], &[255], &[255; 4000], &[0; 7]] {
            let scene = AimedScene::from_bytes(bytes);
            assert!((1..=20).contains(&scene.spheres.len()));
            assert!((1..=16).contains(&scene.rays.len()));
        }
    }
}
