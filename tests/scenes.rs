//! The measured scenes are as their table describes them.

use spherule_kernel::{Ray, Sphere, Vec3, Viewpoint};
use spherule_tests::scenes::{Kind, LARGE, Scene, Size, sample, small, viewpoint};

fn large(name: &str, size: Size) -> Scene {
    Scene::large(name, size).expect("a scene of that name")
}

#[test]
fn cameras_have_a_viewpoint_and_diffuse_rays_have_none() {
    for name in LARGE {
        let scene = large(name, Size::SMALL);
        let primary = viewpoint(scene.rays(Kind::Primary));
        let is_direction = matches!(primary, Some(Viewpoint::Direction(_)));
        assert!(primary.is_some() && is_direction == (name == "parallel"));
        assert!(viewpoint(scene.rays(Kind::Diffuse)).is_none());
        let pixels = Size::SMALL.0 * Size::SMALL.0;
        let counts = Kind::ALL.map(|kind| scene.rays(kind).len());
        assert_eq!(counts, [pixels, pixels / 4], "{name}");
    }
    assert!(Scene::large("none", Size::SMALL).is_none());
}

#[test]
fn a_sample_is_from_all_of_the_picture() {
    let scene = large("u64", Size(256, 64));
    let rays = sample(scene.rays(Kind::Primary), 1 << 13);
    assert_eq!(rays.len(), 1 << 13);
    for quadrant in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
        let inside =
            |ray: &&Ray| ray.direction.x * quadrant[0] > 0.0 && ray.direction.y * quadrant[1] > 0.0;
        let share = rays.iter().filter(inside).count() as f64 / rays.len() as f64;
        assert!((0.15..0.35).contains(&share), "{quadrant:?}: {share}");
    }
}

#[test]
fn sixteen_rays_are_a_tile_and_every_pixel_comes_once() {
    let scene = large("parallel", Size(8, 10));
    let rays = scene.rays(Kind::Primary);
    let from_first = |index: usize| rays[index].origin - rays[0].origin;
    let (right, down) = (from_first(1), from_first(4));
    let near = |a: Vec3, b: Vec3| a.distance(b) < 1e-5;
    assert!(right.dot(down).abs() < 1e-5 && down.y < 0.0);
    assert!(near(from_first(5), right + down) && near(from_first(16), 4.0 * right));
    assert!(near(from_first(63), 7.0 * (right + down)));
    for (index, ray) in rays.iter().enumerate() {
        assert!(rays[..index].iter().all(|other| other.origin.distance(ray.origin) > 0.1));
    }
}

#[test]
fn the_camera_looks_at_its_target_and_up_is_up() {
    let scene = large("u64", Size(4, 64));
    let rays = scene.rays(Kind::Primary);
    let sum = rays.iter().map(|ray| ray.direction).sum::<Vec3>();
    assert!(sum.x.abs() < 1e-6 && sum.y.abs() < 1e-6 && (sum.z + 16.0).abs() < 1e-6);
    assert!(rays[0].direction.x < 0.0 && rays[0].direction.y > 0.0);
}

#[test]
fn far_rays_meet_the_scene() {
    for ray in large("long lens", Size(20, 64)).rays(Kind::Diffuse) {
        let closest = ray.at(-ray.origin.dot(ray.direction) / ray.direction.length_squared());
        assert!(closest.length() < 1.8, "{closest}");
    }
}

#[test]
fn a_flake_touches_its_children() {
    let scene = large("flake4", Size::SMALL);
    let list: Vec<_> = scene.spheres.spheres().iter().collect();
    assert_eq!(list.len(), 7381);
    let (parent, child) = (list[0], list[1]);
    let gap = parent.center.distance(child.center) - parent.radius - child.radius;
    assert!(gap.abs() < 1e-6);
}

#[test]
fn the_ground_is_one_and_the_rest_is_small() {
    let scene = large("ground", Size(4, 10_000));
    let mut radii: Vec<_> = scene.spheres.spheres().iter().map(|sphere| sphere.radius).collect();
    assert_eq!((radii[5_000], radii.len()), (1000.0, 10_000));
    radii.sort_by(f32::total_cmp);
    let spread = (radii[8_413] / radii[5_000]).ln();
    assert!((0.65..0.75).contains(&spread), "{spread}");
    assert!(radii[9_998] < 3.0 && scene.has_ground());
}

/// The spheres of a large scene in a trial run.
fn spheres(name: &str) -> Vec<Sphere> {
    large(name, Size::SMALL).spheres.spheres().iter().collect()
}

/// How many spheres each point lies in.
fn depth(points: impl IntoIterator<Item = Vec3>, spheres: &[Sphere]) -> Vec<usize> {
    let holds = |point: Vec3| move |s: &&Sphere| s.center.distance(point) < s.radius;
    points.into_iter().map(|point| spheres.iter().filter(holds(point)).count()).collect()
}

