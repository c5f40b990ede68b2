//! Edits to a valid pack, sealed again: reaches index relations, textures and the tree, which
//! random bytes never would, behind all those hashes and lengths.
//!
//! An edit is eight bytes: section, what to do, byte offset (16 bits), word (32 bits).

#![no_main]

#[path = "../../tests/common/mod.rs"]
mod common;

use common::{Draft, Scene, put32};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|edits: &[u8]| {
    let mut draft = Draft::new(&Scene::with_instances().bytes());
    for edit in edits.chunks_exact(8).take(64) {
        let section = usize::from(edit[0]) % draft.sections.len();
        let elem_size = common::get32(&draft.sections[section].0, 32) as usize;
        let bytes = &mut draft.sections[section].1;
        let at = usize::from(u16::from_le_bytes([edit[2], edit[3]]));
        let word = common::get32(edit, 4);
        match edit[1] % 8 {
            // One element more, a copy of an existing one, so that trees can grow.
            0 if bytes.len() < 1 << 16 && !bytes.is_empty() => {
                let from = at % (bytes.len() / elem_size).max(1) * elem_size;
                let copy = bytes[from..(from + elem_size).min(bytes.len())].to_vec();
                bytes.extend(copy);
            }
            1 => bytes.truncate(at),
            _ if bytes.len() >= 4 => {
                let at = at % (bytes.len() / 4) * 4;
                put32(bytes, at, word);
            }
            _ => {}
        }
    }
    match pack::Pack::from_bytes(draft.seal()) {
        Ok(pack) => {
            common::sound::assert_sound(&pack);
            drop(pack.manifest());
            assert!(pack.verify_hashes().is_ok());
        }
        Err(error) => assert!(!error.to_string().contains('\n')),
    }
});
