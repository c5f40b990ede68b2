//! Operators, choices and conversions over lanes: each has a function for each kind of numbers.

use super::functions::WideWriter;
use super::types::letter;
use crate::error::NativeError;
use naga::{BinaryOperator, Bytes, Expression, Handle, RelationalFunction, ScalarKind, TypeInner};

impl WideWriter<'_> {
    /// An operator between two values.
    pub(crate) fn binary(
        &mut self,
        handle: Handle<Expression>,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<String, NativeError> {
        use BinaryOperator as Op;
        let kind = self.shape(left)?.0.kind;
        let name = match op {
            Op::Add => "add",
            Op::Subtract => "sub",
            Op::Multiply => "mul",
            Op::Divide => "div",
            Op::Modulo => "rem",
            Op::Equal => "eq",
            Op::NotEqual => "ne",
            Op::Less => "lt",
            Op::LessEqual => "le",
            Op::Greater => "gt",
            Op::GreaterEqual => "ge",
            Op::And | Op::LogicalAnd => "and",
            Op::ExclusiveOr => "xor",
            Op::InclusiveOr | Op::LogicalOr => "or",
            Op::ShiftLeft => "shl",
            Op::ShiftRight => "shr",
        };
        self.each_axis(handle, &[left, right], |x| call(name, kind, x))
    }

    /// One of two values.
    pub(crate) fn select(
        &mut self,
        handle: Handle<Expression>,
        condition: Handle<Expression>,
        accept: Handle<Expression>,
        reject: Handle<Expression>,
    ) -> Result<String, NativeError> {
        if let TypeInner::Struct { .. } | TypeInner::Array { .. } = self.ty(handle) {
            let (mask, yes, no) = (self.atom(condition)?, self.atom(accept)?, self.atom(reject)?);
            let Some(ty) = self.info[handle].ty.handle() else {
                return Err(self.refuse(handle, "this choice"));
            };
            return self.cx.wide_select(ty, [&mask, &yes, &no]);
        }
        let kind = self.shape(handle)?.0.kind;
        self.each_axis(handle, &[condition, accept, reject], |x| call("select", kind, x))
    }

    /// `all` or `any`.
    pub(crate) fn relational(
        &mut self,
        handle: Handle<Expression>,
        fun: RelationalFunction,
        argument: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let join = match fun {
            RelationalFunction::All => "and_b",
            RelationalFunction::Any => "or_b",
            _ => return Err(self.refuse(handle, "this question, in lanes,")),
        };
        let (_, n) = self.shape(argument)?;
        let axes = self.axes(argument, n)?;
        let all = |all: String, axis: &String| format!("v::{join}({all}, {axis})");
        Ok(axes[1..].iter().fold(axes[0].clone(), all))
    }

    /// `T(x)` where `width` is given, else `bitcast<T>(x)`.
    pub(crate) fn convert(
        &mut self,
        handle: Handle<Expression>,
        operand: Handle<Expression>,
        to: ScalarKind,
        width: Option<Bytes>,
    ) -> Result<String, NativeError> {
        let from = self.shape(operand)?.0.kind;
        if from == to {
            return self.value(operand);
        }
        let how = if width.is_some() { "from" } else { "bits" };
        let name = format!("v::{}_{how}_{}", letter(to), letter(from));
        self.each_axis(handle, &[operand], |x| format!("{name}({})", x[0]))
    }
}

/// A call of the function `name` of a kind.
pub(crate) fn call(name: &str, kind: ScalarKind, arguments: &[String]) -> String {
    format!("v::{name}_{}({})", letter(kind), arguments.join(", "))
}
