//! Every kernel that features can make: valid, without dead code or dead bindings, made of exact
//! arithmetic in forms that drivers keep (see `rewrites/forms.rs`), and translatable for every kind of device.

mod common;
#[path = "rewrites/forms.rs"]
mod forms;
#[path = "rewrites/planted.rs"]
mod planted;
#[path = "rewrites/values.rs"]
mod values;

use common::feature_sets;
use forms::rewrites;
use naga::valid::ModuleInfo;
use naga::{Expression, Function, Handle, MathFunction, Module, Statement};
use shaders::{AOV, FeatureSet, LIGHTS, check_layouts, link, link_with, validate};
use std::collections::BTreeSet;

fn kernel(name: &str, features: &FeatureSet) -> (Module, ModuleInfo) {
    let linked = link(features).unwrap_or_else(|e| panic!("{name}: {e}"));
    validate(&linked).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// Linking and validating is most of the work: every kernel is made once, for all that is asked of it.
#[test]
fn every_single_feature_and_every_pair_is_sound() {
    let sets = feature_sets();
    assert!(sets.len() > 200, "only {} different kernels", sets.len());
    let n_threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let forms: BTreeSet<_> = std::thread::scope(|scope| {
        let check = |first: usize| {
            let own = sets.iter().skip(first).step_by(n_threads);
            own.flat_map(|(name, features)| check_kernel(name, features)).collect::<Vec<_>>()
        };
        let threads: Vec<_> =
            (0..n_threads).map(|first| scope.spawn(move || check(first))).collect();
        threads
            .into_iter()
            .flat_map(|thread| thread.join().expect("every kernel is sound"))
            .collect()
    });
    assert!(forms.is_empty(), "forms that drivers rewrite: {forms:#?}");
}

/// CPUs run the full kernel with what layers need. The picture's part of it is the full kernel to the byte.
#[test]
fn aovs_are_sound_and_leave_the_picture_alone() {
    let full = FeatureSet::full();
    let linked = link_with(&full, &[AOV, LIGHTS]).expect("links");
    let (module, info) = validate(&linked).unwrap_or_else(|e| panic!("{e}"));
    let entries: Vec<&str> = module.entry_points.iter().map(|entry| entry.name.as_str()).collect();
    assert!(entries.contains(&"render") && entries.contains(&"aov"), "{entries:?}");
    check_layouts(&module).unwrap_or_else(|e| panic!("{e}"));
    check_arithmetic("aov", &module);
    let forms = rewrites(&module, &info);
    assert!(forms.is_empty(), "forms that drivers rewrite: {forms:#?}");
    let picture = link(&full).expect("links").text;
    let lines: BTreeSet<&str> = linked.text.lines().collect();
    assert!(picture.lines().all(|line| lines.contains(line)));
}

/// Function and form of what drivers may compute in another order; everything else is asserted.
fn check_kernel(name: &str, features: &FeatureSet) -> Vec<(String, String)> {
    let (module, info) = kernel(name, features);
    check_layouts(&module).unwrap_or_else(|e| panic!("{name}: {e}"));
    check_no_dead_code(name, features, &module);
    check_arithmetic(name, &module);
    // Translation is slow in a debug build: one kernel for each feature on each geometry is enough, because
    // a pair adds no construct that its members lack.
    let one_feature = name.split(" + ").collect::<BTreeSet<_>>().len() == 1;
    let halves: Vec<&str> = name.split(" + ").collect();
    let same_twice = halves.len() == 2 && halves[0].ends_with(halves[1]);
    if one_feature || same_twice {
        translate(name, &module, &info);
    }
    let form = |form: String| {
        // The number of the expression differs from kernel to kernel, the function does not.
        let function = form.split(' ').next().unwrap_or_default().to_owned();
        let what = form.split_once(": ").map_or(form.as_str(), |parts| parts.1).to_owned();
        (function, what)
    };
    rewrites(&module, &info).into_iter().map(form).collect()
}

fn translate(name: &str, module: &Module, info: &ModuleInfo) {
    let spv = naga::back::spv::Options::default();
    let words = naga::back::spv::write_vec(module, info, &spv, None)
        .unwrap_or_else(|e| panic!("{name}: SPIR-V: {e}"));
    assert_eq!(words[0], 0x0723_0203, "{name}: SPIR-V magic number");
    // Metal reverses bits from 2.1 on (macOS 10.14, 2018).
    let msl = naga::back::msl::Options {
        lang_version: (2, 1),
        fake_missing_bindings: true,
        ..Default::default()
    };
    let (text, _) = naga::back::msl::write_string(
        module,
        info,
        &msl,
        &naga::back::msl::PipelineOptions::default(),
    )
    .unwrap_or_else(|e| panic!("{name}: MSL: {e}"));
    assert!(text.contains("kernel void render"), "{name}: MSL entry point");
    let hlsl = naga::back::hlsl::Options { fake_missing_bindings: true, ..Default::default() };
    let mut text = String::new();
    naga::back::hlsl::Writer::new(&mut text, &hlsl, &naga::back::hlsl::PipelineOptions::default())
        .write(module, info, None)
        .unwrap_or_else(|e| panic!("{name}: HLSL: {e}"));
    assert!(text.contains("numthreads(8, 8, 1)"), "{name}: HLSL entry point");
}

/// Functions are reached from `render`, and the globals are the bindings that the features promise, plus the
/// stack where there is geometry.
fn check_no_dead_code(name: &str, features: &FeatureSet, module: &Module) {
    let mut reached: BTreeSet<Handle<Function>> = BTreeSet::new();
    let entry = &module.entry_points[0].function;
    let mut globals: BTreeSet<String> = BTreeSet::new();
    let mut open = calls(entry);
    collect_globals(module, entry, &mut globals);
    while let Some(handle) = open.pop() {
        if reached.insert(handle) {
            open.extend(calls(&module.functions[handle]));
            collect_globals(module, &module.functions[handle], &mut globals);
        }
    }
    for (handle, function) in module.functions.iter() {
        let function = function.name.as_deref().unwrap_or("?");
        assert!(reached.contains(&handle), "{name}: `{function}` is not reached from `render`");
    }
    let bindings = features.bindings().expect("the set links");
    let mut promised: BTreeSet<String> = bindings.into_iter().map(|b| b.name).collect();
    if features.geometry() {
        promised.insert("stack".to_owned());
    }
    assert_eq!(globals, promised, "{name}: buffers in use against buffers promised");
    assert_eq!(module.global_variables.len(), promised.len(), "{name}: globals that nothing uses");
}

fn collect_globals(module: &Module, function: &Function, found: &mut BTreeSet<String>) {
    for (_, expression) in function.expressions.iter() {
        if let Expression::GlobalVariable(handle) = expression {
            found.extend(module.global_variables[*handle].name.clone());
        }
    }
}

fn calls(function: &Function) -> Vec<Handle<Function>> {
    fn walk(block: &naga::Block, found: &mut Vec<Handle<Function>>) {
        for statement in block {
            match statement {
                Statement::Call { function, .. } => found.push(*function),
                Statement::Block(inner) => walk(inner, found),
                Statement::If { accept, reject, .. } => {
                    walk(accept, found);
                    walk(reject, found);
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        walk(&case.body, found);
                    }
                }
                Statement::Loop { body, continuing, .. } => {
                    walk(body, found);
                    walk(continuing, found);
                }
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    walk(&function.body, &mut found);
    found
}

/// Only built-ins whose result every device rounds alike.
fn check_arithmetic(name: &str, module: &Module) {
    let exact = [
        MathFunction::Abs,
        MathFunction::Min,
        MathFunction::Max,
        MathFunction::Clamp,
        MathFunction::Floor,
        MathFunction::Sqrt,
        MathFunction::Dot,
        MathFunction::ReverseBits,
        MathFunction::Unpack4xU8,
    ];
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    for function in module.functions.iter().map(|(_, function)| function).chain(entries) {
        for (_, expression) in function.expressions.iter() {
            let in_function = function.name.as_deref().unwrap_or("?");
            match expression {
                Expression::Math { fun, .. } => assert!(
                    exact.contains(fun),
                    "{name}: `{in_function}` uses {fun:?}, which devices round differently"
                ),
                Expression::Derivative { .. } => panic!("{name}: `{in_function}` has derivatives"),
                _ => {}
            }
        }
    }
}

#[test]
fn a_scene_without_spheres_has_no_sphere_code_and_no_sphere_binding() {
    let mut features = FeatureSet::full();
    features.spheres = false;
    features.lights.remove(&pack::abi::LightKind::Sphere);
    let linked = link(&features).expect("links");
    let (module, _) = validate(&linked).expect("is valid");
    let functions = module.functions.iter().filter_map(|(_, f)| f.name.clone());
    let globals = module.global_variables.iter().filter_map(|(_, g)| g.name.clone());
    let types = module.types.iter().filter_map(|(_, t)| t.name.clone());
    for item in functions.chain(globals).chain(types) {
        let plain = item.to_lowercase();
        assert!(!plain.contains("sphere"), "`{item}` is in a kernel without spheres");
    }
    assert!(features.bindings().expect("few").iter().all(|binding| binding.number != 6));
    // The same question to the kernel with spheres, so that the test can fail.
    assert!(link(&FeatureSet::full()).expect("links").text.contains("sphere_words"));
}

#[test]
fn every_declaration_of_every_module_is_in_some_kernel() {
    let mut missing: BTreeSet<(&str, &str)> = BTreeSet::new();
    for (file, text) in shaders::module_texts() {
        missing.extend(declared_functions(text).map(|function| (*file, function)));
    }
    let lens = FeatureSet { lens: true, ..FeatureSet::empty() };
    let with_aov = link_with(&FeatureSet::full(), &[AOV, LIGHTS]).expect("links").text;
    let present: BTreeSet<&str> = declared_functions(&with_aov).collect();
    missing.retain(|(_, function)| !present.contains(function));
    // The full one has most of them.
    let first = [&FeatureSet::full(), &lens];
    for features in first.into_iter().chain(feature_sets().iter().map(|(_, features)| features)) {
        if missing.is_empty() {
            break;
        }
        let text = link(features).expect("links").text;
        let present: BTreeSet<&str> = declared_functions(&text).collect();
        missing.retain(|(_, function)| !present.contains(function));
    }
    assert_eq!(missing, BTreeSet::new(), "functions that no kernel has");
}

fn declared_functions(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| line.strip_prefix("fn ")?.split('(').next())
}

#[test]
fn sections_beyond_128_mib_are_bound_in_windows() {
    let mut features = FeatureSet::full();
    features.spheres = false;
    features.textures.clear();
    features.lights.remove(&pack::abi::LightKind::Sphere);
    features.windows.tri = 2;
    features.windows.shade = 2;
    let text = link(&features).expect("few storage buffers").text;
    assert!(text.contains("@binding(12) var<storage, read> tri_words_1"));
    assert!(text.contains("return tri_words_1[i - 8388608u];"));
    kernel("windows", &features);
    features.windows.node = 24;
    link(&features).expect("thirty storage buffers");
    features.windows.node = 25;
    let error = link(&features).expect_err("thirty-one storage buffers");
    assert_eq!(
        error.to_string(),
        "the scene is too large: it needs 31 storage buffers of 128 MiB, and a kernel has 30 at most"
    );
}

#[test]
fn the_stack_is_as_long_as_the_scene_needs() {
    let features = FeatureSet { stack_size: 23, ..FeatureSet::full() };
    assert!(link(&features).expect("links").text.contains("const STACK_SIZE: u32 = 0x17u;"));
}
