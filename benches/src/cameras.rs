//! Rays that a camera makes, in the ways that it can make them, with the clock running from the camera to the hits.

use crate::agreement::{WithTruth, check};
use crate::builds::Trees;
use crate::engine::kernel::{Kernel, levels};
use crate::engine::{BLOCK, Query, Rays};
use crate::left_out::LeftOut;
use crate::measure::{Effort, large_scenes};
use crate::rounds::{Median, Sampler, Samples, timed};
use spherule_kernel::{
    Camera, CameraTiles, HitPacket, Intersect, Level, LevelName, Projection, Ray, RayPacket,
    SphereTree, Tier, Trace, tile_rays,
};
use spherule_tests::scenes::{Kind, Scene, Size};
use std::cell::RefCell;
use std::time::Duration;

/// How rays are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// By `Camera::packet`, then traced.
    OneByOne,
    /// By `tile_rays`, then traced.
    InLanes,
    /// The rays were made before the clock started.
    Before,
    /// The tree makes them.
    ByTree,
}

impl Way {
    pub(crate) const ALL: [Self; 4] = [Self::OneByOne, Self::InLanes, Self::Before, Self::ByTree];
}

/// What was timed: a way at a level, or one of Embree's calls, on rays made before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Timed {
    Ours(Way, LevelName),
    Embree(&'static str, usize),
}

/// A scene's picture.
pub(crate) struct OfScene {
    pub(crate) scene: &'static str,
    /// How many rays a sample took, of how many in the picture.
    pub(crate) rays: [usize; 2],
    /// Nanoseconds a ray.
    times: Samples<Timed>,
}

/// Measures the pictures of all large scenes, or of `one` alone.
pub(crate) fn measure(effort: Effort, one: Option<&str>, left_out: &LeftOut) -> Vec<OfScene> {
    let (size, blocks, rounds) = match effort {
        Effort::Test => (Size::SMALL, 1, 1),
        Effort::Quick => (Size::FULL, 16, 5),
        Effort::Full => (Size::FULL, usize::MAX, 9),
    };
    let of_scene = |scene: Scene| {
        eprintln!("the camera of {}", scene.name);
        left_out.unless_wrong(scene.name, || OfScene::measure(&scene, blocks, rounds))
    };
    large_scenes(one, size).filter_map(of_scene).collect()
}

