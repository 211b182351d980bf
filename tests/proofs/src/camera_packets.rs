//! Packets hold the rays of their pixels, bit for bit.

use crate::geometry::camera::{Camera, Projection};
use crate::proofs::climb::Random;
use crate::{LaneArray, Ray, Vec3};

fn camera(random: &mut Random) -> Camera {
    let mut vector = || Vec3::from_array([(); 3].map(|()| random.wide(-6, 6)));
    let (end, corner, step_x, step_y) = (vector(), vector(), vector(), vector());
    let projection = match random.below(2) {
        0 => Projection::Perspective { eye: end },
        _ => Projection::Parallel { direction: end },
    };
    Camera { projection, corner, step_x, step_y }
}

fn bits(ray: &Ray) -> [u32; 8] {
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
    [ox, oy, oz, dx, dy, dz, ray.t_min, ray.t_max].map(f32::to_bits)
}

fn check<A: LaneArray>(expected_tile: (u32, u32)) {
    assert_eq!(Camera::tile::<A>(), expected_tile);
    let (tile_width, tile_height) = expected_tile;
    assert_eq!((tile_width * tile_height) as usize, A::COUNT);
    let mut random = Random(51);
    for _ in 0..300 {
        let camera = camera(&mut random);
        let (width, height) = (1 + random.below(20) as u32, 1 + random.below(20) as u32);
        // Every pixel of the image is in one packet, and nothing else is live.
        let mut pixels = 0;
        for iy in (0..height).step_by(tile_height as usize) {
            for ix in (0..width).step_by(tile_width as usize) {
                let packet = camera.packet::<A>(ix, iy, width, height);
                for lane in 0..A::COUNT as u32 {
                    let (x, y) = (ix + lane % tile_width, iy + lane / tile_width);
                    let inside = x < width && y < height;
                    let expected = if inside { camera.get_ray(x, y) } else { Ray::INACTIVE };
                    assert_eq!(bits(&packet.ray(lane as usize)), bits(&expected));
                    assert!(inside || !packet.ray(lane as usize).is_live());
                    pixels += u32::from(inside);
                }
            }
        }
        assert_eq!(pixels, width * height);
    }
}

#[test]
fn one_pixel() {
    check::<[f32; 1]>((1, 1));
}

#[test]
fn two_by_two() {
    check::<[f32; 4]>((2, 2));
}

#[test]
fn four_by_two() {
    check::<[f32; 8]>((4, 2));
}

#[test]
fn four_by_four() {
    check::<[f32; 16]>((4, 4));
}
