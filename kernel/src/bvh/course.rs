//! Where the rays of a bundle run, and the planes around them.

use super::Bvh;
use super::frustum::{Frustum, Line, Sides, across, margin, turn};
use super::member::Member;
use super::slabs::U;
use crate::axes::axes;
use crate::{Accuracy, LaneMask, Lanes};

/// The widest range of slopes that is walked as one.
const NARROW: f32 = 0.5;
/// The least |n_k|.
const ALONG: f32 = 1.0 / 16.0;
/// The largest of an expression in the live lanes of some members; `-inf` where none is live.
macro_rules! greatest_of {
    ($members:expr, $member:ident => $value:expr) => {{
        let mut lanes = None;
        for $member in $members.iter() {
            let value: L = $value;
            let value = L::select($member.live, value, value.like(f32::NEG_INFINITY));
            lanes = Some(match lanes {
                Some(so_far) => value.filter_max(so_far),
                None => value,
            });
        }
        match lanes {
            Some(lanes) => lanes.filter_greatest(),
            None => f32::NEG_INFINITY,
        }
    }};
}

/// Where the rays of a bundle run.
pub(super) struct Course {
    along: usize,
    /// Which way along: 1 or -1.
    sign: f32,
    /// The largest of [`Approach::aside`](super::approach::Approach::aside).
    aside: f32,
    /// What `Fast` adds to depths.
    spread: f32,
    /// Where all rays start, if they do so in one point.
    origin: Option<[f32; 3]>,
}

impl Course {
    /// Nothing where not all rays run the same way, and far enough, along an axis.
    #[inline(always)]
    pub(super) fn of<A: Accuracy, L: Lanes>(
        members: &[Member<'_, L>],
        bvh: &Bvh<'_>,
    ) -> Option<Self> {
        let mut first = None;
        for member in members {
            if !member.covered {
                return None;
            }
            if first.is_none() && member.live.any() {
                first = Some((member, member.live.bits().trailing_zeros() as usize));
            }
        }
        let (member, lane) = first?;
        let [x, y, z] = axes!(i => *member.direction[i].store().as_ref().get(lane)?);
        let (along, travel) = if x.abs() >= y.abs() && x.abs() >= z.abs() {
            (0, x)
        } else if y.abs() >= z.abs() {
            (1, y)
        } else {
            (2, z)
        };
        let sign = if travel < 0.0 { -1.0 } else { 1.0 };
        let origin = axes!(i => *member.origin[i].store().as_ref().get(lane)?);
        let aside = *member.aside.store().as_ref().get(lane)?;

        let mut one_origin = true;
        for member in members {
            let (live, o) = (member.live, member.origin);
            let forward = member.direction[along % 3] * member.aside.like(sign);
            if (live & forward.lt(forward.like(ALONG))).any() {
                return None;
            }
            let [x, y, z] = axes!(i => {
                let shared = o[i].like(origin[i]);
                o[i].lt(shared) | shared.lt(o[i])
            });
            one_origin = one_origin && !member.moved && !(live & (x | y | z)).any();
        }
        let aside = if one_origin { aside } else { greatest_of!(members, m => m.aside) };
        let spread = 4.0 * A::SPREAD * (bvh.extent + aside * (0.125 / U));
        let origin = one_origin.then_some(origin);
        Some(Self { along, sign, aside, spread, origin })
    }

    /// The planes around some members, whose slopes along the axes across lie in `slopes`: least
    /// and greatest, per depth.
    #[inline(always)]
    fn sides<L: Lanes>(&self, members: &[Member<'_, L>], slopes: [[f32; 2]; 2]) -> Sides {
        let k = self.along % 3;
        let mut sides = Sides { along: k, ..Sides::NONE };
        let [[a, b], [c, d]] = slopes;
        let steepest = a.abs().max(b.abs()).max(c.abs().max(d.abs()));
        let (turn, margin) = (turn(steepest), margin(steepest, self.aside));
        for ((i, [low, high]), lines) in across(k).into_iter().zip(slopes).zip(&mut sides.lines) {
            let low = self.sign * (low - turn);
            let high = self.sign * (high + turn);
            let (least, most) = match self.origin {
                Some(origin) => (origin[i % 3] - low * origin[k], origin[i % 3] - high * origin[k]),
                None => {
                    let least = -greatest_of!(members, m => {
                        m.origin[k] * m.aside.like(low) - m.origin[i % 3]
                    });
                    let most = greatest_of!(members, m => {
                        m.origin[i % 3] - m.origin[k] * m.aside.like(high)
                    });
                    (least, most)
                }
            };
            *lines = [Line::new(low, least - margin), Line::new(high, most + margin)];
        }
        sides
    }

    /// What the rays cannot leave, and the same for each member; nothing where they are not narrow.
    #[inline(always)]
    pub(super) fn enclose<L: Lanes>(&self, members: &mut [Member<'_, L>]) -> Option<Frustum> {
        let k = self.along % 3;
        let mut all = [[f32::INFINITY, f32::NEG_INFINITY]; 2];
        for member in &mut *members {
            let per_depth = member.aside.like(self.sign) / member.direction[k];
            let mut slopes = all;
            for ((i, [low, high]), all) in across(k).into_iter().zip(&mut slopes).zip(&mut all) {
                let slope = member.direction[i % 3] * per_depth;
                let none = slope.like(f32::NEG_INFINITY);
                *high = L::select(member.live, slope, none).filter_greatest();
                *low = -L::select(member.live, -slope, none).filter_greatest();
                *all = [all[0].min(*low), all[1].max(*high)];
            }
            member.sides = self.sides(core::slice::from_ref(&*member), slopes);
        }
        if all[0][1] - all[0][0] > NARROW || all[1][1] - all[1][0] > NARROW {
            return None;
        }
        let start = match self.origin {
            Some(origin) => self.sign * origin[k],
            None => -greatest_of!(members, m => m.origin[k] * m.aside.like(-self.sign)),
        };
        Some(Frustum {
            sides: self.sides(members, all),
            sign: self.sign,
            start: start - margin(0.0, self.aside),
            end: self.end(members),
        })
    }

    /// The greatest depth that a ray still goes to, raised by the margin.
    #[inline(always)]
    pub(super) fn end<L: Lanes>(&self, members: &[Member<'_, L>]) -> f32 {
        let k = self.along % 3;
        let end = greatest_of!(members, m => {
            let (sign, per_depth) = (m.aside.like(self.sign), m.direction[k]);
            (m.best * per_depth + m.origin[k]) * sign
        });
        // Where no ray goes on, the end is -inf.
        let raise = 16.0 * U * end.abs().min(f32::MAX);
        end + raise + 2.0 * margin(0.0, self.aside) + self.spread
    }
}
