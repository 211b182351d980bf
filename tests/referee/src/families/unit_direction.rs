//! Cases brought to directions of length one.

use crate::aim::{double, length, single};
use crate::case::Case;
use crate::ulp::{ordered, step};
use spherule_kernel::{Exact, Ray, roots};

/// An end of the interval so many ulp from a root, or fewer, was made for that root.
const AT_ROOT: i64 = 2;

/// The case with a direction as near to length one as `f32` has one. The interval keeps its place on the ray. A direction
/// without length stays.
pub(super) fn with_unit_direction(case: &Case) -> Case {
    let length = length(case.ray.direction);
    if !(length > 0.0 && length.is_finite()) {
        return *case;
    }
    let direction = single(double(case.ray.direction).map(|x| x / length));
    let ray = Ray { direction, ..case.ray };
    let [before, after] = [&case.ray, &ray].map(|ray| roots(Exact, ray, &case.sphere));
    let end = |end: f32| moved(end, length, before.zip(after));
    Case { ray: Ray { t_min: end(ray.t_min), t_max: end(ray.t_max), ..ray }, ..*case }
}

/// An end of the interval of a direction that was `length` long: as many ulp from its root as before, if it was at one. The
/// roots are those before and after.
fn moved(end: f32, length: f64, roots: Option<([f32; 2], [f32; 2])>) -> f32 {
    // Zero and infinities are the same for every length.
    if end == 0.0 || !end.is_finite() {
        return end;
    }
    let both = roots.into_iter().flat_map(|(before, after)| before.into_iter().zip(after));
    let steps = both.map(|(before, after)| (ordered(end) - ordered(before), after));
    let nearest = steps.min_by_key(|(steps, _)| steps.abs());
    match nearest.filter(|(steps, _)| steps.abs() <= AT_ROOT) {
        Some((steps, root)) => step(root, steps),
        None => (f64::from(end) * length) as f32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::{FAMILIES, Family, SEED};
    use crate::ulp::ulp_between;
    use spherule_kernel::{Sphere, Vec3};

    #[test]
    fn ends_stay_at_their_roots() {
        let family = Family::named("interval-at-root").expect("a family");
        let is_at_root = |index: &u64| {
            let Case { ray, sphere } = family.seeded_unit(SEED, *index);
            let near = |root: f32| [ray.t_min, ray.t_max].map(|end| ulp_between(root, end) <= 2);
            roots(Exact, &ray, &sphere)
                .is_some_and(|roots| roots.into_iter().any(|root| near(root).contains(&true)))
        };
        // Of tangents, a fourth, some are missed once their directions are rounded.
        let count = (0..400).filter(is_at_root).count();
        assert!(count > 300, "{count} of 400");
    }

    #[test]
    fn other_ends_keep_their_places() {
        let ray = Ray { t_min: 1.0, t_max: 6.0, ..Ray::new(Vec3::ZERO, Vec3::Z * 4.0) };
        let case = Case { ray, sphere: Sphere::from([0.0, 0.0, 24.0, 4.0]) };
        let unit = with_unit_direction(&case);
        let expected = Ray { direction: Vec3::Z, t_min: 4.0, t_max: 24.0, ..ray };
        assert_eq!(unit, Case { ray: expected, ..case });
        // The far root is at 7 before, and at 28 after.
        let beside = Case { ray: Ray { t_max: step(7.0, -2), ..ray }, ..case };
        assert_eq!(with_unit_direction(&beside).ray.t_max, step(28.0, -2));
    }

    #[test]
    fn directions_get_length_one_or_stay() {
        for family in FAMILIES {
            for index in 0..200 {
                let (case, unit) = (family.seeded(SEED, index), family.seeded_unit(SEED, index));
                let [before, after] = [case, unit].map(|case| length(case.ray.direction));
                let is_unit = (after - 1.0).abs() < 1e-6;
                let has_none = !(before > 0.0 && before.is_finite());
                assert!(is_unit || has_none && unit.bits() == case.bits(), "{case:?}: {unit:?}");
            }
        }
    }
}
