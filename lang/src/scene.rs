//! The checked scene: plain data in SI units, ready to be lowered.
//!
//! Everything a `.rts` text says has been resolved when a `Scene` exists: names are indices, `like`
//! chains and indexed instances are expanded, expressions are numbers, units are metres, radians,
//! seconds and kelvins, colours are linear Rec. 709. It does not know files, meshes or the pack:
//! whether an asset can be read and has the named part is the compiler's business, and each item
//! carries the `Span` that such a later complaint must point at.
//!
//! Lists are sorted by name, so that the order of declarations in the text does not matter.

use crate::source::Span;

/// A whole checked scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Mesh files, sorted by name.
    pub assets: Vec<Asset>,
    /// Images, sorted by name.
    pub textures: Vec<Texture>,
    /// Materials, sorted by name.
    pub materials: Vec<Material>,
    /// Media of materials and of the atmosphere, sorted by name.
    pub media: Vec<Medium>,
    /// Things in the world, fully expanded (`beams[0]`, `beams[1]`, …), sorted by name, index order.
    pub instances: Vec<Instance>,
    /// Sphere lights declared with `light`, sorted by name.
    pub lights: Vec<Light>,
    /// What is seen where nothing is; `None` is black.
    pub sky: Option<Sky>,
    /// The camera that `render` names.
    pub camera: Camera,
    /// The film that `render` names.
    pub film: Film,
    /// The one `render` declaration.
    pub render: Render,
}

/// A name with the place where it was declared.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// The name as other declarations use it; imported names carry their prefix (`lantern.body`).
    pub text: String,
    /// Where it is declared.
    pub span: Span,
}

/// A mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct Asset {
    /// Declared name.
    pub name: Name,
    /// Path relative to the directory of the `.rts` file that declares it, as written.
    pub path: String,
    /// The path literal.
    pub path_span: Span,
    /// Which importer reads it.
    pub format: AssetFormat,
}

/// What a mesh file needs to be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AssetFormat {
    /// Wavefront OBJ: metres per unit of the file, and which axis points up.
    Obj {
        /// Metres per unit.
        metres_per_unit: f64,
        /// Up axis of the file.
        up: Axis,
    },
    /// glTF 2.0, text or binary: metres and +Y up by its specification.
    Gltf,
}

/// A signed coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// +x.
    PlusX,
    /// −x.
    MinusX,
    /// +y.
    PlusY,
    /// −y.
    MinusY,
    /// +z.
    PlusZ,
    /// −z.
    MinusZ,
}

/// An image file used by materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Declared name.
    pub name: Name,
    /// Path relative to the declaring `.rts` file, as written.
    pub path: String,
    /// The path literal.
    pub path_span: Span,
    /// How its numbers are to be read.
    pub space: ColorSpace,
    /// Outside 0..1 along u and v.
    pub wrap: [Wrap; 2],
}

/// Encoding of an image's colour channels; alpha is always linear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorSpace {
    /// sRGB transfer curve.
    Srgb,
    /// Linear colour.
    Linear,
    /// Linear numbers that are not colours: roughness, normals.
    Data,
}

/// What lies outside 0..1 of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The image repeats.
    Repeat,
    /// The edge texel goes on.
    Clamp,
    /// The image repeats mirrored.
    Mirror,
}

/// Linear Rec. 709 triple.
pub type Rgb = [f64; 3];

/// A colour that may come from an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Constant(Rgb),
    /// `.rgb` of a texture, index into `Scene::textures`.
    Texture(usize),
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
}

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Declared name.
    pub name: Name,
    /// Model and parameters.
    pub model: MaterialModel,
    /// Tilts the shading normal.
    pub normal: Option<NormalMap>,
}

/// An image of tangent-space normals, green up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// Index into `Scene::textures`.
    pub texture: usize,
    /// Factor on the tilt, 0 ..= 10.
    pub strength: f64,
}

