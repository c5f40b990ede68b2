//! Unary and binary operators. Integers wrap; quotients, remainders and shift counts follow WGSL;
//! floats are plain IEEE operations in the order written.

use crate::NativeError;
use crate::functions::FunctionWriter;
use crate::text::{call, wrap};
use crate::types::vector_name;
use naga::{BinaryOperator, Expression, Handle, ScalarKind, TypeInner, UnaryOperator};

impl FunctionWriter<'_> {
    /// A unary operator.
    pub(crate) fn unary(
        &mut self,
        handle: Handle<Expression>,
        op: UnaryOperator,
        operand: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let kind = self.scalar_kind(handle);
        match (op, kind) {
            (UnaryOperator::Negate, Some(ScalarKind::Float)) => {
                if let TypeInner::Matrix { .. } = self.ty(operand) {
                    return self.columnwise(operand, |column| format!("-{column}"));
                }
                Ok(format!("-{}", self.operand(operand)?))
            }
            (UnaryOperator::Negate, Some(ScalarKind::Sint)) => {
                self.lanewise(handle, &[operand], |x| format!("{}.wrapping_neg()", x[0]))
            }
            (UnaryOperator::LogicalNot | UnaryOperator::BitwiseNot, Some(_)) => {
                Ok(format!("!{}", self.operand(operand)?))
            }
            _ => Err(self.refuse(handle, "this unary operator")),
        }
    }

    /// A binary operator.
    pub(crate) fn binary(
        &mut self,
        handle: Handle<Expression>,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let matrix = |ty: &TypeInner| matches!(ty, TypeInner::Matrix { .. });
        if matrix(self.ty(left)) || matrix(self.ty(right)) {
            return self.matrix_binary(handle, op, left, right);
        }
        let Some(kind) = self.scalar_kind(left) else {
            return Err(self.refuse(handle, "this binary operator"));
        };
        let Some(form) = form(op, kind) else {
            return Err(self.refuse(handle, &format!("{op:?} of {kind:?}")));
        };
        let vector = matches!(self.ty(handle), TypeInner::Vector { .. });
        match form {
            Form::Infix(op) => Ok(format!("{} {op} {}", self.operand(left)?, self.operand(right)?)),
            Form::Method(name) if vector => {
                let (left, right) = (self.whole(handle, left)?, self.whole(handle, right)?);
                Ok(call(&format!("{}.{name}", wrap(&left)), &[right]))
            }
            Form::Method(name) => {
                let left = self.operand(left)?;
                Ok(call(&format!("{left}.{name}"), &[self.value(right)?]))
            }
            Form::Compare(op) => {
                self.lanewise(handle, &[left, right], |x| format!("{} {op} {}", x[0], x[1]))
            }
            Form::Call(name) => self.lanewise(handle, &[left, right], |x| call(name, x)),
            Form::Shift(name) => self
                .lanewise(handle, &[left, right], |x| call(&format!("{}.{name}", x[0]), &x[1..])),
        }
    }

    /// An operand as a vector of the result's size.
    fn whole(
        &mut self,
        result: Handle<Expression>,
        operand: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let text = self.value(operand)?;
        match (self.ty(operand), self.scalar_kind(operand)) {
            (TypeInner::Scalar(_), Some(kind)) => {
                Ok(format!("{}::splat({text})", vector_name(self.vector_size(result), kind)))
            }
            _ => Ok(text),
        }
    }

    /// `f` of each lane of the arguments, of which scalars count for every lane; of scalars alone
    /// just `f`.
    pub(crate) fn lanewise(
        &mut self,
        result: Handle<Expression>,
        arguments: &[Handle<Expression>],
        f: impl Fn(&[String]) -> String,
    ) -> Result<String, NativeError> {
        let TypeInner::Vector { size, scalar } = *self.ty(result) else {
            let mut texts = Vec::new();
            for &argument in arguments {
                texts.push(self.operand(argument)?);
            }
            return Ok(f(&texts));
        };
        let n = size as usize;
        let mut columns = Vec::new();
        for &argument in arguments {
            columns.push(match self.ty(argument) {
                TypeInner::Vector { .. } => self.lanes(argument, n)?,
                _ => vec![self.atom(argument)?; n],
            });
        }
        let lanes: Vec<String> = (0..n)
            .map(|lane| f(&columns.iter().map(|c| c[lane].clone()).collect::<Vec<_>>()))
            .collect();
        Ok(call(&format!("{}::new", vector_name(size, scalar.kind)), &lanes))
    }
}

/// How Rust writes an operator.
enum Form {
    /// `a + b`, of scalars and of whole vectors.
    Infix(&'static str),
    /// `a.wrapping_add(b)`, of scalars and of whole vectors.
    Method(&'static str),
    /// `a < b`, lane by lane.
    Compare(&'static str),
    /// `f(a, b)`, lane by lane.
    Call(&'static str),
    /// `a.wrapping_shl(b)`, lane by lane.
    Shift(&'static str),
}

fn form(op: BinaryOperator, kind: ScalarKind) -> Option<Form> {
    use BinaryOperator as Op;
    let float = kind == ScalarKind::Float;
    let integer = matches!(kind, ScalarKind::Uint | ScalarKind::Sint);
    Some(match op {
        Op::Add if float => Form::Infix("+"),
        Op::Subtract if float => Form::Infix("-"),
        Op::Multiply if float => Form::Infix("*"),
        Op::Divide if float => Form::Infix("/"),
        Op::Modulo if float => Form::Call("wgsl::rem"),
        Op::Add if integer => Form::Method("wrapping_add"),
        Op::Subtract if integer => Form::Method("wrapping_sub"),
        Op::Multiply if integer => Form::Method("wrapping_mul"),
        Op::Divide if kind == ScalarKind::Uint => Form::Call("wgsl::div_u32"),
        Op::Divide if integer => Form::Call("wgsl::div_i32"),
        Op::Modulo if kind == ScalarKind::Uint => Form::Call("wgsl::rem_u32"),
        Op::Modulo if integer => Form::Call("wgsl::rem_i32"),
        Op::Equal => Form::Compare("=="),
        Op::NotEqual => Form::Compare("!="),
        Op::Less => Form::Compare("<"),
        Op::LessEqual => Form::Compare("<="),
        Op::Greater => Form::Compare(">"),
        Op::GreaterEqual => Form::Compare(">="),
        Op::And if !float => Form::Infix("&"),
        Op::ExclusiveOr if !float => Form::Infix("^"),
        Op::InclusiveOr if !float => Form::Infix("|"),
        Op::LogicalAnd => Form::Infix("&&"),
        Op::LogicalOr => Form::Infix("||"),
        Op::ShiftLeft if integer => Form::Shift("wrapping_shl"),
        Op::ShiftRight if integer => Form::Shift("wrapping_shr"),
        _ => return None,
    })
}
