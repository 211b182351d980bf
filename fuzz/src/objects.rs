//! Object order: spheres one by one, the last first, give the closest hits of their list.

use spherule_kernel::{
    Hit, HitPacket, Lanes, Level, Ray, RayPacket, SphereList, Tier, f32x8, object_lanes,
    object_packets,
};
use spherule_referee::bytes::AimedScene;
use spherule_tests::variants::{bits, levels};

/// Judges them by `expected`, which one lane answers.
///
/// # Panics
/// If one differs.
pub fn check(tier: Tier, scene: &AimedScene, expected: &[Option<Hit>]) {
    let AimedScene { rays, spheres, .. } = scene;
    let list = SphereList::from(&spheres[..]);
    let mut found = vec![in_lanes::<f32>(tier, &list, rays), in_lanes::<f32x8>(tier, &list, rays)];
    found.extend(levels().map(|level| at_level(tier, level, &list, rays)));
    for hits in found {
        let is_same = hits.iter().map(|hit| bits(*hit)).eq(expected.iter().map(|hit| bits(*hit)));
        assert!(is_same, "{tier:?}: {hits:?}, not {expected:?}: {scene:?}");
    }
}

fn last_first(list: &SphereList) -> impl Iterator<Item = u32> {
    (0..list.spheres().len() as u32).rev()
}

fn in_lanes<L: Lanes<Token = ()>>(tier: Tier, list: &SphereList, rays: &[Ray]) -> Vec<Option<Hit>> {
    let of_packet = |rays: &[Ray]| {
        let (packet, mut hits) = (RayPacket::new(rays), HitPacket::none());
        for index in last_first(list) {
            object_lanes::<L>(tier, (), list.spheres(), index, &packet, &mut hits);
        }
        hits.hits().take(rays.len()).collect::<Vec<_>>()
    };
    rays.chunks(L::COUNT).flat_map(of_packet).collect()
}

fn at_level(tier: Tier, level: Level, list: &SphereList, rays: &[Ray]) -> Vec<Option<Hit>> {
    let packets: Vec<RayPacket> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
    let numbers: Vec<u32> = (0..packets.len() as u32).collect();
    let mut hits = vec![HitPacket::none(); packets.len()];
    for index in last_first(list) {
        object_packets(tier, level, list.spheres(), index, &numbers, &packets, &mut hits);
    }
    hits.iter().flat_map(HitPacket::hits).take(rays.len()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "not [None")]
    fn a_wrong_hit_is_seen() {
        let scene = AimedScene {
            rays: vec![Ray::from([[0.0; 3], [0.0, 0.0, 1.0]])],
            aims: vec![0],
            spheres: vec![[0.0, 0.0, 5.0, 1.0].into()],
        };
        check(Tier::Exact, &scene, &[Some(Hit { t: 4.0, sphere: 0 })]);
        check(Tier::Exact, &scene, &[None]);
    }
}