/// How a material scatters and emits.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialModel {
    /// Lambert.
    Diffuse {
        /// Reflectance, 0 ..= 1.
        color: Color,
    },
    /// Mirror blurred by a ball of radius `fuzz`.
    Metal {
        /// Reflectance, 0 ..= 1.
        color: Color,
        /// 0 ..= 1.
        fuzz: f64,
    },
    /// Glass, smooth where the roughness is 0.
    Dielectric {
        /// Refractive index, >= 1.
        ior: f64,
        /// Perceptual roughness, 0 ..= 1.
        roughness: Scalar,
        /// What it is inside.
        inside: Inside,
    },
    /// Water.
    Water {
        /// Refractive index, >= 1.
        ior: f64,
        /// What it is inside; without a medium `sigma_a` and `depth_color` say that.
        inside: Inside,
        /// Absorption, per metre.
        sigma_a: Rgb,
        /// Radiance of what lies below the scene, seen from air.
        depth_color: Rgb,
        /// Scale of the waves' coordinates, and factor on their slopes; `None`: flat.
        waves: Option<[f64; 2]>,
    },
    /// Light source without scattering.
    Emissive {
        /// Colour, any non-negative value.
        color: Color,
        /// Factor on `color`: radiance in W/(m2 sr) up to the scene's own scale.
        strength: f64,
        /// Emits from the back side too.
        both_sides: bool,
    },
    /// glTF metallic-roughness.
    Principled(Principled),
    /// Rough metal.
    Conductor {
        /// Reflectance at normal incidence, 0 ..= 1.
        color: Color,
        /// Perceptual roughness, 0 ..= 1.
        roughness: Scalar,
        /// 0 round ..= 1 brushed along the tangent.
        anisotropy: f64,
        /// Gives back what single reflection loses.
        compensation: bool,
    },
    /// Clear coat over Lambert.
    Clearcoat {
        /// Reflectance of the base, 0 ..= 1.
        color: Color,
        /// Radius of the ball of the coat's mirror direction, 0 ..= 1.
        fuzz: f64,
        /// Refractive index of the coat, >= 1.
        coat_ior: f64,
        /// Factor on what the coat reflects.
        coat_tint: Rgb,
    },
    /// Rough, with bumps and veins.
    Stone {
        /// Reflectance, 0 ..= 1.
        color: Rgb,
        /// That of the veins.
        vein: Option<Rgb>,
        /// The field and its bumps.
        pattern: Pattern,
        /// Share of uncoloured gloss, 0 ..= 1.
        gloss: f64,
    },
    /// Rough, with bumps, rings and gloss along a grain.
    Wood {
        /// Reflectance of early wood, 0 ..= 1.
        color: Rgb,
        /// That of late wood.
        late: Option<Rgb>,
        /// Axis of the object along which the grain runs: 0 x, 1 y, 2 z.
        grain: usize,
        /// Where the text says so.
        grain_span: Span,
        /// The field and its bumps.
        pattern: Pattern,
        /// Share of uncoloured gloss, 0 ..= 1.
        gloss: f64,
        /// How far the gloss is stretched along the grain, 0 ..= 1.
        anisotropy: f64,
    },
    /// Rough thin sheet that lets light through.
    Fabric {
        /// Share of light that is not absorbed, 0 ..= 1.
        color: Color,
        /// The field and its bumps.
        pattern: Pattern,
        /// Perceptual roughness of the gloss, 0 ..= 1.
        roughness: f64,
        /// Share of uncoloured gloss, 0 ..= 1.
        gloss: f64,
        /// Share of the rest that goes through, 0 ..= 1.
        translucency: f64,
    },
    /// Thin sheet that lets light through.
    Leaf(Leaf),
    /// Fuzz and wax over a thin scattering layer.
    Petal(Petal),
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

/// Parameters of `MaterialModel::Leaf`.
#[derive(Clone, Debug, PartialEq)]
pub struct Leaf {
    /// Reflectance, 0 ..= 1.
    pub color: Color,
    /// Coverage.
    pub alpha: Scalar,
    /// Alpha below this is not there; `None` ignores alpha.
    pub alpha_clip: Option<f64>,
    /// Share of the light that goes through, 0 ..= 1.
    pub translucency: f64,
    /// Absorption, 1/m.
    pub sigma_a: Rgb,
    /// Metres.
    pub thickness: f64,
    /// Share of the light through that keeps its direction, 0 ..= 1.
    pub forward: f64,
    /// Mean cosine of that light's blur.
    pub g: f64,
    /// Share of leaves that are not there, 0 ..= 1.
    pub gap: f64,
}

