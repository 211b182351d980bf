//! The surface at every hit, at every layer.

use super::packing::{level, packed};
use super::table::{Layer, packet_layers};
use spherule_kernel::{
    HitPacket, Intersect, LaneArray, Lanes, Level, Ray, RayPacket, Side, SphereList, Surface,
    SurfacePacket, Tier, Towards, Trace, Vec3, f32x4, f32x8, f32x16, shadow_lanes, shadow_packets,
    surface, surface_lanes, surface_packets,
};
use std::vec::IntoIter;

/// The layers at which surfaces are computed.
pub fn surface_layers() -> IntoIter<Layer> {
    packet_layers(Some(Layer::Ray))
}

/// Rays in packets, what they hit, and the surfaces there.
struct Packets<A: LaneArray> {
    rays: Vec<RayPacket<A>>,
    hits: Vec<HitPacket<A>>,
    surfaces: Vec<SurfacePacket<A>>,
}

impl Packets<[f32; 16]> {
    fn at(level: Level, tier: Tier, list: &SphereList, rays: &[Ray]) -> Self {
        let rays = packed(rays);
        let mut hits = vec![HitPacket::none(); rays.len()];
        list.closest_hit_packets(tier, &mut Trace::new().at(level), &rays, &mut hits);
        let mut surfaces = vec![SurfacePacket::none(); rays.len()];
        surface_packets(tier, level, list.spheres(), &rays, &hits, &mut surfaces);
        Self { rays, hits, surfaces }
    }
}

impl<A: LaneArray> Packets<A> {
    fn of_lanes<L: Lanes<Array = A, Token = ()>>(
        tier: Tier,
        list: &SphereList,
        rays: &[Ray],
    ) -> Self {
        let rays = packed(rays);
        let mut hits = vec![HitPacket::none(); rays.len()];
        list.closest_hit_lanes::<L>(tier, (), &mut Trace::new(), &rays, &mut hits);
        let packets = rays.iter().zip(&hits);
        let surfaces = packets
            .map(|(rays, hits)| surface_lanes::<L>(tier, (), list.spheres(), rays, hits))
            .collect();
        Self { rays, hits, surfaces }
    }
}

/// The normal and the point of every ray's closest hit in a list, zeros if there is none.
#[must_use]
pub fn surfaces_of(tier: Tier, layer: Layer, list: &SphereList, rays: &[Ray]) -> Vec<[Vec3; 2]> {
    match layer {
        Layer::Packets(name) => unpacked(&Packets::at(level(name), tier, list, rays).surfaces),
        Layer::Lanes(1) => in_lanes::<f32>(tier, list, rays),
        Layer::Lanes(4) => in_lanes::<f32x4>(tier, list, rays),
        Layer::Lanes(8) => in_lanes::<f32x8>(tier, list, rays),
        Layer::Lanes(_) => in_lanes::<f32x16>(tier, list, rays),
        Layer::Ray | Layer::Slice | Layer::Columns | Layer::SliceAt(_) => {
            let one = |ray: &Ray| {
                let hit = list.closest_hit(tier, ray)?;
                let sphere = list.spheres().get(hit.sphere as usize)?;
                let Surface { normal, point, .. } = surface(tier, ray, hit.t, &sphere);
                Some([normal, point])
            };
            rays.iter().map(|ray| one(ray).unwrap_or_default()).collect()
        }
    }
}

fn in_lanes<L: Lanes<Token = ()>>(tier: Tier, list: &SphereList, rays: &[Ray]) -> Vec<[Vec3; 2]> {
    unpacked(&Packets::of_lanes::<L>(tier, list, rays).surfaces)
}

fn unpacked<A: LaneArray>(surfaces: &[SurfacePacket<A>]) -> Vec<[Vec3; 2]> {
    let lanes = |packet: &SurfacePacket<A>| {
        (0..A::COUNT).map(|lane| [packet.normal(lane), packet.point(lane)]).collect::<Vec<_>>()
    };
    surfaces.iter().flat_map(lanes).collect()
}

/// The shadow rays from what every ray hits in a list, spawned ray by ray or in packets; inactive if none is spawned.
#[must_use]
pub fn shadow_rays_of(
    tier: Tier,
    layer: Layer,
    list: &SphereList,
    rays: &[Ray],
    towards: Towards,
) -> Vec<Ray> {
    match layer {
        Layer::Packets(name) => {
            let level = level(name);
            let Packets { rays, hits, surfaces } = Packets::at(level, tier, list, rays);
            let mut shadow_rays = vec![RayPacket::inactive(); rays.len()];
            let hit = (&*rays, &*hits, &*surfaces);
            shadow_packets(tier, level, list.spheres(), hit, towards, &mut shadow_rays);
            unpacked_rays(&shadow_rays)
        }
        Layer::Lanes(1) => shadows_in_lanes::<f32>(tier, list, rays, towards),
        Layer::Lanes(4) => shadows_in_lanes::<f32x4>(tier, list, rays, towards),
        Layer::Lanes(8) => shadows_in_lanes::<f32x8>(tier, list, rays, towards),
        Layer::Lanes(_) => shadows_in_lanes::<f32x16>(tier, list, rays, towards),
        Layer::Ray | Layer::Slice | Layer::Columns | Layer::SliceAt(_) => {
            let one = |ray: &Ray| {
                let hit = list.closest_hit(tier, ray)?;
                let sphere = list.spheres().get(hit.sphere as usize)?;
                let surface = surface(tier, ray, hit.t, &sphere);
                let normal = surface.normal.as_dvec3();
                let side = surface.incident_side(ray.direction);
                let outward = if side == Side::Inside { -normal } else { normal };
                let (way, spawned) = match towards {
                    Towards::Direction(direction) => {
                        (direction, surface.spawn_ray(tier, &sphere, side, direction))
                    }
                    Towards::Point(point) => (
                        point - surface.position(&sphere),
                        surface.spawn_ray_to(tier, &sphere, side, point),
                    ),
                };
                if outward.dot(way.as_dvec3()) <= 0.0 { None } else { spawned }
            };
            rays.iter().map(|ray| one(ray).unwrap_or(Ray::INACTIVE)).collect()
        }
    }
}

fn shadows_in_lanes<L: Lanes<Token = ()>>(
    tier: Tier,
    list: &SphereList,
    rays: &[Ray],
    towards: Towards,
) -> Vec<Ray> {
    let Packets { rays, hits, surfaces } = Packets::of_lanes::<L>(tier, list, rays);
    let hits = rays.iter().zip(&hits).zip(&surfaces);
    let shadow_rays: Vec<_> = hits
        .map(|((rays, hits), surfaces)| {
            let hit = (rays, hits, surfaces);
            shadow_lanes::<L>(tier, (), list.spheres(), hit, towards)
        })
        .collect();
    unpacked_rays(&shadow_rays)
}

fn unpacked_rays<A: LaneArray>(packets: &[RayPacket<A>]) -> Vec<Ray> {
    packets.iter().flat_map(|rays| (0..A::COUNT).map(|lane| rays.ray(lane))).collect()
}
