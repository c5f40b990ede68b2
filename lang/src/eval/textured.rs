//! Arithmetic with textures: values of which one is a texture become an expression of them.

use std::rc::Rc;

use super::value::Value;
use crate::resolve::ItemId;
use crate::syntax::BinaryOp;
use crate::texture::{MAX_OPERATIONS, MAX_WAITING, TextureExpression};
use crate::units::Dim;

/// An expression whose images are declarations.
pub(crate) type Expression = TextureExpression<ItemId>;

/// Why two values have no sum, difference, product or quotient.
pub(super) enum Trouble {
    /// Their dimensions differ.
    Dimensions,
    /// Such values do not go together.
    Kinds,
    /// Division by zero.
    Zero,
    /// A dimension has too high a power.
    Exponent,
    /// The texture has too many parts.
    Size(String),
}

/// The value as an expression, if it can be part of one.
pub(super) fn part(value: &Value) -> Option<Expression> {
    match value {
        Value::Number(value, Dim::NONE) => Some(Expression::Number(*value)),
        Value::Color(rgb) => Some(Expression::Color(*rgb)),
        Value::TextureColor(id) => Some(Expression::Image(*id)),
        Value::TextureChannel(id, channel) => Some(Expression::Channel(*id, *channel)),
        Value::Textured(expression) => Some(expression.as_ref().clone()),
        _ => None,
    }
}

/// `a op b` where one of them is a texture.
pub(super) fn binary(op: BinaryOp, a: &Value, b: &Value) -> Result<Value, Trouble> {
    let (Some(x), Some(y)) = (part(a), part(b)) else { return Err(Trouble::Kinds) };
    let alike = x.is_color() == y.is_color();
    let expression = match op {
        BinaryOp::Add if alike => sum(x, y),
        BinaryOp::Sub if alike => sum(x, product(Expression::Number(-1.0), y)),
        BinaryOp::Mul => product(x, y),
        BinaryOp::Div => match y {
            Expression::Number(0.0) => return Err(Trouble::Zero),
            Expression::Number(y) => product(x, Expression::Number(1.0 / y)),
            _ => return Err(Trouble::Kinds),
        },
        BinaryOp::Add | BinaryOp::Sub => return Err(Trouble::Kinds),
    };
    sized(expression).map_err(Trouble::Size)
}

/// `-a` of a texture; or why there is none.
pub(super) fn negated(value: &Value) -> Result<Value, String> {
    let part = part(value).ok_or_else(|| format!("cannot negate {}", value.described()))?;
    sized(product(Expression::Number(-1.0), part))
}

/// `mix(a, b, t)` where one of them is a texture; or why there is none.
pub(super) fn mix([a, b, t]: [&Value; 3]) -> Result<Value, String> {
    let wrong = || format!("cannot mix {} and {}", a.described(), b.described());
    let (Some(x), Some(y), Some(t)) = (part(a), part(b), part(t)) else { return Err(wrong()) };
    if x.is_color() != y.is_color() || t.is_color() {
        return Err(wrong());
    }
    sized(Expression::Mix(Box::new([x, y, t])))
}

/// `clamp(x, low, high)` of a number of a texture; or why there is none.
pub(super) fn clamp(x: &Value, range: [f64; 2]) -> Result<Value, String> {
    let wrong = || format!("cannot clamp {}", x.described());
    let part = part(x).filter(|part| !part.is_color()).ok_or_else(wrong)?;
    sized(Expression::Clamp(Box::new(part), range))
}

/// A sum; of operands in the order in which fewer values wait.
fn sum(a: Expression, b: Expression) -> Expression {
    let swapped = b.waiting() > a.waiting();
    Expression::Sum(Box::new(if swapped { [b, a] } else { [a, b] }))
}

/// A product, constants multiplied now; of operands in the order in which fewer values wait.
fn product(a: Expression, b: Expression) -> Expression {
    match (a, b) {
        (Expression::Number(x), Expression::Number(y)) => Expression::Number(x * y),
        (Expression::Number(x), Expression::Color(rgb))
        | (Expression::Color(rgb), Expression::Number(x)) => Expression::Color(rgb.map(|c| c * x)),
        (a, b) => {
            let swapped = b.waiting() > a.waiting();
            Expression::Product(Box::new(if swapped { [b, a] } else { [a, b] }))
        }
    }
}

/// As a value, if kernels can hold it; or why not.
fn sized(expression: Expression) -> Result<Value, String> {
    let (operations, waiting) = (expression.operations(), expression.waiting());
    if operations > MAX_OPERATIONS {
        return Err(format!(
            "this texture takes {operations} operations, at most {MAX_OPERATIONS} fit"
        ));
    }
    if waiting > MAX_WAITING {
        return Err(format!(
            "this texture is nested too deeply: {waiting} values wait for each other, at most {MAX_WAITING} can"
        ));
    }
    Ok(Value::Textured(Rc::new(expression)))
}
