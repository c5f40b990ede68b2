//! The camera, in the normalised scene frame.

use super::field::abi_struct;
use super::tag::tags;

tags! {
    /// How directions become places on the film. The numbers are part of the pack format.
    pub enum CameraKind {
        /// Through a point, or a thin lens around it.
        Perspective = 0,
        /// Along parallel rays.
        Orthographic = 1 as 58 "orthographic camera",
        /// A lat-long map of all directions.
        Panoramic = 2 as 59 "panoramic camera",
    }
}

abi_struct! {
    /// The camera. World frame, normalised units (see `RenderSettings`).
    pub struct Camera {
        /// Centre of the lens, or of the plane in which parallel rays start.
        pub origin: [f32; 3],
        /// Radius of the lens; 0 is a pinhole. Only perspective cameras have one.
        pub lens_radius: f32,
        /// Unit vector to the right of the image.
        pub right: [f32; 3],
        /// Half the height of the view at the film's aspect ratio. Perspective: the tangent of half the vertical field
        /// of view; orthographic: a length; panoramic: turns, a quarter of one is straight up.
        pub half_height: f32,
        /// Unit vector to the top of the image.
        pub up: [f32; 3],
        /// Distance from `origin` to the plane of focus, along `forward`; without a lens to what the camera looks at.
        pub focus_distance: f32,
        /// Unit viewing direction.
        pub forward: [f32; 3],
        /// Half the width, likewise; for another aspect the runtime rescales the height, but not that of a panorama.
        pub half_width: f32,
        /// `CameraKind`.
        pub kind: u32,
        /// Blades of the aperture, whose opening is a regular polygon of the area of the lens; 0: it is round.
        pub blades: u32,
        /// Turns of that polygon, clockwise in the image, from a corner at the top.
        pub blade_rotation: f32,
        /// From its middle to its corners, in radii of the lens.
        pub blade_reach: f32,
    }
}

impl Camera {
    /// The camera for a film of `size` pixels, made for one of `made_for`: another aspect keeps the width of the view. A
    /// panorama keeps its height, too: its rows are angles from pole to pole.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the compiler does")]
    pub fn resized(self, size: [u32; 2], made_for: [u32; 2]) -> Self {
        let ([w, h], [made_w, made_h]) = (size.map(u64::from), made_for.map(u64::from));
        if w * made_h == h * made_w || self.kind == CameraKind::Panoramic as u32 {
            return self;
        }
        let [w, h] = size.map(f64::from);
        Self { half_height: (f64::from(self.half_width) * h / w) as f32, ..self }
    }
}
