//! The linker: exact places, unknown imports, cycles, repeated names.

use shaders::{
    FeatureSet, Linked, ShaderError, generated_texts, link_modules, module_texts, root_module,
    validate,
};

/// The full kernel with the text of one module changed.
fn full_with(module: &str, change: impl Fn(&str) -> String) -> Linked {
    let features = FeatureSet::full();
    let generated = generated_texts(&features).expect("generates");
    let changed = module_texts().iter().find(|(name, _)| *name == module).map(|row| change(row.1));
    let changed = changed.expect("the module exists");
    let modules: Vec<(&str, &str)> = module_texts()
        .iter()
        .map(|(name, text)| (*name, if *name == module { changed.as_str() } else { *text }))
        .chain(generated.iter().map(|(name, text)| (*name, text.as_str())))
        .collect();
    link_modules(&modules, root_module(&features)).expect("links")
}

#[test]
fn a_planted_syntax_error_is_reported_where_it_was_written() {
    let linked = full_with("bsdf/ggx.wgsl", |text| {
        text.replacen("let k = alpha / t;", "let k = alpha // t;", 1)
    });
    let error = validate(&linked).expect_err("the line has lost its semicolon");
    let ShaderError::Parse { at, .. } = error else { panic!("a parse error, not {error}") };
    assert_eq!(at.file, "bsdf/ggx.wgsl");
    let planted = line_of("bsdf/ggx.wgsl", "let k = alpha / t;");
    assert_eq!(at.line, planted + 1, "naga points at the first token after the hole");
}

#[test]
fn a_planted_type_error_is_reported_where_it_was_written() {
    let linked = full_with("shape/sphere.wgsl", |text| {
        text.replacen("let root = sqrt(d);", "let root = d + 1u;", 1)
    });
    let error = validate(&linked).expect_err("f32 + u32");
    let (ShaderError::Parse { at, .. } | ShaderError::Invalid { at, .. }) = error else {
        panic!("naga's error, not {error}")
    };
    assert_eq!(at.file, "shape/sphere.wgsl");
    assert_eq!(at.line, line_of("shape/sphere.wgsl", "let root = sqrt(d);"));
}

fn line_of(module: &str, needle: &str) -> u32 {
    let (_, text) = module_texts().iter().find(|row| row.0 == module).expect("the module exists");
    let line = text.lines().position(|line| line.contains(needle)).expect("the line exists");
    u32::try_from(line + 1).expect("modules are short")
}

#[test]
fn every_byte_of_a_kernel_has_its_place() {
    let linked = full_with("math/basis.wgsl", str::to_owned);
    // What is generated in the place of a file has lines of its own.
    let generated = shaders::generated_texts(&FeatureSet::full()).expect("all is generated");
    // Function names are unique, so each must be found at its own declaration.
    let mut n_found = 0;
    for (start, _) in linked.text.match_indices("\nfn ") {
        let at = linked.locate(start + 1);
        let declaration = linked.text[start + 1..].lines().next().expect("a line");
        let replaced =
            generated.iter().find(|(name, _)| *name == at.file && !name.starts_with("scene/"));
        let replaced = replaced.map(|(_, text)| text.as_str());
        let file = module_texts().iter().find(|(name, _)| *name == at.file).map(|(_, text)| *text);
        if let Some(text) = replaced.or(file) {
            let there = text.lines().nth(at.line as usize - 1).expect("the line exists");
            assert_eq!((there, at.column), (declaration, 1), "{at}");
            n_found += 1;
        } else {
            assert!(at.file.starts_with("scene/"), "{at}");
        }
    }
    assert!(n_found > 80, "only {n_found} functions were looked up");
}

#[test]
fn wrong_modules_are_errors_with_their_place() {
    let entry = "@compute @workgroup_size(1) fn render() { f(); }\n";
    let root = format!("// Root.\n#import \"a.wgsl\"\n{entry}");
    let check = |modules: &[(&str, &str)], expected: &str| {
        let mut all = vec![("root.wgsl", root.as_str())];
        all.extend(modules);
        let error = link_modules(&all, "root.wgsl").expect_err(expected);
        assert_eq!(error.to_string(), expected);
    };
    check(&[], "root.wgsl:2:1: unknown module `a.wgsl`");
    check(
        &[("a.wgsl", "#import \"b.wgsl\"\n"), ("b.wgsl", "\n#import \"a.wgsl\"\nfn f() {}\n")],
        "b.wgsl:2:1: import cycle: a.wgsl -> b.wgsl -> a.wgsl",
    );
    check(
        &[("a.wgsl", "#import \"a.wgsl\"\nfn f() {}\n")],
        "a.wgsl:1:1: import cycle: a.wgsl -> a.wgsl",
    );
    check(
        &[("a.wgsl", "#import \"b.wgsl\"\n\nfn f() {}\n"), ("b.wgsl", "// A.\nfn f() {}\n")],
        "a.wgsl:3:1: `f` is already declared at b.wgsl:2:1",
    );
    check(&[("a.wgsl", "#ifdef X\nfn f() {}\n")], "a.wgsl:1:1: expected `#import \"name.wgsl\"`");
    let error = link_modules(&[("x.wgsl", "fn f() {}\n")], "x.wgsl").expect_err("no entry");
    assert_eq!(error.to_string(), "x.wgsl: no function `render`");
}

#[test]
fn a_module_is_pasted_once_and_only_what_is_used() {
    let modules = [
        (
            "root.wgsl",
            "#import \"a.wgsl\"\n#import \"b.wgsl\"\n@compute @workgroup_size(1) fn render() { a(); b(); }\n",
        ),
        ("a.wgsl", "#import \"c.wgsl\"\nfn a() { c(); }\nfn unused() { c(); }\n"),
        ("b.wgsl", "#import \"c.wgsl\"\nfn b() { c(); }\n"),
        ("c.wgsl", "const N: u32 = 1u;\nconst M: u32 = 2u;\nfn c() { let x = N; }\n"),
    ];
    let linked = link_modules(&modules, "root.wgsl").expect("links");
    assert_eq!(linked.files(), ["c.wgsl", "a.wgsl", "b.wgsl", "root.wgsl"]);
    assert_eq!(linked.text.matches("fn c()").count(), 1);
    assert!(!linked.text.contains("unused") && !linked.text.contains("const M"));
    validate(&linked).expect("is valid");
}
