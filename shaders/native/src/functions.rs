//! One WGSL function → one Rust method: its signature, its locals, and the bookkeeping of which
//! expressions already have a name.
//!
//! naga's `Emit` says when an expression is evaluated. At that point it becomes a `let`, or stays
//! without a name if its only reader is evaluated in the same `Emit` (or is the statement right
//! after it): nothing can be written in between, so the value cannot differ.

use crate::NativeError;
use crate::context::Context;
use crate::names::{Names, PATTERNS};
use crate::resources::Holding;
use crate::text::Text;
use naga::valid::FunctionInfo;
use naga::{
    AddressSpace, Binding, BuiltIn, EntryPoint, Expression, Function, FunctionArgument,
    GlobalVariable, Handle, ShaderStage, Span, Statement, TypeInner,
};
use std::fmt::Write as _;

/// Where `break` and `continue` go.
pub(crate) enum Scope {
    /// A loop; with a separate label before its continuing block, if it has both.
    Loop { label: String, next: Option<String> },
    /// A switch, which only `break` leaves.
    Switch { label: String },
}

/// The state of the walk through one function.
pub(crate) struct FunctionWriter<'a> {
    pub(crate) cx: &'a Context<'a>,
    pub(crate) fun: &'a Function,
    pub(crate) info: &'a FunctionInfo,
    pub(crate) span: Span,
    pub(crate) out: Text,
    pub(crate) names: Names,
    pub(crate) arguments: Vec<String>,
    pub(crate) locals: Vec<String>,
    /// Local copies of the references to read-only resources, by global.
    pub(crate) aliases: Vec<Option<String>>,
    /// The name of each expression that has been evaluated.
    pub(crate) bound: Vec<Option<String>>,
    /// Expressions that are declared before a loop body and assigned within it.
    pub(crate) hoisted: Vec<Option<String>>,
    pub(crate) scopes: Vec<Scope>,
    pub(crate) n_labels: usize,
    pub(crate) n_temporaries: usize,
}

impl<'a> FunctionWriter<'a> {
    /// Prepares the walk. `span` is where the function stands, if naga knows.
    pub(crate) fn new(
        cx: &'a Context<'a>,
        fun: &'a Function,
        info: &'a FunctionInfo,
        span: Span,
    ) -> Self {
        let mut names = Names::with(cx.value_names().chain(PATTERNS.iter().copied()));
        let arguments = fun
            .arguments
            .iter()
            .map(|argument| names.add(argument.name.as_deref().unwrap_or("argument")))
            .collect();
        let locals = fun
            .local_variables
            .iter()
            .map(|(_, local)| names.add(local.name.as_deref().unwrap_or("local")))
            .collect();
        Self {
            cx,
            fun,
            info,
            span,
            out: Text::at_depth(1),
            names,
            arguments,
            locals,
            aliases: vec![None; cx.module.global_variables.len()],
            bound: vec![None; fun.expressions.len()],
            hoisted: vec![None; fun.expressions.len()],
            scopes: Vec::new(),
            n_labels: 0,
            n_temporaries: 0,
        }
    }

    /// The method for an ordinary function.
    pub(crate) fn write_function(mut self, name: &str) -> Result<String, NativeError> {
        let (parameters, result) = self.signature()?;
        self.write_place();
        let is_entrance =
            self.fun.name.as_deref().is_some_and(|name| self.cx.entrances.contains(&name));
        self.out.line(if is_entrance { "#[inline(never)]" } else { "#[inline]" });
        self.out.open(&format!("pub fn {name}(&mut self{parameters}){result} {{"));
        self.write_body()?;
        self.out.close("}");
        Ok(self.out.finish())
    }

    /// The method that leaves the work to the Rust function at `path`.
    pub(crate) fn write_seam(mut self, name: &str, path: &str) -> Result<String, NativeError> {
        let (parameters, result) = self.signature()?;
        self.write_place();
        self.out.line("#[inline]");
        self.out.open(&format!("pub fn {name}(&mut self{parameters}){result} {{"));
        let mut given = vec!["self".to_owned()];
        given.extend(self.arguments.iter().cloned());
        self.out.line(&crate::text::call(path, &given));
        self.out.close("}");
        Ok(self.out.finish())
    }

    /// The parameters behind `self`, and the arrow with the result.
    fn signature(&self) -> Result<(String, String), NativeError> {
        let mut parameters = String::new();
        for (argument, given) in self.fun.arguments.iter().zip(&self.arguments) {
            let ty = self.parameter_type(argument)?;
            let _ = write!(parameters, ", {given}: {ty}");
        }
        let result = match &self.fun.result {
            Some(result) => {
                format!(" -> {}", self.cx.handle_type(result.ty).map_err(|e| self.place(e))?)
            }
            None => String::new(),
        };
        Ok((parameters, result))
    }

