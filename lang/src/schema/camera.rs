//! Cameras: `camera NAME: perspective { ... }`, `orthographic`, `panoramic`.

use super::{Bounds, Default, Field, FieldType, Kind, TypeSchema};
use crate::units::Dim;

types!(CameraType {
    Perspective = PERSPECTIVE,
    Orthographic = ORTHOGRAPHIC,
    Panoramic = PANORAMIC,
});

/// 179 degrees: at 180 the image plane is infinite.
const MAX_FOV: f64 = 179.0 * std::f64::consts::PI / 180.0;

const FOV: FieldType = FieldType::Number(Bounds {
    dim: Dim::ANGLE,
    unit: "deg",
    min: 0.0,
    above_min: true,
    max: MAX_FOV,
});

const MILLIMETRES: FieldType = FieldType::Number(Bounds::above(Dim::LENGTH, "mm", 0.0));

const FROM_DOC: &str = "Where the eye is, or keys: `[0ms: (0, 1, 5)m, 20ms: (1, 1, 5)m]`.";

const FROM: Field =
    Field::new("from", FieldType::Keyed(Dim::LENGTH, "m"), Default::Required, FROM_DOC).foreign(&[
        ("origin", "Mitsuba"),
        ("orig", "LuxCore"),
        ("eye", "common use"),
        ("position", "common use"),
        ("lookfrom", "Ray Tracing in One Weekend"),
    ]);

const TO: Field = Field::new(
    "to",
    FieldType::Keyed(Dim::LENGTH, "m"),
    Default::Required,
    "The point in the middle of the image, or keys, as for `from`.",
)
.foreign(&[
    ("target", "LuxCore and Mitsuba"),
    ("look_at", "common use"),
    ("lookat", "Ray Tracing in One Weekend"),
]);

const UP: Field = Field::new(
    "up",
    FieldType::Vector(Dim::NONE, ""),
    Default::Vector([0.0, 1.0, 0.0]),
    "Which way is up in the image; not along the view.",
)
.foreign(&[("vup", "Ray Tracing in One Weekend")]);

const FIT: Field = Field::new(
    "fit",
    FieldType::Name(Kind::Instance),
    Default::Absent("the camera stays where `from` and `to` say"),
    "The instance that is to fill the image: the camera moves to where it just fits, with 5 % to spare; of a mesh, \
     the boxes around its parts are fitted. `from` and `to` then only give the direction of view, or `from` \
     alone the side that is seen; without them the camera looks from the front, the right and above.",
)
.foreign(&[("frame", "common use"), ("frame_selected", "Blender")]);

const SHUTTER: Field = Field::new(
    "shutter",
    FieldType::Interval(Bounds::new(Dim::TIME, "ms", f64::NEG_INFINITY, f64::INFINITY)),
    Default::Interval(0.0, 0.0),
    "When the shutter opens and closes, relative to the frame.",
)
.foreign(&[("shutteropen", "pbrt and LuxCore"), ("shutter_open", "Mitsuba")]);

