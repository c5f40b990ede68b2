//! Expressions: which have names, which are spelled out where they are read, and the kinds that
//! neither compute nor convert (those are in `operators`, `conversions`, `builtins`, `places`).

use crate::NativeError;
use crate::functions::FunctionWriter;
use crate::text::{unwrap, wrap};
use crate::types::{LANES, column, vector_name};
use naga::{
    Expression, Handle, RelationalFunction, ScalarKind, Span, SwizzleComponent, Type, TypeInner,
    VectorSize,
};

/// The expressions that `expression` reads.
pub(crate) fn operands(expression: &Expression) -> Vec<Handle<Expression>> {
    match expression {
        Expression::Compose { components, .. } => components.clone(),
        Expression::Access { base, index } => vec![*base, *index],
        Expression::AccessIndex { base, .. } => vec![*base],
        Expression::Splat { value, .. } => vec![*value],
        Expression::Swizzle { vector, .. } => vec![*vector],
        Expression::Load { pointer } => vec![*pointer],
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => vec![*expr],
        Expression::Binary { left, right, .. } => vec![*left, *right],
        Expression::Select { condition, accept, reject } => vec![*condition, *accept, *reject],
        Expression::Relational { argument, .. } => vec![*argument],
        Expression::Math { arg, arg1, arg2, arg3, .. } => {
            [Some(*arg), *arg1, *arg2, *arg3].into_iter().flatten().collect()
        }
        Expression::ArrayLength(array) => vec![*array],
        _ => Vec::new(),
    }
}

