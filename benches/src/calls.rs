//! What a call costs: one ray a call beside Embree's, slices and columns beside packets; and spheres that move.

mod refit;

pub(crate) use self::refit::Refit;
use crate::agreement::{WithTruth, check};
use crate::builds::{EMBREE, Trees};
use crate::engine::kernel::{Kernel, levels};
use crate::engine::{EVERY_SECOND, Engine, Query, Rays};
use crate::measure::Effort;
use crate::rounds::{Median, Sampler, Samples, timed};
use spherule_kernel::{
    Exact, Hit, HitColumns, HitPacket, Intersect, Level, LevelName, Ray, RayColumns, RayPacket,
    SphereTree, Trace,
};
use spherule_tests::scenes::{Kind, LARGE, Scene, Size};
use std::cell::RefCell;
use std::time::Duration;

/// Embree's call of one ray, among its engines.
const ONE_RAY: &str = "1 rays a call";
/// Rays of a short call: a group of packets.
pub(crate) const SHORT: usize = 64;

/// How rays are handed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Call {
    OneRay,
    /// All packets in one call.
    Packets,
    Slices,
    Columns,
    /// Packets of [`SHORT`] rays.
    ShortPackets,
    /// Slices of so many rays.
    SlicesOf(usize),
}

impl Call {
    pub(crate) const ALL: [Self; 8] = [
        Self::OneRay,
        Self::Packets,
        Self::Slices,
        Self::Columns,
        Self::ShortPackets,
        Self::SlicesOf(1),
        Self::SlicesOf(8),
        Self::SlicesOf(SHORT),
    ];
}

/// What was timed: one of the kernel's calls, or Embree's call of one ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Timed {
    Ours(Call),
    Embree(usize),
}

/// The times of a scene's rays of one kind, for one query, at one level.
pub(crate) struct Row {
    pub(crate) scene: &'static str,
    pub(crate) kind: Kind,
    pub(crate) query: Query,
    pub(crate) level: LevelName,
    /// Nanoseconds a ray.
    times: Samples<Timed>,
}

/// All that was measured.
pub(crate) struct Calls {
    pub(crate) rows: Vec<Row>,
    pub(crate) refits: Vec<Refit>,
}

/// Measures all scenes, or `one` alone.
pub(crate) fn measure(effort: Effort, one: Option<&str>) -> Calls {
    let (size, rays, time, rounds) = match effort {
        Effort::Test => (Size::SMALL, 256, 0, 1),
        Effort::Quick => (Size::FULL, 1 << 13, 150, 5),
        Effort::Full => (Size::FULL, 1 << 14, 1000, 9),
    };
    let mut all = Calls { rows: Vec::new(), refits: Vec::new() };
    for name in LARGE.into_iter().filter(|name| one.is_none_or(|one| one == *name)) {
        eprintln!("calls, {name}");
        let scene = Scene::large(name, size).expect("listed");
        let levels = levels();
        let trees = Trees::build(&scene, false, &levels);
        let exact = Kernel::new(&scene, &trees.ours).truth();
        for kind in Kind::ALL {
            let some = WithTruth::new((&scene, kind), rays);
            for &level in &levels {
                let engines = trees.others.iter().filter(|engine| is_one_ray(engine, level));
                let engines: Vec<_> = engines.collect();
                for &engine in &engines {
                    let mut run = (engine.ready)(&some.rays);
                    check((&scene, engine), (&some, &some), &mut *run, &exact);
                }
                for query in Query::ALL {
                    let asked = (scene.name, kind, query, level);
                    let plan = (Duration::from_millis(time), rounds);
                    let row = Row::measure(asked, &trees.ours, &engines, &some.rays, plan);
                    all.rows.push(row);
                }
            }
        }
        all.refits.push(Refit::measure(&scene, rounds));
    }
    all
}

fn is_one_ray(engine: &Engine, level: Level) -> bool {
    let label = &engine.label;
    let is_embree = label.way.starts_with(EMBREE) && label.name == ONE_RAY;
    is_embree && label.lanes == level.name().as_str()
}

