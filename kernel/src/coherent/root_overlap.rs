//! Whether the rays of a group meet the same children of the root: estimated before the group goes further down.
//!
//! # Method
//!
//! The group's frustum says which children the group enters, and the rays of one packet say how many of those a ray enters. The work
//! of the group for these children, with what lies below, is compared with the work of its rays by themselves. (`giving_up.rs` compares
//! all that a group has done, but only once that is as much as all rays take to look into the root. Rays that meet little take less
//! than that in all.)

use super::giving_up::live_rays;
use super::packet_state::PacketState;
use crate::bvh::node::{BvhNode, WIDTH};
use crate::bvh::traverse::boxes::enter_about;
use crate::lanes::{LaneMask, Lanes};
use crate::query::Query;

/// What a child, with what lies below it, takes a group: six nodes; what beginning, ending and looking into the root take a ray by
/// itself; and what a child takes it: a node. In the units of [`Effort`](super::effort::Effort). (Zen 5: 65 to 256 parallel rays through
/// 50,000 spheres far apart run 1.1 to 1.3 times as fast, closest hits of 128 parallel rays over a large sphere 1.08 to 1.15 times. If
/// packets that are tried alone are checked, too, bursts of 16 rays among flakes run at 0.2 to 0.4 of the speed.)
const GROUP_CHILD: u32 = 96;
const RAY: u32 = 2;
const RAY_CHILD: u32 = 5;
/// The same for any hit: much more, since a group that has hit enters no other child. (With as much as for closest hits, 128 and 512
/// rays of a long lens over a large sphere run at 0.5 to 0.6 of the speed. Without a check for any hit, parallel rays through spheres
/// far apart run at 0.9.)
const RAY_CHILD_OF_ANY: u32 = 40;

/// Returns whether it pays that a group enters the children `places` of the root.
#[inline(always)]
pub(super) fn pays<L: Lanes, Q: Query>(
    states: &[PacketState<'_, L>],
    places: u32,
    root: &BvhNode,
) -> bool {
    let (rays, group) = (live_rays(states), GROUP_CHILD * places.count_ones());
    if group <= RAY * rays {
        return true;
    }
    let Some(state) = states.first() else { return true };
    let (mut entered, mut rest) = (0, places);
    while rest != 0 {
        let slot = rest.trailing_zeros() as usize % WIDTH;
        rest &= rest - 1;
        let enter = enter_about(&state.rays, state.rays.end[1], root, slot);
        entered += (enter & state.live).bits().count_ones();
    }
    let asked = state.live.bits().count_ones();
    let ray_child = if Q::ANY { RAY_CHILD_OF_ANY } else { RAY_CHILD };
    group * asked <= rays * (RAY * asked + ray_child * entered)
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests {
    extern crate std;

    use crate::proofs::climb::Random;
    use crate::proofs::work::{Kind, Work};
    use crate::{Exact, Intersect, Ray, SphereList, SphereTree, Vec3};
    use std::vec::Vec;

    #[test]
    fn a_group_whose_rays_meet_other_children_of_the_root_ends_there() {
        let mut random = Random(71);
        let mut unit = || random.below(1 << 20) as f32 / (1 << 19) as f32 - 1.0;
        // Small spheres in two clouds, far apart.
        let mut sphere = |number: usize| {
            let far = if number.is_multiple_of(2) { 300.0 } else { -300.0 };
            (Vec3::new(far + 10.0 * unit(), unit(), 10.0 * unit()), 0.01)
        };
        let tree = SphereTree::new((0..8000).map(&mut sphere).collect::<SphereList>());
        let mut beam = |width: f32, at: Vec3| -> Vec<Ray> {
            let mut origin = || at + Vec3::new(width * unit(), 20.0, 12.0 * width / 310.0 * unit());
            (0..256).map(|_| Ray::new(origin(), Vec3::NEG_Y)).collect()
        };
        let nodes = |rays: &[Ray]| {
            let mut hits = [None; 256];
            let work = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
            for (ray, hit) in rays.iter().zip(&hits) {
                assert_eq!(*hit, tree.closest_hit(Exact, ray));
            }
            [Kind::GroupFit, Kind::GroupNode].map(|kind| work.count(kind))
        };

        // Groups enter the root, and nothing else; packets that are tried alone are not checked.
        let [tried, entered] = nodes(&beam(310.0, Vec3::ZERO));
        assert!(tried > 0 && entered <= tried + tried / 2, "{tried} groups, {entered} nodes");
        // Rays that are side by side go on.
        let [tried, entered] = nodes(&beam(0.5, Vec3::new(300.0, 0.0, 0.0)));
        assert!(entered > tried, "{tried} groups, {entered} nodes");
    }
}
