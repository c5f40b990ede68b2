//! How the numbers of a file become metres with +Y up.

use lang::scene::Axis;

/// How the numbers of a file become metres with +Y up.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) metres_per_unit: f64,
    pub(super) up: Axis,
}

impl Frame {
    /// Turns the `up` axis to +Y.
    pub(super) fn turn(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self.up {
            Axis::PlusY => [x, y, z],
            Axis::MinusY => [x, -y, -z],
            Axis::PlusZ => [x, z, -y],
            Axis::MinusZ => [x, -z, y],
            Axis::PlusX => [-y, x, z],
            Axis::MinusX => [y, -x, z],
        }
    }

    /// A position of the file in metres.
    pub(super) fn position(self, p: [f32; 3]) -> [f64; 3] {
        self.turn(p.map(|x| f64::from(x) * self.metres_per_unit))
    }
}
