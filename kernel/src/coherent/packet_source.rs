//! Where the packets of a call come from: memory, rays of a caller's, or a camera.

use super::fit::Fit;
use super::frustum::Frustum;
use super::packet_state::PacketState;
use super::tile_fit;
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::many::ManyRays;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, Lanes};
use core::ops::Range;

/// The packets of a call.
#[derive(Debug)]
#[cfg_attr(not(feature = "std"), expect(unreachable_pub, reason = "a trait of levels names it"))]
pub enum PacketSource<'a, A: LaneArray> {
    /// Packets that are in memory.
    Packets(&'a [RayPacket<A>]),
    /// Packets that are filled with rays, a group at a time, in memory whose contents do not matter.
    #[cfg_attr(not(feature = "std"), expect(dead_code, reason = "levels alone make them there"))]
    Rays(&'a ManyRays<'a>, &'a mut [RayPacket<A>]),
    /// Packets that are made, a group at a time, in memory whose contents do not matter.
    Tiles(CameraTiles<'a>, &'a mut [RayPacket<A>]),
}

impl<A: LaneArray> PacketSource<'_, A> {
    /// Returns how many packets there are.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Packets(packets) => packets.len(),
            Self::Rays(rays, packets) => packets.len().min(rays.count().div_ceil(A::COUNT)),
            Self::Tiles(tiles, packets) => packets.len().min(tiles.corners.len()),
        }
    }

    /// Makes those packets; returns whether they are whole tiles of a camera.
    #[inline(always)]
    pub(super) fn make<L: Lanes<Array = A>>(&mut self, token: L::Token, at: Range<usize>) -> bool {
        match self {
            Self::Packets(_) => false,
            Self::Rays(rays, packets) => {
                if let Some(packets) = packets.get_mut(at.clone()) {
                    L::out_of_line(
                        token,
                        #[inline(always)]
                        || rays.fill::<L>(token, at.start, packets),
                    );
                }
                false
            }
            Self::Tiles(tiles, packets) => {
                match (packets.get_mut(at.clone()), tiles.corners.get(at)) {
                    (Some(packets), Some(corners)) => tiles.fill::<L>(token, corners, packets),
                    _ => false,
                }
            }
        }
    }

    /// Returns packets that were made.
    #[inline(always)]
    pub(super) fn packets(&self, at: Range<usize>) -> &[RayPacket<A>] {
        match self {
            Self::Packets(packets) => packets.get(at),
            Self::Rays(_, packets) | Self::Tiles(_, packets) => packets.get(at),
        }
        .unwrap_or_default()
    }

    /// Returns the planes around a group of whole tiles; `None` if their corners do not tell.
    #[inline(always)]
    pub(super) fn enclose<L: Lanes<Array = A>>(
        &self,
        at: Range<usize>,
        states: &mut [PacketState<'_, L>],
        size: (f32, f32, f32, f32),
    ) -> Option<(Fit, Frustum)> {
        let Self::Tiles(tiles, _) = self else { return None };
        let (corners, token) = (tiles.corners.get(at)?, states.first()?.token());
        // Out of the way of packets that are in memory.
        L::out_of_line(
            token,
            #[inline(always)]
            || tile_fit::enclose(tiles, corners, states, size),
        )
    }
}
