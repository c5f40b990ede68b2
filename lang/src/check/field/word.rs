//! A word against those that its field knows, and the symbol of a unit of length.

use super::slot::Slot;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::resolve::{did_you_mean, quoted_list};
use crate::schema::{FieldType, Word, type_text};
use crate::syntax::Ident;
use crate::units::{self, Dim};

impl Evaluator<'_> {
    pub(super) fn word(&mut self, slot: Slot<'_>, name: &Ident) -> Value {
        match slot.field.ty {
            FieldType::Word(words)
            | FieldType::Words(words)
            | FieldType::IntegerOr(_, _, words) => self.one_of(slot, words, name),
            FieldType::Axis => {
                let known = ["x", "y", "z"].contains(&name.text.as_str());
                let error =
                    Diagnostic::error(Code("E0308"), format!("{} needs a sign", slot.name()));
                let error = error.at(name.span, "which way?");
                self.fault(if known {
                    let text = format!("+{}", name.text);
                    error.with_fix(Fix::guess(format!("write `{text}`"), name.span, text))
                } else {
                    error.with_note("an axis is `+x`, `-x`, `+y`, `-y`, `+z` or `-z`")
                })
            }
            _ => match units::find(&name.text).filter(|unit| unit.dim == Dim::LENGTH) {
                Some(unit) => Value::Number(unit.factor, Dim::LENGTH),
                None => self.unknown_length_unit(slot, name),
            },
        }
    }

    pub(super) fn unknown_length_unit(&mut self, slot: Slot<'_>, name: &Ident) -> Value {
        let text = format!("{} needs a unit of length, found `{}`", slot.name(), name.text);
        let error = Diagnostic::error(Code("E0303"), text);
        if let Some(metric) = units::not_metric(&name.text) {
            let fix = Fix::sure(format!("write `{metric}`"), name.span, metric);
            return self.fault(error.at(name.span, "not metric").with_fix(fix));
        }
        let lengths: Vec<&str> =
            units::UNITS.iter().filter(|u| u.dim == Dim::LENGTH).map(|u| u.symbol).collect();
        let error = match units::other_spelling(&name.text).filter(|ours| lengths.contains(ours)) {
            Some(ours) => error
                .at(name.span, format!("did you mean `{ours}`?"))
                .with_fix(Fix::sure(format!("write `{ours}`"), name.span, ours)),
            None => error.at(name.span, "not known"),
        };
        self.fault(error.with_note(format!("the units of length are {}", lengths.join(" "))))
    }

    pub(super) fn one_of(&mut self, slot: Slot<'_>, words: &'static [Word], name: &Ident) -> Value {
        if let Some((word, _)) = words.iter().find(|(word, _)| *word == name.text) {
            return Value::Word(word);
        }
        let text = format!("{} cannot be `{}`", slot.name(), name.text);
        let all: Vec<String> = words.iter().map(|(word, _)| (*word).to_owned()).collect();
        let error = Diagnostic::error(Code("E0308"), text);
        let error = did_you_mean(error, name, words.iter().map(|(word, _)| *word));
        let is = match slot.field.ty {
            FieldType::IntegerOr(..) => format!("a {}", type_text(slot.field.ty)),
            _ => format!("one of {}", quoted_list(&all)),
        };
        self.fault(error.with_note(format!("it is {is}")))
    }
}
