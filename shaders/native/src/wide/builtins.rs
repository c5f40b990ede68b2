//! Built-in functions over lanes: those whose bits IEEE 754 fixes.

use super::functions::WideWriter;
use super::operators::call;
use super::types::vector;
use crate::error::NativeError;
use naga::{Expression, Handle, MathFunction, ScalarKind};

impl WideWriter<'_> {
    /// A built-in function.
    pub(crate) fn math(
        &mut self,
        handle: Handle<Expression>,
        fun: MathFunction,
        arguments: &[Handle<Expression>],
    ) -> Result<String, NativeError> {
        let (scalar, n) = self.shape(arguments[0])?;
        let kind = scalar.kind;
        if let Some(name) = name_of(fun, kind) {
            return self.each_axis(handle, arguments, |x| call(name, kind, x));
        }
        match (fun, arguments) {
            (MathFunction::Saturate, &[x]) => self
                .each_axis(handle, &[x], |x| format!("v::clamp_f({}, v::f(0.0), v::f(1.0))", x[0])),
            (MathFunction::Clamp, _) => self.each_axis(handle, arguments, |x| {
                let low = call("max", kind, &x[..2]);
                call("min", kind, &[low, x[2].clone()])
            }),
            (MathFunction::Dot, &[a, b]) if n > 1 => {
                let (a, b) = (self.axes(a, n)?, self.axes(b, n)?);
                Ok(sum_of_products(kind, &a, &b))
            }
            (MathFunction::Cross, &[a, b]) => {
                let (a, b) = (self.axes(a, 3)?, self.axes(b, 3)?);
                let axis = |i: usize, j: usize| {
                    format!("v::sub_f(v::mul_f({}, {}), v::mul_f({}, {}))", a[i], b[j], a[j], b[i])
                };
                Ok(vector(&[axis(1, 2), axis(2, 0), axis(0, 1)]))
            }
            (MathFunction::Unpack4xU8, &[x]) => {
                let x = self.atom(x)?;
                let byte = |k: u32| format!("v::and_u(v::shr_u({x}, v::u({})), v::u(255))", 8 * k);
                Ok(vector(&[byte(0), byte(1), byte(2), byte(3)]))
            }
            _ => Err(self.refuse(handle, &format!("the function {fun:?}, in lanes,"))),
        }
    }
}

/// `dot(a, b)`, in the order of the scalar form.
fn sum_of_products(kind: ScalarKind, a: &[String], b: &[String]) -> String {
    let products = a.iter().zip(b).map(|(a, b)| call("mul", kind, &[a.clone(), b.clone()]));
    let sum = products.reduce(|sum, product| call("add", kind, &[sum, product]));
    sum.unwrap_or_default()
}

/// The name of a function that works number by number.
fn name_of(fun: MathFunction, kind: ScalarKind) -> Option<&'static str> {
    use MathFunction as F;
    let float = kind == ScalarKind::Float;
    Some(match fun {
        F::Abs if kind != ScalarKind::Uint => "abs",
        F::Min => "min",
        F::Max => "max",
        F::Clamp if float => "clamp",
        F::Ceil if float => "ceil",
        F::Floor if float => "floor",
        F::Round if float => "round",
        F::Fract if float => "fract",
        F::Trunc if float => "trunc",
        F::Sqrt if float => "sqrt",
        F::ReverseBits if kind == ScalarKind::Uint => "reverse",
        _ => return None,
    })
}
