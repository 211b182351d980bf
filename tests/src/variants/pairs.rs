//! Ray i against sphere i alone, at every layer.

use super::packing::{level, packed, stale_packet};
use super::table::{Layer, packet_layers};
use spherule_kernel::{
    Hit, HitPacket, LaneArray, Lanes, Ray, Sphere, SpherePacket, Tier, f32x4, f32x8, f32x16,
    pair_lanes, pair_packets, pairs,
};
use spherule_referee::case::Case;
use std::vec::IntoIter;

/// The layers at which pairs are intersected.
pub fn pair_layers() -> IntoIter<Layer> {
    packet_layers(Some(Layer::Slice))
}

/// The t of each case on its own.
///
/// # Panics
/// If a hit does not name its sphere: the lane of a packet, the index of a slice.
#[must_use]
pub fn pairs_of(tier: Tier, layer: Layer, cases: &[Case]) -> Vec<Option<f32>> {
    let (rays, spheres): (Vec<Ray>, Vec<Sphere>) =
        cases.iter().map(|case| (case.ray, case.sphere)).unzip();
    let (hits, lanes) = match layer {
        Layer::Packets(name) => {
            let (rays, spheres) = (packed(&rays), sphere_packets(&spheres));
            let mut hits = vec![stale_packet::<f32x16>(); rays.len()];
            pair_packets(tier, level(name), &rays, &spheres, &mut hits);
            (hits.iter().flat_map(HitPacket::hits).take(cases.len()).collect(), 16)
        }
        Layer::Lanes(lanes) => {
            let pairs = match lanes {
                1 => pairs_in_lanes::<f32>,
                4 => pairs_in_lanes::<f32x4>,
                8 => pairs_in_lanes::<f32x8>,
                _ => pairs_in_lanes::<f32x16>,
            };
            (pairs(tier, &rays, &spheres), lanes)
        }
        _ => {
            let mut hits = vec![Some(Hit { t: -7.0, sphere: 7 }); cases.len()];
            pairs(tier, &rays, &spheres, &mut hits);
            (hits, usize::MAX)
        }
    };
    let t = |(index, hit): (usize, Option<Hit>)| {
        let Hit { t, sphere } = hit?;
        assert_eq!(sphere as usize, index % lanes, "a pair's sphere, {layer:?}");
        Some(t)
    };
    hits.into_iter().enumerate().map(t).collect()
}

fn pairs_in_lanes<L: Lanes<Token = ()>>(
    tier: Tier,
    rays: &[Ray],
    spheres: &[Sphere],
) -> Vec<Option<Hit>> {
    let packets = packed(rays).into_iter().zip(sphere_packets(spheres));
    let pair = |(rays, spheres)| pair_lanes::<L>(tier, (), &rays, &spheres);
    let hits = packets.flat_map(|packets| pair(packets).hits().collect::<Vec<_>>());
    hits.take(rays.len()).collect()
}

fn sphere_packets<A: LaneArray>(spheres: &[Sphere]) -> Vec<SpherePacket<A>> {
    spheres.chunks(A::COUNT).map(SpherePacket::new).collect()
}
