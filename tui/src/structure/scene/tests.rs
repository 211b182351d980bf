use super::*;
use crate::color::Srgb;
use crate::scene::Lighting;
use spherule_kernel::Vec3;

/// Enough spheres for a depth list, and two lights that go with the eye.
fn scene() -> Scene {
    let mut scene = Scene::new();
    for index in 0..4000_u16 {
        let [x, y] = [index % 64, index / 64].map(f32::from);
        scene.push(Sphere { center: Vec3::new(x, y, 0.0), radius: 0.4 }, Srgb::WHITE, None);
    }
    scene.lighting = Lighting::Camera;
    scene
}

#[test]
fn nothing_is_sorted_for_lights_that_cast_no_shadows() {
    let (threads, workload) = (Threads::default(), Workload::of_pictures(1.0, 30_000, 4000));
    for shadows in [false, true] {
        let mut scene = scene();
        scene.shadows = shadows;
        let mut structures = SceneStructures::new(scene.list(), &threads);
        let choice = Some(Structure::DepthList);
        let search = structures.picture(choice, &workload, &View::FRONT, &scene);
        let search = search.expect("memory");
        assert_eq!((search.lights.len(), search.to_lights.len()), (2, 2 * usize::from(shadows)));
        assert_eq!(structures.depth_lists.len(), 1 + 2 * usize::from(shadows));
    }
}

#[test]
fn frames_go_on_with_a_tree_that_follows_them() {
    let (threads, scene) = (Threads::default(), scene());
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let one = Workload::of_pictures(1.0, 30_000, 4000);
    assert_eq!(structures.structure(None, &one), Structure::DepthList);
    let many = one.with_moves(100.0);
    let search = structures.picture(None, &many, &View::FRONT, &scene).expect("memory");
    assert_eq!(search.structure, Structure::Bvh);

    // The last of them too, of which nothing follows.
    structures.go_on(scene.list());
    assert_eq!(structures.structure(None, &one), Structure::Bvh);
}

/// A sphere that leaves changes nothing in how the others fade, as it does not change the view.
#[test]
fn frames_fade_as_the_first_did_until_another_is_framed() {
    let list = |x: f32| {
        let centers = [Vec3::ZERO, Vec3::new(x, 0.0, 0.0)];
        Arc::new(SphereList::from_iter(centers.map(|center| (center, 1.0))))
    };
    let (threads, near, far) = (Threads::default(), list(3.0), list(60.0));
    let [first, later] = [&near, &far].map(|list| subject(list.spheres()));
    let fades = |structures: &mut SceneStructures<'_>| {
        structures.set_aids(Aids { depth_cue: true, ..Aids::NONE });
        structures.setting().expect("memory").subject
    };
    let mut structures = SceneStructures::new(&near, &threads);
    assert_eq!(fades(&mut structures), Some(first));
    structures.go_on(&far);
    assert_eq!(fades(&mut structures), Some(first));
    structures.frame(later);
    assert_eq!(fades(&mut structures), Some(later));

    // Also if nothing faded before.
    let mut structures = SceneStructures::new(&near, &threads);
    structures.go_on(&far);
    assert_eq!(fades(&mut structures), Some(first));
    let mut structures = SceneStructures::new(&near, &threads);
    structures.frame(later);
    assert_eq!(fades(&mut structures), Some(later));
}

#[test]
fn more_spheres_than_a_tree_holds_is_no_matter_of_memory() {
    let told = |spheres| match no_tree(spheres) {
        Error::Running(what) => what,
        error => panic!("{error:?}"),
    };
    assert_eq!(told(1 << 27), "no memory for a tree of 134217728 spheres");
    assert!(told((1 << 27) + 1).contains("at most 134217728 spheres"));
}