    /// The method for an entry point, which resets the private variables.
    pub(crate) fn write_entry(
        mut self,
        entry: &EntryPoint,
        name: &str,
    ) -> Result<String, NativeError> {
        if entry.stage != ShaderStage::Compute {
            return Err(self.cx.refuse(self.span, &format!("the {:?} stage", entry.stage)));
        }
        let mut parameters = String::new();
        for (argument, given) in entry.function.arguments.iter().zip(&self.arguments) {
            match argument.binding {
                Some(Binding::BuiltIn(BuiltIn::GlobalInvocationId)) => {}
                Some(Binding::BuiltIn(builtin)) => {
                    let message = format!("the builtin {builtin:?} of `{given}`");
                    return Err(self.cx.refuse(self.argument_span(argument), &message));
                }
                _ => {
                    let span = self.argument_span(argument);
                    return Err(self.cx.refuse(span, "an entry point with a struct argument"));
                }
            }
            let _ = write!(parameters, ", {given}: UVec3");
        }
        self.out.open(&format!("pub fn {name}(&mut self{parameters}) {{"));
        for (handle, global) in self.cx.module.global_variables.iter() {
            if global.space == AddressSpace::Private {
                let value = self.cx.initial(handle)?;
                self.out.line(&format!("self.{} = {value};", self.cx.global_name(handle)));
            }
        }
        self.write_body()?;
        self.out.close("}");
        Ok(self.out.finish())
    }

    fn write_place(&mut self) {
        if let Some(range) = self.span.to_range()
            && self.cx.source.get(..range.start).is_some()
        {
            let line = self.span.location(self.cx.source).line_number;
            self.out.line(&format!("/// WGSL line {line}."));
        }
    }

    /// Arguments have no spans of their own; their expressions do.
    fn argument_span(&self, argument: &FunctionArgument) -> Span {
        let index = self.fun.arguments.iter().position(|a| std::ptr::eq(a, argument));
        self.fun
            .expressions
            .iter()
            .find(
                |(_, e)| matches!(e, Expression::FunctionArgument(i) if Some(*i as usize) == index),
            )
            .map_or(self.span, |(handle, _)| self.fun.expressions.get_span(handle))
    }

    fn parameter_type(&self, argument: &FunctionArgument) -> Result<String, NativeError> {
        match self.cx.module.types[argument.ty].inner {
            TypeInner::Pointer { base, space: AddressSpace::Function } => {
                Ok(format!("&mut {}", self.cx.handle_type(base).map_err(|e| self.place(e))?))
            }
            TypeInner::Pointer { space, .. } | TypeInner::ValuePointer { space, .. } => {
                let construct = format!("a parameter that points into {space:?} space");
                Err(self.cx.refuse(self.argument_span(argument), &construct))
            }
            _ => self.cx.handle_type(argument.ty).map_err(|e| self.place(e)),
        }
    }

    /// Gives an error without a location the function's.
    pub(crate) fn place(&self, error: NativeError) -> NativeError {
        error.or_at(self.span, self.cx.source)
    }

    fn write_body(&mut self) -> Result<(), NativeError> {
        self.write_aliases()?;
        for (handle, local) in self.fun.local_variables.iter() {
            let span = self.fun.local_variables.get_span(handle);
            let ty = self.cx.handle_type(local.ty).map_err(|e| e.or_at(span, self.cx.source))?;
            let value = match local.init {
                Some(init) => self.value(init)?,
                None => self.cx.handle_zero(local.ty)?,
            };
            self.out.line(&format!("let mut {}: {ty} = {value};", self.locals[handle.index()]));
        }
        let mut body = self.fun.body.clone();
        if let Some(Statement::Return { value: None }) = body.last() {
            body.cull(body.len() - 1..);
        }
        self.write_block(&body)
    }

    /// Copies the references to read-only resources, so that writes through `self` cannot be
    /// thought to change them.
    fn write_aliases(&mut self) -> Result<(), NativeError> {
        let mut used: Vec<Handle<GlobalVariable>> = self
            .fun
            .expressions
            .iter()
            .filter_map(|(_, e)| match e {
                Expression::GlobalVariable(global) => Some(*global),
                _ => None,
            })
            .collect();
        used.sort_by_key(|global| global.index());
        used.dedup();
        for global in used {
            let holding = self.cx.holding(global)?;
            if holding.is_shared() {
                let member = self.cx.global_name(global);
                let name = self.names.add(member);
                self.out.line(&format!("let {name} = self.{member};"));
                self.aliases[global.index()] = Some(name);
            }
        }
        Ok(())
    }

    /// How a global is held, and the text that reaches it.
    pub(crate) fn global(
        &self,
        global: Handle<GlobalVariable>,
    ) -> Result<(Holding, String), NativeError> {
        let holding = self.cx.holding(global)?;
        let text = match &self.aliases[global.index()] {
            Some(alias) => alias.clone(),
            None => format!("self.{}", self.cx.global_name(global)),
        };
        Ok((holding, text))
    }

    /// The type of an expression.
    pub(crate) fn ty(&self, handle: Handle<Expression>) -> &'a TypeInner {
        self.info[handle].ty.inner_with(&self.cx.module.types)
    }

    /// The Rust type of an expression.
    pub(crate) fn rust_type(&self, handle: Handle<Expression>) -> Result<String, NativeError> {
        match self.info[handle].ty.handle() {
            Some(ty) => self.cx.handle_type(ty),
            None => self.cx.rust_type(self.ty(handle), self.fun.expressions.get_span(handle)),
        }
        .map_err(|e| e.or_at(self.span_of(handle), self.cx.source))
    }

    /// The error for an expression that cannot be translated.
    pub(crate) fn refuse(&self, handle: Handle<Expression>, construct: &str) -> NativeError {
        let error = self.cx.refuse(self.fun.expressions.get_span(handle), construct);
        self.place(error)
    }
}
