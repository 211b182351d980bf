//! What was measured of a scene's rays of a kind.

use crate::rounds::{Median, Samples};
use crate::scenes::Kind;
use crate::structures::agreement::Agreement;
use crate::structures::contender::{Contender, Tier, Way, question_name};
use spherule_kernel::Question;
use spherule_kernel::dispatch::LevelName;

/// Times of a scene's rays of a kind.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The scene.
    pub scene: &'static str,
    /// Which rays.
    pub kind: Kind,
    /// How many spheres.
    pub spheres: usize,
    /// The level that all tiers were timed at.
    pub level: LevelName,
    /// Who took part.
    pub contenders: Vec<Contender>,
    /// How the answers of others were.
    pub agreements: Vec<(Contender, Agreement)>,
    /// Nanoseconds a ray.
    pub(super) samples: Samples,
}

/// The name of what is timed.
pub(super) fn subject(contender: Contender, question: Question) -> String {
    format!("{}, {contender}", question_name(question))
}

impl Measured {
    /// How often each was timed.
    #[must_use]
    pub fn rounds(&self) -> usize {
        self.samples.rounds()
    }

    /// A million rays a second; nothing of who did not take part.
    #[must_use]
    pub fn rate(&self, contender: Contender, question: Question) -> Option<f64> {
        let took_part = self.contenders.contains(&contender);
        took_part.then(|| 1e3 / self.samples.median(&subject(contender, question)).middle)
    }

    /// How many times as fast a contender is as another, round by round.
    ///
    /// # Panics
    /// Where one of them did not take part.
    #[must_use]
    pub fn times_as_fast(
        &self,
        contender: Contender,
        other: Contender,
        question: Question,
    ) -> Median {
        self.samples.ratio(&subject(other, question), &subject(contender, question))
    }

    /// The fastest of those that `chosen` keeps.
    #[must_use]
    pub fn fastest(
        &self,
        question: Question,
        chosen: impl Fn(Contender) -> bool,
    ) -> Option<Contender> {
        let rate = |contender: &Contender| self.rate(*contender, question).unwrap_or(0.0);
        let all = self.contenders.iter().copied().filter(|&contender| chosen(contender));
        all.max_by(|a, b| rate(a).total_cmp(&rate(b)))
    }

    /// The kernel's fastest way at the best level, in a tier.
    #[must_use]
    pub fn fastest_way(&self, question: Question, tier: Tier) -> Option<Way> {
        let of = |way| Contender::Ours(way, tier, self.level);
        let fastest = self.fastest(question, |other| Way::ALL.map(of).contains(&other))?;
        Way::ALL.into_iter().find(|&way| of(way) == fastest)
    }
}
