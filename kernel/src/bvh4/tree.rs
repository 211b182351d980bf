//! The tree, borrowed: words, and the list that it is over.

use super::boxes::{Boxes, NODE, ROWS};
use super::order;
use super::shape::{MOST, Place, Shape, WIDTH};
use crate::geometry::sphere::Spheres;
use crate::memory::TooSmall;
use crate::scale::scene::SceneScale;

/// The word that a tree begins with: another version has another.
pub(super) const MARK: u32 = 0x3448_5642;
/// Words before the order: the mark, how many spheres, how many of them bounds see, how many are valid, the scale.
pub(super) const HEADER: usize = 5;

/// A tree of one lane over a list of up to 65,536 spheres: firmware uses it instead of a [`Bvh`](crate::Bvh).
///
/// It is made of words, and borrows the list. Either a host builds it, and its [`words`](Bvh4::words) are data of a program,
/// which [loads](Bvh4::load) them; or it is [built](Bvh4::build) where it is used. `docs/targets.md` says what each of the two
/// takes.
///
/// It answers through [`Intersect`](crate::Intersect), bit for bit as the list does, except that by `Fast` and `Geometric`, and by `Stable`
/// outside its domain, it loses some false hits on lines that miss a sphere's box. It answers wider packets lane by lane, in code that is compiled where it is called. Where there are
/// vectors, `Bvh` is many times as fast.
///
/// ```
/// use spherule_kernel::{Bvh4, Exact, Intersect, Ray, Spheres, Vec3};
///
/// static COLUMNS: [[f32; 2]; 4] = [[0.0, 0.0], [0.0, 0.0], [5.0, 9.0], [1.0, 1.0]];
/// let [x, y, z, r] = &COLUMNS;
/// let spheres = Spheres::new(x, y, z, r)?;
///
/// // On the host: words, to be written as a source, or a file (below).
/// let mut memory = [0; Bvh4::needed(2)];
/// let words = Bvh4::build(spheres, &mut memory)?.words();
/// let source = format!("pub static TREE: [u32; {}] = {words:?};", words.len());
///
/// // In the firmware: memory that lies in flash.
/// let tree = Bvh4::load(spheres, words)?;
/// let hit = tree.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// assert_eq!(hit.map(|hit| (hit.t, hit.sphere)), Some((4.0, 0)));
/// # assert!(source.starts_with("pub static TREE: [u32; 31] = ["));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A file has bytes, whose order is yours. Here the lowest comes first:
///
/// ```
/// use spherule_kernel::{Bvh4, Spheres};
///
/// // In the firmware:
/// // `static TREE: [u32; include_bytes!("tree.le").len() / 4] = words(include_bytes!("tree.le"));`
/// const fn words<const N: usize>(bytes: &[u8]) -> [u32; N] {
///     let ((chunks, _), mut words, mut index) = (bytes.as_chunks::<4>(), [0; N], 0);
///     while index < N {
///         words[index] = u32::from_le_bytes(chunks[index]);
///         index += 1;
///     }
///     words
/// }
/// # static IS_CONST: [u32; 1] = words(&[1, 2, 0, 0]);
/// # assert_eq!(IS_CONST, [513]);
///
/// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0])?;
/// let mut memory = [0; Bvh4::needed(1)];
/// let built = Bvh4::build(spheres, &mut memory)?.words();
/// let file: Vec<u8> = built.iter().copied().flat_map(u32::to_le_bytes).collect();
///
/// let read: [u32; Bvh4::needed(1)] = words(&file);
/// assert_eq!(Bvh4::load(spheres, &read)?.words(), built);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The spheres must have the bits that they had on the host: with others, `load` returns an error, mostly
/// [`Bvh4Error::Box`](crate::Bvh4Error::Box).
#[derive(Clone, Copy, Debug)]
pub struct Bvh4<'a> {
    /// The list, the scale and the shape.
    pub(super) boxes: Boxes<'a>,
    pub(super) order: &'a [u32],
    pub(super) nodes: &'a [[u32; WIDTH]],
    /// How many places have valid spheres; bounds do not see the last of these.
    pub(super) valid: u32,
    /// No coordinate of a box is larger, as bounds see it.
    pub(super) extent: f32,
    words: &'a [u32],
}

