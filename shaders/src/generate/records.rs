//! `abi/`: the structs of the records, one module each; `scene/records.wgsl`: loaders that decode words into
//! them, one for each record and one for each field. Both are made from the field tables of `pack::abi`, and
//! the linker keeps what is in use.

use pack::abi::{self, Field, FieldType, Record};
use std::fmt::Write as _;

/// How a record is found: its name in function names, the reader of its section, and the `Frame` field
/// that holds the first word of its table in the heap.
struct Table {
    record: &'static str,
    stem: &'static str,
    module: &'static str,
    word: &'static str,
    heap_at: Option<&'static str>,
    /// There is only one, so that loaders take no index.
    single: bool,
}

const fn section(
    record: &'static str,
    stem: &'static str,
    word: &'static str,
    module: &'static str,
) -> Table {
    Table { record, stem, module, word, heap_at: None, single: false }
}

const fn heap(
    record: &'static str,
    stem: &'static str,
    module: &'static str,
    at: &'static str,
) -> Table {
    Table { record, stem, module, word: "heap_word", heap_at: Some(at), single: false }
}

const TABLES: &[Table] = &[
    Table { single: true, ..section("Frame", "frame", "frame_words", "abi/frame.wgsl") },
    Table { single: true, ..heap("Camera", "camera", "abi/camera.wgsl", "camera_at") },
    Table { single: true, ..heap("Sky", "sky", "abi/sky.wgsl", "sky_at") },
    section("Node", "node", "node_word", "abi/node.wgsl"),
    section("WideNode", "wide_node", "node_word", "abi/wide_node.wgsl"),
    section("Triangle", "triangle", "tri_word", "abi/triangle.wgsl"),
    section("TriShade", "tri_shade", "shade_word", "abi/tri_shade.wgsl"),
    section("Sphere", "sphere", "sphere_word", "abi/sphere.wgsl"),
    heap("Object", "object", "abi/object.wgsl", "object_at"),
    heap("LightLink", "light_link", "abi/light_link.wgsl", "link_at"),
    heap("MotionPiece", "motion_piece", "abi/motion_piece.wgsl", "path_at"),
    heap("CameraKey", "camera_key", "abi/camera_key.wgsl", "camera_key_at"),
    heap("Instance", "instance", "abi/instance.wgsl", "instance_at"),
    heap("Medium", "medium", "abi/medium.wgsl", "medium_at"),
    heap("Material", "material", "abi/material.wgsl", "material_at"),
    heap("Light", "light", "abi/light.wgsl", "light_at"),
    heap("LightNode", "light_node", "abi/light_node.wgsl", "light_tree_at"),
    heap("Texture", "texture", "abi/texture.wgsl", "texture_at"),
    section("TextureOp", "texture_op", "texel_word", "abi/texture_op.wgsl"),
];

/// Records that the kernel writes: name, beginning of the function's name, module; the others are in [`TABLES`].
const WRITTEN: [(&str, &str, &str); 2] =
    [("FilmPixel", "film", "abi/film.wgsl"), ("AovSample", "aov", "abi/aov.wgsl")];

/// The module of each struct, and its text; the same for every scene. A record that has no table is an error of
/// the test that parses them all.
pub(crate) fn structs() -> Vec<(&'static str, String)> {
    let written = WRITTEN.map(|(record, _, module)| (record, module));
    let modules = TABLES.iter().map(|table| (table.record, table.module)).chain(written);
    modules
        .filter_map(|(name, module)| {
            let record = abi::records().into_iter().find(|record| record.name == name)?;
            Some((module, struct_text(&record)))
        })
        .collect()
}

/// The struct as it would be written by hand; padding explains itself.
fn struct_text(record: &Record) -> String {
    let mut text = String::new();
    for line in record.doc {
        let _ = writeln!(text, "//{line}");
    }
    let _ = writeln!(text, "struct {} {{", record.name);
    for field in record.fields {
        for line in field.doc.iter().filter(|_| !field.name.starts_with("_pad")) {
            let _ = writeln!(text, "    //{line}");
        }
        let _ = writeln!(text, "    {}: {},", field.name, field.ty.wgsl());
    }
    text + "}\n"
}

