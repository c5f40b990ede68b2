//! Small scenes, each about one feature of the kernel, and one with all of them; and how the sample function of
//! each kind of material is called.

use std::path::Path;

use compiler::bvh::Layout;
use compiler::lower::Instancing;
use compiler::pipeline::Compiled;
use glam::{Vec2, Vec3};
use lang::scene::Scene;
use pack::abi::MaterialKind;
use pack::{Checked, Pack};
use runtime::kernel::f32 as single;

use crate::kernel::Lobe;

/// A scene that exercises one feature.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// What it is about.
    pub name: &'static str,
    /// Sky, lights and things.
    parts: &'static [&'static str],
    /// Type of the camera, and how much it sees.
    view: [&'static str; 2],
    /// Fields of the camera beyond the usual.
    camera: &'static str,
    /// Fields of the film beyond its size, each behind a comma.
    film: &'static str,
    /// Fields of the render beyond the usual, each behind a comma.
    render: &'static str,
}

const fn case(name: &'static str, parts: &'static [&'static str]) -> Case {
    Case { name, parts, view: PERSPECTIVE, camera: "", film: "", render: "" }
}

/// Every feature of the kernel.
pub const CASES: &[Case] = &[
    // Without geometry, without a sky, with one sort of geometry.
    case("sky alone", &[SKY]),
    Case { camera: LENS, ..case("gradient sky alone, through a lens", &[GRADIENT]) },
    case("image sky alone", &[PANORAMA]),
    case("spheres alone", &[SKY, CLAY, BALL]),
    case("triangles alone", &[SKY, CLAY, BOX]),
    case("black sky", &[SPHERE_LIGHT, CLAY, BALL, FLOOR]),
    Case { camera: LENS, ..case("lens", &[SKY, CLAY, BALL, FLOOR]) },
    // Other cameras.
    Case {
        view: ORTHOGRAPHIC,
        camera: SHUTTER,
        ..case("orthographic camera", &[GRADIENT, PLASTIC, MOVING_BALL, FLOOR])
    },
    Case { view: ORTHOGRAPHIC, ..case("orthographic camera of the sky", &[GRADIENT]) },
    Case { view: PANORAMIC, ..case("panoramic camera", &[GRADIENT, CLAY, BALL, TENT, FLOOR]) },
    Case { view: PANORAMIC, ..case("panoramic camera of the sky", &[PANORAMA]) },
    Case { camera: BLADES, ..case("aperture blades", &[SKY, CLAY, BALL, FLOOR]) },
    // Pixel filters.
    Case { film: ", filter.width = 2.5px", ..case("box filter", &[GRADIENT, CLAY, BALL]) },
    Case { film: ", filter = tent", ..case("tent filter", &[GRADIENT, CLAY, BALL, FLOOR]) },
    Case { film: ", filter = gaussian", ..case("gaussian filter", &[GRADIENT, CLAY, BALL]) },
    Case {
        film: ", filter = blackman_harris",
        ..case("Blackman-Harris filter", &[GRADIENT, CLAY, BALL, FLOOR])
    },
    Case { film: ", filter = tent", ..case("tent filter of the sky", &[GRADIENT]) },
    Case {
        render: ", depth = unlimited",
        ..case("unlimited depth", &[SKY, LAMP, PANEL, CLAY, BALL, FLOOR])
    },
    // The other sampler, at everything that draws numbers, and in the kernel without geometry.
    Case { camera: LENS_AND_SHUTTER, render: PCG, ..case("independent samples", DRAWS) },
    Case { render: PCG, ..case("independent samples of the sky", &[GRADIENT]) },
    // Materials.
    case("diffuse", &[GRADIENT, CLAY, BALL, FLOOR]),
    case("mirror", &[GRADIENT, "material m: metal { color = linear(0.9) }\n", BALL, TENT, FLOOR]),
    case(
        "metal",
        &[SKY, "material m: metal { color = linear(0.9, 0.7, 0.4), fuzz = 0.3 }\n", BALL, FLOOR],
    ),
    case(
        "metal of the largest ball",
        &[SKY, "material m: metal { color = linear(0.9), fuzz = 1 }\n", BALL],
    ),
    case("dielectric", &[GRADIENT, "material m: dielectric { ior = 1.5 }\n", BALL, TENT, FLOOR]),
    case(
        "dielectric that hardly bends",
        &[SKY, "material m: dielectric { ior = 1.0001 }\n", BALL, FLOOR],
    ),
    case("emissive, both sides", &[LAMP_BOTH, PANEL, CLAY, BALL, FLOOR]),
    case(
        "smooth plastic",
        &[GRADIENT, "material m: principled { roughness = 0, ior = 1.8 }\n", BALL, FLOOR],
    ),
    case(
        "rough plastic",
        &[GRADIENT, "material m: principled { roughness = 0.35 }\n", BALL, TENT, FLOOR],
    ),
    case(
        "smooth metal",
        &[SKY, "material m: principled { metallic = 1, roughness = 0.02 }\n", BALL, FLOOR],
    ),
    case(
        "rough metal",
        &[GRADIENT, "material m: principled { metallic = 1, roughness = 1 }\n", BALL, FLOOR],
    ),
    case("half metal that glows", &[SKY, GLOWING, BALL, FLOOR]),
    // Patterns: on flat and on bent surfaces, on turned things, in both directions through a sheet.
    case("stone", &[GRADIENT, SPHERE_LIGHT, STONE, BALL, BOX, TENT, FLOOR]),
    case("stone without bumps, on spheres alone", &[SKY, SMOOTH_STONE, BALL]),
    case("wood along x", &[GRADIENT, SPHERE_LIGHT, WOOD_X, BALL, BOX, FLOOR]),
    case("wood along y", &[SKY, SPHERE_LIGHT, WOOD_Y, BALL, MIRRORED, FLOOR]),
    case("wood along z", &[GRADIENT, LAMP, PANEL, WOOD_Z, BALL, TENT, FLOOR]),
    case("fabric", &[SPHERE_LIGHT, LAMP, PANEL, PAINT, FABRIC, BALL, QUILT, FLOOR]),
    case("opaque fabric", &[GRADIENT, FELT, BALL, TENT]),
    case("bumps as steep as walls", &[GRADIENT, SPHERE_LIGHT, CRAGS, BALL, TENT, FLOOR]),
    case("every pattern", &[GRADIENT, SPHERE_LIGHT, PAINT, PATTERNS, FLOOR]),
    case("conductor", &[GRADIENT, SPHERE_LIGHT, GOLD, BALL, TENT, FLOOR]),
    case("conductor without compensation", &[SKY, IRON, BALL, FLOOR]),
    case("conductor so smooth that it is a mirror", &[GRADIENT, CHROME, BALL, TENT]),
    case("brushed conductor", &[GRADIENT, SPHERE_LIGHT, BRUSHED, BALL, TENT, FLOOR]),
    case("brushed spheres alone", &[GRADIENT, SPHERE_LIGHT, BRUSHED, BALL]),
    case("worn conductor", &[SKY, LAMP, PANEL, WEAR, PAINT, WORN_METAL, BALL, QUILT]),
    case("rough dielectric", &[GRADIENT, SPHERE_LIGHT, FROSTED, BALL, TENT, FLOOR]),
    case("rough dielectric of a texture", &[SKY, LAMP, PANEL, WEAR, WORN_GLASS, BALL, QUILT]),
    case("clearcoat", &[GRADIENT, SPHERE_LIGHT, LACQUER, BALL, TENT, FLOOR]),
    case("clearcoat with gloss", &[SKY, LAMP, PANEL, GLAZE, BALL, FLOOR]),
    case("mix", &[GRADIENT, SPHERE_LIGHT, SPECKLED, BALL, TENT, FLOOR]),
    case("mix of mixes by a mask", &[SKY, LAMP, PANEL, WEAR, MASKED, BALL, QUILT]),
    case("leaf", &[GRADIENT, SPHERE_LIGHT, LEAF, BALL, TENT, FLOOR]),
    case("petal", &[GRADIENT, SPHERE_LIGHT, PETAL, BALL, TENT, FLOOR]),
    // Lights, seen by each sort of lobe.
    case("sphere light on plastic", &[SPHERE_LIGHT, PLASTIC, BALL, FLOOR]),
    case("sphere light on metal", &[SPHERE_LIGHT, SKY, FUZZY, BALL, FLOOR]),
    case("rectangle light on plastic", &[LAMP, PANEL, PLASTIC, BALL, FLOOR]),
    case("rectangle light on metal", &[LAMP, PANEL, GRADIENT, FUZZY, BALL, FLOOR]),
    case("triangle lights", &[LAMP, GLOWING_TENT, PLASTIC, BALL, FLOOR]),
    case(
        "lights of every kind",
        &[LAMP, PANEL, GLOWING_TENT, SPHERE_LIGHT, SKY, PLASTIC, BALL, FLOOR],
    ),
    case("light with a picture and holes", &[WEAR, PAINT, LACE_LAMP, PANEL, CLAY, BALL, FLOOR]),
    // The sky as a light.
    case("image sky", &[PANORAMA, PLASTIC, BALL, FLOOR]),
    case("image sky on metal", &[PANORAMA, FUZZY, BALL, TENT, FLOOR]),
    case(
        "image sky and other lights",
        &[PANORAMA, SPHERE_LIGHT, LAMP, PANEL, PLASTIC, BALL, FLOOR],
    ),
    case("clear sky and its sun", &[DAY, PLASTIC, BALL, FLOOR]),
    case("a picture as the sky, turned", &[POSTCARD, CLAY, BALL, FLOOR]),
    case("gradient sky without a sun", &[BANDS, PLASTIC, BALL, FLOOR]),
    case("tinted light", &[TINTED, SKY, PLASTIC, BALL, FLOOR]),
    case("spot light", &[SPOT, PLASTIC, BALL, FLOOR]),
    case("luminaire", &[LUMINAIRE, PLASTIC, BALL, FLOOR]),
    case("mesh lights", &[SIGN, PLASTIC, BALL, FLOOR]),
    case("disk light", &[DISH, PLASTIC, BALL, FLOOR]),
    case("lights that the camera does not see", &[UNSEEN, SKY, FUZZY, BALL, FLOOR]),
    case(
        "sky and sun that the camera does not see",
        &[UNSEEN_SKY, UNSEEN_SUN, MIRROR, BALL, FLOOR],
    ),
    case("sun that nobody sees", &[GRADIENT, UNSEEN_SUN]),
    case("spot light and other lights", &[SPOT, TINTED, LAMP, PANEL, SKY, FUZZY, BALL, FLOOR]),
    case("directional light alone", &[SUN_AHEAD]),
    case("directional light behind a sky", &[GRADIENT, SUN_AHEAD]),
    case("directional light", &[SUN, PLASTIC, BALL, FLOOR]),
    case("directional lights over an image sky", &[PANORAMA, SUN, SUN_AHEAD, FUZZY, BALL, FLOOR]),
    case(
        "directional lights, a tree of lights and the sky",
        &[PANORAMA, SUN, SUN_AHEAD, LAMP, PANEL, MANY_LAMPS, SPARKS, FUZZY, BALL, FLOOR],
    ),
    case("tree of lights", &[LAMP, MANY_LAMPS, PLASTIC, BALL, FLOOR]),
    case(
        "tree of lights of every kind and the sky",
        &[PANORAMA, TINTED, LAMP_BOTH, PANEL, MANY_LAMPS, SPARKS, FUZZY, BALL, FLOOR],
    ),
    case("gradient sky and a sphere light", &[GRADIENT, SPHERE_LIGHT, PLASTIC, BALL, FLOOR]),
    // Textures.
    case("sRGB texture, repeated", &[SKY, PAINT, PAINTED, BALL, QUILT]),
    case("texture on spheres alone", &[SKY, PAINT, PAINTED, BALL]),
    case("linear texture, mirrored", &[SKY, WEAR, WORN, BALL, QUILT]),
    case("half-float texture, clamped", &[SKY, GLOW, NEON, BALL, QUILT]),
    case("mixed wraps, without spheres", &[SKY, MIXED, PAINTED, QUILT]),
    case("all formats", &[GRADIENT, PAINT, WEAR, GLOW, BUMPS, MANY, BALL, QUILT, FLOOR]),
    // Textures that are computed: with images and without, every operation; placed, as colours and as normals.
    case("texture expressions", &[SKY, SPHERE_LIGHT, PAINT, WEAR, WOVEN, BALL, QUILT]),
    case("patterns alone", &[SKY, TILED, BALL, FLOOR]),
    case("computed holes", &[SKY, WEAR, GRATE, TENT, FLOOR]),
    case("computed glow", &[PAINT, GLOWING_TILES, PANEL, CLAY, BALL, FLOOR]),
    case("placed textures", &[GRADIENT, SPHERE_LIGHT, PLACED, BALL, TENT, QUILT]),
    // Colours of vertices: of the file's material and of others, stored once and not, and where there are none.
    case("vertex colours", &[GRADIENT, SPHERE_LIGHT, PAINT, STAINED_SHELLS, BALL, FLOOR]),
    case("vertex colours alone", &[SKY, OWN_SHELL]),
    case("vertex colours of lights and of holes", &[WEAR, STAINED_LAMP, CLAY, BALL, FLOOR]),
    // Projected: without texture coordinates, on what is stretched, mirrored, stored once and turns; through a sheet.
    case(
        "projected textures",
        &[GRADIENT, SPHERE_LIGHT, PAINT, BUMPS, WRAPPED, BALL, BOX, MIRRORED, FLOOR],
    ),
    case("textures projected on instances", &[SKY, PAINT, BUMPS, CARVED, BEADS, FLOOR]),
    Case {
        camera: SHUTTER,
        ..case(
            "a projected pane that turns",
            &[GRADIENT, SPHERE_LIGHT, PAINT, WEAR, STAINED, CLAY_FLOOR],
        )
    },
    // Cut out, mirrored, interpolated.
    case("alpha on spheres", &[SKY, WEAR, LACE, BALL, FLOOR]),
    case("alpha on triangles", &[GRADIENT, SPHERE_LIGHT, WEAR, LACE, TENT, FLOOR]),
    case("partial coverage", &[GRADIENT, SPHERE_LIGHT, GAUZE, BALL, TENT, FLOOR]),
    case("partial coverage on spheres", &[SKY, GAUZE, BALL]),
    case(
        "partial coverage from a picture, and holes",
        &[GRADIENT, LAMP, PANEL, FADE, VEIL, LACE_SHEET, BALL, TENT, FLOOR],
    ),
    case("partial coverage in instances", &[SKY, SPHERE_LIGHT, FADE, VEIL, BEADS, FLOOR]),
    case(
        "lights of partial coverage",
        &[FADE, PAINT, VEIL_LAMP, PANEL, GLOWING_TENT, CLAY, BALL, FLOOR],
    ),
    Case {
        render: PCG,
        ..case(
            "partial coverage, independent samples",
            &[GRADIENT, SPHERE_LIGHT, GAUZE, TENT, FLOOR],
        )
    },
    case("smooth normals", &[GRADIENT, SPHERE_LIGHT, PLASTIC, TENT, FLOOR]),
    case("mirrored instances", &[GRADIENT, SPHERE_LIGHT, PLASTIC, MIRRORED, FLOOR]),
    // Meshes that are stored once: mirrored, sheared, alone, and with everything that can be hit in the world.
    case("instances", &[GRADIENT, SPHERE_LIGHT, PLASTIC, BEADS, FLOOR]),
    case("instances alone", &[SKY, CLAY, BEADS]),
    case(
        "instances, brushed and of their own material",
        &[GRADIENT, BRUSHED, BEADS, PLAIN_BEAD, BALL],
    ),
    case(
        "instances with normal maps",
        &[GRADIENT, SPHERE_LIGHT, BUMPS, BUMPY_PLASTIC, BEADS, QUILT, FLOOR],
    ),
    case("cut-out instances", &[SKY, SPHERE_LIGHT, WEAR, LACE, BEADS, FLOOR]),
    case("instances of wood", &[GRADIENT, SPHERE_LIGHT, WOOD_X, BEADS, FLOOR]),
    case("instances of glass, filled", &[GRADIENT, SPHERE_LIGHT, INK, FILLED, BEADS, FLOOR]),
    case("instances inside each other", &[GRADIENT, SPHERE_LIGHT, INK, MILK, NESTED_BEADS, FLOOR]),
    case("instances of petals", &[GRADIENT, SPHERE_LIGHT, FLAT_PETAL, BEADS, FLOOR]),
    Case {
        camera: SHUTTER,
        ..case("moving instances", &[GRADIENT, SPHERE_LIGHT, PLASTIC, MOVING_BEADS, FLOOR])
    },
    // Layers of principled surfaces, smooth and rough, with and without textures.
    case("coat", &[GRADIENT, SPHERE_LIGHT, COATED, BALL, TENT, FLOOR]),
    case("smooth coat", &[GRADIENT, SPHERE_LIGHT, VARNISH, BALL, FLOOR]),
    case("sheen", &[GRADIENT, SPHERE_LIGHT, VELVETY, BALL, TENT, FLOOR]),
    case("woven sheen", &[GRADIENT, SPHERE_LIGHT, PAINT, WEAR, SHOT_SILK, BALL, TENT, FLOOR]),
    case("brushed plastic", &[GRADIENT, SPHERE_LIGHT, BRUSHED_PLASTIC, BALL, TENT, FLOOR]),
    case("specular colour", &[GRADIENT, SPHERE_LIGHT, SILK, BALL, FLOOR]),
    case("pane", &[GRADIENT, SPHERE_LIGHT, PANE, BALL, TENT, FLOOR]),
    case("frosted pane", &[GRADIENT, SPHERE_LIGHT, FROSTED_PANE, BALL, TENT, FLOOR]),
    case(
        "every layer, textured",
        &[GRADIENT, LAMP, PANEL, PAINT, WEAR, BUMPS, LAYERED, BALL, QUILT, FLOOR],
    ),
    // Normal maps: steep, over mirrored coordinates and interpolated normals, from both sides.
    case(
        "normal map on plastic",
        &[GRADIENT, SPHERE_LIGHT, BUMPS, BUMPY_PLASTIC, BALL, TENT, QUILT, FLOOR],
    ),
    case(
        "normal map, mirrored",
        &[GRADIENT, SPHERE_LIGHT, BUMPS, BUMPY_CLAY, MIRRORED, QUILT_BACK],
    ),
    case("normal map on a mirror", &[GRADIENT, BUMPS, BUMPY_MIRROR, BALL, TENT]),
    case("normal map on glass", &[GRADIENT, BUMPS, BUMPY_GLASS, BALL, FLOOR]),
    // Media.
    case("fog", &[GRADIENT, SPHERE_LIGHT, MIST, CLAY, BALL, FLOOR]),
    case("smoke", &[SKY, SPHERE_LIGHT, SMOKE, CLAY, BALL, TENT, FLOOR]),
    case("smoke without lights", &[GRADIENT, SMOKE, GLASSY, BALL]),
    case("coloured glass", &[SKY, SPHERE_LIGHT, INK, FILLED, BALL, FLOOR]),
    case("milk behind a surface that is not there", &[SKY, SPHERE_LIGHT, MILK, FOGGY, BALL, FLOOR]),
    case("media inside each other", &[GRADIENT, SPHERE_LIGHT, INK, MILK, NESTED, FLOOR]),
    case("water", &[GRADIENT, SPHERE_LIGHT, POND, CLAY, BALL, FLOOR]),
    case("sea", &[GRADIENT, SPHERE_LIGHT, SEA, CLAY, BALL]),
    case("priorities alone", &[GRADIENT, LAMP, PANEL, PRIORITIES, FLOOR]),
    // Light linking: of what moves, of media and of air; beside one other light, and in a tree.
    case("a linked light", &[GRADIENT, LINKED, PLASTIC, BALL, TENT, FLOOR]),
    case("linked lights and media", &[SKY, LINKED, LINKED_SUN, SMOKE, INK, FILLED, BALL, FLOOR]),
    // Things that move while the shutter is open.
    Case { camera: SHUTTER, ..case("moving sphere", &[GRADIENT, PLASTIC, MOVING_BALL, FLOOR]) },
    Case { camera: SHUTTER, ..case("moving box alone", &[SKY, CLAY, MOVING_BOX]) },
    Case {
        camera: SHUTTER,
        ..case("moving cut-outs", &[SKY, SPHERE_LIGHT, WEAR, LACE, MOVING_BALL, MOVING_TENT, FLOOR])
    },
    Case {
        camera: SHUTTER,
        ..case(
            "moving lights",
            &[LAMP, MOVING_PANEL, MOVING_SHADE, MOVING_LIGHT, PLASTIC, BALL, FLOOR],
        )
    },
    Case {
        camera: SHUTTER,
        ..case(
            "moving light with a picture and holes",
            &[WEAR, PAINT, LACE_LAMP, MOVING_PANEL, CLAY, MOVING_BALL, FLOOR],
        )
    },
    // From key to key: bent ways, turns about one axis and several, in the world and stored once; the camera alone.
    Case { camera: SHUTTER, ..case("keys of a ball", &[GRADIENT, PLASTIC, KEYED_BALL, FLOOR]) },
    Case {
        camera: SHUTTER,
        ..case(
            "keys of patterns and pictures",
            &[GRADIENT, LAMP, KEYED_PANEL, BUMPS, BUMPY_PLASTIC, KEYED_TENT, KEYED_LOG, FLOOR],
        )
    },
    Case {
        camera: SHUTTER,
        ..case("keys of instances", &[GRADIENT, SPHERE_LIGHT, BRUSHED, KEYED_BEADS, FLOOR])
    },
    Case { camera: KEYED_VIEW, ..case("keys of the camera", &[GRADIENT, CLAY, BALL, FLOOR]) },
    Case { camera: KEYED_VIEW, ..case("keys of the camera of the sky", &[GRADIENT]) },
    Case { camera: BLADES_AND_SHUTTER, render: ", depth = unlimited", ..case("all", ALL) },
];

const ALL: &[&str] = &[
    GRADIENT,
    TINTED,
    LINKED,
    SPOT,
    SUN,
    LAMP,
    MOVING_PANEL,
    MANY_LAMPS,
    WEAR,
    PAINT,
    GLOW,
    BUMPS,
    MANY,
    ALL_THINGS,
    PATTERNS,
    MILK,
    NESTED_BALLS,
    MIST,
    POND,
    ALL_BEADS,
    OWN_SHELL,
    KEYED_CRATE,
    FLOOR,
];

/// Something of everything that draws random numbers.
const DRAWS: &[&str] =
    &[GRADIENT, SPHERE_LIGHT, LAMP, PANEL, BRUSHED, MOVING_BALL, MILK, NESTED_BALLS, SAKURA, FLOOR];

const PCG: &str = ", sampler = pcg";

const PERSPECTIVE: [&str; 2] = ["perspective", "fov.vertical = 42deg"];
const ORTHOGRAPHIC: [&str; 2] = ["orthographic", "height = 4m"];
const PANORAMIC: [&str; 2] = ["panoramic", "fov.horizontal = 270deg"];
const LENS: &str = "  aperture = 40cm\n  focus = 5m\n";
const BLADES: &str = "  aperture = 40cm\n  focus = 3m\n  blades = 5\n  rotation = 20deg\n";
const SHUTTER: &str = "  shutter = -5ms..15ms\n";
const KEYED_VIEW: &str = "  aperture = 20cm
  shutter = -5ms..15ms
  from = [-9ms: (0.5, 1.8, 5)m, 2ms: (0.7, 1.8, 5)m, 15ms: (0.7, 2.2, 4.5)m]
  to = [0ms: (0, 0.9, 0)m, 12ms: (-0.4, 0.8, 0)m]\n";
const BLADES_AND_SHUTTER: &str = "  aperture = 40cm
  focus = 5m
  blades = 7
  shutter = 0ms..20ms
  from = [0ms: (0.5, 1.8, 5)m, 9ms: (0.6, 1.8, 5)m]
  to = (0, 0.9, 0)m\n";
const LENS_AND_SHUTTER: &str = "  aperture = 40cm\n  focus = 5m\n  shutter = 0ms..20ms\n";

const SKY: &str = "sky day: constant { color = linear(0.6, 0.8, 1.0) }\n";
const GRADIENT: &str = "sky day: gradient {
  sun.direction = (0.3, 0.5, 0.4)
  glow.color = linear(0.5, 0.3, 0.1)
  disc.color = linear(20)
}\n";