/// Parameters of `MaterialModel::Petal`.
#[derive(Clone, Debug, PartialEq)]
pub struct Petal {
    /// Factor on the light from inside, 0 ..= 1.
    pub color: Color,
    /// Coverage.
    pub alpha: Scalar,
    /// Alpha below this is not there; `None` ignores alpha.
    pub alpha_clip: Option<f64>,
    /// Share of the fuzz, 0 ..= 1.
    pub fuzz_weight: f64,
    /// Radius of the ball of the fuzz, 0 ..= 1.
    pub fuzz: f64,
    /// Radius of the ball of the wax, 0 ..= 1.
    pub wax: f64,
    /// Refractive index.
    pub ior: f64,
    /// Absorption, 1/m.
    pub sigma_a: Rgb,
    /// Scattering, 1/m.
    pub sigma_s: f64,
    /// Mean cosine of scattering.
    pub g: f64,
    /// Metres, at the rim and in the middle.
    pub thickness: [f64; 2],
    /// Lean of the normals at the rim.
    pub pillow: f64,
    /// Lean of each petal.
    pub tilt: f64,
}

/// What fills things of a material that light goes through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inside {
    /// Index into `Scene::media`; `None` is clear.
    pub medium: Option<usize>,
    /// Of things that overlap the greatest is there.
    pub priority: u32,
}

/// What fills things, or the space around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// Declared name.
    pub name: Name,
    /// Model and parameters.
    pub model: MediumModel,
    /// As atmosphere: length of what lies between the scene and the sky, metres.
    pub sky_distance: f64,
}

/// What a medium does with light.
#[derive(Clone, Debug, PartialEq)]
pub enum MediumModel {
    /// Absorbs and scatters.
    Homogeneous {
        /// Absorption for each channel, per metre.
        sigma_a: Rgb,
        /// Scattering for each channel, per metre.
        sigma_s: Rgb,
        /// Mean cosine of scattering, -1 ..= 1.
        g: f64,
    },
    /// Hides light behind its own.
    Fog {
        /// Extinction, per metre.
        density: f64,
        /// Radiance where it is thick.
        color: Rgb,
    },
}

/// Parameters of `MaterialModel::Principled`.
#[derive(Clone, Debug, PartialEq)]
pub struct Principled {
    /// Base colour.
    pub color: Color,
    /// 0 dielectric … 1 metal.
    pub metallic: Scalar,
    /// Perceptual roughness 0 ..= 1.
    pub roughness: Scalar,
    /// Refractive index of the dielectric part.
    pub ior: f64,
    /// Factor on the reflectance of the dielectric part, 0 ..= 1.
    pub specular: Scalar,
    /// Colour of that reflectance at normal incidence, any non-negative value.
    pub specular_color: Color,
    /// Share under a clear coat, 0 ..= 1.
    pub coat: Scalar,
    /// Perceptual roughness of the coat, 0 ..= 1.
    pub coat_roughness: Scalar,
    /// Share of the light entering that goes through the sheet, 0 ..= 1.
    pub transmission: Scalar,
    /// Emitted colour.
    pub emission: Color,
    /// Factor on `emission`.
    pub emission_strength: f64,
    /// Coverage.
    pub alpha: Scalar,
    /// Alpha below this is not there; `None` ignores alpha.
    pub alpha_clip: Option<f64>,
}

/// A thing in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Name, with its index for indexed instances.
    pub name: Name,
    /// What it is.
    pub shape: Shape,
    /// Where the shape expression stands in the text.
    pub shape_span: Span,
    /// Index into `Scene::materials`; `None` takes the asset's own materials.
    pub material: Option<usize>,
    /// Where the material is named, if it is.
    pub material_span: Option<Span>,
    /// Rows of the 3x4 matrix `world_from_object`, metres: scale first, then rotate (about x, then
    /// y, then z), then translate; the objects an instance is nested in come after.
    pub world_from_object: [[f64; 4]; 3],
    /// World frame, metres per second; `world_from_object` is that of the moment 0.
    pub velocity: [f64; 3],
}

/// Geometry of an instance, object frame, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Sphere around the origin.
    Sphere {
        /// Radius, > 0.
        radius: f64,
    },
    /// Rectangle in the xz plane around the origin, normal +y.
    Rectangle {
        /// Sizes along x and z.
        size: [f64; 2],
    },
    /// Box around the origin.
    Box {
        /// Sizes along x, y, z.
        size: [f64; 3],
    },
    /// A mesh file, or one named part of it (OBJ group or object; glTF node or mesh).
    Mesh {
        /// Index into `Scene::assets`.
        asset: usize,
        /// Name of the part as written after the dot; `None` is the whole file.
        part: Option<String>,
    },
}

