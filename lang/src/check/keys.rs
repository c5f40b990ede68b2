//! Keys of a field that may change with time: `[0ms: (0, 0, 0)m, 20ms: (1, 0, 0)m]`.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::value::{Key, Value};
use crate::eval::{Evaluator, Scope, with_unit_fix};
use crate::source::Span;
use crate::syntax::{Entry, Expr};
use crate::units::Dim;

/// Keys of triples with this dimension, in order of time, or `Poison`. Every fault is reported. `name`: the field in
/// messages, `span`: its value; `triple` evaluates what a key holds.
pub(super) fn keys(
    ev: &mut Evaluator<'_>,
    (name, span): (&str, Span),
    dim: Dim,
    (entries, scope): (&[Entry], Scope<'_>),
    triple: impl Fn(&mut Evaluator<'_>, &Expr) -> Value,
) -> Value {
    let mut found: Vec<Option<Key>> = Vec::new();
    let mut last: Option<(f64, &Expr)> = None;
    for entry in entries {
        let time = time(ev, name, entry, scope);
        if let (Some(time), Some(key)) = (time, &entry.key) {
            if let Some((before, earlier)) = last.filter(|(before, _)| time <= *before) {
                let text = format!("the keys of {name} are not in order of time");
                let error = Diagnostic::error(Code("E0401"), text).at(key.span, "not later");
                let error = error.because(earlier.span, "than this one");
                ev.fault(error.with_help(if time < before {
                    "put the earlier key first"
                } else {
                    "leave out one of the two keys"
                }));
                found.push(None);
            }
            last = Some((time, key));
        }
        let triple = match triple(ev, &entry.value) {
            Value::Vector(values, _) => values.try_into().ok(),
            _ => None,
        };
        found.push(time.zip(triple));
    }
    let Some(found) = found.into_iter().collect::<Option<Vec<_>>>() else { return Value::Poison };
    if found.len() < 2 {
        let text = format!("{name} needs two keys or more, found {}", found.len());
        let error = Diagnostic::error(Code("E0306"), text).at(span, "nothing moves here");
        return ev.fault(error.with_help("write a second key, or the value alone"));
    }
    Value::Keys(found.into(), dim)
}

/// The time of a key.
fn time(ev: &mut Evaluator<'_>, name: &str, entry: &Entry, scope: Scope<'_>) -> Option<f64> {
    let Some(key) = &entry.key else {
        let text = format!("this key of {name} has no time");
        let error = Diagnostic::error(Code("E0305"), text).at(entry.value.span, "when?");
        ev.fault(error.with_help("write keys as in `[0ms: (0, 0, 0)m, 20ms: (1, 0, 0)m]`"));
        return None;
    };
    match ev.eval(key, scope) {
        Value::Poison => None,
        Value::Number(time, Dim::TIME) if time.abs() <= crate::schema::MAX_MAGNITUDE => Some(time),
        other => {
            let text = format!("a key needs a time, found {}", other.described());
            let plain = matches!(other, Value::Number(_, Dim::NONE));
            let code = if plain { "E0301" } else { "E0302" };
            let error = Diagnostic::error(Code(code), text).at(key.span, "when?");
            ev.fault(if plain { with_unit_fix(error, key, Dim::TIME, "ms") } else { error });
            None
        }
    }
}
