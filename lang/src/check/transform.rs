//! `at`, `rotate` and `scale`, or `at` and `axes`, become one 3x4 matrix; `velocity` and keys go along with it.

use std::rc::Rc;

use super::exclusive::one_of;
use super::fields::{Fields, moments};
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Key;
use crate::scene::{Motion, MotionKey, at_time};

const AXES: [&str; 3] = ["axes.x", "axes.y", "axes.z"];

/// Rows of a 3x4 matrix, target from source.
pub(super) type Matrix = [[f64; 4]; 3];

/// Where something is, and how it moves, in the frame of what holds it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pose {
    /// At the moment 0.
    pub(super) matrix: Matrix,
    /// Metres per second.
    pub(super) velocity: [f64; 3],
    /// How it moves beside that.
    pub(super) way: Way,
}

/// A way from key to key.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Way {
    /// There are no keys.
    Still,
    Keys(Rc<Motion>),
    /// There are keys that do not go together.
    Not(Mixed),
}

/// Why keys do not go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mixed {
    /// What turns is in a group that is stretched.
    Stretched,
    /// What moves is in a group that turns.
    Twice,
}

/// The pose of an object or an instance.
pub(super) fn pose(fields: &Fields) -> Option<Pose> {
    let velocity = fields.vector("velocity")?;
    Some(Pose { matrix: matrix(fields)?, velocity, way: way(fields)? })
}

fn way(fields: &Fields) -> Option<Way> {
    let keys = ["at", "rotate"].map(|name| fields.keys(name));
    let times = moments(keys.iter().flatten().map(|keys| &**keys));
    if times.is_empty() {
        return Some(Way::Still);
    }
    let key = |time: f64| {
        let at = fields.triple_at("at", time)?;
        Some(MotionKey { time, at, rotate: fields.triple_at("rotate", time)? })
    };
    let keys = times.into_iter().map(key).collect::<Option<_>>()?;
    Some(Way::Keys(Rc::new(Motion { frame: SQUARE, keys })))
}

/// Columns of the matrix that changes nothing.
const SQUARE: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Reports axes that are not all there, or beside what they stand for.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    if fields.keys("at").is_some() {
        one_of(ev, fields, &["at", "velocity"], "how it moves");
    }
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

/// Of something in `inner`, which is in `outer`: the inner velocity and keys are turned and scaled by the outer
/// matrix, and the outer ones added.
pub(super) fn nested(outer: &Pose, inner: &Pose) -> Pose {
    let (mut velocity, v) = (outer.velocity, inner.velocity);
    for (component, row) in velocity.iter_mut().zip(&outer.matrix) {
        *component += row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
    }
    let way = nested_way(outer, inner);
    Pose { matrix: product(&outer.matrix, &inner.matrix), velocity, way }
}

fn nested_way(outer: &Pose, inner: &Pose) -> Way {
    let turning = matches!(&outer.way, Way::Keys(motion) if motion.turns());
    match (&outer.way, &inner.way) {
        (Way::Not(why), _) | (_, Way::Not(why)) => Way::Not(*why),
        (_, Way::Still) if turning && inner.velocity.iter().any(|c| c.abs() > 0.0) => {
            Way::Not(Mixed::Twice)
        }
        (way, Way::Still) => way.clone(),
        (_, Way::Keys(_)) if turning => Way::Not(Mixed::Twice),
        (way, Way::Keys(own)) => {
            let around = match way {
                Way::Keys(motion) => motion.keys.as_slice(),
                Way::Still | Way::Not(_) => &[],
            };
            let frame = if own.turns() { rotation(&outer.matrix) } else { Some(SQUARE) };
            let Some(frame) = frame else { return Way::Not(Mixed::Stretched) };
            let frame = own
                .frame
                .map(|column| [0, 1, 2].map(|row| (0..3).map(|k| frame[k][row] * column[k]).sum()));
            let places = |keys: &[MotionKey]| -> Vec<Key> {
                keys.iter().map(|key| (key.time, key.at)).collect()
            };
            let times = moments([places(around), places(&own.keys)].iter().map(Vec::as_slice));
            let key = |time: f64| {
                let inner = at_time(&own.keys, time);
                let come = |row: usize| match around {
                    [] => 0.0,
                    keys => at_time(keys, time).at[row] - at_time(keys, 0.0).at[row],
                };
                let at = |row: usize| {
                    let m = outer.matrix[row];
                    m[0] * inner.at[0] + m[1] * inner.at[1] + m[2] * inner.at[2] + m[3] + come(row)
                };
                MotionKey { time, at: [0, 1, 2].map(at), rotate: inner.rotate }
            };
            Way::Keys(Rc::new(Motion { frame, keys: times.into_iter().map(key).collect() }))
        }
    }
}

/// Columns of the rotation of a matrix that turns, moves, mirrors and scales alike in all directions; `None` for others.
/// What is mirrored turns as what it mirrors does about the opposite of its axes: the rotation is that of the negative.
fn rotation(m: &Matrix) -> Option<[[f64; 3]; 3]> {
    let columns = [0, 1, 2].map(|k| [m[0][k], m[1][k], m[2][k]]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let size = dot(columns[0], columns[0]);
    let close = |value: f64, to: f64| (value - to).abs() <= 1e-9 * size;
    let even = columns.iter().all(|column| close(dot(*column, *column), size));
    let square = (0..3).all(|k| close(dot(columns[k], columns[(k + 1) % 3]), 0.0));
    let scale = size.sqrt().copysign(determinant(m));
    (even && square).then(|| columns.map(|column| column.map(|x| x / scale)))
}

fn determinant(m: &Matrix) -> f64 {
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
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
    let keys = match &pose.way {
        Way::Keys(motion) => motion.keys.as_slice(),
        Way::Still | Way::Not(_) => &[],
    };
    let near = |key: &MotionKey| key.at.iter().all(|v| v.abs() <= crate::schema::MAX_MAGNITUDE);
    let determinant = determinant(m);
    finite && keys.iter().all(near) && determinant.is_finite() && determinant.abs() > 1e-60
}
