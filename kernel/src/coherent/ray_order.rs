//! An order of rays in which those that take the same way through a scene come one after the other.
//!
//! # Method
//!
//! Groups pay where rays that are near each other are in one packet. Shuffled rays have neighbours as near as sorted ones,
//! only not in their packets. So a sample of the rays is looked at, and shows what all have in common:
//!
//! - Rays that start in one point (a camera) are sorted by direction. In a tree that is far from the core rays that end in
//!   one point (a light) are, too. (In a near tree these run 1.02 to 1.2 times as fast sorted, but at 0.8 of the speed in chains and a
//!   shell.)
//! - Rays that are nearly parallel (a beam, a sun) are sorted by where they cross a plane.
//! - Rays that start in one of two points that are apart (two cameras) are sorted by point and direction. They are in order only if
//!   each ray and the next are of one camera: of rays by turns every packet holds both.
//! - Others make no groups. But in a far tree they gain by being sorted by where they start, since rays of one place read
//!   one part of the tree. This holds for closest hits, and for any hits of rays that end somewhere (at several lights, or near
//!   by). (Any hits of rays without an end ran at 0.74 to 0.9 of the speed.)
//!
//! A key is a cell of a grid, on a Z curve (Morton 1966). Rays are in order already if most have a neighbour in their own cell.
//! For closest hits in a near tree, and for all hits of two cameras by turns, eight groups are tried first, each of rays that sorting would
//! bring together. Unless most of the groups go through, at little cost, streams are faster (60,000 spheres in clusters, a shuffled
//! camera: sorted, 0.7 of the speed). Other any hits gain in any case. Two cameras that are shuffled gain in most cases: four
//! pairs among eight scenes ran at 0.6 to 3.3 of the speed with a trial, at 1.1 in the median, and at 0.77 or more of ray by ray; a pair
//! among seventeen others, without a trial, at 0.81 to 2.4 of a stream, at 1.3 in the median (AVX2, a noisy machine).
//!
//! Making keys takes 5 ns a ray, sorting them 10, and taking rays and writing answers in that order 20. The speed in multiples of
//! that of the same call unsorted, 65,536 rays, AVX-512, closest and any: a shuffled camera 1.9 and 1.9 among 10,000 spheres, 3.1 and
//! 2.1 among nested ones, 1.1 and 1.2 among a million; a beam 1.9 and 2.0, 3.5 and 2.6, 1.2 and 1.4; diffuse rays among a million 1.4
//! and 1. Slower are closest hits of rays all around from a point among a million, 0.89 to 0.95, and calls whose trial is in vain, 0.93
//! to 0.97.

mod grid;
mod keys;

use crate::bvh::tree::Bvh;
use crate::geometry::many::ManyRays;
use crate::geometry::ray::Ray;
use crate::numeric::radix_sort::radix_sort;
use glam::Vec3;
use grid::{Grid, Space};
use keys::{BITS, is_of_second};

pub(crate) use keys::{MOST, RayKeys, SecondGrid};

/// The fewest rays that gain by groups, and by starting near each other. (Sorted, any hits of 16,384 rays ran at 1.2 to 2.1 of the
/// speed for shuffled cameras and beams among nested spheres and 10,000, but at 0.5 to 0.9 in chains, 0.7 to 0.9 along an axis and
/// nearly parallel, 0.9 among a million. With a trial these lose a fifth, and the mean of six scenes is 0.95. Closest hits ran at 0.94;
/// closest hits of 8,192 rays at 0.88, any hits at 0.95.)
pub(crate) const FEWEST_IN_GROUPS: usize = 24_000;
const FEWEST: usize = 2048;
/// Trees of more bytes are far from the core. (In a tree of 2 MB, diffuse rays that are sorted by where they start lose a fifth; in
/// trees of 4 and 5 MB they lose a twentieth, and rays to a light gain as much.)
const FAR: usize = 1 << 23;
/// How many rays are looked at, and how many after each.
const LOOKED_AT: usize = 256;
const AFTER: usize = 4;
/// By so many rays the places where neighbours are looked for differ from multiples of a step.
const A_FEW: usize = 5;
/// Of so many first rays one is like most, even if some others are among them.
const FIRST: usize = 4;
/// Rays are in order if most have a neighbour in their cell, where a cell is of 2^8 rays.
const TOGETHER: u32 = 8;
/// Points count as one if they are within such a share of the scene's size: rays to one light end with rounding errors of their own.
const ONE_POINT: f32 = 1.0 / (1 << 20) as f32;
/// Two viewpoints are apart if they are so far from each other, as a share of the scene's size: packets with rays of a stereoscope's two
/// eyes go together as they are. (A fiftieth apart, any hits of a sheet ran at 0.77 of the speed, told apart.)
const APART: f32 = 1.0 / 8.0;
/// How many groups are tried, how many rays each has, and how many the cell that they are from: 2^6.
pub(crate) const GROUPS_TRIED: usize = 8;
pub(crate) const RAYS_OF_A_GROUP: usize = 64;
const CROWD: u32 = 6;

