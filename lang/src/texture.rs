//! Texture expressions: colours and numbers that a surface takes from images, patterns and arithmetic.
//!
//! An expression is a tree of values. Images are named by `T`: declarations while a text is evaluated, indices into
//! `Scene::textures` in a checked scene. What a kernel makes of it is the compiler's business.

use std::fmt::{self, Write as _};

use crate::scene::Rgb;
use crate::schema::color_text;
use crate::units::{self, Dim};

/// Most operations of one expression, images, patterns and constants included.
pub(crate) const MAX_OPERATIONS: usize = 30;

/// Most values of one expression that wait for each other while it is computed.
pub(crate) const MAX_WAITING: usize = 5;

/// The texture that needs no declaration: the vertex colours of a mesh.
pub(crate) const VERTEX_COLOR: &str = "vertex_color";

/// Names of the channels of textures.
pub(crate) const CHANNELS: [&str; 4] = ["r", "g", "b", "a"];

/// A colour or a number that varies over a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum TextureExpression<T> {
    /// The same number everywhere.
    Number(f64),
    /// The same colour everywhere, linear Rec. 709.
    Color(Rgb),
    /// `.rgb` of an image.
    Image(T),
    /// One channel of an image, 0 red … 3 alpha.
    Channel(T, u8),
    /// The colour of the mesh's vertices, white where it has none.
    VertexColor,
    /// One channel of it, 0 red … 3 alpha.
    VertexChannel(u8),
    /// A number between 0 and 1 by the place in the texture.
    Pattern(TexturePattern),
    /// Sum.
    Sum(Box<[Self; 2]>),
    /// Product.
    Product(Box<[Self; 2]>),
    /// `a (1 - t) + b t` of a, b, t.
    Mix(Box<[Self; 3]>),
    /// A number, not below the first and not above the second.
    Clamp(Box<Self>, [f64; 2]),
}

/// Patterns in texture coordinates u and v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TexturePattern {
    /// 0 and 1 in rectangles, so many along u and along v.
    Checker([f64; 2]),
    /// 1 in bricks, 0 in the mortar between them.
    Bricks {
        /// Bricks along u, rows along v.
        count: [f64; 2],
        /// Width of the mortar, in heights of a row.
        mortar: f64,
    },
    /// From 0 to 1 along the direction that is at this angle from u, radians.
    Gradient(f64),
    /// Waves from 0 to 1, so many in a unit along the direction at an angle from u, radians.
    Wave {
        /// Waves in a unit.
        count: f64,
        /// Angle from u, radians.
        angle: f64,
    },
    /// Fractal noise about 1/2.
    Noise {
        /// Cells of the first octave in a unit.
        count: f64,
        /// Octaves, each twice as fine.
        octaves: u32,
    },
}

impl<T> TextureExpression<T> {
    /// 1/2 on the circle in the unit square, more within it: 1 - 2 r^2 at a distance r from the middle.
    pub(crate) fn disk() -> Self {
        let square = |angle: f64| {
            let from_middle = || {
                let along = Self::Pattern(TexturePattern::Gradient(angle));
                Self::Sum(Box::new([along, Self::Number(-0.5)]))
            };
            Self::Product(Box::new([from_middle(), from_middle()]))
        };
        let r2 = Self::Sum(Box::new([square(0.0), square(std::f64::consts::FRAC_PI_2)]));
        // The deepest part first: then the fewest values wait for each other.
        let fall = Self::Product(Box::new([r2, Self::Number(-2.0)]));
        Self::Sum(Box::new([fall, Self::Number(1.0)]))
    }

    /// Its parts, in order.
    pub fn parts(&self) -> &[Self] {
        match self {
            Self::Number(_)
            | Self::Color(_)
            | Self::Image(_)
            | Self::Channel(..)
            | Self::VertexColor
            | Self::VertexChannel(_)
            | Self::Pattern(_) => &[],
            Self::Sum(parts) | Self::Product(parts) => parts.as_slice(),
            Self::Mix(parts) => parts.as_slice(),
            Self::Clamp(part, _) => std::slice::from_ref(part),
        }
    }

