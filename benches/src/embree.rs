//! Embree 3 as a peer: spheres (`RTC_GEOMETRY_TYPE_SPHERE_POINT`) in the system's `libembree3`.
//!
//! Behind the feature `embree`, since it links a C library that not every machine has (Debian:
//! `libembree-dev`, 3.13). Declared by hand: thirteen functions and three structures of its headers
//! `rtcore_{device,geometry,scene,ray,common}.h`.
//!
//! A call is timed as fairly as can be: rays are copied into Embree's records outside the clock
//! (Embree overwrites them), block by block, so that a block is in the cache when it is traced; the
//! clock sees nothing but calls of `rtcIntersect*` or `rtcOccluded*`. Embree asks its callers to
//! flush subnormal numbers to zero, and is timed so, on a thread of its own; the kernel's `Exact`
//! must not be, so the register is put back after every block, and that is asserted.

// A foreign interface and a control register: neither can be had without. Everything that is unsafe
// in this crate is in this file.
#![allow(unsafe_code)]

use crate::rounds::busy_nanoseconds;
use core::arch::asm;
use core::ffi::{c_char, c_int, c_uint, c_void};
use spherule_kernel::{Hit, Question, Ray, Spheres};
use std::ptr::null_mut;

const SPHERE_POINT: c_int = 50;
const VERTEX_BUFFER: c_int = 1;
const FLOAT4: c_int = 0x9004;
const MEDIUM_QUALITY: c_int = 1;
const COHERENT: c_int = 1;
/// `RTC_INVALID_GEOMETRY_ID`.
const NONE: u32 = u32::MAX;
/// Rays that are copied in, then traced with the clock running, then read back.
const BLOCK: usize = 4096;

/// An opaque object of the library.
type Handle = *mut c_void;

/// `RTCIntersectContext` of a build with one instance level and no minimal width.
#[repr(C)]
struct Context {
    flags: c_int,
    filter: *const c_void,
    instance: [u32; 1],
}

#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct Align16;
#[derive(Clone, Copy)]
#[repr(C, align(32))]
struct Align32;
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Align64;

/// `RTCRay`, `RTCRay8` and `RTCRay16`: the same members, N of each, aligned as `A` is.
#[derive(Clone, Copy)]
#[repr(C)]
struct RayRecord<A, const N: usize> {
    align: [A; 0],
    origin: [[f32; N]; 3],
    near: [f32; N],
    direction: [[f32; N]; 3],
    time: [f32; N],
    far: [f32; N],
    mask: [u32; N],
    id: [u32; N],
    flags: [u32; N],
}

/// `RTCRayHit`, `RTCRayHit8` and `RTCRayHit16`.
#[derive(Clone, Copy)]
#[repr(C)]
struct HitRecord<A, const N: usize> {
    ray: RayRecord<A, N>,
    normal: [[f32; N]; 3],
    u: [f32; N],
    v: [f32; N],
    primitive: [u32; N],
    geometry: [u32; N],
    instance: [u32; N],
}

// As the C compiler lays them out.
const _: () = assert!(size_of::<RayRecord<Align16, 1>>() == 48);
const _: () = assert!(size_of::<HitRecord<Align16, 1>>() == 80);
const _: () = assert!(size_of::<RayRecord<Align32, 8>>() == 384);
const _: () = assert!(size_of::<HitRecord<Align32, 8>>() == 640);
const _: () = assert!(size_of::<RayRecord<Align64, 16>>() == 768);
const _: () = assert!(size_of::<HitRecord<Align64, 16>>() == 1280);
const _: () = assert!(size_of::<Context>() == 24);

