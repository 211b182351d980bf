//! The order of the spheres: by cuts at the middle of the longest axis.

use super::shape::{Shape, part_bits};
use crate::geometry::sphere::{Sphere, Spheres};
use crate::numeric::heap_sort::heap_sort;
use crate::numeric::rounding::{least, most};
use crate::scale::scene::SceneScale;

/// The lower bits of the word at place p are the index of the sphere at p; its upper bits are the place of the
/// sphere with index p. So each sphere is seen to be there once, with no other memory.
const INDEX_BITS: u32 = 16;

/// The index of the sphere at this place of the order.
#[inline(always)]
pub(super) const fn index_in(word: u32) -> u32 {
    word & ((1 << INDEX_BITS) - 1)
}

/// The place of the sphere that has this word's place as its index.
#[inline(always)]
pub(super) const fn place_in(word: u32) -> u32 {
    word >> INDEX_BITS
}

/// How the bounds see a sphere: first the spheres that they see, then those that they do not see, then those that
/// are invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Inside,
    Outside,
    Invalid,
}

impl Kind {
    pub(super) fn of(sphere: &Sphere, scale: &SceneScale) -> Self {
        if !sphere.is_valid() {
            Self::Invalid
        } else if scale.scaled(sphere).is_some() {
            Self::Inside
        } else {
            Self::Outside
        }
    }
}

/// Writes the order of all spheres; returns how many are inside, and how many are valid.
pub(super) fn write(spheres: &Spheres<'_>, scale: &SceneScale, order: &mut [u32]) -> [u32; 2] {
    let (mut place, mut ends) = (0, [0; 3]);
    for (kind, end) in [Kind::Inside, Kind::Outside, Kind::Invalid].into_iter().zip(&mut ends) {
        for (index, sphere) in spheres.iter().enumerate() {
            if Kind::of(&sphere, scale) == kind
                && let Some(word) = order.get_mut(place)
            {
                *word = index as u32;
                place += 1;
            }
        }
        *end = place as u32;
    }
    let [inside, valid, _] = ends;
    cut(spheres, &Shape::new(inside), order);
    for place in 0..order.len() {
        let index = order.get(place).map_or(0, |&word| index_in(word));
        if let Some(word) = order.get_mut(index as usize) {
            *word |= (place as u32) << INDEX_BITS;
        }
    }
    [inside, valid]
}

/// Cuts what is longer than a leaf in two, part by part, from the whole down.
fn cut(spheres: &Spheres<'_>, shape: &Shape, order: &mut [u32]) {
    let count = shape.count as usize;
    for bits in part_bits(shape) {
        let (size, mut begin) = (1 << bits, 0);
        while begin < count {
            let end = (begin + size).min(count);
            if end - begin > size / 2
                && let Some(part) = order.get_mut(begin..end)
            {
                sort(spheres, longest_axis(spheres, part), part);
            }
            begin = end;
        }
    }
}

/// The axis along which the centres lie farthest apart.
fn longest_axis(spheres: &Spheres<'_>, part: &[u32]) -> usize {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for &index in part {
        let center = spheres.get(index as usize).map_or([0.0; 3], |sphere| sphere.center());
        for i in 0..3 {
            low[i] = least(low[i], center[i]);
            high[i] = most(high[i], center[i]);
        }
    }
    let (mut axis, mut longest) = (0, 0.0);
    for i in 0..3 {
        // Halves, so that no length overflows.
        let length = 0.5 * high[i] - 0.5 * low[i];
        if length > longest {
            (axis, longest) = (i, length);
        }
    }
    axis
}

/// Sorts a part by an axis, and equals by index.
fn sort(spheres: &Spheres<'_>, axis: usize, part: &mut [u32]) {
    heap_sort(
        part,
        #[inline(always)]
        |a, b| {
            let (x, y) = (coordinate(spheres, axis, a), coordinate(spheres, axis, b));
            x < y || (x == y && a < b)
        },
    );
}

#[inline(always)]
fn coordinate(spheres: &Spheres<'_>, axis: usize, index: u32) -> f32 {
    let center = spheres.get(index as usize).map_or([0.0; 3], |sphere| sphere.center());
    center.get(axis).copied().unwrap_or(0.0)
}
