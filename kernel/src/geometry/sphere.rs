//! Spheres: one, a borrowed list, and one a lane.

use crate::lanes::LaneArray;
use core::fmt;
use glam::{Vec3, Vec4};

/// The surface `|x - center| = radius`.
///
/// Radius zero (of either sign) is the point `center`. A negative radius, or NaN or infinity
/// anywhere, is a sphere that nothing hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The centre, in the units of the scene.
    pub center: Vec3,
    /// The radius, in the same units.
    pub radius: f32,
}

impl Sphere {
    /// The centre as an array: an index into it is checked at compile time, an index into a [`Vec3`] at run time.
    #[inline(always)]
    pub(crate) fn center(&self) -> [f32; 3] {
        [self.center.x, self.center.y, self.center.z]
    }

    /// Whether the sphere is a surface at all: every number finite, the radius not negative.
    ///
    /// ```
    /// use spherule_kernel::Sphere;
    ///
    /// let sphere = Sphere::from([0.0, 0.0, 5.0, 1.0]);
    /// assert!(sphere.is_valid() && !Sphere { radius: -1.0, ..sphere }.is_valid());
    /// ```
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.center.is_finite() && self.radius.is_finite() && self.radius >= 0.0
    }
}

/// Centre and radius as a row: x, y, z, r.
impl From<[f32; 4]> for Sphere {
    #[inline]
    fn from([x, y, z, radius]: [f32; 4]) -> Self {
        Self { center: Vec3::new(x, y, z), radius }
    }
}

/// A copy, so that an iterator that lends spheres becomes a list.
///
/// ```
/// # #[cfg(feature = "alloc")] {
/// use spherule_kernel::{Sphere, SphereList};
///
/// let spheres = [[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, -1.0]].map(Sphere::from);
/// let valid: SphereList = spheres.iter().filter(|sphere| sphere.is_valid()).collect();
/// assert_eq!(valid.len(), 1);
/// # }
/// ```
impl From<&Self> for Sphere {
    #[inline]
    fn from(sphere: &Self) -> Self {
        *sphere
    }
}

/// The radius is `w`.
impl From<Vec4> for Sphere {
    #[inline]
    fn from(row: Vec4) -> Self {
        row.to_array().into()
    }
}

impl From<(Vec3, f32)> for Sphere {
    #[inline]
    fn from((center, radius): (Vec3, f32)) -> Self {
        Self { center, radius }
    }
}

/// The centre is an array, as other crates' vectors become.
///
/// ```
/// use spherule_kernel::{Sphere, Vec3};
///
/// let sphere = Sphere { center: Vec3::new(0.0, 0.0, 5.0), radius: 1.0 };
/// assert_eq!(Sphere::from(([0.0, 0.0, 5.0], 1.0)), sphere);
/// ```
impl From<([f32; 3], f32)> for Sphere {
    #[inline]
    fn from((center, radius): ([f32; 3], f32)) -> Self {
        Self { center: Vec3::from_array(center), radius }
    }
}

/// A list of spheres in the caller's memory, coordinate by coordinate.
///
/// Sphere `i` is `(x[i], y[i], z[i])` with radius `r[i]`, and `i` is the index that a hit names.
/// No padding or alignment is needed.
#[derive(Clone, Copy, Debug)]
pub struct Spheres<'a> {
    x: &'a [f32],
    y: &'a [f32],
    z: &'a [f32],
    r: &'a [f32],
}

/// Why four slices are no list of spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpheresError {
    /// The slices have different lengths.
    UnequalLengths,
    /// More spheres than a hit can name: the index is a `u32`, and its last value means "none".
    TooMany,
}

impl fmt::Display for SpheresError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::UnequalLengths => "the coordinate slices of the spheres differ in length",
            Self::TooMany => "more spheres than 2^32 - 1",
        })
    }
}

impl core::error::Error for SpheresError {}

impl<'a> Spheres<'a> {
    /// Borrows centres and radii.
    ///
    /// # Errors
    /// [`SpheresError`] where the lengths differ or exceed 2^32 - 1.
    ///
    /// ```
    /// use spherule_kernel::{Spheres, SpheresError};
    ///
    /// assert_eq!(Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).map(|list| list.len()), Ok(1));
    /// assert!(Spheres::new(&[0.0], &[], &[5.0], &[1.0]).is_err());
    /// ```
    pub const fn new(
        x: &'a [f32],
        y: &'a [f32],
        z: &'a [f32],
        r: &'a [f32],
    ) -> Result<Self, SpheresError> {
        if x.len() != y.len() || x.len() != z.len() || x.len() != r.len() {
            return Err(SpheresError::UnequalLengths);
        }
        if x.len() as u64 > u32::MAX as u64 {
            return Err(SpheresError::TooMany);
        }
        Ok(Self { x, y, z, r })
    }

