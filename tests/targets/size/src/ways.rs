//! The ways to draw a picture, of which one is compiled.

mod hard;
#[path = "../../../../kernel/examples/firmware/src/hardware_root.rs"]
mod hardware_root;
mod memory;
mod program_name;

use crate::many::{self, BAKED_TREE};
use core::hint::black_box;
use core::sync::atomic::{AtomicU8, Ordering::Relaxed};
use hardware_root::HardwareRoot;
use memory::Memory;
use program_name::{NAME, by_tier, ends_with};
use spherule_kernel::{
    Bvh, Bvh4, BvhNode, BvhSize, Exact, Fast, Geometric, HitPacket, Intersect, Ray, RayPacket,
    SpherePacket, Spheres, Stable, Trace, f32x4, pair_lanes, roots,
};
use spherule_targets::scene::{self, HEIGHT, WIDTH};

const PIXELS: usize = (WIDTH * HEIGHT) as usize;
static PICTURE: [AtomicU8; PIXELS] = [const { AtomicU8::new(0) }; PIXELS];

/// Draws a mark for the sphere that a pixel's ray has hit.
fn mark(place: usize, sphere: Option<u32>) {
    if let Some(pixel) = PICTURE.get(place) {
        pixel.store(sphere.map_or(b'.', |sphere| b'a' + sphere as u8), Relaxed);
    }
}

/// A checksum of the picture.
pub fn drawn() -> u32 {
    let add = |sum: u32, pixel: &AtomicU8| sum * 31 + u32::from(pixel.load(Relaxed));
    PICTURE.iter().fold(0, |sum: u32, pixel| add(sum % (1 << 24), pixel))
}

/// Whether the picture shows many spheres.
const OF_MANY: bool = ends_with("-many")
    || ends_with("-baked")
    || ends_with("-baked_any")
    || ends_with("-built")
    || ends_with("-bvh");

/// Whether surfaces are asked for.
const OF_SURFACES: bool = ends_with("-hard_surface") || ends_with("-hard_spawn");

/// Draws the picture.
pub fn draw() {
    if OF_MANY {
        draw_many();
    } else if const { ends_with("-hard") } {
        hard::by_list();
    } else if const { ends_with("-hard_tree") } {
        hard::by_tree();
    } else if OF_SURFACES {
        hard::surfaces();
    } else if const { !ends_with("-none") } {
        let Some(spheres) = scene::spheres() else { return };
        if const { ends_with("-slice") } { slices(spheres) } else { pixels(spheres) }
    }
}

/// Draws many spheres.
fn draw_many() {
    let Some(spheres) = many::spheres() else { return };
    if const { ends_with("-many") } {
        draw_all(&spheres);
    } else if const { ends_with("-built") } {
        built(spheres);
    } else if const { ends_with("-bvh") } {
        sixteen_wide(spheres);
    } else if let Ok(tree) = Bvh4::load(spheres, black_box(&BAKED_TREE)) {
        draw_all(&tree);
    }
}

/// Draws one ray at a time, or four.
fn pixels(spheres: Spheres<'_>) {
    let (mut camera, mut place) = (scene::camera(false), 0);
    camera.corner = black_box(camera.corner);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let ray = camera.get_ray(x, y);
            if const { ends_with("-closest") } {
                let hit = by_tier!(tier => spheres.closest_hit(tier, &ray));
                mark(place, hit.map(|hit| hit.sphere));
            } else if const { ends_with("-any") } {
                mark(place, by_tier!(tier => spheres.any_hit(tier, &ray)).then_some(0));
            } else if const { ends_with("-vsqrt") } {
                let (rays, mut hits) = ([RayPacket::new(&[ray])], [HitPacket::none()]);
                let trace = &mut Trace::new();
                by_tier!(tier => spheres.closest_hit_lanes::<HardwareRoot>(tier, (), trace, &rays, &mut hits));
                mark(place, hits[0].hit(0).map(|hit| hit.sphere));
            } else if const { ends_with("-f32x4") } && x % 4 == 0 {
                let rays = [0, 1, 2, 3].map(|next| camera.get_ray(x + next, y));
                let (rays, mut hits) = ([RayPacket::new(&rays)], [HitPacket::none()]);
                let trace = &mut Trace::new();
                by_tier!(tier => spheres.closest_hit_lanes::<f32x4>(tier, (), trace, &rays, &mut hits));
                for lane in 0..4 {
                    mark(place + lane, hits[0].hit(lane).map(|hit| hit.sphere));
                }
            } else if const { ends_with("-libm") } {
                mark(place, textbook(spheres, &ray, libm::sqrtf));
            } else if const { ends_with("-micromath") } {
                mark(place, textbook(spheres, &ray, micromath::F32Ext::sqrt));
            } else if const { ends_with("-pairs") } || const { ends_with("-roots") } {
                nearest(spheres, &ray, place);
            }
            place += 1;
        }
    }
}

