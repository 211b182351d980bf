//! Contenders that are checked and made ready to be timed.

#[cfg(feature = "embree")]
use crate::embree::{Embree, Width};
use crate::rounds::Subject;
#[cfg(feature = "embree")]
use crate::scenes::Kind;
use crate::structures::agreement::Agreement;
use crate::structures::contender::{Contender, QUESTIONS};
use crate::structures::measured::subject;
use crate::structures::ours::{Answers, Rays, Search, Structures};
use crate::structures::peer::Ready;
use spherule_kernel::Hit;
#[cfg(feature = "embree")]
use spherule_kernel::Question;
use spherule_kernel::Ray;
use std::cell::RefCell;

/// Who is to be timed.
pub(super) struct Race<'a> {
    pub(super) structures: Structures<'a>,
    /// One for all of ours: the same memory, as warm for each.
    pub(super) answers: &'a RefCell<Answers>,
    pub(super) contenders: Vec<Contender>,
    pub(super) agreements: Vec<(Contender, Agreement)>,
    pub(super) subjects: Vec<Subject<'a>>,
}

impl<'a> Race<'a> {
    /// The kernel: `search`, for the nearest and for any.
    pub(super) fn ours(&mut self, search: Search, rays: &'a Rays) {
        let contender = Contender::Ours(search.way, search.tier, search.level.name());
        self.contenders.push(contender);
        let (structures, answers) = (self.structures, self.answers);
        for question in QUESTIONS {
            let search = Search { question, ..search };
            self.subjects.push(Subject::new(subject(contender, question), move || {
                search.run(structures, rays, &mut answers.borrow_mut());
                rays.count()
            }));
        }
    }

    /// Another tree, with rays in it, and what `Exact` says of them.
    pub(super) fn peer(
        &mut self,
        peer: &'a dyn Ready,
        name: &str,
        rays: &[Ray],
        truth: &[Option<Hit>],
    ) {
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
                std::hint::black_box(&hits);
                hits.len()
            }));
        }
    }

    /// Embree, in all widths.
    #[cfg(feature = "embree")]
    pub(super) fn embree(
        &mut self,
        embree: &'a Embree,
        name: &str,
        (kind, rays): (Kind, &'a [Ray]),
        truth: &[Option<Hit>],
    ) {
        let coherent = kind == Kind::Primary;
        for width in Width::ALL {
            let contender = Contender::Embree(width);
            let pass = move |question: Question| embree.pass(width, question, coherent, rays);
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
