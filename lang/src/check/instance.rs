//! Instances become a flat list of shapes with a pose and a material each.

use std::rc::Rc;

use super::fields::Fields;
use super::given::Givens;
use super::group::{self, Group};
use super::linked;
use super::object::{self, Objects, Thing};
use super::transform::{self, Mixed, Pose, Way};
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::value::{ShapeValue, Value};
use crate::eval::{Evaluator, Scope};
use crate::resolve::ItemId;
use crate::scene::LightLinks;
use crate::source::Span;
use crate::syntax::Index;
use crate::units::Dim;

/// A scene has at most this many instances.
pub(crate) const MAX_INSTANCES: usize = 1_000_000;

/// One shape in the world.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// Declared name, index, path through groups: the order of the scene.
    pub(super) key: (String, i64, String),
    pub(super) name: String,
    pub(super) name_span: Span,
    /// The object whose shape it is, with its place.
    pub(super) object: Option<(String, Span)>,
    /// Never an object or a group.
    pub(super) shape: Rc<ShapeValue>,
    pub(super) shape_span: Span,
    pub(super) material: Option<(ItemId, Span)>,
    pub(super) group: Group,
    /// What it lights, if it is a light that does not light everything.
    pub(super) links: Option<LightLinks>,
    pub(super) pose: Pose,
}

impl Placed {
    /// What it is made of, as far as the scene says.
    pub(super) fn materials(&self) -> Vec<ItemId> {
        let edits = match &*self.shape {
            ShapeValue::Mesh(_, _, edits) => edits.as_slice(),
            ShapeValue::Plain(_) | ShapeValue::Object(..) | ShapeValue::Objects(_) => &[],
        };
        let edited = edits.iter().filter_map(|edit| edit.material);
        self.material.map(|(id, _)| id).into_iter().chain(edited).collect()
    }
}

/// Collects what is in the world.
#[derive(Default)]
pub(super) struct World {
    pub(super) objects: Objects,
    pub(super) placed: Vec<Placed>,
    /// The limit was reported.
    full: bool,
    /// Objects visited, so that groups of groups without a shape end as well.
    steps: usize,
}

/// What things hand on to the things that they hold.
#[derive(Clone, Default)]
struct Inherited {
    material: Option<(ItemId, Span)>,
    group: Group,
}

/// Where the walk through groups is.
struct Place<'a> {
    key: &'a (String, i64, String),
    name_span: Span,
    /// What the instance itself says, which replaces what all others say.
    over: Inherited,
    links: Option<LightLinks>,
}

impl World {
    /// Checks an `instance` and, if `placed`, puts it into the world.
    pub(super) fn instance(&mut self, ev: &mut Evaluator<'_>, id: ItemId, placed: bool) {
        let (program, models) = (ev.program, ev.models);
        let (Some(decl), Some(model)) = (program.decl(id), models.get(&id)) else { return };
        let name = program.full_name(id);
        let Some(index) = decl.index.as_ref() else {
            if let Some(fields) = ev.fields_of(id) {
                let key = (name.clone(), 0, String::new());
                let material = object::material(&fields);
                self.place(ev, id, (&fields, material), &key, placed);
            }
            return;
        };
        ev.check_names(id);
        let Some((low, high)) = index_range(ev, index, id.module) else { return };
        let givens = ev.givens(id);
        if !has_required(ev, id, &givens) {
            return;
        }
        let variable = index.var.text.as_str();
        if low == high {
            // Nothing is placed, and its names and dimensions are checked all the same.
            let local = (variable, 0.0);
            ev.unsurely(|ev| ev.fields_at(model.schema, &givens, local));
        }
        for i in low..high {
            let before = ev.diagnostics.len();
            let fields = ev.fields_at(model.schema, &givens, (variable, i as f64));
            let key = (name.clone(), i, format!("[{i}]"));
            let material = object::material(&fields);
            self.place(ev, id, (&fields, material), &key, placed);
            let faults = &mut ev.diagnostics[before..];
            for fault in faults.iter_mut().filter(|fault| fault.code.0.starts_with("E04")) {
                fault.notes.push(format!("where `{variable}` is {i}"));
            }
            let failed = faults.iter().any(Diagnostic::is_error);
            if failed || !fields.ok || self.full {
                break;
            }
        }
    }

    /// The same of a `light` that is a thing: it is made of what the light itself says.
    pub(super) fn light(
        &mut self,
        ev: &mut Evaluator<'_>,
        id: ItemId,
        fields: &Fields,
        placed: bool,
    ) {
        let key = (ev.program.full_name(id), 0, String::new());
        let made_of = Some((id, ev.program.name_span(id)));
        self.place(ev, id, (fields, made_of), &key, placed);
    }