/// A ray at a time against a structure.
fn draw_all(structure: &impl Intersect) {
    let (mut camera, mut place) = (scene::camera(false), 0);
    camera.corner = black_box(camera.corner);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let ray = camera.get_ray(x, y);
            if const { ends_with("_any") } {
                mark(place, by_tier!(tier => structure.any_hit(tier, &ray)).then_some(0));
            } else {
                let hit = by_tier!(tier => structure.closest_hit(tier, &ray));
                mark(place, hit.map(|hit| hit.sphere));
            }
            place += 1;
        }
    }
}

/// A tree that is built here.
fn built(spheres: Spheres<'_>) {
    static WORDS: Memory<[u32; Bvh4::needed(MANY)]> = Memory::new([0; Bvh4::needed(MANY)]);
    if let Ok(tree) = Bvh4::build(spheres, WORDS.lend()) {
        draw_all(&tree);
    }
}

/// The tree for many lanes.
fn sixteen_wide(spheres: Spheres<'_>) {
    const NEEDED: BvhSize = Bvh::needed(MANY);
    const PLACES: usize = NEEDED.places;
    static NODES: Memory<[BvhNode; NEEDED.nodes]> = Memory::new([BvhNode::EMPTY; NEEDED.nodes]);
    static ROWS: Memory<[[f32; 4]; PLACES]> = Memory::new([[0.0; 4]; PLACES]);
    static INDICES: Memory<[u32; PLACES]> = Memory::new([0; PLACES]);
    if let Ok(tree) = Bvh::build(spheres, NODES.lend(), ROWS.lend(), INDICES.lend()) {
        draw_all(&tree);
    }
}

const MANY: usize = many::COUNT;

/// The caller's own loop over spheres.
fn nearest(spheres: Spheres<'_>, ray: &Ray, place: usize) {
    let (mut closest, mut index) = ((f32::INFINITY, None), 0);
    while let Some(sphere) = spheres.get(index) {
        let t = if const { ends_with("-roots") } {
            by_tier!(tier => roots(tier, ray, &sphere)).map_or(f32::INFINITY, |[near, _]| near)
        } else {
            let (rays, others) = (RayPacket::new(&[*ray]), SpherePacket::new(&[sphere]));
            by_tier!(tier => pair_lanes::<f32>(tier, (), &rays, &others))
                .hit(0)
                .map_or(f32::INFINITY, |hit| hit.t)
        };
        if t < closest.0 {
            closest = (t, Some(index as u32));
        }
        index += 1;
    }
    mark(place, closest.1);
}

/// The textbook's quadratic, without the kernel: the cost of everything else.
#[inline(always)]
fn textbook(spheres: Spheres<'_>, ray: &Ray, sqrt: impl Fn(f32) -> f32) -> Option<u32> {
    let (mut closest, mut index) = ((f32::INFINITY, None), 0);
    while let Some(sphere) = spheres.get(index) {
        let p = sphere.center - ray.origin;
        let (a, b) = (ray.direction.dot(ray.direction), ray.direction.dot(p));
        let discriminant = b * b - a * (p.dot(p) - sphere.radius * sphere.radius);
        if discriminant >= 0.0 {
            let root = sqrt(discriminant);
            let near = (b - root) / a;
            let t = if near >= 0.0 { near } else { (b + root) / a };
            if t >= 0.0 && t < closest.0 {
                closest = (t, Some(index as u32));
            }
        }
        index += 1;
    }
    closest.1
}

/// A row of rays in one call.
fn slices(spheres: Spheres<'_>) {
    let camera = scene::camera(false);
    for y in 0..HEIGHT {
        let (mut rays, mut hits) = ([Ray::INACTIVE; WIDTH as usize], [None; WIDTH as usize]);
        for (x, ray) in rays.iter_mut().enumerate() {
            *ray = camera.get_ray(x as u32, y);
        }
        by_tier!(tier => spheres.closest_hits(tier, &rays, &mut hits));
        for (x, hit) in hits.iter().enumerate() {
            mark((y * WIDTH) as usize + x, hit.map(|hit| hit.sphere));
        }
    }
}
