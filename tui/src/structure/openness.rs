//! How open a scene is around its spheres: ambient occlusion, by rays spawned on them.
//!
//! # Method
//!
//! From a sphere, 64 rays are spawned in 64 directions d. Each starts where d is the normal, and V(d) is 1 if the ray meets nothing between
//! two diameters of the sphere and a reach. Nearer spheres are left out: in a molecule every atom is in the way of its neighbours on all
//! sides, which adds noise to what should tell a groove from a ridge. (A model of the picture told whether two neighbouring pixels of four
//! proteins lie on different chains or depths: with nearer spheres the AUC was 0.71 to 0.77, without them 0.82 to 0.87.) Of light that
//! comes from everywhere, a surface whose normal is n receives the mean of V(d) over its hemisphere, weighted by the cosine. In harmonics
//! that is mean V + 2 mean(V(d) d) . n; the terms left out begin with the second degree, of which a cosine lets a quarter through. So four
//! numbers tell how open a sphere is on every side. They are the same from every viewpoint: they are found once, when a picture first shows
//! the sphere, and kept as long as no sphere moves. Where nothing is in the way the sum is 1, since directions come in opposite pairs.
//!
//! All spheres have the same directions, so that neighbours see alike. With 64 other directions for each sphere the cost was the same, and
//! the result noise.

use super::search::{Scratch, Search, Tracing};
use crate::threads::Threads;
use spherule_kernel::{
    Coherence, HitPacket, Level, Ray, RayPacket, Sphere, SphereList, SpherePacket, SphereTree,
    Spheres, SurfacePacket, Tier, Towards, Vec3, pair_packets, shadow_packets, surface_packets,
};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, LazyLock};

/// Directions, of which every one has its opposite.
const RAYS: usize = 64;

/// Spheres whose rays are traced at a time. Those of one direction are traced together, since they run the same way.
const AT_ONCE: usize = 16 * RayPacket::COUNT;

/// Where rays begin to count, over the radius of the sphere that they are spawned on.
const NEAR: f32 = 4.0;

/// The tier of these rays, whichever tier draws the picture: the four numbers are found only once, and with other tiers they are the same
/// except for a ray in a million.
const TIER: Tier = Tier::Stable;

/// Directions that lie evenly on the sphere: a Fibonacci lattice of one half, and the opposite ones.
///
/// They are computed by sums and products alone, so that they are the same everywhere.
static DIRECTIONS: LazyLock<[Vec3; RAYS]> = LazyLock::new(|| {
    /// The cosine and the sine of the golden angle.
    const TURN: [f64; 2] = [-0.737_368_878_078_319_8, 0.675_490_294_261_523_9];
    let mut directions = [Vec3::ZERO; RAYS];
    let (mut cos, mut sin) = (1.0_f64, 0.0_f64);
    for pair in 0..RAYS / 2 {
        let height = (2 * pair + 1) as f64 / RAYS as f64;
        let across = (1.0 - height * height).sqrt();
        let direction = Vec3::new((across * cos) as f32, height as f32, (across * sin) as f32);
        (directions[pair], directions[pair + RAYS / 2]) = (direction, -direction);
        (cos, sin) = (cos * TURN[0] - sin * TURN[1], cos * TURN[1] + sin * TURN[0]);
    }
    directions
});

/// How open a scene is around its spheres, as far as it is known.
#[derive(Debug, Default)]
pub struct Openness {
    /// One packed value a sphere.
    known: Vec<AtomicU32>,
    reach: f32,
}

/// What is needed to compute openness by rays spawned on spheres, and what is known of it.
#[derive(Clone, Debug)]
pub struct Around {
    /// What is known.
    pub openness: Arc<Openness>,
    /// The spheres.
    pub list: Arc<SphereList>,
    /// How rays find them; if `None`, all are searched.
    pub tree: Option<Arc<SphereTree>>,
}

/// The memory of a thread that computes openness.
#[derive(Clone, Debug, Default)]
pub struct OpennessMemory {
    wanted: Vec<u32>,
    rays: Vec<RayPacket>,
    occluded: Vec<u32>,
}

impl Openness {
    /// Knows nothing yet of so many spheres. Spheres farther away than `reach` are in no one's way.
    #[must_use]
    pub fn new(spheres: usize, reach: f32) -> Self {
        Self { known: (0..spheres).map(|_| AtomicU32::new(UNKNOWN)).collect(), reach }
    }

    /// Returns how much of the light from everywhere the surface of this sphere receives where its unit normal is `normal`: 0 to 1. Returns
    /// 1 if that is not known, or there is no such sphere. A shorter normal brings it nearer to the mean of all sides.
    #[must_use]
    #[inline]
    pub fn towards(&self, sphere: u32, normal: Vec3) -> f32 {
        let packed =
            self.known.get(sphere as usize).map_or(UNKNOWN, |one| one.load(Ordering::Relaxed));
        if packed == UNKNOWN {
            return 1.0;
        }
        let (mean, slope) = unpacked(packed);
        let open = mean + slope.dot(normal);
        // NaN, of a surface that has no normal, is not above zero.
        if open > 0.0 { open.min(1.0) } else { 0.0 }
    }
}

