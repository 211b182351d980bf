//! A list of spheres that owns its columns.

use super::sphere::{Sphere, Spheres};
use alloc::vec::Vec;

/// Spheres in memory of their own, coordinate by coordinate: the owned form of [`Spheres`].
///
/// Made from anything that becomes a [`Sphere`]: rows `[f32; 4]`, glam's vectors, pairs of centre and
/// radius, slices, arrays or vectors of them, given or lent, any iterator. 16 bytes a sphere.
///
/// ```
/// use spherule_kernel::{Sphere, SphereList, Vec3, Vec4};
///
/// let rows = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
/// let vectors: SphereList = [Vec4::new(0.0, 0.0, 5.0, 1.0)].into_iter().collect();
/// let pairs: SphereList = [(Vec3::Z, 0.5)].into_iter().collect();
/// let spheres = SphereList::from(&[Sphere { center: Vec3::Z, radius: 0.5 }][..]);
/// assert_eq!((rows.len(), vectors.len()), (2, 1));
/// assert_eq!(pairs.spheres().get(0), spheres.spheres().get(0));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SphereList {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    r: Vec<f32>,
}

impl SphereList {
    /// An empty list.
    ///
    /// ```
    /// use spherule_kernel::SphereList;
    ///
    /// assert!(SphereList::new().is_empty());
    /// ```
    #[must_use]
    pub const fn new() -> Self {
        Self { x: Vec::new(), y: Vec::new(), z: Vec::new(), r: Vec::new() }
    }

    /// Appends a sphere.
    ///
    /// ```
    /// use spherule_kernel::SphereList;
    ///
    /// let mut list = SphereList::new();
    /// list.push([0.0, 0.0, 5.0, 1.0]);
    /// assert_eq!(list.len(), 1);
    /// ```
    pub fn push(&mut self, sphere: impl Into<Sphere>) {
        let Sphere { center, radius } = sphere.into();
        self.x.push(center.x);
        self.y.push(center.y);
        self.z.push(center.z);
        self.r.push(radius);
    }

    /// Replaces sphere `index`. Returns whether there is one: past the end, nothing changes.
    ///
    /// ```
    /// use spherule_kernel::SphereList;
    ///
    /// let mut list = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// assert!(list.set(0, [0.0, 0.0, 6.0, 1.0]));
    /// assert!(!list.set(1, [0.0, 0.0, 7.0, 1.0]));
    /// assert_eq!(list, SphereList::from([[0.0, 0.0, 6.0, 1.0]]));
    /// ```
    pub fn set(&mut self, index: usize, sphere: impl Into<Sphere>) -> bool {
        let Self { x, y, z, r } = self;
        let (Some(x), Some(y), Some(z), Some(r)) =
            (x.get_mut(index), y.get_mut(index), z.get_mut(index), r.get_mut(index))
        else {
            return false;
        };
        let Sphere { center, radius } = sphere.into();
        (*x, *y, *z, *r) = (center.x, center.y, center.z, radius);
        true
    }

    /// Removes all spheres. The list keeps its memory for the next ones.
    ///
    /// ```
    /// use spherule_kernel::SphereList;
    ///
    /// let mut list = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// list.clear();
    /// list.extend([[0.0, 0.0, 6.0, 1.0]]);
    /// assert_eq!(list, SphereList::from([[0.0, 0.0, 6.0, 1.0]]));
    /// ```
    pub fn clear(&mut self) {
        for column in [&mut self.x, &mut self.y, &mut self.z, &mut self.r] {
            column.clear();
        }
    }

    /// Writes spheres over those of the list, from the first on, as far as both go.
    pub(super) fn overwrite(&mut self, spheres: impl Iterator<Item: Into<Sphere>>) {
        let Self { x, y, z, r } = self;
        let places = x.iter_mut().zip(y).zip(z.iter_mut().zip(r));
        for (((x, y), (z, r)), sphere) in places.zip(spheres) {
            let Sphere { center, radius } = sphere.into();
            (*x, *y, *z, *r) = (center.x, center.y, center.z, radius);
        }
    }

    /// How many spheres.
    ///
    /// ```
    /// use spherule_kernel::SphereList;
    ///
    /// let list = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert_eq!(list.len(), 2);
    /// ```
    #[must_use]
    pub const fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there are no spheres.
    ///
    /// ```
    /// use spherule_kernel::SphereList;
    ///
    /// let list = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert!(!list.is_empty());
    /// ```
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// The list, borrowed: the first 2^32 - 1 spheres, since a hit can name no more.
    ///
    /// ```
    /// use spherule_kernel::SphereList;
    ///
    /// let list = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert_eq!(list.spheres().get(1).map(|sphere| sphere.center.z), Some(9.0));
    /// ```
    #[must_use]
    #[inline]
    pub fn spheres(&self) -> Spheres<'_> {
        Spheres::first_of(&self.x, &self.y, &self.z, &self.r)
    }
}

impl<S: Into<Sphere>> FromIterator<S> for SphereList {
    fn from_iter<I: IntoIterator<Item = S>>(spheres: I) -> Self {
        let mut list = Self::new();
        list.extend(spheres);
        list
    }
}

impl<S: Into<Sphere>> Extend<S> for SphereList {
    fn extend<I: IntoIterator<Item = S>>(&mut self, spheres: I) {
        let spheres = spheres.into_iter();
        let (more, _) = spheres.size_hint();
        for column in [&mut self.x, &mut self.y, &mut self.z, &mut self.r] {
            column.reserve(more);
        }
        for sphere in spheres {
            self.push(sphere);
        }
    }
}

impl<S: Into<Sphere> + Copy> From<&[S]> for SphereList {
    fn from(spheres: &[S]) -> Self {
        spheres.iter().copied().collect()
    }
}

impl<S: Into<Sphere> + Copy, const N: usize> From<&[S; N]> for SphereList {
    fn from(spheres: &[S; N]) -> Self {
        spheres.iter().copied().collect()
    }
}

impl<S: Into<Sphere> + Copy> From<&Vec<S>> for SphereList {
    fn from(spheres: &Vec<S>) -> Self {
        spheres.iter().copied().collect()
    }
}

impl<S: Into<Sphere>> From<Vec<S>> for SphereList {
    fn from(spheres: Vec<S>) -> Self {
        spheres.into_iter().collect()
    }
}

impl<S: Into<Sphere>, const N: usize> From<[S; N]> for SphereList {
    fn from(spheres: [S; N]) -> Self {
        spheres.into_iter().collect()
    }
}

impl From<&SphereList> for SphereList {
    fn from(spheres: &SphereList) -> Self {
        spheres.clone()
    }
}

impl From<Spheres<'_>> for SphereList {
    fn from(spheres: Spheres<'_>) -> Self {
        spheres.iter().collect()
    }
}
