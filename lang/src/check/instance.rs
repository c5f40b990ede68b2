//! Instances and objects become a flat list of shapes with a matrix and a material each.

use std::collections::{BTreeMap, BTreeSet};

use super::fields::{Fields, Givens};
use super::transform::{self, Matrix};
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::value::{ShapeValue, Value};
use crate::eval::{Evaluator, Scope};
use crate::resolve::ItemId;
use crate::schema::Kind;
use crate::source::Span;
use crate::syntax::Index;
use crate::units::Dim;

/// A scene has at most this many instances.
pub(crate) const MAX_INSTANCES: usize = 1_000_000;

/// Groups may hold groups this deep.
pub(crate) const MAX_OBJECT_DEPTH: usize = 8;

/// One shape in the world.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// Declared name, index, path through groups: the order of the scene.
    pub(super) key: (String, i64, String),
    pub(super) name: String,
    pub(super) name_span: Span,
    /// Never an object or a group.
    pub(super) shape: ShapeValue,
    pub(super) shape_span: Span,
    pub(super) material: Option<(ItemId, Span)>,
    pub(super) matrix: Matrix,
}

/// A checked object.
#[derive(Clone, Debug)]
struct Thing {
    shape: ShapeValue,
    shape_span: Span,
    material: Option<(ItemId, Span)>,
    matrix: Matrix,
}

/// Collects what is in the world.
#[derive(Default)]
pub(super) struct World {
    objects: BTreeMap<ItemId, Option<Thing>>,
    pub(super) placed: Vec<Placed>,
    /// The limit was reported.
    full: bool,
    /// Objects visited, so that groups of groups without a shape end as well.
    steps: usize,
}

/// Where the walk through groups is.
struct Place<'a> {
    key: &'a (String, i64, String),
    name_span: Span,
    /// Material of the instance itself, which replaces all others.
    over: Option<(ItemId, Span)>,
}

impl World {
    /// Checks every object, then which objects hold which.
    pub(super) fn check_objects(&mut self, ev: &mut Evaluator<'_>, ids: &[ItemId]) {
        for &id in ids {
            if super::refuse_index(ev, Kind::Object, id) {
                self.objects.insert(id, None);
                continue;
            }
            let fields = ev.fields_of(id);
            let thing = fields.filter(|fields| fields.ok).and_then(|fields| thing(&fields));
            self.objects.insert(id, thing);
        }
        let mut depths: BTreeMap<ItemId, usize> = BTreeMap::new();
        let mut reported = BTreeSet::new();
        for &id in ids {
            self.depth(ev, id, &mut vec![id], &mut depths, &mut reported);
        }
        for id in reported {
            self.objects.insert(id, None);
        }
    }

    /// How many groups deep an object is; the walk stops at cycles and at the limit.
    fn depth(
        &self,
        ev: &mut Evaluator<'_>,
        id: ItemId,
        stack: &mut Vec<ItemId>,
        depths: &mut BTreeMap<ItemId, usize>,
        reported: &mut BTreeSet<ItemId>,
    ) -> usize {
        if let Some(depth) = depths.get(&id) {
            return *depth;
        }
        let mut deepest = 0;
        let children: &[(ItemId, Span)] = match self.objects.get(&id) {
            Some(Some(Thing { shape: ShapeValue::Objects(children), .. })) => children,
            Some(Some(Thing { shape: ShapeValue::Object(child, at), .. })) => &[(*child, *at)],
            _ => &[],
        };
        {
            for &(child, span) in children {
                if stack.contains(&child) {
                    let text = format!("`{}` contains itself", ev.program.name(child));
                    let error = Diagnostic::error(Code("E0803"), text)
                        .at(span, "leads back to it")
                        .because(ev.program.name_span(child), "this object");
                    ev.fault(error);
                    reported.insert(id);
                    continue;
                }
                if stack.len() > MAX_OBJECT_DEPTH + 1 {
                    deepest = deepest.max(1);
                    continue;
                }
                stack.push(child);
                deepest = deepest.max(1 + self.depth(ev, child, stack, depths, reported));
                stack.pop();
            }
        }
        if deepest > MAX_OBJECT_DEPTH && reported.insert(id) {
            let text =
                format!("`{}` holds groups more than {MAX_OBJECT_DEPTH} deep", ev.program.name(id));
            let span = ev.program.name_span(id);
            ev.fault(Diagnostic::error(Code("E0803"), text).at(span, "this object"));
        }
        depths.insert(id, deepest);
        deepest
    }

