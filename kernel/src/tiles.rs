//! Spheres in the order of their depth, for runs of rays that share an origin or a direction: object
//! order married to image order, without a tree, in memory that the caller provides.
//!
//! # Method
//!
//! [`DepthOrder`] sorts the spheres by the least depth that a ray may meet them at: the
//! distance from the common origin, or how far they lie along the common direction. It is made once a
//! frame, and any number of threads may read it. [`nearest`] and [`any`] then take the packets as
//! they come - the rays of a camera, a tile of the picture a packet - in groups of a thousand, of
//! some ten, of a few. What the rays of a group cannot leave is a pyramid or a prism
//! (`tiles/pencil.rs`); the spheres inside of the larger group's are copied into a short list,
//! still in the order of their depth, of which the smaller groups take theirs (`tiles/list.rs`).
//! The smallest groups go through the last list from the front, each sphere against the rays, a ray
//! a lane, and stop where the next sphere begins deeper than all that their rays have met.
//!
//! # What is guaranteed
//!
//! Bit for bit what the functions of the same names outside this module return: by
//! [`Exact`](crate::Exact) for every input, by [`Stable`](crate::Stable) in its domain, by
//! [`Fast`](crate::Fast) but for hits that the textbook form finds on lines that pass a sphere by
//! by more than [`Accuracy::SPREAD`](crate::Accuracy::SPREAD) says. Lists and filters only decide
//! what is skipped, under bounds proven in `tiles/pencil.rs`; every t is a tier's. What the bounds
//! do not cover is not skipped: spheres with a coordinate or radius above 2^40 are tested by every
//! ray; packets with a ray that does not fit the [`Viewpoint`], starts at t < 0, whose squared length
//! lies outside [2^-100, 2^100], or whose rays look in different directions, are tested against all
//! spheres.

mod answer;
mod list;
mod member;
mod order;
mod pencil;
mod survey;
mod view;
mod walk;

pub use walk::{any, nearest};

use crate::{Spheres, Vec3};
use core::fmt;
use list::{COLUMNS, List, column_length};
use view::{Parallel, Perspective, Seen};

/// What the rays of a run have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// All start here: a perspective camera's eye, a point light.
    Origin(Vec3),
    /// All have this direction, of any length: a parallel projection, a directional light.
    Direction(Vec3),
}

/// The memory for an order was too small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooSmall {
    /// What [`DepthOrder::needed`] says.
    pub needed: usize,
}

impl fmt::Display for TooSmall {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "the order of the spheres needs memory for {} words", self.needed)
    }
}

impl core::error::Error for TooSmall {}

/// The spheres of a list in the order of their depth, for [`nearest`] and [`any`].
///
/// Used with another list than it was made from, it is memory safe and does not panic: with one of
/// another length it is not used at all (every ray is tested against all spheres given); with one
/// of the same length, what is asked of the tier are spheres of the list given, at the indices
/// that the order finds near the ray in the list that it was made from.
#[derive(Clone, Copy, Debug)]
pub struct DepthOrder<'a> {
    /// Nothing where the bounds do not cover it.
    seen: Option<Seen>,
    list: List<'a>,
    /// How many indices behind those of the list are those of spheres above 2^40, which every ray
    /// must be tested against.
    outside: usize,
    /// For no sphere of the list is |x| + r larger.
    extent: f32,
    /// The length of the list.
    count: usize,
}

impl<'a> DepthOrder<'a> {
    /// How many words of memory any list of `count` spheres needs: 24 bytes a sphere, and 768.
    ///
    /// `usize::MAX`, which no memory has, where that many cannot be counted.
    #[must_use]
    pub const fn needed(count: usize) -> usize {
        column_length(count).saturating_mul(COLUMNS)
    }

    /// Sorts `spheres` for rays of `viewpoint`, in the memory given, whose contents do not matter.
    ///
    /// Spheres that are not valid are left out. With a viewpoint that is no one's - NaN, infinity,
    /// a zero direction - or one beyond 2^40, the order can be used, and saves nothing.
    ///
    /// Cost: a radix sort, some 20 ns a sphere. Stack: 2 KiB. No other memory.
    ///
    /// # Errors
    /// [`TooSmall`], with what is needed, where `memory` is shorter than [`DepthOrder::needed`]
    /// says; longer is no error.
    pub fn new(
        spheres: Spheres<'_>,
        viewpoint: Viewpoint,
        memory: &'a mut [u32],
    ) -> Result<Self, TooSmall> {
        let needed = Self::needed(spheres.len());
        match memory.get_mut(..needed) {
            Some(memory) => Ok(match viewpoint {
                Viewpoint::Origin(eye) => order::sort(spheres, Perspective::new(eye), memory),
                Viewpoint::Direction(d) => order::sort(spheres, Parallel::new(d), memory),
            }),
            None => Err(TooSmall { needed }),
        }
    }

    /// How many words of memory for lists [`nearest`] and [`any`] make use of at most: 48 bytes a
    /// sphere, and 1536.
    ///
    /// With less they answer the same, but a group whose list does not fit goes through that of the larger group.
    #[must_use]
    pub const fn lists(count: usize) -> usize {
        Self::needed(count).saturating_mul(LISTS)
    }

    /// The indices of spheres above 2^40.
    fn outside(&self) -> &'a [u32] {
        let outside = self.list.index.get(self.list.count..).unwrap_or_default();
        outside.get(..self.outside).unwrap_or_default()
    }
}

/// How many lists there are at a time.
const LISTS: usize = 2;