const BANDS: &str = "sky day: gradient { blend.high = 0.6, blend.low = 0.1, base = 2 }\n";
/// A sun of one texel over a dim sky.
const PANORAMA: &str = "sky garden: image { file = \"panorama.exr\", strength = 0.5 }\n";
const DAY: &str =
    "sky day: sun_sky { sun.direction = (0.8, 0.7, 0.3), turbidity = 2, strength = 0.02 }\n";
const POSTCARD: &str = "sky card: image { file = \"paint.png\", rotate = 200deg }\n";

const SPHERE_LIGHT: &str = "light bulb: sphere { center = (2, 4, 2)m, radius = 30cm, color = blackbody(3200K), strength = 20 }\n";
const TINTED: &str = "light bulb: sphere {
  center = (2, 4, 2)m
  radius = 90cm
  strength = 5
  tint.color = linear(1, 0.65, 0.22)
  tint.angle = 14deg
}\n";
const LINKED: &str = "light rim: rectangle { at = (-2, 3, 1)m, to = (0, 1, 0)m, size = (1, 1)m, strength = 6, except = floor }\n";
const LINKED_SUN: &str = "light key: directional { direction = (1, 2, 1), angular_diameter = 4deg, strength = 200, only = [floor, ball] }\n";
const SPOT: &str = "light stage: spot { at = (1, 4, 2)m, to = (0, 0.5, 0)m, cone = 20deg, edge = 8deg, radius = 20cm, power = 4000lm }\n";
const LUMINAIRE: &str = "texture wash = image(\"wash.ies\", space: linear)
light lamp: point { at = (1, 3, 1)m, to = (0, 0.5, 0)m, profile = wash, radius = 5cm, spin = 20deg }\n";
const SIGN: &str = "asset crown = obj(\"tent.obj\", unit: m, up: +y)
light sign: mesh { shape = box(size: (1.4, 0.1, 0.1)m), at = (0, 2, 0)m, strength = 900nit }
light crown_light: mesh { shape = crown, at = (1, 1.5, 0)m, scale = 0.4, temperature = 3000K, strength = 5, sides = front }\n";
const DISH: &str =
    "light dish: disk { at = (0.5, 3, 1)m, to = (0, 0.5, 0)m, radius = 60cm, power = 4klm }\n";
