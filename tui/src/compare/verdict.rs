//! What one answer gets wrong against the truth, and counts of many such verdicts.

pub use crate::tally::Class;
use crate::tally::Tally;
use spherule_kernel::{Hit, Ray, Spheres};
use spherule_referee::middle::is_at_the_other_root;

/// A [`Class`], and how far t is off in ulp if both hit the same sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Verdict {
    /// What is wrong.
    pub class: Class,
    /// How far off t is.
    pub ulp: u64,
}

impl Verdict {
    /// Both miss.
    pub const MISS: Self = Self { class: Class::Miss, ulp: 0 };

    /// Compares the answer for `ray` with the truth.
    #[must_use]
    pub fn of(ray: &Ray, spheres: Spheres<'_>, answer: Option<Hit>, truth: Option<Hit>) -> Self {
        let elsewhere = answer.zip(truth).is_some_and(|(a, b)| a.sphere != b.sphere);
        let [t, true_t] = [answer, truth].map(|hit| hit.map(|hit| hit.t));
        let (class, ulp) = Class::of(t, true_t, elsewhere);
        let class = match (class, answer.zip(truth)) {
            (Class::Off(_), Some((answer, truth)))
                if spheres.get(truth.sphere as usize).is_some_and(|sphere| {
                    is_at_the_other_root(ray, &sphere, f64::from(answer.t), truth.t)
                }) =>
            {
                Class::OtherRoot
            }
            _ => class,
        };
        Self { class, ulp }
    }
}

/// Judges the closest hits of many rays, `answers[i]` of `rays[i]` by `truths[i]`, and counts.
pub(crate) fn tally(
    rays: impl IntoIterator<Item = Ray>,
    spheres: Spheres<'_>,
    answers: impl IntoIterator<Item = Option<Hit>>,
    truths: impl IntoIterator<Item = Option<Hit>>,
) -> Tally {
    let mut tally = Tally::default();
    for ((ray, answer), truth) in rays.into_iter().zip(answers).zip(truths) {
        let Verdict { class, .. } = Verdict::of(&ray, spheres, answer, truth);
        let elsewhere = matches!(class, Class::OtherSphere | Class::OtherRoot);
        tally.record(answer.map(|hit| hit.t), truth.map(|hit| hit.t), elsewhere);
    }
    tally
}

/// The worst ray of some.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Worst {
    /// What is wrong with it.
    pub verdict: Verdict,
    /// The sphere that the answer hits or, if the answer is a miss, that the ray hits.
    pub sphere: u32,
    /// Its sample, counted in columns and rows over the whole picture.
    pub sample: (u32, u32),
}

/// What many verdicts come to, in rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Same sphere, same t.
    pub right: u64,
    /// Same sphere, t off: counted by the power of two of their ulp.
    pub off: [u64; 32],
    /// Same sphere, other root.
    pub other_root: u64,
    /// Answers that miss where the truth hits.
    pub lost_hits: u64,
    /// Answers that hit where the truth misses.
    pub false_hits: u64,
    /// Hits of another sphere.
    pub other_spheres: u64,
    /// The worst of the rays that are not right; of equals, the first from the top left. `None` if all are right.
    pub worst: Option<Worst>,
}

impl Counts {
    /// Adds the verdict on a ray through `sample`.
    pub fn add(
        &mut self,
        verdict: Verdict,
        (answer, truth): (Option<Hit>, Option<Hit>),
        sample: (u32, u32),
    ) {
        *match verdict.class {
            Class::Miss => return,
            Class::Right => &mut self.right,
            Class::Off(log) => &mut self.off[usize::from(log)],
            Class::OtherRoot => &mut self.other_root,
            Class::LostHit => &mut self.lost_hits,
            Class::FalseHit => &mut self.false_hits,
            Class::OtherSphere => &mut self.other_spheres,
        } += 1;
        if let Some(hit) = answer.or(truth).filter(|_| verdict.class > Class::Right) {
            self.take(Worst { verdict, sphere: hit.sphere, sample });
        }
    }