#[link(name = "embree3")]
unsafe extern "C" {
    fn rtcNewDevice(config: *const c_char) -> Handle;
    fn rtcReleaseDevice(device: Handle);
    fn rtcGetDeviceError(device: Handle) -> c_int;
    fn rtcNewGeometry(device: Handle, kind: c_int) -> Handle;
    fn rtcSetSharedGeometryBuffer(
        geometry: Handle,
        kind: c_int,
        slot: c_uint,
        format: c_int,
        pointer: *const c_void,
        offset: usize,
        stride: usize,
        count: usize,
    );
    fn rtcCommitGeometry(geometry: Handle);
    fn rtcReleaseGeometry(geometry: Handle);
    fn rtcNewScene(device: Handle) -> Handle;
    fn rtcSetSceneBuildQuality(scene: Handle, quality: c_int);
    fn rtcAttachGeometry(scene: Handle, geometry: Handle) -> c_uint;
    fn rtcCommitScene(scene: Handle);
    fn rtcReleaseScene(scene: Handle);
    fn rtcIntersect1(scene: Handle, context: *mut Context, ray: *mut c_void);
    fn rtcIntersect8(valid: *const i32, scene: Handle, context: *mut Context, rays: *mut c_void);
    fn rtcIntersect16(valid: *const i32, scene: Handle, context: *mut Context, rays: *mut c_void);
    fn rtcOccluded1(scene: Handle, context: *mut Context, ray: *mut c_void);
    fn rtcOccluded8(valid: *const i32, scene: Handle, context: *mut Context, rays: *mut c_void);
    fn rtcOccluded16(valid: *const i32, scene: Handle, context: *mut Context, rays: *mut c_void);
}

/// How many rays a call is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// `rtcIntersect1`, `rtcOccluded1`.
    One,
    /// `rtcIntersect8`, `rtcOccluded8`.
    Eight,
    /// `rtcIntersect16`, `rtcOccluded16`.
    Sixteen,
}

impl Width {
    /// All three.
    pub const ALL: [Self; 3] = [Self::One, Self::Eight, Self::Sixteen];

    /// As it stands in the names of the functions.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::One => "1",
            Self::Eight => "8",
            Self::Sixteen => "16",
        }
    }
}

/// All rays once.
#[derive(Clone, Debug)]
pub struct Pass {
    /// In the calls alone, of the thread's own time.
    pub nanoseconds: u64,
    /// A hit or none for every ray; of a question for any hit, which sphere and where mean nothing.
    pub hits: Vec<Option<Hit>>,
}

/// A device and a scene of spheres, with one thread.
#[derive(Debug)]
pub struct Embree {
    device: Handle,
    scene: Handle,
    /// Center and radius; the scene reads them as long as it is.
    spheres: Box<[[f32; 4]]>,
    build_nanoseconds: u64,
}

// SAFETY: the library's functions may be called from any thread ("the Embree API is thread-safe
// unless stated otherwise"); tracing does not change a committed scene.
unsafe impl Send for Embree {}
// SAFETY: as above.
unsafe impl Sync for Embree {}

impl Embree {
    /// Builds a scene of `spheres`, on a thread of its own: medium quality, no flags.
    ///
    /// # Panics
    /// Where the library reports an error.
    #[must_use]
    pub fn build(spheres: Spheres<'_>) -> Self {
        let build = || Self::build_here(spheres);
        std::thread::scope(|scope| scope.spawn(build).join().expect("embree's thread panicked"))
    }

    fn build_here(spheres: Spheres<'_>) -> Self {
        let of = |sphere: spherule_kernel::Sphere| sphere.center.extend(sphere.radius).to_array();
        let spheres: Box<[[f32; 4]]> = spheres.iter().map(of).collect();
        // SAFETY: the configuration ends with a zero.
        let device = unsafe { rtcNewDevice(c"threads=1".as_ptr()) };
        assert!(!device.is_null(), "embree: no device");
        let (buffer, count) = (spheres.as_ptr(), spheres.len());
        let mut scene = null_mut();
        let build_nanoseconds = flushing(|| {
            let start = busy_nanoseconds();
            // SAFETY: the handles come from the library, the buffer has `count` elements of 16
            // bytes and is kept as long as the scene.
            unsafe {
                let geometry = rtcNewGeometry(device, SPHERE_POINT);
                let (format, stride) = (FLOAT4, 16);
                let buffer = buffer.cast();
                rtcSetSharedGeometryBuffer(
                    geometry,
                    VERTEX_BUFFER,
                    0,
                    format,
                    buffer,
                    0,
                    stride,
                    count,
                );
                rtcCommitGeometry(geometry);
                scene = rtcNewScene(device);
                rtcSetSceneBuildQuality(scene, MEDIUM_QUALITY);
                rtcAttachGeometry(scene, geometry);
                rtcReleaseGeometry(geometry);
                rtcCommitScene(scene);
            }
            busy_nanoseconds() - start
        });
        // SAFETY: a handle from the library.
        let error = unsafe { rtcGetDeviceError(device) };
        assert_eq!(error, 0, "embree: error {error}");
        Self { device, scene, spheres, build_nanoseconds }
    }

