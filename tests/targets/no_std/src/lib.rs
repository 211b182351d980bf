//! The kernel in a program without `std`, heap or unwinding: if this links, it needs none of them.
//!
//! `prove` builds it, builds its negative controls, and looks for panics in the linked program.

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod every_way;

use core::hint::black_box;
use every_way::Sum;
#[cfg(feature = "vectors")]
use spherule_kernel::{AnyHit, ClosestHit, RayPacket, Trace, f32x4, f32x16, stages};
use spherule_kernel::{
    Camera, Projection, Ray, Sphere, Spheres, Tier, Vec3, discriminant, float_environment_is_sound,
    roots,
};

/// A firmware has its own panic handler; without `std` there must be one.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Takes every public way through the kernel, with numbers that the optimiser does not know.
///
/// Returns a digest of the answers, so that the optimiser can leave nothing out.
///
/// # Safety
/// `numbers` points to `count` numbers that do not change meanwhile, or is null.
// Unsafe code: a C interface takes raw memory, and its symbol name is unchecked.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spherule_no_std(numbers: *const f32, count: usize) -> u32 {
    if numbers.is_null() {
        return 0;
    }
    // SAFETY: the caller promises it.
    let numbers = unsafe { core::slice::from_raw_parts(numbers, count) };
    let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
    let vector = |index: usize| Vec3::new(number(index), number(index + 1), number(index + 2));

    let quarter =
        |nth: usize| numbers.get(nth * (count / 4)..(nth + 1) * (count / 4)).unwrap_or_default();
    let Ok(spheres) = Spheres::new(quarter(0), quarter(1), quarter(2), quarter(3)) else {
        return 0;
    };
    let projection = if number(0) < 0.0 {
        Projection::Parallel { direction: vector(1) }
    } else {
        Projection::Perspective { eye: vector(1) }
    };
    let camera = Camera { projection, corner: vector(4), step_x: vector(7), step_y: vector(10) };

    let tier = match number(13) {
        0.0 => Tier::Fast,
        1.0 => Tier::Stable,
        2.0 => Tier::Geometric,
        _ => Tier::Exact,
    };
    let mut rays = [Ray::INACTIVE; 20];
    for (index, ray) in rays.iter_mut().enumerate() {
        *ray = Ray { t_max: number(index), ..camera.get_ray(index as u32, 2) };
    }
    let sphere = Sphere { center: vector(5), radius: number(6) };

    let mut sum = Sum::NONE;
    if cfg!(feature = "four") {
        sum.four_lanes(tier, &camera, spheres);
        return black_box(sum.words());
    }
    sum.structure(tier, &camera, &rays, &mut [], &spheres);
    #[cfg(feature = "vectors")]
    {
        sum.lanes::<f32x4>(tier, &camera, &mut Trace::new(), &spheres);
        sum.lanes::<f32x16>(tier, &camera, &mut Trace::new(), &spheres);
    }
    sum.bvh4(tier, &camera, &rays, spheres);
    #[cfg(feature = "structures")]
    sum.structures(tier, &camera, &rays, spheres);
    sum.pairs(tier, &rays, &sphere);
    sum.objects(tier, &rays, spheres);
    sum.surface(tier, &rays[3], spheres);
    #[cfg(feature = "vectors")]
    sum.surfaces(tier, &rays, spheres);
    sum.word(
        roots(tier, &rays[1], &sphere).map_or(0, |[near, far]| near.to_bits() ^ far.to_bits()),
    );
    sum.word(discriminant(&rays[1], &sphere).map_or(0, |(d, bound)| u32::from(bound < d)));
    #[cfg(feature = "vectors")]
    {
        let packets = [RayPacket::new(&rays)];
        sum.word(stages(ClosestHit, &packets, spheres).tests as u32);
        sum.word(stages(AnyHit, &packets, spheres).tests as u32);
    }
    sum.word(u32::from(float_environment_is_sound()));
    black_box(sum.words())
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
