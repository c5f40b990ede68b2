//! `at`, `rotate` and `scale` become one 3x4 matrix.

use super::fields::Fields;

/// Rows of a 3x4 matrix, target from source.
pub(super) type Matrix = [[f64; 4]; 3];

/// The matrix of an object or an instance: scale, then rotate about x, y and z, then translate.
pub(super) fn matrix(fields: &Fields) -> Option<Matrix> {
    let at = fields.vector::<3>("at")?;
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

/// `outer` after `inner`.
pub(super) fn product(outer: &Matrix, inner: &Matrix) -> Matrix {
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
pub(super) fn is_sound(m: &Matrix) -> bool {
    let finite = m.iter().flatten().all(|v| v.abs() <= crate::schema::MAX_MAGNITUDE);
    let determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    finite && determinant.is_finite() && determinant.abs() > 1e-60
}
