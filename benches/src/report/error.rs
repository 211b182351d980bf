//! How wrong every contender is, regime by regime, against the oracle of big integers.
//!
//! One ray, one sphere, by the door that users take. Error does not depend on lanes: it is tallied
//! once for a name, and every other engine of that name is asked the same and must give the same
//! bits; where one does not, the report counts it.

use crate::report::contender::Contender;
use spherule_kernel::{Ray, Sphere, Spheres};
use spherule_tests::case::Case;
use spherule_tests::measured::MEASURED;
use spherule_tests::oracle;
use spherule_tests::tally::{Summary, Tally};

/// What a contender gets wrong in a regime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegimeError {
    /// The regime's name.
    pub regime: &'static str,
    /// Decisions and ulp.
    pub summary: Summary,
    /// True hits whose t is the correctly rounded one.
    pub rounded: u32,
}

impl RegimeError {
    /// Wrong decisions of every kind in a million rays.
    #[must_use]
    pub fn wrong_ppm(&self) -> f64 {
        let Summary { wrong_hits, wrong_misses, wrong_roots, .. } = self.summary;
        self.ppm(wrong_hits + wrong_misses + wrong_roots)
    }

    /// Of a million rays.
    #[must_use]
    pub fn ppm(&self, count: u32) -> f64 {
        f64::from(count) * 1e6 / f64::from(self.summary.cases)
    }

    /// True hits that were found, at the right root.
    #[must_use]
    pub const fn found(&self) -> u32 {
        self.summary.hits - self.summary.wrong_misses - self.summary.wrong_roots
    }

    /// Of true hits, those with a correctly rounded t, in per cent.
    #[must_use]
    pub fn rounded_percent(&self) -> f64 {
        100.0 * f64::from(self.rounded) / f64::from(self.summary.hits.max(1))
    }

    /// Whether this is no less right than `other` in any figure.
    #[must_use]
    pub fn no_worse_than(&self, other: &Self) -> bool {
        let (ours, theirs) = (self.summary, other.summary);
        ours.wrong_hits <= theirs.wrong_hits
            && ours.wrong_misses <= theirs.wrong_misses
            && ours.wrong_roots <= theirs.wrong_roots
            && ours.median <= theirs.median
            && ours.p999 <= theirs.p999
            && ours.max <= theirs.max
            && self.rounded >= other.rounded
    }
}

/// Everything that a name gets wrong.
#[derive(Clone, Debug)]
pub struct NamedErrors {
    /// The tier's or the form's name.
    pub name: &'static str,
    /// In the order of [`MEASURED`].
    pub regimes: Vec<RegimeError>,
    /// Answers of other engines that differ from those of the first in a bit.
    pub differing: u64,
    /// Of all answers' bits: the same on machines that give the same answers.
    pub digest: u64,
}

/// Asks every contender for `cases` cases of every regime.
#[must_use]
pub fn measure(contenders: &[Contender], cases: u64) -> Vec<NamedErrors> {
    let mut all: Vec<NamedErrors> = Vec::new();
    for measured in MEASURED {
        let cases: Vec<_> = measured.cases(cases).collect();
        let roots: Vec<_> =
            cases.iter().map(|case| oracle::roots(&case.ray, &case.sphere)).collect();
        // The answers of the engine that stands first for a name.
        let mut first: Option<(&'static str, Vec<Option<f32>>)> = None;
        for contender in contenders {
            let answers: Vec<_> = cases.iter().map(|case| alone(contender, case)).collect();
            match &first {
                Some((name, expected)) if *name == contender.name => {
                    let bits = |t: &Option<f32>| t.map(f32::to_bits);
                    let differing = |(a, b)| bits(a) != bits(b);
                    let count = answers.iter().zip(expected).filter(|&pair| differing(pair));
                    entry(&mut all, contender.name).differing += count.count() as u64;
                }
                _ => {
                    let entry = entry(&mut all, contender.name);
                    entry.regimes.push(tallied(measured.name, &cases, &roots, &answers));
                    entry.digest = answers.iter().fold(entry.digest, |digest, t| {
                        let bits = t.map_or(u32::MAX, f32::to_bits);
                        (digest ^ u64::from(bits)).wrapping_mul(0x0100_0000_01b3)
                    });
                    first = Some((contender.name, answers));
                }
            }
        }
    }
    all
}

fn entry<'a>(all: &'a mut Vec<NamedErrors>, name: &'static str) -> &'a mut NamedErrors {
    let index = all.iter().position(|entry| entry.name == name).unwrap_or_else(|| {
        // FNV-1a's offset basis.
        let digest = 0xcbf2_9ce4_8422_2325;
        all.push(NamedErrors { name, regimes: Vec::new(), differing: 0, digest });
        all.len() - 1
    });
    &mut all[index]
}

/// The t of a case on its own.
///
/// # Panics
/// Never: one sphere is a list.
fn alone(contender: &Contender, Case { ray, sphere }: &Case) -> Option<f32> {
    let Sphere { center, radius } = *sphere;
    let (x, y, z, r) = ([center.x], [center.y], [center.z], [radius]);
    let spheres = Spheres::new(&x, &y, &z, &r).expect("equal lengths");
    let rays: [Ray; 1] = [*ray];
    let mut run = (contender.ready)(&rays, spheres);
    run.run();
    run.hits()[0].map(|hit| hit.t)
}

fn tallied(
    regime: &'static str,
    cases: &[Case],
    roots: &[Option<[f32; 2]>],
    answers: &[Option<f32>],
) -> RegimeError {
    let mut tally = Tally::default();
    let mut rounded = 0;
    for ((case, &roots), &answer) in cases.iter().zip(roots).zip(answers) {
        tally.record(case, roots, answer);
        let expected = roots.and_then(|roots| oracle::accepted(&case.ray, roots));
        let right = expected.is_some_and(|t| answer.map(f32::to_bits) == Some(t.to_bits()));
        rounded += u32::from(right);
    }
    RegimeError { regime, summary: tally.summary(), rounded }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::contender::contenders;
    use crate::report::reference::{DOUBLE, LECTURE};

    #[test]
    fn exact_is_right_double_nearly_and_the_lecture_s_form_is_not() {
        let errors = measure(&contenders(), 300);
        let of = |name: &str| errors.iter().find(|entry| entry.name == name).expect("measured");
        for entry in &errors {
            assert_eq!(entry.regimes.len(), MEASURED.len(), "{}", entry.name);
            assert_eq!(entry.differing, 0, "{}", entry.name);
        }
        for regime in &of("exact").regimes {
            assert_eq!((regime.wrong_ppm(), regime.summary.max), (0.0, 0), "{}", regime.regime);
            assert_eq!(regime.rounded, regime.summary.hits, "{}", regime.regime);
        }
        let [ordinary, _, far, ..] = &of(LECTURE).regimes[..] else { panic!("regimes") };
        assert!(ordinary.summary.p999 < 2000 && far.wrong_ppm() > 1e5);
        assert_eq!(of(DOUBLE).regimes[0].rounded, of(DOUBLE).regimes[0].summary.hits);
        let exact = of("exact").regimes.iter();
        assert!(exact.zip(&of("fast").regimes).all(|(exact, fast)| exact.no_worse_than(fast)));
    }
}