const PERSPECTIVE: TypeSchema = TypeSchema {
    kind: Kind::Camera,
    name: "perspective",
    doc: "A camera with a thin lens, or a pinhole when it has no aperture. The field of view comes from `lens`, \
         `fov.horizontal` or `fov.vertical`: one of them, or the default lens.",
    example: "camera hero: perspective { from = (4, 1.5, 10)m, to = (0, 2, 0)m, lens = 50mm, \
              f_stop = 2.0 }",
    fields: &[
        FROM,
        TO,
        UP,
        FIT,
        Field::new(
            "lens",
            MILLIMETRES,
            Default::Absent("50mm, unless a `fov` is given"),
            "Focal length; with `sensor.width` it sets the field of view.",
        )
        .typical("wide 24mm, normal 50mm, portrait 85mm on a 36mm sensor")
        .foreign(&[("focal_length", "Mitsuba and Blender"), ("focallength", "common use")]),
        Field::new(
            "sensor.width",
            MILLIMETRES,
            Default::Number(0.036),
            "Width of the image behind the lens.",
        )
        .foreign(&[("sensor_width", "Blender"), ("film_width", "common use")]),
        Field::new(
            "fov.horizontal",
            FOV,
            Default::Absent("what `lens` says"),
            "Angle between the left and the right edge of the image.",
        )
        .foreign(&[("xfov", "glTF"), ("fov_x", "Mitsuba")]),
        Field::new(
            "fov.vertical",
            FOV,
            Default::Absent("what `lens` says"),
            "Angle between the lower and the upper edge of the image.",
        )
        .foreign(&[
            ("fov", "pbrt, Mitsuba and LuxCore"),
            ("vfov", "Ray Tracing in One Weekend"),
            ("yfov", "glTF"),
            ("fovy", "OpenGL"),
            ("fov_y", "common use"),
            ("fieldofview", "LuxCore"),
        ]),
        Field::new(
            "f_stop",
            FieldType::Number(Bounds::number(0.1, 1e6)),
            Default::Absent("`aperture` decides"),
            "Focal length over aperture; smaller means a shallower depth of field.",
        )
        .typical("1.4 to 22")
        .foreign(&[
            ("fstop", "Blender"),
            ("aperture_fstop", "Blender"),
            ("f_number", "common use"),
        ]),
        Field::new(
            "aperture",
            FieldType::Number(Bounds::new(Dim::LENGTH, "mm", 0.0, f64::INFINITY)),
            Default::Absent("0mm, a pinhole: everything is sharp"),
            "Diameter of the opening of the lens.",
        )
        .foreign(&[
            ("lensradius", "pbrt and LuxCore; it is half of this"),
            ("aperture_radius", "Mitsuba; it is half of this"),
        ]),
        Field::new(
            "blades",
            FieldType::Integer(3, 16),
            Default::Absent("a round opening"),
            "Number of straight blades of the aperture: what is out of focus takes the shape of the opening, a \
             polygon with this many corners and the area of the round one.",
        )
        .typical("5 to 9")
        .foreign(&[
            ("aperture_blades", "Blender"),
            ("bladecount", "common use"),
            ("bokeh.blades", "LuxCore"),
        ]),
        Field::new(
            "rotation",
            FieldType::Number(Bounds::new(Dim::ANGLE, "deg", f64::NEG_INFINITY, f64::INFINITY)),
            Default::Number(0.0),
            "How far the blades are turned, clockwise in the image of what is behind the focus; at 0deg a corner \
             is at the top.",
        )
        .foreign(&[("aperture_rotation", "Blender")]),
        Field::new(
            "focus",
            FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Absent("the distance from `from` to `to`"),
            "Distance at which things are sharp.",
        )
        .foreign(&[
            ("focaldistance", "pbrt and LuxCore"),
            ("focus_distance", "Mitsuba and Blender"),
            ("focus_dist", "Ray Tracing in One Weekend"),
        ]),
        SHUTTER,
    ],
    foreign: &[("thinlens", "Mitsuba"), ("pinhole", "common use"), ("persp", "Blender")],
};

/// A side of what parallel rays see.
const SIDE: FieldType = FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0));

const ORTHOGRAPHIC: TypeSchema = TypeSchema {
    kind: Kind::Camera,
    name: "orthographic",
    doc: "A camera whose rays are parallel: things have the same size at every distance, as in plans and \
         elevations. `width` or `height` sets how much it sees; the other follows from the film. Rays start in the \
         plane through `from`, so what is behind it is not seen.",
    example: "camera front: orthographic { from = (0, 1, 10)m, to = (0, 1, 0)m, height = 4m }",
    fields: &[
        FROM,
        TO,
        UP,
        FIT,
        Field::new(
            "width",
            SIDE,
            Default::Absent("what `height` or `fit` says"),
            "Distance between the left and the right edge of the view.",
        )
        .foreign(&[("ortho_scale", "Blender"), ("xmag", "glTF; it is half of this")]),
        Field::new(
            "height",
            SIDE,
            Default::Absent("what `width` or `fit` says"),
            "Distance between the lower and the upper edge of the view.",
        )
        .foreign(&[("ymag", "glTF; it is half of this"), ("screenwindow", "pbrt and LuxCore")]),
        SHUTTER,
    ],
    foreign: &[("ortho", "Blender and common use"), ("parallel", "common use")],
};

const PANORAMIC: TypeSchema = TypeSchema {
    kind: Kind::Camera,
    name: "panoramic",
    doc: "A camera that sees all around it, on a lat-long (equirectangular) picture: columns are angles around \
         `up`, rows are angles from it, from straight up to straight down. The direction of `to` is in the middle; \
         the horizon is level when `to` is as high as `from`. Pixels are square on a film that is twice as wide as \
         high.",
    example: "camera around: panoramic { from = (0, 1.6, 0)m, to = (0, 1.6, -1)m }",
    fields: &[
        FROM,
        TO,
        UP,
        Field::new(
            "fov.horizontal",
            FieldType::Number(Bounds {
                dim: Dim::ANGLE,
                unit: "deg",
                min: 0.0,
                above_min: true,
                max: 2.0 * std::f64::consts::PI,
            }),
            Default::Number(2.0 * std::f64::consts::PI),
            "Angle between the left and the right edge of the picture; 360deg sees all around.",
        )
        .foreign(&[("fov", "common use"), ("longitude_max", "Blender")]),
        SHUTTER,
    ],
    foreign: &[
        ("panorama", "common use"),
        ("spherical", "pbrt"),
        ("environment", "pbrt-v3 and LuxCore"),
        ("equirectangular", "Blender"),
        ("pano", "Blender"),
    ],
};
