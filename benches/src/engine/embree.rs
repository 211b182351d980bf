//! Embree 3: spheres (`RTC_GEOMETRY_TYPE_SPHERE_POINT`) in the system's `libembree3`.
//!
//! Behind the feature `embree`, since it links a C library that not every machine has (Debian: `libembree-dev`, 3.13).
//! Declared by hand, from its headers `rtcore_{device,geometry,scene,ray,common}.h`.
//!
//! A call is timed as fairly as can be: rays are copied into Embree's records outside the clock (Embree overwrites
//! them), block by block, so that a block is in the cache when it is traced; the clock sees nothing but calls of
//! `rtcIntersect*` or `rtcOccluded*`. Embree asks its callers to flush subnormal numbers to zero, and is timed so;
//! the kernel's `Exact` must not be, so the register is put back after every block, and that is asserted.

// A foreign interface and a control register: neither can be had without. Everything that is unsafe in this crate is in
// this file.
#![allow(unsafe_code)]

use super::{Engine, Label, Promise, Query, Rays, Run};
use crate::rounds::thread_time;
use core::arch::asm;
use core::ffi::{c_char, c_int, c_uint, c_void};
use spherule_kernel::{Hit, Ray, Sphere, Spheres};
use spherule_tests::scenes::viewpoint;
use std::ptr::{null, null_mut};
use std::rc::Rc;

const SPHERE_POINT: c_int = 50;
const VERTEX_BUFFER: c_int = 1;
const FLOAT4: c_int = 0x9004;
const COHERENT: c_int = 1;
/// `RTC_INVALID_GEOMETRY_ID`.
const NONE: u32 = u32::MAX;
/// Rays that are copied in, then traced with the clock running, then read back.
const BLOCK: usize = 4096;

/// An opaque object of the library.
type Handle = *mut c_void;
/// `rtcIntersect1`, `rtcOccluded1`: scene, context, a record of one ray.
type CallOne = unsafe extern "C" fn(Handle, *mut Context, *mut u32);
/// Those of more rays: a flag for each ray, scene, context, a record.
type CallMany = unsafe extern "C" fn(*const i32, Handle, *mut Context, *mut u32);

/// `RTCIntersectContext` of a build with one instance level and no minimal width.
#[repr(C)]
struct Context {
    flags: c_int,
    filter: *const c_void,
    instance: [u32; 1],
}

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
    fn rtcAttachGeometry(scene: Handle, geometry: Handle) -> c_uint;
    fn rtcCommitScene(scene: Handle);
    fn rtcReleaseScene(scene: Handle);
    fn rtcIntersect1(scene: Handle, context: *mut Context, record: *mut u32);
    fn rtcIntersect8(valid: *const i32, scene: Handle, context: *mut Context, record: *mut u32);
    fn rtcIntersect16(valid: *const i32, scene: Handle, context: *mut Context, record: *mut u32);
    fn rtcOccluded1(scene: Handle, context: *mut Context, record: *mut u32);
    fn rtcOccluded8(valid: *const i32, scene: Handle, context: *mut Context, record: *mut u32);
    fn rtcOccluded16(valid: *const i32, scene: Handle, context: *mut Context, record: *mut u32);
}

/// A device and a scene of spheres, with one thread.
pub(crate) struct Embree {
    device: Handle,
    scene: Handle,
    /// Centre and radius; the scene reads them as long as it is.
    _spheres: Box<[[f32; 4]]>,
    /// How long the build took, of the thread's own time; it has no other thread.
    pub(crate) build_nanoseconds: f64,
}

