//! Film fields become pixels and stops.

use super::fields::Fields;
use crate::scene::{Film, Filter, Name, ToneMap};
use crate::schema;
use crate::source::Span;

/// Builds the film. `None` only for fields with faults.
pub(super) fn film(name: Name, fields: &Fields) -> Option<Film> {
    let size = fields.vector::<2>("size")?;
    #[expect(clippy::cast_possible_truncation, reason = "whole and at most MAX_FILM_SIDE")]
    let size = size.map(|pixels| pixels as u32);
    let filter = Filter::of(fields.word("filter")?)?;
    let filter_width = fields.number("filter.width").unwrap_or(match filter {
        Filter::Box => 1.0,
        Filter::Tent => 2.0,
        Filter::Gaussian | Filter::BlackmanHarris => 3.0,
    });
    let tone_map = ToneMap::of(fields.word("tone_map")?)?;
    Some(Film { name, size, filter, filter_width, exposure: fields.number("exposure")?, tone_map })
}

/// The film that is used when none is declared: every default of the schema.
pub(super) fn default_film(span: Span) -> Film {
    let schema = schema::find_type(schema::Kind::Film, "").expect("film has one schema");
    let fields = Fields::new(schema);
    let name = Name { text: "default".to_owned(), span };
    film(name, &fields).expect("every field of a film has a default")
}
