//! Arithmetic and comparison. `+ - <` need equal dimensions, `* /` add and subtract exponents.

use super::advice::{literal_unit, takes_unit, with_unit_fix};
use super::textured::{self, Trouble};
use super::value::Value;
use super::{Evaluator, Scope};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::scene::Axis;
use crate::schema::Kind;
use crate::source::Span;
use crate::syntax::{BinaryOp, CompareOp, Expr, ExprKind, ItemKind};
use crate::units::{self, Dim};

impl Evaluator<'_> {
    pub(super) fn negate(&mut self, inner: &Expr, scope: Scope<'_>) -> Value {
        match self.eval(inner, scope) {
            Value::Poison => Value::Poison,
            Value::Number(value, dim) => Value::Number(-value, dim),
            Value::Vector(values, dim) => {
                Value::Vector(values.into_iter().map(|v| -v).collect(), dim)
            }
            value if value.is_textured() => match textured::negated(&value) {
                Ok(value) => value,
                Err(text) => self.fault(Diagnostic::error(Code("E0111"), text).at(inner.span, "")),
            },
            other => {
                let text = format!("cannot negate {}", other.described());
                self.fault(Diagnostic::error(Code("E0305"), text).at(inner.span, other.described()))
            }
        }
    }

    pub(super) fn binary(
        &mut self,
        (op, op_span): (BinaryOp, Span),
        left: &Expr,
        right: &Expr,
        scope: Scope<'_>,
    ) -> Value {
        let (a, b) = (self.eval(left, scope), self.eval(right, scope));
        if a == Value::Poison || b == Value::Poison {
            return Value::Poison;
        }
        let result = match op {
            _ if a.is_textured() || b.is_textured() => textured::binary(op, &a, &b),
            BinaryOp::Add => combine(&a, &b, |x, y| x + y),
            BinaryOp::Sub => combine(&a, &b, |x, y| x - y),
            BinaryOp::Mul => multiply(&a, &b),
            BinaryOp::Div => divide(&a, &b),
        };
        match result {
            Ok(value) => value,
            Err(Trouble::Dimensions) => {
                let error = mismatch(op, op_span, (&a, left), (&b, right));
                let error = self.unit_of_other_side(error, (&a, left), (&b, right), scope);
                let error = self.explain_names(error, left, scope);
                let error = self.explain_names(error, right, scope);
                self.fault(error)
            }
            Err(Trouble::Zero) => {
                let error = Diagnostic::error(Code("E0402"), "division by zero")
                    .at(right.span, "this is zero");
                self.number_fault(error)
            }
            Err(Trouble::Size(text)) => {
                self.fault(Diagnostic::error(Code("E0111"), text).at(left.span.to(right.span), ""))
            }
            Err(Trouble::Exponent) => {
                let text = "this unit has too high a power";
                self.fault(Diagnostic::error(Code("E0302"), text).at(op_span, "here"))
            }
            Err(Trouble::Kinds) => {
                let text = match op {
                    BinaryOp::Add => format!("cannot add {} and {}", a.described(), b.described()),
                    BinaryOp::Sub => {
                        format!("cannot subtract {} from {}", b.described(), a.described())
                    }
                    BinaryOp::Mul => {
                        format!("cannot multiply {} by {}", a.described(), b.described())
                    }
                    BinaryOp::Div => {
                        format!("cannot divide {} by {}", a.described(), b.described())
                    }
                };
                let error = Diagnostic::error(Code("E0305"), text)
                    .at(op_span, "")
                    .because(left.span, a.described())
                    .because(right.span, b.described());
                let error = axis_advice(axis_advice(error, &a), &b);
                let error = match (&a, &b) {
                    (Value::Vector(..), Value::Vector(..)) if op == BinaryOp::Mul => {
                        error.with_help("use `dot(a, b)` or `cross(a, b)`")
                    }
                    (Value::Item(Kind::Texture, _), _) | (_, Value::Item(Kind::Texture, _)) => {
                        error.with_help("the colour of a texture is `.rgb`, one channel is `.r`")
                    }
                    _ => error,
                };
                self.fault(error)
            }
        }
    }

    #[expect(clippy::float_cmp, reason = "`==` of the language means exactly equal")]
    pub(super) fn compare(
        &mut self,
        (op, op_span): (CompareOp, Span),
        left: &Expr,
        right: &Expr,
        scope: Scope<'_>,
    ) -> Value {
        let (a, b) = (self.eval(left, scope), self.eval(right, scope));
        match (&a, &b) {
            (Value::Poison, _) | (_, Value::Poison) => Value::Poison,
            (Value::Number(x, dim), Value::Number(y, other)) if dim == other => {
                Value::Bool(match op {
                    CompareOp::Less => x < y,
                    CompareOp::LessEqual => x <= y,
                    CompareOp::Greater => x > y,
                    CompareOp::GreaterEqual => x >= y,
                    CompareOp::Equal => x == y,
                    CompareOp::NotEqual => x != y,
                })
            }
            (Value::Bool(_), Value::Bool(_)) | (Value::Text(_), Value::Text(_))
                if matches!(op, CompareOp::Equal | CompareOp::NotEqual) =>
            {
                Value::Bool((a == b) == (op == CompareOp::Equal))
            }
            _ => {
                let code = if a.dim().is_some() && b.dim().is_some() { "E0302" } else { "E0305" };
                let text = format!("cannot compare {} with {}", a.described(), b.described());
                let error = Diagnostic::error(Code(code), text)
                    .at(op_span, "")
                    .because(left.span, a.described())
                    .because(right.span, b.described());
                let error = self.unit_of_other_side(error, (&a, left), (&b, right), scope);
                let error = self.explain_names(error, left, scope);
                let error = self.explain_names(error, right, scope);
                self.fault(error)
            }
        }
    }
}

