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
    heap("VertexColors", "vertex_colors", "abi/vertex_colors.wgsl", "vertex_color_at"),
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

/// The beginning of a record, a struct and a loader of its own: what is asked every time, where the rest is asked
/// seldom and field by field.
struct Head {
    record: &'static str,
    name: &'static str,
    stem: &'static str,
    module: &'static str,
    n_words: usize,
}

const HEADS: [Head; 1] = [Head {
    record: "Material",
    name: "MaterialHead",
    stem: "material_head",
    module: "abi/material_head.wgsl",
    n_words: 6,
}];

impl Head {
    fn fields<'a>(&self, record: &'a Record) -> &'a [Field] {
        let n = record.fields.iter().take_while(|field| field.offset < 16 * self.n_words).count();
        &record.fields[..n]
    }
}

/// Records that the kernel writes: name, beginning of the function's name, module; the others are in [`TABLES`].
const WRITTEN: [(&str, &str, &str); 2] =
    [("FilmPixel", "film", "abi/film.wgsl"), ("AovSample", "aov", "abi/aov.wgsl")];

/// The module of each struct, and its text; the same for every scene. A record that has no table is an error of
/// the test that parses them all.
pub(crate) fn structs() -> Vec<(&'static str, String)> {
    let written = WRITTEN.map(|(record, _, module)| (record, module));
    let modules = TABLES.iter().map(|table| (table.record, table.module)).chain(written);
    let records = abi::records();
    let find = |name: &str| records.iter().find(|record| record.name == name);
    let whole = modules.filter_map(|(name, module)| {
        let record = find(name)?;
        Some((module, struct_text(name, record.doc, record.fields)))
    });
    let heads = HEADS.iter().filter_map(|head| {
        let doc = format!(" The first words of a `{}`: what every vertex asks.", head.record);
        Some((head.module, struct_text(head.name, &[&doc], head.fields(find(head.record)?))))
    });
    whole.chain(heads).collect()
}

/// The struct as it would be written by hand; padding explains itself.
fn struct_text(name: &str, doc: &[&str], fields: &[Field]) -> String {
    let mut text = String::new();
    for line in doc {
        let _ = writeln!(text, "//{line}");
    }
    let _ = writeln!(text, "struct {name} {{");
    for field in fields {
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
    modules.extend(HEADS.iter().map(|head| head.module));
    modules.push("scene/bindings.wgsl");
    text += &super::wgsl::imports(modules);
    for record in abi::records() {
        let Record { name, fields, size, .. } = record;
        if let Some(table) = TABLES.iter().find(|table| table.record == name) {
            text += &loader(table, (name, table.stem), fields, [size / 16; 2]);
            for head in HEADS.iter().filter(|head| head.record == name) {
                let n_words = [head.n_words, size / 16];
                text += &loader(table, (head.name, head.stem), head.fields(&record), n_words);
            }
            text += &field_loaders(table, fields, size / 16);
        } else if let Some((_, stem, _)) = WRITTEN.iter().find(|written| written.0 == name) {
            text += &store(name, stem, fields, size / 16);
        }
    }
    text
}

/// `load_<stem>(i)`: the struct `name` of `fields`, which lie in the first `n_words` words of a record of `stride`.
fn loader(
    table: &Table,
    (name, stem): (&str, &str),
    fields: &[Field],
    [n_words, stride]: [usize; 2],
) -> String {
    let mut text = format!("\nfn load_{stem}({}) -> {name} {{\n", parameter(table));
    let first = first(table, stride);
    if let Some(at) = &first {
        let _ = writeln!(text, "    let at = {at};");
    }
    for w in 0..n_words {
        let _ = writeln!(text, "    let w{w} = {};", word(table, first.as_ref().map(|_| "at"), w));
    }
    let values: Vec<String> =
        fields.iter().map(|field| decode(field, &format!("w{}", field.offset / 16))).collect();
    let _ =
        writeln!(text, "    return {name}(\n        {},\n    );\n}}", values.join(",\n        "));
    text
}

/// `load_<stem>_<field>(i)` of every field.
fn field_loaders(table: &Table, fields: &[Field], n_words: usize) -> String {
    let mut text = String::new();
    let first = first(table, n_words);
    for field in fields.iter().filter(|field| !field.name.starts_with("_pad")) {
        let value = decode(field, &word(table, first.as_deref(), field.offset / 16));
        let (stem, name, ty) = (table.stem, field.name, field.ty.wgsl());
        let _ = writeln!(
            text,
            "\nfn load_{stem}_{name}({}) -> {ty} {{\n    return {value};\n}}",
            parameter(table)
        );
    }
    text
}

fn parameter(table: &Table) -> &'static str {
    if table.single { "" } else { "i: u32" }
}

/// The expression for the first word of the record with index `i`, of `stride` words; a `Frame` has an array alone.
fn first(table: &Table, stride: usize) -> Option<String> {
    let index = format!("i * {stride}u");
    match table.heap_at {
        Some(at) if table.single => Some(format!("load_frame_{at}()")),
        Some(at) => Some(format!("load_frame_{at}() + {index}")),
        None => (!table.single).then_some(index),
    }
}

/// The expression that reads word `w` of the record whose first is `at`.
fn word(table: &Table, at: Option<&str>, w: usize) -> String {
    match at {
        Some(at) => format!("{}({at} + {w}u)", table.word),
        None => format!("{}[{w}]", table.word),
    }
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
