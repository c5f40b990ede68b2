//! Film fields become pixels and stops.

use super::brightness::EFFICACY;
use super::exclusive::one_of;
use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::scene::{Film, Filter, Name, ToneMap};
use crate::schema;
use crate::schema::film::EXPOSURE;
use crate::source::Span;
use crate::units::{self, Dim};

/// Calibration constant of meters that read reflected light, cd s / m2: K of ISO 2720:1974, which leaves 10.6 to 13.4 to
/// makers; 12.5 is that of Canon, Nikon and Sekonic.
const METER: f64 = 12.5;

/// What a film shows of what was metered: the reflectance of a grey card.
const MIDDLE_GREY: f64 = 0.18;

/// Checks how the fields of a film go together.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    for name in ["f_number", "shutter", "iso"] {
        one_of(ev, fields, &["exposure", name], "the exposure");
    }
    for (name, needs, example) in [
        ("f_number", "shutter", "shutter = 8ms"),
        ("shutter", "f_number", "f_number = 8"),
        ("iso", "f_number", "f_number = 8"),
    ] {
        let Some(span) = fields.span(name) else { continue };
        if fields.has(name) && !fields.has(needs) && !fields.has("exposure") {
            let text = format!("`{name}` does nothing without `{needs}`");
            let error = Diagnostic::error(Code("E0207"), text)
                .at(span, "an exposure needs both")
                .with_help(format!("write `{example}`, or leave this out"));
            ev.fault(error);
        }
    }
    check_metered(ev, fields);
}

/// Reports values of a camera that go beyond what `exposure` may be.
fn check_metered(ev: &mut Evaluator<'_>, fields: &Fields) {
    let (Some(stops), Some(span)) = (metered(fields), fields.span("shutter")) else { return };
    let range = EXPOSURE.described();
    if !EXPOSURE.contains(stops) {
        let stops = units::show((stops * 100.0).round() / 100.0, Dim::EV);
        let text = format!("the exposure must be {range}, found {stops}");
        let error = Diagnostic::error(Code("E0401"), text).at(span, "with this time");
        ev.fault(error.with_note(format!("`exposure` = {stops} is what these values come to")));
    }
}

/// Stops at which what a meter reads for the settings of a camera becomes middle grey; `None` where there are none. A
/// meter reads the luminance K N^2 / (t S) in nit; a radiance of 1 W/(m2 sr) is 683 nit.
fn metered(fields: &Fields) -> Option<f64> {
    let number = |name| fields.number(name);
    let (f_number, shutter, iso) = (number("f_number")?, number("shutter")?, number("iso")?);
    let luminance = METER * f_number * f_number / (shutter * iso);
    Some(libm::log2(MIDDLE_GREY * EFFICACY / luminance))
}

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
    let exposure = metered(fields).or_else(|| fields.number("exposure"))?;
    Some(Film { name, size, filter, filter_width, exposure, tone_map })
}

/// The film that is used when none is declared: every default of the schema.
pub(super) fn default_film(span: Span) -> Film {
    let schema = schema::find_type(schema::Kind::Film, "").expect("film has one schema");
    let fields = Fields::new(schema);
    let name = Name { text: "default".to_owned(), span };
    film(name, &fields).expect("every field of a film has a default")
}
