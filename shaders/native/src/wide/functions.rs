//! One WGSL function → one method over lanes. Its first parameter is the mask of lanes that call it.

use super::exits::returns_in;
use crate::context::Context;
use crate::error::NativeError;
use crate::names::{Names, PATTERNS};
use crate::options::Lanes;
use crate::text::Text;
use naga::valid::FunctionInfo;
use naga::{
    AddressSpace, Block, Expression, Function, Handle, LocalVariable, Span, Statement, Type,
    TypeInner,
};
use std::fmt::Write as _;

/// Where the lanes go that `break` and `continue` take out of a mask.
pub(crate) enum Scope {
    /// A loop: the masks of those that have left it, and of those that wait for its end.
    Loop { broken: String, waiting: String },
    /// A switch.
    Switch { broken: String },
}

/// The state of the walk through one function.
pub(crate) struct WideWriter<'a> {
    pub(crate) cx: &'a Context<'a>,
    lanes: Lanes,
    pub(crate) fun: &'a Function,
    pub(crate) info: &'a FunctionInfo,
    pub(crate) span: Span,
    pub(crate) out: Text,
    pub(crate) names: Names,
    pub(crate) arguments: Vec<String>,
    pub(crate) locals: Vec<String>,
    /// The name of each expression that has been evaluated.
    pub(crate) bound: Vec<Option<String>>,
    pub(crate) scopes: Vec<Scope>,
    /// The mask of the block that is being written.
    pub(crate) mask: String,
    /// The mask is that of the function's caller: what its own variables hold in other lanes is of no interest.
    pub(crate) whole: bool,
    /// The block that is being written, and the home of each variable.
    pub(crate) block: *const Block,
    pub(crate) homes: Vec<Option<*const Block>>,
    /// The statement of the function's own block before which each variable is declared that is not at the top.
    first_uses: Vec<Option<usize>>,
    /// The result of the lanes that have returned, if some can return before the others.
    pub(crate) result: Option<String>,
}

impl<'a> WideWriter<'a> {
    /// Prepares the walk. `span` is where the function stands, if naga knows.
    pub(crate) fn new(
        cx: &'a Context<'a>,
        lanes: Lanes,
        (fun, info, span): (&'a Function, &'a FunctionInfo, Span),
    ) -> Self {
        let mut names = Names::with(cx.value_names().chain(PATTERNS.iter().copied()));
        for taken in ["v", "scalar"] {
            names.add(taken);
        }
        let mask = names.add("mask");
        let name_of =
            |name: &Option<String>, other: &str| name.as_deref().unwrap_or(other).to_owned();
        let arguments =
            fun.arguments.iter().map(|a| names.add(&name_of(&a.name, "argument"))).collect();
        let locals = fun
            .local_variables
            .iter()
            .map(|(_, local)| names.add(&name_of(&local.name, "local")))
            .collect();
        Self {
            cx,
            lanes,
            fun,
            info,
            span,
            out: Text::at_depth(1),
            names,
            arguments,
            locals,
            bound: vec![None; fun.expressions.len()],
            scopes: Vec::new(),
            mask,
            whole: true,
            block: std::ptr::null(),
            homes: super::homes::homes(fun),
            first_uses: super::homes::first_uses(fun),
            result: None,
        }
    }

    /// The method for an ordinary function.
    pub(crate) fn write_function(mut self, name: &str) -> Result<String, NativeError> {
        self.open(name)?;
        self.write_body()?;
        self.out.close("}");
        Ok(self.out.finish())
    }

    /// The method that leaves the work to the Rust function at `path`.
    pub(crate) fn write_seam(mut self, name: &str, path: &str) -> Result<String, NativeError> {
        self.open(name)?;
        let mut given = vec!["self".to_owned(), self.mask.clone()];
        given.extend(self.arguments.iter().cloned());
        self.out.line(&crate::text::call(path, &given));
        self.out.close("}");
        Ok(self.out.finish())
    }

    /// The method for an entry point.
    pub(crate) fn write_entry(mut self, name: &str) -> Result<String, NativeError> {
        self.open(name)?;
        self.write_body()?;
        self.out.close("}");
        Ok(self.out.finish())
    }