    /// How long the build took, of the thread's own time; it has no other thread.
    #[must_use]
    pub const fn build_nanoseconds(&self) -> u64 {
        self.build_nanoseconds
    }

    /// How many spheres.
    #[must_use]
    pub fn len(&self) -> usize {
        self.spheres.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.spheres.is_empty()
    }

    /// Traces every ray once, on a thread of its own; `coherent` says that neighbours among the
    /// rays are alike.
    ///
    /// # Panics
    /// Where the thread does, or leaves the floating-point environment changed.
    #[must_use]
    pub fn pass(&self, width: Width, question: Question, coherent: bool, rays: &[Ray]) -> Pass {
        let pass = || match (width, question) {
            (Width::One, Question::Nearest) => {
                self.nearest::<Align16, 1>(coherent, rays, |scene, context, _, record| {
                    // SAFETY: see `blocks`.
                    unsafe { rtcIntersect1(scene, context, record) }
                })
            }
            (Width::Eight, Question::Nearest) => {
                self.nearest::<Align32, 8>(coherent, rays, |scene, context, valid, record| {
                    // SAFETY: see `blocks`.
                    unsafe { rtcIntersect8(valid, scene, context, record) }
                })
            }
            (Width::Sixteen, Question::Nearest) => {
                self.nearest::<Align64, 16>(coherent, rays, |scene, context, valid, record| {
                    // SAFETY: see `blocks`.
                    unsafe { rtcIntersect16(valid, scene, context, record) }
                })
            }
            (Width::One, Question::Any) => {
                self.any::<Align16, 1>(coherent, rays, |scene, context, _, record| {
                    // SAFETY: see `blocks`.
                    unsafe { rtcOccluded1(scene, context, record) }
                })
            }
            (Width::Eight, Question::Any) => {
                self.any::<Align32, 8>(coherent, rays, |scene, context, valid, record| {
                    // SAFETY: see `blocks`.
                    unsafe { rtcOccluded8(valid, scene, context, record) }
                })
            }
            (Width::Sixteen, Question::Any) => {
                self.any::<Align64, 16>(coherent, rays, |scene, context, valid, record| {
                    // SAFETY: see `blocks`.
                    unsafe { rtcOccluded16(valid, scene, context, record) }
                })
            }
        };
        std::thread::scope(|scope| scope.spawn(pass).join().expect("embree's thread panicked"))
    }

    fn nearest<A: Copy, const N: usize>(
        &self,
        coherent: bool,
        rays: &[Ray],
        call: impl Fn(Handle, *mut Context, *const i32, *mut c_void),
    ) -> Pass {
        let load = |rays: &[Ray]| HitRecord::<A, N> {
            ray: RayRecord::new(rays),
            normal: [[0.0; N]; 3],
            u: [0.0; N],
            v: [0.0; N],
            primitive: [NONE; N],
            geometry: [NONE; N],
            instance: [NONE; N],
        };
        let read = |record: &HitRecord<A, N>, lane: usize| {
            (record.geometry[lane] != NONE)
                .then(|| Hit { t: record.ray.far[lane], sphere: record.primitive[lane] })
        };
        self.blocks::<N, _>(coherent, rays, load, call, read)
    }