    /// Whether it is a colour; otherwise it is a number.
    pub fn is_color(&self) -> bool {
        match self {
            Self::Color(_) | Self::Image(_) | Self::VertexColor => true,
            Self::Number(_) | Self::Channel(..) | Self::VertexChannel(_) | Self::Pattern(_) => {
                false
            }
            Self::Sum(_) | Self::Product(_) | Self::Mix(_) | Self::Clamp(..) => {
                self.parts().iter().any(Self::is_color)
            }
        }
    }

    /// How many operations a kernel needs for it; a single channel takes two.
    pub fn operations(&self) -> usize {
        let own = if matches!(self, Self::Channel(..) | Self::VertexChannel(_)) { 2 } else { 1 };
        own + self.parts().iter().map(Self::operations).sum::<usize>()
    }

    /// How many values wait for each other when parts are computed in order.
    pub fn waiting(&self) -> usize {
        let parts = self.parts().iter().enumerate();
        parts.map(|(before, part)| before + part.waiting()).max().unwrap_or(1)
    }

    /// The least and the largest number that it can be in any channel, where images are between 0 and 1.
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Number(value) => [*value, *value],
            Self::Color(rgb) => [
                rgb.iter().copied().fold(f64::MAX, f64::min),
                rgb.iter().copied().fold(0.0, f64::max),
            ],
            Self::Image(_)
            | Self::Channel(..)
            | Self::VertexColor
            | Self::VertexChannel(_)
            | Self::Pattern(_) => [0.0, 1.0],
            Self::Sum(parts) => {
                let [a, b] = parts.each_ref().map(Self::range);
                [a[0] + b[0], a[1] + b[1]]
            }
            Self::Product(parts) => {
                let [a, b] = parts.each_ref().map(Self::range);
                span([a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]])
            }
            Self::Mix(parts) => {
                let [a, b, t] = parts.each_ref().map(Self::range);
                let at = |t: f64| [a[0], a[1]].map(|a| [b[0], b[1]].map(|b| a * (1.0 - t) + b * t));
                span(t.map(at).into_iter().flatten().flatten())
            }
            Self::Clamp(part, [low, high]) => part.range().map(|x| x.max(*low).min(*high)),
        }
    }

    /// The images that it reads, each as often as it does.
    pub fn images(&self) -> Vec<(&T, Option<u8>)> {
        match self {
            Self::Image(image) => vec![(image, None)],
            Self::Channel(image, channel) => vec![(image, Some(*channel))],
            _ => self.parts().iter().flat_map(Self::images).collect(),
        }
    }

    /// The same with other names of images.
    pub fn named<U>(&self, name: &impl Fn(&T) -> U) -> TextureExpression<U> {
        match self {
            Self::Number(value) => TextureExpression::Number(*value),
            Self::Color(rgb) => TextureExpression::Color(*rgb),
            Self::Image(image) => TextureExpression::Image(name(image)),
            Self::Channel(image, channel) => TextureExpression::Channel(name(image), *channel),
            Self::VertexColor => TextureExpression::VertexColor,
            Self::VertexChannel(channel) => TextureExpression::VertexChannel(*channel),
            Self::Pattern(pattern) => TextureExpression::Pattern(*pattern),
            Self::Sum(parts) => {
                TextureExpression::Sum(Box::new(parts.each_ref().map(|part| part.named(name))))
            }
            Self::Product(parts) => {
                TextureExpression::Product(Box::new(parts.each_ref().map(|part| part.named(name))))
            }
            Self::Mix(parts) => {
                TextureExpression::Mix(Box::new(parts.each_ref().map(|part| part.named(name))))
            }
            Self::Clamp(part, range) => {
                TextureExpression::Clamp(Box::new(part.named(name)), *range)
            }
        }
    }
}

/// Least and largest of some numbers.
fn span(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values.into_iter().fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(x), high.max(x)])
}

