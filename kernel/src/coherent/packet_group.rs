//! The packets of a group: how they begin, and meet a block of spheres together.

use super::effort::Effort;
use super::frustum::Outline;
use super::packet_state::PacketState;
use crate::Accuracy;
use crate::bvh::source::SphereSource;
use crate::bvh::traverse::prepared_ray::far_away;
use crate::count::count;
use crate::geometry::sphere_columns::SphereColumns;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::rounding::most;
use crate::query::Query;

/// How many packets go together.
pub(super) const GROUP: usize = 4;

/// Tests the spheres `places` of sixteen, which begin at `depth`, with every packet that goes so deep and whose planes do
/// not exclude them, by that outline. If a packet's depth changes, `end` becomes the greatest depth that any packet
/// still goes to. `effort` is counted.
#[inline(always)]
pub(super) fn meet_block<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    source: &impl SphereSource,
    states: &mut [PacketState<'_, L>],
    (number, spheres, depth): (u32, &SphereColumns<'_>, f32),
    (places, outline): (u32, Outline),
    depth_of: impl Fn(&PacketState<'_, L>) -> f32,
    (end, effort): (&mut f32, &mut Effort),
) {
    let (mut any_changed, mut held) = (false, 0_u64);
    for state in &mut *states {
        // (This saves 3 % of the time of u10k, 6 % of u1m's.)
        if depth > state.depth {
            continue;
        }
        count!(PacketLeaf);
        let places = places & state.sides.look::<L>(state.token(), spheres, outline);
        held = (held << 16) | u64::from(places);
        if places != 0 && state.meet::<Q>(tier, source, (number, spheres), places, effort) {
            state.depth = depth_of(state);
            any_changed = true;
        }
    }
    effort.spheres(held.count_ones());
    if any_changed {
        *end = f32::NEG_INFINITY;
        for state in &*states {
            *end = most(*end, state.depth);
        }
    }
}

/// Lets new packets of a tree that is scaled by `factor` begin once more, if any of their rays are far away (then nearer to a
/// scene of that extent) or have no usual length. In place, since a choice between two states costs a tenth of a group's
/// time.
#[inline(always)]
pub(super) fn approach<L: Lanes>(
    tier: impl Accuracy,
    states: &mut [PacketState<'_, L>],
    factor: f32,
    extent: f32,
) {
    let Some(first) = states.first() else { return };
    let (token, moves, squares) = (first.token(), tier.spread() == 0.0, tier.squares());
    let (mut covered, mut far) = (true, far_away(first.live, first.rays.absolute_error, extent));
    let mut overflows = first.live & first.rays.may_overflow(squares, factor, extent);
    for state in states.iter() {
        covered &= state.covered;
        far = far | far_away(state.live, state.rays.absolute_error, extent);
        overflows = overflows | state.live & state.rays.may_overflow(squares, factor, extent);
    }
    if covered && !(moves && far.any()) && !overflows.any() {
        return;
    }
    L::out_of_line(
        token,
        #[inline(always)]
        || {
            for state in states {
                state.approach((factor, extent), (squares, moves));
            }
        },
    );
}
