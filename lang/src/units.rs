//! Units and dimensions: the text after a number becomes an exponent vector and a factor to SI.
//!
//! A dimension is a vector of small integer exponents over length, angle, time, temperature, pixel,
//! EV, power and luminous flux. A steradian is a square radian. A plain number and a ratio have all exponents zero; `%` is the factor 0.01. This module
//! does not know values or the syntax tree.

use std::fmt;

/// Number of base dimensions.
const N_BASE: usize = 8;

/// Largest exponent that arithmetic may reach; far above anything a scene needs.
const MAX_EXPONENT: i8 = 12;

/// Exponents over (length, angle, time, temperature, pixel, EV, power, luminous flux).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Dim([i8; N_BASE]);

impl Dim {
    /// A plain number, count or ratio.
    pub const NONE: Self = Self([0; N_BASE]);
    /// Metres.
    pub const LENGTH: Self = Self([1, 0, 0, 0, 0, 0, 0, 0]);
    /// Per metre: extinction and its parts.
    pub const PER_LENGTH: Self = Self([-1, 0, 0, 0, 0, 0, 0, 0]);
    /// Radians.
    pub const ANGLE: Self = Self([0, 1, 0, 0, 0, 0, 0, 0]);
    /// Seconds.
    pub const TIME: Self = Self([0, 0, 1, 0, 0, 0, 0, 0]);
    /// Kelvins.
    pub const TEMPERATURE: Self = Self([0, 0, 0, 1, 0, 0, 0, 0]);
    /// Pixels.
    pub const PIXEL: Self = Self([0, 0, 0, 0, 1, 0, 0, 0]);
    /// Metres per second.
    pub const VELOCITY: Self = Self([1, 0, -1, 0, 0, 0, 0, 0]);
    /// Photographic stops.
    pub const EV: Self = Self([0, 0, 0, 0, 0, 1, 0, 0]);
    /// Watts: radiant flux.
    pub const POWER: Self = Self([0, 0, 0, 0, 0, 0, 1, 0]);
    /// Watts per steradian.
    pub const INTENSITY: Self = Self([0, -2, 0, 0, 0, 0, 1, 0]);
    /// Watts per square metre.
    pub const IRRADIANCE: Self = Self([-2, 0, 0, 0, 0, 0, 1, 0]);
    /// Watts per square metre and steradian.
    pub const RADIANCE: Self = Self([-2, -2, 0, 0, 0, 0, 1, 0]);
    /// Lumens.
    pub const LUMINOUS_FLUX: Self = Self([0, 0, 0, 0, 0, 0, 0, 1]);
    /// Candelas: lumens per steradian.
    pub const LUMINOUS_INTENSITY: Self = Self([0, -2, 0, 0, 0, 0, 0, 1]);
    /// Lux: lumens per square metre.
    pub const ILLUMINANCE: Self = Self([-2, 0, 0, 0, 0, 0, 0, 1]);
    /// Candelas per square metre.
    pub const LUMINANCE: Self = Self([-2, -2, 0, 0, 0, 0, 0, 1]);

    /// The dimension of a product; `None` if an exponent leaves ±12.
    #[must_use]
    pub fn times(self, other: Self) -> Option<Self> {
        self.zip(other, i8::checked_add)
    }

    /// The dimension of a quotient; `None` if an exponent leaves ±12.
    #[must_use]
    pub fn per(self, other: Self) -> Option<Self> {
        self.zip(other, i8::checked_sub)
    }

    /// The dimension of an integer power; `None` if an exponent leaves ±12.
    #[must_use]
    pub fn power(self, n: i8) -> Option<Self> {
        self.zip(self, |a, _| a.checked_mul(n))
    }

    /// The dimension of a square root; `None` if an exponent is odd.
    #[must_use]
    pub fn sqrt(self) -> Option<Self> {
        self.zip(self, |a, _| (a % 2 == 0).then_some(a / 2))
    }