/// What rays gain by an order in a structure.
#[derive(Clone, Copy, Debug)]
pub struct GainByOrder {
    /// Whether rays of a viewpoint or of a beam may go together as groups.
    pub(crate) in_groups: bool,
    /// Whether the tree is far from the core: there other rays gain by starting near each other.
    pub(crate) is_far: bool,
    /// Whether any hit is asked.
    pub(crate) is_any: bool,
    /// No sphere is farther from the coordinates' origin.
    pub(crate) radius: f32,
}

impl GainByOrder {
    /// Returns whether so many rays may gain.
    #[inline(always)]
    pub(crate) fn is_for(&self, rays: usize) -> bool {
        (self.in_groups && rays >= FEWEST_IN_GROUPS) || (self.is_far && rays >= FEWEST)
    }
}

impl RayKeys {
    /// Returns the keys that rays gain by being sorted by; `None` if they are in that order already, or if no keys pay.
    #[inline(never)]
    pub(crate) fn of(rays: &ManyRays<'_>, gain: GainByOrder) -> Option<Self> {
        // Odd, so that rays of both are seen if two cameras take turns.
        let step = (rays.count() / LOOKED_AT).saturating_sub(1) | 1;
        let mut looked_at = [Ray::new(Vec3::ZERO, Vec3::ZERO); LOOKED_AT];
        let mut count = 0;
        for number in 0..LOOKED_AT {
            if let (Some(ray), Some(place)) = (rays.ray(number * step), looked_at.get_mut(count))
                && ray.is_live()
            {
                *place = ray;
                count += 1;
            }
        }
        let some = looked_at.get(..count)?;

        let grid = Grid::along_mean(some.iter(), gain.radius);
        let within = gain.radius * ONE_POINT;
        let in_groups = gain.in_groups && rays.count() >= FEWEST_IN_GROUPS;
        let start = |ray: &Ray| ray.origin;
        // (Not finite if a ray has no end.)
        let end = |ray: &Ray| ray.origin + ray.direction * ray.t_max;
        let is_light = in_groups && gain.is_far && are_one_point(some, end, within);
        let mut viewpoints = None;
        let space = if is_light || (in_groups && are_one_point(some, start, within)) {
            Space::Direction
        } else if in_groups && are_most(some, |ray| grid.is_parallel(ray)) {
            Space::Crossing
        } else {
            viewpoints = if in_groups { two_points(some, gain.radius) } else { None };
            let gains_by_start =
                gain.is_far && (!gain.is_any || are_most(some, |ray| ray.t_max.is_finite()));
            if viewpoints.is_none() && !gains_by_start {
                return None;
            }
            if viewpoints.is_some() { Space::Direction } else { Space::Start }
        };
        let most = if space == Space::Direction { 1.0 } else { gain.radius };
        let keys = match viewpoints {
            None => {
                let grid = grid.laid(space, some.iter(), most);
                Self { space, grid, second: None, are_by_turns: false }
            }
            Some(viewpoints) => {
                let [grid, second] = [false, true].map(|second| {
                    let of_point =
                        some.iter().filter(|ray| is_of_second(viewpoints, ray) == second);
                    Grid::along_mean(of_point.clone(), gain.radius).laid(space, of_point, most)
                });
                let second = Some(SecondGrid { viewpoints, grid: second });
                Self { space, grid, second, are_by_turns: false }
            }
        };

        let cell_of_some = (BITS + TOGETHER).saturating_sub((rays.count() | 1).ilog2()).min(BITS);
        let cell = |number| rays.ray(number).map(|ray| keys.key(&ray) >> cell_of_some);
        // How many have such a neighbour next to them, and among those that follow.
        let [mut next, mut near] = [0; 2];
        for number in 0..LOOKED_AT {
            // A few rays later from one to the next: two cameras may take turns of a divisor of the step.
            let number = number * step + number % step.min(A_FEW);
            let own = cell(number);
            next += usize::from(cell(number + 1) == own);
            near += usize::from((1..=AFTER).any(|after| cell(number + after) == own));
        }
        let [is_next, is_near] = [next, near].map(|count| 4 * count >= 3 * LOOKED_AT);
        let is_in_order = if keys.second.is_some() { is_next } else { is_near };
        (!is_in_order).then_some(Self { are_by_turns: is_near, ..keys })
    }

    /// Returns whether groups of cells are to be tried before all rays are sorted: those of one viewpoint, for closest hits in a near tree.
    /// (If they are tried in a far tree, too, few pass: among a million spheres rays all around from a point run at 1.0 of the speed
    /// unsorted, instead of 0.92, but a beam at 1.0, instead of 1.35, and rays to a light at 0.7 to 1.0, instead of 1.1 to 1.3.)
    pub(crate) fn needs_a_trial(&self, gain: GainByOrder) -> bool {
        self.second.is_none() && !gain.is_any && !gain.is_far && self.space != Space::Start
    }
}

