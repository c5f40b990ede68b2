//! What the generated text of the probes computes, as the f64 twin.

#![allow(clippy::float_cmp, reason = "expected values are exact unless a test says how close")]

#[path = "behaviour/control.rs"]
mod control;
#[path = "../src/prelude/double.rs"]
mod double;
#[path = "behaviour/f64_only.rs"]
mod f64_only;
#[path = "behaviour/floats.rs"]
mod floats;
#[path = "behaviour/integers.rs"]
mod integers;
#[path = "behaviour/memory.rs"]
mod memory;
#[path = "behaviour/names.rs"]
mod names;
#[path = "behaviour/vectors.rs"]
mod vectors;

macro_rules! kernels {
    ($($name:ident = $file:literal;)*) => {$(
        #[allow(
            clippy::all,
            clippy::pedantic,
            dead_code,
            non_camel_case_types,
            non_snake_case,
            non_upper_case_globals,
            unreachable_pub,
            unused,
            reason = "generated text"
        )]
        pub mod $name {
            use crate::double::rules as wgsl;
            include!(concat!(env!("OUT_DIR"), "/", $file));
        }
    )*};
}

/// One module a probe.
mod kernels {
    kernels! {
        control = "control_f64.rs";
        floats = "floats_f64.rs";
        integers = "integers_f64.rs";
        memory = "memory_f64.rs";
        names = "names_f64.rs";
        vectors = "vectors_f64.rs";
    }
}
