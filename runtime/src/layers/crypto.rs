//! Names → numbers of Cryptomatte, and the manifest that leads back.
//!
//! Friedman & Jones 2015, "Fully automatic ID mattes with support for motion blur and transparency"; specification 1.2.0.

use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The number of a name: its hash, with an exponent that makes it a normal `f32`.
#[must_use]
pub fn id_of(name: &str) -> u32 {
    let hash = murmur3(name.as_bytes());
    match hash >> 23 & 0xff {
        0 | 0xff => hash ^ 1 << 23,
        _ => hash,
    }
}

/// `MurmurHash3_x86_32` with seed 0 (Appleby, public domain).
fn murmur3(bytes: &[u8]) -> u32 {
    let scrambled =
        |word: u32| word.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
    let (words, rest) = bytes.as_chunks::<4>();
    let mut hash = 0_u32;
    for word in words {
        hash ^= scrambled(u32::from_le_bytes(*word));
        hash = hash.rotate_left(13).wrapping_mul(5).wrapping_add(0xe654_6b64);
    }
    let tail = rest.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte));
    hash ^= scrambled(tail);
    #[expect(clippy::cast_possible_truncation, reason = "the hash takes the length modulo 2^32")]
    let length = bytes.len() as u32;
    hash ^= length;
    hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    hash ^ hash >> 16
}

/// `{"Cube":"a8fce865"}`, in ASCII: EXR attributes are Latin-1, and readers disagree about the rest.
#[must_use]
pub fn manifest_text(names: &BTreeMap<String, u32>) -> String {
    let mut text = "{".to_owned();
    for (name, id) in names {
        if text.len() > 1 {
            text.push(',');
        }
        // Writing to a string cannot fail.
        let _ = write!(text, "{}:\"{id:08x}\"", quoted(name));
    }
    text + "}"
}

/// A JSON string in ASCII.
fn quoted(name: &str) -> String {
    let mut text = "\"".to_owned();
    for unit in name.encode_utf16() {
        match char::from_u32(u32::from(unit)) {
            Some(c @ ('"' | '\\')) => text.extend(['\\', c]),
            Some(c @ ' '..='~') => text.push(c),
            _ => {
                let _ = write!(text, "\\u{unit:04x}");
            }
        }
    }
    text + "\""
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_the_numbers_that_others_give_them() {
        // Blender 5.0.1 wrote the first; the others are test vectors of MurmurHash3 and its specification.
        assert_eq!(format!("{:08x}", id_of("Cube")), "a8fce865");
        for (text, hash) in [
            ("", 0),
            ("a", 0x3c25_69b2),
            ("test", 0xba6b_d213),
            ("Hello, world!", 0xc036_3e43),
            ("The quick brown fox jumps over the lazy dog", 0x2e4f_f723),
        ] {
            assert_eq!(murmur3(text.as_bytes()), hash, "{text}");
        }
        for name in (0..2000).map(|i| i.to_string()).chain([String::new()]) {
            assert!(f32::from_bits(id_of(&name)).is_normal(), "{name}");
        }
    }

    #[test]
    fn the_manifest_is_ascii_json() {
        let names = ["Cube", "B\u{fc}cher", "\u{1f338}", "a\"b\\c\n"].map(str::to_owned);
        let rows: BTreeMap<String, u32> =
            names.into_iter().map(|n| (n.clone(), id_of(&n))).collect();
        let text = manifest_text(&rows);
        assert!(text.is_ascii() && text.contains("B\\u00fccher"), "{text}");
        let read: BTreeMap<String, String> = serde_json::from_str(&text).unwrap();
        assert_eq!(read.len(), rows.len());
        assert!(rows.iter().all(|(name, id)| read[name] == format!("{id:08x}")));
    }
}
