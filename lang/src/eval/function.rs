//! The functions of the language, as a table: name, arguments, sentence, body.
//!
//! Every transcendental function comes from `libm`, so that a scene means the same numbers on every
//! machine.

use super::value::Value;
use super::{color, textured};
use crate::texture::{TextureExpression, TexturePattern};
use crate::units::Dim;
use std::rc::Rc;

/// What an argument must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Want {
    /// A number of this dimension.
    Number(Dim),
    /// A number of any dimension.
    AnyNumber,
    /// A number of the dimension of the first argument.
    LikeFirst,
    /// A triple of any dimension.
    Vector,
    /// A triple of the dimension of the first argument.
    VectorLikeFirst,
    /// A colour given as numbers or as `#rrggbb`.
    ColorParts,
    /// A number, a tuple or a colour; the same as the first argument.
    Blend,
    /// A plain number, or a number of textures.
    Share,
    /// A number of any dimension, or a number of textures.
    Measure,
}

/// A function.
#[derive(Debug)]
pub(crate) struct Function {
    pub(crate) name: &'static str,
    /// Names of its arguments, and what they must be.
    pub(crate) params: &'static [(&'static str, Want)],
    /// The last argument may be repeated.
    pub(crate) more: bool,
    /// The arguments after the first may be left out together.
    pub(crate) one_or_all: bool,
    pub(crate) doc: &'static str,
    pub(crate) run: fn(&[Value]) -> Outcome,
}

impl Function {
    /// `clamp(x, low, high)`.
    pub(crate) fn signature(&self) -> String {
        let names: Vec<&str> = self.params.iter().map(|(name, _)| *name).collect();
        let more = if self.more { ", ..." } else { "" };
        format!("{}({}{more})", self.name, names.join(", "))
    }
}

const PLAIN: Want = Want::Number(Dim::NONE);
const ANGLE: Want = Want::Number(Dim::ANGLE);

const fn function(
    name: &'static str,
    params: &'static [(&'static str, Want)],
    doc: &'static str,
    run: fn(&[Value]) -> Outcome,
) -> Function {
    Function { name, params, more: false, one_or_all: false, doc, run }
}

const fn variadic(mut function: Function) -> Function {
    function.more = true;
    function
}

const fn one_or_all(mut function: Function) -> Function {
    function.one_or_all = true;
    function
}

