//! The fields of a declaration or a call: collected along `like`, and evaluated.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::fields::{Fields, default_value, is_said_by_files};
use super::given::{Given, Givens, OwnFields};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::value::Value;
use crate::eval::{Evaluator, Scope};
use crate::resolve::{ItemId, quoted_list};
use crate::schema::{Field, FieldType, Kind, TypeSchema, types_of};
use crate::source::Span;
use crate::suggest::suggest;
use crate::syntax::{Arg, Expr, Ident};

impl<'p> Evaluator<'p> {
    /// The assignments of a declaration: the nearest along `like` wins.
    pub(crate) fn givens(&mut self, id: ItemId) -> Givens<'p> {
        let models = self.models;
        let chain = models.get(&id).map_or(&[][..], |model| &model.chain);
        let mut givens = BTreeMap::new();
        for &member in chain.iter().rev() {
            givens
                .extend(self.own_fields(member).givens.iter().map(|(name, given)| (*name, *given)));
        }
        givens
    }

    /// Whether a declaration, or one that it is like, has fields that are not known.
    pub(super) fn is_unsure(&mut self, id: ItemId) -> bool {
        let models = self.models;
        let chain = models.get(&id).map_or(&[][..], |model| &model.chain);
        chain.iter().any(|member| self.own_fields(*member).unsure)
    }

    fn own_fields(&mut self, id: ItemId) -> Rc<OwnFields<'p>> {
        if let Some(known) = self.own_fields.get(&id) {
            return Rc::clone(known);
        }
        let mut own = OwnFields::default();
        if let (Some(model), Some(decl)) = (self.models.get(&id), self.program.decl(id)) {
            own.unsure = decl.partial;
            for given in &decl.fields {
                if let Some(field) = model.schema.field(&given.path.text()) {
                    let module = id.module;
                    let given = Given { field, expr: &given.value, span: given.span, module };
                    own.givens.insert(field.name, given);
                } else {
                    own.unsure = true;
                }
            }
        }
        let own = Rc::new(own);
        self.own_fields.insert(id, Rc::clone(&own));
        own
    }

    /// Reports fields that do not exist and fields that are written twice.
    pub(crate) fn check_names(&mut self, id: ItemId) {
        let (Some(model), Some(decl)) = (self.models.get(&id), self.program.decl(id)) else {
            return;
        };
        let schema = model.schema;
        let mut seen: BTreeMap<String, Span> = BTreeMap::new();
        let written: BTreeSet<String> = decl.fields.iter().map(|field| field.path.text()).collect();
        for field in &decl.fields {
            let name = field.path.text();
            if schema.field(&name).is_none() {
                let ident = Ident { text: name, span: field.path.span };
                self.unknown_field(schema, &ident, &written);
                let scope = Scope { module: id.module, local: None };
                if decl.index.is_none() && !is_word(&field.value) {
                    self.eval(&field.value, scope);
                }
            } else if let Some(first) = seen.insert(name.clone(), field.path.span) {
                let error = Diagnostic::error(Code("E0204"), format!("`{name}` is set twice"))
                    .at(field.path.span, "set again")
                    .because(first, "first set here")
                    .with_help("keep one of them");
                self.fault(error);
            }
        }
    }

    /// Reports a field or an argument that does not exist, with the one that was meant.
    fn unknown_field(
        &mut self,
        schema: &'static TypeSchema,
        name: &Ident,
        written: &BTreeSet<String>,
    ) {
        let what = if schema.kind == Kind::Shape { "argument" } else { "field" };
        let text = format!("{} has no {what} `{}`", schema.described(), name.text);
        let error = Diagnostic::error(Code("E0201"), text);
        let free = |ours: &str| !written.contains(ours);
        let names = schema.fields.iter().map(|field| field.name).filter(|ours| free(ours));
        let close = suggest(&name.text, names);
        let same = close.first().filter(|ours| ours.eq_ignore_ascii_case(&name.text));
        let foreign = schema.fields.iter().find_map(|field| {
            let found = field.foreign.iter().find(|(theirs, _)| *theirs == name.text);
            found.map(|(_, from)| (field, *from))
        });
        let group = group(schema, name);
        let error = match (same, foreign, close.as_slice()) {
            (None, Some((ours, from)), _) => {
                let error = error
                    .at(name.span, "not known")
                    .with_note(format!("`{}` is the name in {from}", name.text));
                // `width` and `height` are one field here: neither name can be replaced alone.
                let theirs = ours.foreign.iter().filter(|(theirs, _)| written.contains(*theirs));
                let halves = matches!(ours.ty, FieldType::Pixels);
                let part = theirs.count() > 1 || halves && name.text != "resolution";
                let ours = ours.name;
                if part && free(ours) {
                    let example = schema.example;
                    error.with_help(format!("in `.rts` it is part of `{ours}`, as in: {example}"))
                } else if free(ours) {
                    error.with_fix(Fix::sure(format!("in `.rts` it is `{ours}`"), name.span, ours))
                } else {
                    error.with_help(format!("in `.rts` it is `{ours}`, which is set already"))
                }
            }
            _ if is_optical_constant(schema, name) => error.at(name.span, "not known").with_note(
                "metals take `color`, their reflectance at normal incidence: \
                 ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2) in each channel",
            ),
            _ if is_subsurface(schema, name) => error
                .at(name.span, "not known")
                .with_note("light that wanders below a surface does so in the `interior` of a `dielectric`")
                .with_help(
                    "declare `medium wax: homogeneous { mean_free_path = (12, 5, 3)mm, albedo = linear(0.998, 0.99, 0.96) }` \
                     and `material skin: dielectric { roughness = 0.3, interior = wax }` for a closed mesh",
                ),
            _ if !group.is_empty() => error
                .at(name.span, "a group of fields")
                .with_help(format!("set what is meant: {}", quoted_list(&group))),
            (_, _, [one, ..]) => error
                .at(name.span, format!("did you mean `{one}`?"))
                .with_fix(Fix::sure(format!("write `{one}`"), name.span, *one)),
            (_, _, []) => other_owner(error.at(name.span, "not known"), schema, name),
        };
        self.fault(error);
    }

    /// Evaluates the fields of a declaration without an index.
    pub(crate) fn fields_of(&mut self, id: ItemId) -> Option<Fields> {
        self.check_names(id);
        let givens = self.givens(id);
        let model = self.models.get(&id)?;
        let (schema, of_file) = (model.schema, model.of_file.clone());
        let mut fields = Fields::new(schema);
        fields.of_file = of_file;
        for given in givens.values() {
            let value = self.field_once(id, schema, given);
            fields.put(given.field, value, given.span, given.expr.span);
        }
        self.check_missing(id, &mut fields);
        Some(fields)
    }

    /// Evaluates the fields of an indexed declaration for one value of its variable.
    pub(crate) fn fields_at(
        &mut self,
        schema: &'static TypeSchema,
        givens: &Givens<'p>,
        local: (&str, f64),
    ) -> Fields {
        let mut fields = Fields::new(schema);
        for given in givens.values() {
            let scope = Scope { module: given.module, local: Some(local) };
            let value = self.field_value(schema, given.field, given.expr, scope);
            fields.put(given.field, value, given.span, given.expr.span);
        }
        fields
    }

    /// The value of a field, computed once.
    fn field_once(&mut self, id: ItemId, schema: &'static TypeSchema, given: &Given<'p>) -> Value {
        let key = (id, given.field.name);
        match self.fields.get(&key) {
            Some(Some(value)) => return value.clone(),
            Some(None) => {
                let name = format!("{}.{}", self.program.name(id), given.field.name);
                return self.self_reference(&name, given.span, None);
            }
            None => {}
        }
        self.fields.insert(key, None);
        let scope = Scope { module: given.module, local: None };
        let value = self.surely(|ev| {
            ev.nested(given.span, |ev| ev.field_value(schema, given.field, given.expr, scope))
        });
        self.fields.insert(key, Some(value.clone()));
        value
    }

    /// The value of `name.field` where an expression refers to it.
    pub(crate) fn referred_field(&mut self, id: ItemId, field: &'static Field, at: Span) -> Value {
        let Some(model) = self.models.get(&id) else { return Value::Poison };
        let schema = model.schema;
        let value = match self.givens(id).get(field.name) {
            Some(given) => self.field_once(id, schema, given),
            None if model.of_file.is_some() && is_said_by_files(schema.kind, field.name) => {
                return self.said_by_file(id, field, at);
            }
            None => Value::Default,
        };
        let value = match value {
            Value::Default => default_value(field).unwrap_or(Value::None),
            other => other,
        };
        match value {
            Value::None => {
                let name = self.program.name(id);
                let text = format!("`{name}` does not say its `{}`", field.name);
                let error = Diagnostic::error(Code("E0309"), text)
                    .at(at, "nothing to refer to")
                    .because(self.program.name_span(id), "declared here");
                self.fault(error)
            }
            Value::Integer(n) => Value::plain(f64::from(n)),
            other => other,
        }
    }

    /// Reports that an expression refers to what only a file says.
    fn said_by_file(&mut self, id: ItemId, field: &'static Field, at: Span) -> Value {
        let name = self.program.name(id);
        let text = format!("`{}` of `{name}` is not known here", field.name);
        let error = Diagnostic::error(Code("E0309"), text)
            .at(at, "its file says it, which is read later")
            .because(self.program.name_span(id), "declared here")
            .with_help(format!("set `{}` in `{name}`", field.name));
        self.fault(error)
    }

    /// Reports all required fields that are missing, in one message.
    pub(crate) fn check_missing(&mut self, id: ItemId, fields: &mut Fields) {
        let Some(decl) = self.program.decl(id) else { return };
        let missing: Vec<&Field> = fields.missing();
        if missing.is_empty() {
            return;
        }
        fields.ok = false;
        let names: Vec<String> = missing.iter().map(|field| field.name.to_owned()).collect();
        let name = &decl.name;
        let text = format!("`{}` is missing {}", name.text, quoted_list(&names));
        let mut error = Diagnostic::error(Code("E0207"), text)
            .at(name.span, format!("{} needs more", fields.schema.described()));
        for field in missing {
            error = error.with_note(format!("`{}`: {}", field.name, sentence(field.doc)));
        }
        let example = format!("for example: {}", fields.schema.example);
        self.fault(error.with_help(example));
    }

    /// Evaluates the arguments of `obj(...)`, `sphere(...)` and the like.
    pub(crate) fn call_fields(
        &mut self,
        schema: &'static TypeSchema,
        name: &Ident,
        args: &[Arg],
        scope: Scope<'_>,
    ) -> Fields {
        let mut fields = Fields::new(schema);
        let labels: BTreeSet<String> =
            args.iter().filter_map(|arg| arg.name.as_ref().map(|name| name.text.clone())).collect();
        let mut unknown = false;
        for (i, arg) in args.iter().enumerate() {
            let Some(field) = self.argument_field(schema, (i, arg), &labels) else {
                unknown = true;
                if !is_word(&arg.value) {
                    self.eval(&arg.value, scope);
                }
                continue;
            };
            if let Some(first) = fields.span(field.name) {
                let text = format!("`{}` is set twice", field.name);
                let error = Diagnostic::error(Code("E0204"), text)
                    .at(arg.value.span, "set again")
                    .because(first, "first set here");
                self.fault(error);
            }
            let value = self.field_value(schema, field, &arg.value, scope);
            let span = arg.name.as_ref().map_or(arg.value.span, |n| n.span.to(arg.value.span));
            fields.put(field, value, span, arg.value.span);
        }
        let missing = fields.missing();
        if !missing.is_empty() || unknown {
            fields.ok = false;
        }
        if !missing.is_empty() && !unknown {
            let error = missing_arguments(schema, name, args, &missing);
            self.fault(error);
        }
        fields
    }

    /// Which field an argument sets. Only the path of a file needs no name.
    fn argument_field(
        &mut self,
        schema: &'static TypeSchema,
        (i, arg): (usize, &Arg),
        labels: &BTreeSet<String>,
    ) -> Option<&'static Field> {
        let Some(label) = &arg.name else {
            let first = schema.fields.first()?;
            if i == 0 && matches!(first.ty, FieldType::Path) {
                return Some(first);
            }
            let free = schema
                .fields
                .iter()
                .find(|field| !labels.contains(field.name) && !matches!(field.ty, FieldType::Path));
            let text = format!("this argument of `{}` needs its name", schema.name);
            let mut error = Diagnostic::error(Code("E0306"), text).at(arg.value.span, "which one?");
            if let Some(field) = free {
                let message = format!("write `{}:`", field.name);
                let insertion = format!("{}: ", field.name);
                error = error.with_fix(Fix::guess(message, arg.value.span.before(), insertion));
            }
            self.fault(error);
            return None;
        };
        let found = schema.field(&label.text);
        if found.is_none() {
            self.unknown_field(schema, label, labels);
        }
        found
    }
}

