//! Translates the full kernel to Rust for sixteen invocations at once.

#[path = "../wide/translate.rs"]
mod translate;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    translate::translate(native::Lanes::Avx512)
}
