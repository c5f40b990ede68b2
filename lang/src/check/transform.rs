//! `at`, `rotate` and `scale`, or `at` and `axes`, become one 3x4 matrix; `velocity` goes along with it.

use super::exclusive::one_of;
use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;

const AXES: [&str; 3] = ["axes.x", "axes.y", "axes.z"];

/// Rows of a 3x4 matrix, target from source.
pub(super) type Matrix = [[f64; 4]; 3];

/// Where something is, and how it moves, in the frame of what holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) matrix: Matrix,
    /// Metres per second.
    pub(super) velocity: [f64; 3],
}

/// The pose of an object or an instance.
pub(super) fn pose(fields: &Fields) -> Option<Pose> {
    Some(Pose { matrix: matrix(fields)?, velocity: fields.vector("velocity")? })
}

/// Reports axes that are not all there, or beside what they stand for.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    let written = |name: &&str| fields.has(name);
    let Some(first) = AXES.into_iter().find(|name| written(name)) else { return };
    one_of(ev, fields, &["rotate", first], "how it is turned");
    one_of(ev, fields, &["scale", first], "how large it is");
    if let Some(missing) = AXES.into_iter().find(|name| fields.span(name).is_none())
        && let Some(span) = fields.span(first)
    {
        let error = Diagnostic::error(Code("E0207"), format!("`{missing}` is missing"));
        ev.fault(
            error.at(span, "one of three axes").with_help("write all three axes, or `rotate`"),
        );
    }
}

/// Scale, then rotate about x, y and z, then translate.
fn matrix(fields: &Fields) -> Option<Matrix> {
    let at = fields.vector::<3>("at")?;
    if fields.has(AXES[0]) {
        let [x, y, z] = AXES.map(|name| fields.vector::<3>(name));
        let (x, y, z) = (x?, y?, z?);
        return Some([0, 1, 2].map(|row| [x[row], y[row], z[row], at[row]]));
    }
    let [x, y, z] = fields.vector::<3>("rotate")?;
    let scale = fields.vector::<3>("scale")?;
    let ((sx, cx), (sy, cy), (sz, cz)) = (sin_cos(x), sin_cos(y), sin_cos(z));
    // Rz * Ry * Rx, so that x comes first.
    let rotation = [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ];
    let mut rows = [[0.0; 4]; 3];
    for (row, (turned, offset)) in rows.iter_mut().zip(rotation.iter().zip(at)) {
        for i in 0..3 {
            row[i] = turned[i] * scale[i];
        }
        row[3] = offset;
    }
    Some(rows)
}

/// At `at`, with +y turned to the unit vector `direction`, then turned about that by `spin`. Unless `direction` is
/// vertical, x is level before the spin, and z points up.
pub(super) fn facing(at: [f64; 3], direction: [f64; 3], spin: f64) -> Matrix {
    let y = direction;
    // The horizontal vector across `direction`.
    let level = libm::hypot(y[0], y[2]);
    let x = if level > 1e-6 { [-y[2] / level, 0.0, y[0] / level] } else { [1.0, 0.0, 0.0] };
    let z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
    let (sin, cos) = sin_cos(spin);
    [0, 1, 2].map(|row| [cos * x[row] - sin * z[row], y[row], sin * x[row] + cos * z[row], at[row]])
}

/// Sine and cosine, exact at quarter turns, where people expect zeros.
fn sin_cos(angle: f64) -> (f64, f64) {
    let quarters = angle / std::f64::consts::FRAC_PI_2;
    let nearest = quarters.round();
    if (quarters - nearest).abs() > 1e-12 || nearest.abs() > 1e6 {
        return (libm::sin(angle), libm::cos(angle));
    }
    match nearest.rem_euclid(4.0) {
        0.0 => (0.0, 1.0),
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

/// Of something in `inner`, which is in `outer`: the inner velocity is turned and scaled by the outer
/// matrix, and the outer one added.
pub(super) fn nested(outer: &Pose, inner: &Pose) -> Pose {
    let (mut velocity, v) = (outer.velocity, inner.velocity);
    for (component, row) in velocity.iter_mut().zip(&outer.matrix) {
        *component += row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
    }
    Pose { matrix: product(&outer.matrix, &inner.matrix), velocity }
}

/// `outer` after `inner`.
fn product(outer: &Matrix, inner: &Matrix) -> Matrix {
    let mut rows = [[0.0; 4]; 3];
    for (row, o) in rows.iter_mut().zip(outer) {
        for (i, cell) in row.iter_mut().enumerate() {
            *cell = o[0] * inner[0][i] + o[1] * inner[1][i] + o[2] * inner[2][i];
        }
        row[3] += o[3];
    }
    rows
}

/// No entry is too large, and no axis is flattened to nothing.
pub(super) fn is_sound(pose: &Pose) -> bool {
    let m = &pose.matrix;
    let finite =
        m.iter().flatten().chain(&pose.velocity).all(|v| v.abs() <= crate::schema::MAX_MAGNITUDE);
    let determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    finite && determinant.is_finite() && determinant.abs() > 1e-60
}