fn origins(name: &str) -> Vec<Vec3> {
    large(name, Size::SMALL).rays(Kind::Diffuse).iter().map(|ray| ray.origin).collect()
}

#[test]
fn a_shell_is_hollow_and_has_rays_on_both_sides() {
    for sphere in spheres("shell") {
        assert!((sphere.center.length() - 1.0).abs() < 1e-6 && sphere.radius < 0.05);
    }
    let within = origins("shell").iter().filter(|origin| origin.length() < 0.95).count();
    assert!((64..192).contains(&within), "{within} of 256");
}

#[test]
fn nested_spheres_hold_all_smaller_ones_in_any_order() {
    let mut list = spheres("nested");
    let in_order = list.windows(2).filter(|pair| pair[0].radius < pair[1].radius).count();
    assert!((1300..1700).contains(&in_order), "{in_order} of 2999");
    list.sort_by(|a, b| a.radius.total_cmp(&b.radius));
    assert!(list.iter().all(|sphere| sphere.center == Vec3::ZERO));
    assert!(list.windows(2).all(|pair| pair[0].radius < pair[1].radius));
    assert_eq!((list.len(), list[2999].radius), (3000, 1.0));
    let depth = depth(origins("nested"), &list);
    let outside = depth.iter().filter(|&&depth| depth == 0).count();
    let deep = depth.iter().filter(|&&depth| depth > 1000).count();
    assert!((64..192).contains(&outside) && deep > 32, "{outside} and {deep} of 256");
}

#[test]
fn duplicates_stand_at_ten_indices() {
    let list = spheres("duplicates");
    let alike = |one: &Sphere| list.iter().filter(|other| *other == one).count();
    assert!(list.len() == 3000 && list.iter().all(|sphere| alike(sphere) == 10));
    assert_ne!(list[0], list[1]);
}

#[test]
fn origins_lie_in_many_spheres() {
    let Size(pixels, _) = Size::SMALL;
    let scene = large("inside", Size(pixels, usize::MAX));
    let list: Vec<_> = scene.spheres.spheres().iter().collect();
    let rays = Kind::ALL.map(|kind| scene.rays(kind).iter().map(|ray| ray.origin));
    for origins in rays {
        let depth = depth(origins, &list);
        // At a corner of the cube the number is an eighth.
        let mean = depth.iter().sum::<usize>() as f64 / depth.len() as f64;
        assert!(depth.iter().all(|&depth| depth > 3) && mean > 30.0, "{mean}");
    }
}

#[test]
fn one_is_huge_and_the_rest_is_tiny() {
    let list = spheres("huge and tiny");
    let (first, rest) = list.split_at(1500);
    assert_eq!((list.len(), rest[0].radius), (3000, 0.9));
    assert!(first.iter().chain(&rest[1..]).all(|sphere| sphere.radius < 0.02));
}

#[test]
fn links_touch_along_straight_lines() {
    let list = spheres("chains");
    assert_eq!(list.len(), 3000);
    for chain in list.chunks(1000) {
        let along = (chain[999].center - chain[0].center) / 999.0;
        for pair in chain.windows(2) {
            let step = pair[1].center - pair[0].center;
            assert!((step.length() - pair[0].radius - pair[1].radius).abs() < 1e-6);
            assert!((step - along).length() < 1e-6);
        }
    }
    let along = |chain: usize| list[1000 * chain + 1].center - list[1000 * chain].center;
    assert!(along(0).cross(along(1)).length() > 0.1 * along(0).length_squared());
}

#[test]
fn small_scenes_are_what_they_say() {
    for scene in small::scenes() {
        let list: Vec<_> = scene.spheres.spheres().iter().collect();
        for kind in Kind::ALL {
            let rays = scene.rays(kind);
            let same_origin = rays[0].origin == rays[1].origin;
            assert!(rays.len() == 1024 && same_origin == (kind == Kind::Primary));
            for ray in rays {
                assert!((ray.origin.length() - 30.0).abs() < 1e-4);
                assert!((0.49..=6.01).contains(&ray.direction.length()));
                for sphere in list.iter().filter(|_| scene.name.contains("every")) {
                    let p = sphere.center - ray.origin;
                    let off = p.cross(ray.direction).length() / ray.direction.length();
                    assert!(off < sphere.radius && sphere.radius < p.length());
                }
            }
        }
        for sphere in list.iter().filter(|sphere| sphere.radius < 20.0) {
            assert!(sphere.center.abs().max_element() <= 10.0);
            assert!((0.2..=0.7).contains(&sphere.radius));
        }
        assert_eq!(scene.has_ground(), scene.name.contains("ground"));
    }
    let ground = &small::scenes()[2].spheres;
    assert!(ground.len() == 65 && ground.spheres().get(32).is_some_and(|s| s.radius == 1000.0));
}
