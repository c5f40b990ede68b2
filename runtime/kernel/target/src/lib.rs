//! Attributes: what a function of a wide kernel is compiled for.
//!
//! `runtime/kernel/wide/` is compiled by two crates for different instructions. Each imports one of these attributes
//! under the name `target`; where it names others than the generated functions are compiled for, the crate is refused.

use proc_macro::TokenStream;

/// Compiles a function for AVX2.
#[proc_macro_attribute]
pub fn avx2(_: TokenStream, function: TokenStream) -> TokenStream {
    compiled_for("avx2,fma,bmi1,bmi2,lzcnt,popcnt", function)
}

/// Compiles a function for the AVX-512 of x86-64-v4.
#[proc_macro_attribute]
pub fn avx512(_: TokenStream, function: TokenStream) -> TokenStream {
    let features = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt";
    compiled_for(features, function)
}

fn compiled_for(features: &str, function: TokenStream) -> TokenStream {
    let attribute = format!("#[target_feature(enable = \"{features}\")]");
    let mut out: TokenStream = attribute.parse().expect("an attribute");
    out.extend(function);
    out
}
