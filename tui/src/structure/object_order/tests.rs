//! Object order beside image order, strip by strip, and what it counts.

use super::*;
use crate::scene::builtin::BUILTINS;
use crate::view::{Lens, View};
use spherule_kernel::{Camera, Coherence, Intersect, Level, SphereList, Tier, Trace, Vec3};

const VIEW: View = View {
    eye: Vec3::ZERO,
    target: Vec3::NEG_Z,
    lens: Lens::Perspective { fov: 90.0 },
    ..View::FRONT
};

fn tracing(tier: Tier) -> Tracing {
    Tracing { tier, level: Level::best(), coherence: Coherence::Coherent }
}

/// The packets of a picture, in the order in which it is drawn.
fn packets(view: &View, width: u32, height: u32) -> Vec<RayPacket> {
    let camera = view.camera(width, height, f64::from(width) / f64::from(height));
    let corners = Camera::tile_corners::<[f32; 16]>(width, height);
    corners.map(|(x, y)| camera.packet(x, y, width, height)).collect()
}

/// The hits and counts of object order, so many packets at a time.
fn traced(
    spheres: Spheres<'_>,
    view: &View,
    tier: Tier,
    rays: &[RayPacket],
    strip: usize,
) -> (Vec<HitPacket>, Counts) {
    let mut areas = Vec::new();
    let objects = ObjectOrder::new(spheres, Screen::new(view), &mut areas);
    let (mut raster, mut counts) = (Raster::default(), Counts::default());
    // What was there before does not matter.
    let mut hits = vec![HitPacket::none(); rays.len()];
    spheres.closest_hit_packets(Tier::Exact, &mut Trace::new(), rays, &mut hits);
    for (rays, hits) in rays.chunks(strip).zip(hits.chunks_mut(strip)) {
        counts += objects.closest_hits(tracing(tier), &mut raster, rays, hits);
    }
    (hits, counts)
}

#[test]
fn every_scene_is_as_in_image_order_however_it_is_cut() {
    for entry in BUILTINS {
        let scene = (entry.scene)();
        let first = scene.first_view(1.5);
        let parallel = View { lens: Lens::Parallel { height: first.height_at_target() }, ..first };
        let inside = View { eye: first.target, target: first.eye, ..first };
        for view in [first, parallel, inside] {
            let rays = packets(&view, 61, 41);
            for tier in [Tier::Stable, Tier::Exact] {
                let mut expected = vec![HitPacket::none(); rays.len()];
                let trace = &mut Trace::new();
                scene.spheres().closest_hit_packets(tier, trace, &rays, &mut expected);
                let all = traced(scene.spheres(), &view, tier, &rays, rays.len());
                assert!(all.0 == expected, "{} {tier:?} {view:?}", entry.name);
                for strip in [1, 7, 16, 50] {
                    let found = traced(scene.spheres(), &view, tier, &rays, strip);
                    assert!(found == all, "{} {tier:?}, {strip} at a time", entry.name);
                }
                let met = expected.iter().flat_map(HitPacket::hits).flatten().count() as u64;
                let Writes { stored, overwritten } = all.1.writes;
                assert_eq!(stored - overwritten, met, "{} {tier:?}", entry.name);
            }
        }
    }
}

/// Spheres around the eye, behind it, in one packet, and between rays: 32 x 32 rays, 64 packets.
#[test]
fn counts_that_are_known() {
    let counts = |rows: &[[f32; 4]]| {
        let list = SphereList::from(rows);
        let rays = packets(&VIEW, 32, 32);
        traced(list.spheres(), &VIEW, Tier::Exact, &rays, 16).1
    };
    let expected =
        |tests, stored, overwritten| Counts { tests, writes: Writes { stored, overwritten } };
    assert_eq!(counts(&[]), expected(0, 0, 0));
    assert_eq!(counts(&[[0.0, 0.0, 0.0, 1.0]]), expected(1024, 1024, 0));
    assert_eq!(counts(&[[0.0, 0.0, 9.0, 1.0]]), expected(0, 0, 0));
    // From without to within, each in front of the last; and the other way round.
    let [far, near] = [[0.0, 0.0, 0.0, 2.0], [0.0, 0.0, 0.0, 1.0]];
    assert_eq!(counts(&[far, near, far]), expected(3 * 1024, 2048, 1024));
    assert_eq!(counts(&[near, far]), expected(2048, 1024, 0));
    // Slopes 1/32 and 3/32 from the middle are those of the first two rays: the point between two is in one packet.
    assert_eq!(counts(&[[0.0625, 0.0625, -1.0, 0.001]]), expected(16, 0, 0));
    // At the corner of four packets.
    assert_eq!(counts(&[[0.0, 0.0, -1.0, 0.05]]), expected(64, 4, 0));
    // Not valid.
    assert_eq!(counts(&[[0.0, 0.0, -1.0, -1.0], [f32::NAN; 4]]), expected(0, 0, 0));
}