impl FunctionWriter<'_> {
    /// The text of a value, to stand alone or as an argument.
    pub(crate) fn value(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        match &self.bound[handle.index()] {
            Some(name) => Ok(name.clone()),
            None => self.generate(handle).map(|text| unwrap(&text).to_owned()),
        }
    }

    /// The text of a value, to stand next to an operator or before a dot.
    pub(crate) fn operand(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        self.value(handle).map(|text| wrap(&text))
    }

    /// The text of a value that may be repeated: a name, or as cheap as one.
    pub(crate) fn atom(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        let cheap = matches!(
            self.fun.expressions[handle],
            Expression::Literal(_)
                | Expression::Constant(_)
                | Expression::Override(_)
                | Expression::ZeroValue(_)
                | Expression::FunctionArgument(_)
        );
        if cheap || self.bound[handle.index()].is_some() {
            return self.operand(handle);
        }
        if self.is_emitted(handle) {
            self.bind(handle)?;
            return self.value(handle);
        }
        // A constant without a name of its own is spelled out again wherever it is read.
        let text = self.value(handle)?;
        self.n_temporaries += 1;
        let name = self.names.add_numbered("t", self.n_temporaries);
        self.out.line(&format!("let {name} = {text};"));
        Ok(name)
    }

    /// Whether the value depends on when it is evaluated; a constant's does not.
    pub(crate) fn is_emitted(&self, handle: Handle<Expression>) -> bool {
        let expression = &self.fun.expressions[handle];
        match expression {
            Expression::Literal(_)
            | Expression::Constant(_)
            | Expression::Override(_)
            | Expression::ZeroValue(_) => false,
            Expression::FunctionArgument(_)
            | Expression::GlobalVariable(_)
            | Expression::LocalVariable(_)
            | Expression::Load { .. }
            | Expression::CallResult(_) => true,
            _ => operands(expression).into_iter().any(|operand| self.is_emitted(operand)),
        }
    }

    /// The texts of a vector's lanes; each may be repeated.
    pub(crate) fn lanes(
        &mut self,
        handle: Handle<Expression>,
        n: usize,
    ) -> Result<Vec<String>, NativeError> {
        if self.bound[handle.index()].is_none() {
            match self.fun.expressions[handle].clone() {
                Expression::Splat { value, .. } => return Ok(vec![self.atom(value)?; n]),
                Expression::Swizzle { vector, pattern, .. } => {
                    let from = self.vector_size(vector) as usize;
                    let lanes = self.lanes(vector, from)?;
                    return Ok(pattern[..n].iter().map(|c| lanes[*c as usize].clone()).collect());
                }
                Expression::Compose { components, .. } if components.len() == n => {
                    return components.into_iter().map(|c| self.atom(c)).collect();
                }
                _ => {}
            }
        }
        let name = self.atom(handle)?;
        Ok(LANES[..n].iter().map(|lane| format!("{name}.{lane}")).collect())
    }

    /// The size of a vector-valued expression; 4 for anything else, which is never asked.
    pub(crate) fn vector_size(&self, handle: Handle<Expression>) -> VectorSize {
        match *self.ty(handle) {
            TypeInner::Vector { size, .. } => size,
            _ => VectorSize::Quad,
        }
    }

    /// Evaluates an expression here, under a name.
    pub(crate) fn bind(&mut self, handle: Handle<Expression>) -> Result<(), NativeError> {
        if self.bound[handle.index()].is_none() {
            let text = self.generate(handle)?;
            self.bind_as(handle, unwrap(&text));
        }
        Ok(())
    }

    /// Gives `text` the name of an expression.
    pub(crate) fn bind_as(&mut self, handle: Handle<Expression>, text: &str) {
        let name = if let Some(name) = self.hoisted[handle.index()].clone() {
            self.out.line(&format!("{name} = {text};"));
            name
        } else {
            let name = self.new_name(handle);
            self.out.line(&format!("let {name} = {text};"));
            name
        };
        self.bound[handle.index()] = Some(name);
    }

    /// A free name: the one that WGSL gave it with `let`, or a number.
    pub(crate) fn new_name(&mut self, handle: Handle<Expression>) -> String {
        match self.fun.named_expressions.get(&handle) {
            Some(name) => self.names.add(name),
            None => self.names.add_numbered("e", handle.index()),
        }
    }

    /// Whether an expression is a pointer, which is a place and never a value here.
    pub(crate) fn is_pointer(&self, handle: Handle<Expression>) -> bool {
        matches!(self.ty(handle), TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. })
    }

    /// The zero value of an expression's type.
    pub(crate) fn zero_of(&self, handle: Handle<Expression>) -> Result<String, NativeError> {
        match self.info[handle].ty.handle() {
            Some(ty) => self.cx.handle_zero(ty),
            None => self.cx.zero(self.ty(handle), self.span_of(handle)),
        }
    }

    /// Where an expression stands in the WGSL text.
    pub(crate) fn span_of(&self, handle: Handle<Expression>) -> Span {
        self.fun.expressions.get_span(handle)
    }

    /// Refuses, at its place, what `generate` would refuse once somebody reads it.
    pub(crate) fn check_supported(&self, handle: Handle<Expression>) -> Result<(), NativeError> {
        match &self.fun.expressions[handle] {
            Expression::ImageSample { .. }
            | Expression::ImageLoad { .. }
            | Expression::ImageQuery { .. } => Err(self.refuse(handle, "a texture")),
            Expression::Derivative { .. } => Err(self.refuse(handle, "a derivative")),
            Expression::AtomicResult { .. } => Err(self.refuse(handle, "an atomic operation")),
            _ if self.is_pointer(handle) => Ok(()),
            _ => self.rust_type(handle).map(drop),
        }
    }

    /// The text that computes an expression from its operands.
    fn generate(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        let span = self.span_of(handle);
        match self.fun.expressions[handle].clone() {
            Expression::Literal(literal) => self.cx.literal(literal, span),
            Expression::Constant(constant) => match self.cx.constant_name(constant) {
                Some(name) => Ok(name.to_owned()),
                None => self.cx.global_expression(self.cx.module.constants[constant].init),
            },
            Expression::Override(constant) => Ok(self.cx.override_name(constant).to_owned()),
            Expression::ZeroValue(ty) => self.cx.handle_zero(ty),
            Expression::Compose { ty, components } => self.compose(handle, ty, &components),
            Expression::Access { base, index } => self.access(handle, base, index),
            Expression::AccessIndex { base, index } => self.access_index(handle, base, index),
            Expression::Splat { size, value } => {
                let kind = self.scalar_kind(value);
                match kind {
                    Some(kind) => {
                        Ok(format!("{}::splat({})", vector_name(size, kind), self.value(value)?))
                    }
                    None => Err(self.refuse(handle, "this splat")),
                }
            }
            Expression::Swizzle { size, vector, pattern } => self.swizzle(size, vector, pattern),
            Expression::FunctionArgument(index) => Ok(self.arguments[index as usize].clone()),
            Expression::Load { pointer } => self.load(pointer),
            Expression::Unary { op, expr } => self.unary(handle, op, expr),
            Expression::Binary { op, left, right } => self.binary(handle, op, left, right),
            Expression::Select { condition, accept, reject } => {
                self.select(handle, condition, accept, reject)
            }
            Expression::Relational { fun, argument } => self.relational(handle, fun, argument),
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let arguments: Vec<_> =
                    [Some(arg), arg1, arg2, arg3].into_iter().flatten().collect();
                self.math(handle, fun, &arguments)
            }
            Expression::As { expr, kind, convert } => self.convert(handle, expr, kind, convert),
            Expression::ArrayLength(array) => self.array_length(array),
            Expression::GlobalVariable(_) | Expression::LocalVariable(_) => {
                Err(self.refuse(handle, "a pointer as a value"))
            }
            Expression::CallResult(_) => Err(self.refuse(handle, "the result of this call here")),
            _ => Err(self.refuse(handle, "this expression")),
        }
    }

    /// The kind of a scalar's, vector's or matrix's numbers.
    pub(crate) fn scalar_kind(&self, handle: Handle<Expression>) -> Option<ScalarKind> {
        self.ty(handle).scalar_kind()
    }

    fn compose(
        &mut self,
        handle: Handle<Expression>,
        ty: Handle<Type>,
        components: &[Handle<Expression>],
    ) -> Result<String, NativeError> {
        let vector = matches!(self.cx.module.types[ty].inner, TypeInner::Vector { .. });
        let mut parts = Vec::new();
        for &component in components {
            match *self.ty(component) {
                TypeInner::Vector { size, .. } if vector => {
                    parts.extend(self.lanes(component, size as usize)?);
                }
                _ => parts.push(self.value(component)?),
            }
        }
        self.cx.compose(ty, &parts, self.span_of(handle)).map_err(|e| self.place(e))
    }

    fn swizzle(
        &mut self,
        size: VectorSize,
        vector: Handle<Expression>,
        pattern: [SwizzleComponent; 4],
    ) -> Result<String, NativeError> {
        let kind = self.scalar_kind(vector).unwrap_or(ScalarKind::Float);
        let from = self.vector_size(vector) as usize;
        let lanes = self.lanes(vector, from)?;
        let picked: Vec<String> =
            pattern[..size as usize].iter().map(|c| lanes[*c as usize].clone()).collect();
        Ok(crate::text::call(&format!("{}::new", vector_name(size, kind)), &picked))
    }

    /// A part of a value under an index known now.
    fn access_index(
        &mut self,
        handle: Handle<Expression>,
        base: Handle<Expression>,
        index: u32,
    ) -> Result<String, NativeError> {
        let i = index as usize;
        match *self.ty(base) {
            TypeInner::Vector { size, .. } => {
                Ok(self.lanes_or_operand(base, size as usize)?.swap_remove(i))
            }
            TypeInner::Matrix { columns, rows, .. } => {
                Ok(column(&self.operand(base)?, i, columns == rows))
            }
            TypeInner::Array { .. } => Ok(format!("{}[{i}]", self.operand(base)?)),
            TypeInner::Struct { .. } => {
                let Some(ty) = self.info[base].ty.handle() else {
                    return Err(self.refuse(handle, "this struct"));
                };
                let field = self.cx.field_names(ty)[i].clone();
                Ok(format!("{}.{field}", self.operand(base)?))
            }
            _ => Err(self.refuse(handle, "this access")),
        }
    }

    /// As `lanes`, for a reader of one lane: the vector needs no name.
    fn lanes_or_operand(
        &mut self,
        vector: Handle<Expression>,
        n: usize,
    ) -> Result<Vec<String>, NativeError> {
        match self.fun.expressions[vector] {
            Expression::Load { .. } if self.bound[vector.index()].is_none() => {
                let text = self.operand(vector)?;
                Ok(LANES[..n].iter().map(|lane| format!("{text}.{lane}")).collect())
            }
            _ => self.lanes(vector, n),
        }
    }

    /// A part of a value under an index known when it runs; outside, the last part.
    fn access(
        &mut self,
        handle: Handle<Expression>,
        base: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Result<String, NativeError> {
        if self.is_pointer(handle) {
            return Err(self.refuse(handle, "a pointer as a value"));
        }
        let index = self.operand(index)?;
        let within = |n: u32| format!("({index} as usize).min({})", n - 1);
        match *self.ty(base) {
            TypeInner::Vector { size, scalar } => {
                let base = self.operand(base)?;
                let at = within(size as u32);
                Ok(match scalar.kind {
                    ScalarKind::Bool => format!("{base}.test({at})"),
                    _ => format!("{base}[{at}]"),
                })
            }
            TypeInner::Matrix { columns, rows, .. } => {
                let base = self.operand(base)?;
                let at = within(columns as u32);
                Ok(if columns == rows {
                    format!("{base}.col({at})")
                } else {
                    format!("{base}[{at}]")
                })
            }
            TypeInner::Array { size, .. } => {
                let n = self.cx.array_length(size, self.span_of(base))?;
                // A reference to a constant is one static; the constant itself would be copied.
                let constant = !self.is_emitted(base);
                let base = self.operand(base)?;
                let base = if constant { format!("(&{base})") } else { base };
                Ok(format!("{base}[{}]", within(n)))
            }
            _ => Err(self.refuse(handle, "this access")),
        }
    }

    fn select(
        &mut self,
        handle: Handle<Expression>,
        condition: Handle<Expression>,
        accept: Handle<Expression>,
        reject: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let TypeInner::Vector { size, .. } = *self.ty(condition) else {
            let condition = self.value(condition)?;
            let (accept, reject) = (self.value(accept)?, self.value(reject)?);
            return Ok(format!("if {} {{ {accept} }} else {{ {reject} }}", head(&condition)));
        };
        let n = size as usize;
        let Some(kind) = self.scalar_kind(handle) else {
            return Err(self.refuse(handle, "this select"));
        };
        let (c, a, r) = (self.lanes(condition, n)?, self.lanes(accept, n)?, self.lanes(reject, n)?);
        let lanes: Vec<String> = (0..n)
            .map(|i| format!("if {} {{ {} }} else {{ {} }}", c[i], unwrap(&a[i]), unwrap(&r[i])))
            .collect();
        Ok(crate::text::call(&format!("{}::new", vector_name(size, kind)), &lanes))
    }

    fn relational(
        &mut self,
        handle: Handle<Expression>,
        fun: RelationalFunction,
        argument: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let vector = matches!(self.ty(argument), TypeInner::Vector { .. });
        match fun {
            RelationalFunction::All | RelationalFunction::Any if !vector => self.value(argument),
            RelationalFunction::All => Ok(format!("{}.all()", self.operand(argument)?)),
            RelationalFunction::Any => Ok(format!("{}.any()", self.operand(argument)?)),
            RelationalFunction::IsNan | RelationalFunction::IsInf => {
                Err(self.refuse(handle, &format!("{fun:?}")))
            }
        }
    }
}

/// A condition after `if`: Rust takes no bare struct literal there.
pub(crate) fn head(condition: &str) -> String {
    if condition.contains('{') { format!("({condition})") } else { condition.to_owned() }
}