/// Above the ball, in the picture.
const UNSEEN: &str = "light bulb: point { at = (-0.8, 1.4, 0)m, radius = 30cm, power = 40W, visible = off }
light panel: rectangle { at = (1, 1.6, -1)m, to = (0, 0.5, 0)m, size = (1, 1)m, power = 30W, visible = off }\n";
const UNSEEN_SKY: &str = "sky day: gradient { sun.direction = (0.3, 0.5, 0.4), disc.color = linear(20), visible = off }\n";
/// As [`SUN_AHEAD`].
const UNSEEN_SUN: &str = "light ahead: directional { direction = (-0.2, -0.1, -1), angular_diameter = 30deg, strength = 0.5, visible = off }\n";
const MIRROR: &str = "material m: metal { color = linear(0.9) }\n";
const SUN: &str = "light sun: directional { direction = (1, 2, 1), angular_diameter = 4deg, illuminance = 4W/m2, temperature = 4500K }\n";
/// Where the camera looks, and half the sky wide.
const SUN_AHEAD: &str = "light ahead: directional { direction = (-0.2, -0.1, -1), angular_diameter = 30deg, color = linear(0.3, 0.4, 0.9), strength = 0.5 }\n";
const MANY_LAMPS: &str = "asset canopy = obj(\"tent.obj\", unit: m, up: +y)
instance shade[i in 0..6] { shape = canopy, material = lamp, at = (i - 2.5, 2.2 + 0.3 * i, 0.5)m, scale = 0.4 }\n";
const SPARKS: &str = "instance spark[i in 0..5] { shape = sphere(radius: 5cm), material = lamp, at = (i - 2, 0.3, 2)m }\n";
const LAMP: &str =
    "material lamp: emissive { color = linear(1, 0.9, 0.7), strength = 8, sides = front }\n";
