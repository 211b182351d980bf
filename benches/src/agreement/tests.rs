//! Wrong answers, and too few of them to compare.

use super::*;
use crate::engine::kernel::{Kernel, Way};
use crate::measure::checked;
use spherule_kernel::{Level, Tier, Vec3};
use spherule_tests::scenes::small;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Answers that no ray hits anything.
struct Blind(usize);

impl Run for Blind {
    fn run(&mut self, _: Query) {}

    fn hits(&self) -> Vec<Option<Hit>> {
        vec![None; self.0]
    }
}

/// In other units, too, brute force is held to the tree, and that to the oracle, which does not see every ray.
#[test]
fn a_wrong_truth_is_seen_in_every_unit() {
    for scale in [[0, 0], [100, 0], [0, -51]] {
        let scene = Scene::uniform(500, 16).scaled(scale);
        let kernel = Kernel::new(&scene, &scene.tree());
        let all = kernel.ways(Kind::Primary, &[Level::best()], &[Tier::Exact]);
        let mut brute_force = all.into_iter().next().expect("the first way");
        assert_eq!(brute_force.label.way, Way::BruteForce.as_str());
        let passes = |engine: &Engine, exact: &Ready| {
            let asked = (&scene, Kind::Primary);
            let check = || drop(checked(asked, &[engine], exact, usize::MAX));
            catch_unwind(AssertUnwindSafe(check)).is_ok()
        };
        let blind = || -> Ready { Box::new(|rays| Box::new(Blind(rays.list.len()))) };
        assert!(passes(&brute_force, &kernel.truth()), "{scale:?}");
        assert!(!passes(&brute_force, &blind()), "{scale:?}: the tree");
        brute_force.ready = blind();
        assert!(!passes(&brute_force, &kernel.truth()), "{scale:?}: brute force");
    }
}

#[test]
fn a_wrong_answer_is_seen() {
    let scene = small::cube("64", 64);
    for kind in Kind::ALL {
        let all = WithTruth::few((&scene, kind));
        let spheres: Vec<_> = scene.spheres.spheres().iter().collect();
        let truth = all.truth(&spheres, &Kernel::new(&scene, &scene.tree()).truth());
        let hits = truth.iter().flatten().count();
        assert!((40..900).contains(&hits), "{hits} rays of 1024 hit something");
        let passes = |change: fn(Hit) -> Option<Hit>, (wrong, ulp)| {
            let is_near = move |_, t, truth: Hit| ulp_between(t, truth.t) <= ulp;
            let bounds = (wrong, is_near);
            let own: Vec<_> = truth.iter().map(|hit| hit.and_then(change)).collect();
            let any = catch_unwind(|| near(truth, &own, truth, bounds, "")).is_ok();
            let same = catch_unwind(|| same_bits(&own, truth, truth, |_, _| false, "")).is_ok();
            [catch_unwind(|| near(&own, truth, truth, bounds, "")).is_ok(), any, same]
        };
        let (textbook, exact) = ((8.0 / 1024.0, 1 << 13), (0.0, 0));
        assert_eq!(passes(Some, exact), [true, true, true]);
        assert_eq!(passes(|_| None, textbook), [false, false, false]);
        let another = |hit: Hit| Some(Hit { sphere: hit.sphere + 1, ..hit });
        assert_eq!(passes(another, textbook), [false, true, false]);
        let stretched = |hit: Hit| Some(Hit { t: hit.t * 1.01, ..hit });
        assert_eq!(passes(stretched, textbook), [false, true, false]);
        let next = |hit: Hit| Some(Hit { t: hit.t.next_up(), ..hit });
        assert_eq!(passes(next, exact), [false, true, false]);
        assert_eq!(passes(next, textbook), [true, true, false]);
    }
}

#[test]
fn the_message_tells_how_many_rays_may_differ() {
    let truth = [Some(Hit { t: 4.0, sphere: 0 }); 100];
    let mut lost = truth;
    lost[..3].fill(None);
    let passes = |wrong| {
        let check = || near(&lost, &lost, &truth, (wrong, |_, _, _| true), "Embree");
        catch_unwind(check).map_err(|message| *message.downcast::<String>().expect("a text"))
    };
    assert_eq!(passes(0.04), Ok(()));
    let message = "Embree: of 100 rays 3 closest hits, 3 any hits differ; 2 may";
    assert_eq!(passes(0.025), Err(message.to_owned()));
}

/// At a corner of the picture there is nothing to compare.
#[test]
fn rays_are_compared_that_hit_something() {
    let scene = Scene::uniform(500, 128);
    let kernel = Kernel::new(&scene, &scene.tree());
    let spheres: Vec<_> = scene.spheres.spheres().iter().collect();
    for kind in Kind::ALL {
        let few = WithTruth::new((&scene, kind), 1);
        assert!(few.rays.list.len() < scene.rays(kind).len(), "{kind:?}: all rays");
        let hits = few.truth(&spheres, &kernel.truth()).iter().flatten().count();
        assert!(hits > 0, "{kind:?}");
    }
    let own = WithTruth::new((&scene, Kind::Primary), 1024);
    let away = own.rays.list.iter().map(|ray| Ray::new(ray.origin, -ray.direction));
    let away = WithTruth::of(Rays::new(&away.collect::<Vec<_>>()));
    let all = kernel.ways(Kind::Primary, &[Level::best()], &[Tier::Exact]);
    let of_tree = all.into_iter().nth(1).expect("the second way");
    assert_eq!(of_tree.label.way, Way::RayByRay.as_str());
    for (few, is_compared) in [(&own, true), (&away, false)] {
        let mut run = (of_tree.ready)(&own.rays);
        let asked = || check((&scene, &of_tree), (few, &own), &mut *run, &kernel.truth());
        assert_eq!(catch_unwind(AssertUnwindSafe(asked)).is_ok(), is_compared);
    }
}

#[test]
fn a_false_hit_alone_may_be_lost() {
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    let spheres = [[0.0, 0.0, 5.0, 1.0], [3.0, 0.0, 5.0, 1.0]].map(Sphere::from);
    for (sphere, is_false) in [(0, false), (1, true)] {
        let truth = [Some(Hit { t: 4.0, sphere })];
        let may_be_lost = |_: usize, hit: Hit| is_missed(&ray, spheres[hit.sphere as usize]);
        let passes = |answer: [Option<Hit>; 1]| {
            let check = || same_bits(&answer, &answer, &truth, may_be_lost, "");
            catch_unwind(check).is_ok()
        };
        assert_eq!([passes(truth), passes([None])], [true, is_false]);
        // Where there was no hit, none may be found.
        let found = catch_unwind(|| same_bits(&truth, &truth, &[None], may_be_lost, ""));
        assert!(found.is_err());
    }
}