impl Row {
    /// # Panics
    /// If calls differ in a bit.
    fn measure(
        (scene, kind, query, level): (&'static str, Kind, Query, Level),
        tree: &SphereTree,
        embree: &[&Engine],
        rays: &Rays,
        (time, rounds): (Duration, usize),
    ) -> Self {
        let work = RefCell::new(Work::new(tree, &rays.list));
        let count = rays.list.len() as f64;
        let run = |call| {
            let mut work = work.borrow_mut();
            work.forget();
            work.run(call, level, query);
            work.answers(query)
        };
        let expected = run(Call::Packets);
        for call in Call::ALL {
            let is_same = run(call) == expected;
            assert!(is_same, "{scene}, {kind:?}, {query:?}, {level:?}: {call:?}");
        }
        let mut samplers = Vec::<(_, Sampler<'_>)>::new();
        for call in Call::ALL {
            let work = &work;
            let sample = move || work.borrow_mut().run(call, level, query) / count;
            samplers.push((Timed::Ours(call), Box::new(sample)));
        }
        for (index, engine) in embree.iter().enumerate() {
            let mut run = (engine.ready)(rays);
            let sample = move || run.time(query, 1) / count;
            samplers.push((Timed::Embree(index), Box::new(sample)));
        }
        let times = Samples::take(samplers, time, rounds..=8 * rounds);
        Self { scene, kind, query, level: level.name(), times }
    }

    /// Million rays a second.
    pub(crate) fn rate(&self, call: Call) -> Option<f64> {
        Some(1e3 / self.times.median(&Timed::Ours(call))?.middle)
    }

    /// How many times as fast `call` is as `other`.
    pub(crate) fn ratio(&self, call: Call, other: Call) -> Option<Median> {
        self.times.ratio(&Timed::Ours(other), &Timed::Ours(call))
    }

    /// How many times as fast one ray a call is as Embree's call of one ray, in its quicker version.
    pub(crate) fn by_embree(&self) -> Option<Median> {
        let time = |timed: &&Timed| self.times.median(timed).map_or(f64::INFINITY, |it| it.middle);
        let all = self.times.names.iter().filter(|timed| matches!(timed, Timed::Embree(_)));
        let quicker = all.min_by(|a, b| time(a).total_cmp(&time(b)))?;
        self.times.ratio(quicker, &Timed::Ours(Call::OneRay))
    }

    pub(crate) fn rounds(&self) -> usize {
        self.times.rounds()
    }
}

/// Rays in every form, and memory for their answers.
struct Work<'a> {
    tree: &'a SphereTree,
    rays: &'a [Ray],
    packets: Vec<RayPacket>,
    columns: [Vec<f32>; 8],
    hits: Vec<Option<Hit>>,
    occluded: Vec<bool>,
    packet_hits: Vec<HitPacket>,
    packets_occluded: Vec<u32>,
    column_hits: (Vec<f32>, Vec<u32>),
    last: Call,
}

impl<'a> Work<'a> {
    fn new(tree: &'a SphereTree, rays: &'a [Ray]) -> Self {
        let (count, packets) = (rays.len(), rays.len().div_ceil(RayPacket::COUNT));
        let column = |of: fn(&Ray) -> f32| rays.iter().map(of).collect();
        Self {
            tree,
            rays,
            packets: rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect(),
            columns: [
                column(|ray| ray.origin.x),
                column(|ray| ray.origin.y),
                column(|ray| ray.origin.z),
                column(|ray| ray.direction.x),
                column(|ray| ray.direction.y),
                column(|ray| ray.direction.z),
                column(|ray| ray.t_min),
                column(|ray| ray.t_max),
            ],
            hits: vec![None; count],
            occluded: vec![false; count],
            packet_hits: vec![HitPacket::none(); packets],
            packets_occluded: vec![0; packets],
            column_hits: (vec![0.0; count], vec![0; count]),
            last: Call::Packets,
        }
    }