/// `a + b`, `a - b`.
fn combine(a: &Value, b: &Value, f: impl Fn(f64, f64) -> f64) -> Result<Value, Trouble> {
    match (a, b) {
        (Value::Number(x, dim), Value::Number(y, other)) if dim == other => {
            Ok(Value::Number(f(*x, *y), *dim))
        }
        (Value::Vector(x, dim), Value::Vector(y, other)) if x.len() == y.len() => {
            if dim != other {
                return Err(Trouble::Dimensions);
            }
            Ok(Value::Vector(x.iter().zip(y).map(|(x, y)| f(*x, *y)).collect(), *dim))
        }
        (Value::Color(x), Value::Color(y)) => {
            Ok(Value::Color([f(x[0], y[0]), f(x[1], y[1]), f(x[2], y[2])]))
        }
        (Value::Number(..), Value::Number(..)) => Err(Trouble::Dimensions),
        _ => Err(Trouble::Kinds),
    }
}

fn multiply(a: &Value, b: &Value) -> Result<Value, Trouble> {
    match (a, b) {
        (Value::Number(x, dim), Value::Number(y, other)) => {
            Ok(Value::Number(x * y, dim.times(*other).ok_or(Trouble::Exponent)?))
        }
        (Value::Number(x, dim), Value::Vector(v, other))
        | (Value::Vector(v, other), Value::Number(x, dim)) => {
            let dim = dim.times(*other).ok_or(Trouble::Exponent)?;
            Ok(Value::Vector(v.iter().map(|v| v * x).collect(), dim))
        }
        (Value::Number(x, Dim::NONE), Value::Color(rgb))
        | (Value::Color(rgb), Value::Number(x, Dim::NONE)) => Ok(Value::Color(rgb.map(|c| c * x))),
        (Value::Color(x), Value::Color(y)) => {
            Ok(Value::Color([x[0] * y[0], x[1] * y[1], x[2] * y[2]]))
        }
        _ => Err(Trouble::Kinds),
    }
}

