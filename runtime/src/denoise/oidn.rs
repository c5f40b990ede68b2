//! Open Image Denoise 2 as a library that is loaded at run time: the part of its C interface that is used here.
//!
//! # Proof
//!
//! Loading a library runs its code, and calling it relies on its types. The file is one that the user names, that the
//! system's loader would give to any program, or that lies in the user's Python: as trustworthy as `rtr` itself. Types
//! are those of `oidn.h` of 2.0 to 2.5, which keeps them within version 2; a library of another version is refused by
//! the number that a device of it gives, before an image is given to it, and one that lacks a function is as well. A
//! library that is loaded stays until the process ends, so no function is called that is gone. Device and filter are
//! released once, by their owners' `Drop`, filters before their device, which they borrow. Images are slices of three
//! floats a pixel, borrowed mutably as long as their filter lives (`&mut self` keeps that lifetime from being cut
//! short), and no shorter than the size that is given to the library. Filters run to their end within `execute`, and
//! call back within it only: on any thread, a function that reads a `Sync` value which lives until then. No C++
//! exception passes the C interface, which turns them into error codes.
#![expect(unsafe_code, reason = "a C library that is loaded at run time; the proof is above")]

use super::find;
use files::ShowPath as _;
use libloading::Library;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::{Path, PathBuf};
use std::ptr;
use thiserror::Error;

/// `OIDN_DEVICE_TYPE_CPU`.
const CPU: c_int = 1;
/// `OIDN_FORMAT_FLOAT3`.
const FLOAT3: c_int = 3;
/// `OIDN_ERROR_CANCELLED`.
const CANCELLED: c_int = 6;
/// The version whose interface this is.
const MAJOR: c_int = 2;

/// Why there is no denoiser, or what it says.
#[derive(Debug, Error)]
pub enum OidnError {
    /// It is nowhere.
    #[error(
        "Open Image Denoise is not found: `pip install pyoidn`, or get it from \
         https://www.openimagedenoise.org and name its folder with --oidn PATH or OIDN_DIR"
    )]
    NotFound,
    /// It is not where it should be.
    #[error("{by}: there is no Open Image Denoise at {}", path.shown())]
    NotThere {
        /// Who says so.
        by: &'static str,
        /// Where.
        path: PathBuf,
    },
    /// The system cannot load it.
    #[error("cannot load {}: {message}", path.shown())]
    Load {
        /// The library.
        path: PathBuf,
        /// The system's words.
        message: String,
    },
    /// Another library.
    #[error("{} is not Open Image Denoise 2: it has no function `{function}`", path.shown())]
    Foreign {
        /// The library.
        path: PathBuf,
        /// What it lacks.
        function: String,
    },
    /// Another version.
    #[error("{} is Open Image Denoise {version}, but version 2 is needed", path.shown())]
    Version {
        /// The library.
        path: PathBuf,
        /// Its version.
        version: String,
    },
    /// It was told to stop.
    #[error("interrupted")]
    Cancelled,
    /// It refuses.
    #[error("Open Image Denoise: {0}")]
    Said(String),
}

/// Whether the work is in vain, asked on any thread.
pub(super) type IsCancelled<'a> = &'a (dyn Fn() -> bool + Sync);

/// `OIDNProgressMonitorFunction`: gets what it was set with and the share that is done; false cancels.
type Monitor = unsafe extern "C" fn(*mut c_void, f64) -> bool;

/// `OIDNDevice` and `OIDNFilter`.
type Handle = *mut c_void;

