//! What the generated text of the probes computes, as the f32 kernel.

#![allow(clippy::float_cmp, reason = "expected values are exact unless a test says how close")]

#[path = "behaviour/control.rs"]
mod control;
#[path = "behaviour/f32_only.rs"]
mod f32_only;
#[path = "behaviour/floats.rs"]
mod floats;
#[path = "behaviour/integers.rs"]
mod integers;
#[path = "behaviour/memory.rs"]
mod memory;
#[path = "behaviour/names.rs"]
mod names;
#[path = "../src/prelude/single.rs"]
mod single;
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
            use crate::single::rules as wgsl;
            include!(concat!("generated/", $file));
        }
    )*};
}

/// One module a probe.
mod kernels {
    kernels! {
        control = "control.rs";
        floats = "floats.rs";
        integers = "integers.rs";
        memory = "memory.rs";
        names = "names.rs";
        vectors = "vectors.rs";
    }
}
