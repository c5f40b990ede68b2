//! Evaluated fields of one declaration or call, with their defaults.

use std::collections::BTreeMap;
use std::rc::Rc;

use crate::eval::value::{Key, Value};
use crate::resolve::{InFile, ItemId};
use crate::scene::{Axis, FileBase, MotionKey, Name, Rgb, at_time};
use crate::schema::{self, Default, Field, FieldType, Kind, TypeSchema};
use crate::shape::Lengths;
use crate::source::Span;
use crate::units::{self, Dim};

/// Evaluated fields. Only `ok` ones may be read: then every value is what its schema says.
#[derive(Clone, Debug)]
pub(crate) struct Fields {
    pub(crate) schema: &'static TypeSchema,
    values: BTreeMap<&'static str, Written>,
    /// Nothing is missing and nothing is poisoned.
    pub(crate) ok: bool,
    /// What of a mesh file it is like.
    pub(crate) of_file: Option<InFile>,
}

/// Whether a file says this of its materials or cameras, so that its default does not count for what is like one.
pub(crate) fn is_said_by_files(kind: Kind, field: &str) -> bool {
    match kind {
        Kind::Material => !["compensation", "projection"].contains(&field),
        Kind::Camera => {
            ["from", "to", "up", "lens", "fov.horizontal", "fov.vertical"].contains(&field)
        }
        _ => false,
    }
}

/// A field that is written in the text.
#[derive(Clone, Debug)]
struct Written {
    value: Value,
    span: Span,
    value_span: Span,
}

/// The default of a field as a value; `None` where there is none.
pub(crate) fn default_value(field: &Field) -> Option<Value> {
    let dim = schema::unit_of(field.ty).map_or(Dim::NONE, |(dim, _)| dim);
    Some(match field.default {
        Default::Required | Default::Absent(_) => return None,
        #[expect(clippy::cast_possible_truncation, reason = "defaults of integers are whole")]
        Default::Number(value)
            if matches!(field.ty, FieldType::Integer(..) | FieldType::IntegerOr(..)) =>
        {
            Value::Integer(value as u32)
        }
        Default::Number(value) if matches!(field.ty, FieldType::Scale) => {
            Value::Vector(vec![value; 3], Dim::NONE)
        }
        Default::Number(value) => Value::Number(value, dim),
        Default::Vector(values) => Value::Vector(values.to_vec(), dim),
        Default::Pixels(size) => Value::Vector(size.map(f64::from).to_vec(), Dim::PIXEL),
        Default::Color(rgb) => Value::Color(rgb),
        Default::Word(word) => match (field.ty, axis(word)) {
            (FieldType::Axis, Some(axis)) => Value::Axis(axis),
            (FieldType::LengthUnit, _) => {
                Value::Number(units::find(word).map_or(1.0, |unit| unit.factor), Dim::LENGTH)
            }
            _ => Value::Word(word),
        },
        Default::Interval(a, b) => Value::Range(a, b, dim),
    })
}

fn axis(word: &str) -> Option<Axis> {
    Some(match word {
        "+x" => Axis::PlusX,
        "-x" => Axis::MinusX,
        "+y" => Axis::PlusY,
        "-y" => Axis::MinusY,
        "+z" => Axis::PlusZ,
        "-z" => Axis::MinusZ,
        _ => return None,
    })
}

/// What keys say of a moment.
fn triple_at(keys: &[Key], time: f64) -> [f64; 3] {
    let key = |(time, at): &Key| MotionKey { time: *time, at: *at, rotate: [0.0; 3] };
    let keys: Vec<MotionKey> = keys.iter().map(key).collect();
    at_time(&keys, time).at
}

/// The moments of several lists of keys, each once, in order.
pub(super) fn moments<'a>(lists: impl IntoIterator<Item = &'a [Key]>) -> Vec<f64> {
    let mut times: Vec<f64> = lists.into_iter().flatten().map(|(time, _)| *time + 0.0).collect();
    times.sort_by(f64::total_cmp);
    times.dedup_by(|a, b| a.total_cmp(b).is_eq());
    times
}

impl Fields {
    /// Nothing written: every field has its default, where it has one.
    pub(crate) fn new(schema: &'static TypeSchema) -> Self {
        Self { schema, values: BTreeMap::new(), ok: true, of_file: None }
    }

    /// The same, with a default for everything that a file says.
    pub(crate) fn without_file(&self) -> Self {
        Self { of_file: None, ..self.clone() }
    }

    /// What it takes from a file, if anything.
    pub(crate) fn file_base(&self, asset: &dyn Fn(ItemId) -> usize) -> Option<FileBase> {
        let base = self.of_file.as_ref()?;
        let said = self.values.iter().map(|(name, written)| (*name, written.span)).collect();
        let name = Name { text: base.name.clone(), span: base.span };
        Some(FileBase { asset: asset(base.asset), name, said })
    }

    /// Whether the file that it is like something of says this field.
    fn is_in_file(&self, name: &str) -> bool {
        self.of_file.is_some() && is_said_by_files(self.schema.kind, name)
    }

    /// Sets a field. `span` is the whole assignment.
    pub(super) fn put(
        &mut self,
        field: &'static Field,
        value: Value,
        span: Span,
        value_span: Span,
    ) {
        if value == Value::Poison {
            self.ok = false;
        }
        self.values.insert(field.name, Written { value, span, value_span });
    }

