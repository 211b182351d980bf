//! What planes around a group of rays must be moved by, and how far off the points of a camera's pixels are.
//!
//! Let x be where a ray of slope w meets a sphere, at a depth Z past its origin, and W and D the slope and the offset of the
//! plane below, as computed. In real arithmetic W c_k + D is c_i + (x_i - c_i) - W (x_k - c_k) + (W - w) Z, less the margin; the
//! middle is at most r times the length of the normal of W. So the sphere passes if the margin, (w - W) Z and what radii are
//! larger by exceed all roundings, term by term in F, Z and r.

use super::{NAMES, U, find, ray, rules, sum_of};
use crate::bvh::traverse::prepared_ray::{ABSOLUTE_ERROR, PreparedLanes};
use crate::coherent::frustum::{Outline, Sides, length, margin, turn};
use crate::geometry::camera::tiles::{CameraTiles, POINT_ERROR};
use crate::geometry::sphere_columns::SphereColumns;
use crate::proofs::polynomial::Polynomial;
use crate::proofs::recorded::{Operation, Recorded, record};
use crate::scale::rays::ScaledRays;
use crate::{Camera, Lanes, Projection, RayPacket, Vec3};

/// From the text, in u: 2^-36 P, of Z (1 + |w|), with |p| <= 33 Z; o' is not on its line, of F (1 + |w|); the answer is not the
/// root, of r and the normal's length.
const FROM_THE_TEXT: [f64; 3] = [33.0 / 4096.0, 1.0, 28.0];
/// The same: the centre is rounded in the frame of a depth list, of Z |w|, and of r and the normal's length.
const IN_A_FRAME: [f64; 2] = [2.0, 2.0];
/// |w| and 1 are at most so many times 1 + w^2 / 2, which is counted as the length of a normal.
const PER_LENGTH: [f64; 2] = [core::f64::consts::FRAC_1_SQRT_2, 1.0];

/// In u: how much slopes must be turned by, of |w| and besides; how much planes must be moved by, in absolute errors; how much larger radii
/// must be.
pub(in crate::proofs) struct Needs {
    pub(in crate::proofs) turn: [f64; 2],
    pub(in crate::proofs) margin: f64,
    pub(in crate::proofs) larger: f64,
}

