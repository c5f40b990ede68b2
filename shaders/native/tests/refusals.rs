//! Faithful or refused: what has no translation is an error that names it, with line and column.

use native::{NativeError, Precision, generate};

/// Checks that both precisions refuse `source` at `line` in words that contain `words`.
fn check(source: &str, line: u32, words: &str) {
    for precision in [Precision::F32, Precision::F64] {
        let error = generate(source, precision).expect_err("this must be refused");
        assert!(error.message.contains(words), "{error} does not say {words:?}");
        assert_eq!(error.line, line, "{error}");
        assert!(error.column > 0, "{error}");
    }
}

#[test]
fn atomics() {
    let source = "@group(0) @binding(0) var<storage, read_write> counter: atomic<u32>;
fn f() -> u32 {
    return atomicAdd(&counter, 1u);
}";
    check(source, 1, "atomic");
    let source = "struct Counters {
    n: u32,
    hits: atomic<u32>,
}
@group(0) @binding(0) var<storage, read_write> counters: Counters;
fn f() { atomicStore(&counters.hits, 1u); }";
    check(source, 1, "atomic");
}

#[test]
fn barriers() {
    check("fn f() {\n    storageBarrier();\n}", 2, "a barrier");
    check("@compute @workgroup_size(1)\nfn main() {\n  workgroupBarrier();\n}", 3, "a barrier");
}

#[test]
fn workgroup_variables() {
    let source = "\nvar<workgroup> shared_sum: array<u32, 4>;
fn f() -> u32 {
    return shared_sum[0];
}";
    check(source, 2, "var<workgroup>");
}

#[test]
fn textures_and_samplers() {
    let source = "@group(0) @binding(0) var image: texture_2d<f32>;
fn f() -> vec4<f32> {
    return textureLoad(image, vec2<i32>(0), 0);
}";
    check(source, 1, "texture");
    let source = "@group(0) @binding(0) var nearest: sampler;\n";
    check(source, 1, "sampler");
    let source = "@group(0) @binding(0) var out: texture_storage_2d<rgba8unorm, write>;
fn f() { textureStore(out, vec2<i32>(0), vec4<f32>(1.0)); }";
    check(source, 1, "texture");
}

#[test]
fn other_widths() {
    check("enable f16;\nfn f(x: f16) -> f16 {\n    return x * 2.0h;\n}", 2, "16 bits");
    check("fn f() -> f32 {\n    var x: f64 = 1.0lf;\n    return f32(x);\n}", 2, "64 bits");
    check("fn f() -> u32 {\n    let x = 3lu;\n    return u32(x * x);\n}", 3, "64 bits");
}

#[test]
fn other_stages_and_builtins() {
    let source = "@fragment\nfn main() -> @location(0) vec4<f32> { return vec4<f32>(1.0); }";
    assert!(generate(source, Precision::F32).unwrap_err().message.contains("Fragment"));
    let source = "@compute @workgroup_size(1)
fn main(@builtin(local_invocation_index) i: u32) {
    var x = i;
    x += 1u;
}";
    check(source, 2, "LocalInvocationIndex");
    check("fn f(x: f32) -> f32 {\n    return dpdx(x);\n}", 2, "derivative");
}

#[test]
fn subgroups() {
    let source = "fn f(x: u32) -> u32 {\n    return subgroupAdd(x);\n}";
    check(source, 2, "subgroup");
}

#[test]
fn pointers_that_rust_cannot_lend() {
    let source = "var<private> counter: u32;
fn bump(x: ptr<private, u32>) { *x += 1u; }
fn f() { bump(&counter); }";
    check(source, 2, "Private");
    let source = "fn swap(a: ptr<function, u32>, b: ptr<function, u32>) {
    let t = *a;
    *a = *b;
    *b = t;
}
fn f() -> u32 {
    var list = array<u32, 2>(1u, 2u);
    swap(&list[0], &list[1]);
    return list[0];
}";
    check(source, 8, "two pointers into one variable");
}

#[test]
fn arrays_whose_length_is_known_late() {
    let source = "override n: u32 = 4u;
var<workgroup> list: array<u32, n>;
fn f() -> u32 { return list[0]; }";
    check(source, 2, "workgroup");
    let source = "struct Tail {
    n: u32,
    list: array<u32>,
}
@group(0) @binding(0) var<storage, read> tail: Tail;
fn f() -> u32 { return tail.list[2]; }";
    check(source, 1, "runtime-sized array");
    check("\noverride n: u32;\nfn f() -> u32 { return n; }", 2, "`override` without a default");
}

#[test]
fn whatever_naga_refuses_keeps_its_place() {
    check("fn f() -> u32 {\n    return missing;\n}", 2, "missing");
    check("fn f() -> u32 {\n    return 1.5;\n}", 2, "");
    check("fn f( {", 1, "expected");
    check("fn f() {\n    var x = 1u;\n    loop { x += 1u; }\n}\nfn g() -> u32 {\n}", 5, "");
}

#[test]
fn errors_read_as_line_column_message() {
    let source = "fn f() {\n    storageBarrier();\n}";
    let error: NativeError = generate(source, Precision::F32).unwrap_err();
    assert_eq!(error.to_string(), "2:5: a barrier has no CPU translation");
    assert_eq!(source[error.offset..].find("storageBarrier"), Some(0));
}
