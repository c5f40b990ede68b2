//! Pack → what its kernel has and what was left out, for reports: features with the declarations that need
//! them, sections with their bindings, sizes of kernels. A pack with a manifest that cannot be read still has
//! sections and the lines of its kernel.

use crate::scene::Scene;
use pack::Manifest;
use pack::manifest::{Feature, KernelSize};
use serde::Serialize;

/// What a kernel was made of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Features that are in.
    pub kept: Vec<Reason>,
    /// Features that are not.
    pub left_out: Vec<Reason>,
    /// What the pack holds, in file order.
    pub sections: Vec<Section>,
    /// Lines of WGSL, see `KernelSize::lines_of`.
    pub wgsl_lines: u32,
    /// Words of SPIR-V, without names and checks; `None` where the manifest does not say.
    pub spirv_words: Option<u32>,
    /// Lines of the kernel with all features.
    pub full_wgsl_lines: u32,
    /// Its words.
    pub full_spirv_words: u32,
}

/// A feature and why it is in, or not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Reason {
    /// Name of the feature.
    pub name: String,
    /// Why.
    pub reason: String,
    /// Name of the declaration that the reason is about.
    pub by: Option<String>,
    /// `file:line` of that declaration.
    pub at: Option<String>,
}

/// A section of the pack.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Section {
    /// Its name.
    pub name: String,
    /// Elements.
    pub elements: u64,
    /// Bytes.
    pub bytes: u64,
    /// Its first binding in the kernel; `None`: the host reads it.
    pub binding: Option<u32>,
}

impl LeftOut {
    /// Of the pack of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let pack = scene.pack();
        let manifest = pack.manifest().unwrap_or_default();
        let reasons = |list: &[Feature]| list.iter().map(|f| Reason::of(&manifest, f)).collect();
        let sections = pack::describe(pack).into_iter().map(|row| Section {
            name: row.kind,
            elements: row.count,
            bytes: row.bytes,
            binding: row.binding,
        });
        let words = manifest.kernel.words;
        Self {
            kept: reasons(&manifest.features_kept),
            left_out: reasons(&manifest.features_left_out),
            sections: sections.collect(),
            wgsl_lines: KernelSize::lines_of(pack.kernel()),
            spirv_words: (words > 0).then_some(words),
            full_wgsl_lines: env!("FULL_KERNEL_LINES").parse().unwrap_or_default(),
            full_spirv_words: env!("FULL_KERNEL_WORDS").parse().unwrap_or_default(),
        }
    }
}

impl Reason {
    fn of(manifest: &Manifest, feature: &Feature) -> Self {
        let by = feature.by.as_ref();
        Self {
            name: feature.name.clone(),
            reason: feature.reason.clone(),
            by: by.map(|by| by.name.clone()),
            at: by.and_then(|by| manifest.place(by)),
        }
    }
}
