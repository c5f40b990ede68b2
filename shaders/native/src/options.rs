//! What is asked for beside the WGSL: the precision, and functions that hand-written Rust does instead.

/// The type that stands for WGSL's `f32` in the generated text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// `f32`: the same bits as a GPU that rounds as IEEE 754 says.
    F32,
    /// `f64`: the twin that shows where rounding matters.
    F64,
}

/// Which instructions the lanes of a wide module are made of, and so how many there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lanes {
    /// Eight, with AVX2.
    Avx2,
    /// Sixteen, with the AVX-512 of x86-64-v4.
    Avx512,
}

/// A function that hand-written Rust may do instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seam<'a> {
    /// Its name in the WGSL.
    pub function: &'a str,
    /// Path of the Rust function, as seen from the generated module. It takes `&mut Kernel` and the
    /// arguments, and gives the result. The translation is there as well, under the name with
    /// `generated_` in front, so that it can be called for what the hand-written one does not do.
    pub path: &'a str,
}

/// What hand-written Rust does in a translation, and what it calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ByHand<'a> {
    /// Functions that it does.
    pub seams: &'a [Seam<'a>],
    /// A type that it needs, as seen from the generated module; it may have the lifetime `'a` of the resources, and
    /// has a default. `Kernel` gets a member `companion` of it that no translated function uses.
    pub companion: Option<&'a str>,
    /// Functions that it calls. The scalar forms compile them once, with the module, and all others with whoever calls
    /// them; the wide form translates them even where nothing else calls them. Their names in the WGSL.
    pub entrances: &'a [&'a str],
}