    fn take(&mut self, other: Worst) {
        let is_worse = self.worst.is_none_or(|worst| {
            // In the order in which a picture is read.
            let place = |of: &Worst| (of.sample.1, of.sample.0);
            other.verdict > worst.verdict
                || other.verdict == worst.verdict && place(&other) < place(&worst)
        });
        if is_worse {
            self.worst = Some(other);
        }
    }

    /// The counts of both, in whatever order.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        self.right += other.right;
        for (sum, count) in self.off.iter_mut().zip(other.off) {
            *sum += count;
        }
        self.other_root += other.other_root;
        self.lost_hits += other.lost_hits;
        self.false_hits += other.false_hits;
        self.other_spheres += other.other_spheres;
        if let Some(worst) = other.worst {
            self.take(worst);
        }
        self
    }

    /// The number of rays of which more than the last digits are wrong.
    #[must_use]
    pub fn wrong_decisions(&self) -> u64 {
        self.other_root + self.lost_hits + self.false_hits + self.other_spheres
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::{Exact, Intersect, Vec3};

    fn hit(t: f32, sphere: u32) -> Option<Hit> {
        Some(Hit { t, sphere })
    }

    /// Along z, against spheres of radius 1 at 5 and of radius 2 around the origin.
    fn verdict(answer: Option<Hit>, truth: Option<Hit>) -> Verdict {
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        let spheres = Spheres::new(&[0.0; 2], &[0.0; 2], &[5.0, 0.0], &[1.0, 2.0]);
        Verdict::of(&ray, spheres.expect("as many of each"), answer, truth)
    }

    fn stepped(t: f32, ulp: i32) -> f32 {
        f32::from_bits(t.to_bits().wrapping_add_signed(ulp))
    }

    #[test]
    fn decisions() {
        for (answer, truth, class) in [
            (None, None, Class::Miss),
            (hit(4.0, 0), None, Class::FalseHit),
            (None, hit(4.0, 0), Class::LostHit),
            (hit(2.0, 1), hit(4.0, 0), Class::OtherSphere),
            // Whatever t is.
            (hit(4.0, 1), hit(4.0, 0), Class::OtherSphere),
            (hit(4.0, 0), hit(4.0, 0), Class::Right),
            (hit(6.0, 0), hit(4.0, 0), Class::OtherRoot),
            (hit(4.0, 0), hit(6.0, 0), Class::OtherRoot),
            (hit(5.5, 0), hit(4.0, 0), Class::OtherRoot),
            (hit(-2.0, 1), hit(2.0, 1), Class::OtherRoot),
            (hit(1e9, 0), hit(4.0, 0), Class::OtherRoot),
        ] {
            assert_eq!(verdict(answer, truth).class, class, "{answer:?} {truth:?}");
        }
    }

    #[test]
    fn last_digits() {
        for (ulp, log) in [(1, 0), (-1, 0), (2, 1), (3, 1), (-4, 2), (15, 3), (16, 4), (255, 7)] {
            let found = verdict(hit(stepped(4.0, ulp), 0), hit(4.0, 0));
            let ulp = u64::from(ulp.unsigned_abs());
            assert_eq!(found, Verdict { class: Class::Off(log), ulp }, "{ulp}");
        }
        // Across zero, and at infinity: no root is nearer than the truth.
        let tiny = f32::from_bits(1);
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        let nowhere = Spheres::new(&[], &[], &[], &[]).expect("none of each");
        for (answer, truth, ulp) in [
            (-tiny, tiny, 2),
            (0.0, -0.0, 0),
            (f32::INFINITY, f32::MAX, 1),
            (-1.0, 1.0, 0x7f00_0000),
        ] {
            let found = Verdict::of(&ray, nowhere, hit(answer, 0), hit(truth, 0));
            assert_eq!(found.ulp, ulp, "{answer:e} {truth:e}");
            let class = ulp.checked_ilog2().map_or(Class::Right, |log| Class::Off(log as u8));
            assert_eq!(found.class, class);
        }
    }

    /// A hit at the other root is in a wrong place, and its t is not among the errors in ulp.
    #[test]
    fn a_tally_tells_roots_apart() {
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        let spheres = Spheres::new(&[0.0; 2], &[0.0; 2], &[5.0, 0.0], &[1.0, 2.0]);
        let spheres = spheres.expect("as many of each");
        let truth = hit(4.0, 0);
        let answers = [truth, hit(stepped(4.0, 3), 0), hit(6.0, 0), hit(2.0, 1), None];
        let found = tally([ray; 5], spheres, answers, [truth; 5]).summary();
        assert_eq!((found.wrong_places, found.wrong_misses, found.rounded), (2, 1, 1));
        assert_eq!(found.ulp.map(|ulp| ulp.max), Some(3));
    }

    /// Where D is lost, the textbook's t is next to the middle, and rounded roots may be as far from it.
    #[test]
    fn next_to_the_middle_the_nearer_root_is_told() {
        let origin = Vec3::new(115.54503, 93.65253, 1990.1035);
        let ray = Ray::new(origin, Vec3::new(-0.060_130_928, -0.045_098_197, -0.997_171_2));
        let spheres = Spheres::new(&[-4.4], &[1.8], &[0.0], &[1.9]).expect("one of each");
        let truth = spheres.closest_hit(Exact, &ray);
        assert_eq!(truth.map(|hit| hit.t), Some(1995.3837));
        for (t, is_elsewhere) in [(1995.8287_f32, true), (1995.8287_f32.next_down(), false)] {
            let class = Verdict::of(&ray, spheres, hit(t, 0), truth).class;
            assert_eq!(class == Class::OtherRoot, is_elsewhere, "{t}: {class:?}");
        }
    }

    /// Where both roots are one, there is no other.
    #[test]
    fn a_line_that_touches_has_one_root() {
        let ray = Ray::new(Vec3::new(1.0, 0.0, 0.0), Vec3::Z);
        let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("one of each");
        for answer in [4.0, 6.0, 1e9] {
            let class = Verdict::of(&ray, spheres, hit(answer, 0), hit(5.0, 0)).class;
            assert!(matches!(class, Class::Off(_)), "{answer}: {class:?}");
        }
    }

    #[test]
    fn the_worst_is_the_same_in_every_order() {
        let off = Verdict { class: Class::Off(3), ulp: 9 };
        let lost = Verdict { class: Class::LostHit, ulp: 0 };
        let rays = [
            (Verdict::MISS, (9, 0)),
            (off, (0, 1)),
            (lost, (7, 2)),
            (Verdict { class: Class::Right, ulp: 0 }, (3, 0)),
            (lost, (2, 2)),
            (lost, (1, 3)),
            (Verdict { class: Class::Off(3), ulp: 10 }, (4, 4)),
        ];
        let count = |rays: &[(Verdict, (u32, u32))]| {
            let mut counts = Counts::default();
            for &(verdict, sample) in rays {
                counts.add(verdict, (None, hit(1.0, 8)), sample);
            }
            counts
        };
        let all = count(&rays);
        assert_eq!(all.worst, Some(Worst { verdict: lost, sphere: 8, sample: (2, 2) }));
        assert_eq!((all.right, all.off[3], all.lost_hits), (1, 2, 3));
        assert_eq!(all.wrong_decisions(), 3);
        for middle in 0..=rays.len() {
            let (first, last) = (count(&rays[..middle]), count(&rays[middle..]));
            assert_eq!(first.and(&last), all);
            assert_eq!(last.and(&first), all);
        }
        let right = count(&rays[..1]);
        assert_eq!((right.worst, right.wrong_decisions()), (None, 0));
    }
}
