//! The command line of the reports.

use clap::builder::PossibleValuesParser;
use clap::{Parser, ValueEnum};
use spherule_tests::orders::Order;
use spherule_tests::scenes::{LARGE, SPREAD};

#[derive(Parser)]
pub(crate) struct Arguments {
    /// What is measured; all unless said.
    pub(crate) part: Option<Part>,
    /// One large scene alone; nothing is written.
    #[arg(long, value_parser = PossibleValuesParser::new(LARGE.into_iter().chain([SPREAD])))]
    pub(crate) scene: Option<String>,
    /// One order of rays alone, in every scene that is chosen; nothing is written.
    #[arg(long, value_parser = Order::ALL.map(Order::as_str))]
    pub(crate) order: Option<String>,
    /// Rays of a call, in rays in every order; nothing is written.
    #[arg(long)]
    pub(crate) rays: Option<usize>,
    /// Writes docs/benchmarks.
    #[arg(long)]
    pub(crate) write: bool,
    /// A first impression.
    #[arg(long)]
    pub(crate) quick: bool,
    /// That everything runs; nothing is written.
    #[arg(long)]
    pub(crate) test: bool,
    /// What cargo says to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Part {
    Tiers,
    Structures,
    Cameras,
    Surfaces,
    Orders,
    Calls,
    Scales,
}

impl Arguments {
    pub(crate) fn chooses(&self, part: Part) -> bool {
        self.part.is_none_or(|chosen| chosen == part)
    }

    /// Whether pages are written.
    pub(crate) fn writes(&self) -> bool {
        let is_part = self.scene.is_some() || self.order.is_some() || self.rays.is_some();
        self.write && !self.test && !is_part
    }

    /// Why these options do not go together in such a build, if so: an option that does nothing would not be seen.
    pub(crate) fn refusal(&self, build: &str) -> Option<&'static str> {
        let scene = self.scene.as_deref();
        let is_of = |part| self.part == Some(part);
        if scene.is_some() && (is_of(Part::Tiers) || is_of(Part::Scales)) {
            return Some(
                "--scene: tiers and scales have scenes of their own; structures, cameras, surfaces, orders and calls take one",
            );
        }
        if scene == Some(SPREAD) && !is_of(Part::Orders) {
            return Some("--scene spread: orders alone measures it: say `orders --scene spread`");
        }
        if (self.order.is_some() || self.rays.is_some()) && !is_of(Part::Orders) {
            return Some("--order, --rays: orders alone takes them: say `orders`");
        }
        if self.writes() && build != "plain" && !is_of(Part::Tiers) {
            return Some(
                "--write: a native build has not every level, and would write pages without them: say `tiers --write`, or build without target-cpu",
            );
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_that_would_do_nothing_are_refused() {
        let refusal = |build, words: &str| {
            let words = ["report"].into_iter().chain(words.split_whitespace());
            Arguments::try_parse_from(words).expect("known options").refusal(build)
        };
        for (words, expected) in [
            ("tiers --scene u10k", "scenes of their own"),
            ("scales --scene one --quick", "scenes of their own"),
            ("structures --scene spread", "orders alone measures it"),
            ("--scene spread", "orders alone measures it"),
            ("calls --rays 64", "orders alone takes them"),
            ("--order beam", "orders alone takes them"),
        ] {
            let refusal = refusal("plain", words).expect(words);
            assert!(refusal.contains(expected), "{words}: {refusal}");
        }
        for words in ["", "--scene u10k", "orders --scene spread --rays 64", "tiers --quick"] {
            assert_eq!(refusal("plain", words), None, "{words}");
        }
    }

    /// Levels below the build's own have no rows there.
    #[test]
    fn a_native_build_writes_tiers_alone() {
        for (words, in_plain, in_native) in [
            ("--write", true, false),
            ("structures --write", true, false),
            ("tiers --write", true, true),
            ("structures --write --test", true, true),
            ("structures", true, true),
        ] {
            let words = ["report"].into_iter().chain(words.split_whitespace());
            let arguments = Arguments::try_parse_from(words).expect("known options");
            let is_taken = ["plain", "native"].map(|build| arguments.refusal(build).is_none());
            assert_eq!(is_taken, [in_plain, in_native]);
        }
    }
}