    /// Checks an `instance` and, if `placed`, puts it into the world.
    pub(super) fn instance(&mut self, ev: &mut Evaluator<'_>, id: ItemId, placed: bool) {
        let (program, models) = (ev.program, ev.models);
        let (Some(decl), Some(model)) = (program.decl(id), models.get(&id)) else { return };
        let name = program.full_name(id);
        let Some(index) = decl.index.as_ref() else {
            if let Some(fields) = ev.fields_of(id) {
                let key = (name.clone(), 0, String::new());
                self.place(ev, id, &fields, &key, placed);
            }
            return;
        };
        ev.check_names(id);
        let Some((low, high)) = index_range(ev, index, id.module) else { return };
        let givens = ev.givens(id);
        if !has_required(ev, id, &givens) || low == high {
            return;
        }
        for i in low..high {
            let before = ev.diagnostics.len();
            #[expect(clippy::cast_precision_loss, reason = "index ranges end at 2^53")]
            let local = (index.var.text.as_str(), i as f64);
            let fields = ev.fields_at(model.schema, &givens, local);
            let key = (name.clone(), i, format!("[{i}]"));
            self.place(ev, id, &fields, &key, placed);
            let failed = ev.diagnostics[before..].iter().any(Diagnostic::is_error);
            if failed || !fields.ok || self.full {
                break;
            }
        }
    }

    fn place(
        &mut self,
        ev: &mut Evaluator<'_>,
        id: ItemId,
        fields: &Fields,
        key: &(String, i64, String),
        placed: bool,
    ) {
        let name_span = ev.program.name_span(id);
        let base = ev.models.get(&id).and_then(|model| model.object);
        if let Some((base, _)) = base {
            ev.used.insert(base);
        }
        if !fields.ok {
            return;
        }
        let shape = match (fields.get("shape"), base) {
            (Some(Value::Shape(_)), Some((object, at))) => {
                let text = "this instance has two shapes";
                let name = ev.program.name(object);
                let error = Diagnostic::error(Code("E0703"), text)
                    .at(fields.span("shape").unwrap_or(name_span), "keep one of them")
                    .because(at, format!("it already has the shape of `{name}`"));
                ev.fault(error);
                return;
            }
            (Some(Value::Shape(shape)), None) => *shape,
            (_, Some((object, at))) => ShapeValue::Object(object, at),
            (_, None) => {
                let text = format!("`{}` lacks `shape`", ev.program.name(id));
                let error = Diagnostic::error(Code("E0207"), text)
                    .at(name_span, "an instance needs a shape or an object")
                    .with_help("write `shape = sphere(radius: 1m)`, or `instance name: object`");
                ev.fault(error);
                return;
            }
        };
        let Some(matrix) = transform::matrix(fields) else { return };
        let over = material(fields);
        let place = Place { key, name_span, over };
        let shape_span = fields.value_span("shape").or(base.map(|(_, at)| at)).unwrap_or(name_span);
        let thing = Thing { shape, shape_span, material: over, matrix };
        if placed {
            self.flatten(ev, &place, &thing, &mut Vec::new(), None);
        }
    }

    /// Puts a thing, or what it groups, into the world. `path` holds the names of the members on
    /// the way; a single object adds no name of its own.
    fn flatten(
        &mut self,
        ev: &mut Evaluator<'_>,
        place: &Place<'_>,
        thing: &Thing,
        path: &mut Vec<ItemId>,
        inherited: Option<(ItemId, Span)>,
    ) {
        self.steps += 1;
        if self.full || self.steps > 16 * MAX_INSTANCES {
            self.overflow(ev, place);
            return;
        }
        let own = place.over.or(thing.material).or(inherited);
        let children: &[(ItemId, Span)] = match &thing.shape {
            ShapeValue::Objects(children) => children,
            ShapeValue::Object(child, at) => &[(*child, *at)],
            _ => return self.put(ev, place, thing, (path.as_slice(), own)),
        };
        let named = matches!(thing.shape, ShapeValue::Objects(_));
        for &(child, _) in children {
            let Some(Some(inner)) = self.objects.get(&child) else { continue };
            let mut inner = inner.clone();
            inner.matrix = transform::product(&thing.matrix, &inner.matrix);
            if named {
                path.push(child);
            }
            self.flatten(ev, place, &inner, path, own);
            if named {
                path.pop();
            }
        }
    }

