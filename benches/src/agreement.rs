//! The check before the clock: a fast wrong answer is no answer.
//!
//! The kernel's ways must give brute force's bits; by `Fast` and `Geometric` they may lose false hits. On the small scenes
//! brute force must be within its tier's promise of `Exact`. On all, `Exact` by brute force must equal `Exact` by the tree
//! and, if there are not too many spheres, the oracle. All other programs are held to `Exact`.

use crate::engine::{Engine, OTHERS_PART, OTHERS_ULP, Promise, Query, Rays, Ready, Run};
use spherule::tally::ulp_between;
use spherule_kernel::{Exact, Hit, Ray, Sphere, pairs};
use spherule_tests::oracle;
use spherule_tests::scenes::{Kind, Scene, sample};
use std::cell::OnceCell;
use std::collections::HashMap;

/// How many tests by brute force a check of bits may cost. In some scenes every test finds a candidate.
const TESTS: usize = 1 << 26;
/// How many tests by big integers a check may cost.
const ORACLE_TESTS: usize = 1 << 14;

/// Rays, and what `Exact` says of them.
pub(crate) struct WithTruth {
    pub(crate) rays: Rays,
    truth: OnceCell<Vec<Option<Hit>>>,
}

impl WithTruth {
    /// About `count` rays of a scene.
    pub(crate) fn new((scene, kind): (&Scene, Kind), count: usize) -> Self {
        Self::of(Rays::new(&sample(scene.rays(kind), count)))
    }

    pub(crate) fn of(rays: Rays) -> Self {
        Self { rays, truth: OnceCell::new() }
    }

    /// As many rays as brute force answers in a moment.
    pub(crate) fn few((scene, kind): (&Scene, Kind)) -> Self {
        Self::new((scene, kind), (TESTS / scene.spheres.len().max(1)).min(1 << 16))
    }

    /// The answers of `exact`. The oracle confirms some of them, from all over.
    fn truth(&self, spheres: &[Sphere], exact: &Ready) -> &[Option<Hit>] {
        self.truth.get_or_init(|| {
            let truth = answers(&mut *exact(&self.rays), Query::ClosestHit);
            let (all, some) = (truth.len(), ORACLE_TESTS / spheres.len().max(1));
            // By the golden ratio, since every n-th ray might be of one column of a picture.
            let spread = |index: usize| ((index as f64 * 0.618_034).fract() * all as f64) as usize;
            let place = |index: usize| if some < all { spread(index) } else { index };
            for place in (0..some.min(all)).map(place) {
                let ray = &self.rays.list[place];
                assert_eq!(truth[place], oracle::closest(ray, spheres), "{ray:?}");
            }
            truth
        })
    }
}

fn answers(run: &mut dyn Run, query: Query) -> Vec<Option<Hit>> {
    run.forget();
    run.run(query);
    run.hits()
}

