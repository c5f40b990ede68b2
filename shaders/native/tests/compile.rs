//! Every generated module compiles, with no warnings but those that generated text may have.

macro_rules! kernels {
    ($($name:ident = $file:literal;)*) => {$(
        mod $name { include!(concat!("generated/", $file)); }
    )*};
}
kernels! {
    control_f32 = "control_f32.rs"; control_f64 = "control_f64.rs";
    memory_f32 = "memory_f32.rs"; memory_f64 = "memory_f64.rs";
    integers_f32 = "integers_f32.rs"; integers_f64 = "integers_f64.rs";
    vectors_f32 = "vectors_f32.rs"; vectors_f64 = "vectors_f64.rs";
    floats_f32 = "floats_f32.rs"; floats_f64 = "floats_f64.rs";
    names_f32 = "names_f32.rs"; names_f64 = "names_f64.rs";
}
