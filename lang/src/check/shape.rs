//! Shape calls become geometry: `sphere(radius: 14cm)`.

use std::rc::Rc;

use crate::eval::value::{ShapeValue, Value};
use crate::eval::{Evaluator, Scope};
use crate::schema::TypeSchema;
use crate::schema::shape::ShapeType;
use crate::syntax::{Arg, Ident};

impl Evaluator<'_> {
    /// Evaluates a call of the shape that `schema` describes.
    pub(crate) fn shape_call(
        &mut self,
        schema: &'static TypeSchema,
        name: &Ident,
        args: &[Arg],
        scope: Scope<'_>,
    ) -> Value {
        let fields = self.call_fields(schema, name, args, scope);
        if !fields.ok {
            return Value::Poison;
        }
        let shape = match ShapeType::of(schema) {
            ShapeType::Sphere => fields.number("radius").map(ShapeValue::Sphere),
            ShapeType::Rectangle => fields.vector("size").map(ShapeValue::Rectangle),
            ShapeType::Box => fields.vector("size").map(ShapeValue::Box),
        };
        shape.map_or(Value::Poison, |shape| Value::Shape(Rc::new(shape)))
    }
}
