//! Asks pairs, roots and every structure.

use super::fnv::Fnv;
use crate::cases::{CASES, Case, Random, case};
use crate::scene;
use spherule_kernel::{
    Bvh, Bvh4, BvhNode, BvhSize, Camera, CameraTiles, DepthList, Hit, HitPacket, Intersect, Lanes,
    Level, Projection, Ray, RayPacket, SpherePacket, Spheres, Tier, Trace, Vec3, Viewpoint, f32x4,
    pair_lanes, roots,
};

/// A tier at a level.
pub(super) struct Asked {
    pub(super) level: Level,
    pub(super) tier: Tier,
    /// Whether one bit of an answer to each question is changed.
    pub(super) control: bool,
}

/// How many cases make a list.
const LISTED: usize = 20;
/// Out of so many runs of cases, one makes a list.
const EVERY: usize = 8;
/// How many spheres a tree holds.
const BUILT: usize = 100;
/// The memory that the tree needs.
const NEEDED: BvhSize = Bvh::needed(BUILT);

impl Asked {
    /// Asks every case by itself, in one lane and in four.
    pub(super) fn pairs(&self) -> Fnv {
        let mut fnv = Fnv::new(self.control);
        for first in (0..CASES).step_by(4) {
            let cases = [0, 1, 2, 3].map(|next| case(first + next));
            let four = pairs::<f32x4>(self.tier, &cases);
            for (case, t) in cases.iter().zip(four) {
                let [alone, ..] = pairs::<f32>(self.tier, core::slice::from_ref(case));
                fnv.number(t);
                fnv.number(alone);
            }
        }
        fnv
    }

    /// Asks for both roots of every case.
    pub(super) fn roots(&self) -> Fnv {
        let mut fnv = Fnv::new(self.control);
        for number in 0..CASES {
            let Case { ray, sphere } = case(number);
            match roots(self.tier, &ray, &sphere) {
                Some(roots) => roots.into_iter().for_each(|t| fnv.number(t)),
                None => fnv.word(0),
            }
        }
        fnv
    }

    /// Asks lists: every ray of some cases against the spheres of all these cases.
    pub(super) fn lists(&self) -> Fnv {
        let mut fnv = Fnv::new(self.control);
        for first in (0..CASES).step_by(LISTED * EVERY) {
            let mut columns = [[0.0; LISTED]; 4];
            let mut rays = [Ray::INACTIVE; LISTED];
            for (place, ray) in rays.iter_mut().enumerate() {
                let Case { ray: of_case, sphere } = case(first + place as u32);
                *ray = of_case;
                let row = [sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius];
                columns.iter_mut().zip(row).for_each(|(column, number)| column[place] = number);
            }
            let [x, y, z, r] = &columns;
            if let Ok(spheres) = Spheres::new(x, y, z, r) {
                self.ask(&mut fnv, &spheres, &rays, &mut []);
                in_lanes::<f32>(&mut fnv, self.tier, &spheres, &rays);
                in_lanes::<f32x4>(&mut fnv, self.tier, &spheres, &rays);
            }
        }
        fnv
    }

    /// Asks list, depth list and both trees of an ordinary scene; `Exact` also with spheres one inside another. If one of them cannot be
    /// built, nothing is hit.
    pub(super) fn structures(&self) -> Fnv {
        let (mut fnv, mut random) = (Fnv::new(self.control), Random(7));
        let mut columns = [[0.0; BUILT]; 4];
        for place in 0..BUILT {
            let center = random.point() * 4.0;
            let radius = if self.tier == Tier::Exact && place % 4 == 0 { 3.0 } else { 0.4 };
            let row = [center.x, center.y, center.z, radius + 0.1 * random.number()];
            columns.iter_mut().zip(row).for_each(|(column, number)| column[place] = number);
        }
        let (eye, mut rays) = (Vec3::new(0.0, 0.0, -9.0), [Ray::INACTIVE; 128]);
        for (place, ray) in rays.iter_mut().enumerate() {
            let origin = if place % 2 == 0 { eye } else { random.point() * 4.0 };
            *ray = Ray::new(origin, random.point() * 4.0 - origin);
        }

        let [x, y, z, r] = &columns;
        // On every target alike, it would not be seen in the digests that one is missing.
        let nothing = Fnv::new(self.control);
        let Ok(spheres) = Spheres::new(x, y, z, r) else { return nothing };
        let mut words = [0.0; DepthList::needed(BUILT)];
        let mut scratch = [0.0; DepthList::scratch(BUILT)];
        let mut nodes = [BvhNode::EMPTY; NEEDED.nodes];
        let (mut places, mut indices) = ([[0.0; 4]; NEEDED.places], [0; NEEDED.places]);
        self.ask(&mut fnv, &spheres, &rays, &mut []);
        let Ok(sorted) = DepthList::sort(spheres, Viewpoint::Origin(eye), &mut words) else {
            return nothing;
        };
        self.ask(&mut fnv, &sorted, &rays, &mut scratch);
        let Ok(tree) = Bvh::build(spheres, &mut nodes, &mut places, &mut indices) else {
            return nothing;
        };
        self.ask(&mut fnv, &tree, &rays, &mut []);
        self.tiles(&mut fnv, &tree, &spheres, eye);
        let mut words = [0; Bvh4::needed(BUILT)];
        let Ok(built) = Bvh4::build(spheres, &mut words) else { return nothing };
        let Ok(tree) = Bvh4::load(spheres, built.words()) else { return nothing };
        tree.words().iter().for_each(|&word| fnv.word(word));
        self.ask(&mut fnv, &tree, &rays, &mut []);
        fnv
    }

