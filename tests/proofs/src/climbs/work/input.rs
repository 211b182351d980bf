//! Inputs that a search can climb over: a scene and rays, made of numbers that change by little or by much.

use crate::proofs::climb::Random;
use crate::{Ray, RayPacket, Sphere, SphereList, SphereTree, Vec3};
use std::vec::Vec;

/// The numbers that make an input, each from 1 up to 2: a climb changes their fractions.
pub(super) type Genes = [f32; OF_TREE + OF_RAYS + 1];

/// The genes of the tree are the first, the one of the query is the last.
pub(super) const OF_TREE: usize = 7;
const OF_RAYS: usize = 25;

const MOST_SPHERES: u32 = 3000;
const MOST_RAYS: u32 = 1024;

/// How spheres lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scene {
    Uniform,
    Clusters,
    /// One within the other.
    Shells,
    /// Small ones on a large one.
    Ground,
    /// Uniform, with radii over 10^6.
    Radii,
    Line,
    /// In a plane.
    Sheet,
    /// Each touches its neighbours, and all numbers are short: rays of a grid are tangents of many.
    Lattice,
}

/// What a scene is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct SceneInput {
    pub(super) scene: Scene,
    pub(super) spheres: usize,
    /// In a cube from -1 to 1.
    pub(super) radius: f32,
    /// 2^k.
    pub(super) scale: f32,
    pub(super) shift: Vec3,
    pub(super) seed: u64,
}

/// What rays are made of, in the scene's cube from -1 to 1: ray i goes from `from + around` to `to + about`,
/// which run along with each other by as much as `parallel` says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bundle {
    pub(super) from: Vec3,
    pub(super) from_spread: f32,
    pub(super) to: Vec3,
    pub(super) to_spread: f32,
    /// 1 for a beam whose ends are its beginnings, moved.
    pub(super) parallel: f32,
}

/// In what order rays come, and what else is said of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayInput {
    pub(super) bundles: [Bundle; 2],
    /// So many rays of the one bundle, then as many of the other; zero if there is only one bundle.
    pub(super) alternate: usize,
    /// How many rays in turn are near each other.
    pub(super) run: usize,
    /// How far rays of a run are apart, where the bundle's size is one.
    pub(super) within_run: f32,
    /// Whether runs follow each other line by line, instead of at random.
    pub(super) lines: bool,
    /// The part of the rays that change places.
    pub(super) shuffled: f32,
    /// The part of the rays that are not live.
    pub(super) dead: f32,
    pub(super) t_min: f32,
    pub(super) t_max: f32,
    /// The length of directions, 2^k.
    pub(super) length: f32,
    pub(super) count: usize,
    pub(super) seed: u64,
}

/// An input, of which the tree is made apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Input {
    pub(super) scene: SceneInput,
    pub(super) rays: RayInput,
    /// Whether the query asks for any hit, or for the closest.
    pub(super) any: bool,
}

/// How many values a gene has.
const STEPS: u16 = 1 << 9;

/// The value that a gene has: smaller changes of it change nothing.
pub(super) fn step(gene: f32) -> u16 {
    (((gene - 1.0) * f32::from(STEPS)) as u16).min(STEPS - 1)
}

/// Reads genes one after the other.
struct Reader<'a>(core::slice::Iter<'a, f32>);

