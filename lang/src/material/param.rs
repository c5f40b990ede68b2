//! The types of material parameters: how each is read from checked fields, and how it is written.

use std::collections::BTreeMap;

use crate::check::Fields;
use crate::eval::value::Value;
use crate::resolve::ItemId;
use crate::scene::{Medium, Rgb, Texture};
use crate::schema::{self, Field, FieldType, color_text};
use crate::source::Span;
use crate::texture::TextureExpression;
use crate::units::{self, Dim};

/// A colour that may come from an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Constant(Rgb),
    /// `.rgb` of a texture, index into `Scene::textures`.
    Texture(usize),
    /// Computed from textures, index into `Scene::expressions`.
    Expression(usize),
}

/// A number that may come from one channel of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// The same everywhere.
    Constant(f64),
    /// One channel (0 red … 3 alpha) of a texture.
    Texture {
        /// Index into `Scene::textures`.
        texture: usize,
        /// 0 red, 1 green, 2 blue, 3 alpha.
        channel: u8,
    },
    /// Computed from textures, index into `Scene::expressions`.
    Expression(usize),
}

/// An image of tangent-space normals, green up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// Index into `Scene::textures`.
    pub texture: usize,
    /// Factor on the tilt, 0 ..= 10.
    pub strength: f64,
}

/// A field over an object, and the bumps it makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// Pattern coordinates are metres of the object times this; > 0.
    pub scale: f64,
    /// Step of the differences that tilt the normal, metres of the object; > 0.
    pub step: f64,
    /// Height of the bumps, metres of the object; >= 0.
    pub height: f64,
}

/// Ripples of water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waves {
    /// Coordinates are metres of the object times this.
    pub scale: f64,
    /// Factor on the slopes.
    pub height: f64,
}

/// What fills things of a material that light goes through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inside {
    /// Index into `Scene::media`; `None` is clear.
    pub medium: Option<usize>,
    /// Of things that overlap the greatest is there.
    pub priority: u32,
}

/// The inside of water: a medium, or what it says itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filling {
    /// What fills it.
    pub inside: Inside,
    /// Absorption where there is no medium, per metre.
    pub sigma_a: Rgb,
    /// Radiance of what lies below the scene where there is no medium, seen from air.
    pub depth_color: Rgb,
}

/// A material that another is made of, index into `Scene::materials`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ingredient(pub usize);

/// Where a grain runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Axis of the object: 0 x, 1 y, 2 z.
    pub axis: usize,
    /// Where the text says so.
    pub span: Span,
}

/// What parameters are read from.
pub(crate) struct Reader<'a> {
    /// Checked fields without faults.
    pub(crate) fields: &'a Fields,
    /// Index of a texture in the scene.
    pub(crate) textures: &'a dyn Fn(ItemId) -> usize,
    /// Index of an expression of textures in the scene.
    pub(crate) expressions: &'a dyn Fn(&TextureExpression<ItemId>) -> usize,
    /// Indices of media in the scene.
    pub(crate) media: &'a BTreeMap<ItemId, usize>,
    /// Indices of materials in the scene.
    pub(crate) materials: &'a BTreeMap<ItemId, usize>,
}

impl Reader<'_> {
    /// Name of the material's type.
    pub(super) fn name(&self) -> &'static str {
        self.fields.schema.name
    }
}

/// Fields of a declaration as they would be written.
pub(crate) struct Shown<'a> {
    /// What they may refer to, by index.
    textures: &'a [Texture],
    expressions: &'a [TextureExpression<usize>],
    media: &'a [Medium],
    /// Names of materials.
    materials: &'a [&'a str],
    /// Names and values.
    pub(crate) lines: Vec<(&'static str, String)>,
}

