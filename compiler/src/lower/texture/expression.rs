//! Expressions of textures become the operations of a kernel.
//!
//! Parts are written in order, each leaving its value on the stack, then the operation on them. It knows neither
//! files nor records; images are ids of the texture table.

use lang::scene::{Placement, TextureExpression, TexturePattern};
use pack::abi::{TextureOp, TextureOpKind};

/// Appends the operations that leave the value of `of`. `image` gives those that leave an image.
pub(in crate::lower) fn operations(
    of: &TextureExpression<usize>,
    image: &mut impl FnMut(usize) -> Vec<TextureOp>,
) -> Vec<TextureOp> {
    let mut ops: Vec<TextureOp> =
        of.parts().iter().flat_map(|part| operations(part, image)).collect();
    match of {
        TextureExpression::Number(value) => ops.push(constant([*value as f32; 4])),
        TextureExpression::Color([r, g, b]) => {
            ops.push(constant([*r as f32, *g as f32, *b as f32, 1.0]));
        }
        TextureExpression::Image(texture) => ops.extend(image(*texture)),
        TextureExpression::Channel(texture, channel) => {
            ops.extend(image(*texture));
            ops.push(TextureOp { arg: u32::from(*channel), ..plain(TextureOpKind::Channel) });
        }
        TextureExpression::VertexColor => ops.push(plain(TextureOpKind::VertexColor)),
        TextureExpression::VertexChannel(channel) => {
            ops.push(plain(TextureOpKind::VertexColor));
            ops.push(TextureOp { arg: u32::from(*channel), ..plain(TextureOpKind::Channel) });
        }
        TextureExpression::Pattern(of) => ops.push(pattern(of)),
        TextureExpression::Sum(_) => ops.push(plain(TextureOpKind::Add)),
        TextureExpression::Product(_) => ops.push(plain(TextureOpKind::Multiply)),
        TextureExpression::Mix(_) => ops.push(plain(TextureOpKind::Mix)),
        TextureExpression::Clamp(_, [low, high]) => {
            let p = [*low as f32, *high as f32, 0.0, 0.0];
            ops.push(TextureOp { p, ..plain(TextureOpKind::Clamp) });
        }
    }
    ops
}

/// Whether any of these operations reads the colours of vertices.
pub(super) fn reads_vertex_colors(ops: &[TextureOp]) -> bool {
    ops.iter().any(|op| op.kind == TextureOpKind::VertexColor as u32)
}

/// Whether any of these operations depends on texture coordinates.
pub(super) fn reads_uvs(ops: &[TextureOp]) -> bool {
    let leaf = |op: &TextureOp| {
        TextureOpKind::from_tag(op.kind).is_some_and(|kind| {
            kind.operands() == 0
                && !matches!(kind, TextureOpKind::Constant | TextureOpKind::VertexColor)
        })
    };
    ops.iter().any(leaf)
}

/// The colour of the vertices, times the image with this id in the texture table, if there is one.
pub(in crate::lower) fn vertex_color(image: Option<u32>) -> Vec<TextureOp> {
    let color = plain(TextureOpKind::VertexColor);
    match image {
        None => vec![color],
        Some(id) => {
            vec![self::image(id, &Placement::NONE), color, plain(TextureOpKind::Multiply)]
        }
    }
}

/// The same value everywhere.
pub(in crate::lower) fn constant(p: [f32; 4]) -> TextureOp {
    TextureOp { p, ..plain(TextureOpKind::Constant) }
}

/// Puts the number on top of the stack into channel `channel` of the value below it.
pub(in crate::lower) fn insert(channel: usize) -> TextureOp {
    TextureOp { arg: channel as u32, ..plain(TextureOpKind::Insert) }
}

/// The image with this id in the texture table, where `placement` puts it.
pub(in crate::lower) fn image(id: u32, placement: &Placement) -> TextureOp {
    let (matrix, offset) = placement.matrix();
    TextureOp { arg: id, ..placed(TextureOpKind::Image, matrix, offset) }
}

/// The id of the image that an operation reads.
pub(super) fn image_of(op: &TextureOp) -> Option<u32> {
    (op.kind == TextureOpKind::Image as u32).then_some(op.arg)
}

/// What follows the image of a normal map: its x and y point along the axes of the image, which are turned against
/// those of the surface where the coordinates are.
///
/// A map of heights h(M uv) has the gradient M^T grad h. Only the directions of the axes count: a normal map has slopes
/// and not heights, whatever its size.
pub(in crate::lower) fn tilt(placement: &Placement) -> TextureOp {
    let (sin, cos) = (libm::sin(placement.rotate) as f32, libm::cos(placement.rotate) as f32);
    let [u, v] = placement.scale.map(|scale| if scale < 0.0 { -1.0 } else { 1.0 });
    TextureOp { p: [u * cos, u * sin, -v * sin, v * cos], ..plain(TextureOpKind::Tilt) }
}

