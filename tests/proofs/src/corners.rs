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
    // Holds a pixel's number against the ends of its tile, of which the upper one is moved by `off`. What a corner's division and product
    // lose, the turn and the margin for rays cover.
    let mut hold = |kind: usize, number: f64, [low, high]: [f64; 2], off: f64, size: f64| {
        let rounding = 3.0 * 2.0_f64.powi(-24) * size;
        let outside = (number - high).max(low - number) - rounding;
        assert!(outside <= 0.0, "{kind}, {number}: {camera:?}, {corner:?}");
        if off > 8.0 * rounding {
            most[kind] = Some(((outside + off) / off).max(most[kind].unwrap_or(0.0)));
        }
    };
    let ends = |side: [f32x4; 2]| side.map(|ends| f64::from(ends.to_array()[0]));

    if let (Some(moved), Some(as_they_are)) = (points.slopes(false), exact.slopes(false)) {
        for axis in 0..2 {
            let ([minus_low, high], [_, exact]) = (ends(moved[axis]), ends(as_they_are[axis]));
            for d in pixels.clone() {
                let slope = f64::from(d[axis]) / f64::from(d.z);
                hold(0, slope, [-minus_low, high], high - exact, slope.abs());
            }
        }
    }

    // The same points as origins of parallel rays of that slope.
    let slope = random.wide(-6, 0);
    let both = [[f32x4::splat(slope); 2]; 2];
    let (steepest, none) = (f32x4::splat(slope.abs()), f32x4::ZERO);
    let moved = points.offsets(&both, steepest, 1.0, none);
    let as_they_are = exact.offsets(&both, steepest, 1.0, none);
    for axis in 0..2 {
        let ([low, high], [_, exact]) = (ends(moved[axis]), ends(as_they_are[axis]));
        for o in pixels.clone() {
            let offset = f64::from(o[axis]) - f64::from(slope) * f64::from(o.z);
            let size = f64::from(o[axis].abs() + slope.abs() * o.z.abs());
            hold(1, offset, [low, high], high - exact, size);
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