    /// As many spheres as all four columns hold, and as an index can name.
    #[cfg(feature = "alloc")]
    #[inline]
    pub(super) fn first_of(x: &'a [f32], y: &'a [f32], z: &'a [f32], r: &'a [f32]) -> Self {
        let count = x.len().min(y.len()).min(z.len()).min(r.len()).min(u32::MAX as usize);
        let first = |column: &'a [f32]| column.get(..count).unwrap_or_default();
        Self { x: first(x), y: first(y), z: first(z), r: first(r) }
    }

    /// How many spheres.
    ///
    /// ```
    /// use spherule_kernel::Spheres;
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// assert_eq!(spheres.len(), 1);
    /// ```
    #[must_use]
    pub const fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there are no spheres.
    ///
    /// ```
    /// use spherule_kernel::Spheres;
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// assert!(!spheres.is_empty());
    /// ```
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Sphere `index`; `None` past the end.
    ///
    /// ```
    /// use spherule_kernel::{Sphere, Spheres};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// assert_eq!(spheres.get(0), Some(Sphere::from([0.0, 0.0, 5.0, 1.0])));
    /// assert_eq!(spheres.get(1), None);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn get(&self, index: usize) -> Option<Sphere> {
        Some(Sphere {
            center: Vec3::new(*self.x.get(index)?, *self.y.get(index)?, *self.z.get(index)?),
            radius: *self.r.get(index)?,
        })
    }

    /// Returns the columns as they were given: x, y, z and radii, all of one length.
    ///
    /// ```
    /// use spherule_kernel::Spheres;
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let [_, _, z, radii] = spheres.columns();
    /// assert_eq!((z, radii), (&[5.0][..], &[1.0][..]));
    /// ```
    #[must_use]
    #[inline(always)]
    pub const fn columns(&self) -> [&'a [f32]; 4] {
        [self.x, self.y, self.z, self.r]
    }

    /// The spheres in the order of their indices.
    ///
    /// ```
    /// use spherule_kernel::Spheres;
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// assert_eq!(spheres.iter().map(|sphere| sphere.radius).sum::<f32>(), 1.0);
    /// ```
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Sphere> + use<'a> {
        let Self { x, y, z, r } = *self;
        x.iter()
            .zip(y)
            .zip(z.iter().zip(r))
            .map(|((&x, &y), (&z, &radius))| Sphere { center: Vec3::new(x, y, z), radius })
    }
}

/// One sphere a lane, in plain arrays, for ray `i` against sphere `i`: sixteen unless `A` says
/// otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct SpherePacket<A: LaneArray = [f32; 16]> {
    alignment: A::Alignment,
    pub(crate) center: [A; 3],
    pub(crate) radius: A,
}

impl<A: LaneArray> SpherePacket<A> {
    /// Sphere `i` in lane `i`; lanes past the end of `spheres` hold a sphere that nothing hits,
    /// spheres past the last lane are left out.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     HitPacket, Level, Ray, RayPacket, SpherePacket, Tier, Vec3, pair_packets,
    /// };
    ///
    /// let spheres = SpherePacket::new(&[[0.0, 0.0, 5.0, 1.0].into()]);
    /// let rays = RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]);
    /// let mut hits = [HitPacket::none()];
    /// pair_packets(Tier::Exact, Level::best(), &[rays], &[spheres], &mut hits);
    /// assert_eq!(hits[0].hits().flatten().count(), 1);
    /// ```
    #[must_use]
    pub fn new(spheres: &[Sphere]) -> Self {
        let (center, radius) = ([A::ZEROS; 3], A::filled(-1.0));
        let mut packet = Self { alignment: A::ALIGNMENT, center, radius };
        for (lane, sphere) in spheres.iter().take(A::COUNT).enumerate() {
            let center = sphere.center.to_array();
            for axis in 0..3 {
                packet.center[axis].set(lane, center[axis]);
            }
            packet.radius.set(lane, sphere.radius);
        }
        packet
    }
}