pub(in crate::proofs) fn needs() -> Needs {
    let witness = [0.1, 0.2, 0.3, 0.25, 0.5, 1.0, 3.0, 2.0, 9.0, 1.5];
    let ((slope, low, moved, long), graph) = record(witness, |inputs| {
        let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = inputs;
        let scaled = ScaledRays::new(&ray([ox, oy, oz], [dx, dy, dz]), 1.0);
        let PreparedLanes { origin, direction, absolute_error, .. } =
            PreparedLanes::as_they_are(&scaled);
        // As a fit does, along z.
        let slope = direction[0] * (dx.like(1.0) / direction[2]);
        let low = slope - turn(slope.abs());
        let moved = margin(slope.abs(), absolute_error);
        let offset = origin[0] - low * origin[2] - moved;
        let long = length(low);
        let [slopes, offsets, lengths] = [low, offset, long].map(|node| [node.tag(); 4]);
        let sides = Sides { along: 2, slope: slopes, offset: offsets, length: lengths };
        let [cx, cy, cz, r] = [cx, cy, cz, r].map(|node| [node.tag(); 16]);
        let spheres = SphereColumns { center: [&cx, &cy, &cz], radius: &r };
        let _ = sides.look::<Recorded>((), &spheres, Outline::Sphere);
        (slope, low, moved, long)
    });
    let index = |wanted: Operation| find(&graph, |operation| operation == wanted);
    let [cx, cz, r] = [6, 8, 9].map(|input| index(Operation::Input(input)));
    // Where the plane lies, and how far a sphere reaches.
    let least = sum_of(&graph, index(Operation::Product(cz, low.0)));
    let highest = sum_of(&graph, index(Operation::Product(r, long.0)));
    assert!(matches!(graph[highest], Operation::Sum(_, across) if across == cx));

    let mut rules = rules(NAMES);
    rules.name(slope.0, "w");
    rules.name(low.0, "W");
    rules.name(long.0, "L");
    for node in [low.0, long.0, moved.0] {
        rules.free(node);
    }
    rules.run(&graph);
    let own = rules.symbol("w");
    let off = rules.off_by(own);
    let mut error = rules.bound(least).error() + rules.bound(highest).error();

    let [f, z, radius, slope, long] = ["F", "Z", "r", "W", "L"].map(|name| rules.symbol(name));
    let [far, deep, wide] = [f, z, radius].map(Polynomial::symbol);
    let along = &(&far + &deep) + &wide;
    let across = &(&far + &(&Polynomial::symbol(slope) * &deep)) + &wide;
    for (name, bound) in [("ox", &far), ("oz", &far), ("cz", &along), ("cx", &across)] {
        error = error.with(rules.symbol(name), bound);
    }
    let of = |powers: &[(usize, i32)]| error.coefficient(powers) / U;
    let [text_z, text_f, text_r] = FROM_THE_TEXT;
    let of_f = of(&[(f, 1)]).max(of(&[(f, 1), (slope, 1)])) + text_f;
    let of_r = of(&[(radius, 1)]) * PER_LENGTH[1]
        + of(&[(radius, 1), (slope, 1)]) * PER_LENGTH[0]
        + of(&[(radius, 1), (long, 1)]);
    Needs {
        // The slope itself, and its difference with the turn.
        turn: [
            off / U + 1.0 + of(&[(z, 1), (slope, 1)]) + text_z + IN_A_FRAME[0],
            of(&[(z, 1)]) + text_z,
        ],
        margin: of_f / f64::from(ABSOLUTE_ERROR),
        larger: of_r + text_r + IN_A_FRAME[1],
    }
}

/// In u: the error of a pixel's point, relative to the terms that it is summed of.
pub(in crate::proofs) fn point_error() -> f64 {
    // Of indices that are as large as the picture.
    let (column, row) = (3, 5);
    let names = ["corner", "step x", "step y"];
    let (point, graph) = record([1.0, 0.5, 0.25], |[corner, step_x, step_y]| {
        let [corner, step_x, step_y] = [corner, step_x, step_y].map(|node| Vec3::splat(node.tag()));
        let projection = Projection::Perspective { eye: Vec3::ZERO };
        let camera = Camera { projection, corner, step_x, step_y };
        let tiles = CameraTiles { camera, size: (16, 16), corners: &[(column, row)] };
        let mut packets = [RayPacket::<[f32; 1]>::inactive()];
        assert!(tiles.fill::<Recorded>((), tiles.corners, &mut packets));
        Recorded::splat((), packets[0].direction[0][0])
    });
    let mut rules = rules(names);
    for (node, operation) in graph.iter().enumerate() {
        // Sums of whole numbers are exact.
        if let Operation::Sum(a, b) = *operation
            && [a, b].iter().all(|part| matches!(graph[*part], Operation::Constant(_)))
        {
            rules.free(node);
        }
    }
    rules.run(&graph);
    let [corner, step_x, step_y] = names.map(|name| Polynomial::symbol(rules.symbol(name)));
    let whole = &(&corner + &step_x.scaled(column.into())) + &step_y.scaled(row.into());
    rules.bound(point.0).error().over(&whole) / U
}

/// How often the error of a point must count in slopes: at a corner and at the pixel, each off by what it is, where the
/// depths that are divided by may be less by three errors, of which each is 1/64 of them.
pub(in crate::proofs) fn errors_of_points(most: f64) -> f64 {
    2.0 * point_error() * U / f64::from(POINT_ERROR) / (1.0 - 3.0 * most)
}