fn plain(kind: TextureOpKind) -> TextureOp {
    TextureOp { kind: kind as u32, ..TextureOp::default() }
}

fn placed(kind: TextureOpKind, matrix: [f64; 4], [u, v]: [f64; 2]) -> TextureOp {
    let q = [u as f32, v as f32, 0.0, 0.0];
    TextureOp { p: matrix.map(|x| x as f32), q, ..plain(kind) }
}

fn pattern(of: &TexturePattern) -> TextureOp {
    let along = |kind, count: f64, angle: f64| {
        let matrix = [count * libm::cos(angle), count * libm::sin(angle), 0.0, 0.0];
        placed(kind, matrix, [0.0; 2])
    };
    match *of {
        // As many along w as along u: both are level where v is up.
        TexturePattern::Checker([u, v]) => {
            let mut op = placed(TextureOpKind::Checker, [u, 0.0, 0.0, v], [0.0; 2]);
            op.q[2] = u as f32;
            op
        }
        TexturePattern::Bricks { count: [u, v], mortar } => {
            // As wide between the ends of bricks as between rows: half of it belongs to each brick.
            let mut op = placed(TextureOpKind::Bricks, [u, 0.0, 0.0, v], [0.0; 2]);
            op.q[2] = (0.5 * mortar * u / v) as f32;
            op.q[3] = (0.5 * mortar) as f32;
            op
        }
        TexturePattern::Gradient(angle) => along(TextureOpKind::Gradient, 1.0, angle),
        TexturePattern::Wave { count, angle } => along(TextureOpKind::Wave, count, angle),
        TexturePattern::Noise { count, octaves } => {
            let mut op = placed(TextureOpKind::Noise, [count, 0.0, 0.0, count], [0.0; 2]);
            (op.arg, op.q[2]) = (octaves, count as f32);
            op
        }
    }
}

/// A guess at the mean, from the means of the images: for the brightness of lights, which only decides how often they
/// are chosen. At least a thousandth of what the value may be, since a part of it may give light.
pub(super) fn mean(ops: &[TextureOp], image: impl Fn(u32) -> [f64; 4]) -> [f64; 4] {
    const LEAST: f64 = 1e-3;
    let mut stack: Vec<[Guess; 4]> = Vec::new();
    for op in ops {
        let Some(kind) = TextureOpKind::from_tag(op.kind) else { continue };
        let args = stack.split_off(stack.len().saturating_sub(kind.operands()));
        let lanes = |f: &dyn Fn(usize) -> Guess| [0, 1, 2, 3].map(f);
        stack.push(match (kind, args.as_slice()) {
            (TextureOpKind::Constant, _) => op.p.map(|x| Guess::of(f64::from(x))),
            (TextureOpKind::Image, _) => image(op.arg).map(Guess::of),
            (TextureOpKind::Channel, [a]) => [a[op.arg.min(3) as usize]; 4],
            (TextureOpKind::Clamp, [a]) => a.map(|x| x.clamp(op.p[0], op.p[1])),
            (TextureOpKind::Tilt, [a]) => *a,
            (TextureOpKind::Insert, [a, b]) => {
                lanes(&|k| if k == op.arg as usize { b[0] } else { a[k] })
            }
            (TextureOpKind::Multiply, [a, b]) => lanes(&|k| a[k].times(b[k])),
            (TextureOpKind::Add, [a, b]) => lanes(&|k| a[k].plus(b[k])),
            (TextureOpKind::Mix, [a, b, t]) => {
                let one = Guess::of(1.0);
                lanes(&|k| a[k].times(one.plus(t[k].times(Guess::of(-1.0)))).plus(b[k].times(t[k])))
            }
            // Patterns.
            _ => [Guess { mean: 0.5, most: 1.0 }; 4],
        });
    }
    let top = stack.pop().unwrap_or([Guess::of(1.0); 4]);
    top.map(|guess| guess.mean.max(LEAST * guess.most))
}

/// What is thought of a value that differs from place to place.
#[derive(Clone, Copy)]
struct Guess {
    mean: f64,
    /// About the largest magnitude.
    most: f64,
}

impl Guess {
    fn of(x: f64) -> Self {
        Self { mean: x, most: x.abs() }
    }

    fn times(self, other: Self) -> Self {
        Self { mean: self.mean * other.mean, most: self.most * other.most }
    }

    fn plus(self, other: Self) -> Self {
        Self { mean: self.mean + other.mean, most: self.most + other.most }
    }

    fn clamp(self, low: f32, high: f32) -> Self {
        let (low, high) = (f64::from(low), f64::from(high));
        let mean = self.mean.max(low).min(high);
        Self { mean, most: self.most.min(low.abs().max(high.abs())).max(mean.abs()) }
    }
}
