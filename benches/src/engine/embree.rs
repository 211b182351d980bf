//! Embree 3 and 4: spheres (`RTC_GEOMETRY_TYPE_SPHERE_POINT`), with the instructions of each of the kernel's levels.
//!
//! The module is behind the feature `embree`, since it opens [libraries] in C that not every machine has.
//!
//! A call is timed as fairly as can be. Embree overwrites its records: so rays are copied into them outside the clock, block by block, and
//! a block is in the cache when it is traced, as the kernel's blocks are. The clock sees nothing but calls of `rtcIntersect*` or
//! `rtcOccluded*`. Embree asks its callers to flush subnormal numbers to zero, and is timed with that. The kernel's `Exact` must not be
//! flushed, so the register is restored after every block, and an assertion checks that.

// A foreign interface and a control register: Rust has neither without `unsafe`. All unsafe code of this crate is here and in the folder
// beside.
#![allow(unsafe_code)]

mod call;
mod library;

pub(crate) use library::{Library, libraries};

use super::{BLOCK, Engine, Label, Promise, Query, Rays, Run};
use crate::rounds::thread_time;
use call::{Call, calls};
use core::arch::asm;
use core::ffi::{c_int, c_uint, c_void};
use library::Handle;
use spherule_kernel::{Hit, LevelName, Ray, Sphere, Spheres};
use std::ptr::{null, null_mut};
use std::rc::Rc;

const SPHERE_POINT: c_int = 50;
const VERTEX_BUFFER: c_int = 1;
const FLOAT4: c_int = 0x9004;
/// `RTC_INVALID_GEOMETRY_ID`.
const NONE: u32 = u32::MAX;

/// `RTCIntersectContext` of Embree 3, of a build with one instance level and no minimal width.
#[repr(C)]
struct Context {
    flags: c_int,
    filter: *const c_void,
    instance: [u32; 1],
}

/// `RTCRayQueryContext` of Embree 4, of a build with one instance level and with arrays of instances. A hit copies both members.
#[repr(C)]
struct QueryContext {
    instance: [u32; 1],
    place: [u32; 1],
}

/// `RTCIntersectArguments` and `RTCOccludedArguments` of Embree 4.
#[repr(C)]
struct Arguments {
    flags: c_int,
    features: c_int,
    context: *mut c_void,
    filter: *const c_void,
    callback: *const c_void,
}

const _: () = assert!(size_of::<Context>() == 24 && size_of::<Arguments>() == 32);
const _: () = assert!(size_of::<QueryContext>() == 8);

/// A device and a scene of spheres, with one thread.
pub(crate) struct Embree {
    library: &'static Library,
    /// The level whose instructions the device uses.
    level: LevelName,
    device: Handle,
    scene: Handle,
    /// Centre and radius. The scene reads them as long as it lives.
    _spheres: Box<[[f32; 4]]>,
    /// The thread's own time of the build, which uses no other thread.
    pub(crate) build_nanoseconds: f64,
}

impl Embree {
    /// Builds a scene of `spheres`: medium quality and no flags, which are the defaults.
    pub(crate) fn build(library: &'static Library, level: LevelName, spheres: Spheres<'_>) -> Self {
        let row = |sphere: Sphere| sphere.center.extend(sphere.radius).to_array();
        let spheres: Box<[[f32; 4]]> = spheres.iter().map(row).collect();
        let configuration = match level {
            LevelName::Baseline => c"threads=1,isa=sse4.2",
            LevelName::Avx2 => c"threads=1,isa=avx2",
            LevelName::Avx512 => c"threads=1,isa=avx512",
            other => unreachable!("Embree is not asked for {other:?}"),
        };
        // SAFETY: the configuration ends with a zero.
        let device = unsafe { (library.new_device)(configuration.as_ptr()) };
        assert!(!device.is_null(), "embree: no device");
        let (buffer, count) = (spheres.as_ptr().cast(), spheres.len());
        let mut scene = null_mut();
        let nanoseconds = flushing(|| {
            // SAFETY: the handles come from the library; the buffer has `count` elements of 16 bytes and lives as long as the scene.
            unsafe {
                let geometry = (library.new_geometry)(device, SPHERE_POINT);
                let (kind, format) = (VERTEX_BUFFER, FLOAT4);
                (library.set_shared_buffer)(geometry, kind, 0, format, buffer, 0, 16, count);
                (library.commit_geometry)(geometry);
                scene = (library.new_scene)(device);
                (library.attach_geometry)(scene, geometry);
                (library.release_geometry)(geometry);
                (library.commit_scene)(scene);
            }
        });
        // SAFETY: a handle from the library.
        let error = unsafe { (library.device_error)(device) };
        assert_eq!(error, 0, "embree: error {error}");
        let build_nanoseconds = nanoseconds as f64;
        Self { library, level, device, scene, _spheres: spheres, build_nanoseconds }
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: handles from the library, released once.
        unsafe {
            (self.library.release_scene)(self.scene);
            (self.library.release_device)(self.device);
        }
    }
}

/// One for each of the device's calls.
pub(crate) fn engines(embree: &Rc<Embree>) -> Vec<Engine> {
    let engine = |call: Call| {
        let lanes = embree.level.as_str();
        let label = Label { way: &embree.library.name, name: call.name, lanes };
        let embree = Rc::clone(embree);
        let ready = move |rays: &Rays| -> Box<dyn Run> {
            let (embree, rays) = (Rc::clone(&embree), Rc::clone(&rays.list));
            Box::new(Calls { embree, call, rays, hits: Vec::new() })
        };
        Engine { label, promise: Promise::EMBREE, most_rays: usize::MAX, ready: Box::new(ready) }
    };
    let has_streams = embree.library.intersect_stream.is_some();
    calls(embree.level, has_streams).into_iter().map(engine).collect()
}