    /// Has no unit.
    #[must_use]
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// A count of values: `three lengths`, `two plain numbers`, `three values in m/s`.
    #[must_use]
    pub fn several(self, n: usize) -> String {
        let count = match n {
            2 => "two".to_owned(),
            3 => "three".to_owned(),
            4 => "four".to_owned(),
            n => n.to_string(),
        };
        let noun = match self {
            Self::NONE => "plain numbers",
            Self::LENGTH => "lengths",
            Self::PER_LENGTH => "numbers per length",
            Self::ANGLE => "angles",
            Self::TIME => "times",
            Self::TEMPERATURE => "temperatures",
            Self::PIXEL => "numbers of pixels",
            Self::EV => "exposures",
            Self::POWER => "powers",
            Self::LUMINOUS_FLUX => "luminous fluxes",
            _ => return format!("{count} values in {}", self.si_unit()),
        };
        format!("{count} {noun}")
    }

    fn zip(self, other: Self, f: impl Fn(i8, i8) -> Option<i8>) -> Option<Self> {
        let mut out = [0; N_BASE];
        for ((o, a), b) in out.iter_mut().zip(self.0).zip(other.0) {
            *o = f(a, b).filter(|e| (-MAX_EXPONENT..=MAX_EXPONENT).contains(e))?;
        }
        Some(Self(out))
    }

    /// The name a `param` declaration uses, such as `length`; see [`PARAM_DIMENSIONS`].
    #[must_use]
    pub fn from_param_name(name: &str) -> Option<Self> {
        PARAM_DIMENSIONS.iter().find(|(n, _)| *n == name).map(|(_, dim)| *dim)
    }

    /// The SI unit in which values of this dimension are kept, in `.rts` spelling where one exists.
    #[must_use]
    pub fn si_unit(self) -> String {
        let symbols = ["m", "rad", "s", "K", "px", "EV", "W", "lm"];
        let part = |sign: i8| {
            symbols
                .iter()
                .zip(self.0)
                .filter(|(_, e)| e.signum() == sign)
                .map(|(s, e)| {
                    let n = e.unsigned_abs();
                    if n == 1 { (*s).to_owned() } else { format!("{s}{n}") }
                })
                .collect::<Vec<_>>()
                .join(" ")
        };
        let (above, below) = (part(1), part(-1));
        if below.is_empty() { above } else { format!("{above}/{below}") }
    }
}

/// Dimension names that may follow `param name:`.
pub const PARAM_DIMENSIONS: &[(&str, Dim)] = &[
    ("length", Dim::LENGTH),
    ("angle", Dim::ANGLE),
    ("time", Dim::TIME),
    ("temperature", Dim::TEMPERATURE),
    ("pixel", Dim::PIXEL),
    ("exposure", Dim::EV),
    ("power", Dim::POWER),
    ("luminous_flux", Dim::LUMINOUS_FLUX),
    ("number", Dim::NONE),
    ("ratio", Dim::NONE),
    ("count", Dim::NONE),
];

/// With article, as it stands in a message: `a length`, `a plain number`, `length/time`.
impl fmt::Display for Dim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = match *self {
            Self::NONE => "a plain number",
            Self::LENGTH => "a length",
            Self::PER_LENGTH => "a number per length",
            Self::ANGLE => "an angle",
            Self::TIME => "a time",
            Self::TEMPERATURE => "a temperature",
            Self::PIXEL => "a number of pixels",
            Self::EV => "an exposure",
            Self::POWER => "a power",
            Self::INTENSITY => "an intensity",
            Self::IRRADIANCE => "an irradiance",
            Self::RADIANCE => "a radiance",
            Self::LUMINOUS_FLUX => "a luminous flux",
            Self::LUMINOUS_INTENSITY => "a luminous intensity",
            Self::ILLUMINANCE => "an illuminance",
            Self::LUMINANCE => "a luminance",
            _ => "",
        };
        if !known.is_empty() {
            return f.write_str(known);
        }
        match (self.0[0], self.0[1..].iter().all(|e| *e == 0)) {
            (2, true) => return f.write_str("an area"),
            (3, true) => return f.write_str("a volume"),
            (-1, true) => return f.write_str("a number per length"),
            _ => {}
        }
        write!(f, "a value in {}", self.si_unit())
    }
}

/// One atom that may stand after a number.
#[derive(Clone, Copy, Debug)]
pub struct Unit {
    /// As written in the text.
    pub symbol: &'static str,
    /// Its dimension.
    pub dim: Dim,
    /// SI value of one.
    pub factor: f64,
    /// Long name, for the reference.
    pub doc: &'static str,
}

