//! Lanes of one's own: the same source in one lane, four, eight and sixteen, with the same bits.
//!
//! `Lanes` is implemented here by `f32`, which is the form for targets without SIMD, and by the vectors of
//! the crate `wide`. Any other vector type can implement it.

use spherule_kernel::{
    Exact, Hit, HitPacket, Intersect, Lanes, Ray, RayPacket, SphereList, Trace, Vec3, f32x4, f32x8,
    f32x16,
};

/// The closest hits by lanes of a type, which may need a token as a proof that the CPU has them.
fn closest_hits<L: Lanes>(token: L::Token, spheres: &SphereList, rays: &[Ray]) -> Vec<Option<Hit>> {
    let packets: Vec<_> = rays.chunks(L::COUNT).map(RayPacket::<L::Array>::new).collect();
    let mut hits = vec![HitPacket::<L::Array>::none(); packets.len()];
    spheres.closest_hit_lanes::<L>(Exact, token, &mut Trace::new(), &packets, &mut hits);
    hits.iter().flat_map(HitPacket::hits).take(rays.len()).collect()
}

fn main() {
    let spheres: SphereList =
        (0..50).map(|i| [i as f32 * 0.3, 0.0, 10.0 + i as f32, 2.0]).collect();
    let rays: Vec<Ray> = (0..100)
        .map(|i| Ray::new(Vec3::ZERO, Vec3::new(i as f32 * 0.01 - 0.5, 0.1, 1.0)))
        .collect();

    let one = closest_hits::<f32>((), &spheres, &rays);
    assert_eq!(one, closest_hits::<f32x4>((), &spheres, &rays));
    assert_eq!(one, closest_hits::<f32x8>((), &spheres, &rays));
    assert_eq!(one, closest_hits::<f32x16>((), &spheres, &rays));
    println!(
        "{} of {} rays hit, with the same bits in every width",
        one.iter().flatten().count(),
        rays.len()
    );
}
