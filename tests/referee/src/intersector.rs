//! Any code that finds what rays meet can be judged.

use crate::answer::Answer;
use crate::rules::{Rules, Ties};
use spherule_kernel::{Hit, Intersect, Ray, Sphere, SphereList, Tier, pairs};

/// Finds what rays meet among spheres.
///
/// ```
/// use spherule_referee::{Intersector, Ray, Sphere, answer::Answer};
///
/// #[derive(Clone)]
/// struct Blind;
///
/// impl Intersector for Blind {
///     fn name(&self) -> &str {
///         "blind"
///     }
///
///     fn closest_hits(&mut self, _: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
///         vec![None; rays.len()]
///     }
/// }
/// ```
///
/// A method may panic, hang, or answer too few rays: the judge reports that, and judges the other rays.
pub trait Intersector {
    /// What it is called.
    fn name(&self) -> &str;

    /// The closest hit of each ray among `spheres`, in the order of the rays; `None` for a miss.
    fn closest_hits(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>>;

    /// What ray i meets of sphere i alone, whose index is 0. By default calls
    /// [`closest_hits`](Intersector::closest_hits) once a ray.
    fn pairs(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
        let one = |(sphere, ray)| {
            let answers =
                self.closest_hits(std::slice::from_ref(sphere), std::slice::from_ref(ray));
            answers.into_iter().next()
        };
        // A missing answer ends the list, which makes it too short.
        spheres.iter().zip(rays).map_while(one).collect()
    }

    /// What the intersector promises: by default, the contract.
    fn rules(&self) -> Rules {
        Rules::CONTRACT
    }
}

/// A function of one ray and one sphere. The closest of several spheres is the one with the least t, then the first.
#[derive(Clone, Debug)]
pub struct Pair<F> {
    name: String,
    rules: Rules,
    function: F,
}

impl<F> Pair<F> {
    /// The function returns t in the ray's interval, or `None` for a miss.
    pub fn new<T: Into<f64>>(name: &str, function: F) -> Self
    where
        F: FnMut(&Ray, &Sphere) -> Option<T>,
    {
        // The function knows no more than t.
        let rules = Rules { ties: Ties::Rounded, ..Rules::CONTRACT };
        Self { name: name.to_owned(), rules, function }
    }

    /// The same function, with other promises.
    #[must_use]
    pub fn with_rules(self, rules: Rules) -> Self {
        Self { rules, ..self }
    }
}

impl<F, T> Intersector for Pair<F>
where
    F: FnMut(&Ray, &Sphere) -> Option<T>,
    T: Into<f64>,
{
    fn name(&self) -> &str {
        &self.name
    }

    fn closest_hits(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
        let mut closest = |ray| {
            let mut closest: Option<Answer> = None;
            for (index, sphere) in (0..).zip(spheres) {
                let Some(t) = (self.function)(ray, sphere) else { continue };
                let t = t.into();
                if closest.is_none_or(|known| t < known.t) {
                    closest = Some(Answer { t, sphere: Some(index) });
                }
            }
            closest
        };
        rays.iter().map(&mut closest).collect()
    }

    fn pairs(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
        let mut one = |(sphere, ray)| (self.function)(ray, sphere).map(Answer::at);
        spheres.iter().zip(rays).map(&mut one).collect()
    }

    fn rules(&self) -> Rules {
        self.rules
    }
}

/// A tier of Spherule's kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel(pub Tier);

impl Intersector for Kernel {
    fn name(&self) -> &str {
        self.0.as_str()
    }

    fn closest_hits(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
        let mut hits = vec![None; rays.len()];
        SphereList::from(spheres).closest_hits(self.0, rays, &mut hits);
        hits.into_iter().map(|hit| hit.map(answer)).collect()
    }

    fn pairs(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
        let mut hits = vec![None; rays.len()];
        pairs(self.0, rays, spheres, &mut hits);
        hits.into_iter().map(|hit| hit.map(|hit: Hit| Answer::at(hit.t))).collect()
    }

    fn rules(&self) -> Rules {
        match self.0 {
            Tier::Exact => Rules::CONTRACT,
            // The other tiers know no more than T.
            _ => Rules { ties: Ties::Rounded, ..Rules::CONTRACT },
        }
    }
}

fn answer(hit: Hit) -> Answer {
    Answer { t: hit.t.into(), sphere: Some(hit.sphere) }
}
