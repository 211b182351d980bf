//! The libraries, opened by name when they are first asked for. Their interface is declared by hand, from the headers
//! `rtcore_{device,geometry,scene,ray,common}.h`.

use core::ffi::{c_char, c_int, c_uint, c_void};
use libloading::Library as File;
use std::env;
use std::ffi::OsStr;
use std::sync::OnceLock;

/// An opaque object of the library.
pub(super) type Handle = *mut c_void;
/// `rtcIntersect1`, `rtcOccluded1`: the scene, then context and record (Embree 3) or record and arguments (4).
type CallOne = unsafe extern "C" fn(Handle, *mut c_void, *mut c_void);
/// Those of more rays: a flag for each ray before.
type CallMany = unsafe extern "C" fn(*const i32, Handle, *mut c_void, *mut c_void);
/// `rtcIntersect1M`, `rtcOccluded1M` of Embree 3: scene, context, records, how many, and bytes from one to the next.
type CallStream = unsafe extern "C" fn(Handle, *mut c_void, *mut c_void, c_uint, usize);
/// `rtcSetSharedGeometryBuffer`: geometry, kind, slot, format, memory, offset, stride, count.
type SetSharedBuffer =
    unsafe extern "C" fn(Handle, c_int, c_uint, c_int, *const c_void, usize, usize, usize);

/// What is used of a library.
pub(crate) struct Library {
    /// With its version, as it says it.
    pub(crate) name: String,
    /// Whether it is Embree 3, not 4.
    pub(super) is_3: bool,
    /// The flag for rays that have something in common.
    pub(super) coherent: c_int,
    /// 32-bit members of a record of a ray and its hit.
    pub(super) members: usize,
    pub(super) new_device: unsafe extern "C" fn(*const c_char) -> Handle,
    pub(super) release_device: unsafe extern "C" fn(Handle),
    pub(super) device_error: unsafe extern "C" fn(Handle) -> c_int,
    pub(super) new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle,
    pub(super) set_shared_buffer: SetSharedBuffer,
    pub(super) commit_geometry: unsafe extern "C" fn(Handle),
    pub(super) release_geometry: unsafe extern "C" fn(Handle),
    pub(super) new_scene: unsafe extern "C" fn(Handle) -> Handle,
    pub(super) attach_geometry: unsafe extern "C" fn(Handle, Handle) -> c_uint,
    pub(super) commit_scene: unsafe extern "C" fn(Handle),
    pub(super) release_scene: unsafe extern "C" fn(Handle),
    pub(super) intersect1: CallOne,
    pub(super) occluded1: CallOne,
    /// Of 4, 8 and 16 rays.
    pub(super) intersect: [CallMany; 3],
    pub(super) occluded: [CallMany; 3],
    /// Embree 4 has no streams.
    pub(super) intersect_stream: Option<CallStream>,
    pub(super) occluded_stream: Option<CallStream>,
    /// The functions are in it.
    _file: File,
}

/// Those of the variable `SPHERULE_EMBREE`, names or paths with colons between them; Embree 3 of the system unless said.
///
/// # Panics
/// If one cannot be opened.
pub(crate) fn libraries() -> &'static [Library] {
    static LIBRARIES: OnceLock<Vec<Library>> = OnceLock::new();
    LIBRARIES.get_or_init(|| {
        let names = env::var_os("SPHERULE_EMBREE").unwrap_or_else(|| "libembree3.so.3".into());
        env::split_paths(&names).map(|name| Library::open(name.as_os_str())).collect()
    })
}

impl Library {
    fn open(path: &OsStr) -> Self {
        /// The property of a device that is the version.
        const VERSION: c_int = 0;
        // SAFETY: what a library does when it is opened is the caller's to answer for, who named it.
        let file = unsafe { File::new(path) };
        let file = file.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        // SAFETY, here and below: the type is that of the headers, and the file is kept with the function.
        let new_device: unsafe extern "C" fn(*const c_char) -> Handle =
            unsafe { function(&file, "rtcNewDevice") };
        let release_device: unsafe extern "C" fn(Handle) =
            unsafe { function(&file, "rtcReleaseDevice") };
        let property: unsafe extern "C" fn(Handle, c_int) -> isize =
            unsafe { function(&file, "rtcGetDeviceProperty") };
        // SAFETY: the configuration ends with a zero; the device is one of this library.
        let version = unsafe {
            let device = new_device(c"threads=1".as_ptr());
            let version = property(device, VERSION);
            release_device(device);
            version
        };
        let (major, minor) = (version / 10_000, version / 100 % 100);
        assert!(major == 3 || major == 4, "{}: Embree {major}", path.display());
        let is_3 = major == 3;
        unsafe {
            Self {
                name: format!("Embree {major}.{minor}"),
                is_3,
                coherent: if is_3 { 1 } else { 1 << 16 },
                members: if is_3 { 20 } else { 21 },
                new_device,
                release_device,
                device_error: function(&file, "rtcGetDeviceError"),
                new_geometry: function(&file, "rtcNewGeometry"),
                set_shared_buffer: function(&file, "rtcSetSharedGeometryBuffer"),
                commit_geometry: function(&file, "rtcCommitGeometry"),
                release_geometry: function(&file, "rtcReleaseGeometry"),
                new_scene: function(&file, "rtcNewScene"),
                attach_geometry: function(&file, "rtcAttachGeometry"),
                commit_scene: function(&file, "rtcCommitScene"),
                release_scene: function(&file, "rtcReleaseScene"),
                intersect1: function(&file, "rtcIntersect1"),
                occluded1: function(&file, "rtcOccluded1"),
                intersect: ["rtcIntersect4", "rtcIntersect8", "rtcIntersect16"]
                    .map(|name| function(&file, name)),
                occluded: ["rtcOccluded4", "rtcOccluded8", "rtcOccluded16"]
                    .map(|name| function(&file, name)),
                intersect_stream: is_3.then(|| function(&file, "rtcIntersect1M")),
                occluded_stream: is_3.then(|| function(&file, "rtcOccluded1M")),
                _file: file,
            }
        }
    }
}

/// The function of that name.
///
/// # Safety
/// It has the type `F`, and is not called after the file is closed.
unsafe fn function<F: Copy>(file: &File, name: &str) -> F {
    // SAFETY: as the caller promises.
    let symbol = unsafe { file.get::<F>(name.as_bytes()) };
    *symbol.unwrap_or_else(|error| panic!("{name}: {error}"))
}
