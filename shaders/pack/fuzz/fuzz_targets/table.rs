//! Edits to header and section table of a valid pack, with `render_id` put right: reaches every
//! rule about offsets, lengths and counts.
//!
//! An edit is ten bytes: byte offset (16 bits), then the eight bytes to put there.

#![no_main]

#[path = "../../tests/common/mod.rs"]
mod common;

use common::{Scene, fix_render_id, get32, put};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|edits: &[u8]| {
    let mut bytes = Scene::full().bytes();
    let end = 128 + 64 * get32(&bytes, 32) as usize;
    for edit in edits.chunks_exact(10).take(16) {
        let at = usize::from(u16::from_le_bytes([edit[0], edit[1]])) % (end - 7);
        let mut value = [0; 8];
        value.copy_from_slice(&edit[2..]);
        put(&mut bytes, at, value);
    }
    fix_render_id(&mut bytes);
    match pack::Pack::from_bytes(bytes) {
        Ok(pack) => common::sound::assert_sound(&pack),
        Err(error) => assert!(!error.to_string().contains('\n')),
    }
});
