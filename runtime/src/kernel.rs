//! The kernel as Rust: what the build script generated from the full WGSL, in two precisions, and for eight
//! invocations at once.
//!
//! Not written by hand and not edited: `build.rs` links every WGSL module and translates the text.

macro_rules! generated {
    ($(#[$doc:meta])* $name:ident = $file:literal) => {
        $(#[$doc])*
        #[allow(
            clippy::all,
            clippy::pedantic,
            dead_code,
            missing_docs,
            unreachable_pub,
            unused,
            non_snake_case,
            non_upper_case_globals,
            reason = "generated"
        )]
        pub mod $name {
            include!(concat!(env!("OUT_DIR"), $file));
        }
    };
}

generated! {
    /// The kernel in single precision: the same bits as a GPU that rounds as IEEE 754 says. Its `trace` is
    /// `walk`'s, what was generated for it is `generated_trace`.
    f32 = "/kernel_f32.rs"
}

generated! {
    /// Its twin in double precision, which shows where rounding matters.
    f64 = "/kernel_f64.rs"
}

#[cfg(target_arch = "x86_64")]
generated! {
    /// The kernel in single precision for eight invocations at once.
    wide = "/kernel_wide.rs"
}