const fn unit(symbol: &'static str, dim: Dim, factor: f64, doc: &'static str) -> Unit {
    Unit { symbol, dim, factor, doc }
}

/// Every unit of the language.
pub const UNITS: &[Unit] = &[
    unit("nm", Dim::LENGTH, 1e-9, "nanometre"),
    unit("um", Dim::LENGTH, 1e-6, "micrometre"),
    unit("mm", Dim::LENGTH, 1e-3, "millimetre"),
    unit("cm", Dim::LENGTH, 1e-2, "centimetre"),
    unit("m", Dim::LENGTH, 1.0, "metre"),
    unit("km", Dim::LENGTH, 1e3, "kilometre"),
    unit("deg", Dim::ANGLE, std::f64::consts::PI / 180.0, "degree"),
    unit("rad", Dim::ANGLE, 1.0, "radian"),
    unit("turn", Dim::ANGLE, std::f64::consts::TAU, "full turn"),
    unit("ms", Dim::TIME, 1e-3, "millisecond"),
    unit("s", Dim::TIME, 1.0, "second"),
    unit("min", Dim::TIME, 60.0, "minute"),
    unit("h", Dim::TIME, 3600.0, "hour"),
    unit("K", Dim::TEMPERATURE, 1.0, "kelvin"),
    unit("px", Dim::PIXEL, 1.0, "pixel"),
    unit("EV", Dim::EV, 1.0, "photographic stop, a factor of two"),
    unit("sr", Dim([0, 2, 0, 0, 0, 0, 0, 0]), 1.0, "steradian"),
    unit("mW", Dim::POWER, 1e-3, "milliwatt"),
    unit("W", Dim::POWER, 1.0, "watt"),
    unit("kW", Dim::POWER, 1e3, "kilowatt"),
    unit("lm", Dim::LUMINOUS_FLUX, 1.0, "lumen"),
    unit("klm", Dim::LUMINOUS_FLUX, 1e3, "kilolumen"),
    unit("cd", Dim::LUMINOUS_INTENSITY, 1.0, "candela, a lumen per steradian"),
    unit("kcd", Dim::LUMINOUS_INTENSITY, 1e3, "kilocandela"),
    unit("lx", Dim::ILLUMINANCE, 1.0, "lux, a lumen per square metre"),
    unit("klx", Dim::ILLUMINANCE, 1e3, "kilolux"),
    unit("nit", Dim::LUMINANCE, 1.0, "candela per square metre"),
    unit("%", Dim::NONE, 0.01, "percent"),
];

/// Spellings people know from elsewhere, and the unit of the language they most likely mean.
const OTHER_SPELLINGS: &[(&str, &str)] = &[
    ("meter", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("metres", "m"),
    ("mtr", "m"),
    ("centimeter", "cm"),
    ("centimeters", "cm"),
    ("centimetre", "cm"),
    ("centimetres", "cm"),
    ("millimeter", "mm"),
    ("millimeters", "mm"),
    ("millimetre", "mm"),
    ("millimetres", "mm"),
    ("kilometer", "km"),
    ("kilometre", "km"),
    ("micron", "um"),
    ("microns", "um"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("turns", "turn"),
    ("rev", "turn"),
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("msec", "ms"),
    ("minute", "min"),
    ("minutes", "min"),
    ("hour", "h"),
    ("hours", "h"),
    ("hr", "h"),
    ("kelvin", "K"),
    ("Kelvin", "K"),
    ("pixel", "px"),
    ("pixels", "px"),
    ("stop", "EV"),
    ("stops", "EV"),
    ("watt", "W"),
    ("watts", "W"),
    ("lumen", "lm"),
    ("lumens", "lm"),
    ("candela", "cd"),
    ("candelas", "cd"),
    ("lux", "lx"),
    ("nits", "nit"),
    ("steradian", "sr"),
    ("steradians", "sr"),
];

/// Units of lengths that the language leaves out on purpose, with the exact length.
const NOT_METRIC: &[(&str, &str)] = &[
    ("in", "25.4mm"),
    ("inch", "25.4mm"),
    ("ft", "304.8mm"),
    ("foot", "304.8mm"),
    ("feet", "304.8mm"),
    ("yd", "914.4mm"),
    ("mi", "1.609344km"),
    ("mile", "1.609344km"),
];

/// Looks up one unit symbol.
#[must_use]
pub fn find(symbol: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|u| u.symbol == symbol)
}

/// The unit of a dimension that needs no factor, where it has a symbol.
#[must_use]
#[expect(clippy::float_cmp, reason = "factors of SI units are exactly 1")]
pub fn si_symbol(dim: Dim) -> Option<&'static str> {
    UNITS.iter().find(|unit| unit.dim == dim && unit.factor == 1.0).map(|unit| unit.symbol)
}