impl Around {
    /// Computes the openness of those of `spheres` for which it is not known, until the threads are stopped. Returns how many rays that
    /// took.
    pub fn learn(
        &self,
        (level, threads): (Level, &Threads),
        scratch: &mut Scratch,
        memory: &mut OpennessMemory,
        spheres: impl Iterator<Item = u32>,
    ) -> u64 {
        let (known, list) = (&self.openness.known, self.list.spheres());
        let search = self.tree.as_ref().map_or(Search::Brute(list), |tree| Search::Bvh(tree.bvh()));
        let is_wanted = |&sphere: &u32| {
            known.get(sphere as usize).is_some_and(|one| one.load(Ordering::Relaxed) == UNKNOWN)
        };
        let OpennessMemory { wanted, rays, occluded } = memory;
        wanted.clear();
        wanted.extend(spheres.filter(is_wanted));
        wanted.sort_unstable();
        wanted.dedup();
        let tracing = Tracing { tier: TIER, level, coherence: Coherence::Detect };
        let mut learnt = 0;
        for wanted in wanted.chunks(AT_ONCE).take_while(|_| !threads.are_stopped()) {
            let packets: Vec<_> = wanted
                .chunks(RayPacket::COUNT)
                .map(|wanted| Sixteen::gather(list, wanted))
                .collect();
            let mut seen = [(0, Vec3::ZERO); AT_ONCE];
            for &direction in DIRECTIONS.iter() {
                rays.clear();
                rays.extend(
                    packets
                        .iter()
                        .map(|packet| packet.spawn_rays(level, direction, self.openness.reach)),
                );
                occluded.clear();
                occluded.resize(rays.len(), 0);
                search.any_hits(tracing, scratch, rays, occluded);
                for (seen, occluded) in seen.chunks_mut(RayPacket::COUNT).zip(&*occluded) {
                    for (lane, (count, sum)) in seen.iter_mut().enumerate() {
                        if occluded >> lane & 1 == 0 {
                            *count += 1;
                            *sum += direction;
                        }
                    }
                }
            }
            for (&sphere, &(count, sum)) in wanted.iter().zip(&seen) {
                // Another thread that computed it wrote the same.
                known[sphere as usize].store(packed(count, sum), Ordering::Relaxed);
            }
            learnt += wanted.len();
        }
        (learnt * RAYS) as u64
    }
}

/// Sixteen spheres of a scene, or as many as are left.
struct Sixteen {
    columns: [[f32; RayPacket::COUNT]; 4],
    packet: SpherePacket,
    count: usize,
}

impl Sixteen {
    fn gather(spheres: Spheres<'_>, wanted: &[u32]) -> Self {
        let mut columns = [[0.0; RayPacket::COUNT]; 4];
        let mut all = [Sphere { center: Vec3::ZERO, radius: -1.0 }; RayPacket::COUNT];
        for (lane, &index) in wanted.iter().enumerate() {
            let Some(sphere) = spheres.get(index as usize) else { continue };
            all[lane] = sphere;
            let [x, y, z] = sphere.center.to_array();
            for (column, value) in columns.iter_mut().zip([x, y, z, sphere.radius]) {
                column[lane] = value;
            }
        }
        Self { columns, packet: SpherePacket::new(&all), count: wanted.len() }
    }

    /// Rays spawned on each sphere in `direction`, from the place where that is the normal; inactive where there is no such place in single
    /// precision.
    fn spawn_rays(&self, level: Level, direction: Vec3, reach: f32) -> RayPacket {
        let [x, y, z, radius] = &self.columns;
        let Ok(spheres) = Spheres::new(x, y, z, radius) else { return RayPacket::inactive() };
        // One ray goes from outside to the centre; where it hits, the spawned ray leaves.
        let mut inwards = RayPacket::inactive();
        for (lane, sphere) in spheres.iter().take(self.count).enumerate() {
            let origin = sphere.center + 2.0 * sphere.radius * direction;
            inwards.set(lane, &Ray::new(origin, -direction));
        }
        let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
        let mut outwards = [RayPacket::inactive()];
        pair_packets(TIER, level, &[inwards], &[self.packet], &mut hits);
        surface_packets(TIER, level, spheres, &[inwards], &hits, &mut surfaces);
        let hit = (&[inwards][..], &hits[..], &surfaces[..]);
        shadow_packets(TIER, level, spheres, hit, Towards::Direction(direction), &mut outwards);
        let [mut outwards] = outwards;
        for (lane, &radius) in radius.iter().enumerate().take(self.count) {
            let ray = outwards.ray(lane);
            if ray.is_live() {
                outwards.set(lane, &Ray { t_min: NEAR * radius, t_max: reach, ..ray });
            }
        }
        outwards
    }
}

/// The packed value of a sphere of which nothing is known.
const UNKNOWN: u32 = 0;
/// The greatest coordinate of a sum of open directions: half of all are open, a half sphere, and their mean is half.
const MOST: f32 = RAYS as f32 / 4.0;

/// How many directions are open and their sum, a byte a number.
fn packed(count: u8, sum: Vec3) -> u32 {
    let [x, y, z] =
        sum.to_array().map(|sum| (sum / MOST * 127.0).round().clamp(-127.0, 127.0) as i8 as u8);
    u32::from_le_bytes([x, y, z, count + 1])
}

/// The mean openness of all sides, and what it gains along the normal.
fn unpacked(packed: u32) -> (f32, Vec3) {
    let [x, y, z, count] = packed.to_le_bytes();
    let slope = Vec3::from_array([x, y, z].map(|sum| f32::from(sum as i8))) * (2.0 * MOST / 127.0);
    ((f32::from(count) - 1.0) / RAYS as f32, slope / RAYS as f32)
}

#[cfg(test)]
mod tests;
