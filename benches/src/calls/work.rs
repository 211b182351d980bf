//! The calls, on rays in every form.

use crate::engine::Query;
use crate::forms::{Answer, Forms};
use crate::rounds::timed;
use spherule_kernel::{
    Exact, HitColumns, Intersect, Level, Ray, RayColumns, RayPacket, SphereTree, Trace,
};

/// Rays of a short call: a group of packets.
pub(crate) const SHORT: usize = 64;

/// How rays are handed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Call {
    OneRay,
    Columns,
    /// Packets of so many rays together.
    PacketsOf(usize),
    /// Slices of so many rays.
    SlicesOf(usize),
}

impl Call {
    /// All packets in one call.
    pub(crate) const PACKETS: Self = Self::PacketsOf(usize::MAX);
    /// All rays in one slice.
    pub(crate) const SLICES: Self = Self::SlicesOf(usize::MAX);

    pub(crate) const ALL: [Self; 8] = [
        Self::OneRay,
        Self::PACKETS,
        Self::SLICES,
        Self::Columns,
        Self::PacketsOf(SHORT),
        Self::SlicesOf(1),
        Self::SlicesOf(8),
        Self::SlicesOf(SHORT),
    ];
}

/// What columns say of a ray that hits nothing: the bits of t, and the sphere.
const MISS: (u32, u32) = (f32::INFINITY.to_bits(), u32::MAX);

/// Rays in every form, and memory for their answers.
pub(super) struct Work<'a> {
    tree: &'a SphereTree,
    forms: Forms,
    columns: [Vec<f32>; 8],
    column_hits: (Vec<f32>, Vec<u32>),
}

impl<'a> Work<'a> {
    pub(super) fn new(tree: &'a SphereTree, rays: &[Ray]) -> Self {
        let row = |ray: &Ray| {
            let (o, d) = (ray.origin, ray.direction);
            [o.x, o.y, o.z, d.x, d.y, d.z, ray.t_min, ray.t_max]
        };
        let column = |place: usize| rays.iter().map(|ray| row(ray)[place]).collect();
        Self {
            tree,
            forms: Forms::new(rays.to_vec()),
            columns: std::array::from_fn(column),
            column_hits: (vec![0.0; rays.len()], vec![0; rays.len()]),
        }
    }

    /// Answers every ray. Returns how many nanoseconds it took.
    pub(super) fn run(&mut self, call: Call, level: Level, query: Query) -> f64 {
        let Self { tree, forms, columns, column_hits: (t, sphere) } = self;
        let Forms { rays, packets, hits, occluded, packet_hits, packets_occluded } = forms;
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
            (Call::Columns, query) => {
                let [ox, oy, oz, dx, dy, dz, t_min, t_max] = columns.each_ref().map(Vec::as_slice);
                let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
                let columns = RayColumns { origin, direction, t_min, t_max };
                timed(|| match query {
                    Query::ClosestHit => {
                        let found = HitColumns { t, sphere };
                        tree.closest_hit_columns(Exact, trace, columns, found);
                    }
                    Query::AnyHit => tree.any_hit_columns(Exact, trace, columns, occluded),
                })
            }
            // What one call learns would help the next: so each begins with a new `Trace`.
            (Call::PacketsOf(count), query) => timed(|| {
                let count = count / RayPacket::COUNT;
                let many = packets.chunks(count).zip(packet_hits.chunks_mut(count));
                for ((packets, hits), occluded) in many.zip(packets_occluded.chunks_mut(count)) {
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
    pub(super) fn forget(&mut self) {
        self.forms.forget();
        self.column_hits.0.fill(f32::NAN);
        self.column_hits.1.fill(u32::MAX);
    }

    /// What the last run of this call answered.
    pub(super) fn answers(&self, call: Call, query: Query) -> Vec<Answer> {
        match (call, query) {
            (Call::PacketsOf(_), query) => self.forms.of_packets(query),
            (Call::Columns, Query::ClosestHit) => {
                let (t, sphere) = &self.column_hits;
                let bits = t.iter().map(|t| t.to_bits()).zip(sphere.iter().copied());
                bits.map(|hit| (hit != MISS).then_some(hit)).collect()
            }
            (_, query) => self.forms.of_slices(query),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_tests::scenes::{Kind, Scene, Size};

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
                let forgotten = work.answers(call, query);
                work.run(call, Level::best(), query);
                [forgotten, work.answers(call, query)]
            };
            let [_, expected] = run(Call::PACKETS);
            for call in Call::ALL {
                let [forgotten, found] = run(call);
                assert!(found == expected && forgotten != expected, "{query:?}, {call:?}");
            }
        }
    }
}
