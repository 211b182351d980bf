//! Where the spheres of a scene are.

use spherule_kernel::{Sphere, Spheres};

/// A box around most spheres. Of each axis the least and the greatest hundredth of the spheres are left out, so that a
/// single huge sphere, which rays need not look for, does not hide where the others are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Its least coordinates.
    pub low: [f64; 3],
    /// Its greatest coordinates.
    pub high: [f64; 3],
}

impl Extent {
    /// The extent of the valid spheres; the cube from -1 to 1 if there is none.
    #[must_use]
    pub fn of(spheres: Spheres<'_>) -> Self {
        let valid: Vec<_> = spheres.iter().filter(Sphere::is_valid).collect();
        if valid.is_empty() {
            return Self { low: [-1.0; 3], high: [1.0; 3] };
        }
        let left_out = (valid.len() - 1) / 100;
        let nth = |axis: usize, sign: f64| {
            let out = |sphere: &Sphere| {
                f64::from(sphere.radius) + sign * f64::from(sphere.center.to_array()[axis])
            };
            let mut all: Vec<_> = valid.iter().map(out).collect();
            // The greatest first.
            *all.select_nth_unstable_by(left_out, |a, b| b.total_cmp(a)).1
        };
        let (low, high) =
            ([0, 1, 2].map(|axis| -nth(axis, -1.0)), [0, 1, 2].map(|axis| nth(axis, 1.0)));
        Self { low, high }
    }

    /// Its middle.
    #[must_use]
    pub fn middle(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| (self.low[axis] + self.high[axis]) / 2.0)
    }

    /// Half of its longest side.
    #[must_use]
    pub fn half(&self) -> f64 {
        [0, 1, 2]
            .map(|axis| (self.high[axis] - self.low[axis]) / 2.0)
            .into_iter()
            .fold(0.0, f64::max)
    }
}
