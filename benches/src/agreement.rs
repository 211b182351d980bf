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
            if truth.iter().all(Option::is_none) {
                let spheres: Vec<_> = scene.spheres.spheres().iter().collect();
                let hits = own.truth(&spheres, exact).iter().flatten().count();
                assert_eq!(hits, 0, "{name}: {hits} rays hit, and none of those that are compared");
            }
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
    let rays = truth.len();
    let closest = (0..rays).filter(|&ray| !agree(ray)).count();
    let any = any.iter().zip(truth).filter(|(any, truth)| any.is_some() != truth.is_some());
    let (any, most) = (any.count(), (wrong * rays as f64) as usize);
    assert!(
        closest.max(any) <= most,
        "{name}: of {rays} rays {closest} closest hits, {any} any hits differ; {most} may"
    );
}

#[cfg(test)]
mod tests;
