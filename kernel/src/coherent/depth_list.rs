//! Spheres in the order of their depth, for runs of rays that share an origin or a direction: object
//! order joined with image order, without a tree, in memory that the caller provides.
//!
//! # Method
//!
//! [`DepthList`] sorts the spheres by the least depth that a ray may hit them at: the
//! distance from the common origin, or how far they lie along the common direction. It is made once a
//! frame, and any number of threads may read it. Packets come in the caller's order - the rays of a camera, a block
//! of the picture a packet - and are taken in runs of a thousand, of some tens, and in groups of four. A frustum (`fit.rs`) bounds
//! the rays of each. The spheres inside the frustum of the largest run are copied into a short list,
//! still in the order of their depth, from which the smaller runs copy theirs (`listed.rs`).
//! The groups go through the last list from the front, as they go through the leaves of a tree, and
//! stop where the next sphere begins deeper than all that their rays have hit (`list_group.rs`). Packets that fit no frustum do so, too.

use super::depth_sort;
use super::listed::{COLUMNS, Listed, column_length};
use super::view::{View, Viewpoint};
use crate::bvh::source::{SomeSpheres, Which};
use crate::geometry::sphere::Spheres;
use crate::memory::TooSmall;
use crate::scale::scene::SceneScale;

/// The spheres of a list in the order of their depth, in memory of the caller's.
///
/// # Guarantee
///
/// It answers bit for bit what the list of spheres does: by [`Exact`](crate::Exact) for every input, by
/// [`Stable`](crate::Stable) in its domain, by [`Fast`](crate::Fast) and [`Geometric`](crate::Geometric) except for
/// false hits: which of these it finds may depend on the rays of a call.
/// Lists and filters only decide what is skipped, under the bounds of the tree (`docs/traversal-margins.md`); every t is a tier's. Units do not matter, since bounds see spheres
/// and rays multiplied by powers of two.
///
/// What the bounds do not cover is not skipped. Spheres that are 2^40 times as large or small as most are tested as in a
/// list. A packet is tested against all spheres if one of its rays does not fit the [`Viewpoint`] or starts at t < 0. If its rays look in
/// different directions, it is tested against the nearest eighth of the spheres (128 at least), and against all if a ray goes on.
///
/// # Cost
///
/// Time grows with the number of spheres that lie one behind the other. Besides, each thousand packets, by slices each 64, look through
/// all spheres. Packets that follow each other should lie beside each other in the picture.
/// [`Trace::scratch`](crate::Trace::scratch) is memory for the short lists: with less than
/// [`DepthList::scratch`] the answers are the same, but take longer. Stack: as [`Intersect`](crate::Intersect) says.
///
/// ```
/// use spherule_kernel::{DepthList, Exact, Intersect, Ray, Spheres, Vec3, Viewpoint};
///
/// let spheres = Spheres::new(&[0.0, 0.0], &[0.0, 0.0], &[9.0, 5.0], &[1.0, 1.0]).expect("equal lengths");
/// let mut memory = [0.0; DepthList::needed(2)];
/// let list = DepthList::sort(spheres, Viewpoint::Origin(Vec3::ZERO), &mut memory)?;
/// let hit = list.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// assert_eq!(hit.map(|hit| (hit.t, hit.sphere)), Some((4.0, 1)));
/// # Ok::<(), spherule_kernel::TooSmall>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DepthList<'a> {
    /// The list that was sorted.
    pub(super) spheres: Spheres<'a>,
    /// How bounds see lengths.
    pub(super) scale: SceneScale,
    /// `None` if the bounds do not cover the viewpoint.
    pub(super) view: Option<View>,
    pub(super) listed: Listed<'a>,
    /// How many spheres no bound sees: their places follow those of the list.
    pub(super) outside: usize,
    /// No sphere of the list has a larger |x_i| + r, in the frame of the view.
    pub(super) extent: f32,
}

impl<'a> DepthList<'a> {
    /// Returns how many `f32` any list of `count` spheres needs: 6 a sphere, plus at most 192.
    ///
    /// Returns `usize::MAX`, which no memory has, if that number overflows.
    ///
    /// ```
    /// assert_eq!(spherule_kernel::DepthList::needed(100), 768);
    /// ```
    #[must_use]
    pub const fn needed(count: usize) -> usize {
        column_length(count).saturating_mul(COLUMNS)
    }

    /// Returns how many `f32` of scratch a traversal uses at most: 12 a sphere, plus 384.
    ///
    /// ```
    /// assert_eq!(spherule_kernel::DepthList::scratch(100), 1536);
    /// ```
    #[must_use]
    pub const fn scratch(count: usize) -> usize {
        Self::needed(count).saturating_mul(2)
    }

    /// Sorts `spheres` for rays of `viewpoint`, in the given memory, which is overwritten.
    ///
    /// Spheres that are not valid are left out. If the viewpoint is NaN, infinite or a zero direction, or beyond 2^56 times the size
    /// of most spheres, the list can be used, but saves nothing.
    ///
    /// Cost: a radix sort, 30 to 120 ns a sphere. Stack: 2 KiB. No other memory.
    ///
    /// # Errors
    /// [`TooSmall`] if `memory` is shorter than [`DepthList::needed`] says; longer memory is no error.
    ///
    /// ```
    /// use spherule_kernel::{DepthList, Spheres, Vec3, Viewpoint};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let mut memory = [0.0; DepthList::needed(1)];
    /// assert!(DepthList::sort(spheres, Viewpoint::Direction(Vec3::Z), &mut memory).is_ok());
    /// assert!(DepthList::sort(spheres, Viewpoint::Direction(Vec3::Z), &mut []).is_err());
    /// ```
    pub fn sort(
        spheres: Spheres<'a>,
        viewpoint: Viewpoint,
        memory: &'a mut [f32],
    ) -> Result<Self, TooSmall> {
        let needed = Self::needed(spheres.len());
        TooSmall::check("numbers", needed, memory.len())?;
        let scale = SceneScale::of(&spheres);
        let view = View::new(viewpoint, scale.factor);
        let memory = memory.get_mut(..needed).unwrap_or_default();
        let sorted = match &view {
            Some(view) => depth_sort::sort(&spheres, scale, view, memory),
            None => depth_sort::Sorted::default(),
        };
        let listed = Listed::new(memory, sorted.listed);
        Ok(Self { spheres, scale, view, listed, outside: sorted.outside, extent: sorted.extent })
    }

    /// Returns the spheres that no bound sees.
    #[inline(always)]
    pub(super) fn outside(&self) -> SomeSpheres<'a> {
        let behind = self.listed.indices().get(self.listed.count..).unwrap_or_default();
        let outside = behind.get(..self.outside).unwrap_or_default();
        SomeSpheres { spheres: self.spheres, which: Which::IndexBits(outside) }
    }

    /// The list that was sorted.
    ///
    /// ```
    /// use spherule_kernel::{DepthList, Spheres, Vec3, Viewpoint};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let mut memory = [0.0; DepthList::needed(1)];
    /// let list = DepthList::sort(spheres, Viewpoint::Origin(Vec3::ZERO), &mut memory)?;
    /// assert_eq!(list.spheres().len(), 1);
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    #[must_use]
    pub const fn spheres(&self) -> Spheres<'a> {
        self.spheres
    }
}