    /// Required fields that are not written.
    pub(super) fn missing(&self) -> Vec<&'static Field> {
        let absent = |field: &&Field| match self.values.get(field.name) {
            None => true,
            Some(written) => matches!(written.value, Value::Default),
        };
        // A camera that frames something finds its place itself.
        let found = |field: &&Field| {
            let by_file = self.is_in_file(field.name) && self.span(field.name).is_none();
            by_file || self.has("fit") && ["from", "to"].contains(&field.name)
        };
        let required = self.schema.fields.iter().filter(|field| field.is_required());
        required.filter(absent).filter(|field| !found(field)).collect()
    }

    /// Is the field written, with something else than `none` or `default`?
    pub(crate) fn has(&self, name: &str) -> bool {
        let written = self.values.get(name).map(|written| &written.value);
        written.is_some_and(|value| !matches!(value, Value::None | Value::Default))
    }

    /// The assignment, if it is written.
    pub(crate) fn span(&self, name: &str) -> Option<Span> {
        self.values.get(name).map(|written| written.span)
    }

    /// The assigned expression, if it is written.
    pub(crate) fn value_span(&self, name: &str) -> Option<Span> {
        self.values.get(name).map(|written| written.value_span)
    }

    /// Is it written as `none`?
    pub(crate) fn is_none(&self, name: &str) -> bool {
        self.values.get(name).is_some_and(|written| written.value == Value::None)
    }

    /// The value or its default; `None` where there is neither, or where a file says it.
    pub(crate) fn get(&self, name: &str) -> Option<Value> {
        let written = self.values.get(name).map(|written| written.value.clone());
        match written {
            None if self.is_in_file(name) => None,
            Some(Value::Default) | None => self.schema.field(name).and_then(default_value),
            Some(Value::None) => None,
            other => other,
        }
    }

    /// A number in SI.
    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        match self.get(name) {
            Some(Value::Number(value, _)) => Some(value),
            _ => None,
        }
    }

    /// A number in SI with its dimension.
    pub(crate) fn quantity(&self, name: &str) -> Option<(f64, Dim)> {
        match self.get(name) {
            Some(Value::Number(value, dim)) => Some((value, dim)),
            _ => None,
        }
    }

    /// A whole number.
    pub(crate) fn integer(&self, name: &str) -> Option<u32> {
        match self.get(name) {
            Some(Value::Integer(value)) => Some(value),
            _ => None,
        }
    }

    /// Both ends of an interval in SI.
    pub(crate) fn interval(&self, name: &str) -> Option<[f64; 2]> {
        match self.get(name) {
            Some(Value::Range(low, high, _)) => Some([low, high]),
            _ => None,
        }
    }

    /// Some numbers in SI; of keys those of the moment 0.
    pub(crate) fn vector<const N: usize>(&self, name: &str) -> Option<[f64; N]> {
        match self.get(name) {
            Some(Value::Vector(values, _)) => values.try_into().ok(),
            Some(Value::Keys(keys, _)) => triple_at(&keys, 0.0).to_vec().try_into().ok(),
            _ => None,
        }
    }

    /// The keys of a field that has some: times and numbers in SI.
    pub(crate) fn keys(&self, name: &str) -> Option<Rc<[Key]>> {
        match self.get(name) {
            Some(Value::Keys(keys, _)) => Some(keys),
            _ => None,
        }
    }

    /// Some numbers in SI, at some moment.
    pub(crate) fn triple_at(&self, name: &str, time: f64) -> Option<[f64; 3]> {
        self.keys(name).map_or_else(|| self.vector(name), |keys| Some(triple_at(&keys, time)))
    }

    /// The numbers of every field that has some, in SI.
    pub(crate) fn lengths(&self) -> Lengths {
        let numbers = |field: &Field| match self.get(field.name)? {
            Value::Number(value, _) => Some((field.name, vec![value])),
            Value::Vector(values, _) => Some((field.name, values)),
            Value::List(items) => {
                let numbers = |(item, _): &(Value, Span)| match item {
                    Value::Vector(values, _) => values.clone(),
                    _ => Vec::new(),
                };
                Some((field.name, items.iter().flat_map(numbers).collect()))
            }
            _ => None,
        };
        self.schema.fields.iter().filter_map(numbers).collect()
    }

    /// Where the entry of a list stands.
    pub(crate) fn place_in(&self, name: &str, entry: usize) -> Option<Span> {
        let Some(Value::List(items)) = self.get(name) else { return None };
        items.get(entry).map(|(_, span)| *span)
    }

    /// A constant colour.
    pub(crate) fn color(&self, name: &str) -> Option<Rgb> {
        match self.get(name) {
            Some(Value::Color(rgb)) => Some(rgb),
            _ => None,
        }
    }

    /// A word.
    pub(crate) fn word(&self, name: &str) -> Option<&'static str> {
        match self.get(name) {
            Some(Value::Word(word)) => Some(word),
            _ => None,
        }
    }

    /// Words of a list, or one alone.
    pub(crate) fn words(&self, name: &str) -> Vec<&'static str> {
        match self.get(name) {
            Some(Value::Word(word)) => vec![word],
            Some(Value::List(values)) => {
                let word = |(value, _): &(Value, Span)| match value {
                    Value::Word(word) => Some(*word),
                    _ => None,
                };
                values.iter().filter_map(word).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Named declarations of a list, each with the place of its name.
    pub(crate) fn items(&self, name: &str) -> Vec<(ItemId, Span)> {
        let Some(Value::List(values)) = self.get(name) else { return Vec::new() };
        let item = |(value, span): &(Value, Span)| match value {
            Value::Item(_, id) => Some((*id, *span)),
            _ => None,
        };
        values.iter().filter_map(item).collect()
    }

    /// A text in quotes.
    pub(crate) fn text(&self, name: &str) -> Option<String> {
        match self.get(name) {
            Some(Value::Text(text)) => Some(text.to_string()),
            _ => None,
        }
    }

    /// A named declaration.
    pub(crate) fn item(&self, name: &str) -> Option<ItemId> {
        match self.get(name) {
            Some(Value::Item(_, id)) => Some(id),
            _ => None,
        }
    }
}
