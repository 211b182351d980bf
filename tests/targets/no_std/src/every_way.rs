//! Takes every public way through the kernel, and makes a digest of the answers.

use core::hint::black_box;
#[cfg(feature = "structures")]
use spherule_kernel::{
    Bvh, BvhMemory, BvhNode, DepthList, Projection, QueuedRay, StreamMemory, StreamRay, Viewpoint,
};
use spherule_kernel::{
    Bvh4, Camera, CameraTiles, Hit, HitColumns, HitPacket, Intersect, Lanes, Ray, RayColumns,
    RayPacket, Side, Sphere, SpherePacket, Spheres, Tier, Trace, f32x4, object_lanes, pair_lanes,
    pairs, side, surface,
};
#[cfg(feature = "vectors")]
use spherule_kernel::{
    Level, SurfacePacket, Towards, Vec3, f32x8, f32x16, object_packets, pair_packets,
    shadow_packets, surface_packets,
};

/// A digest of answers.
pub(super) struct Sum(u32);

impl Sum {
    pub(super) const NONE: Self = Self(0);

    pub(super) fn words(&self) -> u32 {
        self.0
    }

    pub(super) fn word(&mut self, word: u32) {
        self.0 = self.0.rotate_left(1) ^ word;
    }

    fn bits(&mut self, words: impl IntoIterator<Item = impl Into<u32>>) {
        words.into_iter().for_each(|word| self.word(word.into()));
    }

    fn hits(&mut self, hits: impl IntoIterator<Item = Option<Hit>>) {
        for hit in hits {
            self.word(hit.map_or(0, |hit| hit.t.to_bits() ^ hit.sphere));
        }
    }

    /// Traces a list and a tree in vectors of four lanes.
    pub(super) fn four_lanes(&mut self, tier: Tier, camera: &Camera, spheres: Spheres<'_>) {
        self.lanes::<f32x4>(tier, camera, &mut Trace::new(), &spheres);
        #[cfg(feature = "structures")]
        {
            let mut nodes = [BvhNode::EMPTY; 4];
            let (mut places, mut indices) = ([[0.0; 4]; 120], [0; 120]);
            let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
            if let Ok(tree) = memory.build(spheres) {
                for mut trace in [Trace::new().coherent(), Trace::new().incoherent()] {
                    self.lanes::<f32x4>(tier, camera, &mut trace, &tree);
                }
            }
            let growth = memory.refit(spheres).map_or(0.0, |tree| tree.growth());
            self.word(growth.to_bits());
        }
    }

    /// Computes a normal and spawns rays.
    pub(super) fn surface(&mut self, tier: Tier, ray: &Ray, spheres: Spheres<'_>) {
        let Some(hit) = spheres.closest_hit(tier, ray) else { return };
        let Some(sphere) = spheres.get(hit.sphere as usize) else { return };
        let surface = surface(tier, ray, hit.t, &sphere);
        self.bits(surface.normal.to_array().map(f32::to_bits));
        let outside = surface.spawn_ray(tier, &sphere, Side::Outside, ray.origin);
        let inside = surface.spawn_ray_to(tier, &sphere, Side::Inside, ray.origin);
        for ray in [outside, inside].into_iter().flatten() {
            self.word(u32::from(side(ray.origin, &sphere) == Some(Side::Outside)));
            self.bits(ray.origin.to_array().map(f32::to_bits));
        }
    }

    /// Computes normals and points in packets, and spawns rays.
    #[cfg(feature = "vectors")]
    pub(super) fn surfaces(&mut self, tier: Tier, rays: &[Ray; 20], spheres: Spheres<'_>) {
        let packets = [RayPacket::new(rays)];
        let mut hits = [HitPacket::none()];
        spheres.closest_hit_packets(tier, &mut Trace::new(), &packets, &mut hits);
        let mut surfaces = [SurfacePacket::none()];
        surface_packets(tier, Level::best(), spheres, &packets, &hits, &mut surfaces);
        for lane in 0..16 {
            let (normal, point) = (surfaces[0].normal(lane), surfaces[0].point(lane));
            self.bits(normal.to_array().map(f32::to_bits));
            self.bits(point.to_array().map(f32::to_bits));
        }
        let hit = (&packets as &[_], &hits as &[_], &surfaces as &[_]);
        let mut shadow_rays = [RayPacket::inactive()];
        for towards in [Towards::Direction(Vec3::Y), Towards::Point(Vec3::ONE)] {
            shadow_packets(tier, Level::best(), spheres, hit, towards, &mut shadow_rays);
            self.bits(shadow_rays[0].ray(1).origin.to_array().map(f32::to_bits));
        }
    }

