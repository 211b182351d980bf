//! The kernel in a program without `std`, heap or unwinding: if this links, it needs none of them.
//!
//! `prove` builds it, builds its negative controls, and looks for panics in what was linked.

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

use core::hint::black_box;
use spherule_kernel::camera::Projection;
use spherule_kernel::{
    Accuracy, Bvh, BvhLeaf, BvhNode, Camera, DepthOrder, Exact, Fast, Hit, HitPacket, Lanes, Ray,
    RayPacket, Sphere, SpherePacket, Spheres, Stable, Vec3, Viewpoint, any, bvh, f32x4, f32x8,
    f32x16, float_environment_is_sound, nearest, nearest_hit, pairs, roots, tiles,
};

/// What a firmware does in its own way; without `std` there must be one.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Takes every public way through the kernel, with numbers that the optimiser does not know.
///
/// Answers a digest of the hits, so that nothing can be left out.
///
/// # Safety
/// `numbers` points to `count` numbers that nobody writes meanwhile, or is null.
// Unsafe code: a C interface takes raw memory, and its symbol name is unchecked.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spherule_no_std(numbers: *const f32, count: usize) -> u32 {
    if numbers.is_null() {
        return 0;
    }
    // SAFETY: promised by the caller.
    let numbers = unsafe { core::slice::from_raw_parts(numbers, count) };
    let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
    let vector = |index: usize| Vec3::new(number(index), number(index + 1), number(index + 2));

    let quarter = |nth: usize| numbers.get(nth * (count / 4)..(nth + 1) * (count / 4));
    let [Some(x), Some(y), Some(z), Some(r)] = [0, 1, 2, 3].map(quarter) else {
        return 0;
    };
    let Ok(spheres) = Spheres::new(x, y, z, r) else {
        return 0;
    };
    let projection = if number(0) < 0.0 {
        Projection::Parallel { direction: vector(1) }
    } else {
        Projection::Perspective { eye: vector(1) }
    };
    let camera = Camera { projection, corner: vector(4), step_x: vector(7), step_y: vector(10) };

    let mut digest = 0;
    digest ^= tier::<Fast>(&camera, spheres, &vector);
    digest ^= tier::<Stable>(&camera, spheres, &vector);
    digest ^= tier::<Exact>(&camera, spheres, &vector);
    // The same source in every tier and width: of each one.
    digest ^= tree::<Fast, f32>(&camera, spheres);
    digest ^= tree::<Stable, f32x4>(&camera, spheres);
    digest ^= tree::<Exact, f32x16>(&camera, spheres);
    digest ^= u32::from(float_environment_is_sound());
    black_box(digest)
}

fn tier<A: Accuracy>(
    camera: &Camera,
    spheres: Spheres<'_>,
    vector: &impl Fn(usize) -> Vec3,
) -> u32 {
    let ray = Ray { t_max: vector(3).x, ..camera.get_ray(1, 2) };
    let sphere = Sphere { center: vector(5), radius: vector(6).x };
    let root = roots::<A>(&ray, &sphere).map_or(0, |[near, far]| near.to_bits() ^ far.to_bits());
    let single = nearest_hit::<A>(&ray, spheres).map_or(0, digest);
    root ^ single
        ^ width::<A, f32>(camera, spheres, &sphere)
        ^ width::<A, f32x4>(camera, spheres, &sphere)
        ^ width::<A, f32x8>(camera, spheres, &sphere)
        ^ width::<A, f32x16>(camera, spheres, &sphere)
}

fn width<A: Accuracy, L: Lanes<Token = ()>>(
    camera: &Camera,
    spheres: Spheres<'_>,
    sphere: &Sphere,
) -> u32 {
    let mut rays = [camera.packet::<L>(0, 0, 8, 8), camera.packet::<L>(4, 4, 8, 8)];
    rays[1].set(1, &camera.get_ray(7, 7));
    rays[0].set(0, &rays[1].ray(L::COUNT - 1));
    let mut hits = [HitPacket::<L>::none(); 2];
    nearest::<A, L>((), &rays, spheres, &mut hits);
    let mut met = [0; 2];
    any::<A, L>((), &rays, spheres, &mut met);
    let beside = pairs::<A, L>(
        (),
        &RayPacket::<L>::new(&[rays[0].ray(0)]),
        &SpherePacket::<L>::new(&[*sphere]),
    );

    // More memory than most lists of spheres need: too little is a value, too.
    let (mut memory, mut lists) = ([0; 1024], [0; 1000]);
    let viewpoint = match camera.projection {
        Projection::Perspective { eye } => Viewpoint::Origin(eye),
        Projection::Parallel { direction } => Viewpoint::Direction(direction),
    };
    let (mut listed, mut listed_met) = ([HitPacket::<L>::none(); 2], [0; 2]);
    let needed = match DepthOrder::new(spheres, viewpoint, &mut memory) {
        Ok(order) => {
            tiles::nearest::<A, L>((), &rays, spheres, &order, &mut lists, &mut listed);
            tiles::any::<A, L>((), &rays, spheres, &order, &mut lists, &mut listed_met);
            DepthOrder::lists(spheres.len())
        }
        Err(error) => error.needed,
    };

    let mut sum = met[0] ^ met[1] ^ listed_met[0] ^ listed_met[1] ^ needed as u32;
    for packet in hits.iter().chain(&listed).chain([&beside]) {
        for lane in 0..L::COUNT {
            sum ^= packet.hit(lane).map_or(0, digest).rotate_left(lane as u32);
        }
    }
    sum
}

/// By a tree, in memory for some sixty spheres.
fn tree<A: Accuracy, L: Lanes<Token = ()>>(camera: &Camera, spheres: Spheres<'_>) -> u32 {
    let (mut nodes, mut leaves) = ([BvhNode::EMPTY; 3], [BvhLeaf::EMPTY; 5]);
    let tree = match Bvh::build(spheres, &mut nodes, &mut leaves) {
        Ok(tree) => tree,
        Err(error) => return error.needed.leaves as u32,
    };
    let rays = [camera.packet::<L>(0, 0, 8, 8), camera.packet::<L>(4, 4, 8, 8)];
    let (mut hits, mut coherent) = ([HitPacket::<L>::none(); 2], [HitPacket::<L>::none(); 2]);
    bvh::nearest::<A, L>((), &rays, spheres, &tree, &mut hits);
    bvh::nearest_coherent::<A, L>((), &rays, spheres, &tree, &mut coherent);
    let (mut met, mut coherently) = ([0; 2], [0; 2]);
    bvh::any::<A, L>((), &rays, spheres, &tree, &mut met);
    bvh::any_coherent::<A, L>((), &rays, spheres, &tree, &mut coherently);

    let mut sum = met[0] ^ met[1] ^ coherently[0] ^ coherently[1] ^ tree.depth() as u32;
    for packet in hits.iter().chain(&coherent) {
        for lane in 0..L::COUNT {
            sum ^= packet.hit(lane).map_or(0, digest).rotate_left(lane as u32);
        }
    }
    sum ^ tree.size().nodes as u32
}

fn digest(hit: Hit) -> u32 {
    hit.t.to_bits() ^ hit.sphere
}

/// Negative control: memory from the heap, with no allocator in the program.
#[cfg(feature = "alloc")]
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn spherule_alloc(number: f32) -> f32 {
    *black_box(alloc::boxed::Box::new(number))
}

/// Negative control: an index that nothing bounds.
#[cfg(feature = "panic")]
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn spherule_panic(index: usize) -> f32 {
    black_box([0.0, 1.0])[index]
}