impl Reader<'_> {
    /// From zero up to one, in steps that matter.
    fn part(&mut self) -> f32 {
        let gene = self.0.next().expect("as many genes as are read");
        f32::from(step(*gene)) / f32::from(STEPS)
    }

    /// 2^`low` to 2^`high`.
    fn power(&mut self, low: f32, high: f32) -> f32 {
        libm::exp2f(low + self.part() * (high - low))
    }

    /// A power of two with a whole exponent.
    fn whole_power(&mut self, low: f32, high: f32) -> f32 {
        libm::exp2f(libm::roundf(low + self.part() * (high - low)))
    }

    /// Zero for an eighth, then as [`power`](Self::power).
    fn power_or_zero(&mut self, low: f32, high: f32) -> f32 {
        let part = (self.part() - 0.125) / 0.875;
        if part < 0.0 { 0.0 } else { libm::exp2f(low + part * (high - low)) }
    }

    fn below(&mut self, end: usize) -> usize {
        (self.part() * end as f32) as usize % end
    }

    /// From 1 to `most`, as many small ones as large.
    fn count(&mut self, most: u32) -> usize {
        self.power(0.0, libm::log2f(most as f32)) as usize
    }

    fn seed(&mut self) -> u64 {
        u64::from((self.part() * 64.0) as u32)
    }

    /// Somewhere in a cube, mostly near its middle or its faces.
    fn point(&mut self, size: f32) -> Vec3 {
        let along = self.below(7);
        let far = self.power_or_zero(-3.0, 3.0) * size;
        let axis = [Vec3::X, Vec3::Y, Vec3::Z][along % 3];
        let slant = Vec3::new(0.3, -0.2, 0.1);
        match along {
            0..3 => axis * far,
            3..6 => (slant - axis) * far,
            _ => slant * far,
        }
    }

    fn bundle(&mut self) -> Bundle {
        Bundle {
            from: self.point(2.0),
            from_spread: self.power_or_zero(-16.0, 2.0),
            to: self.point(1.0),
            to_spread: self.power_or_zero(-16.0, 3.0),
            parallel: [0.0, 1.0, 1.0, -1.0][self.below(4)],
        }
    }
}

impl Input {
    /// An input by its genes.
    pub(super) fn of(genes: &Genes) -> Self {
        use Scene::{Clusters, Ground, Lattice, Line, Radii, Sheet, Shells, Uniform};

        let (of_tree, of_rays) = genes.split_at(OF_TREE);
        let (mut tree, mut rays) = (Reader(of_tree.iter()), Reader(of_rays.iter()));
        let scenes = [Uniform, Clusters, Shells, Ground, Radii, Line, Sheet, Lattice];
        let scene = scenes[tree.below(scenes.len())];
        let spheres = 1 + tree.count(MOST_SPHERES);
        let scene = SceneInput {
            scene,
            spheres,
            radius: tree.power(-14.0, 0.0),
            scale: tree.whole_power(-20.0, 20.0),
            shift: tree.point(16.0),
            seed: tree.seed(),
        };
        let rays = RayInput {
            bundles: [rays.bundle(), rays.bundle()],
            alternate: [0, 0, 0, 1, 3, 16, 40, 64][rays.below(8)],
            run: rays.count(256),
            within_run: rays.power_or_zero(-12.0, 0.0),
            lines: rays.below(2) == 0,
            shuffled: rays.power_or_zero(-6.0, 0.0),
            dead: rays.power_or_zero(-8.0, -0.1),
            t_min: [0.0, 0.0, 0.0, 1e-3, 0.5, -0.5, f32::NEG_INFINITY][rays.below(7)],
            t_max: [f32::INFINITY, f32::INFINITY, 0.5, 1.0, 4.0][rays.below(5)],
            length: rays.whole_power(-8.0, 8.0),
            count: rays.count(MOST_RAYS),
            seed: rays.seed(),
        };
        let any = genes[OF_TREE + OF_RAYS] >= 1.5;
        Self { scene, rays, any }
    }

    /// The rays, in packets.
    pub(super) fn packets(&self) -> Vec<RayPacket> {
        packed(&self.rays())
    }

    /// The rays, where the scene is.
    pub(super) fn rays(&self) -> Vec<Ray> {
        let rays = self.rays.rays();
        let there = |ray: &Ray| Ray {
            origin: (ray.origin + self.scene.shift) * self.scene.scale,
            direction: ray.direction * self.scene.scale,
            ..*ray
        };
        rays.iter().map(there).collect()
    }
}

pub(super) fn packed(rays: &[Ray]) -> Vec<RayPacket> {
    rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect()
}

