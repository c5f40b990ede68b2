//! Animations at one time → how each node stands.
//!
//! Channels of glTF 2.0, section 3.11: steps, straight lines, the shorter way round for rotations, and cubic splines.
//! It knows neither meshes nor skins.

use super::super::error::{ErrorKind, ImportError};
use super::super::file::Reader;
use super::accessor::Buffers;
use super::document::{Document, list};
use super::matrix::{Matrix, from_parts};
use ::gltf::json::Node;
use ::gltf::json::animation::{Animation, Interpolation, Property, Sampler};
use ::gltf::json::validation::Checked;
use lang::scene::GltfChoice;
use std::collections::BTreeMap;

/// What animations say of nodes, by index; the others stand as they are stored.
#[derive(Default)]
pub(super) struct Pose(BTreeMap<usize, Stand>);

#[derive(Default)]
struct Stand {
    translation: Option<[f32; 3]>,
    /// A quaternion (x, y, z, w), not of length 1.
    rotation: Option<[f32; 4]>,
    scale: Option<[f32; 3]>,
    weights: Option<Vec<f32>>,
}

impl Pose {
    /// The pose that the scene chooses.
    pub(super) fn of(
        buffers: &Buffers<'_>,
        choice: &GltfChoice,
        reader: &mut Reader<'_>,
    ) -> Result<Self, ImportError> {
        let document = buffers.document;
        let mut pose = Self::default();
        let Some(time) = choice.time else { return Ok(pose) };
        for (index, animation) in chosen(document, choice.animation.as_deref())? {
            for (channel_idx, channel) in animation.channels.iter().enumerate() {
                let what = format!("animation {index} channel {channel_idx}");
                let fail = |message: &str| document.error(ErrorKind::Index, &what, message);
                let node = channel.target.node.value();
                if node >= document.root.nodes.len() {
                    return Err(fail("there is no such node"));
                }
                // Others are of extensions, which are told.
                let Checked::Valid(property) = channel.target.path else { continue };
                let sampler = animation.samplers.get(channel.sampler.value());
                let sampler = sampler.ok_or_else(|| fail("there is no such sampler"))?;
                let track = Track { buffers, sampler, what: &what };
                let stand = pose.0.entry(node).or_default();
                track.move_to(time, property, stand, reader)?;
            }
        }
        Ok(pose)
    }

    /// The node's own transform; `None` when it is projective, without a rotation, or not finite.
    pub(super) fn local_matrix(&self, index: usize, node: &Node) -> Option<Matrix> {
        let stand = self.0.get(&index);
        let moved = stand.filter(|stand| {
            stand.translation.is_some() || stand.rotation.is_some() || stand.scale.is_some()
        });
        let matrix = if let (Some(m), None) = (&node.matrix, moved) {
            let m = m.map(f64::from); // column-major
            if [m[3], m[7], m[11]].iter().any(|x| x.abs() > 0.0) || (m[15] - 1.0).abs() > 1e-6 {
                return None;
            }
            [0, 1, 2].map(|row| [m[row], m[row + 4], m[row + 8], m[row + 12]])
        } else {
            let stored = node.rotation.map_or([0.0, 0.0, 0.0, 1.0], |rotation| rotation.0);
            let translation = moved.and_then(|stand| stand.translation).or(node.translation);
            let rotation = moved.and_then(|stand| stand.rotation).unwrap_or(stored);
            let scale = moved.and_then(|stand| stand.scale).or(node.scale);
            from_parts(&translation.unwrap_or([0.0; 3]), &rotation, &scale.unwrap_or([1.0; 3]))?
        };
        matrix.iter().flatten().all(|x| x.is_finite()).then_some(matrix)
    }

    /// Weights of the morph targets of a node's mesh, if an animation says them.
    pub(super) fn weights(&self, index: usize) -> Option<&[f32]> {
        self.0.get(&index)?.weights.as_deref()
    }
}

/// The animations that are played: the named one, or all if they move different things.
fn chosen<'a>(
    document: &Document<'a>,
    name: Option<&str>,
) -> Result<Vec<(usize, &'a Animation)>, ImportError> {
    let all = || document.root.animations.iter().enumerate();
    let fail = |message: String| Err(ImportError::new(ErrorKind::Choice, document.file, message));
    if document.root.animations.is_empty() {
        return fail("it has no animation, so every `time` is the same".to_owned());
    }
    if let Some(wanted) = name {
        let found: Vec<_> = all().filter(|(_, own)| own.name.as_deref() == Some(wanted)).collect();
        if found.is_empty() {
            return fail(format!("it has no animation `{wanted}`: {}", names(document)));
        }
        return Ok(found);
    }
    let mut moved = BTreeMap::new();
    for (index, animation) in all() {
        let targets = animation.channels.iter().map(|channel| &channel.target);
        for target in targets {
            let Checked::Valid(property) = target.path else { continue };
            let first = *moved.entry((target.node.value(), property as u8)).or_insert(index);
            if first != index {
                let names = names(document);
                return fail(format!("several animations move the same node: {names}")).map_err(
                    |error| error.with_help("name one, for example `animation: \"Walk\"`"),
                );
            }
        }
    }
    Ok(all().collect())
}