impl Embree {
    /// Builds a scene of `spheres`: medium quality and no flags, which are the defaults.
    pub(crate) fn build(spheres: Spheres<'_>) -> Self {
        let row = |sphere: Sphere| sphere.center.extend(sphere.radius).to_array();
        let spheres: Box<[[f32; 4]]> = spheres.iter().map(row).collect();
        // SAFETY: the configuration ends with a zero.
        let device = unsafe { rtcNewDevice(c"threads=1".as_ptr()) };
        assert!(!device.is_null(), "embree: no device");
        let (buffer, count) = (spheres.as_ptr().cast(), spheres.len());
        let mut scene = null_mut();
        let nanoseconds = flushing(|| {
            // SAFETY: the handles come from the library, the buffer has `count` elements of 16 bytes and is kept as
            // long as the scene.
            unsafe {
                let geometry = rtcNewGeometry(device, SPHERE_POINT);
                let (kind, format) = (VERTEX_BUFFER, FLOAT4);
                rtcSetSharedGeometryBuffer(geometry, kind, 0, format, buffer, 0, 16, count);
                rtcCommitGeometry(geometry);
                scene = rtcNewScene(device);
                rtcAttachGeometry(scene, geometry);
                rtcReleaseGeometry(geometry);
                rtcCommitScene(scene);
            }
        });
        // SAFETY: a handle from the library.
        let error = unsafe { rtcGetDeviceError(device) };
        assert_eq!(error, 0, "embree: error {error}");
        Self { device, scene, _spheres: spheres, build_nanoseconds: nanoseconds as f64 }
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

/// The calls of 1, 8 and 16 rays.
pub(crate) fn engines(embree: &Rc<Embree>) -> [Engine; 3] {
    [(1, "1 rays a call"), (8, "8 rays a call"), (16, "16 rays a call")].map(|(n, lanes)| {
        let embree = Rc::clone(embree);
        let ready = move |rays: &Rays| -> Box<dyn Run> {
            let flags = if viewpoint(&rays.list).is_some() { COHERENT } else { 0 };
            let (embree, rays) = (Rc::clone(&embree), Rc::clone(&rays.list));
            Box::new(Calls { embree, n, flags, rays, hits: Vec::new() })
        };
        Engine {
            label: Label { way: "", name: "Embree", lanes },
            promise: Promise::OTHERS,
            most_rays: usize::MAX,
            ready: Box::new(ready),
        }
    })
}

/// Calls of `n` rays.
struct Calls {
    embree: Rc<Embree>,
    n: usize,
    flags: c_int,
    rays: Rc<[Ray]>,
    hits: Vec<Option<Hit>>,
}

impl Run for Calls {
    fn run(&mut self, query: Query) {
        self.pass(query);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        self.hits.clone()
    }

    /// Of the calls alone.
    fn time(&mut self, query: Query, runs: usize) -> f64 {
        (0..runs).map(|_| self.pass(query)).sum::<u64>() as f64
    }
}

impl Calls {
    /// Block by block: fills records, calls with the clock running, reads.
    fn pass(&mut self, query: Query) -> u64 {
        let (n, scene) = (self.n, self.embree.scene);
        let one: [CallOne; 2] = [rtcIntersect1, rtcOccluded1];
        let many: [CallMany; 2] =
            if n == 8 { [rtcIntersect8, rtcOccluded8] } else { [rtcIntersect16, rtcOccluded16] };
        // `RTCRayHit`, or `RTCRay` alone.
        let (which, rows) = if query == Query::ClosestHit { (0, 20) } else { (1, 12) };
        let mut context = Context { flags: self.flags, filter: null(), instance: [NONE] };
        let (context, valid) = (&raw mut context, Valid([-1; 16]));
        let mut memory = vec![0; BLOCK * rows + 16];
        let aligned = memory.as_ptr().align_offset(64);
        self.hits.clear();
        let mut nanoseconds = 0;
        for block in self.rays.chunks(BLOCK) {
            let records = &mut memory[aligned..][..block.len().div_ceil(n) * rows * n];
            for (record, rays) in records.chunks_exact_mut(rows * n).zip(block.chunks(n)) {
                fill(record, n, rays);
            }
            nanoseconds += flushing(|| {
                for record in records.chunks_exact_mut(rows * n) {
                    let record = record.as_mut_ptr();
                    // SAFETY: scene, context and flags live; a record has as many rows of `n` words as the call reads
                    // and writes, and is aligned to 4 `n` bytes, since the first is to 64.
                    unsafe {
                        match n {
                            1 => one[which](scene, context, record),
                            _ => many[which](valid.0.as_ptr(), scene, context, record),
                        }
                    }
                }
            });
            let hit = |index: usize| read(&records[index / n * rows * n..], n, index % n, query);
            self.hits.extend((0..block.len()).map(hit));
        }
        nanoseconds
    }
}

/// A flag for each ray of a record, aligned as the library asks.
#[repr(align(64))]
struct Valid([i32; 16]);

/// Writes rays into a record: rows of `n` words, a member each. The last ray fills up.
fn fill(record: &mut [u32], n: usize, rays: &[Ray]) {
    for lane in 0..n {
        let ray = &rays[lane.min(rays.len() - 1)];
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
        let members = [ox, oy, oz, ray.t_min, dx, dy, dz, 0.0, ray.t_max].map(f32::to_bits);
        // Then mask, id and flags; of the hit normal, u, v, and the indices of primitive, geometry and instance.
        let members = members.into_iter().chain([u32::MAX, 0, 0, 0, 0, 0, 0, 0, NONE, NONE, NONE]);
        for (row, member) in record.chunks_exact_mut(n).zip(members) {
            row[lane] = member;
        }
    }
}

fn read(record: &[u32], n: usize, lane: usize, query: Query) -> Option<Hit> {
    let member = |row: usize| record[row * n + lane];
    let t = f32::from_bits(member(8));
    match query {
        Query::ClosestHit => (member(18) != NONE).then(|| Hit { t, sphere: member(17) }),
        // An occluded ray ends at minus infinity.
        Query::AnyHit => (t < 0.0).then_some(Hit { t: 0.0, sphere: 0 }),
    }
}

/// How many nanoseconds calls of the library take with subnormal numbers flushed to zero, as it asks of its callers;
/// the register is put back. `calls` must do no floating-point arithmetic of its own.
fn flushing(calls: impl FnOnce()) -> u64 {
    /// Results (bit 15) and operands (bit 6) that are subnormal become zero.
    const FLUSH: u32 = 1 << 15 | 1 << 6;
    let before = control_and_status(None);
    control_and_status(Some(before | FLUSH));
    let start = thread_time();
    calls();
    let nanoseconds = thread_time() - start;
    control_and_status(Some(before));
    assert_eq!(control_and_status(None), before, "the floating-point environment was not restored");
    nanoseconds
}

/// Writes the register if there is something to write, and reads it.
fn control_and_status(write: Option<u32>) -> u32 {
    let mut register = write.unwrap_or(0);
    // SAFETY: loads and stores four bytes where there are four; what is loaded was stored before, but for two of its
    // defined bits.
    unsafe {
        if write.is_some() {
            asm!("ldmxcsr [{}]", in(reg) &raw const register, options(nostack, readonly));
        }
        asm!("stmxcsr [{}]", in(reg) &raw mut register, options(nostack));
    }
    register
}
