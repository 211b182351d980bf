//! The caller's memory in which a tree is built and refitted.

use super::build::join::{InTurn, Join};
use super::build::refit::refit;
use super::built::Built;
use super::node::BvhNode;
use super::tree::Bvh;
use crate::geometry::sphere::Spheres;
use crate::memory::TooSmall;
use core::fmt;

/// Why a tree was not refitted; it is as it was before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefitError {
    /// No tree was built in the memory.
    NoTree,
    /// The tree is over another number of spheres.
    OtherCount {
        /// How many the tree was built over.
        built: usize,
        /// How many are given.
        given: usize,
    },
    /// The caller's memory has too few indices for the spheres that no box holds.
    TooSmall(TooSmall),
}

impl fmt::Display for RefitError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTree => formatter.write_str("no tree was built in the memory"),
            Self::OtherCount { built, given } => {
                write!(formatter, "the tree is over {built} spheres, and {given} are given")
            }
            Self::TooSmall(error) => error.fmt(formatter),
        }
    }
}

impl core::error::Error for RefitError {}

/// So that `?` takes the error of [`BvhMemory::build`], too.
impl From<TooSmall> for RefitError {
    fn from(error: TooSmall) -> Self {
        Self::TooSmall(error)
    }
}

/// The caller's memory in which a [`Bvh`] is built, and refitted when its spheres move.
///
/// The tree borrows the memory and its list until it is built or refitted again.
///
/// ```
/// use spherule_kernel::{Bvh, BvhMemory, Exact, Intersect, Ray, Spheres, Vec3};
///
/// const NEEDED: usize = Bvh::needed(2).places;
/// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
/// let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
///
/// let mut z = [5.0, 9.0];
/// fn spheres(z: &[f32; 2]) -> Spheres<'_> {
///     Spheres::new(&[0.0; 2], &[0.0; 2], z, &[1.0; 2]).expect("equal lengths")
/// }
/// let first = memory.build(spheres(&z))?.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// z[0] = 20.0;
/// let tree = memory.refit(spheres(&z))?;
/// let then = tree.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// assert_eq!((first.map(|hit| hit.t), then.map(|hit| hit.t)), (Some(4.0), Some(8.0)));
/// assert!(tree.growth() < 1.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct BvhMemory<'m> {
    nodes: &'m mut [BvhNode],
    places: &'m mut [[f32; 4]],
    indices: &'m mut [u32],
    /// The tree that is in it, if there is one, and over how many spheres.
    tree: Option<(Built, usize)>,
}

impl<'m> BvhMemory<'m> {
    /// Borrows memory, whose contents do not matter. [`Bvh::needed`] says how much a tree needs.
    ///
    /// With one index more for each sphere, no refit returns [`RefitError::TooSmall`].
    ///
    /// ```
    /// use spherule_kernel::{Bvh, BvhMemory, RefitError, Spheres};
    ///
    /// const NEEDED: usize = Bvh::needed(1).places;
    /// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
    /// let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// assert_eq!(memory.refit(spheres).err(), Some(RefitError::NoTree));
    /// ```
    #[must_use]
    pub const fn new(
        nodes: &'m mut [BvhNode],
        places: &'m mut [[f32; 4]],
        indices: &'m mut [u32],
    ) -> Self {
        Self { nodes, places, indices, tree: None }
    }

    /// Builds a tree, as [`Bvh::build`] does.
    ///
    /// # Errors
    /// As [`Bvh::build`]; then there is no tree in the memory.
    ///
    /// ```
    /// use spherule_kernel::{Bvh, BvhMemory, Spheres};
    ///
    /// const NEEDED: usize = Bvh::needed(1).places;
    /// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
    /// let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// assert_eq!(memory.build(spheres)?.spheres().len(), 1);
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    pub fn build<'a>(&'a mut self, spheres: Spheres<'a>) -> Result<Bvh<'a>, TooSmall> {
        self.build_with(&InTurn, spheres)
    }

    /// Builds the same tree, as [`Bvh::build_with`] does.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    ///
    /// ```
    /// use spherule_kernel::{Bvh, BvhMemory, InTurn, Spheres};
    ///
    /// const NEEDED: usize = Bvh::needed(1).places;
    /// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
    /// let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// assert_eq!(memory.build_with(&InTurn, spheres)?.spheres().len(), 1);
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    pub fn build_with<'a>(
        &'a mut self,
        join: &impl Join,
        spheres: Spheres<'a>,
    ) -> Result<Bvh<'a>, TooSmall> {
        self.tree = None;
        let Self { nodes, places, indices, tree } = self;
        let built = Bvh::built(join, &spheres, nodes, places, indices)?;
        *tree = Some((built, spheres.len()));
        Ok(Bvh::of(built, spheres, nodes, places, indices))
    }

    /// Replaces each sphere of the tree in the memory by the one with the same index in `spheres`, centre and radius.
    ///
    /// Guarantees what a new tree guarantees, for any spheres; only time is lost, and [`Bvh::growth`] says how much. Spheres
    /// that are not valid now are left out, and come back when they are valid again. Some spheres are tested against every ray:
    /// those larger or smaller by 2^40 or more than most were when the tree was built; those left out then that are
    /// valid now; and, of more than four equal spheres, some that now differ.
    ///
    /// Cost: a tenth to a quarter of a build's time; less with so many indices that no refit is [`TooSmall`], since then nothing
    /// is counted first. Stack: some 3 KiB. No other memory.
    ///
    /// # Errors
    /// [`RefitError`] if the number of spheres is another, if there are too few indices for the spheres that no box holds, or if
    /// there is no tree. Then a tree in the memory is as it was.
    ///
    /// ```
    /// use spherule_kernel::{Bvh, BvhMemory, Exact, Intersect, Ray, Spheres, Vec3};
    ///
    /// const NEEDED: usize = Bvh::needed(1).places;
    /// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
    /// let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// memory.build(spheres)?;
    /// let moved = Spheres::new(&[0.0], &[0.0], &[7.0], &[1.0])?;
    /// let hit = memory.refit(moved)?.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
    /// assert_eq!(hit.map(|hit| hit.t), Some(6.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn refit<'a>(&'a mut self, spheres: Spheres<'a>) -> Result<Bvh<'a>, RefitError> {
        let Self { nodes, places, indices, tree } = self;
        let Some((built, count)) = tree else { return Err(RefitError::NoTree) };
        if *count != spheres.len() {
            return Err(RefitError::OtherCount { built: *count, given: spheres.len() });
        }
        refit(built, &spheres, nodes, places, indices).map_err(RefitError::TooSmall)?;
        Ok(Bvh::of(*built, spheres, nodes, places, indices))
    }
}
