//! Affine maps between the frames of nodes.

/// Rows of an affine matrix.
pub(super) type Matrix = [[f64; 4]; 3];

/// Leaves everything where it is.
pub(super) const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// `a` after `b`.
pub(super) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |row: &[f64; 4], column: usize| {
        let sum: f64 = (0..3).map(|k| row[k] * b[k][column]).sum();
        if column == 3 { sum + row[3] } else { sum }
    };
    a.map(|row| [0, 1, 2, 3].map(|column| entry(&row, column)))
}

/// Scaled, then turned by a quaternion (x, y, z, w) of any length but 0, then moved; `None` without a rotation.
pub(super) fn from_parts(
    translation: &[f32; 3],
    rotation: &[f32; 4],
    scale: &[f32; 3],
) -> Option<Matrix> {
    let [tx, ty, tz] = translation.map(f64::from);
    let [sx, sy, sz] = scale.map(f64::from);
    let r = rotation_matrix(rotation.map(f64::from))?;
    let row = |r: [f64; 3], t: f64| [r[0] * sx, r[1] * sy, r[2] * sz, t];
    Some([row(r[0], tx), row(r[1], ty), row(r[2], tz)])
}

/// Of a quaternion (x, y, z, w) of any length but 0.
fn rotation_matrix(q: [f64; 4]) -> Option<[[f64; 3]; 3]> {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let [x, y, z, w] = q.map(|c| c / length);
    Some([
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ])
}