    /// Reports once that there is too much in the world.
    fn overflow(&mut self, ev: &mut Evaluator<'_>, place: &Place<'_>) {
        if !self.full {
            self.full = true;
            let text = format!("the scene has more than {MAX_INSTANCES} instances");
            ev.fault(Diagnostic::error(Code("E0801"), text).at(place.name_span, "too many here"));
        }
    }

    fn put(
        &mut self,
        ev: &mut Evaluator<'_>,
        place: &Place<'_>,
        thing: &Thing,
        (path, material): (&[ItemId], Option<(ItemId, Span)>),
    ) {
        if self.placed.len() >= MAX_INSTANCES {
            self.overflow(ev, place);
            return;
        }
        let (base, index, suffix) = place.key;
        let parts: Vec<&str> = path.iter().map(|id| ev.program.name(*id)).collect();
        let mut tail = suffix.clone();
        for part in parts {
            tail.push('.');
            tail.push_str(part);
        }
        if material.is_none() && !matches!(thing.shape, ShapeValue::Mesh(..)) {
            let text = format!("`{base}{tail}` has no material");
            let error = Diagnostic::error(Code("E0207"), text)
                .at(place.name_span, "what is it made of?")
                .because(thing.shape_span, "this shape has none of its own")
                .with_help("write `material = name`");
            ev.fault(error);
            return;
        }
        if !transform::is_sound(&thing.matrix) {
            let text = format!("`{base}{tail}` is scaled or moved beyond what can be drawn");
            ev.fault(Diagnostic::error(Code("E0402"), text).at(place.name_span, "this instance"));
            return;
        }
        self.placed.push(Placed {
            key: (base.clone(), *index, tail.clone()),
            name: format!("{base}{tail}"),
            name_span: place.name_span,
            shape: thing.shape.clone(),
            shape_span: thing.shape_span,
            material,
            matrix: thing.matrix,
        });
    }
}

/// The material that is written, with its place.
fn material(fields: &Fields) -> Option<(ItemId, Span)> {
    fields.item("material").zip(fields.value_span("material"))
}

fn thing(fields: &Fields) -> Option<Thing> {
    let Some(Value::Shape(shape)) = fields.get("shape") else { return None };
    Some(Thing {
        shape: *shape,
        shape_span: fields.value_span("shape")?,
        material: material(fields),
        matrix: transform::matrix(fields)?,
    })
}

/// Reports a missing shape once, before any index is tried.
fn has_required(ev: &mut Evaluator<'_>, id: ItemId, givens: &Givens<'_>) -> bool {
    let Some(model) = ev.models.get(&id) else { return false };
    let partial = model.chain.iter().filter_map(|m| ev.program.decl(*m)).any(|decl| decl.partial);
    partial || givens.contains_key("shape") || model.object.is_some() || {
        let text = format!("`{}` lacks `shape`", ev.program.name(id));
        let span = ev.program.name_span(id);
        let error = Diagnostic::error(Code("E0207"), text)
            .at(span, "an instance needs a shape or an object");
        ev.fault(error);
        false
    }
}

/// The whole numbers that an index runs through.
fn index_range(ev: &mut Evaluator<'_>, index: &Index, module: u32) -> Option<(i64, i64)> {
    let scope = Scope { module, local: None };
    let span = index.range.span;
    let value = ev.eval(&index.range, scope);
    let error = |text: String| Diagnostic::error(Code("E0802"), text);
    let (low, high) = match value {
        Value::Poison => return None,
        Value::Range(low, high, Dim::NONE) => (low, high),
        other => {
            let text = format!(
                "an index runs from one plain number to another, not {}",
                other.described()
            );
            ev.fault(error(text).at(span, "write `0..6`"));
            return None;
        }
    };
    if low.fract() != 0.0 || high.fract() != 0.0 {
        ev.fault(error("an index runs through whole numbers".to_owned()).at(span, "not whole"));
        return None;
    }
    if high < low {
        let text = format!("this index ends before it begins: {low}..{high}");
        ev.fault(error(text).at(span, "the end is not included"));
        return None;
    }
    if high - low > MAX_INSTANCES as f64 || low.abs() > 9e15 {
        let text = format!("this index makes {} instances, more than {MAX_INSTANCES}", high - low);
        ev.fault(Diagnostic::error(Code("E0801"), text).at(span, "too many"));
        return None;
    }
    #[expect(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
    Some((low as i64, high as i64))
}