impl<'a> Bvh4<'a> {
    /// Returns how many words any list of `count` spheres needs: at most 12 bytes a sphere, plus 700.
    ///
    /// More than 65,536 spheres are too many: this returns `usize::MAX`, since no memory is enough.
    ///
    /// ```
    /// use spherule_kernel::Bvh4;
    ///
    /// assert_eq!(Bvh4::needed(1000), 3021);
    /// ```
    #[must_use]
    pub const fn needed(count: usize) -> usize {
        if count > MOST {
            return usize::MAX;
        }
        HEADER + count + Shape::new(count as u32).nodes as usize * NODE
    }

    /// Builds a tree over `spheres` in the given memory, which is overwritten. The same list gives the same words on every
    /// target.
    ///
    /// Cost: time in proportion to n log² n for n spheres, wherever they lie. (A ray that meets a sphere also meets all spheres
    /// that are equal to it.) Stack: 2.7 KiB on 32 bits (`docs/targets.md`). No other memory.
    ///
    /// # Errors
    /// [`TooSmall`] if there are fewer words than [`Bvh4::needed`] says; more words are no error, and the rest is left as it
    /// is.
    ///
    /// ```
    /// use spherule_kernel::{Bvh4, Exact, Intersect, Ray, Spheres, Vec3};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let mut memory = [0; Bvh4::needed(1)];
    /// let tree = Bvh4::build(spheres, &mut memory)?;
    /// assert!(tree.any_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z)));
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    pub fn build(spheres: Spheres<'a>, words: &'a mut [u32]) -> Result<Self, TooSmall> {
        let needed = Self::needed(spheres.len());
        TooSmall::check("words", needed, words.len())?;
        let too_small = TooSmall { what: "words", needed, given: words.len() };
        let (order_end, scale) = (HEADER + spheres.len(), SceneScale::of(&spheres));
        let order = words.get_mut(HEADER..order_end).ok_or(too_small)?;
        let [inside, valid] = order::write(&spheres, &scale, order);
        let header = [MARK, spheres.len() as u32, inside, valid, scale.factor.to_bits()];
        if let Some(place) = words.first_chunk_mut::<HEADER>() {
            *place = header;
        }
        let boxes = Boxes { spheres, scale, shape: Shape::new(inside) };
        let (order, nodes) = words.split_at_mut_checked(order_end).ok_or(too_small)?;
        let order = order.get(HEADER..).unwrap_or_default();
        let (nodes, _) = nodes.as_chunks_mut();
        for height in 1..=boxes.shape.height {
            for number in 0..boxes.shape.of_height(height) {
                let place = Place { number, height };
                let rows = nodes.get_mut(boxes.shape.node(place) * ROWS..);
                if let Some(node) = rows.and_then(|rows| rows.first_chunk_mut::<ROWS>()) {
                    *node = boxes.rows(order, place);
                }
            }
        }
        Ok(Self::of(boxes, words, valid))
    }

    /// The words of a tree that was checked or built.
    pub(super) fn of(boxes: Boxes<'a>, words: &'a [u32], valid: u32) -> Self {
        let count = boxes.spheres.len();
        let end = HEADER + count + boxes.shape.nodes as usize * NODE;
        let words = words.get(..end).unwrap_or_default();
        let order = words.get(HEADER..HEADER + count).unwrap_or_default();
        let (nodes, _) = words.get(HEADER + count..).unwrap_or_default().as_chunks();
        let extent = boxes.extent(order);
        Self { boxes, order, nodes, valid, extent, words }
    }

    /// Returns the list that the tree is over.
    ///
    /// ```
    /// use spherule_kernel::{Bvh4, Spheres};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let mut memory = [0; Bvh4::needed(1)];
    /// assert_eq!(Bvh4::build(spheres, &mut memory)?.spheres().len(), 1);
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    #[must_use]
    pub const fn spheres(&self) -> Spheres<'a> {
        self.boxes.spheres
    }

    /// Returns the words that the tree is made of, the same on every target.
    ///
    /// ```
    /// use spherule_kernel::{Bvh4, Spheres};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let mut memory = [0; Bvh4::needed(1)];
    /// let words = Bvh4::build(spheres, &mut memory)?.words();
    /// assert!(words.len() <= Bvh4::needed(1));
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    #[must_use]
    pub const fn words(&self) -> &'a [u32] {
        self.words
    }

    /// The rows of a node.
    #[inline(always)]
    pub(super) fn node(&self, place: Place) -> Option<&'a [[u32; WIDTH]; ROWS]> {
        self.nodes.get(self.boxes.shape.node(place) * ROWS..)?.first_chunk()
    }
}
