//! Where the nodes and leaves of a tree lie: the number of its spheres alone says where.
//!
//! A leaf has height 0, a node is one higher than its children. Node or leaf j of height h is over the spheres from j s to
//! (j + 1) s, with s = 4 4^h, as far as there are any; its children are 4 j to 4 j + 3. The root comes first, then the nodes
//! below it, height by height.

/// How many spheres a leaf holds: two to this power. (With leaves of 1, 2, 4 and 8 spheres, a ray of the picture of
/// `tests/targets/sizes` takes 5.6, 5.5, 5.0 and 5.4 thousand instructions by `Stable`, and a tree over n spheres takes 36,
/// 20, 12 and 8 n bytes.)
const LEAF_BITS: u32 = 2;
/// How many spheres a tree can hold: a word is the index of one sphere, and the place of another.
pub(super) const MOST: usize = 1 << 16;
/// The height of a root over [`MOST`] spheres.
pub(super) const HIGHEST: usize = 7;
/// Children of a node.
pub(super) const WIDTH: usize = 4;

/// Where nodes and leaves lie.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// How many spheres.
    pub(super) count: u32,
    /// The height of the root; zero where there are no spheres.
    pub(super) height: u32,
    /// Where the nodes of each height begin.
    firsts: [u32; HIGHEST + 1],
    /// How many nodes.
    pub(super) nodes: u32,
}

/// A node or a leaf: its number among those of its height, and its height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) number: u32,
    pub(super) height: u32,
}

impl Shape {
    /// Of a tree over `count` spheres, at most [`MOST`].
    pub(super) const fn new(count: u32) -> Self {
        let (mut shape, mut height) =
            (Self { count, height: 0, firsts: [0; HIGHEST + 1], nodes: 0 }, 0);
        while count > 0 && height < HIGHEST && (height == 0 || shape.of_height(height as u32) > 1) {
            height += 1;
        }
        shape.height = height as u32;
        while height > 0 {
            // Always so.
            if height <= HIGHEST {
                shape.firsts[height] = shape.nodes;
            }
            shape.nodes += shape.of_height(height as u32);
            height -= 1;
        }
        shape
    }

    /// How many nodes or leaves of that height.
    #[inline(always)]
    pub(super) const fn of_height(&self, height: u32) -> u32 {
        if self.count == 0 { 0 } else { ((self.count - 1) >> size_bits(height)) + 1 }
    }

    /// The root.
    pub(super) const fn root(&self) -> Place {
        Place { number: 0, height: self.height }
    }

    /// Which spheres of the order are below: from the first to before the second.
    #[inline(always)]
    pub(super) const fn run(&self, place: Place) -> [u32; 2] {
        let bits = size_bits(place.height);
        let (begin, end) = (place.number << bits, (place.number + 1) << bits);
        [begin, if end < self.count { end } else { self.count }]
    }

    /// The number of a node among all nodes.
    #[inline(always)]
    pub(super) const fn node(&self, place: Place) -> usize {
        // The remainder tells the compiler that the index is in bounds.
        (self.firsts[place.height as usize % (HIGHEST + 1)] + place.number) as usize
    }
}

impl Place {
    /// Child `slot`; it exists only if its number is below how many there are of its height.
    #[inline(always)]
    pub(super) const fn child(self, slot: usize) -> Self {
        let number = self.number * WIDTH as u32 + slot as u32;
        Self { number, height: self.height.wrapping_sub(1) }
    }
}

/// How many spheres fill a node or leaf of that height, as a power of two.
#[inline(always)]
const fn size_bits(height: u32) -> u32 {
    LEAF_BITS + 2 * height
}

/// The sizes of the parts that are cut, from the whole down, as powers of two: each is cut in two of the next size.
pub(super) fn part_bits(shape: &Shape) -> impl Iterator<Item = u32> + use<> {
    (LEAF_BITS + 1..=size_bits(shape.height)).rev()
}

#[cfg(all(test, proofs))]
mod tests {
    use super::*;

    #[test]
    fn every_sphere_is_in_one_leaf_and_every_child_in_its_parent() {
        for count in (0..300).chain([1000, 4095, 4096, 4097, 40_000, MOST as u32 - 1, MOST as u32])
        {
            let shape = Shape::new(count);
            assert!(shape.height as usize <= HIGHEST && (count == 0) == (shape.height == 0));
            let (mut next, mut nodes) = (0, 0);
            for number in 0..shape.of_height(0) {
                let [begin, end] = shape.run(Place { number, height: 0 });
                assert!(
                    begin == next && end > begin && end - begin <= 1 << LEAF_BITS,
                    "{count}: {begin}..{end}"
                );
                next = end;
            }
            assert_eq!(next, count);
            for height in (1..=shape.height).rev() {
                for number in 0..shape.of_height(height) {
                    let place = Place { number, height };
                    assert_eq!(shape.node(place), nodes, "{count}: {place:?}");
                    nodes += 1;
                    let [begin, end] = shape.run(place);
                    let mut next = begin;
                    for slot in 0..WIDTH {
                        let child = place.child(slot);
                        if child.number < shape.of_height(child.height) {
                            let [from, to] = shape.run(child);
                            assert!(from == next && to > from, "{count}: {child:?}");
                            next = to;
                        }
                    }
                    assert_eq!(next, end, "{count}: {place:?}");
                }
            }
            assert_eq!(nodes, shape.nodes as usize);
            assert!(count == 0 || shape.of_height(shape.height) == 1);
        }
    }
}