const LAMP_BOTH: &str = "material lamp: emissive { color = linear(0.7, 0.9, 1), strength = 8 }\n";
const PANEL: &str = "instance panel {
  shape = rectangle(size: (2, 1)m)
  material = lamp
  rotate = (180, 0, 30)deg
  at = (0, 4, 0)m
}\n";
const GLOWING_TENT: &str = "asset canopy = obj(\"tent.obj\", unit: m, up: +y)
instance shade { shape = canopy, material = lamp, at = (-1, 2.5, 0.5)m }\n";
const LACE_LAMP: &str = "material lamp: principled {
  color = linear(0.2)
  emission.color = paint.rgb
  emission.strength = 6
  alpha = wear.a
  alpha.clip = 50%
}\n";

const MIST: &str = "medium mist: fog { visibility = 40m, color = linear(0.3, 0.4, 0.5) }\n";
const SMOKE: &str = "medium smoke: homogeneous { sigma_a = (0.01, 0.02, 0.05)/m, sigma_s = (0.1, 0.2, 0.4)/m, g = 0.6, sky_distance = 9m }\n";
const INK: &str = "medium ink: homogeneous { sigma_a = (0.2, 0.9, 2)/m }\n";
const MILK: &str = "medium milk: homogeneous { mean_free_path = (0.4, 0.3, 0.2)m, albedo = linear(0.99, 0.9, 0.8), g = -0.3 }\n";
const GLASSY: &str = "material m: dielectric { ior = 1.5 }\n";
const FILLED: &str = "material m: dielectric { ior = 1.5, interior = ink }\n";
const FOGGY: &str = "material m: dielectric { ior = 1, interior = milk }\n";
const NESTED: &str = "material m: dielectric { ior = 1.5, interior = ink, priority = 2 }
material n: dielectric { ior = 1.33, interior = milk, priority = 1 }
material o: dielectric { ior = 1, priority = 3 }
instance ball { shape = sphere(radius: 1m), material = n, at = (0, 1, 0)m }
instance crate { shape = box(size: (1.5, 0.5, 1.5)m), material = m, rotate = (0, 30, 0)deg, at = (0, 0.5, 0.3)m }
instance bubble { shape = sphere(radius: 30cm), material = o, at = (0.3, 1.3, 0.4)m }\n";
const NESTED_BALLS: &str = "material n: dielectric { ior = 1.33, interior = milk, priority = 1 }
instance nested { shape = sphere(radius: 50cm), material = n, at = (-1.2, 0.9, 1.2)m }\n";
const POND: &str = "material wet: water { waves.scale = 2, waves.height = 3, priority = 1 }
instance pond { shape = box(size: (3, 1, 3)m), material = wet, at = (0.4, 0.6, 1)m, rotate = (0, 25, 0)deg }\n";
const SEA: &str = "material wet: water { waves.height = 2 }
instance sea { shape = rectangle(size: (90, 90)m), material = wet, at = (0, 0.7, 0)m }\n";
const PRIORITIES: &str = "material m: dielectric { ior = 1.5, priority = 2 }
material n: dielectric { ior = 1.33, priority = 1 }
instance ball { shape = sphere(radius: 1m), material = n, at = (0, 1, 0)m }
instance crate { shape = box(size: (1.5, 0.5, 1.5)m), material = m, at = (0, 0.5, 0.3)m }\n";
const MOVING_LIGHT: &str = "light bulb: sphere { center = (2, 4, 2)m, radius = 30cm, strength = 20, velocity = (-80, -20, 30)m/s }\n";
const MOVING_PANEL: &str = "instance panel {
  shape = rectangle(size: (2, 1)m)
  material = lamp
  rotate = (180, 0, 30)deg
  at = (0, 4, 0)m
  velocity = (40, -30, 10)m/s
}\n";
const MOVING_SHADE: &str = "asset canopy = obj(\"tent.obj\", unit: m, up: +y)
object wing { shape = canopy, material = lamp, at = (-1, 2.5, 0.5)m, velocity = (0, 30, 0)m/s }
instance shade { shape = [wing], velocity = (50, 0, 0)m/s }\n";

