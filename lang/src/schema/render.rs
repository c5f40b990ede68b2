//! The render: `render NAME: path { ... }`.

use super::{Default, Field, FieldType, Kind, TypeSchema, Word};
use crate::scene::{Layer, Sampler};

pub(super) const TYPES: &[&TypeSchema] = &[&PATH];

const UNLIMITED: &[Word] = &[(
    "unlimited",
    "paths end by Russian roulette alone, so no light is missing; from bounce 1024 on with a chance of 1 in 1024 at \
     least, which also ends those that lose nothing",
)];

const PATH: TypeSchema = TypeSchema {
    kind: Kind::Render,
    name: "path",
    doc: "A path tracer. A scene has exactly one render.",
    example: "render main: path { camera = hero, film = uhd, sky = dusk, samples = 256 }",
    fields: &[
        Field::new(
            "camera",
            FieldType::Name(Kind::Camera),
            Default::Absent("the only camera of the file"),
            "The camera that sees the scene.",
        )
        .foreign(&[("sensor", "Mitsuba")]),
        Field::new(
            "film",
            FieldType::Name(Kind::Film),
            Default::Absent("the only film of the file, or one with every default"),
            "The picture that is made.",
        ),
        Field::new(
            "sky",
            FieldType::Name(Kind::Sky),
            Default::Absent("the only sky of the file, or black; `none` is black"),
            "What is seen where there is nothing else.",
        )
        .foreign(&[("environment", "common use"), ("world", "Blender"), ("background", "common use")]),
        Field::new(
            "atmosphere",
            FieldType::Name(Kind::Medium),
            Default::Absent("clear air"),
            "What fills the space around things.",
        )
        .foreign(&[("medium", "Mitsuba"), ("volume_world", "LuxCore"), ("fog", "common use")]),
        Field::new(
            "samples",
            FieldType::Integer(1, 1 << 24),
            Default::Number(64.0),
            "Paths for each pixel; four times as many halve the noise.",
        )
        .typical("16 to look, 256 to show, 4096 to keep")
        .foreign(&[
            ("pixelsamples", "pbrt"),
            ("sample_count", "Mitsuba"),
            ("spp", "common use"),
            ("samples_per_pixel", "Ray Tracing in One Weekend"),
            ("halt_spp", "LuxCore"),
        ]),
        Field::new(
            "depth",
            FieldType::IntegerOr(1, 1024, UNLIMITED),
            Default::Number(12.0),
            "Longest path, in segments; 1 sees only what gives off light.",
        )
        .typical("8 to 50; glass inside glass needs more")
        .foreign(&[
            ("maxdepth", "pbrt and LuxCore"),
            ("max_depth", "Mitsuba and Ray Tracing in One Weekend"),
            ("max_bounces", "Blender"),
        ]),
        Field::new(
            "roulette",
            FieldType::Integer(0, 1024),
            Default::Number(3.0),
            "Bounce from which weak paths may end early; 1024 never ends one, unless `depth` is `unlimited`.",
        )
        .foreign(&[("rr_depth", "Mitsuba"), ("rrthreshold", "pbrt-v3")]),
        Field::new(
            "seed",
            FieldType::Integer(0, u32::MAX),
            Default::Number(0.0),
            "Another seed gives another picture of the same scene, equally noisy.",
        ),
        Field::new(
            "sampler",
            FieldType::Word(Sampler::WORDS),
            Default::Word("sobol"),
            "Which random numbers to draw; both converge to the same picture. `sobol` is best with a power of two \
             as `samples`.",
        )
        .foreign(&[("sampling_pattern", "Blender")]),
        Field::new(
            "layers",
            FieldType::Words(Layer::WORDS),
            Default::Absent("none; `rtr --layers` asks for others"),
            "What the EXR holds beside the picture, such as `[albedo, normal, depth]`.",
        )
        .foreign(&[("aovs", "Mitsuba"), ("passes", "Blender")]),
        Field::new(
            "output",
            FieldType::Text,
            Default::Absent("the name of the pack"),
            "Where the picture goes, relative to where the renderer runs; the ending is `.exr` or `.png`.",
        )
        .foreign(&[("filename", "pbrt"), ("file", "common use")]),
    ],
    foreign: &[("pathtracer", "common use"), ("volpath", "pbrt"), ("PATHCPU", "LuxCore")],
};