/// The loaders; the same for every scene.
pub(crate) fn text() -> String {
    let mut text =
        String::from("// Generated: loaders of the records, from their field tables.\n\n");
    let mut modules: Vec<&str> = TABLES.iter().map(|table| table.module).collect();
    modules.extend(WRITTEN.map(|(_, _, module)| module));
    modules.push("scene/bindings.wgsl");
    text += &super::wgsl::imports(modules);
    for Record { name, fields, size, .. } in abi::records() {
        if let Some(table) = TABLES.iter().find(|table| table.record == name) {
            text += &loaders(table, fields, size / 16);
        } else if let Some((_, stem, _)) = WRITTEN.iter().find(|written| written.0 == name) {
            text += &store(name, stem, fields, size / 16);
        }
    }
    text
}

fn loaders(table: &Table, fields: &[Field], n_words: usize) -> String {
    let Table { record, stem, .. } = table;
    let parameter = if table.single { "" } else { "i: u32" };
    let mut text = format!("\nfn load_{stem}({parameter}) -> {record} {{\n");
    for w in 0..n_words {
        let _ = writeln!(text, "    let w{w} = {};", word(table, n_words, w));
    }
    let values: Vec<String> =
        fields.iter().map(|field| decode(field, &format!("w{}", field.offset / 16))).collect();
    let _ =
        writeln!(text, "    return {record}(\n        {},\n    );\n}}", values.join(",\n        "));
    for field in fields.iter().filter(|field| !field.name.starts_with("_pad")) {
        let value = decode(field, &word(table, n_words, field.offset / 16));
        let (name, ty) = (field.name, field.ty.wgsl());
        let _ = writeln!(
            text,
            "\nfn load_{stem}_{name}({parameter}) -> {ty} {{\n    return {value};\n}}"
        );
    }
    text
}

/// The expression that reads word `w` of the record with index `i`.
fn word(table: &Table, n_words: usize, w: usize) -> String {
    if table.record == "Frame" {
        return format!("frame_words[{w}]");
    }
    let base = table.heap_at.map_or(String::new(), |at| format!("load_frame_{at}() + "));
    let index = if table.single { String::new() } else { format!("i * {n_words}u + ") };
    format!("{}({base}{index}{w}u)", table.word)
}

/// The expression that takes `field` out of the word that `word` reads.
fn decode(field: &Field, word: &str) -> String {
    let lanes = field.ty.lanes();
    let first = field.offset % 16 / 4;
    let swizzle =
        if lanes == 4 { String::new() } else { format!(".{}", &"xyzw"[first..first + lanes]) };
    if field.ty.is_float() {
        format!("bitcast<{}>({word}{swizzle})", field.ty.wgsl())
    } else {
        format!("{word}{swizzle}")
    }
}

/// `film_store(i, pixel)` and `aov_store(i, pixel)`: each the only write of its kernel.
fn store(record: &str, stem: &str, fields: &[Field], n_words: usize) -> String {
    let mut text = format!("\nfn {stem}_store(i: u32, pixel: {record}) {{\n");
    for w in 0..n_words {
        let lanes: Vec<String> =
            fields.iter().filter(|field| field.offset / 16 == w).map(encode).collect();
        let _ = writeln!(
            text,
            "    film_words[i * {n_words}u + {w}u] = vec4<u32>({});",
            lanes.join(", ")
        );
    }
    text + "}\n"
}

fn encode(field: &Field) -> String {
    let value = format!("pixel.{}", field.name);
    match field.ty {
        FieldType::F32 => format!("bitcast<u32>({value})"),
        FieldType::Vec2F => format!("bitcast<vec2<u32>>({value})"),
        FieldType::Vec3F => format!("bitcast<vec3<u32>>({value})"),
        FieldType::Vec4F => format!("bitcast<vec4<u32>>({value})"),
        FieldType::U32 | FieldType::Vec2U | FieldType::Vec3U | FieldType::Vec4U => value,
    }
}