/// Reads the whole text after a number: `mm`, `%`, `/m`, `m/s`, `m2`, `W/m2/sr`.
///
/// Returns the dimension and the factor to SI.
///
/// # Errors
/// The atom that is not a unit.
pub fn parse(text: &str) -> Result<(Dim, f64), &str> {
    let mut atoms = text.split('/');
    let above = atoms.next().unwrap_or_default();
    let (mut dim, mut factor) = (Dim::NONE, 1.0);
    if !above.is_empty() {
        (dim, factor) = parse_atom(above)?;
    } else if !text.starts_with('/') {
        return Err(text);
    }
    for below in atoms {
        let (d, f) = parse_atom(below)?;
        dim = dim.per(d).ok_or(below)?;
        factor /= f;
    }
    Ok((dim, factor))
}

/// One atom with an optional one-digit power.
fn parse_atom(text: &str) -> Result<(Dim, f64), &str> {
    if let Some(unit) = find(text) {
        return Ok((unit.dim, unit.factor));
    }
    let mut letters = text.chars();
    let power = letters.next_back().and_then(|c| c.to_digit(10));
    let (Some(power @ 1..=9), Some(unit)) = (power, find(letters.as_str())) else {
        return Err(text);
    };
    if unit.symbol == "%" {
        return Err(text);
    }
    let exponent = i8::try_from(power).expect("a digit fits");
    let dim = unit.dim.power(exponent).ok_or(text)?;
    let factor = (0..power).fold(1.0, |f, _| f * unit.factor);
    Ok((dim, factor))
}

/// The unit that `atom` is another spelling of, if it is a well-known one.
#[must_use]
pub fn other_spelling(atom: &str) -> Option<&'static str> {
    let exact = OTHER_SPELLINGS.iter().find(|(from, _)| *from == atom).map(|(_, to)| *to);
    let case = || UNITS.iter().find(|u| u.symbol.eq_ignore_ascii_case(atom)).map(|u| u.symbol);
    exact.or_else(case)
}

/// For a unit of length that is left out on purpose: how long one is, in the language's units.
#[must_use]
pub fn not_metric(atom: &str) -> Option<&'static str> {
    NOT_METRIC.iter().find(|(from, _)| *from == atom).map(|(_, to)| *to)
}

/// Prints a plain number so that it reads back exactly, in `.rts` spelling.
#[must_use]
pub fn show_number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if (1e-5..1e15).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Prints an SI value in the unit that gives the shortest text which reads back exactly: `0.0032`
/// metres as `3.2mm`.
#[must_use]
pub fn show(value: f64, dim: Dim) -> String {
    let candidates: &[&str] = match dim {
        Dim::LENGTH => &["m", "cm", "mm", "um", "nm", "km"],
        Dim::ANGLE => &["deg", "rad", "turn"],
        Dim::TIME => &["s", "ms", "min", "h"],
        Dim::TEMPERATURE => &["K"],
        Dim::PIXEL => &["px"],
        Dim::EV => &["EV"],
        Dim::POWER => &["W", "mW", "kW"],
        Dim::LUMINOUS_FLUX => &["lm", "klm"],
        Dim::LUMINOUS_INTENSITY => &["cd", "kcd"],
        Dim::ILLUMINANCE => &["lx", "klx"],
        Dim::LUMINANCE => &["nit"],
        Dim::NONE => return show_number(value),
        _ => return format!("{}{}", show_number(value), dim.si_unit()),
    };
    candidates
        .iter()
        .filter_map(|symbol| find(symbol).and_then(|unit| show_in(value, unit)))
        .min_by_key(String::len)
        .unwrap_or_else(|| show_number(value))
}