/// Returns whether a tree is so far from the core that rays gain by sharing what they read.
pub(super) fn is_far(bvh: &Bvh<'_>) -> bool {
    bvh.bytes() > FAR
}

/// Sorts places by their keys; `others` is as long.
#[inline(never)]
pub(crate) fn sort(places: &mut [u32], others: &mut [u32]) {
    radix_sort(places, others, BITS / 8, |place| place >> BITS);
}

/// Writes rays of some cells into `groups`: rays that would come one after the other if all were sorted. Returns how many are in
/// each group.
#[inline(never)]
pub(crate) fn gather_some(
    rays: &ManyRays<'_>,
    places: &[u32],
    groups: &mut [[Ray; RAYS_OF_A_GROUP]; GROUPS_TRIED],
) -> [usize; GROUPS_TRIED] {
    /// The most cells: the number of 2^16 rays, the most that there are, has 17 bits.
    const CELLS: usize = (2 * MOST) >> CROWD;
    const NONE: u8 = GROUPS_TRIED as u8;
    let least = (places.len() | 1).ilog2() + 1;
    let bits = BITS + (BITS + CROWD).saturating_sub(least).min(BITS - 1);
    let mut group_of = [NONE; CELLS];
    for number in 0..GROUPS_TRIED {
        let place = places.get(places.len() / GROUPS_TRIED * number).map_or(0, |place| *place);
        group_of[(place >> bits) as usize % CELLS] = number as u8;
    }
    let mut counts = [0; GROUPS_TRIED];
    for place in places {
        let number = group_of[(place >> bits) as usize % CELLS];
        if number != NONE
            && let Some(group) = groups.get_mut(number as usize)
            && let Some(count) = counts.get_mut(number as usize)
            && let Some(free) = group.get_mut(*count)
            && let Some(ray) = rays.ray(number_of(*place))
        {
            *free = ray;
            *count += 1;
        }
    }
    counts
}

/// Writes rays of two viewpoints that take turns into `groups`: each of rays of one viewpoint that follow each other. Returns how many
/// are in each group. (These are of a line, rather than of a cell; but no keys are made for them.)
#[inline(never)]
pub(crate) fn gather_turns(
    rays: &ManyRays<'_>,
    second: &SecondGrid,
    groups: &mut [[Ray; RAYS_OF_A_GROUP]; GROUPS_TRIED],
) -> [usize; GROUPS_TRIED] {
    let mut counts = [0; GROUPS_TRIED];
    for (number, (group, count)) in groups.iter_mut().zip(&mut counts).enumerate() {
        let from = rays.count() / GROUPS_TRIED * number;
        for place in from..from + AFTER * RAYS_OF_A_GROUP {
            if let Some(ray) = rays.ray(place)
                && is_of_second(second.viewpoints, &ray) == (number % 2 == 1)
                && let Some(free) = group.get_mut(*count)
            {
                *free = ray;
                *count += 1;
            }
        }
    }
    counts
}

/// The number of a ray.
#[inline(always)]
pub(crate) const fn number_of(place: u32) -> usize {
    place as usize % MOST
}

/// Returns whether most of the rays have the same `point` as one of the first has.
fn are_one_point(rays: &[Ray], point: impl Fn(&Ray) -> Vec3, within: f32) -> bool {
    rays.iter().take(FIRST).any(|one| {
        let one = point(one);
        are_most(rays, |ray| (point(ray) - one).abs().cmple(Vec3::splat(within)).all())
    })
}

/// Returns two points in which most of the rays start, if no one point is, and they are apart in a scene of that radius.
fn two_points(rays: &[Ray], radius: f32) -> Option<[Vec3; 2]> {
    let within = Vec3::splat(radius * ONE_POINT);
    let is_at = |ray: &Ray, point: Vec3| (ray.origin - point).abs().cmple(within).all();
    // Few rays tell that most pairs are none.
    let (few, some) = (rays.get(..4 * FIRST)?, rays.get(..2 * FIRST)?);
    let mut pairs = some.iter().flat_map(|one| some.iter().map(|other| [one.origin, other.origin]));
    pairs.find(|pair| {
        let [one, other] = *pair;
        if (one - other).abs().max_element() < radius * APART {
            return false;
        }
        let is_of_pair = |ray: &Ray| pair.iter().any(|&point| is_at(ray, point));
        are_most(few, is_of_pair) && are_most(rays, is_of_pair)
    })
}

/// Returns whether something holds for seven of eight rays.
fn are_most(rays: &[Ray], holds: impl Fn(&Ray) -> bool) -> bool {
    8 * rays.iter().filter(|ray| holds(ray)).count() >= 7 * rays.len() && !rays.is_empty()
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
pub(crate) mod tests;