fn divide(a: &Value, b: &Value) -> Result<Value, Trouble> {
    let Value::Number(y, other) = b else { return Err(Trouble::Kinds) };
    let result = match a {
        Value::Number(x, dim) => Value::Number(x / y, dim.per(*other).ok_or(Trouble::Exponent)?),
        Value::Vector(v, dim) => {
            let dim = dim.per(*other).ok_or(Trouble::Exponent)?;
            Value::Vector(v.iter().map(|v| v / y).collect(), dim)
        }
        Value::Color(rgb) if other.is_none() => Value::Color(rgb.map(|c| c / y)),
        _ => return Err(Trouble::Kinds),
    };
    if *y == 0.0 { Err(Trouble::Zero) } else { Ok(result) }
}

fn mismatch(
    op: BinaryOp,
    op_span: Span,
    (a, left): (&Value, &Expr),
    (b, right): (&Value, &Expr),
) -> Diagnostic {
    let (x, y) = (dim_text(a), dim_text(b));
    let text = match op {
        BinaryOp::Sub => format!("cannot subtract {y} from {x}"),
        _ => format!("cannot add {x} and {y}"),
    };
    Diagnostic::error(Code("E0302"), text)
        .at(op_span, "")
        .because(left.span, x)
        .because(right.span, y)
}

fn dim_text(value: &Value) -> String {
    value.dim().map_or_else(|| value.described(), |dim| dim.to_string())
}

impl Evaluator<'_> {
    /// Where a literal stands on one side: proposes the unit of the other side.
    fn unit_of_other_side(
        &self,
        error: Diagnostic,
        (a, left): (&Value, &Expr),
        (b, right): (&Value, &Expr),
        scope: Scope<'_>,
    ) -> Diagnostic {
        let (Some(x), Some(y)) = (a.dim(), b.dim()) else { return error };
        let sides = [(right, y, left, x), (left, x, right, y)];
        for (literal, own, other, wanted) in sides {
            if wanted.is_none() {
                continue;
            }
            let of_dimension = |unit: &&str| units::parse(unit).is_ok_and(|(dim, _)| dim == wanted);
            let unit = self.written_unit(other, scope).filter(of_dimension);
            if own.is_none() && takes_unit(literal) {
                let error = with_unit_fix(error, literal, wanted, unit.unwrap_or_default());
                return as_guess(error);
            }
            let usual = if wanted == Dim::ANGLE { Some("deg") } else { units::si_symbol(wanted) };
            let written = match &literal.kind {
                ExprKind::Number(number) => number.unit.as_ref(),
                _ => None,
            };
            if let (Some(unit), Some(written)) = (unit.or(usual), written) {
                return error.with_fix(Fix::guess(format!("write {wanted}"), written.span, unit));
            }
        }
        error
    }

    /// The unit that a literal is written with, or the value of a name.
    fn written_unit<'e>(&'e self, expr: &'e Expr, scope: Scope<'_>) -> Option<&'e str> {
        let ExprKind::Path(path) = &expr.kind else { return literal_unit(expr) };
        let id = self.program.lookup(scope.module, path)?;
        match &self.program.item(id).kind {
            ItemKind::Let(binding) => literal_unit(&binding.value),
            ItemKind::Param(param) => literal_unit(&param.value),
            _ => None,
        }
    }
}

/// The unit of the other side is likely, not certain.
fn as_guess(mut error: Diagnostic) -> Diagnostic {
    for fix in &mut error.fixes {
        fix.applicability = crate::diagnostic::Applicability::MaybeIncorrect;
    }
    error
}

/// `-x` is always the axis, never the negated name `x`.
pub(super) fn axis_advice(error: Diagnostic, value: &Value) -> Diagnostic {
    let name = match value {
        Value::Axis(Axis::MinusX) => "x",
        Value::Axis(Axis::MinusY) => "y",
        Value::Axis(Axis::MinusZ) => "z",
        _ => return error,
    };
    error.with_help(format!("`-{name}` is an axis; for the negated value write `- {name}`"))
}
