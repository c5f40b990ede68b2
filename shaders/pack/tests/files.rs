//! Truncated, flipped, foreign and hostile files: one clear line or a sound pack, never a panic.

mod common;

use common::sound::assert_sound;
use common::{Draft, Scene, WAYS, get32, map, put32};
use pack::{Kind, Pack, PackError};

fn open(bytes: &[u8]) -> Result<Pack, PackError> {
    Pack::from_bytes(bytes.to_vec())
}

/// One line, not empty, no trailing full stop.
fn assert_clear(error: &PackError) {
    let text = error.to_string();
    assert!(!text.is_empty() && !text.contains('\n') && !text.ends_with('.'), "{text}");
}

#[test]
fn every_truncation_is_refused() {
    let bytes = Scene::full().bytes();
    let mut lengths: Vec<usize> = (0..1100).collect();
    for page in (0..bytes.len()).step_by(4096) {
        lengths.extend([page.saturating_sub(1), page, page + 1]);
    }
    for (entry, section) in Draft::new(&bytes).sections {
        let end = common::index64(&entry, 16) + section.len();
        lengths.extend([end - 1, end, end + 1]);
    }
    for len in lengths.into_iter().filter(|len| *len < bytes.len()) {
        assert_clear(&open(&bytes[..len]).expect_err("a truncated pack"));
    }
}

#[test]
fn appended_bytes_are_refused() {
    let bytes = Scene::full().bytes();
    for tail in [&[0][..], &[0; 4096], b"another file"] {
        assert_clear(&open(&[&bytes, tail].concat()).expect_err("a pack with a tail"));
    }
}

/// Whatever bit of header or table flips, the pack is refused or means the same.
#[test]
fn every_flipped_bit_of_header_and_table_is_refused_or_means_nothing() {
    let bytes = Scene::full().bytes();
    let original = open(&bytes).unwrap();
    let end = 128 + 64 * get32(&bytes, 32) as usize;
    let mut accepted = 0;
    for bit in 0..end * 8 {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        match open(&flipped) {
            Err(error) => assert_clear(&error),
            Ok(pack) => {
                accepted += 1;
                let byte = bit / 8;
                let minor = (10..12).contains(&byte);
                let recipe = (96..128).contains(&byte);
                let meta_hash = (end - 16..end).contains(&byte);
                assert!(minor || recipe || meta_hash, "bit {bit}");
                assert_eq!(pack.render_id(), original.render_id());
                for (new, old) in pack.sections().zip(original.sections()) {
                    assert_eq!((new.kind, new.bytes), (old.kind, old.bytes));
                }
            }
        }
    }
    // The minor version, the recipe, and the hash of a section that does not render.
    assert_eq!(accepted, (2 + 32 + 16) * 8);
}

/// Any single bit, wherever it is: refused, or every byte that renders is as it was.
#[test]
fn a_flipped_bit_is_refused_or_changes_nothing_that_renders() {
    let scene = Scene::full();
    let (bytes, mut random) = (scene.bytes(), Random(3));
    let original = open(&bytes).unwrap();
    let draft = Draft::new(&bytes);
    let inside = |at: usize| {
        draft.sections.iter().any(|(entry, section)| {
            let start = common::index64(entry, 16);
            (start..start + section.len()).contains(&at)
        })
    };
    let head = 128 + 64 * get32(&bytes, 32) as usize;
    let padding: Vec<usize> = (head..bytes.len()).filter(|at| !inside(*at)).collect();
    let sections: Vec<usize> = (head..bytes.len()).filter(|at| inside(*at)).collect();
    assert!(!padding.is_empty() && sections.len() > 1000);
    let mut tries: Vec<usize> = (0..head * 8).collect();
    tries.extend((0..1000).map(|_| padding[random.below(padding.len())] * 8 + random.below(8)));
    tries.extend((0..4000).map(|_| sections[random.below(sections.len())] * 8 + random.below(8)));
    let (mut by_rules, mut by_hashes, mut accepted) = (0, 0, 0);
    for bit in tries {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let pack = match open(&flipped) {
            Ok(pack) => pack,
            Err(error) => {
                assert_clear(&error);
                by_rules += 1;
                continue;
            }
        };
        if let Err(error) = pack.verify_hashes() {
            assert_clear(&error);
            by_hashes += 1;
            continue;
        }
        accepted += 1;
        assert!(bit / 8 < head, "bit {bit} of the contents was accepted");
        assert_eq!(pack.render_id(), original.render_id());
        assert_eq!(pack.features(), original.features());
        for (new, old) in pack.sections().zip(original.sections()) {
            assert_eq!((new.kind, new.bytes), (old.kind, old.bytes));
        }
    }
    // The minor version and the recipe, which name the format and the inputs, and render nothing.
    assert_eq!(accepted, (2 + 32) * 8);
    assert!(by_rules > 8000 && by_hashes > 100, "{by_rules} by rules, {by_hashes} by hashes");
}

/// A small generator, so that the test is the same everywhere (Steele et al. 2014, `SplitMix64`).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end as u64).expect("a remainder is smaller than `end`")
    }
}