    fn open(&mut self, name: &str) -> Result<(), NativeError> {
        let mut parameters = format!(", mut {}: v::B", self.mask);
        for (argument, given) in self.fun.arguments.iter().zip(&self.arguments) {
            let ty = match self.cx.module.types[argument.ty].inner {
                TypeInner::Pointer { base, space: AddressSpace::Function } => {
                    format!("&mut {}", self.wide(base)?)
                }
                // Hundreds of bytes.
                TypeInner::Struct { .. } => format!("&{}", self.wide(argument.ty)?),
                _ => self.wide(argument.ty)?,
            };
            let _ = write!(parameters, ", {given}: {ty}");
        }
        let result = match &self.fun.result {
            Some(result) => format!(" -> {}", self.wide(result.ty)?),
            None => String::new(),
        };
        self.out.line("#[inline]");
        self.out.line(self.lanes.attribute());
        self.out.open(&format!("pub fn {name}(&mut self{parameters}){result} {{"));
        Ok(())
    }

    fn wide(&self, ty: Handle<Type>) -> Result<String, NativeError> {
        self.cx.wide_type(ty).map_err(|error| self.place(error))
    }

    fn write_body(&mut self) -> Result<(), NativeError> {
        let body = &self.fun.body;
        let last = match body.last() {
            Some(Statement::Return { value }) => Some(*value),
            _ => None,
        };
        let n = body.len() - usize::from(last.is_some());
        for (handle, local) in self.fun.local_variables.iter() {
            let is_struct =
                matches!(self.cx.module.types[local.ty].inner, TypeInner::Struct { .. });
            let late = is_struct && local.init.is_none();
            let first = &mut self.first_uses[handle.index()];
            *first = first.filter(|first| late && *first < n);
            if first.is_none() {
                self.declare(handle)?;
            }
        }
        if let Some(result) = &self.fun.result
            && (returns_in(body.iter().take(n)) || last.is_none())
        {
            let name = self.names.add("result");
            let (ty, zero) = (self.wide(result.ty)?, self.cx.wide_zero(result.ty)?);
            self.out.line(&format!("let mut {name}: {ty} = {zero};"));
            self.result = Some(name);
        }
        let nested = self.write_statements(body, n)?;
        match (last.flatten(), self.result.clone()) {
            (Some(value), Some(_)) => self.write_result(value)?,
            (Some(value), None) => {
                let value = self.value(value)?;
                self.out.line(&format!("return {value};"));
            }
            (None, _) => {}
        }
        for _ in 0..nested {
            self.out.close("}");
        }
        if let Some(result) = self.result.clone() {
            self.out.line(&result);
        }
        Ok(())
    }

    /// Declares the variables that statement `k` of the function's own block is the first to use. A struct is hundreds of
    /// bytes, which are not cleared for lanes that have left before.
    pub(crate) fn declare_before(&mut self, k: usize) -> Result<(), NativeError> {
        for (handle, _) in self.fun.local_variables.iter() {
            if self.first_uses[handle.index()] == Some(k) {
                self.declare(handle)?;
            }
        }
        Ok(())
    }

    fn declare(&mut self, handle: Handle<LocalVariable>) -> Result<(), NativeError> {
        let local = &self.fun.local_variables[handle];
        let ty = self.wide(local.ty)?;
        let name = self.locals[handle.index()].clone();
        let value = match local.init {
            Some(init) => self.value(init)?,
            // It is stored before anything else.
            None if self.homes[handle.index()].is_some() => {
                self.out.line(&format!("let mut {name}: {ty};"));
                return Ok(());
            }
            None => self.cx.wide_zero(local.ty)?,
        };
        self.out.line(&format!("let mut {name}: {ty} = {value};"));
        Ok(())
    }

    /// Gives an error without a location the function's.
    pub(crate) fn place(&self, error: NativeError) -> NativeError {
        error.or_at(self.span, self.cx.source)
    }

    /// The type of an expression.
    pub(crate) fn ty(&self, handle: Handle<Expression>) -> &'a TypeInner {
        self.info[handle].ty.inner_with(&self.cx.module.types)
    }

    /// The error for an expression that cannot be translated.
    pub(crate) fn refuse(&self, handle: Handle<Expression>, construct: &str) -> NativeError {
        let error = self.cx.refuse(self.fun.expressions.get_span(handle), construct);
        self.place(error)
    }
}