impl<'a> Shown<'a> {
    pub(crate) fn new(
        textures: &'a [Texture],
        expressions: &'a [TextureExpression<usize>],
        (media, materials): (&'a [Medium], &'a [&'a str]),
    ) -> Self {
        Self { textures, expressions, media, materials, lines: Vec::new() }
    }

    pub(super) fn push(&mut self, field: &Field, value: String) {
        self.lines.push((field.name, value));
    }

    fn expression(&self, expression: usize) -> String {
        let named = |texture: &usize| self.texture(*texture).to_owned();
        self.expressions.get(expression).map_or_else(String::new, |of| of.named(&named).to_string())
    }

    fn texture(&self, texture: usize) -> &str {
        self.textures.get(texture).map_or("", |texture| texture.name.text.as_str())
    }

    /// The name of a medium, or `none`.
    pub(crate) fn medium(&self, medium: Option<usize>) -> String {
        let medium = medium.and_then(|medium| self.media.get(medium));
        medium.map_or("none", |medium| medium.name.text.as_str()).to_owned()
    }
}

/// What is done with numbers: their field and the numbers.
pub(super) type Change<'a> = dyn FnMut(&Field, &mut [f64]) + 'a;

/// A type of parameters. It stands for one schema field, or for several that belong together.
pub(crate) trait Param: Sized {
    /// The value of the fields of these names.
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self>;

    /// Writes it as these fields.
    fn show(&self, fields: &[Field], shown: &mut Shown<'_>);

    /// Calls `change` with its constant numbers.
    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>);
}

impl Param for f64 {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        from.fields.number(names[0])
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        shown.push(&fields[0], number(&fields[0], *self));
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        change(&fields[0], std::slice::from_mut(self));
    }
}

impl Param for Option<f64> {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        Some(from.fields.number(names[0]))
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        let text = self.map_or("none".to_owned(), |value| number(&fields[0], value));
        shown.push(&fields[0], text);
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        change(&fields[0], self.as_mut_slice());
    }
}

impl Param for Rgb {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        from.fields.color(names[0]).or_else(|| from.fields.vector(names[0]))
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        shown.push(&fields[0], triple(&fields[0], *self));
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        change(&fields[0], self);
    }
}

impl Param for Option<Rgb> {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        Some(Param::read(from, names))
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        let text = self.map_or("none".to_owned(), |value| triple(&fields[0], value));
        shown.push(&fields[0], text);
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        if let Some(rgb) = self {
            change(&fields[0], rgb);
        }
    }
}

impl Param for [f64; 2] {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        from.fields.interval(names[0])
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        let [low, high] = self.map(|value| number(&fields[0], value));
        shown.push(&fields[0], format!("{low}..{high}"));
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        change(&fields[0], self);
    }
}

/// `on` and `both` are true.
impl Param for bool {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        from.fields.word(names[0]).map(is_on)
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        let FieldType::Word(words) = fields[0].ty else { return };
        let word = words.iter().map(|row| row.0).find(|word| is_on(word) == *self);
        shown.push(&fields[0], word.unwrap_or_default().to_owned());
    }

    fn numbers_mut(&mut self, _: &[Field], _: &mut Change<'_>) {}
}

fn is_on(word: &str) -> bool {
    ["on", "both"].contains(&word)
}

impl Param for Color {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        match from.fields.get(names[0]) {
            Some(Value::Color(rgb)) => Some(Self::Constant(rgb)),
            Some(Value::TextureColor(id)) => Some(Self::Texture((from.textures)(id))),
            Some(Value::Textured(of)) => Some(Self::Expression((from.expressions)(&of))),
            _ => None,
        }
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        let text = match self {
            Self::Constant(rgb) => color_text(*rgb),
            Self::Texture(texture) => format!("{}.rgb", shown.texture(*texture)),
            Self::Expression(expression) => shown.expression(*expression),
        };
        shown.push(&fields[0], text);
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        if let Self::Constant(rgb) = self {
            change(&fields[0], rgb);
        }
    }
}

impl Param for Scalar {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        match from.fields.get(names[0]) {
            Some(Value::Number(value, _)) => Some(Self::Constant(value)),
            Some(Value::TextureChannel(id, channel)) => {
                Some(Self::Texture { texture: (from.textures)(id), channel })
            }
            Some(Value::Textured(of)) => Some(Self::Expression((from.expressions)(&of))),
            _ => None,
        }
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        let text = match self {
            Self::Constant(value) => number(&fields[0], *value),
            Self::Texture { texture, channel } => {
                let channel = ["r", "g", "b", "a"][usize::from(*channel).min(3)];
                format!("{}.{channel}", shown.texture(*texture))
            }
            Self::Expression(expression) => shown.expression(*expression),
        };
        shown.push(&fields[0], text);
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        if let Self::Constant(value) = self {
            change(&fields[0], std::slice::from_mut(value));
        }
    }
}

