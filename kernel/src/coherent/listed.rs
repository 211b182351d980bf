//! Spheres in the order of their depth, column by column, in blocks of sixteen.

use super::survey::Survey;
use crate::geometry::sphere_columns::SphereColumns;
use crate::lanes::{LaneArray, Lanes, WIDTH};

/// x, y, z, radius, depth, index.
pub(super) const COLUMNS: usize = 6;
/// What the columns hold where there is no sphere.
const NONE: [f32; COLUMNS] = [0.0, 0.0, 0.0, f32::NAN, f32::INFINITY, 0.0];

/// Returns how many numbers a column of `count` spheres has: a block more, so that lanes can be stored anywhere in it
/// and the end can be marked.
pub(super) const fn column_length(count: usize) -> usize {
    (count / WIDTH).saturating_add(2).saturating_mul(WIDTH)
}

/// The columns of `memory`, each of `length` numbers, or of none if there is no room.
#[inline(always)]
pub(super) fn columns(memory: &mut [f32], length: usize) -> [&mut [f32]; COLUMNS] {
    let (x, rest) = memory.split_at_mut(length.min(memory.len()));
    let (y, rest) = rest.split_at_mut(length.min(rest.len()));
    let (z, rest) = rest.split_at_mut(length.min(rest.len()));
    let (radius, rest) = rest.split_at_mut(length.min(rest.len()));
    let (depth, rest) = rest.split_at_mut(length.min(rest.len()));
    let (index, _) = rest.split_at_mut(length.min(rest.len()));
    [x, y, z, radius, depth, index]
}

/// Spheres in the order of their depth: centres in the frame of a view, radii, the least depth that a ray
/// hits them at, and their indices in the list of spheres, as bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Listed<'a> {
    columns: [&'a [[f32; WIDTH]]; COLUMNS],
    /// How many spheres there are; behind them are radii that are NaN, and infinite depths.
    pub(super) count: usize,
}

impl<'a> Listed<'a> {
    /// The first `count` spheres of columns that fill `memory`.
    pub(super) fn new(memory: &'a mut [f32], count: usize) -> Self {
        let length = memory.len() / COLUMNS;
        Self::of(columns(memory, length), count)
    }

    #[inline(always)]
    fn of([x, y, z, radius, depth, index]: [&'a mut [f32]; COLUMNS], count: usize) -> Self {
        let columns = [
            x.as_chunks().0,
            y.as_chunks().0,
            z.as_chunks().0,
            radius.as_chunks().0,
            depth.as_chunks().0,
            index.as_chunks().0,
        ];
        Self { columns, count }
    }

    /// Block `number` of sixteen, and the least depth in it; `None` past the last.
    #[inline(always)]
    pub(super) fn block(&self, number: usize) -> Option<(SphereColumns<'a>, f32)> {
        if number * WIDTH >= self.count {
            return None;
        }
        let [x, y, z, radius, depth, _] = self.columns;
        let center = [x.get(number)?, y.get(number)?, z.get(number)?];
        Some((SphereColumns { center, radius: radius.get(number)? }, depth.get(number)?[0]))
    }

    /// The indices of all places, as bits.
    #[inline(always)]
    pub(super) fn indices(&self) -> &'a [f32] {
        self.columns[5].as_flattened()
    }

    /// Returns the spheres of the list that rays of a survey may hit, in the same order; `None` if they have no
    /// room in `memory`.
    #[inline(always)]
    pub(super) fn inside<'b, L: Lanes>(
        &self,
        token: L::Token,
        Survey { frustum, reach, outline, .. }: &Survey,
        memory: &'b mut [f32],
    ) -> Option<Listed<'b>> {
        // As many whole blocks as there is room for.
        let length = memory.len() / COLUMNS / WIDTH * WIDTH;
        let columns = columns(memory, length);
        let (mut count, mut number) = (0, 0);
        while let Some((spheres, depth)) = self.block(number) {
            // All spheres that follow begin deeper.
            if depth > *reach {
                break;
            }
            let places = frustum.look::<L>(token, &spheres, *outline);
            for part in 0..WIDTH / L::COUNT {
                let here = places >> (part * L::COUNT) & (u32::MAX >> (32 - L::COUNT));
                if here == 0 {
                    continue;
                }
                let inside = L::mask(token, here);
                for column in 0..COLUMNS {
                    let lanes = L::load_part(token, self.columns[column].get(number)?, part);
                    if !lanes.compress(inside).store().put_at(columns[column], count) {
                        return None;
                    }
                }
                count += here.count_ones() as usize;
            }
            number += 1;
        }
        for column in 0..COLUMNS {
            if !<[f32; WIDTH]>::filled(NONE[column]).put_at(columns[column], count) {
                return None;
            }
        }
        Some(Listed::of(columns, count))
    }
}
