//! Rays that are kept as packets, sixteen to a packet, are traced without a copy; a camera's rays are made on the way.

use spherule_kernel::{
    Camera, CameraTiles, Exact, HitPacket, Intersect, Projection, RayPacket, SphereTree, Trace,
    Vec3,
};

const SIDE: u32 = 64;
const STEP: f32 = 1.0 / SIDE as f32;

fn main() {
    // A wall of a hundred spheres.
    let tree = SphereTree::new(
        (0..100)
            .map(|i| [(i % 10) as f32 - 4.5, (i / 10) as f32 - 4.5, -12.0, 0.4])
            .collect::<Vec<_>>(),
    );
    let camera = Camera {
        projection: Projection::Perspective { eye: Vec3::ZERO },
        // The centre of the first pixel: the picture's edges are at 0.5 to each side.
        corner: Vec3::new(0.5 * STEP - 0.5, 0.5 - 0.5 * STEP, -1.0),
        step_x: Vec3::new(STEP, 0.0, 0.0),
        step_y: Vec3::new(0.0, -STEP, 0.0),
    };

    // A packet is a tile of the picture: its rays look the same way. The tree makes them, and knows what four tiles may
    // meet without a look at their rays.
    let corners: Vec<_> = Camera::tile_corners::<[f32; 16]>(SIDE, SIDE).collect();
    let tiles = CameraTiles { camera, size: (SIDE, SIDE), corners: &corners };
    let mut rays = vec![RayPacket::inactive(); corners.len()];
    let mut hits = vec![HitPacket::none(); corners.len()];
    tree.closest_hit_tiles(Exact, &mut Trace::new().coherent(), tiles, &mut rays, &mut hits);

    // The rays are left for what comes next: here they are traced once more, as packets.
    let mut again = vec![HitPacket::none(); rays.len()];
    tree.closest_hit_packets(Exact, &mut Trace::new().coherent(), &rays, &mut again);
    assert_eq!(hits, again);

    let nearest =
        hits.iter().flat_map(HitPacket::hits).flatten().min_by(|a, b| a.t.total_cmp(&b.t));
    let count = hits.iter().flat_map(HitPacket::hits).flatten().count();
    println!("{count} of {} rays hit; the nearest: {nearest:?}", SIDE * SIDE);
}