    /// Traces the depth list and the tree.
    #[cfg(feature = "structures")]
    pub(super) fn structures(
        &mut self,
        tier: Tier,
        camera: &Camera,
        rays: &[Ray; 20],
        spheres: Spheres<'_>,
    ) {
        // More memory than most lists of spheres need; too little memory is an input, too.
        let (mut words, mut scratch) = ([0.0; 1024], [0.0; 1000]);
        let (mut nodes, mut places, mut indices) = ([BvhNode::EMPTY; 4], [[0.0; 4]; 120], [0; 120]);
        let (mut stream_rays, mut queues) = ([StreamRay::EMPTY; 16], [QueuedRay::EMPTY; 280]);
        let viewpoint = match camera.projection {
            Projection::Perspective { eye } => Viewpoint::Origin(eye),
            Projection::Parallel { direction } => Viewpoint::Direction(direction),
        };
        match DepthList::sort(spheres, viewpoint, &mut words) {
            Ok(depth_list) => self.structure(tier, camera, rays, &mut scratch, &depth_list),
            Err(error) => self.word(error.needed as u32),
        }
        match Bvh::build(spheres, &mut nodes, &mut places, &mut indices) {
            Ok(tree) => {
                self.structure(tier, camera, rays, &mut [], &tree);
                match StreamMemory::new(&mut stream_rays, &mut queues) {
                    Ok(memory) => {
                        let mut trace = Trace::new().incoherent().with_stream(memory.everywhere());
                        self.lanes::<f32>(tier, camera, &mut trace, &tree);
                    }
                    Err(error) => self.word(error.needed as u32),
                }
                self.word((tree.depth() + tree.size().nodes) as u32);
            }
            Err(error) => self.word(error.needed as u32),
        }
    }

    /// Traces the tree of one lane: a built one, and one loaded from arbitrary words.
    pub(super) fn bvh4(
        &mut self,
        tier: Tier,
        camera: &Camera,
        rays: &[Ray; 20],
        spheres: Spheres<'_>,
    ) {
        let mut words = [0; 1024];
        match Bvh4::build(spheres, &mut words) {
            Ok(tree) => self.bits(tree.words().iter().copied()),
            Err(error) => self.word(error.needed as u32),
        }
        match Bvh4::load(spheres, black_box(&words)) {
            Ok(tree) => self.structure(tier, camera, rays, &mut [], &tree),
            Err(error) => self.word(error as u32),
        }
    }

    /// Calls every layer of the door.
    pub(super) fn structure(
        &mut self,
        tier: Tier,
        camera: &Camera,
        rays: &[Ray; 20],
        scratch: &mut [f32],
        structure: &impl Intersect,
    ) {
        let (mut hits, mut occluded) = ([None; 20], [false; 20]);
        self.hits([structure.closest_hit(tier, &rays[0])]);
        self.word(u32::from(structure.any_hit(tier, &rays[0])));
        structure.closest_hits(tier, rays, &mut hits);
        self.hits(hits);
        structure.any_hits(tier, rays, &mut occluded);
        self.bits(occluded);
        let mut numbers = [[0.0; 20]; 8];
        for (place, ray) in rays.iter().take(20).enumerate() {
            let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
            let row = [ox, oy, oz, dx, dy, dz, ray.t_min, ray.t_max];
            for (column, number) in numbers.iter_mut().zip(row) {
                if let Some(at) = column.get_mut(place) {
                    *at = number;
                }
            }
        }
        let (mut t, mut spheres) = ([0.0; 20], [0; 20]);
        for trace in [Trace::new().coherent(), Trace::new().incoherent()] {
            let mut trace = trace.with_scratch(&mut *scratch);
            // Columns of any length.
            let [ox, oy, oz, dx, dy, dz, t_min, t_max] =
                numbers.each_ref().map(|column| black_box(column.as_slice()));
            let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
            let columns = RayColumns { origin, direction, t_min, t_max };
            let found = HitColumns {
                t: black_box(t.as_mut_slice()),
                sphere: black_box(spheres.as_mut_slice()),
            };
            structure.closest_hit_columns(tier, &mut trace, columns, found);
            self.bits(t.map(f32::to_bits));
            self.bits(spheres);
            structure.any_hit_columns(
                tier,
                &mut trace,
                columns,
                black_box(occluded.as_mut_slice()),
            );
            self.bits(occluded);
            structure.closest_hits_with(tier, &mut trace, rays, &mut hits);
            self.hits(hits);
            structure.any_hits_with(tier, &mut trace, rays, &mut occluded);
            self.bits(occluded);
            let packets = [camera.packet(0, 0, 8, 8), camera.packet(4, 4, 8, 8)];
            let (mut hits, mut occluded) = ([HitPacket::none(); 2], [0; 2]);
            structure.closest_hit_packets(tier, &mut trace, &packets, &mut hits);
            self.hits(hits.iter().flat_map(HitPacket::hits));
            structure.any_hit_packets(tier, &mut trace, &packets, &mut occluded);
            self.bits(occluded);
            let (mut made, corners) = ([RayPacket::inactive(); 2], [(0, 0), (4, 4)]);
            let tiles = CameraTiles { camera: *camera, size: black_box((8, 8)), corners: &corners };
            structure.closest_hit_tiles(tier, &mut trace, tiles, &mut made, &mut hits);
            self.hits(hits.iter().flat_map(HitPacket::hits));
            // The source is the same in every width: the other widths trace a list below.
            self.lanes::<f32>(tier, camera, &mut trace, structure);
            #[cfg(feature = "vectors")]
            self.lanes::<f32x8>(tier, camera, &mut trace, structure);
        }
    }

