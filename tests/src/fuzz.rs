//! Hostile input: one target for each reader of bytes, with seeds in `tests/corpus`.
//!
//! A target turns any bytes into "accepted" or a refusal of one line, and panics when a promise of
//! SECURITY.md is broken: what was accepted must be sound, and survive being written and read again
//! where it can be written. `tests/tests/fuzz.rs` replays the seeds and some mutations, the program
//! `fuzz` mutates for as long as one likes, and `tests/fuzz` lets libFuzzer call the same functions.

pub mod corpus;
mod entry;
mod http;
mod image;
mod mesh;
mod mutate;
mod pack;
mod picture;
mod seeds;
mod text;

pub use corpus::Seed;
pub use mutate::{Mutator, Random};
pub use seeds::write;

use std::path::Path;
use tempfile::TempDir;

/// A reader of bytes.
#[derive(Clone, Copy)]
pub struct Target {
    /// On the command line, and of the folder of its seeds.
    pub name: &'static str,
    /// What it reads.
    pub reads: &'static str,
    /// Hands the bytes to the reader, with a folder for files; the error is a refusal.
    check: fn(&Path, &[u8]) -> Result<(), String>,
    /// Renews lengths and checksums, so that damage gets past them.
    repair: fn(&mut [u8]),
    /// Pieces that mean something in this format.
    words: &'static [&'static [u8]],
    /// Mutations in `cargo test`.
    pub tries: u32,
}

/// Every target.
pub const TARGETS: &[Target] = &[
    Target {
        name: "text",
        reads: "scenes: parser, checker, formatter",
        check: text::check,
        repair: keep,
        words: text::WORDS,
        tries: 1500,
    },
    Target {
        name: "obj",
        reads: "Wavefront OBJ",
        check: mesh::obj,
        repair: keep,
        words: mesh::OBJ_WORDS,
        tries: 4000,
    },
    Target {
        name: "mtl",
        reads: "materials of an OBJ",
        check: mesh::mtl,
        repair: keep,
        words: mesh::MTL_WORDS,
        tries: 1000,
    },
    Target {
        name: "ply",
        reads: "PLY",
        check: mesh::ply,
        repair: keep,
        words: mesh::PLY_WORDS,
        tries: 4000,
    },
    Target {
        name: "stl",
        reads: "STL",
        check: mesh::stl,
        repair: keep,
        words: mesh::STL_WORDS,
        tries: 4000,
    },
    Target {
        name: "gltf",
        reads: "glTF as text",
        check: mesh::gltf,
        repair: keep,
        words: mesh::GLTF_WORDS,
        tries: 4000,
    },
    Target {
        name: "glb",
        reads: "glTF as binary",
        check: mesh::glb,
        repair: mesh::repair_glb,
        words: mesh::GLTF_WORDS,
        tries: 4000,
    },
    Target {
        name: "png",
        reads: "PNG images",
        check: image::low,
        repair: image::repair_png,
        words: image::PNG_WORDS,
        tries: 3000,
    },
    Target {
        name: "jpeg",
        reads: "JPEG images",
        check: image::low,
        repair: keep,
        words: image::JPEG_WORDS,
        tries: 3000,
    },
    Target {
        name: "ktx2",
        reads: "KTX2 images of Basis Universal",
        check: image::low,
        repair: keep,
        words: image::KTX2_WORDS,
        tries: 3000,
    },
    Target {
        name: "hdr",
        reads: "Radiance HDR images",
        check: image::high,
        repair: keep,
        words: image::HDR_WORDS,
        tries: 3000,
    },
    Target {
        name: "ies",
        reads: "luminaire files",
        check: image::high,
        repair: keep,
        words: image::IES_WORDS,
        tries: 1000,
    },
    Target {
        name: "exr",
        reads: "OpenEXR images as textures",
        check: image::exr,
        repair: keep,
        words: image::EXR_WORDS,
        tries: 2000,
    },
    Target {
        name: "merge",
        reads: "EXR pictures of `rtr`, and `rtr merge`",
        check: picture::part,
        repair: keep,
        words: image::EXR_WORDS,
        tries: 1000,
    },
    Target {
        name: "checkpoint",
        reads: "checkpoints of `rtr`",
        check: picture::checkpoint,
        repair: picture::repair_checkpoint,
        words: picture::CHECKPOINT_WORDS,
        tries: 3000,
    },
    Target {
        name: "http",
        reads: "requests to `rtr view`",
        check: http::check,
        repair: keep,
        words: http::WORDS,
        tries: 20_000,
    },
    Target {
        name: "entry",
        reads: "entries of the tree cache",
        check: entry::check,
        repair: entry::repair,
        words: &[],
        tries: 1000,
    },
    Target {
        name: "pack",
        reads: "render packs",
        check: pack::open,
        repair: pack::repair,
        words: &[],
        tries: 1000,
    },
    Target {
        name: "pack-table",
        reads: "edits to header and section table of a sound pack",
        check: pack::table,
        repair: keep,
        words: &[],
        tries: 1000,
    },
    Target {
        name: "pack-contents",
        reads: "edits to the sections of a sound pack, sealed again",
        check: pack::contents,
        repair: keep,
        words: &[],
        tries: 1000,
    },
];

fn keep(_: &mut [u8]) {}

/// The target of this name.
#[must_use]
pub fn target(name: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|target| target.name == name)
}

/// A target with a temporary folder for the files that its reader wants.
pub struct Runner {
    target: &'static Target,
    folder: TempDir,
}

impl Runner {
    /// Ready to run.
    ///
    /// # Errors
    /// When there is no temporary folder.
    pub fn new(target: &'static Target) -> std::io::Result<Self> {
        Ok(Self { target, folder: tempfile::tempdir()? })
    }

    /// Whether the reader accepts the bytes, or its words.
    ///
    /// # Errors
    /// The refusal.
    ///
    /// # Panics
    /// When a promise is broken: that is the finding.
    pub fn run(&self, bytes: &[u8]) -> Result<(), String> {
        (self.target.check)(self.folder.path(), bytes).inspect_err(|refusal| {
            assert!(!refusal.contains('\n'), "a refusal of several lines: {refusal}");
            assert!(refusal.len() < 1000, "a refusal of {} bytes: {refusal}", refusal.len());
        })
    }
}
