//! Orders of rays suit the scene that they are made for, whatever its scale and place.

use spherule_kernel::{Exact, Intersect, Ray, Sphere, SphereList, SphereTree, Trace, Vec3};
use spherule_tests::orders::{Extent, Order};
use spherule_tests::scenes::{LARGE, Scene, Size, viewpoint};
use spherule_tests::variants::levels;

fn scenes() -> impl Iterator<Item = Scene> {
    let large = LARGE.into_iter().filter_map(|name| Scene::large(name, Size::SMALL));
    large.chain([Scene::spread(Size::SMALL)])
}

fn hits(spheres: &SphereList, rays: &[Ray]) -> Vec<Option<u32>> {
    let mut hits = vec![None; rays.len()];
    let (tree, mut trace) = (SphereTree::new(spheres.clone()), Trace::new().incoherent());
    tree.closest_hits_with(Exact, &mut trace, rays, &mut hits);
    hits.into_iter().map(|hit| hit.map(|hit| hit.sphere)).collect()
}

#[test]
fn any_number_of_live_rays_and_the_same_from_the_same_seed() {
    let scene = Scene::uniform(50, 16);
    let spheres = scene.spheres.spheres();
    for order in Order::ALL {
        for count in [0, 1, 15, 17, 64, 1000, 4099] {
            let rays = order.rays(spheres, count, 1);
            assert_eq!(rays.len(), count, "{order:?}");
            assert!(rays.iter().all(Ray::is_live), "{order:?}");
            assert_eq!(rays, order.rays(spheres, count, 1), "{order:?}");
        }
        let is_drawn = order.rays(spheres, 100, 1) != order.rays(spheres, 100, 2);
        let is_fixed = matches!(
            order,
            Order::ScanLines | Order::Reversed | Order::TwoCameras | Order::Scanner
        );
        assert_eq!(is_drawn, !is_fixed, "{order:?}");
        assert_eq!(Order::named(order.as_str()), Some(order));
    }
}

#[test]
fn rays_meet_every_scene() {
    // (So few chains are three thin lines, which many rays miss.)
    for scene in scenes().filter(|scene| scene.name != "chains") {
        for order in Order::ALL {
            // Of large bursts, a few must go towards some sphere.
            let count = if order == Order::Bursts1000 { 16_000 } else { 2000 };
            let rays = order.rays(scene.spheres.spheres(), count, 1);
            let met = hits(&scene.spheres, &rays).iter().flatten().count();
            // No ray that leaves a convex body bounces back to it.
            let least = if (scene.name, order) == ("one", Order::Bounces) { 0 } else { 4 };
            assert!(met >= least, "{}, {order:?}: {met} of {count} rays hit", scene.name);
        }
    }
}

#[test]
fn a_scene_of_another_scale_gets_the_same_rays() {
    let plain = Scene::uniform(300, 16);
    for order in Order::ALL {
        let rays = order.rays(plain.spheres.spheres(), 4096, 1);
        let found = hits(&plain.spheres, &rays);
        assert!(found.iter().flatten().count() >= 400, "{order:?}");
        for scale in [-90, -60, 41, 90] {
            let scaled = plain.scaled([scale, 0]);
            let rays = order.rays(scaled.spheres.spheres(), 4096, 1);
            assert_eq!(hits(&scaled.spheres, &rays), found, "{order:?}, 2^{scale}");
        }
    }
}

#[test]
fn a_scene_elsewhere_gets_rays_there() {
    let there = Vec3::new(300.0, -2000.0, 77.0);
    let moved = |sphere: Sphere| Sphere { center: sphere.center + there, ..sphere };
    let plain = Scene::uniform(300, 16).spheres;
    let elsewhere: SphereList = plain.spheres().iter().map(moved).collect();
    for order in Order::ALL {
        let [met, as_many] = [&*plain, &elsewhere].map(|spheres| {
            let rays = order.rays(spheres.spheres(), 2048, 1);
            hits(spheres, &rays).iter().flatten().count()
        });
        assert!(met.abs_diff(as_many) < 100, "{order:?}: {met}, {as_many}");
    }
}

#[test]
fn a_huge_sphere_does_not_hide_where_the_others_are() {
    let extent = Extent::of(Scene::large("ground", Size::SMALL).expect("listed").spheres.spheres());
    assert!(extent.half() > 9.0 && extent.half() < 12.0, "{extent:?}");
    assert_eq!(Extent::of(SphereList::default().spheres()).half(), 1.0);
}

#[test]
fn orders_are_what_they_are_called() {
    let spheres = Scene::uniform(300, 16).spheres;
    let of = |order: Order| order.rays(spheres.spheres(), 4096, 1);
    let is_shared = |order: &Order| viewpoint(&of(*order)).is_some();
    let shared: Vec<_> = Order::ALL.into_iter().filter(is_shared).map(Order::as_str).collect();
    let expected = "beam; long lens, shuffled; scan lines; shuffled; reversed; scanner; \
                    along an axis; from far away; all around";
    assert_eq!(shared.join("; "), expected);
    // How often neighbours share their origins, or are nearly parallel.
    let neighbours = |order, alike: fn(&Ray, &Ray) -> bool| {
        of(order).windows(2).filter(|pair| alike(&pair[0], &pair[1])).count()
    };
    let origin = |a: &Ray, b: &Ray| a.origin == b.origin;
    let direction = |a: &Ray, b: &Ray| a.direction.normalize().dot(b.direction.normalize()) > 0.95;
    assert_eq!(neighbours(Order::Bursts16, origin), 4096 - 256);
    assert_eq!(neighbours(Order::Bursts1000, origin), 4095 - 4);
    assert_eq!(neighbours(Order::TwoCameras, origin), 0);
    assert!((1900..2200).contains(&neighbours(Order::TwoCamerasShuffled, origin)));
    assert_eq!(neighbours(Order::Alternating64, origin), 32 * 63);
    assert_eq!(neighbours(Order::HalfAndHalf, origin), 2047);
    assert!(neighbours(Order::SortedByDirection, direction) > 3600);
    assert!(neighbours(Order::Diffuse, direction) < 400);
    assert!(neighbours(Order::NearlyParallel, direction) == 4095);
}

/// Calls long enough that shuffled rays are sorted, at every level in turn.
#[test]
fn long_calls_in_any_order_answer_as_one_ray_a_call_does() {
    let scene = Scene::uniform(1000, 16);
    let (spheres, tree) = (scene.spheres.spheres(), scene.tree());
    for (order, level) in Order::ALL.into_iter().zip(levels().cycle()) {
        let rays = order.rays(spheres, 25_000, 1);
        let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
        tree.closest_hits_with(Exact, &mut Trace::new().at(level), &rays, &mut hits);
        tree.any_hits_with(Exact, &mut Trace::new().at(level), &rays, &mut occluded);
        for (number, ray) in rays.iter().enumerate() {
            assert_eq!(hits[number], tree.closest_hit(Exact, ray), "{order:?}, {number}");
            assert_eq!(occluded[number], hits[number].is_some(), "{order:?}, {number}");
        }
    }
}
