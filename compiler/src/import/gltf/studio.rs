//! Lights and cameras of nodes, in the frame of the file.

use super::super::check::unit;
use super::super::error::{ErrorKind, ImportError};
use super::super::studio::{FileCamera, FileLight, FileView, LightKind, Studio};
use super::document::Document;
use super::matrix::Matrix;
use ::gltf::json::extensions::scene::khr_lights_punctual::{Light, Type};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Camera, Index, Node};

/// Longest name that is kept, in characters.
const MAX_NAME: usize = 256;

/// Adds what a node has of both.
pub(super) fn collect(
    document: &Document<'_>,
    node: &Node,
    file_from_node: &Matrix,
    studio: &mut Studio,
) -> Result<(), ImportError> {
    let extensions = node.extensions.as_ref();
    if let Some(light) = extensions.and_then(|extensions| extensions.khr_lights_punctual.as_ref()) {
        studio.lights.push(light_of(document, node, light.light, file_from_node)?);
    }
    if let Some(camera) = node.camera {
        studio.cameras.push(camera_of(document, node, camera, file_from_node)?);
    }
    Ok(())
}

fn light_of(
    document: &Document<'_>,
    node: &Node,
    index: Index<Light>,
    file_from_node: &Matrix,
) -> Result<FileLight, ImportError> {
    let what = format!("light {}", index.value());
    let Some(light) = document.root.get(index) else {
        return Err(document.error(ErrorKind::Index, &what, "there is no such light"));
    };
    let color = light.color.map(f64::from);
    let intensity = f64::from(light.intensity);
    let spot = light.spot.clone().unwrap_or_default();
    let angles = [spot.inner_cone_angle, spot.outer_cone_angle].map(f64::from);
    let numbers = color.iter().chain(&angles).chain([&intensity]);
    if !numbers.clone().all(|x| x.is_finite()) || color.iter().chain([&intensity]).any(|x| *x < 0.0)
    {
        let message = "its colour, intensity or angles are negative or not finite";
        return Err(document.error(ErrorKind::Number, &what, message));
    }
    let kind = match light.type_ {
        Checked::Valid(Type::Point) => LightKind::Point,
        Checked::Valid(Type::Spot) => LightKind::Spot { inner: angles[0], outer: angles[1] },
        Checked::Valid(Type::Directional) => LightKind::Directional,
        Checked::Invalid => {
            let message = "its type is not directional, point or spot";
            return Err(document.error(ErrorKind::Format, &what, message));
        }
    };
    let name = name(node, light.name.as_deref());
    let (at, along) = (origin(file_from_node), backwards(file_from_node));
    Ok(FileLight { name, kind, color, intensity, at, along })
}

fn camera_of(
    document: &Document<'_>,
    node: &Node,
    index: Index<Camera>,
    file_from_node: &Matrix,
) -> Result<FileCamera, ImportError> {
    let what = format!("camera {}", index.value());
    let Some(camera) = document.root.get(index) else {
        return Err(document.error(ErrorKind::Index, &what, "there is no such camera"));
    };
    let view = match (&camera.perspective, &camera.orthographic) {
        (Some(lens), _) => FileView::Perspective(f64::from(lens.yfov)),
        // The scale of its node does not count; half of the height is stored.
        (None, Some(view)) => FileView::Orthographic(2.0 * f64::from(view.ymag).abs()),
        (None, None) => {
            let message = "it does not say how much it sees";
            return Err(document.error(ErrorKind::Format, &what, message));
        }
    };
    let (is_sound, message) = match view {
        FileView::Perspective(fov) => {
            (fov > 0.0 && fov < std::f64::consts::PI, "its `yfov` is no angle between 0 and pi")
        }
        FileView::Orthographic(height) => {
            (height.is_finite() && height > 0.0, "its `ymag` is 0 or no number")
        }
    };
    if !is_sound {
        return Err(document.error(ErrorKind::Number, &what, message));
    }
    Ok(FileCamera {
        name: name(node, camera.name.as_deref()),
        view,
        from: origin(file_from_node),
        along: backwards(file_from_node),
        up: unit(column(file_from_node, 1)).unwrap_or([0.0, 1.0, 0.0]),
    })
}

fn name(node: &Node, own: Option<&str>) -> String {
    let named = |name: &&str| !name.is_empty();
    let name = node.name.as_deref().filter(named).or(own.filter(named)).unwrap_or_default();
    name.chars().take(MAX_NAME).collect()
}

fn column(matrix: &Matrix, k: usize) -> [f64; 3] {
    matrix.map(|row| row[k])
}

fn origin(matrix: &Matrix) -> [f64; 3] {
    column(matrix, 3)
}

/// Lights shine and cameras look along -z.
fn backwards(matrix: &Matrix) -> [f64; 3] {
    unit(column(matrix, 2).map(|x| -x)).unwrap_or([0.0, 0.0, -1.0])
}
