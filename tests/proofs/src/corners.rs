//! No pixel of a tile is outside of what its corners say: slopes and offsets of all pixels, in doubles, are compared
//! with those of the corners, moved by the errors of points alone. Cameras are made so that points are mostly rounding.

use crate::coherent::tile_fit::Points;
use crate::geometry::camera::tiles::CameraTiles;
use crate::proofs::climb::Random;
use crate::{Camera, Projection, Vec3, f32x4};
use std::println;

/// A camera that looks along z, more or less; rounding is as large as steps are, or much smaller.
fn camera(random: &mut Random) -> (Camera, (u32, u32)) {
    let corner = (random.below(1 << 22) as u32, random.below(1 << 22) as u32);
    let mut vector =
        |low: i32, high: i32| Vec3::from_array([(); 3].map(|()| random.wide(low, high)));
    let (mut step_x, mut step_y, towards) = (vector(-34, -6), vector(-34, -6), vector(-4, 0));
    // Slopes in between at the tile, whatever is lost on the way there.
    (step_x.z, step_y.z) = (step_x.z / 64.0, step_y.z / 64.0);
    let at_tile = Vec3::new(towards.x, towards.y, 1.0);
    let corner_point = at_tile - corner.0 as f32 * step_x - corner.1 as f32 * step_y;
    let projection = Projection::Perspective { eye: Vec3::ZERO };
    (Camera { projection, corner: corner_point, step_x, step_y }, corner)
}

/// The part that is needed of what planes are moved by: by slopes, and by offsets of a slope.
fn needed(random: &mut Random) -> [Option<f64>; 2] {
    let (camera, corner) = camera(random);
    let size = (corner.0 + 4, corner.1 + 4);
    let tiles = CameraTiles { camera, size, corners: &[corner] };
    let points = Points {
        at_corners: tiles.corner_points::<[f32; 16]>(&[corner]),
        error: tiles.point_error(),
        heading: (2, 1.0),
    };
    let exact = Points { error: [0.0; 3], at_corners: points.at_corners, ..points };
    let pixels = (0..16).map(|i| camera.get_ray(corner.0 + i % 4, corner.1 + i / 4).direction);
    let mut most = [None::<f64>; 2];

    if let (Some(moved), Some(as_they_are)) = (points.slopes(false), exact.slopes(false)) {
        for (side, axis) in [0, 1].into_iter().enumerate() {
            let [minus_low, high] = moved[side].map(|ends| f64::from(ends.to_array()[0]));
            let off = high - f64::from(as_they_are[side][1].to_array()[0]);
            for d in pixels.clone() {
                let slope = f64::from(d[axis]) / f64::from(d.z);
                // The division and the product of a corner's, which the turn for rays covers.
                let rounding = 3.0 * 2.0_f64.powi(-24) * slope.abs();
                let outside = (slope - high).max(-minus_low - slope) - rounding;
                assert!(outside <= 0.0, "{slope}: {camera:?}, {corner:?}");
                if off > 8.0 * rounding {
                    most[0] = Some(((outside + off) / off).max(most[0].unwrap_or(0.0)));
                }
            }
        }
    }

    // The same points as origins of parallel rays of that slope.
    let slope = random.wide(-6, 0);
    let both = [[f32x4::splat(slope); 2]; 2];
    let (steepest, none) = (f32x4::splat(slope.abs()), f32x4::ZERO);
    let moved = points.offsets(&both, steepest, 1.0, none);
    let as_they_are = exact.offsets(&both, steepest, 1.0, none);
    for (side, axis) in [0, 1].into_iter().enumerate() {
        let [low, high] = moved[side].map(|ends| f64::from(ends.to_array()[0]));
        let off = high - f64::from(as_they_are[side][1].to_array()[0]);
        for o in pixels.clone() {
            let offset = f64::from(o[axis]) - f64::from(slope) * f64::from(o.z);
            // As above: the margin for rays covers it.
            let rounding =
                3.0 * 2.0_f64.powi(-24) * f64::from(o[axis].abs() + slope.abs() * o.z.abs());
            let outside = (offset - high).max(low - offset) - rounding;
            assert!(outside <= 0.0, "{offset}, slope {slope}: {camera:?}, {corner:?}");
            if off > 8.0 * rounding {
                most[1] = Some(((outside + off) / off).max(most[1].unwrap_or(0.0)));
            }
        }
    }
    most
}

#[test]
fn no_pixel_is_outside_of_its_corners() {
    let mut random = Random(52);
    let (mut most, mut seen) = ([0.0_f64; 2], [0; 2]);
    for _ in 0..1_000_000 {
        for (kind, needed) in needed(&mut random).into_iter().enumerate() {
            if let Some(needed) = needed {
                most[kind] = most[kind].max(needed);
                seen[kind] += 1;
            }
        }
    }
    println!("of what slopes and offsets are moved by, {most:.2?} is needed, of {seen:?} tiles");
    // Without it, pixels are outside.
    assert!(most.iter().all(|most| (0.05..=1.0).contains(most)), "{most:?}");
    assert!(seen.iter().all(|&seen| seen > 5_000), "{seen:?}");
}