/// May this be the word of a field that does not exist? Then it is no unknown name as well.
fn is_word(expr: &Expr) -> bool {
    matches!(&expr.kind, crate::syntax::ExprKind::Path(path) if path.segments.len() == 1)
}

fn missing_arguments(
    schema: &TypeSchema,
    name: &Ident,
    args: &[Arg],
    missing: &[&'static Field],
) -> Diagnostic {
    let unit = missing.iter().find(|field| matches!(field.ty, FieldType::LengthUnit));
    if let (Some(_), Some(first), 1) = (unit, args.first(), missing.len()) {
        return Diagnostic::error(Code("E0502"), "mesh file without a unit")
            .at(name.span, "one unit of this file is how long?")
            .with_note("scans and CAD files are often in `mm` or `cm`, exports from Blender in `m`")
            .with_fix(Fix::guess("state it", first.value.span.after(), ", unit: m"));
    }
    let names: Vec<String> = missing.iter().map(|field| field.name.to_owned()).collect();
    let text = format!("`{}(...)` is missing {}", schema.name, quoted_list(&names));
    let mut error = Diagnostic::error(Code("E0207"), text).at(name.span, "needs more");
    for field in missing {
        error = error.with_note(format!("`{}`: {}", field.name, sentence(field.doc)));
    }
    error.with_help(format!("for example: {}", schema.example))
}

/// Refractive index or extinction of a metal, as other renderers ask for them.
fn is_optical_constant(schema: &TypeSchema, name: &Ident) -> bool {
    schema.name == "conductor" && ["ior", "eta", "k", "n"].contains(&name.text.as_str())
}

/// Subsurface scattering, as other renderers ask for it.
fn is_subsurface(schema: &TypeSchema, name: &Ident) -> bool {
    let own = ["radius", "scattering_radius", "mfp", "sss"];
    let of_surface = ["principled", "dielectric", "diffuse"].contains(&schema.name);
    of_surface && (own.contains(&name.text.as_str()) || name.text.starts_with("subsurface"))
}

/// The fields whose names begin with `name` and a dot.
fn group(schema: &TypeSchema, name: &Ident) -> Vec<String> {
    let begins =
        |field: &str| field.strip_prefix(&name.text).is_some_and(|rest| rest.starts_with('.'));
    let names = schema.fields.iter().map(|field| field.name);
    names.filter(|field| begins(field)).map(str::to_owned).collect()
}

/// A field of another type of the same kind: says which. Else lists the fields there are.
fn other_owner(error: Diagnostic, schema: &TypeSchema, name: &Ident) -> Diagnostic {
    let others: Vec<String> = types_of(schema.kind)
        .iter()
        .filter(|other| other.field(&name.text).is_some())
        .map(|other| other.name.to_owned())
        .collect();
    let names: Vec<String> = schema.fields.iter().map(|field| field.name.to_owned()).collect();
    let error = match others.as_slice() {
        [] => error,
        _ => error.with_note(format!("`{}` is a field of {}", name.text, quoted_list(&others))),
    };
    error.with_note(format!("the fields are {}", quoted_list(&names)))
}

/// A sentence of the schema as part of a line: lower case, no full stop.
fn sentence(doc: &str) -> String {
    let doc = doc.trim_end_matches('.');
    let mut letters = doc.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}