const FLOOR: &str = "material grey: diffuse { color = linear(0.6) }
instance floor { shape = rectangle(size: (20, 20)m), material = grey }\n";
const BALL: &str = "instance ball { shape = sphere(radius: 1m), material = m, at = (0, 1, 0)m }\n";
const MOVING_BALL: &str = "instance ball { shape = sphere(radius: 1m), material = m, at = (0, 1, 0)m, velocity = (60, 10, -30)m/s }\n";
const KEYED_BALL: &str = "instance ball { shape = sphere(radius: 1m), material = m, at = [0ms: (0, 1, 0)m, 4ms: (0.5, 1.2, 0)m, 20ms: (0, 1, 1)m], rotate = [0ms: (0, 0, 0)deg, 9ms: (0, 70, 0)deg] }\n";
const KEYED_CRATE: &str = "instance keyed { shape = box(size: (0.5, 0.3, 0.3)m), material = lacquer, rotate = [0ms: (0, 0, 0)deg, 20ms: (90, 40, 0)deg], at = [0ms: (-2, 1.8, 0)m, 9ms: (-1.8, 1.7, 0)m, 20ms: (-1.8, 2, 0)m] }\n";
const KEYED_TENT: &str = "asset tent = obj(\"tent.obj\", unit: m, up: +y)
instance canvas { shape = tent, material = m, at = (1.2, 0.4, 1.6)m, scale = (1, 1.5, 1), rotate = [-9ms: (0, 0, 0)deg, 9ms: (30, 90, -20)deg] }\n";
const KEYED_LOG: &str = "material oak: wood { color = linear(0.5, 0.3, 0.15), grain = x, scale = 3 }
object log { shape = box(size: (1.5, 0.4, 0.4)m), material = oak, rotate = [-5ms: (0, 0, 0)deg, 15ms: (0, 500, 0)deg] }
instance cart { shape = [log], rotate = (0, 0, 20)deg, scale = (-1, 1, 1), at = [0ms: (0, 0.8, 0)m, 7ms: (-0.4, 0.8, 0.3)m] }\n";
const KEYED_PANEL: &str = "instance panel { shape = rectangle(size: (2, 1)m), material = lamp, rotate = (180, 0, 30)deg, at = [-1ms: (0, 4, 0)m, 3ms: (0.4, 3.6, 0)m, 9ms: (0.4, 3.8, -0.6)m] }\n";
const KEYED_BEADS: &str = "asset bead = obj(\"bead.obj\", unit: m, up: +y)
instance bead_a { shape = bead, material = m, rotate = [-5ms: (20, 40, 0)deg, 15ms: (20, 40, 90)deg], at = (-1.4, 0.7, 0)m, scale = (0.7, 0.5, 0.9) }
instance bead_b { shape = bead, material = m, rotate = [0ms: (0, -70, 30)deg, 6ms: (40, -70, 60)deg], at = [0ms: (1, 0.8, 0.6)m, 9ms: (1.3, 0.8, 0.2)m], scale = (-0.6, 0.8, 0.4) }
instance bead_c { shape = bead, material = m, at = (-0.2, 0.5, 1.4)m, scale = 0.5 }
instance bead_d { shape = bead, material = m, at = (0.4, 1.7, 0)m, scale = 0.3, velocity = (10, 0, 5)m/s }\n";
const MOVING_BOX: &str = "instance crate { shape = box(size: (1, 1, 1)m), material = m, rotate = (0, 30, 0)deg, at = (0, 0.7, 1)m, velocity = (0, 40, 20)m/s }\n";
const MOVING_TENT: &str = "asset tent = obj(\"tent.obj\", unit: m, up: +y)
instance canvas { shape = tent, material = m, at = (1.2, 0, 1.6)m, scale = (1, 1.5, 1), velocity = (-50, 0, -10)m/s }\n";
const BOX: &str = "instance crate { shape = box(size: (1, 1, 1)m), material = m, rotate = (0, 30, 0)deg, at = (0, 0.7, 1)m }\n";
const TENT: &str = "asset tent = obj(\"tent.obj\", unit: m, up: +y)
instance canvas { shape = tent, material = m, at = (1.2, 0, 1.6)m, scale = (1, 1.5, 1) }\n";
/// A ball of 432 triangles, stored once: turned, stretched, mirrored, sheared.
const BEADS: &str = "asset bead = obj(\"bead.obj\", unit: m, up: +y)
object bent { shape = bead, rotate = (0, 30, 40)deg, scale = (0.5, 0.4, 0.7) }
instance bead_a { shape = bead, material = m, rotate = (20, 40, 0)deg, at = (-1.4, 0.7, 0)m, scale = (0.7, 0.5, 0.9) }
instance bead_b { shape = bead, material = m, rotate = (0, -70, 30)deg, at = (1, 0.8, 0.6)m, scale = (-0.6, 0.8, 0.4) }
instance bead_c { shape = bead, material = m, at = (-0.2, 0.5, 1.4)m, scale = 0.5 }
instance bead_d { shape = bent, material = m, rotate = (15, 0, 5)deg, at = (0.3, 1.5, -0.6)m, scale = (1.4, -0.8, 1) }\n";
const PLAIN_BEAD: &str =
    "instance bead_e { shape = bead, at = (1.2, 0.4, 1.6)m, scale = (0.4, 0.3, -0.5) }\n";
const MOVING_BEADS: &str = "asset bead = obj(\"bead.obj\", unit: m, up: +y)
instance bead_a { shape = bead, material = m, rotate = (20, 40, 0)deg, at = (-1.4, 0.7, 0)m, scale = (0.7, 0.5, 0.9), velocity = (50, 10, 0)m/s }
instance bead_b { shape = bead, material = m, rotate = (0, -70, 30)deg, at = (1, 0.8, 0.6)m, scale = (-0.6, 0.8, 0.4), velocity = (0, 30, -40)m/s }
instance bead_c { shape = bead, material = m, at = (-0.2, 0.5, 1.4)m, scale = 0.5 }
instance bead_d { shape = bead, material = m, at = (0.4, 1.7, 0)m, scale = 0.3 }\n";
const NESTED_BEADS: &str = "asset bead = obj(\"bead.obj\", unit: m, up: +y)
material m: dielectric { ior = 1.5, interior = ink, priority = 2 }
material n: dielectric { ior = 1.33, interior = milk, priority = 1 }
material o: dielectric { ior = 1, priority = 3 }
instance bead_a { shape = bead, material = n, at = (0, 1, 0)m }
instance bead_b { shape = bead, material = m, rotate = (0, 30, 0)deg, at = (0, 0.5, 0.6)m, scale = (-0.9, 0.4, 0.7) }
instance bead_c { shape = bead, material = o, at = (0.3, 1.3, 0.4)m, scale = 0.3 }
instance bead_d { shape = bead, material = n, at = (1.7, 0.4, 0)m, scale = (0.3, 0.4, 0.3) }\n";
/// No petal of it leans, so that all of them are alike.
const FLAT_PETAL: &str =
    "material m: petal { color = linear(0.9, 0.5, 0.6), pillow = 0, tilt = 0 }\n";
const ALL_BEADS: &str = "asset bead = obj(\"bead.obj\", unit: m, up: +y)
instance bead_a { shape = bead, material = steel, rotate = (20, 40, 0)deg, at = (-1.9, 0.5, 1.6)m, scale = (0.2, 0.3, -0.25) }
instance bead_b { shape = bead, material = glass, rotate = (0, -70, 30)deg, at = (1, 0.3, 1.9)m, scale = (0.3, 0.2, 0.25), velocity = (10, 20, 0)m/s }
instance bead_c { shape = bead, material = n, at = (1.9, 0.4, 1.2)m, scale = 0.25 }
instance bead_d { shape = bead, at = (1.4, 1.3, 0.6)m, scale = 0.25 }\n";
const MIRRORED: &str = "asset tent = obj(\"tent.obj\", unit: m, up: +y)
instance one { shape = tent, material = m, at = (1.2, 0, 1)m, scale = (1, 1.5, -1), rotate = (0, 20, 0)deg }
instance two { shape = tent, material = m, at = (-1, 0.9, 1)m, scale = (-1.5, -1, -1.2) }\n";
/// Texture coordinates from -1.4 to 2.3.
const QUILT: &str = "asset quilt = obj(\"quilt.obj\", unit: m, up: +y)
instance spread { shape = quilt, material = m, rotate = (70, 0, 0)deg, at = (-1.6, 1, 1)m }\n";

