//! No kernel carries anything that its scene cannot reach: no function, no buffer or variable, no struct,
//! no constant, no alias; for every example and every case of a feature.
//!
//! Functions, variables and types are looked at in naga's IR, which does not know how kernels are linked.
//! Constants and aliases are gone there, folded into what uses them; they are looked for as words.

use std::collections::BTreeSet;

use naga::proc::TypeResolution;
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    Block, Expression, Function, GlobalVariable, Handle, Module, Statement, Type, TypeInner,
};
use rayon::prelude::*;
use shaders::Linked;
use tests::features::{CASES, compiled};

/// What the entry point reaches.
#[derive(Default)]
struct Reached {
    functions: BTreeSet<Handle<Function>>,
    globals: BTreeSet<Handle<GlobalVariable>>,
    types: BTreeSet<Handle<Type>>,
}

/// Everything in the kernel that nothing reaches, by kind and name.
fn dead(kernel: &Linked) -> Vec<String> {
    let (module, info) = shaders::validate(kernel).expect("kernels are valid");
    let reached = Reached::of(&module, &info);
    let name = |name: &Option<String>| name.clone().unwrap_or_else(|| "?".to_owned());
    let mut found = Vec::new();
    for (handle, function) in module.functions.iter() {
        if !reached.functions.contains(&handle) {
            found.push(format!("function {}", name(&function.name)));
        }
    }
    for (handle, global) in module.global_variables.iter() {
        if !reached.globals.contains(&handle) {
            found.push(format!("variable {}", name(&global.name)));
        }
    }
    for (handle, ty) in module.types.iter() {
        // Types without a name are naga's own.
        if ty.name.is_some() && !reached.types.contains(&handle) {
            found.push(format!("type {}", name(&ty.name)));
        }
    }
    found.extend(unused_words(&kernel.text));
    found
}

impl Reached {
    fn of(module: &Module, info: &ModuleInfo) -> Self {
        let mut reached = Self::default();
        let entry = &module.entry_points[0].function;
        reached.function(module, entry, info.get_entry_point(0));
        let mut open = calls(&entry.body);
        while let Some(handle) = open.pop() {
            if reached.functions.insert(handle) {
                let function = &module.functions[handle];
                reached.function(module, function, &info[handle]);
                open.extend(calls(&function.body));
            }
        }
        reached
    }

    fn function(&mut self, module: &Module, function: &Function, info: &FunctionInfo) {
        let arguments = function.arguments.iter().map(|argument| argument.ty);
        let results = function.result.iter().map(|result| result.ty);
        let locals = function.local_variables.iter().map(|(_, local)| local.ty);
        for ty in arguments.chain(results).chain(locals) {
            self.ty(module, ty);
        }
        for (handle, expression) in function.expressions.iter() {
            match expression {
                Expression::GlobalVariable(global) if self.globals.insert(*global) => {
                    self.ty(module, module.global_variables[*global].ty);
                }
                Expression::Compose { ty, .. } | Expression::ZeroValue(ty) => self.ty(module, *ty),
                _ => {}
            }
            if let TypeResolution::Handle(ty) = &info[handle].ty {
                self.ty(module, *ty);
            }
        }
    }

    /// A type and what it is made of.
    fn ty(&mut self, module: &Module, ty: Handle<Type>) {
        if !self.types.insert(ty) {
            return;
        }
        match &module.types[ty].inner {
            TypeInner::Struct { members, .. } => {
                for member in members {
                    self.ty(module, member.ty);
                }
            }
            TypeInner::Array { base, .. } | TypeInner::Pointer { base, .. } => {
                self.ty(module, *base);
            }
            _ => {}
        }
    }
}

fn calls(block: &Block) -> Vec<Handle<Function>> {
    let inside = |blocks: &[&Block]| blocks.iter().flat_map(|block| calls(block)).collect();
    let of = |statement: &Statement| -> Vec<Handle<Function>> {
        match statement {
            Statement::Call { function, .. } => vec![*function],
            Statement::Block(block) => inside(&[block]),
            Statement::If { accept, reject, .. } => inside(&[accept, reject]),
            Statement::Loop { body, continuing, .. } => inside(&[body, continuing]),
            Statement::Switch { cases, .. } => {
                inside(&cases.iter().map(|case| &case.body).collect::<Vec<_>>())
            }
            _ => Vec::new(),
        }
    };
    block.iter().flat_map(of).collect()
}

/// Constants and aliases whose name stands nowhere but in their own declaration, or in one of those. All else
/// is proven to be reached, so a word in it is a use.
fn unused_words(text: &str) -> Vec<String> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let mut lines: Vec<&str> = code.filter(|line| !line.trim().is_empty()).collect();
    let words = |line: &str| -> Vec<String> {
        let words = line.split(|c: char| c != '_' && !c.is_ascii_alphanumeric());
        words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
    };
    let mut found = Vec::new();
    loop {
        let all: Vec<Vec<String>> = lines.iter().map(|line| words(line)).collect();
        let declared = |words: &[String]| {
            let kind = words.first().filter(|kind| ["const", "alias"].contains(&kind.as_str()))?;
            Some((kind.clone(), words.get(1)?.clone()))
        };
        let unused = all.iter().position(|own| {
            declared(own).is_some_and(|(_, name)| {
                all.iter().flatten().filter(|word| **word == name).count() == 1
            })
        });
        let Some(at) = unused else { return found };
        let (kind, name) = declared(&all[at]).expect("it is one");
        found.push(format!("{kind} {name}"));
        lines.remove(at);
    }
}

#[test]
fn no_kernel_carries_anything_that_its_scene_cannot_reach() {
    let examples = scenes::catalog::EXAMPLES.par_iter().map(|example| {
        (format!("example {}", example.name), tests::scene::example(example, &[]).kernel)
    });
    let cases = CASES.par_iter().map(|case| (case.name.to_owned(), compiled(case).kernel));
    let found: Vec<String> = examples
        .chain(cases)
        .flat_map_iter(|(name, kernel)| {
            dead(&kernel).into_iter().map(move |what| format!("{name}: {what}"))
        })
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn whatever_is_planted_is_found() {
    let clean = compiled(tests::features::named("lens")).kernel;
    assert_eq!(dead(&clean), Vec::<String>::new());
    let plants: [(&str, &[&str]); 6] = [
        ("fn planted(x: f32) -> f32 {\n    return x;\n}\n", &["function planted"]),
        (
            "fn planted() -> f32 {\n    return leaf_of_it();\n}\n\nfn leaf_of_it() -> f32 {\n    return 1.0;\n}\n",
            &["function planted", "function leaf_of_it"],
        ),
        (
            "@group(0) @binding(40) var<storage, read> planted_words: array<vec4<u32>>;\n",
            &["variable planted_words"],
        ),
        ("struct Planted {\n    a: vec4f,\n}\n", &["type Planted"]),
        (
            "const PLANTED: u32 = 3u;\n\nconst HALF: u32 = PLANTED / 2u;\n",
            &["const HALF", "const PLANTED"],
        ),
        ("alias Planted = u32;\n", &["alias Planted", "type Planted"]),
    ];
    for (plant, expected) in plants {
        let mut kernel = clean.clone();
        kernel.text += plant;
        let mut found = dead(&kernel);
        found.sort();
        let mut expected: Vec<&str> = expected.to_vec();
        expected.sort_unstable();
        assert_eq!(found, expected, "{plant}");
    }
}
