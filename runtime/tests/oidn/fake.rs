//! What stands for Open Image Denoise in tests: a library with its functions, whose results are easy to foretell.
//!
//! A guide alone becomes half of itself. A picture becomes itself plus its guides, as they are given. `FAKE_OIDN` in the
//! environment makes it fail (`fail`), give infinity (`infinite`), be version 3 (`newer`), or interrupt the process and wait
//! until it is told to stop (`interrupt`).

#![allow(non_snake_case, reason = "names of the C interface")]

use std::collections::BTreeMap;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// `SIGINT`.
const INTERRUPT: c_int = 2;

static ERROR: Mutex<Option<CString>> = Mutex::new(None);

#[derive(Default)]
struct Filter {
    images: BTreeMap<String, (*mut [f32; 3], usize)>,
    flags: Vec<String>,
    monitor: Option<(Monitor, *mut c_void)>,
}

type Monitor = unsafe extern "C" fn(*mut c_void, f64) -> bool;

unsafe extern "C" {
    fn raise(signal: c_int) -> c_int;
}

fn says(mode: &str) -> bool {
    std::env::var("FAKE_OIDN").is_ok_and(|found| found == mode)
}

fn fail(text: &str) {
    *ERROR.lock().unwrap() = CString::new(text).ok();
}

unsafe fn text(name: *const c_char) -> String {
    unsafe { CStr::from_ptr(name) }.to_str().unwrap().to_owned()
}

#[unsafe(no_mangle)]
extern "C" fn oidnNewDevice(kind: c_int) -> *mut c_void {
    assert_eq!(kind, 1, "the CPU");
    Box::into_raw(Box::new(0_u8)).cast()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnReleaseDevice(device: *mut c_void) {
    drop(unsafe { Box::<u8>::from_raw(device.cast()) });
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnSetDeviceInt(_: *mut c_void, name: *const c_char, value: c_int) {
    if unsafe { text(name) } != "numThreads" || value < 1 {
        fail("an unknown parameter");
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnGetDeviceInt(_: *mut c_void, name: *const c_char) -> c_int {
    match unsafe { text(name) }.as_str() {
        "versionMajor" if says("newer") => 3,
        "versionMajor" => 2,
        "versionMinor" => 99,
        _ => 7,
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnGetDeviceError(_: *mut c_void, message: *mut *const c_char) -> c_int {
    let error = ERROR.lock().unwrap().take();
    let code = error.as_ref().map_or(0, |text| if text.as_bytes() == b"cancelled" { 6 } else { 1 });
    // Small, and few.
    unsafe { *message = error.map_or(ptr::null(), |error| error.into_raw().cast_const()) };
    code
}

#[unsafe(no_mangle)]
extern "C" fn oidnCommitDevice(_: *mut c_void) {}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnNewFilter(_: *mut c_void, kind: *const c_char) -> *mut c_void {
    assert_eq!(unsafe { text(kind) }, "RT");
    Box::into_raw(Box::<Filter>::default()).cast()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnReleaseFilter(filter: *mut c_void) {
    drop(unsafe { Box::<Filter>::from_raw(filter.cast()) });
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnSetSharedFilterImage(
    filter: *mut c_void,
    name: *const c_char,
    pixels: *mut c_void,
    format: c_int,
    w: usize,
    h: usize,
    offset: usize,
    pixel_stride: usize,
    row_stride: usize,
) {
    assert_eq!((format, offset, pixel_stride, row_stride), (3, 0, 0, 0));
    let filter = unsafe { &mut *filter.cast::<Filter>() };
    filter.images.insert(unsafe { text(name) }, (pixels.cast(), w * h));
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnSetFilterBool(filter: *mut c_void, name: *const c_char, value: bool) {
    assert!(value);
    unsafe { &mut *filter.cast::<Filter>() }.flags.push(unsafe { text(name) });
}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnSetFilterProgressMonitorFunction(
    filter: *mut c_void,
    monitor: Monitor,
    asked: *mut c_void,
) {
    unsafe { &mut *filter.cast::<Filter>() }.monitor = Some((monitor, asked));
}

#[unsafe(no_mangle)]
extern "C" fn oidnCommitFilter(_: *mut c_void) {}

#[unsafe(no_mangle)]
unsafe extern "C" fn oidnExecuteFilter(filter: *mut c_void) {
    let filter = unsafe { &*filter.cast::<Filter>() };
    if says("fail") {
        return fail("out of\nmemory");
    }
    let goes_on = || {
        let (monitor, asked) = filter.monitor.expect("it was set");
        unsafe { monitor(asked, 0.5) }
    };
    if says("interrupt") {
        unsafe { raise(INTERRUPT) };
        let began = Instant::now();
        while goes_on() && began.elapsed() < Duration::from_secs(20) {
            std::thread::sleep(Duration::from_millis(5));
        }
    }
    if !goes_on() {
        return fail("cancelled");
    }
    let at =
        |name: &str, i: usize| filter.images.get(name).map(|(pixels, _)| unsafe { *pixels.add(i) });
    let (output, n) = filter.images["output"];
    let is_picture = filter.images.contains_key("color");
    let is_guided = is_picture && filter.images.len() > 2;
    let expected: &[&str] = match (is_picture, is_guided) {
        (false, _) => &[],
        (true, false) => &["hdr"],
        (true, true) => &["hdr", "cleanAux"],
    };
    if filter.flags != expected {
        return fail("other flags were expected");
    }
    for i in 0..n {
        let of = |name: &str| at(name, i).unwrap_or_default();
        let pixel = [0, 1, 2].map(|c| match is_picture {
            true if says("infinite") => f32::INFINITY,
            true => of("color")[c] + of("albedo")[c] + of("normal")[c],
            false => 0.5 * (of("albedo")[c] + of("normal")[c]),
        });
        unsafe { *output.add(i) = pixel };
    }
}