/// Asserts that `run`, the engine with the rays of `own`, answers as it promises.
pub(crate) fn check(
    (scene, engine): (&Scene, &Engine),
    (few, own): (&WithTruth, &WithTruth),
    run: &mut dyn Run,
    exact: &Ready,
) {
    let name = format!("{}, {}", scene.name, engine.label);
    match &engine.promise {
        Promise::Nothing => {}
        Promise::SameBits(other) | Promise::SameButFalseHits(other) => {
            let truth = answers(&mut *other(&few.rays), Query::ClosestHit);
            let mut run = (engine.ready)(&few.rays);
            let [closest, any] = Query::ALL.map(|query| answers(&mut *run, query));
            let may_lose = matches!(engine.promise, Promise::SameButFalseHits(_));
            let spheres = scene.spheres.spheres();
            let is_lost = |ray: usize, hit: Hit| {
                let sphere = spheres.get(hit.sphere as usize);
                may_lose && sphere.is_some_and(|sphere| is_missed(&few.rays.list[ray], sphere))
            };
            same_bits(&closest, &any, &truth, is_lost, &name);
        }
        &(Promise::Near(wrong, _) | Promise::Other(wrong)) => {
            let spheres: Vec<_> = scene.spheres.spheres().iter().collect();
            let truth = own.truth(&spheres, exact);
            let [closest, any] = Query::ALL.map(|query| answers(run, query));
            // Where spheres are equal, another engine may name any of them.
            let first = first_alike(&spheres);
            let named =
                |hit: Option<Hit>| hit.map(|hit| Hit { sphere: first[hit.sphere as usize], ..hit });
            let closest: Vec<_> = closest.into_iter().map(named).collect();
            let is_near = |ray: usize, t: f32, truth: Hit| match engine.promise {
                Promise::Near(_, ulp) => ulp_between(t, truth.t) <= ulp,
                _ => {
                    let (ray, sphere) = (&own.rays.list[ray], &spheres[truth.sphere as usize]);
                    let size = ray.origin.distance(sphere.center) + sphere.radius;
                    let error = (t - truth.t).abs() * ray.direction.length();
                    ulp_between(t, truth.t) <= OTHERS_ULP || error <= OTHERS_PART * size
                }
            };
            near(&closest, &any, truth, (wrong, is_near), &name);
        }
    }
}

/// For each sphere the lowest index of an equal sphere.
fn first_alike(spheres: &[Sphere]) -> Vec<u32> {
    let bits = |sphere: &Sphere| {
        let [x, y, z] = sphere.center.to_array();
        [x, y, z, sphere.radius].map(f32::to_bits)
    };
    let mut first = HashMap::new();
    (0..).zip(spheres).map(|(index, sphere)| *first.entry(bits(sphere)).or_insert(index)).collect()
}

/// Whether a ray does not hit this sphere in truth.
fn is_missed(ray: &Ray, sphere: Sphere) -> bool {
    let mut hit = [None];
    pairs(Exact, &[*ray], &[sphere], &mut hit);
    hit == [None]
}

/// Any answer will do where the hit of `truth` may be lost.
fn same_bits(
    closest: &[Option<Hit>],
    any: &[Option<Hit>],
    truth: &[Option<Hit>],
    may_be_lost: impl Fn(usize, Hit) -> bool,
    name: &str,
) {
    let bits = |hit: &Option<Hit>| hit.map(|hit| (hit.t.to_bits(), hit.sphere));
    assert_eq!((closest.len(), any.len()), (truth.len(), truth.len()), "{name}");
    for (ray, (truth, (closest, any))) in truth.iter().zip(closest.iter().zip(any)).enumerate() {
        let is_same = bits(closest) == bits(truth) && any.is_some() == truth.is_some();
        if is_same || truth.is_some_and(|hit| may_be_lost(ray, hit)) {
            continue;
        }
        assert_eq!(bits(closest), bits(truth), "{name}, ray {ray}: closest hit");
        assert_eq!(any.is_some(), truth.is_some(), "{name}, ray {ray}: any hit");
    }
}

fn near(
    closest: &[Option<Hit>],
    any: &[Option<Hit>],
    truth: &[Option<Hit>],
    (wrong, is_near): (f64, impl Fn(usize, f32, Hit) -> bool),
    name: &str,
) {
    assert_eq!((closest.len(), any.len()), (truth.len(), truth.len()), "{name}");
    let agree = |ray: usize| match (closest[ray], truth[ray]) {
        (Some(hit), Some(truth)) => hit.sphere == truth.sphere && is_near(ray, hit.t, truth),
        (hit, truth) => hit.is_none() && truth.is_none(),
    };
    let differ = (0..truth.len()).filter(|&ray| !agree(ray)).count();
    let others = any.iter().zip(truth).filter(|(any, truth)| any.is_some() != truth.is_some());
    let (others, most) = (others.count(), (wrong * truth.len() as f64) as usize);
    assert!(differ.max(others) <= most, "{name}: {differ} closest hits, {others} any hits differ");
}

#[cfg(test)]
mod tests {
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
}