/// Prints an SI value in one unit; `None` if no decimal of that unit reads back as this value.
#[must_use]
#[expect(clippy::float_cmp, reason = "it must read back exactly")]
pub fn show_in(value: f64, unit: &Unit) -> Option<String> {
    let scaled = value / unit.factor;
    // Division rounds: 0.05 / 0.001 is 50.00000000000001. Fifteen digits are what it can be sure of.
    let rounded = format!("{scaled:.14e}").parse::<f64>().unwrap_or(scaled);
    let text = [rounded, scaled].into_iter().find(|s| s * unit.factor == value)?;
    Some(format!("{}{}", show_number(text), unit.symbol))
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "units are exact")]
mod tests {
    use super::*;

    #[test]
    fn compound_units_multiply_exponents_and_factors() {
        let speed = Dim::LENGTH.per(Dim::TIME).unwrap();
        assert_eq!(parse("m/s"), Ok((speed, 1.0)));
        assert_eq!(parse("/m"), Ok((Dim::NONE.per(Dim::LENGTH).unwrap(), 1.0)));
        assert_eq!(parse("km/h").unwrap(), (speed, 1e3 / 3600.0));
        assert_eq!(parse("m2").unwrap().0, Dim::LENGTH.power(2).unwrap());
        assert_eq!(parse("%"), Ok((Dim::NONE, 0.01)));
        assert_eq!(parse("W/m2/sr"), Ok((Dim::RADIANCE, 1.0)));
        assert_eq!(parse("kW/m2"), Ok((Dim::IRRADIANCE, 1e3)));
        assert_eq!(parse("lm/sr").unwrap(), parse("cd").unwrap());
        assert_eq!(parse("cd/m2").unwrap(), parse("nit").unwrap());
        assert_eq!(parse("lm/m2").unwrap(), parse("lx").unwrap());
    }

    #[test]
    fn unknown_atoms_are_named() {
        assert_eq!(parse("mtr"), Err("mtr"));
        assert_eq!(parse("m/sec"), Err("sec"));
        assert_eq!(parse("%2"), Err("%2"));
        assert_eq!(parse("m0"), Err("m0"));
        assert_eq!(parse(""), Err(""));
        assert_eq!(other_spelling("degrees"), Some("deg"));
        assert_eq!(other_spelling("KM"), Some("km"));
    }

    #[test]
    fn exponents_stay_bounded() {
        let mut dim = Dim::LENGTH;
        let mut steps = 0;
        while let Some(next) = dim.times(Dim::LENGTH) {
            dim = next;
            steps += 1;
            assert!(steps < 100);
        }
        assert_eq!(Dim::LENGTH.sqrt(), None);
        assert_eq!(Dim::LENGTH.power(2).unwrap().sqrt(), Some(Dim::LENGTH));
    }

    #[test]
    fn shown_values_read_back_exactly() {
        let lengths = [0.0032, 0.05, 0.036, 1.0, 1234.5, 1e-9, 0.1 + 0.2, 400.0 * 0.0046, -0.007];
        for value in lengths {
            let text = show(value, Dim::LENGTH);
            let unit = text.trim_start_matches(|c: char| !c.is_ascii_alphabetic() || c == 'e');
            let number: f64 = text[..text.len() - unit.len()].parse().unwrap();
            assert_eq!(number * parse(unit).unwrap().1, value, "{text}");
        }
        assert_eq!(show(0.0032, Dim::LENGTH), "3.2mm");
        assert_eq!(show(50e-3, Dim::LENGTH), "5cm");
        assert_eq!(show(0.5 * std::f64::consts::PI, Dim::ANGLE), "90deg");
    }

    #[test]
    fn dimensions_have_names_for_messages() {
        assert_eq!(Dim::LENGTH.to_string(), "a length");
        assert_eq!(Dim::LENGTH.per(Dim::TIME).unwrap().to_string(), "a value in m/s");
        assert_eq!(Dim::LENGTH.power(2).unwrap().to_string(), "an area");
    }
}
