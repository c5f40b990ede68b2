//! Light linking: `only = [vase, plinth]` and `except = floor` become the instances that a light lights.

use std::rc::Rc;

use super::exclusive::one_of;
use super::field::Slot;
use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::value::Value;
use crate::eval::{Evaluator, Scope};
use crate::scene::{LightLinks, Name};
use crate::schema::Kind;
use crate::source::Span;
use crate::syntax::{Entry, ExprKind};

/// The fields, at most one of which a light has.
const FIELDS: [&str; 2] = ["only", "except"];

impl Evaluator<'_> {
    /// A list of names of declarations of one kind, or `Poison`; every entry that is none is reported.
    pub(super) fn names(
        &mut self,
        slot: Slot<'_>,
        kind: Kind,
        (entries, scope): (&[Entry], Scope<'_>),
    ) -> Value {
        let mut values = Vec::new();
        for entry in entries {
            if let Some(key) = &entry.key {
                let text = format!("the names of {} have no keys", slot.name());
                self.fault(Diagnostic::error(Code("E0305"), text).at(key.span, "leave this out"));
                return Value::Poison;
            }
            let value = match &entry.value.kind {
                ExprKind::Path(path) => self.path(path, scope, Some(kind)),
                _ => self.eval(&entry.value, scope),
            };
            values.push((value, entry.value.span));
        }
        self.fit_names(slot, kind, values.into())
    }

    /// Names of a list that is known, each with its place.
    pub(super) fn fit_names(
        &mut self,
        slot: Slot<'_>,
        kind: Kind,
        values: Rc<[(Value, Span)]>,
    ) -> Value {
        if values.is_empty() {
            let text = format!("{} is empty", slot.name());
            let error = Diagnostic::error(Code("E0306"), text).at(slot.span(), "names nothing");
            return self.fault(error.with_help("name something, or leave the field out"));
        }
        let mut sound = true;
        for (value, span) in values.iter() {
            match value {
                Value::Item(own, _) if *own == kind => continue,
                Value::Poison => {}
                other => drop(self.wrong_kind_at(slot, *span, other, kind.with_article())),
            }
            sound = false;
        }
        if sound { Value::List(values) } else { Value::Poison }
    }
}

/// Reports fields that contradict each other.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    one_of(ev, fields, &FIELDS, "what the light lights");
}

/// What a light with these fields lights; `None`: everything.
pub(super) fn links(ev: &Evaluator<'_>, fields: &Fields) -> Option<LightLinks> {
    let of = |field| -> Vec<Name> {
        let name = |(id, span)| Name { text: ev.program.full_name(id), span };
        fields.items(field).into_iter().map(name).collect()
    };
    let [only, except] = FIELDS.map(of);
    match (only.is_empty(), except.is_empty()) {
        (false, _) => Some(LightLinks::Only(only)),
        (true, false) => Some(LightLinks::Except(except)),
        (true, true) => None,
    }
}