/// Declares the functions that are used, and how they are found.
macro_rules! functions {
    ($($name:ident: $symbol:literal, fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        #[derive(Clone, Copy, Debug)]
        struct Functions {
            $($name: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
        }

        impl Functions {
            /// The functions of `library`; the name of the first that it lacks.
            fn of(library: &Library) -> Result<Self, &'static str> {
                Ok(Self {
                    // SAFETY: the types are those of `oidn.h`, if it is the library that has them.
                    $($name: *unsafe { library.get($symbol.as_bytes()) }.map_err(|_| $symbol)?,)*
                })
            }
        }
    };
}

functions! {
    new_device: "oidnNewDevice", fn(c_int) -> Handle;
    release_device: "oidnReleaseDevice", fn(Handle);
    set_device_int: "oidnSetDeviceInt", fn(Handle, *const c_char, c_int);
    get_device_int: "oidnGetDeviceInt", fn(Handle, *const c_char) -> c_int;
    get_device_error: "oidnGetDeviceError", fn(Handle, *mut *const c_char) -> c_int;
    commit_device: "oidnCommitDevice", fn(Handle);
    new_filter: "oidnNewFilter", fn(Handle, *const c_char) -> Handle;
    release_filter: "oidnReleaseFilter", fn(Handle);
    set_image: "oidnSetSharedFilterImage",
        fn(Handle, *const c_char, *mut c_void, c_int, usize, usize, usize, usize, usize);
    set_filter_bool: "oidnSetFilterBool", fn(Handle, *const c_char, bool);
    set_monitor: "oidnSetFilterProgressMonitorFunction", fn(Handle, Monitor, *mut c_void);
    commit_filter: "oidnCommitFilter", fn(Handle);
    execute_filter: "oidnExecuteFilter", fn(Handle);
}

/// The library.
#[derive(Debug)]
pub(super) struct Oidn {
    functions: Functions,
    version: String,
}

impl Oidn {
    /// Finds and loads it; see `Denoiser::open`.
    pub(super) fn open(named: Option<&Path>) -> Result<Self, OidnError> {
        let dir = std::env::var_os("OIDN_DIR").filter(|dir| !dir.is_empty()).map(PathBuf::from);
        let told = [("--oidn", named), ("OIDN_DIR", dir.as_deref())];
        if let Some((by, path)) = told.into_iter().find_map(|(by, path)| Some((by, path?))) {
            let at = find::at(path).ok_or(OidnError::NotThere { by, path: path.to_owned() })?;
            return Self::load(&at);
        }
        for path in find::of_loader().chain(find::of_wheel()) {
            match Self::load(&path) {
                // The loader has not found it.
                Err(OidnError::Load { .. }) if path.is_relative() => {}
                loaded => return loaded,
            }
        }
        Err(OidnError::NotFound)
    }

    fn load(path: &Path) -> Result<Self, OidnError> {
        // SAFETY: whoever named it trusts it.
        let library = unsafe { Library::new(path) }.map_err(|error| {
            let message =
                std::error::Error::source(&error).map_or(error.to_string(), ToString::to_string);
            OidnError::Load { path: path.to_owned(), message: one_line(&message) }
        })?;
        let functions = Functions::of(&library).map_err(|function| OidnError::Foreign {
            path: path.to_owned(),
            function: function.to_owned(),
        })?;
        // It has threads of its own, and stays.
        std::mem::forget(library);
        let mut oidn = Self { functions, version: String::new() };
        let device = oidn.device(None, &|| false)?;
        let [major, minor, patch] =
            [c"versionMajor", c"versionMinor", c"versionPatch"].map(|name| device.int(name));
        drop(device);
        oidn.version = format!("{major}.{minor}.{patch}");
        if major != MAJOR {
            return Err(OidnError::Version { path: path.to_owned(), version: oidn.version });
        }
        Ok(oidn)
    }

    /// `2.5.1`.
    pub(super) fn version(&self) -> &str {
        &self.version
    }

    /// The CPU, which reads the images where they are and gives the same pixels again.
    pub(super) fn device<'a>(
        &'a self,
        threads: Option<usize>,
        is_cancelled: IsCancelled<'a>,
    ) -> Result<Device<'a>, OidnError> {
        // SAFETY: see the proof.
        let handle = unsafe { (self.functions.new_device)(CPU) };
        let device = Device { functions: &self.functions, handle, is_cancelled };
        if handle.is_null() {
            return Err(device.error().unwrap_or(OidnError::Said("it has no device".to_owned())));
        }
        if let Some(threads) = threads.and_then(|n| c_int::try_from(n).ok()) {
            // SAFETY: the device is not null, the name ends with a zero byte.
            unsafe { (self.functions.set_device_int)(handle, c"numThreads".as_ptr(), threads) };
        }
        // SAFETY: the device is not null.
        unsafe { (self.functions.commit_device)(handle) };
        device.error().map_or(Ok(device), Err)
    }
}

/// What computes.
pub(super) struct Device<'a> {
    functions: &'a Functions,
    /// Null where none could be had.
    handle: Handle,
    is_cancelled: IsCancelled<'a>,
}

