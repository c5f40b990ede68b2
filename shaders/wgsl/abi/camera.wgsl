// Thin-lens perspective camera. World frame, normalised units (see `RenderSettings`).
struct Camera {
    // Centre of the lens.
    origin: vec3<f32>,
    // Radius of the lens; 0 is a pinhole.
    lens_radius: f32,
    // Unit vector to the right of the image.
    right: vec3<f32>,
    // Tangent of half the vertical field of view at the film's aspect ratio.
    tan_half_height: f32,
    // Unit vector to the top of the image.
    up: vec3<f32>,
    // Distance from `origin` to the plane of focus, along `forward`.
    focus_distance: f32,
    // Unit viewing direction.
    forward: vec3<f32>,
    // Tangent of half the horizontal field of view; the runtime rescales the vertical one for another aspect.
    tan_half_width: f32,
}