    /// Answers every ray. Returns how many nanoseconds it took.
    fn run(&mut self, call: Call, level: Level, query: Query) -> f64 {
        self.last = call;
        let Self { tree, rays, packets, hits, occluded, packet_hits, packets_occluded, .. } = self;
        let mut trace = Trace::new().at(level);
        let trace = &mut trace;
        match (call, query) {
            (Call::OneRay, Query::ClosestHit) => timed(|| {
                for (ray, hit) in rays.iter().zip(hits) {
                    *hit = tree.closest_hit_with(Exact, trace, ray);
                }
            }),
            (Call::OneRay, Query::AnyHit) => timed(|| {
                for (ray, occluded) in rays.iter().zip(occluded) {
                    *occluded = tree.any_hit_with(Exact, trace, ray);
                }
            }),
            (Call::Packets, Query::ClosestHit) => {
                timed(|| tree.closest_hit_packets(Exact, trace, packets, packet_hits))
            }
            (Call::Packets, Query::AnyHit) => {
                timed(|| tree.any_hit_packets(Exact, trace, packets, packets_occluded))
            }
            (Call::Slices, Query::ClosestHit) => {
                timed(|| tree.closest_hits_with(Exact, trace, rays, hits))
            }
            (Call::Slices, Query::AnyHit) => {
                timed(|| tree.any_hits_with(Exact, trace, rays, occluded))
            }
            (Call::Columns, query) => {
                let [ox, oy, oz, dx, dy, dz, t_min, t_max] =
                    self.columns.each_ref().map(Vec::as_slice);
                let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
                let columns = RayColumns { origin, direction, t_min, t_max };
                let (t, sphere) = &mut self.column_hits;
                timed(|| match query {
                    Query::ClosestHit => {
                        let found = HitColumns { t, sphere };
                        tree.closest_hit_columns(Exact, trace, columns, found);
                    }
                    Query::AnyHit => tree.any_hit_columns(Exact, trace, columns, occluded),
                })
            }
            // What one call learns would help the next: so each begins with a new `Trace`.
            (Call::ShortPackets, query) => timed(|| {
                let many = packets.chunks(SHORT / RayPacket::COUNT);
                let hits = packet_hits.chunks_mut(SHORT / RayPacket::COUNT);
                let occluded = packets_occluded.chunks_mut(SHORT / RayPacket::COUNT);
                for ((packets, hits), occluded) in many.zip(hits).zip(occluded) {
                    let trace = &mut Trace::new().at(level);
                    match query {
                        Query::ClosestHit => tree.closest_hit_packets(Exact, trace, packets, hits),
                        Query::AnyHit => tree.any_hit_packets(Exact, trace, packets, occluded),
                    }
                }
            }),
            (Call::SlicesOf(count), query) => timed(|| {
                let many = rays.chunks(count).zip(hits.chunks_mut(count));
                for ((rays, hits), occluded) in many.zip(occluded.chunks_mut(count)) {
                    let trace = &mut Trace::new().at(level);
                    match query {
                        Query::ClosestHit => tree.closest_hits_with(Exact, trace, rays, hits),
                        Query::AnyHit => tree.any_hits_with(Exact, trace, rays, occluded),
                    }
                }
            }),
        }
    }

    /// Overwrites the answers with wrong ones, so that a run that writes none is seen.
    fn forget(&mut self) {
        self.hits.fill(Some(Hit { t: f32::NAN, sphere: u32::MAX }));
        self.occluded.iter_mut().enumerate().for_each(|(ray, hit)| *hit = ray % 2 == 0);
        self.packet_hits.fill(HitPacket::none());
        self.packets_occluded.fill(EVERY_SECOND);
        self.column_hits.0.fill(f32::NAN);
        self.column_hits.1.fill(u32::MAX);
    }

    /// The answers of the last run, one a ray: the bits of t and the sphere; for any hit, whether there is one.
    fn answers(&self, query: Query) -> Vec<(u32, u32)> {
        const NONE: (u32, u32) = (f32::INFINITY.to_bits(), u32::MAX);
        let bits = |hit: Option<Hit>| hit.map_or(NONE, |hit| (hit.t.to_bits(), hit.sphere));
        let is_packed = matches!(self.last, Call::Packets | Call::ShortPackets);
        let answer = |ray: usize| {
            let (packet, lane) = (ray / RayPacket::COUNT, ray % RayPacket::COUNT);
            match (query, self.last) {
                (Query::AnyHit, _) if is_packed => (self.packets_occluded[packet] >> lane & 1, 0),
                (Query::AnyHit, _) => (u32::from(self.occluded[ray]), 0),
                (_, Call::Columns) => (self.column_hits.0[ray].to_bits(), self.column_hits.1[ray]),
                _ if is_packed => bits(self.packet_hits[packet].hit(lane)),
                _ => bits(self.hits[ray]),
            }
        };
        (0..self.rays.len()).map(answer).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls leave their answers where others look for theirs.
    #[test]
    fn a_call_that_writes_nothing_is_seen() {
        let scene = Scene::large("u64", Size::SMALL).expect("listed");
        let tree = scene.tree();
        for query in Query::ALL {
            let mut work = Work::new(&tree, scene.rays(Kind::Primary));
            let mut run = |call| {
                work.forget();
                // As if it had run.
                work.last = call;
                let forgotten = work.answers(query);
                work.run(call, Level::best(), query);
                [forgotten, work.answers(query)]
            };
            let [_, expected] = run(Call::Packets);
            for call in Call::ALL {
                let [forgotten, found] = run(call);
                assert!(found == expected && forgotten != expected, "{query:?}, {call:?}");
            }
        }
    }
}
