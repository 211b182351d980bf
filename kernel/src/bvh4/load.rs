//! The checks of a tree that is data.

use super::boxes::{Boxes, NODE};
use super::order::{Kind, index_in, place_in};
use super::shape::{MOST, Place, Shape};
use super::tree::{Bvh4, HEADER, MARK};
use crate::geometry::sphere::Spheres;
use crate::scale::scene::SceneScale;
use core::fmt;

/// Why words are not a tree over the spheres of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bvh4Error {
    /// The words do not begin as a tree of this version does.
    Mark,
    /// The tree is over another number of spheres than the list has.
    Count,
    /// There are fewer words than the tree has.
    Length,
    /// The scale of lengths is not a power of two.
    Scale,
    /// A sphere is missing, there twice, or not among its kind: covered by the bounds, not covered, or
    /// invalid.
    Order,
    /// A box is not that of its spheres.
    Box,
}

impl fmt::Display for Bvh4Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Mark => "the words are no tree of this version",
            Self::Count => "the tree is of another number of spheres",
            Self::Length => "the tree is cut off",
            Self::Scale => "the tree's scale is no power of two",
            Self::Order => "the tree's order is not of these spheres",
            Self::Box => "a box of the tree is not that of its spheres",
        })
    }
}

impl core::error::Error for Bvh4Error {}

impl<'a> Bvh4<'a> {
    /// Loads a tree over `spheres` from its [`words`](Bvh4::words), wherever they come from.
    ///
    /// Any words may be given: a tree that is loaded answers as the list does, and all other words are an error.
    ///
    /// Cost: some hundreds of operations a sphere, since each box is computed anew from its spheres. Stack: some 2 KiB
    /// on 32 bits. No other memory.
    ///
    /// # Errors
    /// [`Bvh4Error`] if the words are not those of a tree over these spheres, bit for bit. More words than the tree's are no
    /// error.
    ///
    /// ```
    /// use spherule_kernel::{Bvh4, Bvh4Error, Spheres};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let mut memory = [0; Bvh4::needed(1)];
    /// let words = Bvh4::build(spheres, &mut memory)?.words();
    /// assert_eq!(Bvh4::load(spheres, words)?.words(), words);
    /// assert_eq!(Bvh4::load(spheres, &words[..3]).err(), Some(Bvh4Error::Length));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn load(spheres: Spheres<'a>, words: &'a [u32]) -> Result<Self, Bvh4Error> {
        let (&[mark, count, inside, valid, factor], rest) =
            words.split_first_chunk::<HEADER>().ok_or(Bvh4Error::Length)?;
        if mark != MARK {
            return Err(Bvh4Error::Mark);
        }
        if count as usize != spheres.len() || count as usize > MOST {
            return Err(Bvh4Error::Count);
        }
        if inside > valid || valid > count {
            return Err(Bvh4Error::Order);
        }
        let scale = SceneScale::from_factor(f32::from_bits(factor)).ok_or(Bvh4Error::Scale)?;
        let shape = Shape::new(inside);
        let (order, rest) = rest.split_at_checked(count as usize).ok_or(Bvh4Error::Length)?;
        let nodes = rest.get(..shape.nodes as usize * NODE).ok_or(Bvh4Error::Length)?;
        check_order(&spheres, &scale, order, [inside, valid])?;
        let boxes = Boxes { spheres, scale, shape };
        check_boxes(&boxes, order, nodes)?;
        Ok(Self::of(boxes, words, valid))
    }
}

/// Checks that every sphere is in one place, which is among its kind.
fn check_order(
    spheres: &Spheres<'_>,
    scale: &SceneScale,
    order: &[u32],
    [inside, valid]: [u32; 2],
) -> Result<(), Bvh4Error> {
    for (index, &word) in order.iter().enumerate() {
        let place = place_in(word);
        // There are as many places as spheres: if each sphere has a place of its own, each place has a sphere.
        let there = order.get(place as usize).is_some_and(|&word| index_in(word) == index as u32);
        let expected = if place < inside {
            Kind::Inside
        } else if place < valid {
            Kind::Outside
        } else {
            Kind::Invalid
        };
        let kind = spheres.get(index).map(|sphere| Kind::of(&sphere, scale));
        if !there || kind != Some(expected) {
            return Err(Bvh4Error::Order);
        }
    }
    Ok(())
}

/// Checks that every box is as the build makes it.
fn check_boxes(boxes: &Boxes<'_>, order: &[u32], nodes: &[u32]) -> Result<(), Bvh4Error> {
    for height in 1..=boxes.shape.height {
        for number in 0..boxes.shape.of_height(height) {
            let place = Place { number, height };
            let rows = boxes.rows(order, place);
            let at = boxes.shape.node(place) * NODE;
            if nodes.get(at..at + NODE) != Some(rows.as_flattened()) {
                return Err(Bvh4Error::Box);
            }
        }
    }
    Ok(())
}
