//! Viewing rays, one pixel at a time or a tile of them.
//!
//! A camera is an eye (or, in a parallel projection, a direction), the first pixel of its image plane
//! and the steps from one pixel to the next: vectors only, so that no tangent is needed here.
//! Pixel `(0, 0)` is the one at the corner, `x` grows along `step_x` and `y` along `step_y`.
//!
//! Source: Shirley, Marschner et al., Fundamentals of Computer Graphics, ch. 4.

mod tile_order;
pub(crate) mod tiles;

use super::ray::Ray;

use super::ray_packet::RayPacket;
use crate::lanes::LaneArray;
use glam::Vec3;

/// How pixels become rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// All rays start at `eye`; the plane holds directions, relative to it.
    Perspective {
        /// Where the rays start.
        eye: Vec3,
    },
    /// All rays have this direction; the plane holds origins.
    Parallel {
        /// Where the rays go.
        direction: Vec3,
    },
}

/// Makes viewing rays. Directions are not normalised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Perspective or parallel.
    pub projection: Projection,
    /// The centre of pixel `(0, 0)`: relative to the eye in perspective, in space in parallel. It is the picture's outermost point at
    /// this corner, plus `(step_x + step_y) / 2`.
    pub corner: Vec3,
    /// From a pixel to its right-hand neighbour.
    pub step_x: Vec3,
    /// From a pixel to the one below.
    pub step_y: Vec3,
}

impl Camera {
    /// The ray through pixel `(ix, iy)`, with `t` in `[0, +inf]`.
    ///
    /// Indices are rounded to `f32`: exact up to 2^24.
    ///
    /// ```
    /// use spherule_kernel::{Camera, Projection, Vec3};
    ///
    /// let camera = Camera {
    ///     projection: Projection::Perspective { eye: Vec3::ZERO },
    ///     corner: Vec3::NEG_Z,
    ///     step_x: Vec3::X,
    ///     step_y: Vec3::NEG_Y,
    /// };
    /// assert_eq!(camera.get_ray(2, 1).direction, Vec3::new(2.0, -1.0, -1.0));
    /// ```
    #[must_use]
    #[inline]
    pub fn get_ray(&self, ix: u32, iy: u32) -> Ray {
        let on_plane = self.corner + ix as f32 * self.step_x + iy as f32 * self.step_y;
        match self.projection {
            Projection::Perspective { eye } => Ray::new(eye, on_plane),
            Projection::Parallel { direction } => Ray::new(on_plane, direction),
        }
    }

    /// The width and height in pixels of the tile that fills a packet: as square as can be.
    ///
    /// ```
    /// use spherule_kernel::Camera;
    ///
    /// assert_eq!(Camera::tile::<[f32; 16]>(), (4, 4));
    /// ```
    #[must_use]
    pub const fn tile<A: LaneArray>() -> (u32, u32) {
        let mut height = 1;
        while height * height * 4 <= A::COUNT {
            height *= 2;
        }
        ((A::COUNT / height) as u32, height as u32)
    }

    /// The rays of the tile whose first pixel is `(ix, iy)`, row by row; lanes outside the image
    /// of `width` x `height` pixels are inactive. Bit for bit [`Camera::get_ray`] of each pixel.
    ///
    /// ```
    /// use spherule_kernel::{Camera, Projection, Vec3};
    ///
    /// let camera = Camera {
    ///     projection: Projection::Perspective { eye: Vec3::ZERO },
    ///     corner: Vec3::NEG_Z,
    ///     step_x: Vec3::X,
    ///     step_y: Vec3::NEG_Y,
    /// };
    /// let packet = camera.packet::<[f32; 16]>(0, 0, 3, 4);
    /// assert_eq!(packet.ray(5), camera.get_ray(1, 1));
    /// // The last column is outside of the picture.
    /// assert_eq!(packet.live(), 0b0111_0111_0111_0111);
    /// ```
    #[must_use]
    pub fn packet<A: LaneArray>(&self, ix: u32, iy: u32, width: u32, height: u32) -> RayPacket<A> {
        let (tile_width, _) = Self::tile::<A>();
        let mut packet = RayPacket::<A>::inactive();
        for lane in 0..A::COUNT as u32 {
            let x = ix.saturating_add(lane % tile_width);
            let y = iy.saturating_add(lane / tile_width);
            if x < width && y < height {
                packet.set(lane as usize, &self.get_ray(x, y));
            }
        }
        packet
    }
}
