//! What is true of rays and spheres under rules.
//!
//! `Exact` gives the roots and the order of spheres; where rules say otherwise, each case is settled by itself.

use crate::rules::{Inside, Precision, Rules, Tangents, Ties};
use crate::tangent::is_tangent;
use spherule_kernel::{
    Exact, Hit, Intersect, Ray, Side, Sphere, SphereTree, compare_hits, pairs, roots, side,
};
use std::cmp::Ordering;

/// What is true of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truth {
    /// The ray hits this.
    Hit(Hit),
    /// The ray hits nothing.
    Miss,
    /// The rules leave it open.
    Open,
}

impl Truth {
    /// The hit, if there is one.
    #[must_use]
    pub fn hit(&self) -> Option<Hit> {
        match *self {
            Self::Hit(hit) => Some(hit),
            Self::Miss | Self::Open => None,
        }
    }
}

/// Ray i against sphere i, whose index counts as 0: overwrites `truths`.
///
/// Cost: some tens of nanoseconds a pair; three times that if the rules differ in more than the interval.
pub fn of_pairs(rules: &Rules, rays: &[Ray], spheres: &[Sphere], truths: &mut Vec<Truth>) {
    let closed: Vec<Ray> = rays.iter().map(|ray| rules.closed(ray)).collect();
    let mut hits = vec![None; rays.len().min(spheres.len())];
    pairs(Exact, &closed, spheres, &mut hits);
    truths.clear();
    truths.extend(hits.into_iter().enumerate().map(|(index, hit)| {
        let hit: Option<Hit> = hit.map(|hit| Hit { sphere: 0, ..hit });
        settled(rules, &closed[index], &spheres[index], hit)
    }));
}

/// One ray and one sphere, whose index counts as 0.
#[must_use]
pub fn of_pair(rules: &Rules, ray: &Ray, sphere: &Sphere) -> Truth {
    let closed = rules.closed(ray);
    settled(rules, &closed, sphere, first_hit(&closed, sphere))
}

/// The hit under the contract, for a closed interval.
fn first_hit(ray: &Ray, sphere: &Sphere) -> Option<Hit> {
    let mut hit = [None];
    pairs(Exact, &[*ray], &[*sphere], &mut hit);
    hit[0].map(|hit| Hit { sphere: 0, ..hit })
}

/// What rules make of the contract's hit, of a ray whose interval is closed.
fn settled(rules: &Rules, ray: &Ray, sphere: &Sphere, hit: Option<Hit>) -> Truth {
    let truth = hit.map_or(Truth::Miss, Truth::Hit);
    if rules.follow_from_roots() {
        return truth;
    }
    if rules.precision == Precision::F64
        && let Some(roots) = roots(Exact, ray, sphere)
        && roots.iter().any(|t| *t == ray.t_min || *t == ray.t_max || t.is_infinite())
    {
        return Truth::Open;
    }
    if rules.inside == Inside::Solid
        && ray.is_live()
        && sphere.is_valid()
        && side(ray.origin, sphere) != Some(Side::Outside)
    {
        let starts = ray.t_min <= 0.0 && 0.0 <= ray.t_max;
        return if starts { Truth::Hit(Hit { t: 0.0, sphere: 0 }) } else { Truth::Open };
    }
    if hit.is_none() {
        return truth;
    }
    if rules.inside == Inside::Miss && side(ray.origin, sphere) == Some(Side::Inside) {
        return Truth::Miss;
    }
    if rules.tangents != Tangents::Hit && is_tangent(ray, sphere) {
        return if rules.tangents == Tangents::Miss { Truth::Miss } else { Truth::Open };
    }
    truth
}

/// Spheres that many rays share.
#[derive(Debug)]
pub struct Shared<'a> {
    spheres: &'a [Sphere],
    tree: SphereTree,
}

impl<'a> Shared<'a> {
    /// Builds a tree over the spheres.
    #[must_use]
    pub fn new(spheres: &'a [Sphere]) -> Self {
        Self { spheres, tree: SphereTree::new(spheres) }
    }

    /// The spheres.
    #[must_use]
    pub fn spheres(&self) -> &'a [Sphere] {
        self.spheres
    }

    /// The closest hits of rays: `truths` is overwritten.
    ///
    /// Cost: that of `Exact` in a tree. If rules change the contract's hit of a ray, that ray is tested against every sphere; with `inside
    /// = "solid"` every ray is.
    pub fn truths(&self, rules: &Rules, rays: &[Ray], truths: &mut Vec<Truth>) {
        let closed: Vec<Ray> = rays.iter().map(|ray| rules.closed(ray)).collect();
        let mut hits = vec![None; rays.len()];
        self.tree.closest_hits(Exact, &closed, &mut hits);
        truths.clear();
        truths.extend(closed.iter().zip(hits).map(|(ray, hit)| self.settled(rules, ray, hit)));
    }

    fn settled(&self, rules: &Rules, ray: &Ray, hit: Option<Hit>) -> Truth {
        let truth = hit.map_or(Truth::Miss, Truth::Hit);
        if rules.follow_from_roots() || (hit.is_none() && rules.inside != Inside::Solid) {
            return truth;
        }
        let of_sphere = |index: u32| {
            let sphere = &self.spheres[index as usize];
            match settled(rules, ray, sphere, first_hit(ray, sphere)) {
                Truth::Hit(hit) => Truth::Hit(Hit { sphere: index, ..hit }),
                other => other,
            }
        };
        if rules.inside != Inside::Solid && hit.is_some_and(|hit| of_sphere(hit.sphere) == truth) {
            return truth;
        }
        let mut closest: Option<Hit> = None;
        for index in 0..self.spheres.len() as u32 {
            match of_sphere(index) {
                Truth::Open => return Truth::Open,
                Truth::Miss => {}
                Truth::Hit(hit) => {
                    if closest.is_none_or(|known| self.order(ray, [hit, known]).is_lt()) {
                        closest = Some(hit);
                    }
                }
            }
        }
        closest.map_or(Truth::Miss, Truth::Hit)
    }

    fn order(&self, ray: &Ray, hits: [Hit; 2]) -> Ordering {
        // The t at which a ray starts in a ball is no root.
        if hits[0].t != hits[1].t || hits[0].t == 0.0 {
            return hits[0].t.total_cmp(&hits[1].t);
        }
        compare_hits(Exact, ray, hits.map(|hit| (hit.t, &self.spheres[hit.sphere as usize])))
    }

    /// Whether the rules accept `answered` for the true closest hit.
    #[must_use]
    pub fn is_as_close(&self, rules: &Rules, ray: &Ray, truth: Hit, answered: u32) -> bool {
        let Some(sphere) = self.spheres.get(answered as usize) else { return false };
        if rules.ties == Ties::First {
            return answered == truth.sphere;
        }
        let Truth::Hit(hit) = of_pair(rules, ray, sphere) else { return false };
        let hit = Hit { sphere: answered, ..hit };
        hit.t == truth.t
            && (rules.ties == Ties::Rounded || self.order(&rules.closed(ray), [hit, truth]).is_eq())
    }
}
