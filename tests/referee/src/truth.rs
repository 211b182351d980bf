//! What is true of rays and spheres under rules.
//!
//! `Exact` gives the roots and the order of spheres; where rules say otherwise, each case is settled by itself.

use crate::aim::length;
use crate::random::power_of_two;
use crate::rules::{Inside, Interval, Precision, Rules, Tangents, Ties};
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
        settled(rules, &rays[index], &spheres[index], hit)
    }));
}

/// One ray and one sphere, whose index counts as 0.
#[must_use]
pub fn of_pair(rules: &Rules, ray: &Ray, sphere: &Sphere) -> Truth {
    settled(rules, ray, sphere, first_hit(&rules.closed(ray), sphere))
}

/// The hit under the contract, for a closed interval.
fn first_hit(ray: &Ray, sphere: &Sphere) -> Option<Hit> {
    let mut hit = [None];
    pairs(Exact, &[*ray], &[*sphere], &mut hit);
    hit[0]
}

/// What rules make of the contract's hit, which is that of the closed interval.
fn settled(rules: &Rules, ray: &Ray, sphere: &Sphere, hit: Option<Hit>) -> Truth {
    let truth = hit.map_or(Truth::Miss, Truth::Hit);
    if rules.follow_from_roots() {
        return truth;
    }
    // A root that is rounded to an end, as the ray has it, may lie on either side of it.
    if rules.precision == Precision::F64
        && ray.is_live()
        && let Some(roots) = roots(Exact, ray, sphere)
        && roots.iter().any(|t| *t == ray.t_min || *t == ray.t_max || t.is_infinite())
    {
        return Truth::Open;
    }
    let ray = &rules.closed(ray);
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
    /// No point of a valid sphere is farther from zero.
    reach: f64,
}

impl<'a> Shared<'a> {
    /// Builds a tree over the spheres.
    #[must_use]
    pub fn new(spheres: &'a [Sphere]) -> Self {
        let valid = spheres.iter().filter(|sphere| sphere.is_valid());
        let reach = valid.map(|sphere| length(sphere.center) + f64::from(sphere.radius));
        Self { spheres, tree: SphereTree::new(spheres), reach: reach.fold(0.0, f64::max) }
    }

    /// The spheres.
    #[must_use]
    pub fn spheres(&self) -> &'a [Sphere] {
        self.spheres
    }

    /// The closest hits of rays: `truths` is overwritten.
    ///
    /// Cost: that of `Exact` in a tree. If rules change the contract's hit of a ray, that ray is tested against every sphere; with `inside
    /// = "solid"` every ray is, and with `precision = "f64"` a ray on which roots may be too large for single precision.
    pub fn truths(&self, rules: &Rules, rays: &[Ray], truths: &mut Vec<Truth>) {
        let closed: Vec<Ray> = rays.iter().map(|ray| rules.closed(ray)).collect();
        let mut hits = vec![None; rays.len()];
        self.tree.closest_hits(Exact, &closed, &mut hits);
        truths.clear();
        truths.extend(rays.iter().zip(hits).map(|(ray, hit)| self.settled(rules, ray, hit)));
    }

    fn settled(&self, rules: &Rules, ray: &Ray, hit: Option<Hit>) -> Truth {
        let truth = hit.map_or(Truth::Miss, Truth::Hit);
        if rules.follow_from_roots() {
            return truth;
        }
        let is_double = rules.precision == Precision::F64;
        if is_double && self.is_first_at_an_end(rules, ray, hit) {
            return Truth::Open;
        }
        let of_sphere = |index: u32| match of_pair(rules, ray, &self.spheres[index as usize]) {
            Truth::Hit(hit) => Truth::Hit(Hit { sphere: index, ..hit }),
            other => other,
        };
        // A root that overflows is behind every other, except where the interval begins before all.
        let may_be_first = hit.is_none() || ray.t_min == f32::NEG_INFINITY;
        let sees_all =
            rules.inside == Inside::Solid || is_double && may_be_first && self.may_overflow(ray);
        if !sees_all && hit.is_none_or(|hit| of_sphere(hit.sphere) == truth) {
            return truth;
        }
        let mut closest: Option<Hit> = None;
        for index in 0..self.spheres.len() as u32 {
            match of_sphere(index) {
                Truth::Open => return Truth::Open,
                Truth::Miss => {}
                Truth::Hit(hit) => {
                    if closest.is_none_or(|known| self.order(rules, ray, [hit, known]).is_lt()) {
                        closest = Some(hit);
                    }
                }
            }
        }
        closest.map_or(Truth::Miss, Truth::Hit)
    }

    /// Whether the first root in the interval with both its ends is rounded to one of them. `hit` is the contract's.
    fn is_first_at_an_end(&self, rules: &Rules, ray: &Ray, hit: Option<Hit>) -> bool {
        let is_closed = rules.interval == Interval::Closed;
        let first = if is_closed { hit } else { self.tree.closest_hit(Exact, ray) };
        first.is_some_and(|hit| hit.t == ray.t_min || hit.t == ray.t_max)
    }

    /// Whether a root may be too large for single precision.
    fn may_overflow(&self, ray: &Ray) -> bool {
        let farthest = length(ray.origin) + self.reach;
        ray.is_live() && farthest >= power_of_two(127) * length(ray.direction)
    }

    fn order(&self, rules: &Rules, ray: &Ray, hits: [Hit; 2]) -> Ordering {
        // The t at which a ray starts in a ball is no root.
        let is_start = rules.inside == Inside::Solid && hits[0].t == 0.0;
        if hits[0].t != hits[1].t || is_start {
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
        let hit = match of_pair(rules, ray, sphere) {
            Truth::Hit(hit) => Some(hit),
            // If either answer is right, so is the hit.
            Truth::Open => first_hit(&rules.closed(ray), sphere),
            Truth::Miss => None,
        };
        let is_tie = |hit| self.order(rules, ray, [hit, truth]).is_eq();
        hit.map(|hit| Hit { sphere: answered, ..hit })
            .is_some_and(|hit| hit.t == truth.t && (rules.ties == Ties::Rounded || is_tie(hit)))
    }
}