/// Every function, in the order of the reference.
pub(crate) const FUNCTIONS: &[Function] = &[
    one_or_all(function(
        "srgb",
        &[("r", Want::ColorParts), ("g", PLAIN), ("b", PLAIN)],
        "A colour as picked from a screen: `srgb(#c79a6b)`, or three numbers between 0 and 1.",
        srgb,
    )),
    one_or_all(function(
        "linear",
        &[("r", Want::ColorParts), ("g", PLAIN), ("b", PLAIN)],
        "A linear Rec. 709 colour: one number for grey, or three.",
        linear,
    )),
    function(
        "blackbody",
        &[("temperature", Want::Number(Dim::TEMPERATURE))],
        "The colour of a glowing body between 500K and 100000K, with luminance 1.",
        blackbody,
    ),
    function("sin", &[("angle", ANGLE)], "Sine.", |a| Ok(plain(libm::sin(num(a, 0))))),
    function("cos", &[("angle", ANGLE)], "Cosine.", |a| Ok(plain(libm::cos(num(a, 0))))),
    function("tan", &[("angle", ANGLE)], "Tangent.", |a| Ok(plain(libm::tan(num(a, 0))))),
    function("asin", &[("x", PLAIN)], "The angle with this sine.", |a| {
        inverse(num(a, 0), libm::asin)
    }),
    function("acos", &[("x", PLAIN)], "The angle with this cosine.", |a| {
        inverse(num(a, 0), libm::acos)
    }),
    function("atan", &[("x", PLAIN)], "The angle with this tangent.", |a| {
        Ok(angle(libm::atan(num(a, 0))))
    }),
    function(
        "atan2",
        &[("y", Want::AnyNumber), ("x", Want::LikeFirst)],
        "The angle of the point (x, y) from the x axis.",
        |a| Ok(angle(libm::atan2(num(a, 0), num(a, 1)))),
    ),
    function("exp", &[("x", PLAIN)], "e to the power x.", |a| Ok(plain(libm::exp(num(a, 0))))),
    function("log", &[("x", PLAIN)], "Natural logarithm.", |a| match num(a, 0) {
        x if x > 0.0 => Ok(plain(libm::log(x))),
        x => Err(format!("the logarithm of {x} does not exist")),
    }),
    function("pow", &[("x", Want::AnyNumber), ("y", PLAIN)], "x to the power y.", pow),
    function("sqrt", &[("x", Want::AnyNumber)], "Square root.", sqrt),
    function("abs", &[("x", Want::AnyNumber)], "Without its sign.", |a| Ok(map(a, f64::abs))),
    variadic(function(
        "min",
        &[("a", Want::AnyNumber), ("b", Want::LikeFirst)],
        "The smallest.",
        |a| Ok(fold(a, f64::min)),
    )),
    variadic(function(
        "max",
        &[("a", Want::AnyNumber), ("b", Want::LikeFirst)],
        "The largest.",
        |a| Ok(fold(a, f64::max)),
    )),
    function(
        "clamp",
        &[("x", Want::Measure), ("low", Want::LikeFirst), ("high", Want::LikeFirst)],
        "x, but not below low and not above high.",
        |a| {
            let (low, high) = (num(a, 1), num(a, 2));
            if low > high {
                return Err("`low` is above `high`".to_owned());
            }
            if a[0].is_textured() {
                return textured::clamp(&a[0], [low, high]);
            }
            Ok(map(a, |x| x.max(low).min(high)))
        },
    ),
    function("floor", &[("x", PLAIN)], "The greatest whole number that is not above x.", |a| {
        Ok(map(a, f64::floor))
    }),
    function("ceil", &[("x", PLAIN)], "The least whole number that is not below x.", |a| {
        Ok(map(a, f64::ceil))
    }),
    function(
        "round",
        &[("x", PLAIN)],
        "The nearest whole number; halves go away from zero.",
        |a| Ok(map(a, f64::round)),
    ),
    function(
        "mod",
        &[("x", Want::AnyNumber), ("y", Want::LikeFirst)],
        "What is left of x after whole multiples of y; never negative.",
        |a| {
            let (x, y) = (num(a, 0), num(a, 1));
            if y <= 0.0 {
                Err("`y` must be above zero".to_owned())
            } else {
                Ok(map(a, |_| modulo(x, y)))
            }
        },
    ),
    function(
        "mix",
        &[("a", Want::Blend), ("b", Want::Blend), ("t", Want::Share)],
        "a where t is 0, b where t is 1, in proportion between.",
        mix,
    ),
    one_or_all(function(
        "checker",
        &[("across", PLAIN), ("up", PLAIN)],
        "A texture: squares of 0 and 1, `across` of them along u and `up` along v.",
        checker,
    )),
    function(
        "bricks",
        &[("across", PLAIN), ("up", PLAIN), ("mortar", PLAIN)],
        "A texture: 1 in bricks, 0 in the mortar between them, whose width is a share of a brick's height. \
         `across` bricks along u, `up` rows along v.",
        bricks,
    ),
    function(
        "gradient",
        &[("angle", ANGLE)],
        "A texture: from 0 to 1 along the direction at this angle from u.",
        |a| pattern(TexturePattern::Gradient(num(a, 0))),
    ),
    function(
        "wave",
        &[("count", PLAIN), ("angle", ANGLE)],
        "A texture: `count` smooth waves between 0 and 1 along the direction at this angle from u.",
        |a| pattern(TexturePattern::Wave { count: cells(a, 0)?, angle: num(a, 1) }),
    ),
    one_or_all(function(
        "noise",
        &[("count", PLAIN), ("octaves", PLAIN)],
        "A texture: random numbers between 0 and 1 with `count` bumps along u and v, smooth with one octave, rough \
         with more (4 by default).",
        noise,
    )),
    function(
        "distance",
        &[("a", Want::Vector), ("b", Want::VectorLikeFirst)],
        "How far apart two points are.",
        |a| {
            let (p, q) = (vec(a, 0), vec(a, 1));
            let d = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
            Ok(Value::Number(length(d), dim(a, 0)))
        },
    ),
    function("length", &[("v", Want::Vector)], "The length of a vector.", |a| {
        Ok(Value::Number(length(vec(a, 0)), dim(a, 0)))
    }),
    function("normalize", &[("v", Want::Vector)], "The same direction with length 1.", |a| {
        let (v, l) = (vec(a, 0), length(vec(a, 0)));
        if l == 0.0 {
            return Err("a vector of length zero has no direction".to_owned());
        }
        Ok(Value::Vector(v.map(|x| x / l).to_vec(), Dim::NONE))
    }),
    function("dot", &[("a", Want::Vector), ("b", Want::Vector)], "Scalar product.", |a| {
        let (p, q) = (vec(a, 0), vec(a, 1));
        let dim = product_dim(a)?;
        Ok(Value::Number(p[0] * q[0] + p[1] * q[1] + p[2] * q[2], dim))
    }),
    function("cross", &[("a", Want::Vector), ("b", Want::Vector)], "Vector product.", |a| {
        let (p, q) = (vec(a, 0), vec(a, 1));
        let c = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        Ok(Value::Vector(c.to_vec(), product_dim(a)?))
    }),
    function(
        "polar",
        &[("azimuth", ANGLE), ("elevation", ANGLE), ("distance", Want::AnyNumber)],
        "The point at this distance: azimuth clockwise from -z as seen from above (so 90deg is +x), \
         elevation above the horizon.",
        polar,
    ),
];