/// As it would be written.
impl<T: fmt::Display> fmt::Display for TextureExpression<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = units::show_number;
        match self {
            Self::Number(value) => out.write_str(&number(*value)),
            Self::Color(rgb) => out.write_str(&color_text(*rgb)),
            Self::Image(image) => write!(out, "{image}.rgb"),
            Self::Channel(image, channel) => {
                write!(out, "{image}.{}", CHANNELS[usize::from(*channel).min(3)])
            }
            Self::VertexColor => write!(out, "{VERTEX_COLOR}.rgb"),
            Self::VertexChannel(channel) => {
                write!(out, "{VERTEX_COLOR}.{}", CHANNELS[usize::from(*channel).min(3)])
            }
            Self::Pattern(pattern) => write!(out, "{pattern}"),
            Self::Sum(parts) => write!(out, "{} + {}", parts[0], parts[1]),
            Self::Product(parts) => {
                for (i, part) in parts.iter().enumerate() {
                    let between = if i == 0 { "" } else { " * " };
                    match part {
                        Self::Sum(_) => write!(out, "{between}({part})")?,
                        _ => write!(out, "{between}{part}")?,
                    }
                }
                Ok(())
            }
            Self::Mix(parts) => write!(out, "mix({}, {}, {})", parts[0], parts[1], parts[2]),
            Self::Clamp(part, [low, high]) => {
                write!(out, "clamp({part}, {}, {})", number(*low), number(*high))
            }
        }
    }
}

/// As it would be written.
impl fmt::Display for TexturePattern {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = units::show_number;
        let angle = |angle: f64| units::show(angle, Dim::ANGLE);
        match *self {
            Self::Checker(count) => {
                write!(out, "checker({}, {})", number(count[0]), number(count[1]))
            }
            Self::Bricks { count: [u, v], mortar } => {
                write!(out, "bricks({}, {}, {})", number(u), number(v), number(mortar))
            }
            Self::Gradient(turn) => write!(out, "gradient({})", angle(turn)),
            Self::Wave { count, angle: turn } => {
                write!(out, "wave({}, {})", number(count), angle(turn))
            }
            Self::Noise { count, octaves } => write!(out, "noise({}, {octaves})", number(count)),
        }
    }
}

/// Where an image lies in texture coordinates: they are scaled, turned and moved before it is looked up, as by
/// Blender's *Mapping* node of the type *Point*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Factors on u and v: how often the image fits into a unit.
    pub scale: [f64; 2],
    /// Counter-clockwise turn of the coordinates, radians.
    pub rotate: f64,
    /// What is added at the end.
    pub offset: [f64; 2],
}

impl Placement {
    /// The image fills the unit square.
    pub const NONE: Self = Self { scale: [1.0; 2], rotate: 0.0, offset: [0.0; 2] };

    /// Where in the image the point (u, v) lies: a 2 x 2 matrix, row by row, and what is added to its product.
    #[must_use]
    pub fn matrix(&self) -> ([f64; 4], [f64; 2]) {
        let (sin, cos) = (libm::sin(self.rotate), libm::cos(self.rotate));
        let [u, v] = self.scale;
        ([cos * u, -sin * v, sin * u, cos * v], self.offset)
    }

    /// The fields that say so, without those that say what is so anyway.
    #[must_use]
    #[expect(clippy::float_cmp, reason = "what is exactly so anyway is not written")]
    pub(crate) fn fields(&self) -> String {
        let mut text = String::new();
        let numbers = [
            ("scale_u", self.scale[0], 1.0),
            ("scale_v", self.scale[1], 1.0),
            ("offset_u", self.offset[0], 0.0),
            ("offset_v", self.offset[1], 0.0),
        ];
        for (name, value, usual) in numbers {
            if value != usual {
                let _ = write!(text, ", {name}: {}", units::show_number(value));
            }
        }
        if self.rotate != 0.0 {
            let _ = write!(text, ", rotate: {}", units::show(self.rotate, Dim::ANGLE));
        }
        text
    }
}