const COATED: &str = "material m: principled { color = linear(0.5, 0.05, 0.02), roughness = 0.6, coat.weight = 0.9, coat.roughness = 0.2 }\n";
const VARNISH: &str =
    "material m: principled { color = linear(0.4, 0.2, 0.1), metallic = 0.3, coat.weight = 1 }\n";
const VELVETY: &str = "material m: principled { color = linear(0.3, 0.02, 0.05), roughness = 0.8, sheen = linear(0.8, 0.5, 0.6), sheen.roughness = 0.4 }\n";
const SHOT_SILK: &str = "material m: principled { color = linear(0.2), roughness = wear.g, sheen = paint.rgb, sheen.roughness = wear.r, transmission = 0.2 }\n";
const BRUSHED_PLASTIC: &str = "material m: principled { color = linear(0.1, 0.3, 0.8), roughness = 0.4, anisotropy = 0.8, anisotropy.rotation = 30deg }\n";
const SILK: &str = "material m: principled { color = linear(0.3), specular = 0.8, specular.color = linear(4, 2, 0.5), roughness = 0.4 }\n";
const PANE: &str =
    "material m: principled { color = linear(0.9, 1, 0.8), roughness = 0, transmission = 1 }\n";
const FROSTED_PANE: &str = "material m: principled { color = linear(0.9, 0.8, 1), roughness = 0.4, transmission = 0.7, metallic = 0.1 }\n";
const LAYERED: &str = "material m: principled {
  color = paint.rgb
  roughness = wear.g
  metallic = wear.b
  specular = wear.g
  specular.color = paint.rgb
  coat.weight = wear.b
  coat.roughness = wear.g
  transmission = wear.a
  anisotropy = 0.7
  anisotropy.rotation = -100deg
  normal = bumps.rgb
}\n";

/// The back of the quilt.
const QUILT_BACK: &str = "asset quilt = obj(\"quilt.obj\", unit: m, up: +y)
instance under { shape = quilt, material = m, rotate = (-110, 0, 0)deg, at = (-1.2, 1, 1)m, scale = (-1, 1, 1) }\n";

const BUMPS: &str = "texture bumps = image(\"bumps.png\", space: data)\n";
const BUMPY_PLASTIC: &str = "material m: principled { color = linear(0.1, 0.3, 0.8), roughness = 0.3, normal = bumps.rgb }\n";
const BUMPY_CLAY: &str = "material m: diffuse { color = linear(0.7, 0.4, 0.2), normal = bumps.rgb, normal.strength = 4 }\n";
const BUMPY_MIRROR: &str =
    "material m: metal { color = linear(0.9), normal = bumps.rgb, normal.strength = 0.5 }\n";
const BUMPY_GLASS: &str = "material m: dielectric { ior = 1.5, normal = bumps.rgb }\n";

const CLAY: &str = "material m: diffuse { color = linear(0.7, 0.4, 0.2) }\n";
const PLASTIC: &str = "material m: principled { color = linear(0.1, 0.3, 0.8), roughness = 0.3 }\n";
const LEAF: &str = "material m: leaf { color = linear(0.5, 0.6, 0.2), translucency = 40% }\n";
const PETAL: &str = "material m: petal { color = linear(0.9, 0.6, 0.7), sigma_s = 5/mm }\n";
const SAKURA: &str = "material sakura: petal { color = linear(0.9, 0.6, 0.7) }
instance blossom { shape = sphere(radius: 30cm), material = sakura, at = (1.6, 0.3, 1)m }\n";
const FUZZY: &str = "material m: metal { color = linear(0.8), fuzz = 0.2 }\n";
const GOLD: &str = "material m: conductor { color = linear(1, 0.7, 0.3), roughness = 0.4 }\n";
const IRON: &str =
    "material m: conductor { color = linear(0.6), roughness = 1, compensation = off }\n";
const CHROME: &str = "material m: conductor { color = linear(0.6), roughness = 0.02 }\n";
const BRUSHED: &str =
    "material m: conductor { color = linear(0.9), roughness = 0.3, anisotropy = 0.8 }\n";
const WORN_METAL: &str = "material m: conductor { color = paint.rgb, roughness = wear.g }\n";
const FROSTED: &str = "material m: dielectric { ior = 1.5, roughness = 0.4 }\n";
const WORN_GLASS: &str = "material m: dielectric { ior = 1.3, roughness = wear.b }\n";
const LACQUER: &str = "material m: clearcoat { color = linear(0.7, 0.1, 0.1) }\n";
const SPECKLED: &str = "material m: mix { a = shiny, b = rough, amount = 0.3 }
material shiny: metal { color = linear(0.9, 0.7, 0.4), fuzz = 0.1 }
material rough: stone { color = linear(0.5, 0.3, 0.2), bump.strength = 20mm }\n";
const MASKED: &str = "material m: mix { a = metals, b = rough, amount = wear.r }
material metals: mix { a = brushed, b = varnish, amount = checker(3) }
material brushed: conductor { color = linear(0.9), roughness = 0.3, anisotropy = 0.8 }
material varnish: clearcoat { color = linear(0.2, 0.5, 0.3) }
material rough: diffuse { color = linear(0.4, 0.3, 0.2) }\n";
const GLAZE: &str = "material m: clearcoat {
  color = linear(0.9)
  fuzz = 0
  coat.ior = 1.65
  coat.tint = linear(1, 0.9, 0.5)
}\n";
const GLOWING: &str = "material m: principled {
  metallic = 0.5
  roughness = 0.6
  emission.color = linear(0.2, 0.1, 0)
  emission.strength = 2
}\n";

const STONE: &str = "material m: stone { color = linear(0.6, 0.55, 0.5), scale = 2 }\n";
const SMOOTH_STONE: &str = "material m: stone { color = linear(0.6), color.vein = linear(0.9, 0.1, 0), bump.strength = 0m }\n";
const WOOD_X: &str = "material m: wood { color = linear(0.5, 0.3, 0.15), grain = x, scale = 3 }\n";
const WOOD_Y: &str = "material m: wood {
  color = linear(0.5, 0.3, 0.15)
  color.late = linear(0.1, 0, 0)
  grain = y
  gloss = 30%
  anisotropy = 1
}\n";
const WOOD_Z: &str = "material m: wood { color = linear(0.5), grain = z, gloss = 100% }\n";
const FABRIC: &str = "material m: fabric { color = paint.rgb, scale = 3, translucency = 0.5 }\n";
const FELT: &str = "material m: fabric { color = linear(0.3, 0.1, 0.1), translucency = 0, gloss = 0.2, roughness = 0.3 }\n";
const CRAGS: &str = "material m: stone { color = linear(0.9), bump.strength = 300m }\n";
const PATTERNS: &str = "material rock: stone { color = linear(0.6, 0.55, 0.5), scale = 2 }
material oak: wood { color = linear(0.5, 0.3, 0.15), grain = x, scale = 3 }
material cloth: fabric { color = paint.rgb }
instance patterned_a { shape = sphere(radius: 1m), material = rock, at = (-1, 1, -1)m }
instance patterned_b { shape = box(size: (2, 0.3, 0.5)m), material = oak, rotate = (0, 30, 0)deg, at = (0.5, 0.4, 1)m }
instance patterned_c { shape = rectangle(size: (1, 1)m), material = cloth, rotate = (70, 0, 20)deg, at = (1.3, 1, 0)m }
instance patterned_d { shape = sphere(radius: 30cm), material = oak, at = (-1.2, 0.3, 1.2)m }\n";

const PAINT: &str = "texture paint = image(\"paint.png\", space: srgb)\n";
const MIXED: &str =
    "texture paint = image(\"paint.png\", space: srgb, wrap_u: clamp, wrap_v: mirror)\n";