/// What a function gives: a value, or why there is none.
type Outcome = Result<Value, String>;

/// The function of this name.
pub(crate) fn find(name: &str) -> Option<&'static Function> {
    FUNCTIONS.iter().find(|function| function.name == name)
}

/// Argument `i` as a number; the caller has checked what it is.
fn num(args: &[Value], i: usize) -> f64 {
    match args.get(i) {
        Some(Value::Number(value, _)) => *value,
        _ => 0.0,
    }
}

/// Argument `i` as a triple; the caller has checked what it is.
fn vec(args: &[Value], i: usize) -> [f64; 3] {
    match args.get(i) {
        Some(Value::Vector(values, _)) => [values[0], values[1], values[2]],
        _ => [0.0; 3],
    }
}

fn dim(args: &[Value], i: usize) -> Dim {
    args.get(i).and_then(Value::dim).unwrap_or(Dim::NONE)
}

fn product_dim(args: &[Value]) -> Result<Dim, String> {
    dim(args, 0).times(dim(args, 1)).ok_or_else(|| "this unit has too high a power".to_owned())
}

fn plain(value: f64) -> Value {
    Value::plain(value)
}

fn angle(value: f64) -> Value {
    Value::Number(value, Dim::ANGLE)
}

fn inverse(x: f64, f: fn(f64) -> f64) -> Outcome {
    if x.abs() <= 1.0 { Ok(angle(f(x))) } else { Err(format!("{x} is not between -1 and 1")) }
}

fn map(args: &[Value], f: impl Fn(f64) -> f64) -> Value {
    Value::Number(f(num(args, 0)), dim(args, 0))
}

fn fold(args: &[Value], f: fn(f64, f64) -> f64) -> Value {
    let best = (1..args.len()).fold(num(args, 0), |best, i| f(best, num(args, i)));
    Value::Number(best, dim(args, 0))
}

fn modulo(x: f64, y: f64) -> f64 {
    let rest = x % y;
    if rest < 0.0 { rest + y } else { rest }
}

