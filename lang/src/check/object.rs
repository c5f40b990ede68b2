//! Objects: what each is made of, and which hold which.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::fields::Fields;
use super::group::{self, Group};
use super::index::refuse_index;
use super::transform::{self, Pose};
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::{ShapeValue, Value};
use crate::resolve::ItemId;
use crate::schema::Kind;
use crate::source::Span;

/// Groups may hold groups this deep.
pub(super) const MAX_OBJECT_DEPTH: usize = 8;

/// A shape or a group with its place.
#[derive(Clone, Debug)]
pub(super) struct Thing {
    /// Which object it is; `None`: an instance.
    pub(super) object: Option<ItemId>,
    pub(super) shape: Rc<ShapeValue>,
    pub(super) shape_span: Span,
    pub(super) material: Option<(ItemId, Span)>,
    pub(super) group: Group,
    pub(super) pose: Pose,
}

/// Every object; those with faults are known to be there, and hold nothing. No object holds itself.
#[derive(Default)]
pub(super) struct Objects(BTreeMap<ItemId, Option<Rc<Thing>>>);

/// State of the walk that measures how deep objects are nested.
#[derive(Default)]
struct Walk {
    /// Objects on the way, outermost first.
    stack: Vec<ItemId>,
    depths: BTreeMap<ItemId, usize>,
    reported: BTreeSet<ItemId>,
}

impl Objects {
    /// Checks every object, then which objects hold which.
    pub(super) fn check(&mut self, ev: &mut Evaluator<'_>, ids: &[ItemId]) {
        for &id in ids {
            let known = !refuse_index(ev, Kind::Object, id);
            let fields = if known { ev.fields_of(id) } else { None };
            if let Some(fields) = &fields {
                transform::check(ev, fields);
            }
            let thing = fields.filter(|fields| fields.ok).and_then(|fields| thing(id, &fields));
            self.0.insert(id, thing.map(Rc::new));
        }
        let mut walk = Walk::default();
        for &id in ids {
            walk.stack.push(id);
            self.depth(ev, id, &mut walk);
            walk.stack.pop();
        }
        for id in walk.reported {
            self.0.insert(id, None);
        }
    }

    /// The object behind an id, if it is sound.
    pub(super) fn get(&self, id: ItemId) -> Option<Rc<Thing>> {
        self.0.get(&id).cloned().flatten()
    }

    /// How many groups deep an object is; the walk stops at cycles and at the limit.
    fn depth(&self, ev: &mut Evaluator<'_>, id: ItemId, walk: &mut Walk) -> usize {
        if let Some(depth) = walk.depths.get(&id) {
            return *depth;
        }
        let thing = self.get(id);
        let children: &[(ItemId, Span)] = match thing.as_ref().map(|thing| &*thing.shape) {
            Some(ShapeValue::Objects(children)) => children,
            Some(ShapeValue::Object(child, at)) => &[(*child, *at)],
            _ => &[],
        };
        let mut deepest = 0;
        for &(child, span) in children {
            if walk.stack.contains(&child) {
                if walk.reported.insert(id) {
                    let text = format!("`{}` contains itself", ev.program.name(child));
                    let error = Diagnostic::error(Code("E0803"), text)
                        .at(span, "leads back to it")
                        .because(ev.program.name_span(child), "this object");
                    ev.fault(error);
                }
            } else if walk.stack.len() > MAX_OBJECT_DEPTH + 1 {
                deepest = deepest.max(1);
            } else {
                walk.stack.push(child);
                deepest = deepest.max(1 + self.depth(ev, child, walk));
                walk.stack.pop();
            }
        }
        if deepest > MAX_OBJECT_DEPTH && walk.reported.insert(id) {
            let name = ev.program.name(id);
            let text = format!("`{name}` holds groups more than {MAX_OBJECT_DEPTH} deep");
            let span = ev.program.name_span(id);
            ev.fault(Diagnostic::error(Code("E0803"), text).at(span, "this object"));
        }
        walk.depths.insert(id, deepest);
        deepest
    }
}

/// The material that is written, with its place.
pub(super) fn material(fields: &Fields) -> Option<(ItemId, Span)> {
    fields.item("material").zip(fields.value_span("material"))
}

fn thing(id: ItemId, fields: &Fields) -> Option<Thing> {
    let Some(Value::Shape(shape)) = fields.get("shape") else { return None };
    Some(Thing {
        object: Some(id),
        shape,
        shape_span: fields.value_span("shape")?,
        material: material(fields),
        group: group::group(fields),
        pose: transform::pose(fields)?,
    })
}