/// `scale`, `bump.eps`, `bump.strength`.
impl Param for Pattern {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        Some(Self {
            scale: from.fields.number(names[0])?,
            step: from.fields.number(names[1])?,
            height: from.fields.number(names[2])?,
        })
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        for (field, value) in fields.iter().zip([self.scale, self.step, self.height]) {
            shown.push(field, number(field, value));
        }
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        let numbers = [&mut self.scale, &mut self.step, &mut self.height];
        for (field, value) in fields.iter().zip(numbers) {
            change(field, std::slice::from_mut(value));
        }
    }
}

/// `waves`, `waves.scale`, `waves.height`.
impl Param for Option<Waves> {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        let (scale, height) = (from.fields.number(names[1])?, from.fields.number(names[2])?);
        Some(is_on(from.fields.word(names[0])?).then_some(Waves { scale, height }))
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        if let Some(waves) = self {
            shown.push(&fields[1], number(&fields[1], waves.scale));
            shown.push(&fields[2], number(&fields[2], waves.height));
        } else {
            shown.push(&fields[0], "off".to_owned());
        }
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        if let Some(waves) = self {
            change(&fields[1], std::slice::from_mut(&mut waves.scale));
            change(&fields[2], std::slice::from_mut(&mut waves.height));
        }
    }
}

/// `interior`, `priority`.
impl Param for Inside {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        let medium = match from.fields.item(names[0]) {
            Some(id) => Some(*from.media.get(&id)?),
            None => None,
        };
        Some(Self { medium, priority: from.fields.integer(names[1])? })
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        shown.push(&fields[0], shown.medium(self.medium));
        shown.push(&fields[1], self.priority.to_string());
    }

    fn numbers_mut(&mut self, _: &[Field], _: &mut Change<'_>) {}
}

/// `sigma_a`, `interior`, `priority`, `depth.color`.
impl Param for Filling {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        Some(Self {
            inside: Param::read(from, &names[1..3])?,
            sigma_a: Param::read(from, &names[..1])?,
            depth_color: Param::read(from, &names[3..])?,
        })
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        if self.inside.medium.is_some() {
            self.inside.show(&fields[1..3], shown);
        } else {
            self.sigma_a.show(&fields[..1], shown);
            shown.push(&fields[2], self.inside.priority.to_string());
            self.depth_color.show(&fields[3..], shown);
        }
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        self.sigma_a.numbers_mut(&fields[..1], change);
        self.depth_color.numbers_mut(&fields[3..], change);
    }
}

impl Param for Ingredient {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        from.materials.get(&from.fields.item(names[0])?).copied().map(Self)
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        let name = shown.materials.get(self.0).copied().unwrap_or_default();
        shown.push(&fields[0], name.to_owned());
    }

    fn numbers_mut(&mut self, _: &[Field], _: &mut Change<'_>) {}
}

impl Param for Grain {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        let word = from.fields.word(names[0])?;
        let axis = ["x", "y", "z"].iter().position(|axis| word == *axis)?;
        Some(Self { axis, span: from.fields.value_span(names[0])? })
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        shown.push(&fields[0], ["x", "y", "z"][self.axis.min(2)].to_owned());
    }

    fn numbers_mut(&mut self, _: &[Field], _: &mut Change<'_>) {}
}

/// A number as it would be written for this field.
fn number(field: &Field, value: f64) -> String {
    let (dim, _) = schema::unit_of(field.ty).unwrap_or((Dim::NONE, ""));
    units::show(value, dim)
}

/// A colour, or three numbers with the unit of the field.
fn triple(field: &Field, value: Rgb) -> String {
    match schema::unit_of(field.ty) {
        None => color_text(value),
        Some((dim, _)) => {
            let [x, y, z] = value.map(units::show_number);
            format!("({x}, {y}, {z}){}", dim.si_unit())
        }
    }
}
