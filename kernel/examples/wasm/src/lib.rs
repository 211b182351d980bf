//! Sixteen rays against a scene, in a module that imports nothing: its host writes rays into memory, calls `trace`, and
//! reads what they hit.

#![no_std]
// Unsafe code: symbols that the host of the module calls.
#![allow(unsafe_code)]

use core::sync::atomic::{AtomicU32, Ordering::Relaxed};
use spherule_kernel::{Exact, HitPacket, Intersect, Ray, RayPacket, Spheres, Trace, Vec3};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

static X: [f32; 2] = [-0.9, 0.9];
static Y: [f32; 2] = [0.0, 0.2];
static Z: [f32; 2] = [-4.0, -5.0];
static RADIUS: [f32; 2] = [1.0, 0.9];

/// The bits of the origin and the direction of each ray, one ray after the other.
static RAYS: [[AtomicU32; 6]; 16] = [const { [const { AtomicU32::new(0) }; 6] }; 16];
/// The bits of t, and the sphere.
static HITS: [[AtomicU32; 2]; 16] = [const { [const { AtomicU32::new(0) }; 2] }; 16];

/// Where the host writes rays: 6 numbers each.
#[unsafe(no_mangle)]
pub extern "C" fn rays() -> *const [AtomicU32; 6] {
    RAYS.as_ptr()
}

/// Where the host reads hits: t, infinite if there is none, and the index of the sphere.
#[unsafe(no_mangle)]
pub extern "C" fn hits() -> *const [AtomicU32; 2] {
    HITS.as_ptr()
}

/// Finds what every ray hits.
#[unsafe(no_mangle)]
pub extern "C" fn trace() {
    let Ok(spheres) = Spheres::new(&X, &Y, &Z, &RADIUS) else { return };
    let mut packet = RayPacket::inactive();
    for (lane, ray) in RAYS.iter().enumerate() {
        let [ox, oy, oz, dx, dy, dz] = ray;
        let vector = |x: &AtomicU32, y: &AtomicU32, z: &AtomicU32| {
            let number = |bits: &AtomicU32| f32::from_bits(bits.load(Relaxed));
            Vec3::new(number(x), number(y), number(z))
        };
        packet.set(lane, &Ray::new(vector(ox, oy, oz), vector(dx, dy, dz)));
    }
    let mut found = [HitPacket::none()];
    spheres.closest_hit_packets(Exact, &mut Trace::new(), &[packet], &mut found);
    let [found] = found;
    for (([t_bits, index], t), sphere) in HITS.iter().zip(found.t()).zip(found.spheres()) {
        t_bits.store(t.to_bits(), Relaxed);
        index.store(*sphere, Relaxed);
    }
}
