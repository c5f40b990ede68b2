//! Render packs: an error of one line, or a pack that is sound.
//!
//! `open` takes any bytes and reaches header, table and manifest. `table` and `contents` edit a sound
//! pack and make its hashes true again: they reach what lies behind all those lengths and hashes.

#[path = "../../../shaders/pack/tests/common/mod.rs"]
mod common;

use std::path::Path;

use common::{Draft, Scene, fix_render_id, get32, get64, put, put32};

fn judge(bytes: Vec<u8>) -> Result<(), String> {
    let pack = ::pack::Pack::from_bytes(bytes).map_err(|error| error.to_string())?;
    common::sound::assert_sound(&pack);
    // A manifest may be malformed: nothing that renders depends on it.
    drop(pack.manifest());
    Ok(())
}

pub(super) fn open(_: &Path, bytes: &[u8]) -> Result<(), String> {
    judge(bytes.to_vec())
}

/// A pack of little.
pub(super) fn seed() -> Vec<u8> {
    Scene::empty().bytes()
}

/// An edit is ten bytes: byte offset (16 bits), then the eight bytes to put there.
pub(super) fn table(_: &Path, edits: &[u8]) -> Result<(), String> {
    let mut bytes = Scene::full().bytes();
    let end = 128 + 64 * get32(&bytes, 32) as usize;
    for edit in edits.chunks_exact(10).take(16) {
        let at = usize::from(u16::from_le_bytes([edit[0], edit[1]])) % (end - 7);
        let mut value = [0; 8];
        value.copy_from_slice(&edit[2..]);
        put(&mut bytes, at, value);
    }
    fix_render_id(&mut bytes);
    judge(bytes)
}

/// An edit is eight bytes: section, what to do, byte offset (16 bits), word (32 bits).
pub(super) fn contents(_: &Path, edits: &[u8]) -> Result<(), String> {
    let mut draft = Draft::new(&Scene::with_instances().bytes());
    for edit in edits.chunks_exact(8).take(64) {
        let section = usize::from(edit[0]) % draft.sections.len();
        let elem_size = get32(&draft.sections[section].0, 32) as usize;
        let bytes = &mut draft.sections[section].1;
        let at = usize::from(u16::from_le_bytes([edit[2], edit[3]]));
        let word = get32(edit, 4);
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
    let bytes = draft.seal();
    judge(bytes.clone())?;
    let pack = ::pack::Pack::from_bytes(bytes).map_err(|error| error.to_string())?;
    assert!(pack.verify_hashes().is_ok());
    Ok(())
}

/// Makes the hashes of sections that lie inside of the file true again, and the one over the table.
pub(super) fn repair(bytes: &mut [u8]) {
    if bytes.len() < 128 {
        return;
    }
    let count = (get32(bytes, 32) as usize).min((bytes.len() - 128) / 64);
    for at in (0..count).map(|i| 128 + 64 * i) {
        let number = |place: usize| usize::try_from(get64(bytes, at + place)).ok();
        let range = number(16).and_then(|from| Some(from..from.checked_add(number(24)?)?));
        if let Some(section) = range.and_then(|range| bytes.get(range)) {
            let hash = blake3::hash(section);
            let (half, _) = hash.as_bytes().split_at(16);
            bytes[at + 48..at + 64].copy_from_slice(half);
        }
    }
    fix_render_id(bytes);
}
