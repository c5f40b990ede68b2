//! Warnings about values that are allowed and probably not meant.

use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::Evaluator;
use crate::schema::{Field, FieldType};
use crate::source::Span;
use crate::syntax::{Expr, ExprKind, Number, Unit};
use crate::units::{self, Dim};

/// Looks at a literal as it is written.
pub(super) fn literal(ev: &mut Evaluator<'_>, field: &Field, expr: &Expr) {
    match (&expr.kind, field.ty) {
        (
            ExprKind::Tuple { items, unit: Some(unit) },
            FieldType::Vector(Dim::ANGLE, _) | FieldType::Keyed(Dim::ANGLE, _),
        ) => {
            if let Some(item) = items.iter().find(|item| looks_like_radians(item)) {
                radians(ev, item.span, unit);
            }
        }
        (ExprKind::Number(Number { unit: Some(unit), .. }), FieldType::Number(bounds))
            if bounds.dim == Dim::ANGLE && looks_like_radians(expr) =>
        {
            radians(ev, expr.span, unit);
        }
        (
            ExprKind::Number(Number { unit: Some(unit), value, .. }),
            FieldType::Number(bounds) | FieldType::ScalarSlot(bounds),
        ) if unit.text == "%" && bounds.is_share() && *value > 0.0 && *value < 1.0 => {
            let text = format!("`{}` is less than one percent", field.name);
            let warning = Diagnostic::warning(Code("W0302"), "percent", text)
                .at(
                    expr.span,
                    format!("this is {}", units::show_number((value * 1e4).round() * 1e-6)),
                )
                .with_fix(Fix::guess("write a ratio", unit.span, ""));
            ev.tell(warning);
        }
        _ => {}
    }
}

/// A number of degrees that is a multiple of a twelfth of pi to three digits: 1.5708, 0.7854.
fn looks_like_radians(expr: &Expr) -> bool {
    let number = match &expr.kind {
        ExprKind::Number(number) => number,
        ExprKind::Negate(inner) => return looks_like_radians(inner),
        _ => return false,
    };
    let digits = number.text.split_once('.').map_or(0, |(_, tail)| tail.len());
    let twelfths = number.value / (std::f64::consts::PI / 12.0);
    digits >= 3 && twelfths.round() >= 1.0 && (twelfths - twelfths.round()).abs() < 2e-3
}

fn radians(ev: &mut Evaluator<'_>, span: Span, unit: &Unit) {
    if unit.text != "deg" {
        return;
    }
    let warning = Diagnostic::warning(Code("W0301"), "radians", "these degrees look like radians")
        .at(span, "a fraction of pi")
        .because(unit.span, "but the unit is degrees")
        .with_fix(Fix::guess("write radians", unit.span, "rad"));
    ev.tell(warning);
}