    pub(super) fn lanes<L: Lanes<Token = ()>>(
        &mut self,
        tier: Tier,
        camera: &Camera,
        trace: &mut Trace<'_>,
        structure: &impl Intersect,
    ) {
        let mut rays: [RayPacket<L::Array>; 2] =
            [camera.packet(0, 0, 8, 8), camera.packet(4, 4, 8, 8)];
        rays[1].set(1, &camera.get_ray(7, 7));
        rays[0].set(0, &rays[1].ray(L::COUNT - 1));
        let (mut hits, mut occluded) = ([HitPacket::none(); 2], [0; 2]);
        structure.closest_hit_lanes::<L>(tier, (), trace, &rays, &mut hits);
        self.hits(hits.iter().flat_map(HitPacket::hits));
        structure.any_hit_lanes::<L>(tier, (), trace, &rays, &mut occluded);
        self.bits(occluded);
        // A picture of any size, with too few packets for it.
        let size: (u32, u32) = black_box((8, 8));
        let mut corners = [(0, 0); 4];
        let in_order = Camera::tile_corners::<L::Array>(size.0, size.1);
        corners.iter_mut().zip(in_order).for_each(|(corner, next)| *corner = next);
        let tiles = CameraTiles { camera: *camera, size, corners: &corners };
        structure.closest_hit_tile_lanes::<L>(tier, (), trace, tiles, &mut rays, &mut hits);
        self.hits(hits.iter().flat_map(HitPacket::hits));
    }

    pub(super) fn pairs(&mut self, tier: Tier, rays: &[Ray; 20], sphere: &Sphere) {
        let mut hits = [None; 20];
        pairs(tier, rays, &[*sphere; 20], &mut hits);
        self.hits(hits);
        self.pair_lanes::<f32>(tier, rays, sphere);
        #[cfg(feature = "vectors")]
        {
            let mut hits = [HitPacket::none()];
            let packets = ([RayPacket::new(rays)], [SpherePacket::new(&[*sphere; 16])]);
            pair_packets(tier, Level::best(), &packets.0, &packets.1, &mut hits);
            self.hits(hits[0].hits());
            self.pair_lanes::<f32x4>(tier, rays, sphere);
            self.pair_lanes::<f32x8>(tier, rays, sphere);
            self.pair_lanes::<f32x16>(tier, rays, sphere);
        }
    }

    pub(super) fn objects(&mut self, tier: Tier, rays: &[Ray; 20], spheres: Spheres<'_>) {
        self.object_lanes::<f32>(tier, rays, spheres);
        #[cfg(feature = "vectors")]
        {
            let (packets, mut hits) = ([RayPacket::new(rays)], [HitPacket::none()]);
            let level = Level::best();
            let writes = object_packets(tier, level, spheres, 1, &[0, 1], &packets, &mut hits);
            self.word((writes.stored + writes.overwritten) as u32);
            self.hits(hits[0].hits());
            self.object_lanes::<f32x4>(tier, rays, spheres);
            self.object_lanes::<f32x8>(tier, rays, spheres);
            self.object_lanes::<f32x16>(tier, rays, spheres);
        }
    }

    fn object_lanes<L: Lanes<Token = ()>>(
        &mut self,
        tier: Tier,
        rays: &[Ray; 20],
        spheres: Spheres<'_>,
    ) {
        let (rays, mut hits) = (RayPacket::new(rays), HitPacket::none());
        for index in 0..3 {
            object_lanes::<L>(tier, (), spheres, index, &rays, &mut hits);
        }
        self.hits(hits.hits());
    }

    fn pair_lanes<L: Lanes<Token = ()>>(&mut self, tier: Tier, rays: &[Ray; 20], sphere: &Sphere) {
        let (rays, spheres) = (RayPacket::new(rays), SpherePacket::new(&[*sphere; 16]));
        self.hits(pair_lanes::<L>(tier, (), &rays, &spheres).hits());
    }
}