const WEAR: &str = "texture wear = image(\"wear.png\", space: data, wrap: mirror)\n";
const GLOW: &str = "texture glow = image(\"glow.exr\", space: linear, wrap: clamp)\n";
const PAINTED: &str = "material m: diffuse { color = paint.rgb }\n";
const WOVEN: &str = "let tiles = bricks(4, 8, 0.1)
material m: principled {
  color = mix(linear(0.2, 0.5, 0.1), 0.9 * paint.rgb * linear(0.9, 0.6, 0.3) + linear(0.05), tiles)
  roughness = clamp(noise(6, 3) * 2 - 0.5, 0, 1)
  metallic = checker(5, 3) * wear.r
  specular = 1 - wear.g
  specular.color = paint.rgb * 0.5 + linear(0.5)
  coat.weight = gradient(30deg)
  coat.roughness = wave(7, 20deg)
}\n";
const TILED: &str = "material m: diffuse { color = mix(linear(0.8, 0.1, 0.1), linear(0.9), checker(8) * noise(3)) }\n";
const GRATE: &str =
    "material m: principled { alpha = mix(wear.a, 1, bricks(2, 3, 0.2)), alpha.clip = 40% }\n";
const GLOWING_TILES: &str =
    "material lamp: emissive { color = paint.rgb * checker(3), strength = 4 }\n";
const PLACED: &str =
    "texture paint = image(\"paint.png\", space: srgb, scale: 3, rotate: 30deg, offset_u: 0.2)
texture bumps = image(\"bumps.png\", space: data, scale_u: -2, scale_v: 1.5, rotate: -70deg)
texture wear = image(\"wear.png\", space: data, scale: 0.5)
material m: principled {
  color = paint.rgb
  normal = bumps.rgb
  roughness = wear.g
  specular.color = paint.rgb
}\n";
/// A shell with colours: of its own material, and stored once in two places, one of them mirrored.
const STAINED_SHELLS: &str = "asset shell = obj(\"shell.obj\", unit: m, up: +y)
material m: principled { color = paint.rgb * vertex_color.rgb, roughness = 0.1 + 0.8 * vertex_color.g }
material gauze: principled { color = vertex_color.rgb, alpha = clamp(2 * vertex_color.r - 0.4, 0, 1) }
instance own { shape = shell, at = (-1.6, 0.6, 1)m, scale = 0.5 }
instance mirrored { shape = shell, material = m, at = (1.6, 0.5, 1)m, scale = (-0.5, 0.5, 0.5), rotate = (0, 40, 0)deg }
instance thin { shape = shell, material = gauze, at = (0, 0.4, 2)m, scale = 0.4 }\n";
const OWN_SHELL: &str = "asset shell = obj(\"shell.obj\", unit: m, up: +y)
instance own { shape = shell, at = (0, 1, 0)m }\n";
const STAINED_LAMP: &str = "asset shell = obj(\"shell.obj\", unit: m, up: +y)
material lamp: principled { color = linear(0.2), emission.color = vertex_color.rgb, emission.strength = 9, alpha = vertex_color.g, alpha.clip = 60% }
instance glow { shape = shell, material = lamp, at = (0.3, 2.6, 0)m, scale = 0.6 }\n";
const WRAPPED: &str = "material m: principled { color = mix(paint.rgb, linear(0.8), checker(3)), roughness = 0.4, normal = bumps.rgb, projection = box }\n";
const CARVED: &str = "material wrapped: principled { color = mix(paint.rgb, linear(0.8), checker(3)), roughness = 0.4, normal = bumps.rgb, projection = box }
material veined: diffuse { color = linear(0.9) * noise(4), projection = solid }
material m: mix { a = wrapped, b = veined, amount = checker(5), projection = solid }\n";
const STAINED: &str = "material m: principled { transmission = wear.g, color = paint.rgb, roughness = 0, projection = z }
instance pane { shape = rectangle(size: (2, 2)m), material = m, at = (0, 1.2, 0)m, rotate = [0ms: (80, 0, 0)deg, 20ms: (80, 60, 0)deg] }\n";
const CLAY_FLOOR: &str = "material clay: diffuse { color = linear(0.7, 0.4, 0.2) }
instance ground { shape = rectangle(size: (6, 6)m), material = clay }\n";
const WORN: &str = "material m: principled { roughness = wear.g, metallic = wear.b }\n";
const NEON: &str = "material m: emissive { color = glow.rgb, strength = 2 }\n";
const LACE: &str =
    "material m: principled { color = linear(0.4, 0.7, 0.3), alpha = wear.a, alpha.clip = 50% }\n";
const GAUZE: &str = "material m: principled { color = linear(0.4, 0.7, 0.3), alpha = 0.4 }\n";
const FADE: &str = "texture fade = image(\"fade.png\", space: data)\n";
const VEIL: &str = "material m: principled { color = linear(0.4, 0.7, 0.3), alpha = fade.a }\n";
const LACE_SHEET: &str = "material lace: principled { color = linear(0.4), alpha = fade.a, alpha.clip = 50% }
instance sheet { shape = rectangle(size: (2, 2)m), material = lace, at = (1, 1.5, 0)m, rotate = (50, 0, 0)deg }\n";
const VEIL_LAMP: &str = "material lamp: principled {
  color = linear(0.2)
  emission.color = paint.rgb
  emission.strength = 6
  alpha = fade.a
}\n";
const MANY: &str = "material m: principled {
  color = paint.rgb
  normal = bumps.rgb
  roughness = wear.g
  metallic = wear.b
  specular = 0.5
  coat.weight = 0.3
  coat.roughness = wear.g
  transmission = 0.2
  anisotropy = 0.5
  emission.color = glow.rgb
  emission.strength = 0.1
  alpha = wear.a
  alpha.clip = 30%
}\n";
const ALL_THINGS: &str = "material brass: metal { color = linear(0.9, 0.7, 0.4), fuzz = 0.3 }
material glass: dielectric { ior = 1.5 }
material clay: diffuse { color = mix(paint.rgb, linear(0.5), checker(4)) }
material steel: conductor { color = linear(0.8), roughness = 0.3, anisotropy = 0.8 }
material frosted: dielectric { roughness = 0.4 }
material lacquer: clearcoat { color = linear(0.7, 0.1, 0.1) }
material maple: leaf { color = linear(0.5, 0.2, 0.1) }
material sakura: petal { color = linear(0.9, 0.6, 0.7) }
material gauze: principled { color = linear(0.7, 0.2, 0.3), sheen = linear(0.2, 0.3, 0.4), alpha = 0.6 }
material rusty: mix { a = steel, b = clay, amount = checker(6) * 0.8 }
asset tent = obj(\"tent.obj\", unit: m, up: +y)
instance a { shape = sphere(radius: 60cm), material = glass, at = (-1.5, 0.6, 1)m, velocity = (20, 0, 0)m/s }
instance b { shape = box(size: (1, 1, 1)m), material = clay, rotate = (0, 30, 0)deg, at = (1.8, 0.5, -1)m }
instance c { shape = tent, material = m, at = (0.6, 0, 1.4)m, scale = (-1, 1, 1), velocity = (0, 15, 0)m/s }
instance d { shape = sphere(radius: 50cm), material = brass, at = (0, 0.5, -1)m }
instance e { shape = sphere(radius: 40cm), material = m, at = (-0.4, 1.6, 0)m }
instance f { shape = sphere(radius: 30cm), material = steel, at = (0.8, 1.6, 0)m }
instance g { shape = sphere(radius: 30cm), material = frosted, at = (0.1, 0.3, 2)m }
instance h { shape = sphere(radius: 30cm), material = lacquer, at = (-0.7, 0.3, 2)m }
instance i { shape = sphere(radius: 30cm), material = maple, at = (-2.2, 0.3, -0.4)m }
instance k { shape = box(size: (0.5, 0.5, 0.5)m), material = gauze, at = (-0.5, 1, 1)m, rotate = (0, 20, 30)deg }
texture wash = image(\"wash.ies\", space: linear)
light washer: point { at = (2, 2.5, 1)m, profile = wash, profile.scale = 0.2, temperature = 3000K }
light halo: disk { at = (-2, 2, 0)m, to = (0, 1, 0)m, radius = 20cm, power = 9W, visible = off }
instance l { shape = sphere(radius: 20cm), material = rusty, at = (1.6, 0.2, 2)m }
instance j { shape = tent, material = sakura, at = (-0.6, 0, 2.2)m, scale = (0.6, 0.8, 0.6) }\n";

/// A four-sided tent with normals and texture coordinates.
const TENT_OBJ: &str = "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0 0.5\nv -0.5 0 0.5\nv 0 0.8 0
vn -0.6 0.5 -0.6\nvn 0.6 0.5 -0.6\nvn 0.6 0.5 0.6\nvn -0.6 0.5 0.6\nvn 0 1 0
vt 0 0\nvt 1 0\nvt 0.5 1
f 2/1/2 1/2/1 5/3/5\nf 3/1/3 2/2/2 5/3/5\nf 4/1/4 3/2/3 5/3/5\nf 1/1/1 4/2/4 5/3/5\n";
/// A lamp with two beams.
const WASH_IES: &str = "IESNA:LM-63-1995\nTILT=NONE\n1 900 1 4 3 1 2 0 0 0\n1 1 40\n0 30 60 90
0 90 180\n900 4000 300 0\n900 700 100 0\n900 2500 300 0\n";
/// A square whose texture coordinates go beyond the image on all sides.
const QUILT_OBJ: &str = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1
vt -1.4 -1.2\nvt 2.3 -1.2\nvt 2.3 2.1\nvt -1.4 2.1
f 1/1 2/2 3/3 4/4\n";

/// A ball of 18 by 13 bands with normals and texture coordinates; places are multiples of 2^-10, so that they can
/// be shifted without a loss.
/// `colored`: with a colour at each vertex.
fn bead_obj(colored: bool) -> String {
    use std::f64::consts::PI;
    use std::fmt::Write as _;
    let (n, m) = (18_u32, 13_u32);
    let mut text = String::new();
    for j in 0..=m {
        for i in 0..=n {
            let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(m));
            // The seam has the same places on both sides, and so have the poles.
            let (sin, cos) = (2.0 * PI * f64::from(i % n) / f64::from(n)).sin_cos();
            let radius = if j % m == 0 { 0.0 } else { (PI * v).sin() };
            let p = [radius * cos, -(PI * v).cos(), radius * sin]
                .map(|x| (x * 1024.0).round() / 1024.0);
            let [x, y, z] = p;
            let color = if colored {
                p.map(|x| format!(" {}", 0.5 + 0.5 * x)).concat()
            } else {
                String::new()
            };
            writeln!(text, "v {x} {y} {z}{color}\nvn {x} {y} {z}\nvt {u} {v}")
                .expect("strings take all");
        }
    }
    for j in 0..m {
        for i in 0..n {
            let at = |i: u32, j: u32| j * (n + 1) + i + 1;
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            if j > 0 {
                writeln!(text, "f {a}/{a}/{a} {c}/{c}/{c} {d}/{d}/{d}").expect("strings take all");
            }
            if j + 1 < m {
                writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}").expect("strings take all");
            }
        }
    }
    text
}