/// From -1 to 1.
fn signed(random: &mut Random) -> f32 {
    (random.bits() >> 40) as f32 / (1 << 23) as f32 - 1.0
}

fn in_cube(random: &mut Random) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| signed(random)))
}

impl SceneInput {
    pub(super) fn tree(&self) -> SphereTree {
        SphereTree::new(self.list())
    }

    pub(super) fn list(&self) -> SphereList {
        let mut random = Random(self.seed + 1);
        let mut list = SphereList::new();
        let centers: Vec<_> = (0..16).map(|_| in_cube(&mut random)).collect();
        for number in 0..self.spheres {
            let part = (number + 1) as f32 / self.spheres as f32;
            let place = in_cube(&mut random);
            let (center, radius) = match self.scene {
                Scene::Uniform => (place, self.radius),
                Scene::Clusters => (centers[number % 16] + place * 0.05, self.radius * 0.1),
                Scene::Shells => (place * self.radius * 0.1, part),
                Scene::Ground if number == 0 => (Vec3::new(0.0, -1001.0, 0.0), 1000.0),
                Scene::Ground => (place * Vec3::new(1.0, 0.0, 1.0) - Vec3::Y, self.radius),
                Scene::Radii => {
                    (place, self.radius * libm::exp2f(-10.0 + 10.0 * signed(&mut random)))
                }
                Scene::Line => (Vec3::X * (2.0 * part - 1.0) + place * self.radius, self.radius),
                Scene::Sheet => (place * Vec3::new(1.0, 1.0, 0.0), self.radius),
                Scene::Lattice => {
                    let at = [number % 16, number / 16 % 16, number / 256];
                    (Vec3::from_array(at.map(|i| (i as f32 - 7.5) / 8.0)), 0.0625)
                }
            };
            let (center, radius) = ((center + self.shift) * self.scale, radius * self.scale);
            list.push(Sphere { center, radius });
        }
        list
    }
}

impl RayInput {
    /// In the scene's cube.
    fn rays(&self) -> Vec<Ray> {
        let mut random = Random(self.seed + 1);
        let mut rays = Vec::with_capacity(self.count);
        let runs = self.count.div_ceil(self.run);
        let wide = (1..=runs).find(|wide| wide * wide >= runs).unwrap_or(1);
        let mut bases = [Vec3::ZERO; 2];
        for number in 0..self.count {
            let run = number / self.run;
            if number % self.run == 0 {
                bases = [in_cube(&mut random), in_cube(&mut random)];
                if self.lines {
                    let at = |part: usize| 2.0 * part as f32 / wide as f32 - 1.0;
                    bases = [Vec3::new(at(run % wide), at(run / wide), 0.0); 2];
                }
            }
            let bundle = match number.checked_div(self.alternate) {
                Some(turn) => &self.bundles[turn % 2],
                None => &self.bundles[0],
            };
            let [around, about] = bases.map(|base| base + in_cube(&mut random) * self.within_run);
            let from = around * bundle.from_spread;
            let to = bundle.to + about * bundle.to_spread + from * bundle.parallel;
            let from = bundle.from + from;
            let mut ray = Ray::new(from, (to - from) * self.length);
            (ray.t_min, ray.t_max) = (self.t_min / self.length, self.t_max / self.length);
            rays.push(ray);
        }
        for number in 0..self.count {
            if signed(&mut random).abs() < self.shuffled {
                rays.swap(number, random.below(self.count as u64) as usize);
            }
        }
        for ray in &mut rays {
            if signed(&mut random).abs() < self.dead {
                match random.below(5) {
                    0 => ray.t_max = f32::NAN,
                    1 => ray.origin.x = f32::NAN,
                    2 => ray.direction.y = f32::INFINITY,
                    3 => ray.direction = Vec3::ZERO,
                    _ => ray.t_max = f32::NEG_INFINITY,
                }
            }
        }
        rays
    }
}