fn length(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

fn sqrt(args: &[Value]) -> Outcome {
    let x = num(args, 0);
    if x < 0.0 {
        return Err(format!("the square root of {x} does not exist"));
    }
    let own = dim(args, 0);
    let dim = own.sqrt().ok_or_else(|| format!("the square root of {own} has no unit"))?;
    Ok(Value::Number(x.sqrt(), dim))
}

fn pow(args: &[Value]) -> Outcome {
    let (x, y) = (num(args, 0), num(args, 1));
    let own = dim(args, 0);
    let dim = if own.is_none() {
        own
    } else {
        let whole = y.fract() == 0.0 && y.abs() <= 12.0;
        #[expect(clippy::cast_possible_truncation, reason = "a whole number of at most 12")]
        let n = whole.then_some(y as i8);
        n.and_then(|n| own.power(n))
            .ok_or_else(|| format!("{own} needs a small whole number as its power"))?
    };
    if x < 0.0 && y.fract() != 0.0 {
        return Err(format!("{x} to the power {y} does not exist"));
    }
    if x == 0.0 && y < 0.0 {
        return Err("zero has no negative power".to_owned());
    }
    Ok(Value::Number(libm::pow(x, y), dim))
}

/// Most cells of a pattern in a unit.
const MAX_CELLS: f64 = 1e6;

/// Argument `i` as a number of cells.
fn cells(args: &[Value], i: usize) -> Result<f64, String> {
    match num(args, i) {
        count if count > 0.0 && count <= MAX_CELLS => Ok(count),
        count => Err(format!("{count} is not above 0 and at most {MAX_CELLS}")),
    }
}

#[expect(clippy::unnecessary_wraps, reason = "the table wants functions that may fail")]
fn pattern(pattern: TexturePattern) -> Outcome {
    Ok(Value::Textured(Rc::new(TextureExpression::Pattern(pattern))))
}

fn checker(args: &[Value]) -> Outcome {
    let across = cells(args, 0)?;
    let up = if args.len() > 1 { cells(args, 1)? } else { across };
    pattern(TexturePattern::Checker([across, up]))
}

fn bricks(args: &[Value]) -> Outcome {
    let mortar = num(args, 2);
    if !(0.0..1.0).contains(&mortar) {
        return Err(format!("`mortar` is {mortar}, not between 0 and 1"));
    }
    pattern(TexturePattern::Bricks { count: [cells(args, 0)?, cells(args, 1)?], mortar })
}

fn noise(args: &[Value]) -> Outcome {
    let octaves = if args.len() > 1 { num(args, 1) } else { 4.0 };
    if octaves.fract() != 0.0 || !(1.0..=16.0).contains(&octaves) {
        return Err(format!("`octaves` is {octaves}, not a whole number between 1 and 16"));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 16")]
    let octaves = octaves as u32;
    pattern(TexturePattern::Noise { count: cells(args, 0)?, octaves })
}

fn mix(args: &[Value]) -> Outcome {
    if args.iter().any(Value::is_textured) {
        return textured::mix([&args[0], &args[1], &args[2]]);
    }
    let t = num(args, 2);
    let lerp = |x: f64, y: f64| x * (1.0 - t) + y * t;
    match (&args[0], &args[1]) {
        (Value::Number(x, dim), Value::Number(y, other)) if dim == other => {
            Ok(Value::Number(lerp(*x, *y), *dim))
        }
        (Value::Vector(x, dim), Value::Vector(y, other)) if dim == other && x.len() == y.len() => {
            Ok(Value::Vector(x.iter().zip(y).map(|(x, y)| lerp(*x, *y)).collect(), *dim))
        }
        (Value::Color(x), Value::Color(y)) => {
            Ok(Value::Color([lerp(x[0], y[0]), lerp(x[1], y[1]), lerp(x[2], y[2])]))
        }
        (x, y) => Err(format!("cannot mix {} and {}", x.described(), y.described())),
    }
}

#[expect(clippy::unnecessary_wraps, reason = "the table wants functions that may fail")]
fn polar(args: &[Value]) -> Outcome {
    let (azimuth, elevation, d) = (num(args, 0), num(args, 1), num(args, 2));
    let flat = d * libm::cos(elevation);
    let point =
        vec![flat * libm::sin(azimuth), d * libm::sin(elevation), -flat * libm::cos(azimuth)];
    Ok(Value::Vector(point, dim(args, 2)))
}

fn color_parts(args: &[Value]) -> [f64; 3] {
    match (&args[0], args.len()) {
        (Value::Vector(..), _) => vec(args, 0),
        (_, 1) => [num(args, 0); 3],
        _ => [num(args, 0), num(args, 1), num(args, 2)],
    }
}

fn srgb(args: &[Value]) -> Outcome {
    if let Value::Hex(bytes) = args[0] {
        return Ok(Value::Color(color::linear_from_hex(bytes)));
    }
    let rgb = color_parts(args);
    if let Some(wrong) = rgb.iter().find(|c| !(0.0..=1.0).contains(*c)) {
        return Err(format!("a channel of `srgb` is {wrong}, not between 0 and 1"));
    }
    Ok(Value::Color(rgb.map(color::linear_from_srgb)))
}

fn linear(args: &[Value]) -> Outcome {
    if let Value::Hex(_) = args[0] {
        return Err("`#rrggbb` is sRGB: write `srgb(#rrggbb)`".to_owned());
    }
    Ok(Value::Color(color_parts(args)))
}

fn blackbody(args: &[Value]) -> Outcome {
    let [low, high] = color::BLACKBODY_RANGE;
    match num(args, 0) {
        kelvin if (low..=high).contains(&kelvin) => Ok(Value::Color(color::blackbody(kelvin))),
        kelvin => Err(format!("{kelvin}K is not between {low}K and {high}K")),
    }
}
