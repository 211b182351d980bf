//! The times of a scene: every contender checked, then all in turns.

#[cfg(feature = "embree")]
use crate::embree::{Embree, Width};
use crate::rounds::{self, Median, Samples, Subject};
use crate::scenes::{Kind, Scene};
use crate::structures::agreement::{self, Agreement};
use crate::structures::contender::{Contender, Tier, Way, question_name};
use crate::structures::ours::{Answers, Rays, Search, Structures, TreeMemory, bytes, sample};
use crate::structures::peer::{Builder, Ready};
use spherule_kernel::dispatch::Level;
use spherule_kernel::{Hit, Question, Ray};
use std::cell::RefCell;

/// Tests of brute force that a round may cost.
const TESTS: usize = 1 << 26;
/// Rays of single-ray peers: enough for a time.
const PEER_RAYS: usize = 1 << 15;
/// What is asked.
pub const QUESTIONS: [Question; 2] = [Question::Nearest, Question::Any];

/// Times of a scene's rays of a kind.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The scene.
    pub scene: &'static str,
    /// Which rays.
    pub kind: Kind,
    /// How many spheres.
    pub spheres: usize,
    /// How many rays; brute force gets fewer of them where it is slow.
    pub rays: usize,
    /// Who took part.
    pub contenders: Vec<Contender>,
    /// How the peers' answers were.
    pub agreements: Vec<(Contender, Agreement)>,
    samples: Samples,
}

/// What a scene's tree is like.
#[derive(Clone, Copy, Debug)]
pub struct Tree {
    /// Bytes a sphere, beyond the caller's list.
    pub bytes: f64,
    /// Nodes below each other.
    pub depth: usize,
}

fn subject(contender: Contender, question: Question) -> String {
    format!("{}, {contender}", question_name(question))
}

impl Measured {
    /// A million rays a second.
    #[must_use]
    pub fn rate(&self, contender: Contender, question: Question) -> f64 {
        1e3 / self.samples.median(&subject(contender, question)).middle
    }

    /// How many times as fast a contender is as another, round by round.
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
        let rate = |contender: &Contender| self.rate(*contender, question);
        let all = self.contenders.iter().copied().filter(|&contender| chosen(contender));
        all.max_by(|a, b| rate(a).total_cmp(&rate(b)))
    }
}

/// Times both kinds of a scene's rays.
///
/// # Panics
/// Where an answer is wrong.
#[must_use]
pub fn scene(
    scene: &Scene,
    levels: &[Level],
    builders: &[Builder],
    rounds: usize,
) -> (Tree, Vec<Measured>) {
    let spheres = scene.spheres.spheres();
    let mut memory = TreeMemory::new(spheres.len());
    let bvh = memory.build(spheres);
    let tree = Tree { bytes: bytes(&bvh) as f64 / spheres.len().max(1) as f64, depth: bvh.depth() };
    let structures = Structures { spheres, bvh: &bvh };
    let mut peers: Vec<_> = builders.iter().map(|builder| builder(spheres)).collect();
    #[cfg(feature = "embree")]
    let embree = Embree::build(spheres);
    let measured = Kind::ALL.map(|kind| {
        let list = scene.rays(kind);
        let few = &sample(list, TESTS / spheres.len().max(1));
        let (all, few) = (Rays::new(list), Rays::new(few));
        let answers = RefCell::new(Answers::new(all.count()));
        let mut race = Race {
            structures,
            contenders: Vec::new(),
            agreements: Vec::new(),
            subjects: Vec::new(),
        };
        for &level in levels {
            agreement::ours(scene.name, list, level, structures);
            for (way, rays) in [(Way::Brute, &few), (Way::Single, &all), (Way::Coherent, &all)] {
                for tier in Tier::ALL {
                    race.ours(way, tier, level, rays, &answers);
                }
            }
        }
        let exact = Search {
            question: Question::Nearest,
            way: Way::Single,
            tier: Tier::Exact,
            level: levels[0],
        };
        let truth = |rays: &[Ray]| {
            let rays = Rays::new(rays);
            let mut answers = Answers::new(rays.count());
            exact.run(structures, &rays, &mut answers);
            answers.nearest()
        };
        let name = format!("{}, {}", scene.name, kind.as_str());
        let some = sample(list, PEER_RAYS);
        let truth_of_some = truth(&some);
        for peer in &mut peers {
            peer.take_rays(&some);
            race.peer(&**peer, &name, &some, &truth_of_some);
        }
        #[cfg(feature = "embree")]
        race.embree(&embree, &name, list, kind, &truth(list));
        let samples = rounds::take(&mut race.subjects, rounds);
        Measured {
            scene: scene.name,
            kind,
            spheres: spheres.len(),
            rays: list.len(),
            contenders: race.contenders,
            agreements: race.agreements,
            samples,
        }
    });
    (tree, measured.into())
}

/// Contenders that are made ready.
struct Race<'a> {
    structures: Structures<'a>,
    contenders: Vec<Contender>,
    agreements: Vec<(Contender, Agreement)>,
    subjects: Vec<Subject<'a>>,
}

impl<'a> Race<'a> {
    fn ours(
        &mut self,
        way: Way,
        tier: Tier,
        level: Level,
        rays: &'a Rays,
        answers: &'a RefCell<Answers>,
    ) {
        let contender = Contender::Ours(way, tier, level.name());
        self.contenders.push(contender);
        let structures = self.structures;
        for question in QUESTIONS {
            let search = Search { question, way, tier, level };
            self.subjects.push(Subject::new(subject(contender, question), move || {
                search.run(structures, rays, &mut answers.borrow_mut());
                rays.count()
            }));
        }
    }

    fn peer(&mut self, peer: &'a dyn Ready, name: &str, rays: &[Ray], truth: &[Option<Hit>]) {
        let contender = Contender::Peer(peer.name());
        let mut hits = vec![None; rays.len()];
        let [nearest, any] = QUESTIONS.map(|question| {
            peer.pass(question, &mut hits);
            hits.clone()
        });
        let agreement = Agreement::of(rays, self.structures.spheres, truth, &nearest, &any);
        // Some clamp directions that are nearly along an axis.
        let agreement = agreement.within(1e-3, &format!("{name}, {contender}"));
        self.contenders.push(contender);
        self.agreements.push((contender, agreement));
        for question in QUESTIONS {
            let mut hits = hits.clone();
            self.subjects.push(Subject::new(subject(contender, question), move || {
                peer.pass(question, &mut hits);
                hits.len()
            }));
        }
    }

    #[cfg(feature = "embree")]
    fn embree(
        &mut self,
        embree: &'a Embree,
        name: &str,
        rays: &'a [Ray],
        kind: Kind,
        truth: &[Option<Hit>],
    ) {
        for width in Width::ALL {
            let contender = Contender::Embree(width);
            let pass = move |question| embree.pass(width, question, kind == Kind::Primary, rays);
            let [nearest, any] = QUESTIONS.map(|question| pass(question).hits);
            let agreement = Agreement::of(rays, self.structures.spheres, truth, &nearest, &any);
            let agreement = agreement.within(0.0, &format!("{name}, {contender}"));
            self.contenders.push(contender);
            self.agreements.push((contender, agreement));
            for question in QUESTIONS {
                let sample = move || pass(question).nanoseconds as f64 / rays.len() as f64;
                self.subjects.push(Subject::timing_itself(subject(contender, question), sample));
            }
        }
    }
}