/// What can be chosen.
fn names(document: &Document<'_>) -> String {
    let names = document.root.animations.iter().filter_map(|animation| animation.name.as_deref());
    list("its animations are", names)
}

/// A sampler.
struct Track<'a> {
    buffers: &'a Buffers<'a>,
    sampler: &'a Sampler,
    /// Animation and channel, for messages.
    what: &'a str,
}

impl Track<'_> {
    fn move_to(
        &self,
        time: f64,
        property: Property,
        stand: &mut Stand,
        reader: &mut Reader<'_>,
    ) -> Result<(), ImportError> {
        let document = self.buffers.document;
        for index in [self.sampler.input, self.sampler.output] {
            let count = Buffers::count(document, index)?;
            reader.take(count.saturating_mul(16), document.file)?;
        }
        match property {
            Property::Translation => stand.translation = Some(self.vector(time)?),
            Property::Scale => stand.scale = Some(self.vector(time)?),
            Property::Rotation => {
                let values = self.buffers.floats::<4>(self.sampler.output)?;
                let values: Vec<f32> = values.into_iter().flatten().collect();
                stand.rotation = Some(four(&self.sample(&values, Some(4), time, true)?));
            }
            Property::MorphTargetWeights => {
                let values = self.buffers.floats::<1>(self.sampler.output)?;
                let values: Vec<f32> = values.into_iter().flatten().collect();
                let weights = self.sample(&values, None, time, false)?;
                stand.weights = Some(weights.into_iter().map(single).collect());
            }
        }
        Ok(())
    }

    fn vector(&self, time: f64) -> Result<[f32; 3], ImportError> {
        let values = self.buffers.floats::<3>(self.sampler.output)?;
        let values: Vec<f32> = values.into_iter().flatten().collect();
        let [x, y, z, _] = four(&self.sample(&values, Some(3), time, false)?);
        Ok([x, y, z])
    }

    /// Numbers at `time`, so many a key, or as many as there are.
    fn sample(
        &self,
        values: &[f32],
        width: Option<usize>,
        time: f64,
        turns: bool,
    ) -> Result<Vec<f64>, ImportError> {
        let document = self.buffers.document;
        let fail = |message: &str| document.error(ErrorKind::Format, self.what, message);
        let times: Vec<f32> =
            self.buffers.floats::<1>(self.sampler.input)?.into_iter().flatten().collect();
        if times.is_empty() || !times.is_sorted_by(|a, b| a < b) {
            return Err(fail("its times do not rise"));
        }
        let Checked::Valid(interpolation) = self.sampler.interpolation else {
            return Err(fail("its interpolation is not LINEAR, STEP or CUBICSPLINE"));
        };
        // Splines have the tangent before, the value, and the tangent after.
        let parts = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let keys = times.len() * parts;
        let width = width.unwrap_or(values.len() / keys);
        if values.len() != keys * width {
            return Err(fail("it has not as many values as times"));
        }
        let value = |key: usize, part: usize| {
            let at = (key * parts + part) * width;
            values[at..at + width].iter().map(|x| f64::from(*x)).collect::<Vec<f64>>()
        };
        let middle = parts / 2;
        let after = times.partition_point(|t| f64::from(*t) <= time);
        if after == 0 || after == times.len() {
            return Ok(value(after.saturating_sub(1).min(times.len() - 1), middle));
        }
        let before = after - 1;
        let [t0, t1] = [before, after].map(|key| f64::from(times[key]));
        let (step, t) = (t1 - t0, (time - t0) / (t1 - t0));
        let (a, b) = (value(before, middle), value(after, middle));
        Ok(match interpolation {
            Interpolation::Step => a,
            Interpolation::Linear if turns => between(&a, &b, t),
            Interpolation::Linear => mix(&a, &b, [1.0 - t, t]),
            Interpolation::CubicSpline => {
                let (out, into) = (value(before, 2), value(after, 0));
                let (t2, t3) = (t * t, t * t * t);
                let ends = mix(&a, &b, [2.0 * t3 - 3.0 * t2 + 1.0, 3.0 * t2 - 2.0 * t3]);
                let slopes = mix(&out, &into, [step * (t3 - 2.0 * t2 + t), step * (t3 - t2)]);
                mix(&ends, &slopes, [1.0, 1.0])
            }
        })
    }
}

fn mix(a: &[f64], b: &[f64], [of_a, of_b]: [f64; 2]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| of_a * a + of_b * b).collect()
}

/// From unit quaternion `a` to `b` the shorter way round.
fn between(a: &[f64], b: &[f64], t: f64) -> Vec<f64> {
    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let (cos, sign) = (dot.abs().min(1.0), if dot < 0.0 { -1.0 } else { 1.0 });
    let angle = libm::acos(cos);
    let sin = libm::sin(angle);
    // Where they are all but the same, a straight line is as good.
    if sin < 1e-6 {
        return mix(a, b, [1.0 - t, sign * t]);
    }
    let share = |of: f64| libm::sin(of * angle) / sin;
    mix(a, b, [share(1.0 - t), sign * share(t)])
}

/// Numbers that are there, then zeros.
fn four(values: &[f64]) -> [f32; 4] {
    [0, 1, 2, 3].map(|i| values.get(i).copied().map_or(0.0, single))
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
fn single(x: f64) -> f32 {
    x as f32
}
