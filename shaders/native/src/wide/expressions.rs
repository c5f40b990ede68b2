//! Expressions over lanes. Each gets a name where naga says that it is evaluated.

use super::functions::WideWriter;
use super::operators::call;
use super::types::{letter, vector};
use crate::error::NativeError;
use crate::types::LANES;
use naga::{Expression, Handle, Literal, Scalar, ScalarKind, TypeInner, UnaryOperator};

impl WideWriter<'_> {
    /// The text of a value.
    pub(crate) fn value(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        match &self.bound[handle.index()] {
            Some(name) => Ok(name.clone()),
            None => self.generate_here(handle),
        }
    }

    /// The name of a value, or a text that costs nothing to repeat.
    pub(crate) fn atom(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        let text = self.value(handle)?;
        Ok(self.named(&text))
    }

    /// A name for a text, unless it is one.
    pub(crate) fn named(&mut self, text: &str) -> String {
        let is_name = |text: &str| text.chars().all(|c| c.is_alphanumeric() || c == '_');
        let given = text.strip_prefix("(*").and_then(|text| text.strip_suffix(')'));
        if is_name(given.unwrap_or(text)) {
            return text.to_owned();
        }
        let name = self.names.add("t");
        self.out.line(&format!("let {name} = {text};"));
        name
    }

    /// Evaluates an expression here, under a name.
    pub(crate) fn bind(&mut self, handle: Handle<Expression>) -> Result<(), NativeError> {
        if self.bound[handle.index()].is_none() && self.info[handle].ref_count > 0 {
            let text = self.generate_here(handle)?;
            if self.is_struct_in_value(handle) {
                self.bound[handle.index()] = Some(text);
            } else {
                self.bind_as(handle, &text);
            }
        }
        Ok(())
    }

    /// Whether an expression is a struct within a struct that is a value: it never changes, so it is read where it is,
    /// and not copied.
    fn is_struct_in_value(&self, handle: Handle<Expression>) -> bool {
        let is_struct = |handle| matches!(self.ty(handle), TypeInner::Struct { .. });
        let Expression::AccessIndex { base, .. } = self.fun.expressions[handle] else {
            return false;
        };
        is_struct(handle) && is_struct(base)
    }

    /// Gives `text` the name of an expression.
    pub(crate) fn bind_as(&mut self, handle: Handle<Expression>, text: &str) {
        let name = match self.fun.named_expressions.get(&handle) {
            Some(name) => self.names.add(name),
            None => self.names.add_numbered("e", handle.index()),
        };
        self.out.line(&format!("let {name} = {text};"));
        self.bound[handle.index()] = Some(name);
    }

    /// Whether an expression is a pointer, which is a place and never a value here.
    pub(crate) fn is_pointer(&self, handle: Handle<Expression>) -> bool {
        matches!(self.ty(handle), TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. })
    }

    /// The scalar of a scalar's or vector's lanes, and how many there are.
    pub(crate) fn shape(&self, handle: Handle<Expression>) -> Result<(Scalar, usize), NativeError> {
        match *self.ty(handle) {
            TypeInner::Scalar(scalar) => Ok((scalar, 1)),
            TypeInner::Vector { size, scalar } => Ok((scalar, size as usize)),
            _ => Err(self.refuse(handle, "such a value, in lanes,")),
        }
    }

    /// The texts of the axes of a vector; a scalar is the same along all `n`.
    pub(crate) fn axes(
        &mut self,
        handle: Handle<Expression>,
        n: usize,
    ) -> Result<Vec<String>, NativeError> {
        let name = self.atom(handle)?;
        Ok(match self.ty(handle) {
            TypeInner::Vector { .. } => {
                LANES[..n].iter().map(|axis| format!("{name}.{axis}")).collect()
            }
            _ => vec![name; n],
        })
    }

    /// A value made axis by axis.
    pub(crate) fn each_axis(
        &mut self,
        handle: Handle<Expression>,
        arguments: &[Handle<Expression>],
        f: impl Fn(&[String]) -> String,
    ) -> Result<String, NativeError> {
        let (_, n) = self.shape(handle)?;
        let mut columns = Vec::new();
        for &argument in arguments {
            columns.push(self.axes(argument, n)?);
        }
        let part =
            |axis: usize| f(&columns.iter().map(|column| column[axis].clone()).collect::<Vec<_>>());
        let parts: Vec<String> = (0..n).map(part).collect();
        Ok(if n == 1 { parts.concat() } else { vector(&parts) })
    }

    /// As `generate`; an error without a location gets the expression's.
    fn generate_here(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        let span = self.fun.expressions.get_span(handle);
        self.generate(handle).map_err(|error| error.or_at(span, self.cx.source))
    }

    fn generate(&mut self, handle: Handle<Expression>) -> Result<String, NativeError> {
        match self.fun.expressions[handle].clone() {
            Expression::Literal(literal) => self.literal(handle, literal),
            Expression::Constant(constant) => self.constant(handle, constant),
            Expression::ZeroValue(ty) => self.cx.wide_zero(ty),
            Expression::Compose { ty, components } => self.compose(ty, &components),
            Expression::Access { base, index } => self.access(handle, base, index),
            Expression::AccessIndex { base, index } => self.access_index(base, index),
            Expression::Splat { size, value } => {
                let value = self.atom(value)?;
                Ok(vector(&vec![value; size as usize]))
            }
            Expression::Swizzle { size, vector: from, pattern } => {
                let axes = self.axes(from, 4)?;
                let picked: Vec<String> =
                    pattern[..size as usize].iter().map(|c| axes[*c as usize].clone()).collect();
                Ok(vector(&picked))
            }
            Expression::FunctionArgument(index) => {
                let name = self.arguments[index as usize].clone();
                let is_struct = matches!(self.ty(handle), TypeInner::Struct { .. });
                Ok(if is_struct { format!("(*{name})") } else { name })
            }
            Expression::Load { pointer } => self.load(pointer),
            Expression::Unary { op, expr } => {
                let (scalar, _) = self.shape(expr)?;
                let name = match op {
                    UnaryOperator::Negate => "neg",
                    UnaryOperator::LogicalNot | UnaryOperator::BitwiseNot => "not",
                };
                self.each_axis(handle, &[expr], |x| call(name, scalar.kind, x))
            }
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
            _ => Err(self.refuse(handle, "this expression, in lanes,")),
        }
    }

    fn literal(
        &mut self,
        handle: Handle<Expression>,
        literal: Literal,
    ) -> Result<String, NativeError> {
        let span = self.fun.expressions.get_span(handle);
        let text = self.cx.literal(literal, span)?.replace("Real::", "f32::");
        Ok(format!("v::{}({text})", letter(literal.scalar().kind)))
    }

    /// A constant of the scalar module.
    fn constant(
        &mut self,
        handle: Handle<Expression>,
        constant: Handle<naga::Constant>,
    ) -> Result<String, NativeError> {
        let text = match self.cx.constant_name(constant) {
            Some(name) => format!("scalar::{name}"),
            None => self.cx.global_expression(self.cx.module.constants[constant].init)?,
        };
        let (scalar, n) = self.shape(handle)?;
        let letter = letter(scalar.kind);
        if n == 1 {
            return Ok(format!("v::{letter}({text})"));
        }
        let part = |axis: &&str| format!("v::{letter}({text}.{axis})");
        Ok(vector(&LANES[..n].iter().map(part).collect::<Vec<_>>()))
    }

    fn compose(
        &mut self,
        ty: Handle<naga::Type>,
        components: &[Handle<Expression>],
    ) -> Result<String, NativeError> {
        match self.cx.module.types[ty].inner {
            TypeInner::Vector { .. } => {
                let mut parts = Vec::new();
                for &component in components {
                    let (_, n) = self.shape(component)?;
                    parts.extend(self.axes(component, n)?);
                }
                Ok(vector(&parts))
            }
            TypeInner::Struct { .. } => {
                let mut members = Vec::new();
                for (field, &component) in self.cx.field_names(ty).iter().zip(components) {
                    members.push(format!("{field}: {}", self.value(component)?));
                }
                Ok(format!("{} {{ {} }}", self.cx.struct_name(ty), members.join(", ")))
            }
            TypeInner::Array { .. } => {
                let mut parts = Vec::new();
                for &component in components {
                    parts.push(self.value(component)?);
                }
                Ok(format!("[{}]", parts.join(", ")))
            }
            ref inner => {
                let span = self.cx.module.types.get_span(ty);
                Err(self.place(self.cx.refuse(span, crate::types::type_word(inner))))
            }
        }
    }

    /// A part of a value under an index known now.
    fn access_index(
        &mut self,
        base: Handle<Expression>,
        index: u32,
    ) -> Result<String, NativeError> {
        // What has been bound may be a path of fields, which needs no name.
        let name = match &self.bound[base.index()] {
            Some(path) => path.clone(),
            None => self.atom(base)?,
        };
        match *self.ty(base) {
            TypeInner::Vector { .. } => Ok(format!("{name}.{}", LANES[index as usize])),
            TypeInner::Array { .. } => Ok(format!("{name}[{index}]")),
            TypeInner::Struct { .. } => match self.info[base].ty.handle() {
                Some(ty) => Ok(format!("{name}.{}", self.cx.field_names(ty)[index as usize])),
                None => Err(self.refuse(base, "this struct")),
            },
            _ => Err(self.refuse(base, "this access")),
        }
    }

    /// A part of a value under an index known when it runs; outside, the last part.
    fn access(
        &mut self,
        handle: Handle<Expression>,
        base: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let name = self.atom(base)?;
        let parts = match *self.ty(base) {
            TypeInner::Vector { size, .. } => {
                let axes = LANES[..size as usize].iter().map(|axis| format!("{name}.{axis}"));
                format!("&[{}]", axes.collect::<Vec<_>>().join(", "))
            }
            TypeInner::Array { .. } => format!("&{name}"),
            _ => return Err(self.refuse(base, "this access")),
        };
        let index = self.index(index)?;
        let (scalar, n) = self.shape(handle)?;
        if n != 1 {
            return Err(self.refuse(handle, "a vector under an index that is not known"));
        }
        Ok(format!("v::pick_{}({parts}, {index})", letter(scalar.kind)))
    }

    /// An index without a sign: a negative one is far outside.
    pub(crate) fn index(&mut self, index: Handle<Expression>) -> Result<String, NativeError> {
        let text = self.atom(index)?;
        Ok(match self.shape(index)?.0.kind {
            ScalarKind::Sint | ScalarKind::AbstractInt => format!("v::u_bits_i({text})"),
            _ => text,
        })
    }
}
