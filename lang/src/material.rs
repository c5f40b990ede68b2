//! Materials: each is declared once, in `materials!`.
//!
//! From that list come the schema (and with it checking, `rtc explain` and `docs/reference.md`), the typed
//! value, how it is read from checked fields, and how `rtc show --resolved` writes it. What a kind is in a pack
//! and in the kernel stands under the same name in `pack::abi::MaterialKind`; the compiler turns one into the
//! other. This does not know the pack.

mod brightness;
mod fields;
mod no_effect;
mod param;
mod pattern;
mod principled;
mod projection;
mod sheet;
mod specular;

pub use brightness::Brightness;
pub(crate) use fields::VISIBLE;
pub use no_effect::{NoEffect, without_effect};
pub use param::{Color, Filling, Grain, Ingredient, Inside, NormalMap, Pattern, Scalar, Waves};
pub(crate) use param::{Param, Reader, Shown};
pub use projection::TextureProjection;

use crate::scene::{FileBase, Name, Rgb};
use crate::schema::{Default, Field, Kind, TypeSchema};

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Declared name.
    pub name: Name,
    /// Model and parameters.
    pub model: MaterialModel,
    /// Tilts the shading normal.
    pub normal: Option<NormalMap>,
    /// Where its textures lie.
    pub projection: TextureProjection,
    /// The material of a mesh file that it is like; then what the declaration does not say is not known yet.
    pub of_file: Option<MaterialOfFile>,
}

/// What a material takes from a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialOfFile {
    /// The material.
    pub base: FileBase,
    /// `normal.strength`; counts for the normal map of the file if the declaration says it.
    pub normal_strength: f64,
}

/// What compilation asks of a material beside its numbers. As it is here: opaque, without light of its own, the
/// same on every piece of a mesh.
pub trait Traits {
    /// Colour of the light that it gives off, and the factor on it.
    fn emission(&self) -> Option<(Color, f64)> {
        None
    }

    /// It does something else with light than give it off.
    fn scatters(&self) -> bool {
        true
    }

    /// What fills the things made of it, which should be closed.
    fn inside(&self) -> Option<Inside> {
        None
    }

    /// It is a thin sheet.
    fn sheet(&self) -> Option<Sheet> {
        None
    }

    /// It has a grain.
    fn grain(&self) -> Option<Grain> {
        None
    }

    /// Why light does more than to be scattered by its front or back, if it does.
    fn unmixable(&self) -> Option<&'static str> {
        None
    }
}

const GLOWS: &str = "it gives off light";
const HAS_INSIDE: &str = "it has an inside, which light enters";
const IS_SHEET: &str = "light goes straight through it";
const HAS_HOLES: &str = "not all of it is there: `alpha`";

/// A thin sheet, of which a mesh holds many pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet {
    /// At its thickest, metres.
    pub thickness: f64,
    /// Share of the pieces that are not there, 0 ..= 1.
    pub gap: f64,
    /// Lean of the normals at the rim.
    pub pillow: f64,
    /// Lean of each piece.
    pub tilt: f64,
}

/// Which values of a material are allowed and hardly meant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lints {
    /// `color` is the share that a rough surface scatters, and no real one is quite white.
    pub(crate) albedo: bool,
    /// Slope of the bumps' field at `scale` 1, per metre: its root mean square, measured.
    pub(crate) slope: Option<f64>,
}

impl Lints {
    const NONE: Self = Self { albedo: false, slope: None };
    const ALBEDO: Self = Self { albedo: true, slope: None };

    /// Those of the material type `name`.
    pub(crate) fn of(name: &str) -> Self {
        LINTS.iter().find(|(known, _)| *known == name).map_or(Self::NONE, |row| row.1)
    }
}