/// 10^4 packs with random changes inside the sections, hashes put right.
#[test]
fn accepted_packs_are_sound_whatever_bytes_change() {
    let scene = Scene::full();
    let original = Draft::new(&scene.bytes());
    let mut random = Random(1);
    let mut accepted = 0;
    for _ in 0..10_000 {
        let mut draft = original.clone();
        for _ in 0..=random.below(3) {
            let at = random.below(draft.sections.len());
            let section = &mut draft.sections[at].1;
            let at = random.below(section.len() / 4) * 4;
            match random.below(4) {
                0 => section[at + random.below(4)] ^= 1 << random.below(8),
                1 => section[at + random.below(4)] = random.next().to_le_bytes()[0],
                // Small numbers are plausible indices, counts and tags.
                2 => put32(section, at, u32::try_from(random.below(12)).unwrap()),
                _ => {
                    let word = get32(section, at) ^ (1 << random.below(32));
                    put32(section, at, word);
                }
            }
        }
        match Pack::from_bytes(draft.seal()) {
            Ok(pack) => {
                accepted += 1;
                assert_sound(&pack);
                drop(pack.manifest());
                pack.verify_hashes().unwrap();
            }
            Err(error) => assert_clear(&error),
        }
    }
    assert!((1000..9000).contains(&accepted), "{accepted} accepted: the test tests one side only");
}

/// Random bytes anywhere in the file, nothing put right.
#[test]
fn random_damage_never_panics() {
    let bytes = Scene::full().bytes();
    let mut random = Random(2);
    for _ in 0..2_000 {
        let mut damaged = bytes.clone();
        for _ in 0..=random.below(8) {
            let at =
                if random.below(2) == 0 { random.below(1024) } else { random.below(bytes.len()) };
            damaged[at] = random.next().to_le_bytes()[0];
        }
        match open(&damaged) {
            Ok(pack) => assert_sound(&pack),
            Err(error) => assert_clear(&error),
        }
    }
}

#[test]
fn foreign_files_are_named_for_what_they_are() {
    let source = "is this a scene source? compile it first: rtc X -o X.pack";
    let long = format!("rts 1\n{}", "material clay = diffuse { color: srgb(0.8) }\n".repeat(90));
    // Cut in the middle of a character after 128 bytes.
    let split = format!("rts 1\n#{}ä and so on", "x".repeat(120));
    let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
    let cases: [(&[u8], &str); 10] = [
        (b"rts 1", source),
        (b"\xef\xbb\xbfrts 1\n", source),
        (b"\n  rts 1\n", source),
        (long.as_bytes(), source),
        (split.as_bytes(), source),
        (b"", "not a render pack: the first bytes are none, the file is empty"),
        (png, "not a render pack: the first bytes are 89 50 4e 47 0d 0a 1a 0a"),
        (b"glTF\x02", "not a render pack: the first bytes are 67 6c 54 46 02"),
        (
            b"rts\xff\xff\xff\xff\xff",
            "not a render pack: the first bytes are 72 74 73 ff ff ff ff ff",
        ),
        (
            b"\x09RTP\n\x1a\n",
            "header: the first bytes were altered, perhaps by a transfer in text mode",
        ),
    ];
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("file");
    for (bytes, expected) in cases {
        assert_eq!(open(bytes).unwrap_err().to_string(), expected);
        std::fs::write(&path, bytes).unwrap();
        for open in WAYS {
            assert_eq!(open(&path).unwrap_err().to_string(), expected);
        }
    }
}

#[test]
fn directories_are_not_packs() {
    let dir = tempfile::tempdir().unwrap();
    for open in WAYS {
        let text = open(dir.path()).unwrap_err().to_string();
        // Windows refuses to open a directory at all.
        assert!(text.ends_with(" is not a regular file") || text.starts_with("cannot open "));
    }
}

/// The first 128 bytes of a pack of format 3, frozen here as they might be written one day.
#[test]
fn another_major_format_is_refused_politely() {
    const FROZEN: [u8; 128] = {
        let mut bytes = [0x5a; 128];
        let start = [0x89, b'R', b'T', b'P', 0x0d, 0x0a, 0x1a, 0x0a, 3, 0, 7, 0, 4, 3, 2, 1];
        let mut at = 0;
        while at < start.len() {
            bytes[at] = start[at];
            at += 1;
        }
        bytes
    };
    let expected = "header: format 3, this program reads format 2: compile the scene again: \
                    rtc X -o X.pack";
    assert_eq!(open(&FROZEN).unwrap_err().to_string(), expected);
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("future.pack");
    std::fs::write(&path, FROZEN).unwrap();
    assert_eq!(map(&path).unwrap_err().to_string(), expected);
}

/// The error does not depend on how many threads looked for it.
#[test]
fn the_first_error_is_reported_on_any_number_of_threads() {
    let mut scene = Scene::full();
    let shade = scene.shades[0];
    let triangle = scene.triangles[0];
    scene.shades = vec![shade; 100_000];
    scene.triangles = vec![triangle; 100_000];
    for bad in [99_999, 70_000, 40_000] {
        scene.shades[bad].material = 99;
        scene.shades[bad].uv0[0] = f32::NAN;
    }
    for threads in [1, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let error = pool.install(|| scene.writer().to_bytes().unwrap_err());
        assert_eq!(
            error.to_string(),
            "TRISHADE[40000] at byte 0x1d4c0c: material is 99, but MATERIAL has 15 elements"
        );
    }
}

/// `Kind` prints whatever bytes a file holds.
#[test]
fn names_are_printed_safely() {
    assert_eq!(Kind::SKY.to_string(), "SKY");
    assert_eq!(Kind(*b"A\x1b[2J   ").to_string(), "A\\u{1b}[2J");
    assert_eq!(Kind([0xff; 8]).to_string(), "0xffffffffffffffff");
}
