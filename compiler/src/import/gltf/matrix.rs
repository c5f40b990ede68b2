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
