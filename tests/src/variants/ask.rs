//! What the rays of a test hit, by a row of the table.

use super::answers::Answers;
use super::memory::Structures;
use super::packing::{columns_of, level, packed, stale_packet, unpacked};
use super::table::{Layer, Structure, Variant};
use spherule_kernel::{
    DepthList, Hit, HitColumns, Intersect, Lanes, QueuedRay, Ray, RayColumns, Sphere, SphereList,
    SphereTree, StreamMemory, StreamRay, Trace, f32x4, f32x8, f32x16,
};

impl Variant {
    /// What these rays hit.
    ///
    /// # Panics
    /// Where the structure does not [hold](Variant::holds) the spheres.
    #[must_use]
    pub fn ask(&self, structures: Structures<'_>, rays: &[Ray]) -> Answers {
        let Structures { list, depth_list, tree, refitted, bvh4 } = structures;
        match self.structure {
            Structure::List => self.ask_list(list, rays),
            Structure::DepthList(sevenths) => {
                let words = DepthList::scratch(list.spheres().len()) * sevenths / 7;
                let mut scratch = vec![f32::NAN; words];
                self.ask_of(depth_list, &mut Trace::new().with_scratch(&mut scratch), rays)
            }
            Structure::Tree(coherence) => {
                self.ask_tree(tree, &mut Trace::new().with(coherence), rays)
            }
            Structure::Refitted(coherence) => {
                self.ask_tree(refitted, &mut Trace::new().with(coherence), rays)
            }
            Structure::Stream(count) => {
                // More than there are rays is never used. A count above a hundred stays above it.
                let count = count.min(rays.len().next_multiple_of(16).max(112));
                // The least memory that a few rays need; for more rays, as much as queues like to
                // have.
                let needed = StreamMemory::queues_needed(count);
                let queues = if count < 100 { needed } else { needed + 32 * count };
                let mut queues = vec![QueuedRay::EMPTY; queues];
                let mut memory = vec![StreamRay::EMPTY; count];
                let memory = StreamMemory::new(&mut memory, &mut queues).expect("enough");
                let mut trace = Trace::new().incoherent().with_stream(memory.everywhere());
                self.ask_tree(tree, &mut trace, rays)
            }
            Structure::Bvh4 => {
                self.ask_of(&bvh4.expect("no more spheres than it holds"), &mut Trace::new(), rays)
            }
        }
    }

    /// What these rays hit in a tree, whatever the structure. `trace` keeps what it learns.
    #[must_use]
    pub fn ask_tree(&self, tree: &SphereTree, trace: &mut Trace<'_>, rays: &[Ray]) -> Answers {
        self.ask_of(tree, trace, rays)
    }

    /// The closest hits in a list, whatever the structure.
    ///
    /// # Panics
    /// If a ray that hits anything has no closest hit, or the reverse.
    #[must_use]
    pub fn closest(&self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Hit>> {
        let Answers { hits, occluded } = self.ask_list(&SphereList::from(spheres), rays);
        assert!(
            hits.iter().map(Option::is_some).eq(occluded),
            "{self:?}: closest hits and any hits"
        );
        hits
    }

    fn ask_list(&self, list: &SphereList, rays: &[Ray]) -> Answers {
        match self.layer {
            Layer::Lanes(4) => self.lanes::<_, f32x4>(list, &mut Trace::new(), rays),
            Layer::Lanes(16) => self.lanes::<_, f32x16>(list, &mut Trace::new(), rays),
            _ => self.ask_of(list, &mut Trace::new(), rays),
        }
    }

    fn ask_of(&self, structure: &impl Intersect, trace: &mut Trace<'_>, rays: &[Ray]) -> Answers {
        let tier = self.tier;
        // Old contents must not show, and nothing past the rays may be touched.
        let stale = Some(Hit { t: -7.0, sphere: 7 });
        let mut hits = vec![stale; rays.len() + 1];
        let mut occluded: Vec<bool> = (0..=rays.len()).map(|i| i % 3 == 0).collect();
        let past = occluded[rays.len()];
        match self.layer {
            Layer::Ray => {
                for (index, ray) in rays.iter().enumerate() {
                    hits[index] = structure.closest_hit(tier, ray);
                    occluded[index] = structure.any_hit(tier, ray);
                }
            }
            Layer::Slice => {
                structure.closest_hits(tier, rays, &mut hits);
                structure.any_hits(tier, rays, &mut occluded);
            }
            Layer::Columns => {
                let table = columns_of(rays);
                let [ox, oy, oz, dx, dy, dz, t_min, t_max] = table.each_ref().map(Vec::as_slice);
                let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
                let columns = RayColumns { origin, direction, t_min, t_max };
                let (mut t, mut sphere) = (vec![-7.0; rays.len() + 2], vec![7; rays.len() + 1]);
                let found = HitColumns { t: &mut t, sphere: &mut sphere };
                structure.closest_hit_columns(tier, trace, columns, found);
                structure.any_hit_columns(tier, trace, columns, &mut occluded);
                let none = |t: f32, sphere: u32| sphere == u32::MAX && t == f32::INFINITY;
                let hit = |(&t, &sphere)| (!none(t, sphere)).then_some(Hit { t, sphere });
                hits = t.iter().zip(&sphere).map(hit).collect();
                assert_eq!(t.last(), Some(&-7.0), "{self:?}: past the rays");
            }
            Layer::SliceAt(name) => {
                trace.level = level(name);
                structure.closest_hits_with(tier, trace, rays, &mut hits);
                structure.any_hits_with(tier, trace, rays, &mut occluded);
            }
            Layer::Packets(name) => {
                trace.level = level(name);
                let packets = packed(rays);
                let mut found = vec![stale_packet::<f32x16>(); packets.len() + 1];
                let mut bits = vec![u32::MAX; packets.len() + 1];
                structure.closest_hit_packets(tier, trace, &packets, &mut found);
                structure.any_hit_packets(tier, trace, &packets, &mut bits);
                return unpacked::<f32x16>(rays.len(), &found, &bits);
            }
            Layer::Lanes(1) => return self.lanes::<_, f32>(structure, trace, rays),
            Layer::Lanes(_) => return self.lanes::<_, f32x8>(structure, trace, rays),
        }
        assert_eq!(
            (hits.pop(), occluded.pop()),
            (Some(stale), Some(past)),
            "{self:?}: past the rays"
        );
        Answers { hits, occluded }
    }

    fn lanes<S: Intersect, L: Lanes<Token = ()>>(
        &self,
        structure: &S,
        trace: &mut Trace<'_>,
        rays: &[Ray],
    ) -> Answers {
        let packets = packed(rays);
        let mut found = vec![stale_packet::<L>(); packets.len() + 1];
        let mut bits = vec![u32::MAX; packets.len() + 1];
        structure.closest_hit_lanes::<L>(self.tier, (), trace, &packets, &mut found);
        structure.any_hit_lanes::<L>(self.tier, (), trace, &packets, &mut bits);
        unpacked::<L>(rays.len(), &found, &bits)
    }
}
