//! The perspective camera, in the normalised scene frame.

use super::field::abi_struct;

abi_struct! {
    /// Thin-lens perspective camera. World frame, normalised units (see `RenderSettings`).
    pub struct Camera {
        /// Centre of the lens.
        pub origin: [f32; 3],
        /// Radius of the lens; 0 is a pinhole.
        pub lens_radius: f32,
        /// Unit vector to the right of the image.
        pub right: [f32; 3],
        /// Tangent of half the vertical field of view at the film's aspect ratio.
        pub tan_half_height: f32,
        /// Unit vector to the top of the image.
        pub up: [f32; 3],
        /// Distance from `origin` to the plane of focus, along `forward`.
        pub focus_distance: f32,
        /// Unit viewing direction.
        pub forward: [f32; 3],
        /// Tangent of half the horizontal field of view; the runtime rescales the vertical one for another aspect.
        pub tan_half_width: f32,
    }
}