impl OfScene {
    fn measure(scene: &Scene, blocks: usize, rounds: usize) -> Self {
        let (camera, pixels) = camera(scene);
        let levels = levels();
        let trees = Trees::build(scene, false, &levels);
        let picture = RefCell::new(Picture::new(&trees.ours, camera, pixels, blocks));
        let made = WithTruth::of(picture.borrow().rays());
        let (count, exact) = (made.rays.list.len() as f64, Kernel::new(scene, &trees.ours).truth());
        let mut samplers = Vec::<(_, Sampler<'_>)>::new();
        for &level in &levels {
            picture.borrow_mut().check(level);
            for way in Way::ALL {
                let picture = &picture;
                let sample = move || picture.borrow_mut().pass(way, level) / count;
                samplers.push((Timed::Ours(way, level.name()), Box::new(sample)));
            }
        }
        for (index, engine) in trees.others.iter().enumerate() {
            if engine.label.is_embree() {
                let mut run = (engine.ready)(&made.rays);
                check((scene, engine), (&made, &made), &mut *run, &exact);
                let sampler = engine.sampler(&made.rays, Query::ClosestHit);
                samplers.push((Timed::Embree(engine.label.lanes, index), sampler));
            }
        }
        let times = Samples::take(samplers, Duration::ZERO, rounds..=rounds);
        let rays = [made.rays.list.len(), scene.rays(Kind::Primary).len()];
        Self { scene: scene.name, rays, times }
    }

    pub(crate) fn rounds(&self) -> usize {
        self.times.rounds()
    }

    /// The levels, the best first.
    pub(crate) fn levels(&self) -> impl Iterator<Item = LevelName> {
        let is_timed = |name: &LevelName| self.rate(Way::Before, *name).is_some();
        LevelName::ALL.into_iter().rev().filter(is_timed)
    }

    /// Million rays a second.
    pub(crate) fn rate(&self, way: Way, level: LevelName) -> Option<f64> {
        Some(1e3 / self.times.median(&Timed::Ours(way, level))?.middle)
    }

    /// How many times as fast as another way.
    pub(crate) fn ratio(&self, way: Way, other: Way, level: LevelName) -> Option<Median> {
        self.times.ratio(&Timed::Ours(other, level), &Timed::Ours(way, level))
    }

    /// How many times as fast as Embree's quickest call with the same instructions, on rays made before.
    pub(crate) fn times_embree(&self, way: Way, level: LevelName) -> Option<Median> {
        let is_it =
            |timed: &Timed| matches!(timed, Timed::Embree(name, _) if *name == level.as_str());
        self.times.ratio(self.times.quickest(is_it)?, &Timed::Ours(way, level))
    }
}

/// The camera through whose pixels a scene's primary rays go, up to rounding, and how many pixels its picture has across.
fn camera(scene: &Scene) -> (Camera, u32) {
    let rays = scene.rays(Kind::Primary);
    let pixels = rays.len().isqrt();
    // Tiles of four by four, row by row.
    let pixel = |x: usize, y: usize| {
        let tile = y / 4 * (pixels / 4) + x / 4;
        rays[16 * tile + 4 * (y % 4) + x % 4]
    };
    let [first, right, below] = [pixel(0, 0), pixel(pixels - 1, 0), pixel(0, pixels - 1)];
    let is_parallel = first.direction == right.direction;
    let point = |ray: &Ray| if is_parallel { ray.origin } else { ray.direction };
    let step = |ray: &Ray| {
        let way = point(ray).as_dvec3() - point(&first).as_dvec3();
        (way / (pixels - 1) as f64).as_vec3()
    };
    let projection = if is_parallel {
        Projection::Parallel { direction: first.direction }
    } else {
        Projection::Perspective { eye: first.origin }
    };
    let corner = point(&first);
    let camera = Camera { projection, corner, step_x: step(&right), step_y: step(&below) };
    (camera, pixels as u32)
}

/// Packets of a block.
const PACKETS: usize = BLOCK / RayPacket::COUNT;

/// Blocks of a picture, and memory for one.
struct Picture<'a> {
    tree: &'a SphereTree,
    camera: Camera,
    pixels: u32,
    /// The first pixels of tiles, sixteen that follow each other in a square.
    corners: Vec<(u32, u32)>,
    rays: Vec<RayPacket>,
    hits: Vec<HitPacket>,
}

impl<'a> Picture<'a> {
    /// Of so many blocks, from all of the picture.
    fn new(tree: &'a SphereTree, camera: Camera, pixels: u32, blocks: usize) -> Self {
        let corners: Vec<_> = Camera::tile_corners::<[f32; 16]>(pixels, pixels).collect();
        let step = (corners.len() / PACKETS / blocks).max(1);
        let chosen: Vec<_> = corners.chunks(PACKETS).step_by(step).flatten().copied().collect();
        let memory = PACKETS.min(chosen.len());
        Self {
            tree,
            camera,
            pixels,
            corners: chosen,
            rays: vec![RayPacket::inactive(); memory],
            hits: vec![HitPacket::none(); memory],
        }
    }

    /// All of them, in the order of the tiles.
    fn rays(&self) -> Rays {
        let rays = self.corners.iter().flat_map(|&(x, y)| {
            let packet = self.camera.packet::<[f32; 16]>(x, y, self.pixels, self.pixels);
            (0..RayPacket::COUNT).map(move |lane| packet.ray(lane))
        });
        Rays::new(&rays.collect::<Vec<_>>())
    }