/// One of the calls, with rays.
struct Calls {
    embree: Rc<Embree>,
    call: Call,
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

    /// The time of the calls alone.
    fn time(&mut self, query: Query, runs: usize) -> f64 {
        (0..runs).map(|_| self.pass(query)).sum::<u64>() as f64
    }
}

impl Calls {
    /// Block by block: fills records, calls with the clock running, reads.
    fn pass(&mut self, query: Query) -> u64 {
        let Call { rays: n, is_stream, is_coherent, .. } = self.call;
        let (scene, library) = (self.embree.scene, self.embree.library);
        // `RTCRayHit`, or `RTCRay` alone.
        let (one, many, members) = match query {
            Query::ClosestHit => (library.intersect1, library.intersect, library.members),
            Query::AnyHit => (library.occluded1, library.occluded, RAY),
        };
        let stream = match query {
            Query::ClosestHit => library.intersect_stream,
            Query::AnyHit => library.occluded_stream,
        };
        let stream = stream.filter(|_| is_stream);
        let many = many[n.ilog2().saturating_sub(2) as usize];
        // A record of one ray is aligned to 16 bytes.
        let words = (members * n).next_multiple_of(4);
        let flags = if is_coherent { library.coherent } else { 0 };
        let mut context = Context { flags, filter: null(), instance: [NONE] };
        let mut query_context = QueryContext { instance: [NONE], place: [NONE] };
        let context = &raw mut context;
        let mut arguments = Arguments {
            flags,
            features: -1,
            context: (&raw mut query_context).cast(),
            filter: null(),
            callback: null(),
        };
        let (arguments, valid) = (&raw mut arguments, Valid([-1; 16]));
        let mut memory = vec![0; BLOCK * words / n + 16];
        let aligned = memory.as_ptr().align_offset(64);
        self.hits.clear();
        let mut nanoseconds = 0;
        for block in self.rays.chunks(BLOCK) {
            let records = &mut memory[aligned..][..block.len().div_ceil(n) * words];
            for (record, rays) in records.chunks_exact_mut(words).zip(block.chunks(n)) {
                fill(record, n, rays);
            }
            nanoseconds += flushing(|| {
                if let Some(stream) = stream {
                    let (first, count) = (records.as_mut_ptr().cast(), block.len() as c_uint);
                    // SAFETY: as below; `count` records are there, each of `4 * words` bytes.
                    unsafe { stream(scene, context.cast(), first, count, 4 * words) };
                    return;
                }
                for record in records.chunks_exact_mut(words) {
                    let record = record.as_mut_ptr().cast();
                    // Embree 4 takes the two arguments in the other order.
                    let [first, second] = if library.is_3 {
                        [context.cast(), record]
                    } else {
                        [record, arguments.cast()]
                    };
                    // SAFETY: everything that is pointed to lives. A record has as many rows of `n` words as the call reads and writes. It
                    // is aligned to 4 `n` bytes, or to 16 for one ray, since the first record is aligned to 64.
                    unsafe {
                        match n {
                            1 => one(scene, first, second),
                            _ => many(valid.0.as_ptr(), scene, first, second),
                        }
                    }
                }
            });
            let hit = |index: usize| read(&records[index / n * words..], n, index % n, query);
            self.hits.extend((0..block.len()).map(hit));
        }
        nanoseconds
    }
}

/// How many members of a record belong to the ray.
const RAY: usize = 12;

/// A flag for each ray of a record, aligned as the library asks.
#[repr(align(64))]
struct Valid([i32; 16]);

/// Writes rays into a record of rows of `n` words, one row a member. The last ray fills the lanes that are left.
fn fill(record: &mut [u32], n: usize, rays: &[Ray]) {
    for lane in 0..n {
        let ray = &rays[lane.min(rays.len() - 1)];
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
        let members = [ox, oy, oz, ray.t_min, dx, dy, dz, 0.0, ray.t_max].map(f32::to_bits);
        // Then mask, id and flags; then, of the hit, normal, u, v, and the indices of primitive, geometry and instance. Embree 4 has one
        // more index, of an instance in an array.
        let members =
            members.into_iter().chain([u32::MAX, 0, 0, 0, 0, 0, 0, 0, NONE, NONE, NONE, NONE]);
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
        // Embree sets t to minus infinity for an occluded ray.
        Query::AnyHit => (t < 0.0).then_some(Hit { t: 0.0, sphere: 0 }),
    }
}

/// How many nanoseconds `calls` takes with subnormal numbers flushed to zero, as the library asks of its callers. The register is restored
/// afterwards. `calls` must do no floating-point arithmetic of its own.
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

/// Writes the register if `write` is a value, and reads it.
fn control_and_status(write: Option<u32>) -> u32 {
    let mut register = write.unwrap_or(0);
    // SAFETY: loads and stores four bytes where there are four. The loaded value was stored before, except for two of its defined bits.
    unsafe {
        if write.is_some() {
            asm!("ldmxcsr [{}]", in(reg) &raw const register, options(nostack, readonly));
        }
        asm!("stmxcsr [{}]", in(reg) &raw mut register, options(nostack));
    }
    register
}
