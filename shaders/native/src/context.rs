//! One module on its way to Rust: what naga knows of it, and the names it gets.

use crate::error::NativeError;
use crate::names::{Names, PATTERNS, TYPE_NAMES};
use crate::options::{ByHand, Precision, Seam};
use naga::valid::ModuleInfo;
use naga::{Constant, Function, GlobalVariable, Handle, Module, Override, Span, Type, TypeInner};

/// What every part of the walk needs to know.
pub(crate) struct Context<'a> {
    pub(crate) module: &'a Module,
    pub(crate) info: &'a ModuleInfo,
    pub(crate) source: &'a str,
    pub(crate) precision: Precision,
    structs: Vec<String>,
    fields: Vec<Vec<String>>,
    constants: Vec<Option<String>>,
    overrides: Vec<String>,
    globals: Vec<String>,
    functions: Vec<String>,
    pub(crate) entry_points: Vec<String>,
    /// Path of the Rust function that does a function's work, and the name of the translation.
    pub(crate) seams: Vec<Option<(&'a str, String)>>,
    /// As in `ByHand`.
    pub(crate) companion: Option<&'a str>,
    /// WGSL names of the functions that are compiled with the module, and not with their callers.
    pub(crate) entrances: &'a [&'a str],
}

impl<'a> Context<'a> {
    /// Gives every item of the module its Rust name.
    pub(crate) fn new(
        module: &'a Module,
        info: &'a ModuleInfo,
        source: &'a str,
        precision: Precision,
        by_hand: ByHand<'a>,
    ) -> Result<Self, NativeError> {
        let mut types = Names::with(TYPE_NAMES.iter().copied());
        let mut structs = Vec::new();
        let mut fields = Vec::new();
        for (_, ty) in module.types.iter() {
            let (name, members) = match &ty.inner {
                TypeInner::Struct { members, .. } => {
                    let mut names = Names::default();
                    let members = members
                        .iter()
                        .map(|m| names.add(m.name.as_deref().unwrap_or("member")))
                        .collect();
                    (types.add(ty.name.as_deref().unwrap_or("Unnamed")), members)
                }
                _ => (String::new(), Vec::new()),
            };
            structs.push(name);
            fields.push(members);
        }
        let mut values = Names::with(PATTERNS.iter().copied());
        let constants = module
            .constants
            .iter()
            .map(|(_, constant)| {
                let inner = &module.types[constant.ty].inner;
                let name = constant.name.as_ref()?;
                (!inner.is_abstract(&module.types)).then(|| values.add(name))
            })
            .collect();
        let overrides = module
            .overrides
            .iter()
            .map(|(_, constant)| values.add(constant.name.as_deref().unwrap_or("override_")))
            .collect();
        let mut members = Names::with(["unused", "companion"]);
        let globals = module
            .global_variables
            .iter()
            .map(|(_, global)| members.add(global.name.as_deref().unwrap_or("global")))
            .collect();
        let mut methods = Names::with(["new"]);
        let entry_points = module.entry_points.iter().map(|e| methods.add(&e.name)).collect();
        let functions = module
            .functions
            .iter()
            .map(|(_, function)| methods.add(function.name.as_deref().unwrap_or("function")))
            .collect();
        let seams = seam_of_each(module, by_hand.seams, &mut methods)?;
        Ok(Self {
            module,
            info,
            source,
            precision,
            structs,
            fields,
            constants,
            overrides,
            globals,
            functions,
            entry_points,
            seams,
            companion: by_hand.companion,
            entrances: entrances_of(module, by_hand.entrances)?,
        })
    }

    /// The error for a construct that has no faithful translation.
    pub(crate) fn refuse(&self, span: Span, construct: &str) -> NativeError {
        NativeError::at(span, self.source, format!("{construct} has no CPU translation"))
    }

    /// The Rust name of a struct.
    pub(crate) fn struct_name(&self, ty: Handle<Type>) -> &str {
        &self.structs[ty.index()]
    }

    /// The Rust names of a struct's members.
    pub(crate) fn field_names(&self, ty: Handle<Type>) -> &[String] {
        &self.fields[ty.index()]
    }

    /// The Rust name of a constant, if it is one in Rust too.
    pub(crate) fn constant_name(&self, constant: Handle<Constant>) -> Option<&str> {
        self.constants[constant.index()].as_deref()
    }

    /// The Rust name of an override.
    pub(crate) fn override_name(&self, constant: Handle<Override>) -> &str {
        &self.overrides[constant.index()]
    }

    /// The member of `Kernel` that holds a global variable.
    pub(crate) fn global_name(&self, global: Handle<GlobalVariable>) -> &str {
        &self.globals[global.index()]
    }

    /// The method of `Kernel` that a function becomes.
    pub(crate) fn function_name(&self, function: Handle<Function>) -> &str {
        &self.functions[function.index()]
    }

    /// All names that a local variable must not take.
    pub(crate) fn value_names(&self) -> impl Iterator<Item = &str> {
        self.constants.iter().flatten().chain(&self.overrides).map(String::as_str)
    }
}

/// What stands in for each function of the module, if anything does.
fn seam_of_each<'a>(
    module: &Module,
    seams: &[Seam<'a>],
    methods: &mut Names,
) -> Result<Vec<Option<(&'a str, String)>>, NativeError> {
    let mut found = vec![None; module.functions.len()];
    for seam in seams {
        let index = named(module, seam.function, "a seam")?;
        found[index] = Some((seam.path, methods.add(&format!("generated_{}", seam.function))));
    }
    Ok(found)
}

/// The same names, all of which are functions of the module.
fn entrances_of<'a>(
    module: &Module,
    entrances: &'a [&'a str],
) -> Result<&'a [&'a str], NativeError> {
    for entrance in entrances {
        named(module, entrance, "an entrance")?;
    }
    Ok(entrances)
}

/// Index of the function that the WGSL names so, which is asked for as `what`.
fn named(module: &Module, name: &str, what: &str) -> Result<usize, NativeError> {
    let is = |function: &Function| function.name.as_deref() == Some(name);
    let index = module.functions.iter().position(|(_, function)| is(function));
    index.ok_or_else(|| NativeError::nowhere(format!("there is no function `{name}` for {what}")))
}