impl Device<'_> {
    /// Denoises the guide `name` alone, in place.
    pub(super) fn prefilter(
        &self,
        name: &CStr,
        pixels: &mut [[f32; 3]],
        size: [usize; 2],
    ) -> Result<(), OidnError> {
        let mut filter = Filter::new(self)?;
        filter.images([name, c"output"], pixels, size)?;
        filter.run()
    }

    /// Denoises radiance in place, along guides that are without noise.
    pub(super) fn filter(
        &self,
        pixels: &mut [[f32; 3]],
        guides: &mut [(&CStr, Vec<[f32; 3]>)],
        size: [usize; 2],
    ) -> Result<(), OidnError> {
        let mut filter = Filter::new(self)?;
        filter.images([c"color", c"output"], pixels, size)?;
        filter.set(c"hdr");
        if !guides.is_empty() {
            filter.set(c"cleanAux");
        }
        for (name, guide) in guides {
            filter.images([*name], guide, size)?;
        }
        filter.run()
    }

    fn int(&self, name: &CStr) -> c_int {
        // SAFETY: the device is not null, the name ends with a zero byte.
        unsafe { (self.functions.get_device_int)(self.handle, name.as_ptr()) }
    }

    /// What has gone wrong since the last question.
    fn error(&self) -> Option<OidnError> {
        let mut message = ptr::null();
        // SAFETY: null asks for what went wrong without a device; the message is written or left.
        let code = unsafe { (self.functions.get_device_error)(self.handle, &raw mut message) };
        if code == 0 {
            return None;
        }
        if code == CANCELLED {
            return Some(OidnError::Cancelled);
        }
        if message.is_null() {
            return Some(OidnError::Said(format!("error {code}")));
        }
        // SAFETY: a text that ends with a zero byte and stays until the next call; it is copied before.
        let text = unsafe { CStr::from_ptr(message) }.to_string_lossy();
        Some(OidnError::Said(one_line(&text)))
    }
}

impl Drop for Device<'_> {
    fn drop(&mut self) {
        if !self.handle.is_null() {
            // SAFETY: it is released once, by its owner.
            unsafe { (self.functions.release_device)(self.handle) };
        }
    }
}

/// A filter `RT`, for pictures of ray tracers, which has its images for as long as it lives. It runs once.
struct Filter<'a> {
    device: &'a Device<'a>,
    handle: Handle,
}

impl<'a> Filter<'a> {
    fn new(device: &'a Device<'a>) -> Result<Self, OidnError> {
        // SAFETY: the device is not null, the name ends with a zero byte.
        let handle = unsafe { (device.functions.new_filter)(device.handle, c"RT".as_ptr()) };
        if handle.is_null() {
            let error = device.error();
            return Err(error.unwrap_or(OidnError::Said("it has no filter `RT`".to_owned())));
        }
        Ok(Self { device, handle })
    }

    /// Gives `pixels`, as many as `size` says, under each of the names.
    fn images<const N: usize>(
        &mut self,
        names: [&CStr; N],
        pixels: &'a mut [[f32; 3]],
        [w, h]: [usize; 2],
    ) -> Result<(), OidnError> {
        if w.checked_mul(h) != Some(pixels.len()) {
            return Err(OidnError::Said(format!("{} pixels are not {w}x{h}", pixels.len())));
        }
        let pixels = pixels.as_mut_ptr().cast();
        for name in names {
            let set = self.device.functions.set_image;
            // SAFETY: the filter is not null, the name ends with a zero byte, and there are `w * h` pixels, which are
            // borrowed until the filter is gone. Strides of 0 are those of rows and pixels without gaps.
            unsafe { set(self.handle, name.as_ptr(), pixels, FLOAT3, w, h, 0, 0, 0) };
        }
        Ok(())
    }

    fn set(&self, name: &CStr) {
        // SAFETY: the filter is not null, the name ends with a zero byte.
        unsafe { (self.device.functions.set_filter_bool)(self.handle, name.as_ptr(), true) };
    }

    fn run(self) -> Result<(), OidnError> {
        let asked = (&raw const self.device.is_cancelled).cast_mut().cast();
        // SAFETY: the filter is not null, and its images, and whom it asks, are borrowed until this returns.
        unsafe {
            (self.device.functions.set_monitor)(self.handle, goes_on, asked);
            (self.device.functions.commit_filter)(self.handle);
            (self.device.functions.execute_filter)(self.handle);
        }
        self.device.error().map_or(Ok(()), Err)
    }
}

impl Drop for Filter<'_> {
    fn drop(&mut self) {
        // SAFETY: it is released once, by its owner, before its device.
        unsafe { (self.device.functions.release_filter)(self.handle) };
    }
}

/// Whether a filter is to go on.
///
/// # Safety
/// `asked` points to an `IsCancelled`, which lives.
unsafe extern "C" fn goes_on(asked: *mut c_void, _done: f64) -> bool {
    // SAFETY: as the caller promises.
    let is_cancelled = unsafe { *asked.cast_const().cast::<IsCancelled<'_>>() };
    !is_cancelled()
}

/// A message of somebody else's as a part of one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