    /// Asks the lecture's scene in both projections.
    pub(super) fn pictures(&self) -> Fnv {
        let mut fnv = Fnv::new(self.control);
        let Some(spheres) = scene::spheres() else { return fnv };
        for is_parallel in [false, true] {
            let camera = scene::camera(is_parallel);
            for y in 0..scene::HEIGHT {
                let mut row = [Ray::INACTIVE; scene::WIDTH as usize];
                for (x, ray) in row.iter_mut().enumerate() {
                    *ray = camera.get_ray(x as u32, y);
                }
                self.ask(&mut fnv, &spheres, &row, &mut []);
                fnv.hit(spheres.closest_hit(self.tier, &row[20]));
                fnv.word(u32::from(spheres.any_hit(self.tier, &row[40])));
            }
        }
        fnv
    }

    /// Asks what a camera's tiles hit in a tree and in a list, in both projections, and for the rays.
    fn tiles(&self, fnv: &mut Fnv, tree: &Bvh<'_>, list: &Spheres<'_>, eye: Vec3) {
        let (step_x, step_y) = (Vec3::new(0.03, 0.001, 0.0), Vec3::new(0.0, -0.03, 0.002));
        let first = Vec3::new(-0.11, 0.12, 1.0);
        for is_parallel in [false, true] {
            let camera = Camera {
                projection: if is_parallel {
                    Projection::Parallel { direction: Vec3::new(0.1, -0.1, 1.0) }
                } else {
                    Projection::Perspective { eye }
                },
                corner: if is_parallel { eye + 9.0 * first } else { first },
                step_x: if is_parallel { 9.0 * step_x } else { step_x },
                step_y: if is_parallel { 9.0 * step_y } else { step_y },
            };
            // The picture's edge cuts the last of the tiles.
            let corners = [(0, 0), (4, 0), (0, 4), (4, 4), (8, 0), (8, 4)];
            let tiles = CameraTiles { camera, size: (10, 8), corners: &corners };
            let (mut rays, mut hits) = ([RayPacket::inactive(); 6], [HitPacket::none(); 6]);
            let mut trace = Trace::new().at(self.level).coherent();
            tree.closest_hit_tiles(self.tier, &mut trace, tiles, &mut rays, &mut hits);
            hits.iter().flat_map(HitPacket::hits).for_each(|hit| fnv.hit(hit));
            list.closest_hit_tiles(self.tier, &mut trace, tiles, &mut rays, &mut hits);
            hits.iter().flat_map(HitPacket::hits).for_each(|hit| fnv.hit(hit));
            for column in rays.iter().flat_map(RayPacket::directions) {
                column.iter().for_each(|number| fnv.word(number.to_bits()));
            }
        }
    }

    /// Asks for the closest hit of every ray, and whether there is any hit.
    fn ask(&self, fnv: &mut Fnv, structure: &impl Intersect, rays: &[Ray], scratch: &mut [f32]) {
        let mut trace = Trace::new().at(self.level).with_scratch(scratch);
        let (mut hits, mut occluded): ([Option<Hit>; 128], _) = ([None; 128], [false; 128]);
        structure.closest_hits_with(self.tier, &mut trace, rays, &mut hits);
        structure.any_hits_with(self.tier, &mut trace, rays, &mut occluded);
        for (hit, occluded) in hits.into_iter().zip(occluded).take(rays.len()) {
            fnv.hit(hit);
            fnv.word(u32::from(occluded));
        }
    }
}

/// The t of some cases, as many as there are lanes.
fn pairs<L: Lanes<Token = ()>>(tier: Tier, cases: &[Case]) -> [f32; 4] {
    let (mut rays, mut spheres) = ([Ray::INACTIVE; 4], [case(0).sphere; 4]);
    for (place, case) in cases.iter().enumerate().take(L::COUNT) {
        (rays[place], spheres[place]) = (case.ray, case.sphere);
    }
    let (rays, spheres) = (RayPacket::new(&rays), SpherePacket::new(&spheres));
    let hits = pair_lanes::<L>(tier, (), &rays, &spheres);
    let mut t = [f32::INFINITY; 4];
    t.iter_mut().zip(hits.t()).for_each(|(t, hit)| *t = *hit);
    t
}

/// The closest hits in lanes that are fixed when the program is built.
fn in_lanes<L: Lanes<Token = ()>>(fnv: &mut Fnv, tier: Tier, spheres: &Spheres<'_>, rays: &[Ray]) {
    for rays in rays.chunks(L::COUNT) {
        let (packets, mut hits) = ([RayPacket::<L::Array>::new(rays)], [HitPacket::none()]);
        spheres.closest_hit_lanes::<L>(tier, (), &mut Trace::new(), &packets, &mut hits);
        hits[0].hits().take(rays.len()).for_each(|hit| fnv.hit(hit));
    }
}
