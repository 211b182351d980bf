//! Rays that are kept as packets, sixteen to a packet, are traced without a copy.

use spherule_kernel::{
    Camera, Exact, HitPacket, Intersect, Projection, RayPacket, SphereTree, Trace, Vec3,
};

const SIDE: u32 = 64;

fn main() {
    // A wall of a hundred spheres.
    let tree = SphereTree::new(
        (0..100)
            .map(|i| [(i % 10) as f32 - 4.5, (i / 10) as f32 - 4.5, -12.0, 0.4])
            .collect::<Vec<_>>(),
    );
    let camera = Camera {
        projection: Projection::Perspective { eye: Vec3::ZERO },
        corner: Vec3::new(-0.5, 0.5, -1.0),
        step_x: Vec3::new(1.0 / SIDE as f32, 0.0, 0.0),
        step_y: Vec3::new(0.0, -1.0 / SIDE as f32, 0.0),
    };

    // A packet is a tile of the picture: its rays look the same way.
    let (width, height) = Camera::tile::<[f32; 16]>();
    let mut rays: Vec<RayPacket> = Vec::new();
    for y in (0..SIDE).step_by(height as usize) {
        for x in (0..SIDE).step_by(width as usize) {
            rays.push(camera.packet(x, y, SIDE, SIDE));
        }
    }
    let mut hits = vec![HitPacket::none(); rays.len()];
    tree.closest_hit_packets(Exact, &mut Trace::new().coherent(), &rays, &mut hits);

    let nearest =
        hits.iter().flat_map(HitPacket::hits).flatten().min_by(|a, b| a.t.total_cmp(&b.t));
    let count = hits.iter().flat_map(HitPacket::hits).flatten().count();
    println!("{count} of {} rays hit; the nearest: {nearest:?}", SIDE * SIDE);
}