    fn place(
        &mut self,
        ev: &mut Evaluator<'_>,
        id: ItemId,
        (fields, material): (&Fields, Option<(ItemId, Span)>),
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
            (Some(Value::Shape(shape)), None) => shape,
            (_, Some((object, at))) => Rc::new(ShapeValue::Object(object, at)),
            (_, None) => {
                let text = format!("`{}` is missing `shape`", ev.program.name(id));
                let error = Diagnostic::error(Code("E0207"), text)
                    .at(name_span, "an instance needs a shape or an object")
                    .with_help("write `shape = sphere(radius: 1m)`, or `instance name: object`");
                ev.fault(error);
                return;
            }
        };
        transform::check(ev, fields);
        let Some(pose) = transform::pose(fields) else { return };
        let over = Inherited { material, group: group::group(fields) };
        let (material, group) = (over.material, over.group.clone());
        let place = Place { key, name_span, over, links: linked::links(ev, fields) };
        let shape_span = fields.value_span("shape").or(base.map(|(_, at)| at)).unwrap_or(name_span);
        let thing = Thing { object: None, shape, shape_span, material, group, pose };
        if placed {
            self.flatten(ev, &place, (&thing, &thing.pose), &mut Vec::new(), &Inherited::default());
        }
    }

    /// Puts a thing, or what it groups, into the world. `path` holds the names of the members on
    /// the way; a single object adds no name of its own.
    fn flatten(
        &mut self,
        ev: &mut Evaluator<'_>,
        place: &Place<'_>,
        (thing, world): (&Thing, &Pose),
        path: &mut Vec<ItemId>,
        inherited: &Inherited,
    ) {
        let own = Inherited {
            material: place.over.material.or(thing.material).or(inherited.material),
            group: first([&place.over.group, &thing.group, &inherited.group]),
        };
        let children: &[(ItemId, Span)] = match &*thing.shape {
            ShapeValue::Objects(children) => children,
            ShapeValue::Object(child, at) => &[(*child, *at)],
            _ => return self.put(ev, place, (thing, world), (path.as_slice(), own)),
        };
        let named = matches!(*thing.shape, ShapeValue::Objects(_));
        for &(child, _) in children {
            self.steps += 1;
            if self.full || self.steps > 16 * MAX_INSTANCES {
                self.overflow(ev, place);
                return;
            }
            let Some(inner) = self.objects.get(child) else { continue };
            let world = transform::nested(world, &inner.pose);
            if named {
                path.push(child);
            }
            self.flatten(ev, place, (&inner, &world), path, &own);
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
        (thing, world): (&Thing, &Pose),
        (path, Inherited { material, group }): (&[ItemId], Inherited),
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
        if material.is_none() && !matches!(*thing.shape, ShapeValue::Mesh(..)) {
            let text = format!("`{base}{tail}` has no material");
            let error = Diagnostic::error(Code("E0207"), text)
                .at(place.name_span, "what is it made of?")
                .because(thing.shape_span, "this shape has none of its own")
                .with_help("write `material = name`");
            ev.fault(error);
            return;
        }
        if let Way::Not(why) = world.way {
            mixed(ev, place, why);
            return;
        }
        if !transform::is_sound(world) {
            let text = format!("`{base}{tail}` is scaled or moved beyond what can be drawn");
            ev.fault(Diagnostic::error(Code("E0402"), text).at(place.name_span, "this instance"));
            return;
        }
        self.placed.push(Placed {
            key: (base.clone(), *index, tail.clone()),
            name: format!("{base}{tail}"),
            name_span: place.name_span,
            object: thing.object.map(|id| (ev.program.full_name(id), ev.program.name_span(id))),
            shape: Rc::clone(&thing.shape),
            shape_span: thing.shape_span,
            material,
            group,
            links: place.links.clone(),
            pose: world.clone(),
        });
    }
}

/// Reports keys that do not go together.
fn mixed(ev: &mut Evaluator<'_>, place: &Place<'_>, why: Mixed) {
    let (base, _, suffix) = place.key;
    let (text, help) = match why {
        Mixed::Stretched => (
            format!("`{base}{suffix}` holds something that turns, and is stretched"),
            "give the group's `scale` one number, and scale what turns itself",
        ),
        Mixed::Twice => (
            format!("`{base}{suffix}` turns, and holds something that moves"),
            "let either the group or its member turn; a group that only moves may hold both",
        ),
    };
    let error = Diagnostic::error(Code("E0806"), text).at(place.name_span, "this instance");
    ev.fault(error.with_help(help));
}

/// The first group that is there.
fn first(groups: [&Group; 3]) -> Group {
    groups.into_iter().find_map(Clone::clone)
}

/// Reports a missing shape once, before any index is tried.
fn has_required(ev: &mut Evaluator<'_>, id: ItemId, givens: &Givens<'_>) -> bool {
    let Some(model) = ev.models.get(&id) else { return false };
    givens.contains_key("shape") || model.object.is_some() || {
        let text = format!("`{}` is missing `shape`", ev.program.name(id));
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
