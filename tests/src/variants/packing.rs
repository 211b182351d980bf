//! The rays of a test as packets and as columns, and answers read from packets.

use super::answers::Answers;
use spherule_kernel::{
    HitPacket, LaneArray, Lanes, Level, LevelName, Ray, RayPacket, Sphere, SpherePacket, Tier,
    Vec3, pair_lanes,
};

pub(super) fn level(name: LevelName) -> Level {
    Level::named(name).expect("a level of this CPU")
}

/// The numbers of rays, column by column; some columns are longer.
pub(super) fn columns_of(rays: &[Ray]) -> [Vec<f32>; 8] {
    let numbers = |r: &Ray| {
        let ([ox, oy, oz], [dx, dy, dz]) = (r.origin.to_array(), r.direction.to_array());
        [ox, oy, oz, dx, dy, dz, r.t_min, r.t_max]
    };
    std::array::from_fn(|column| {
        let longer = [0.5].repeat(column % 3);
        rays.iter().map(|ray| numbers(ray)[column]).chain(longer).collect()
    })
}

pub(super) fn packed<A: LaneArray>(rays: &[Ray]) -> Vec<RayPacket<A>> {
    rays.chunks(A::COUNT).map(RayPacket::new).collect()
}

/// The answers to `count` rays. One packet more must have been left alone.
pub(super) fn unpacked<L: Lanes<Token = ()>>(
    count: usize,
    found: &[HitPacket<L::Array>],
    bits: &[u32],
) -> Answers {
    let past = count.div_ceil(L::COUNT);
    assert!(found[past].hits().eq(stale_packet::<L>().hits()) && bits[past] == u32::MAX);
    Answers {
        hits: found.iter().flat_map(HitPacket::hits).take(count).collect(),
        occluded: (0..count).map(|ray| bits[ray / L::COUNT] >> (ray % L::COUNT) & 1 == 1).collect(),
    }
}

/// A packet that is full of hits.
pub(super) fn stale_packet<L: Lanes<Token = ()>>() -> HitPacket<L::Array> {
    let ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
    let sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
    let (rays, spheres) = (RayPacket::new(&[ray; 16]), SpherePacket::new(&[sphere; 16]));
    pair_lanes::<L>(Tier::Fast, (), &rays, &spheres)
}
