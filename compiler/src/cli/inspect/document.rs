//! A pack → what `rtc inspect --json` says of it; the keys are in `docs/json.md`.

use std::path::Path;

use files::ShowPath as _;
use pack::abi::{Node, WideNode};
use pack::manifest::{Feature, KernelSize, Named};
use pack::{Checked, Manifest, Pack};
use serde_json::{Value, json};

/// One object. `id`: the pack's render id, hexadecimal; `full`: the size of the kernel that has all features.
pub(super) fn document(
    (path, id): (&Path, &str),
    pack: &Pack<Checked>,
    manifest: &Manifest,
    full: KernelSize,
) -> Value {
    let render = pack.render();
    let named = |list: &[Named]| list.iter().map(|n| declared(manifest, n)).collect::<Value>();
    json!({
        "schema": "rtc.inspect/1",
        "pack": path.shown().to_string(),
        "render_id": id,
        "scene": manifest.scene,
        "rtc_version": manifest.rtc_version,
        "options": manifest.options,
        "output": manifest.output,
        "image": render.image_size,
        "samples": render.samples,
        "depth": render.depth(),
        "stack_need": render.stack_need,
        "nodes": {
            "binary": pack.records::<Node>().len(),
            "wide": pack.records::<WideNode>().len(),
        },
        "features": pack::features::names(pack.features()),
        "kernel": kernel(pack, manifest, full),
        "files": manifest.files,
        "cameras": named(&manifest.cameras),
        "instances": named(&manifest.instances),
        "materials": named(&manifest.materials),
        "textures": named(&manifest.textures),
        "lights": named(&manifest.lights),
        "counters": counters(manifest),
    })
}

/// As the report of `rtr` has it.
fn kernel(pack: &Pack<Checked>, manifest: &Manifest, full: KernelSize) -> Value {
    let reason = |feature: &Feature| {
        let by = feature.by.as_ref();
        json!({
            "name": feature.name,
            "reason": feature.reason,
            "by": by.map(|by| &by.name),
            "at": by.and_then(|by| manifest.place(by)),
        })
    };
    let section = |row: pack::SectionRow| {
        json!({
            "name": row.kind,
            "version": row.version,
            "elements": row.count,
            "element_bytes": row.elem_size,
            "bytes": row.bytes,
            "binding": row.binding,
            "blake3": row.hash,
        })
    };
    json!({
        "kept": manifest.features_kept.iter().map(reason).collect::<Value>(),
        "left_out": manifest.features_left_out.iter().map(reason).collect::<Value>(),
        "sections": pack::describe(pack).into_iter().map(section).collect::<Value>(),
        "wgsl_lines": manifest.kernel.lines,
        "spirv_words": manifest.kernel.words,
        "full_wgsl_lines": full.lines,
        "full_spirv_words": full.words,
    })
}

fn declared(manifest: &Manifest, named: &Named) -> Value {
    json!({ "name": named.name, "at": manifest.place(named) })
}

fn counters(manifest: &Manifest) -> Value {
    let counter = |(name, count): &(String, u64)| json!({ "name": name, "count": count });
    manifest.counters.iter().map(counter).collect()
}
