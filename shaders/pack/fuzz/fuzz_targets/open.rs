//! Any bytes: an error of one line, or a pack that is sound. Reaches header, table and manifest.

#![no_main]

#[path = "../../tests/common/mod.rs"]
mod common;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match pack::Pack::from_bytes(bytes.to_vec()) {
        Ok(pack) => {
            common::sound::assert_sound(&pack);
            drop(pack.manifest());
        }
        Err(error) => assert!(!error.to_string().contains('\n')),
    }
});