    fn any<A: Copy, const N: usize>(
        &self,
        coherent: bool,
        rays: &[Ray],
        call: impl Fn(Handle, *mut Context, *const i32, *mut c_void),
    ) -> Pass {
        // An occluded ray ends at minus infinity.
        let read = |record: &RayRecord<A, N>, lane: usize| {
            (record.far[lane] < 0.0).then_some(Hit { t: 0.0, sphere: 0 })
        };
        self.blocks::<N, _>(coherent, rays, RayRecord::<A, N>::new, call, read)
    }

    /// Block by block: loads records, calls with the clock running, reads.
    ///
    /// `call` gets a scene, a context, N flags and a record that are valid while it runs.
    fn blocks<const N: usize, R>(
        &self,
        coherent: bool,
        rays: &[Ray],
        load: impl Fn(&[Ray]) -> R,
        call: impl Fn(Handle, *mut Context, *const i32, *mut c_void),
        read: impl Fn(&R, usize) -> Option<Hit>,
    ) -> Pass {
        let flags = if coherent { COHERENT } else { 0 };
        let mut context = Context { flags, filter: null_mut(), instance: [NONE] };
        let valid = Valid([-1; 16]);
        let mut pass = Pass { nanoseconds: 0, hits: Vec::with_capacity(rays.len()) };
        let mut records = Vec::with_capacity(BLOCK / N);
        for block in rays.chunks(BLOCK) {
            records.clear();
            records.extend(block.chunks(N).map(&load));
            pass.nanoseconds += flushing(|| {
                let start = busy_nanoseconds();
                for record in &mut records {
                    let record = std::ptr::from_mut(record).cast();
                    call(self.scene, &raw mut context, valid.0.as_ptr(), record);
                }
                busy_nanoseconds() - start
            });
            let hits = (0..block.len()).map(|index| read(&records[index / N], index % N));
            pass.hits.extend(hits);
        }
        pass
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: handles from the library, released once.
        unsafe {
            rtcReleaseScene(self.scene);
            rtcReleaseDevice(self.device);
        }
    }
}

/// A flag for each ray of a packet, aligned as the library asks.
#[repr(align(64))]
struct Valid([i32; 16]);

impl<A, const N: usize> RayRecord<A, N> {
    /// The rays; the last one again where there are fewer than N.
    fn new(rays: &[Ray]) -> Self {
        let ray = |lane: usize| &rays[lane.min(rays.len() - 1)];
        Self {
            align: [],
            origin: [0, 1, 2].map(|axis| std::array::from_fn(|lane| ray(lane).origin[axis])),
            near: std::array::from_fn(|lane| ray(lane).t_min),
            direction: [0, 1, 2].map(|axis| std::array::from_fn(|lane| ray(lane).direction[axis])),
            time: [0.0; N],
            far: std::array::from_fn(|lane| ray(lane).t_max),
            mask: [u32::MAX; N],
            id: [0; N],
            flags: [0; N],
        }
    }
}

/// Runs calls of the library with subnormal numbers flushed to zero, as it asks of its callers, and
/// puts the register back. `calls` must do no floating-point arithmetic of its own.
fn flushing<T>(calls: impl FnOnce() -> T) -> T {
    /// Results (bit 15) and operands (bit 6) that are subnormal become zero.
    const FLUSH: u32 = 1 << 15 | 1 << 6;
    let before = control_and_status();
    set_control_and_status(before | FLUSH);
    let result = calls();
    set_control_and_status(before);
    assert_eq!(control_and_status(), before, "the floating-point environment was not restored");
    result
}

fn control_and_status() -> u32 {
    let mut register = 0_u32;
    // SAFETY: stores four bytes where there are four.
    unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut register, options(nostack)) };
    register
}

fn set_control_and_status(register: u32) {
    // SAFETY: loads four bytes; the value is one that was stored, with two of its defined bits set.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const register, options(nostack, readonly)) };
}