/// The case with this name.
///
/// # Panics
/// When there is none.
#[must_use]
pub fn named(name: &str) -> &'static Case {
    CASES.iter().find(|case| case.name == name).expect("tests name cases that there are")
}

/// Compiles a case; its files are made in a temporary directory.
///
/// # Panics
/// When the case is not a scene.
#[must_use]
pub fn compiled(case: &Case) -> Compiled {
    changed(case, |_| {})
}

/// Compiles a case after `change` has altered its checked scene.
///
/// # Panics
/// When the case is not a scene.
#[must_use]
pub fn changed(case: &Case, change: impl FnOnce(&mut Scene)) -> Compiled {
    with(case, (Instancing::default(), Layout::default()), change)
}

/// Compiles a case with or without meshes that are stored once, and with this layout of nodes.
///
/// # Panics
/// When the case is not a scene.
#[must_use]
pub fn shared(case: &Case, instancing: Instancing, layout: Layout) -> Compiled {
    with(case, (instancing, layout), |_| {})
}

fn with(case: &Case, how: (Instancing, Layout), change: impl FnOnce(&mut Scene)) -> Compiled {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_files(dir.path());
    let Case { parts, view: [kind, seen], camera, film, render, .. } = case;
    let things = parts.concat();
    let air = ["mist", "smoke"].into_iter().find(|air| things.contains(&format!("medium {air}:")));
    let air = air.map_or(String::new(), |air| format!(", atmosphere = {air}"));
    let still = "  from = (0.5, 1.8, 5)m\n  to = (0, 0.9, 0)m\n";
    let place = if camera.contains("from") { "" } else { still };
    let depth = if render.contains("depth") { "" } else { ", depth = 8" };
    let text = format!(
        "rts 1\n{things}
camera eye: {kind} {{
{place}  {seen}
{camera}}}
film small {{ size = (40, 30)px{film} }}
render main: path {{ camera = eye, film = small, samples = 8{depth}, seed = 7{render}{air} }}\n",
    );
    crate::scene::compile_shared(dir.path(), &text, how, change)
}

/// Compiles a case into a checked pack.
///
/// # Panics
/// When the case is not a scene.
#[must_use]
pub fn case_pack(case: &Case) -> Pack<Checked> {
    Pack::from_bytes(crate::scene::bytes(&compiled(case))).expect("what was written can be read")
}

fn write_files(dir: &Path) {
    let save = |name: &str, texel: fn(u8, u8) -> [u8; 4]| {
        let at = |x: u32| u8::try_from(x).expect("the images are small");
        let image = image::RgbaImage::from_fn(13, 8, |x, y| image::Rgba(texel(at(x), at(y))));
        image.save(dir.join(name)).expect("an image can be written");
    };
    save("paint.png", |x, y| [x * 19, y * 31, (x ^ y) * 16, 255]);
    save("bumps.png", |x, y| [50 + x * 14, 240 - y * 27, 150 + (x ^ y) * 7, 255]);
    save("wear.png", |x, y| [0, 60 + x * 12, y * 30, if (x + y) % 3 == 0 { 0 } else { 255 }]);
    save("fade.png", |x, y| [255, 0, 0, 20 * x + y]);
    let glow = |x: usize, y: usize| (x as f32 * 0.25, y as f32 * 0.5, 1.5_f32);
    exr::prelude::write_rgb_file(dir.join("glow.exr"), 6, 5, glow)
        .expect("an image can be written");
    let sun = |x: usize, y: usize| {
        let dim = 0.1 + 0.05 * (x % 3) as f32 + 0.02 * y as f32;
        if (x, y) == (5, 2) { (400.0, 300.0, 150.0) } else { (dim, dim, 0.3_f32) }
    };
    exr::prelude::write_rgb_file(dir.join("panorama.exr"), 16, 8, sun)
        .expect("an image can be written");
    let [bead, shell] = [false, true].map(bead_obj);
    let texts = [
        ("tent.obj", TENT_OBJ),
        ("quilt.obj", QUILT_OBJ),
        ("bead.obj", &bead),
        ("shell.obj", &shell),
        ("wash.ies", WASH_IES),
    ];
    for (name, text) in texts {
        std::fs::write(dir.join(name), text).expect("a mesh can be written");
    }
}

/// The sample of `lobe` for these numbers.
#[must_use]
pub fn sample_at(
    kernel: &mut single::Kernel<'_>,
    lobe: &Lobe,
    wo: Vec3,
    u: Vec2,
    v: f32,
) -> single::Scattered {
    let s = lobe.single();
    match lobe.kind {
        MaterialKind::Diffuse => kernel.diffuse_sample(s, u),
        MaterialKind::Metal => kernel.metal_sample(s, wo, u, v),
        MaterialKind::Dielectric => kernel.dielectric_sample(s, wo, v),
        MaterialKind::Emissive => kernel.emissive_sample(),
        MaterialKind::Principled => kernel.dispatch_principled_sample(s, wo, u, v),
        MaterialKind::Stone => kernel.stone_sample(s, wo, u, v),
        MaterialKind::Wood => kernel.wood_sample(s, wo, u, v),
        MaterialKind::Fabric => kernel.fabric_sample(s, wo, u, v),
        MaterialKind::Conductor => kernel.conductor_sample(s, wo, u, v),
        MaterialKind::RoughDielectric => kernel.rough_dielectric_sample(s, wo, u, v),
        MaterialKind::Clearcoat => kernel.clearcoat_sample(s, wo, u, v, 1.0 - v),
        MaterialKind::Petal => kernel.petal_sample(s, wo, u, v, v),
        MaterialKind::Leaf => kernel.leaf_sample(s, wo, u, v),
        MaterialKind::Water => kernel.water_sample(s, wo, v),
        MaterialKind::Mix => kernel.mix_sample(),
    }
}