/// A sphere light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Declared name.
    pub name: Name,
    /// Centre at the moment 0, world frame, metres.
    pub center: [f64; 3],
    /// World frame, metres per second.
    pub velocity: [f64; 3],
    /// Radius, metres, > 0.
    pub radius: f64,
    /// Radiance, W/(m2 sr) up to the scene's own scale.
    pub radiance: Rgb,
    /// What colours part of its light.
    pub tint: Option<Tint>,
}

/// A factor on the light of a sphere light by the direction from which it comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// The factor.
    pub color: Rgb,
    /// Largest angle between a tinted ray towards the light and `direction`, radians, 0 .. pi.
    pub angle: f64,
    /// Unit vector towards the light, world frame.
    pub direction: [f64; 3],
}

/// What a ray sees that leaves the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Declared name.
    pub name: Name,
    /// Where its radiance comes from.
    pub model: SkyModel,
}

/// Sky models; all colours are radiance.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyModel {
    /// One radiance for every direction.
    Constant(Rgb),
    /// Bands over the sine of the elevation: `zenith` at 1, `horizon` at `blend_low`, `middle` at
    /// `blend_high` of the way between them, `ground` from `blend_ground` below `blend_low` downwards;
    /// plus glow and disc around `sun_direction`.
    Gradient {
        /// Straight up.
        zenith: Rgb,
        /// Between horizon and zenith.
        middle: Rgb,
        /// At sine `blend_low`.
        horizon: Rgb,
        /// Lowest.
        ground: Rgb,
        /// Share of the height from `blend_low` to the zenith, in (0, 1).
        blend_high: f64,
        /// Sine of the elevation, in (-1, 1).
        blend_low: f64,
        /// How much below `blend_low` the ground is reached, > 0; beyond -1 it is not quite.
        blend_ground: f64,
        /// Unit vector towards the sun.
        sun_direction: [f64; 3],
        /// Added radiance, times `cos^glow_power`.
        glow: Rgb,
        /// Exponent, >= 1.
        glow_power: f64,
        /// Added radiance, times `cos^disc_power`.
        disc: Rgb,
        /// Exponent, >= 1.
        disc_power: f64,
    },
    /// A lat-long image: its middle towards -z, its right half towards +x, its top row straight up.
    Image {
        /// Path relative to the directory of the `.rts` file that declares it, as written.
        path: String,
        /// The path literal.
        path_span: Span,
        /// Turn about +y, radians, right-handed.
        rotate: f64,
        /// Factor on the radiance in the image.
        strength: f64,
    },
}

/// A perspective camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Declared name.
    pub name: Name,
    /// Eye, metres.
    pub from: [f64; 3],
    /// Point in the middle of the image, metres.
    pub to: [f64; 3],
    /// Which way is up in the image; not parallel to the view.
    pub up: [f64; 3],
    /// Horizontal field of view at the film's aspect ratio, radians.
    pub fov_horizontal: f64,
    /// Vertical field of view at the film's aspect ratio, radians.
    pub fov_vertical: f64,
    /// Radius of the lens, metres; 0 is a pinhole.
    pub lens_radius: f64,
    /// Distance to the plane of focus, metres, > 0.
    pub focus_distance: f64,
    /// Shutter opens and closes, seconds relative to the frame.
    pub shutter: [f64; 2],
}

/// What the picture is written to.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Declared name.
    pub name: Name,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Stops; the PNG is multiplied by `2^exposure`.
    pub exposure: f64,
    /// Response of the PNG.
    pub tone_map: ToneMap,
}

/// Film response of the PNG; the EXR is always linear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToneMap {
    /// sRGB encoding only.
    None,
    /// `x / (1 + x)`.
    Reinhard,
    /// Filmic.
    Aces,
}

/// Where random numbers come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampler {
    /// Owen-scrambled Sobol pairs.
    Sobol,
    /// Independent numbers.
    Pcg,
}

/// How the picture is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Render {
    /// Declared name.
    pub name: Name,
    /// What is between things: index into `Scene::media`.
    pub atmosphere: Option<usize>,
    /// Samples per pixel.
    pub samples: u32,
    /// Longest path in segments.
    pub max_depth: u32,
    /// Bounce from which Russian roulette may end a path.
    pub roulette_depth: u32,
    /// Seed of the image.
    pub seed: u32,
    /// Where random numbers come from.
    pub sampler: Sampler,
    /// Where the picture goes, as written; relative to the working directory of `rtr`.
    pub output: Option<String>,
}