/// Declares the materials. A field of the model stands for the schema fields behind it; `also` are schema
/// fields that no model holds.
macro_rules! materials {
    ($(
        $(#[doc = $about:literal])*
        $model:ident $name:literal {
            doc: $doc:expr,
            example: $example:expr,
            elsewhere: $foreign:expr,
            lints: $lints:expr,
            fields: {
                $($(#[doc = $of_field:literal])*
                $field:ident: $ty:ty = [$($schema:expr),+],)*
            }
            $(also: [$($also:expr),*],)?
            traits: { $($traits:tt)* }
        }
    )*) => {
        /// How a material scatters and emits.
        #[derive(Clone, Debug, PartialEq)]
        pub enum MaterialModel {
            $($(#[doc = $about])* $model($model),)*
        }

        $(
            $(#[doc = $about])*
            #[derive(Clone, Debug, PartialEq)]
            pub struct $model {
                $($(#[doc = $of_field])* pub $field: $ty,)*
            }

            impl Traits for $model {
                $($traits)*
            }
        )*

        /// The schema of each, in the order of the reference.
        pub(crate) const TYPES: &[&TypeSchema] = &[$(&TypeSchema {
            kind: Kind::Material,
            name: $name,
            doc: $doc,
            example: $example,
            fields: &[$($($schema,)+)* $($($also),*)?],
            foreign: $foreign,
        }),*];

        const LINTS: &[(&str, Lints)] = &[$(($name, $lints)),*];

        impl MaterialModel {
            /// The model of these fields. `None` only for fields with faults.
            pub(crate) fn read(from: &Reader<'_>) -> Option<Self> {
                match from.name() {
                    $($name => Some(Self::$model($model {
                        $($field: Param::read(from, &[$($schema.name),+])?,)*
                    })),)*
                    name => unreachable!("`{name}` is no material type of this list"),
                }
            }

            /// Name of its type, and its fields as they would be written.
            pub(crate) fn show(&self, shown: &mut Shown<'_>) -> &'static str {
                match self {
                    $(Self::$model(model) => {
                        $(model.$field.show(&[$($schema),+], shown);)*
                        $name
                    })*
                }
            }

            /// Calls `change` with the numbers of each field, in SI; a colour has three.
            pub fn numbers_mut(&mut self, change: &mut dyn FnMut(&Field, &mut [f64])) {
                match self {
                    $(Self::$model(model) => {
                        $(model.$field.numbers_mut(&[$($schema),+], change);)*
                    })*
                }
            }

            fn as_traits(&self) -> &dyn Traits {
                match self {
                    $(Self::$model(model) => model,)*
                }
            }
        }
    };
}

impl Traits for MaterialModel {
    fn emission(&self) -> Option<(Color, f64)> {
        self.as_traits().emission()
    }

    fn scatters(&self) -> bool {
        self.as_traits().scatters()
    }

    fn inside(&self) -> Option<Inside> {
        self.as_traits().inside()
    }

    fn sheet(&self) -> Option<Sheet> {
        self.as_traits().sheet()
    }

    fn grain(&self) -> Option<Grain> {
        self.as_traits().grain()
    }

    fn unmixable(&self) -> Option<&'static str> {
        self.as_traits().unmixable()
    }
}

materials! {
    /// Lambert.
    Diffuse "diffuse" {
        doc: "Scatters light evenly in all directions (Lambert): chalk, clay, matt paint.",
        example: "material clay: diffuse { color = srgb(#b5651d) }",
        elsewhere: &[
        ("lambertian", "common use"),
        ("lambert", "common use"),
        ("matte", "pbrt-v3 and LuxCore"),
    ],
        lints: Lints::ALBEDO,
        fields: {
            /// Reflectance, 0 ..= 1.
            color: Color = [fields::reflectance(Default::Required)],
        }
        also: [fields::NORMAL, fields::NORMAL_STRENGTH, projection::PROJECTION],
        traits: {}
    }
    /// Mirror blurred by a ball of radius `fuzz`.
    Metal "metal" {
        doc: "A coloured mirror, blurred by moving the mirrored direction within a ball.",
        example: "material brass: metal { color = linear(0.89, 0.68, 0.33), fuzz = 0.1 }",
        elsewhere: &[("mirror", "pbrt-v3 and LuxCore"), ("glossy", "Blender")],
        lints: Lints::NONE,
        fields: {
            /// Reflectance, 0 ..= 1.
            color: Color = [fields::reflectance(Default::Required)],
            /// 0 ..= 1.
            fuzz: f64 = [fields::METAL_FUZZ],
        }
        also: [fields::NORMAL, fields::NORMAL_STRENGTH, projection::PROJECTION],
        traits: {}
    }
    /// Rough metal.
    Conductor "conductor" {
        doc: "Metal with a rough surface (GGX). Its highlights stretch at grazing angles, and light that is \
             reflected several times is not lost.",
        example: "material gold: conductor { color = linear(1, 0.71, 0.29), roughness = 0.3 }",
        elsewhere: &[
        ("roughconductor", "Mitsuba"),
        ("metal2", "LuxCore"),
        ("glossy_metal", "common use"),
    ],
        lints: Lints::NONE,
        fields: {
            /// Reflectance at normal incidence, 0 ..= 1.
            color: Color = [specular::CONDUCTOR_COLOR],
            /// Perceptual roughness, 0 ..= 1.
            roughness: Scalar = [specular::CONDUCTOR_ROUGHNESS],
            /// 0 round ..= 1 brushed along the tangent.
            anisotropy: f64 = [specular::CONDUCTOR_ANISOTROPY],
            /// Gives back what single reflection loses.
            compensation: bool = [specular::COMPENSATION],
        }
        also: [fields::NORMAL, fields::NORMAL_STRENGTH, projection::PROJECTION],
        traits: {}
    }
    /// Glass, smooth where the roughness is 0.
    Dielectric "dielectric" {
        doc: "Glass, smooth or ground: reflects and refracts. Its inside absorbs and scatters if it has an \
             `interior`.",
        example: "material glass: dielectric { ior = 1.52 }",
        elsewhere: &[
        ("glass", "pbrt-v3, LuxCore and Blender"),
        ("refraction", "Blender"),
        ("roughdielectric", "Mitsuba"),
        ("roughglass", "LuxCore"),
        ("subsurface", "pbrt"),
        ("skin", "common use"),
    ],
        lints: Lints::NONE,
        fields: {
            /// Refractive index, >= 1.
            ior: f64 = [fields::IOR],
            /// Perceptual roughness, 0 ..= 1.
            roughness: Scalar = [specular::DIELECTRIC_ROUGHNESS],
            /// Gives back what single scattering loses.
            compensation: bool = [specular::COMPENSATION],
            /// What it is inside.
            inside: Inside = [fields::INTERIOR, fields::PRIORITY],
        }
        also: [fields::NORMAL, fields::NORMAL_STRENGTH, projection::PROJECTION],
        traits: {
            fn unmixable(&self) -> Option<&'static str> {
                Some(HAS_INSIDE)
            }

            fn inside(&self) -> Option<Inside> {
                Some(self.inside)
            }
        }
    }
    /// Clear coat over Lambert.
    Clearcoat "clearcoat" {
        doc: "Matt colour under a clear coat: lacquer, varnish, glazed clay. Nothing is lost between coat and base. \
             A coat of index 1.65 reflects 6% at normal incidence, as strongly coated toys in older pictures do.",
        example: "material lacquer: clearcoat { color = srgb(#8c1d18), fuzz = 0.05 }",
        elsewhere: &[
        ("coateddiffuse", "pbrt-v4"),
        ("roughplastic", "Mitsuba"),
        ("glossy2", "LuxCore"),
        ("varnish", "common use"),
        ("coat", "Blender"),
    ],
        lints: Lints::ALBEDO,
        fields: {
            /// Reflectance of the base, 0 ..= 1.
            color: Color = [fields::reflectance(Default::Required)],
            /// Radius of the ball of the coat's mirror direction, 0 ..= 1.
            fuzz: f64 = [specular::CLEARCOAT_FUZZ],
            /// Refractive index of the coat, >= 1.
            coat_ior: f64 = [specular::CLEARCOAT_COAT_IOR],
            /// Factor on what the coat reflects.
            coat_tint: Rgb = [specular::CLEARCOAT_COAT_TINT],
        }
        also: [fields::NORMAL, fields::NORMAL_STRENGTH, projection::PROJECTION],
        traits: {}
    }
    /// Light source without scattering.
    Emissive "emissive" {
        doc: "Gives off light and scatters none. It may be on any shape or mesh part; its radiance is `color` \
             times `strength`.",
        example: "material lamp: emissive { color = blackbody(3000K), strength = 12 }",
        elsewhere: &[
        ("area", "Mitsuba"),
        ("diffuse_light", "common use"),
        ("emission", "Blender"),
        ("light", "common use"),
    ],
        lints: Lints::NONE,
        fields: {
            /// Colour, any non-negative value.
            color: Color = [fields::EMISSIVE_COLOR],
            /// Factor on `color`.
            brightness: Brightness = [fields::EMISSIVE_STRENGTH, fields::EMISSIVE_POWER],
            /// Emits from the back side too.
            both_sides: bool = [fields::EMISSIVE_SIDES],
            /// The camera sees it.
            visible: bool = [fields::VISIBLE],
            /// Coverage.
            alpha: Scalar = [fields::ALPHA],
            /// Alpha below this is not there; `None`: alpha is the share that is there.
            alpha_clip: Option<f64> = [fields::ALPHA_CLIP],
        }
        traits: {
            fn unmixable(&self) -> Option<&'static str> {
                Some(GLOWS)
            }

            fn emission(&self) -> Option<(Color, f64)> {
                Some((self.color, self.brightness.value()))
            }

            fn scatters(&self) -> bool {
                false
            }
        }
    }
    /// glTF metallic-roughness.
    Principled "principled" {
        doc: "The metallic-roughness model of glTF: one material for plastic, wood, stone and metal.",
        example: "material tile: principled { color = srgb(#3f6f8f), roughness = 0.3 }",
        elsewhere: &[
        ("disney", "pbrt-v3 and LuxCore"),
        ("pbrMetallicRoughness", "glTF"),
        ("standard", "common use"),
        ("plastic", "pbrt-v3 and Mitsuba"),
    ],
        lints: Lints::ALBEDO,
        fields: {
            /// Base colour.
            color: Color = [fields::reflectance(Default::Color([0.8; 3]))],
            /// 0 dielectric … 1 metal.
            metallic: Scalar = [principled::METALLIC],
            /// Perceptual roughness 0 ..= 1.
            roughness: Scalar = [principled::ROUGHNESS],
            /// Refractive index of the dielectric part.
            ior: f64 = [fields::IOR],
            /// Factor on the reflectance of the dielectric part, 0 ..= 1.
            specular: Scalar = [principled::SPECULAR],
            /// Colour of that reflectance at normal incidence, any non-negative value.
            specular_color: Color = [principled::SPECULAR_COLOR],
            /// 0 round ..= 1 brushed.
            anisotropy: f64 = [principled::ANISOTROPY],
            /// From the tangent to the direction of brushing, radians.
            anisotropy_rotation: f64 = [principled::ANISOTROPY_ROTATION],
            /// Share under a clear coat, 0 ..= 1.
            coat: Scalar = [principled::COAT_WEIGHT],
            /// Perceptual roughness of the coat, 0 ..= 1.
            coat_roughness: Scalar = [principled::COAT_ROUGHNESS],
            /// Colour of the sheen, 0 ..= 1.
            sheen: Color = [principled::SHEEN],
            /// Perceptual roughness of the sheen, 0 ..= 1.
            sheen_roughness: Scalar = [principled::SHEEN_ROUGHNESS],
            /// Share of the light entering that goes through the sheet, 0 ..= 1.
            transmission: Scalar = [principled::TRANSMISSION],
            /// Gives back what single scattering loses.
            compensation: bool = [specular::COMPENSATION],
            /// Emitted colour.
            emission: Color = [principled::EMISSION_COLOR],
            /// Factor on `emission`.
            emission_strength: f64 = [principled::EMISSION_STRENGTH],
            /// Coverage.
            alpha: Scalar = [fields::ALPHA],
            /// Alpha below this is not there; `None`: alpha is the share that is there.
            alpha_clip: Option<f64> = [fields::ALPHA_CLIP],
        }
        also: [fields::NORMAL, fields::NORMAL_STRENGTH, projection::PROJECTION],
        traits: {
            fn unmixable(&self) -> Option<&'static str> {
                let dark = matches!(self.emission, Color::Constant(rgb) if rgb.iter().all(|c| *c <= 0.0));
                if self.emission_strength > 0.0 && !dark {
                    Some(GLOWS)
                } else if self.transmission != Scalar::Constant(0.0) {
                    Some(IS_SHEET)
                } else if self.alpha != Scalar::Constant(1.0) {
                    Some(HAS_HOLES)
                } else {
                    None
                }
            }

            fn emission(&self) -> Option<(Color, f64)> {
                Some((self.emission, self.emission_strength))
            }
        }
    }
    /// Rough, with bumps and veins.
    Stone "stone" {
        doc: "Stone with bumps, veins and a roughness between 0.4 and 0.75, from blocks a third of a metre wide \
             down to grains of two centimetres. No two things have the same pattern.",
        example: "material basalt: stone { color = srgb(#8a8782), scale = 4, bump.strength = 10mm, bump.eps = 2.5mm }",
        elsewhere: &[
        ("rock", "common use"),
        ("marble", "pbrt-v3 and LuxCore"),
        ("granite", "common use"),
    ],
        lints: Lints { slope: Some(3.3), ..Lints::ALBEDO },
        fields: {
            /// Reflectance, 0 ..= 1.
            color: Rgb = [pattern::color("Colour of the stone between its veins.")],
            /// That of the veins.
            vein: Option<Rgb> = [pattern::STONE_COLOR_VEIN],
            /// The field and its bumps.
            pattern: Pattern = [pattern::SCALE, pattern::step(0.010), pattern::height(0.04)],
            /// Share of uncoloured gloss, 0 ..= 1.
            gloss: f64 = [pattern::gloss(0.06)],
        }
        traits: {}
    }
    /// Rough, with bumps, rings and gloss along a grain.
    Wood "wood" {
        doc: "Wood with growth rings, bumps and gloss along a grain, and a roughness between 0.45 and 0.85. No two \
             things have the same pattern.",
        example: "material cedar: wood { color = srgb(#b5794a), grain = x, scale = 3 }",
        elsewhere: &[("timber", "common use"), ("plank", "common use")],
        lints: Lints { slope: Some(2.8), ..Lints::ALBEDO },
        fields: {
            /// Reflectance of early wood, 0 ..= 1.
            color: Rgb = [pattern::color("Colour of the early wood, the paler part of each ring.")],
            /// That of late wood.
            late: Option<Rgb> = [pattern::WOOD_COLOR_LATE],
            /// Where the grain runs.
            grain: Grain = [pattern::WOOD_GRAIN],
            /// The field and its bumps.
            pattern: Pattern = [pattern::SCALE, pattern::step(0.008), pattern::height(0.03)],
            /// Share of uncoloured gloss, 0 ..= 1.
            gloss: f64 = [pattern::gloss(0.04)],
            /// How far the gloss is stretched along the grain, 0 ..= 1.
            anisotropy: f64 = [pattern::WOOD_ANISOTROPY],
        }
        traits: {
            fn grain(&self) -> Option<Grain> {
                Some(self.grain)
            }
        }
    }
    /// Rough thin sheet that lets light through.
    Fabric "fabric" {
        doc: "A rough thin sheet with folds and weave as bumps; some of the light goes through. For surfaces \
             without thickness, or around something else.",
        example: "material linen: fabric { color = srgb(#d8cdb8), translucency = 0.25 }",
        elsewhere: &[("cloth", "LuxCore"), ("textile", "common use"), ("velvet", "Blender")],
        lints: Lints { slope: Some(7.9), ..Lints::ALBEDO },
        fields: {
            /// Share of light that is not absorbed, 0 ..= 1.
            color: Color = [pattern::FABRIC_COLOR],
            /// The field and its bumps.
            pattern: Pattern = [pattern::SCALE, pattern::step(0.010), pattern::height(0.02)],
            /// Perceptual roughness of the gloss, 0 ..= 1.
            roughness: f64 = [pattern::FABRIC_ROUGHNESS],
            /// Share of uncoloured gloss, 0 ..= 1.
            gloss: f64 = [pattern::gloss(0.04)],
            /// Share of the rest that goes through, 0 ..= 1.
            translucency: f64 = [pattern::FABRIC_TRANSLUCENCY],
        }
        also: [projection::PROJECTION],
        traits: {}
    }
    /// Thin sheet that lets light through.
    Leaf "leaf" {
        doc: "A thin sheet that lets light through: leaves, paper, thin cloth. What crosses it is tinted on the \
             way, and part of it keeps its direction, blurred.",
        example: "material maple: leaf { color = srgb(#7a3b1e), translucency = 40% }",
        elsewhere: &[("translucent", "LuxCore and Blender"), ("thin", "common use")],
        lints: Lints::NONE,
        fields: {
            /// Reflectance, 0 ..= 1.
            color: Color = [sheet::COLOR],
            /// Coverage.
            alpha: Scalar = [fields::ALPHA],
            /// Alpha below this is not there; `None`: alpha is the share that is there.
            alpha_clip: Option<f64> = [fields::ALPHA_CLIP],
            /// Share of the light that goes through, 0 ..= 1.
            translucency: f64 = [sheet::LEAF_TRANSLUCENCY],
            /// Absorption, 1/m.
            sigma_a: Rgb = [sheet::LEAF_SIGMA_A],
            /// Metres.
            thickness: f64 = [sheet::LEAF_THICKNESS],
            /// Share of the light through that keeps its direction, 0 ..= 1.
            forward: f64 = [sheet::LEAF_FORWARD],
            /// Mean cosine of that light's blur.
            g: f64 = [sheet::mean_cosine(0.6, "How little that light is blurred: mean cosine of its scattering.")],
            /// Share of leaves that are not there, 0 ..= 1.
            gap: f64 = [sheet::LEAF_GAP],
        }
        traits: {
            fn unmixable(&self) -> Option<&'static str> {
                Some(IS_SHEET)
            }

            fn sheet(&self) -> Option<Sheet> {
                let thickness = self.thickness;
                Some(Sheet { thickness, gap: self.gap, pillow: 0.0, tilt: 0.0 })
            }
        }
    }
    /// Fuzz and wax over a thin scattering layer.
    Petal "petal" {
        doc: "A petal: fuzz on the surface, a waxy skin, and a thin layer in which light is scattered many times \
             (random walk). Texture coordinates 0..1 span one petal.",
        example: "material sakura: petal { color = srgb(#f6c9d6) }",
        elsewhere: &[],
        lints: Lints::NONE,
        fields: {
            /// Factor on the light from inside, 0 ..= 1.
            color: Color = [sheet::COLOR],
            /// Coverage.
            alpha: Scalar = [fields::ALPHA],
            /// Alpha below this is not there; `None`: alpha is the share that is there.
            alpha_clip: Option<f64> = [fields::ALPHA_CLIP],
            /// Share of the fuzz, 0 ..= 1.
            fuzz_weight: f64 = [sheet::PETAL_FUZZ_WEIGHT],
            /// Radius of the ball of the fuzz, 0 ..= 1.
            fuzz: f64 = [sheet::PETAL_FUZZ_RADIUS],
            /// Refractive index.
            ior: f64 = [sheet::PETAL_IOR],
            /// Radius of the ball of the wax, 0 ..= 1.
            wax: f64 = [sheet::PETAL_WAX],
            /// Absorption, 1/m.
            sigma_a: Rgb = [sheet::PETAL_SIGMA_A],
            /// Scattering, 1/m.
            sigma_s: f64 = [sheet::PETAL_SIGMA_S],
            /// Mean cosine of scattering.
            g: f64 = [sheet::mean_cosine(0.7, "Mean cosine of scattering inside the petal.")],
            /// Metres, at the rim and in the middle.
            thickness: [f64; 2] = [sheet::PETAL_THICKNESS],
            /// Lean of the normals at the rim.
            pillow: f64 = [sheet::PETAL_PILLOW],
            /// Lean of each petal.
            tilt: f64 = [sheet::PETAL_TILT],
        }
        traits: {
            fn unmixable(&self) -> Option<&'static str> {
                Some(IS_SHEET)
            }

            fn sheet(&self) -> Option<Sheet> {
                let thickness = self.thickness[0].max(self.thickness[1]);
                Some(Sheet { thickness, gap: 0.0, pillow: self.pillow, tilt: self.tilt })
            }
        }
    }
    /// Water.
    Water "water" {
        doc: "Water with ripples: reflects and refracts, and absorbs inside, red first. Faces that point up carry \
             three trains of sine waves. A closed shape is a body of water; an open one, such as a `rectangle`, \
          is a sea without a bottom of its own, in which light that leaves the scene below the surface \
          has the colour of the deep.",
        example: "material pond: water { waves.height = 0.5 }",
        elsewhere: &[("ocean", "common use"), ("sea", "common use")],
        lints: Lints::NONE,
        fields: {
            /// Refractive index, >= 1.
            ior: f64 = [fields::WATER_IOR],
            /// What it is inside.
            filling: Filling = [fields::WATER_SIGMA_A, fields::WATER_INTERIOR, fields::PRIORITY, fields::WATER_DEPTH_COLOR],
            /// `None`: flat.
            waves: Option<Waves> = [fields::WATER_WAVES, fields::WATER_WAVES_SCALE, fields::WATER_WAVES_HEIGHT],
        }
        traits: {
            fn unmixable(&self) -> Option<&'static str> {
                Some(HAS_INSIDE)
            }

            fn inside(&self) -> Option<Inside> {
                // Water that names no medium may be a sea, open at its rim.
                Some(self.filling.inside).filter(|inside| inside.medium.is_some())
            }
        }
    }
    /// One of two materials, by chance.
    Mix "mix" {
        doc: "Two materials on one surface, each with its share: rust on steel, dust on varnish. A mask as \
             `amount` says where each one is. The parts may be mixes themselves, but must reflect and scatter \
             light at their surface: none may have an inside, give off light, be cut out or let light straight \
             through.",
        example: "material worn: mix { a = steel, b = clay, amount = noise(7) }",
        elsewhere: &[
        ("blend", "common use"),
        ("blendbsdf", "Mitsuba"),
        ("mix_shader", "Blender"),
        ("layered", "common use"),
    ],
        lints: Lints::NONE,
        fields: {
            /// The first.
            a: Ingredient = [fields::MIX_A],
            /// The second.
            b: Ingredient = [fields::MIX_B],
            /// Share of the second, 0 ..= 1.
            amount: Scalar = [fields::MIX_AMOUNT],
        }
        also: [projection::PROJECTION],
        traits: {}
    }
}
