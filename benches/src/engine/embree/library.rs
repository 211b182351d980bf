//! Embree's libraries, opened by name at first use. Their interface is declared by hand, from the headers
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
/// The calls of several rays: they take a flag for each ray first.
type CallMany = unsafe extern "C" fn(*const i32, Handle, *mut c_void, *mut c_void);
/// `rtcIntersect1M`, `rtcOccluded1M` of Embree 3: scene, context, records, how many, and bytes from one to the next.
type CallStream = unsafe extern "C" fn(Handle, *mut c_void, *mut c_void, c_uint, usize);
/// `rtcSetSharedGeometryBuffer`: geometry, kind, slot, format, memory, offset, stride, count.
type SetSharedBuffer =
    unsafe extern "C" fn(Handle, c_int, c_uint, c_int, *const c_void, usize, usize, usize);

/// The functions and constants of one library that are used here.
pub(crate) struct Library {
    /// The name with the version that the library reports.
    pub(crate) name: String,
    /// Whether it is Embree 3, not 4.
    pub(super) is_3: bool,
    /// The flag for coherent rays.
    pub(super) coherent: c_int,
    /// How many 32-bit members a record of a ray and its hit has.
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
    /// The calls of 4, 8 and 16 rays.
    pub(super) intersect: [CallMany; 3],
    pub(super) occluded: [CallMany; 3],
    /// `None` in Embree 4, which has no streams.
    pub(super) intersect_stream: Option<CallStream>,
    pub(super) occluded_stream: Option<CallStream>,
    /// Keeps the file open that the functions are in.
    _file: File,
}

/// The libraries that the variable `SPHERULE_EMBREE` names: names or paths with colons between them. Unset, the system's Embree 3.
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
        /// The device property that holds the version.
        const VERSION: c_int = 0;
        // SAFETY: the caller named the library, and answers for what it does when it is opened.
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

/// Returns the function called `name`.
///
/// # Safety
/// The function has the type `F`, and is not called after the file is closed.
unsafe fn function<F: Copy>(file: &File, name: &str) -> F {
    // SAFETY: as the caller promises.
    let symbol = unsafe { file.get::<F>(name.as_bytes()) };
    *symbol.unwrap_or_else(|error| panic!("{name}: {error}"))
}
