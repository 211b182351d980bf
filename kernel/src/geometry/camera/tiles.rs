//! Tiles of a camera's picture: packets that are made where they are traced.

use super::{Camera, Projection};
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, Lanes};
use crate::numeric::axes::axes;
use crate::numeric::rounding::U;
use wide::f32x4;

/// The tiles of a camera's picture that are to be traced, a packet each.
///
/// A tree knows, without reading any ray, that each tile lies between its four corner pixels. Four consecutive tiles go
/// through a tree together, so they should be neighbours in the picture, in a square if possible.
#[derive(Clone, Copy, Debug)]
pub struct CameraTiles<'a> {
    /// Where the rays start, and go.
    pub camera: Camera,
    /// The picture's width and height in pixels: rays of pixels outside are inactive.
    pub size: (u32, u32),
    /// The first pixel of each tile; its width and height are [`Camera::tile`]'s.
    pub corners: &'a [(u32, u32)],
}

/// 2^24: `f32` holds indices below it exactly.
const EXACT: u32 = 1 << 24;

/// The largest error of a point, relative to the terms that it is summed of.
pub(crate) const POINT_ERROR: f32 = 4.0 * U;

impl CameraTiles<'_> {
    /// Makes the rays of the tiles that begin at `corners`, as many as there is room for; returns whether each of them is
    /// whole.
    #[inline(always)]
    pub(crate) fn fill<L: Lanes>(
        &self,
        token: L::Token,
        corners: &[(u32, u32)],
        packets: &mut [RayPacket<L::Array>],
    ) -> bool {
        let mut whole = true;
        for number in 0..packets.len().min(corners.len()) {
            if let (Some(packet), Some(&corner)) = (packets.get_mut(number), corners.get(number)) {
                whole &= self.write::<L>(token, corner, packet);
            }
        }
        whole
    }

    /// Makes the packet of a tile; returns whether all of its pixels are in the picture.
    #[inline(always)]
    fn write<L: Lanes>(
        &self,
        token: L::Token,
        corner: (u32, u32),
        packet: &mut RayPacket<L::Array>,
    ) -> bool {
        if !self.is_whole::<L::Array>(corner) {
            let (camera, (width, height)) = (&self.camera, self.size);
            L::out_of_line(token, || *packet = camera.packet(corner.0, corner.1, width, height));
            return false;
        }
        let (tile_width, _) = Camera::tile::<L::Array>();
        let (mut columns, mut rows) = (L::Array::ZEROS, L::Array::ZEROS);
        for lane in 0..L::COUNT {
            columns.set(lane, (lane as u32 % tile_width) as f32);
            rows.set(lane, (lane as u32 / tile_width) as f32);
        }
        // Sums of whole numbers below 2^24 are exact.
        let column = L::load(token, &columns) + L::splat(token, corner.0 as f32);
        let row = L::load(token, &rows) + L::splat(token, corner.1 as f32);
        let Camera { projection, corner, step_x, step_y } = &self.camera;
        let (from, step_x, step_y) = (corner.to_array(), step_x.to_array(), step_y.to_array());
        let on_plane = axes!(i => {
            (L::splat(token, from[i]) + column * L::splat(token, step_x[i])
                + row * L::splat(token, step_y[i])).store()
        });
        let (is_parallel, shared) = match projection {
            Projection::Perspective { eye } => (false, eye.to_array()),
            Projection::Parallel { direction } => (true, direction.to_array()),
        };
        let shared = axes!(i => L::Array::filled(shared[i]));
        if is_parallel {
            (packet.origin, packet.direction) = (on_plane, shared);
        } else {
            (packet.origin, packet.direction) = (shared, on_plane);
        }
        (packet.t_min, packet.t_max) = (L::Array::ZEROS, L::Array::INFINITIES);
        true
    }

    /// Whether all pixels of a tile are in the picture, and `f32` holds their indices exactly.
    #[inline(always)]
    fn is_whole<A: LaneArray>(&self, (left, top): (u32, u32)) -> bool {
        let (tile_width, tile_height) = Camera::tile::<A>();
        let (width, height) = (self.size.0.min(EXACT), self.size.1.min(EXACT));
        left < width && top < height && width - left >= tile_width && height - top >= tile_height
    }

    /// The points on the image plane of the corner pixels of up to four whole tiles, a tile a lane: the same bits as the rays have.
    #[inline(always)]
    pub(crate) fn corner_points<A: LaneArray>(&self, tiles: &[(u32, u32)]) -> [[f32x4; 3]; 4] {
        let (tile_width, tile_height) = Camera::tile::<A>();
        let (mut left, mut top) = ([0.0; 4], [0.0; 4]);
        for lane in 0..4 {
            // Lanes past the last tile repeat it.
            if let Some(&(x, y)) = tiles.get(lane.min(tiles.len().saturating_sub(1))) {
                (left[lane], top[lane]) = (x as f32, y as f32);
            }
        }
        let (left, top) = (f32x4::new(left), f32x4::new(top));
        let right = left + f32x4::splat((tile_width - 1) as f32);
        let bottom = top + f32x4::splat((tile_height - 1) as f32);
        let Camera { corner, step_x, step_y, .. } = &self.camera;
        let (from, step_x, step_y) = (corner.to_array(), step_x.to_array(), step_y.to_array());
        let [a, b, c] = axes!(i => {
            let (from, step_x, step_y) =
                (f32x4::splat(from[i]), f32x4::splat(step_x[i]), f32x4::splat(step_y[i]));
            let (left, right) = (from + left * step_x, from + right * step_x);
            let (up, down) = (top * step_y, bottom * step_y);
            [left + up, right + up, left + down, right + down]
        });
        [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]], [a[3], b[3], c[3]]]
    }

    /// The largest distance of pixels' points from where they would be without rounding, coordinate by coordinate.
    #[inline(always)]
    pub(crate) fn point_error(&self) -> [f32; 3] {
        let Camera { corner, step_x, step_y, .. } = &self.camera;
        let (from, step_x, step_y) = (corner.to_array(), step_x.to_array(), step_y.to_array());
        let (width, height) = (self.size.0 as f32, self.size.1 as f32);
        axes!(i => {
            POINT_ERROR * (from[i].abs() + width * step_x[i].abs() + height * step_y[i].abs())
        })
    }
}