    /// Nanoseconds of all blocks.
    fn pass(&mut self, way: Way, level: Level) -> f64 {
        let blocks = self.corners.len().div_ceil(PACKETS);
        (0..blocks).map(|block| self.block(block, way, level)).sum()
    }

    fn block(&mut self, block: usize, way: Way, level: Level) -> f64 {
        let Self { tree, camera, pixels, corners, rays, hits } = self;
        let corners = corners[block * PACKETS..].chunks(PACKETS).next().expect("a block");
        let tiles = CameraTiles { camera: *camera, size: (*pixels, *pixels), corners };
        let (rays, hits) = (&mut rays[..corners.len()], &mut hits[..corners.len()]);
        let mut trace = Trace::new().at(level).coherent();
        if way == Way::Before {
            tile_rays(level, tiles, rays);
        }
        let time = timed(|| {
            match way {
                Way::OneByOne => {
                    for (packet, &(x, y)) in rays.iter_mut().zip(corners) {
                        *packet = camera.packet(x, y, *pixels, *pixels);
                    }
                }
                Way::InLanes => tile_rays(level, tiles, rays),
                Way::Before => {}
                Way::ByTree => {
                    return tree.closest_hit_tiles(Tier::Stable, &mut trace, tiles, rays, hits);
                }
            }
            tree.closest_hit_packets(Tier::Stable, &mut trace, rays, hits);
        });
        std::hint::black_box(&self.hits);
        time
    }

    /// Forgets rays and hits, so that a way that makes none is seen.
    fn forget(&mut self) {
        self.rays.fill(RayPacket::inactive());
        self.hits.fill(HitPacket::none());
    }

    /// # Panics
    /// If a way's hits are not those of brute force, or its rays not the camera's.
    fn check(&mut self, level: Level) {
        let blocks = self.corners.len().div_ceil(PACKETS);
        for block in (0..blocks).step_by(blocks.div_ceil(4)) {
            self.forget();
            self.block(block, Way::OneByOne, level);
            let (rays, hits) = (self.rays.clone(), self.hits.clone());
            let mut expected = vec![HitPacket::none(); 4];
            let few = &rays[..rays.len().min(4)];
            let mut trace = Trace::new().at(level);
            self.tree.list().closest_hit_packets(Tier::Stable, &mut trace, few, &mut expected);
            assert!(hits.starts_with(&expected[..few.len()]), "not as brute force");
            for way in [Way::InLanes, Way::Before, Way::ByTree] {
                self.forget();
                self.block(block, way, level);
                assert!(self.rays == rays && self.hits == hits, "{way:?}");
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page;

    #[test]
    fn the_page_tells_what_part_of_the_picture_was_timed() {
        let scene = Scene::large("u64", Size(128, 64)).expect("listed");
        let (tree, (camera, pixels)) = (scene.tree(), camera(&scene));
        let picture = Picture::new(&tree, camera, pixels, 2);
        let rays = [picture.rays().list.len(), scene.rays(Kind::Primary).len()];
        let sampler: Sampler<'_> = Box::new(|| 1.0);
        let timed = vec![(Timed::Ours(Way::Before, LevelName::Baseline), sampler)];
        let times = Samples::take(timed, Duration::ZERO, 1..=1);
        let page = page::cameras::page("", &[OfScene { scene: scene.name, rays, times }]);
        assert!(page.contains("; 8192 of 16384 rays of each picture,"), "{page}");
    }

    /// The tree's own rays and hits are not what another way left.
    #[test]
    fn a_way_that_makes_nothing_is_seen() {
        let scene = Scene::large("u64", Size::SMALL).expect("listed");
        let (tree, (camera, pixels)) = (scene.tree(), camera(&scene));
        let mut picture = Picture::new(&tree, camera, pixels, 1);
        picture.check(Level::best());
        let found = (picture.rays.clone(), picture.hits.clone());
        picture.forget();
        assert!(picture.rays != found.0 && picture.hits != found.1);
        picture.block(0, Way::ByTree, Level::best());
        assert!(picture.rays == found.0 && picture.hits == found.1);
    }
}
