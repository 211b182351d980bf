//! The lecture's picture in characters, from a Cortex-M4F: a camera goes once around two spheres.
//!
//! No heap, no formatting, no panic. `run` builds it, and draws in qemu. The picture comes by semihosting; from a
//! board it comes through a debugger.

#![no_std]
#![no_main]

mod hardware_root;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hio};
use hardware_root::HardwareRoot;
use spherule_kernel::{
    Camera, Exact, HitPacket, Intersect, Projection, Ray, RayPacket, Sphere, Spheres, Trace, Vec3,
    float_environment_is_sound, surface,
};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 24;
/// How many pictures make a turn.
const PICTURES: u32 = 8;
/// The characters of surfaces, from those that face away from the light to those that face it.
const SHADES: &[u8; 10] = b".:-=+*#%@@";

// x, y, z and radius, in flash.
static X: [f32; 2] = [-0.9, 0.9];
static Y: [f32; 2] = [0.0, 0.2];
static Z: [f32; 2] = [0.5, -0.5];
static RADIUS: [f32; 2] = [1.0, 0.9];

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[entry]
fn main() -> ! {
    let status = if draw_all() { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE };
    debug::exit(status);
    loop {}
}

/// Draws a turn; false if there is nowhere to draw, or the processor does not compute as it must.
fn draw_all() -> bool {
    if !float_environment_is_sound() {
        return false;
    }
    let (Ok(mut screen), Ok(spheres)) = (hio::hstdout(), Spheres::new(&X, &Y, &Z, &RADIUS)) else {
        return false;
    };
    // An eighth of a turn: cosine and sine.
    let (mut eye, turn) = (Vec3::new(0.0, 0.0, 5.0), core::f32::consts::FRAC_1_SQRT_2);
    for _ in 0..PICTURES {
        let camera = camera_at(eye);
        for y in 0..HEIGHT {
            let mut line = [b'\n'; WIDTH as usize + 1];
            for (character, x) in line.iter_mut().zip(0..WIDTH) {
                *character = shade(spheres, &camera.get_ray(x, y));
            }
            if screen.write_all(&line).is_err() {
                return false;
            }
        }
        eye = Vec3::new(turn * (eye.x + eye.z), 0.0, turn * (eye.z - eye.x));
    }
    true
}

/// A camera that looks at the spheres' middle. A character is twice as high as it is wide.
fn camera_at(eye: Vec3) -> Camera {
    let right = Vec3::new(eye.z, 0.0, -eye.x) * 0.013;
    let down = Vec3::new(0.0, -0.13, 0.0);
    // The centre of the first pixel, from that of the picture.
    let corner = -eye - 0.5 * ((WIDTH - 1) as f32 * right + (HEIGHT - 1) as f32 * down);
    Camera { projection: Projection::Perspective { eye }, corner, step_x: right, step_y: down }
}

/// The character of one ray: decided as in real arithmetic, in one lane with the processor's own root.
fn shade(spheres: Spheres<'_>, ray: &Ray) -> u8 {
    let (rays, mut hits) = ([RayPacket::new(&[*ray])], [HitPacket::none()]);
    spheres.closest_hit_lanes::<HardwareRoot>(Exact, (), &mut Trace::new(), &rays, &mut hits);
    let [hits] = hits;
    let Some(hit) = hits.hit(0) else { return b' ' };
    let Some(sphere) = spheres.get(hit.sphere as usize) else { return b' ' };
    shade_of(ray, hit.t, &sphere)
}

/// The character for how far a surface faces a light at the upper left, behind the camera's first place.
fn shade_of(ray: &Ray, t: f32, sphere: &Sphere) -> u8 {
    let light = Vec3::new(-0.57, 0.57, 0.57);
    let towards = surface(Exact, ray, t, sphere).normal.dot(light).max(0.0);
    SHADES.get((towards * 9.99) as usize).copied().unwrap_or(b'@')
}
