//! Where a thing is: points, normals and lengths of its own frame in the world's.

use glam::{DMat3, DVec3};
use lang::scene::Instance;

use crate::lower::shutter::Shutter;

/// `world_from_object` at the moment when the shutter opens, split.
pub(in crate::lower) struct Transform {
    pub(in crate::lower) linear: DMat3,
    pub(in crate::lower) translation: DVec3,
    /// Turns normals: the cofactor matrix, signed so that outside stays outside.
    pub(super) normal: DMat3,
    /// The transform mirrors: winding must be reversed.
    pub(super) mirrors: bool,
}

impl Transform {
    pub(in crate::lower) fn of(instance: &Instance, shutter: Shutter) -> Self {
        let (linear, translation) = shutter.pose(instance);
        Self::new(linear, translation)
    }

    pub(in crate::lower) fn new(linear: DMat3, translation: DVec3) -> Self {
        let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let mirrors = linear.determinant() < 0.0;
        let normal = if mirrors { cofactors * -1.0 } else { cofactors };
        Self { linear, translation, normal, mirrors }
    }

    /// All of it, for keys.
    pub(in crate::lower) fn numbers(&self) -> [f64; 12] {
        let [x, y, z] = self.linear.to_cols_array_2d();
        let rows = [x, y, z, self.translation.to_array()];
        std::array::from_fn(|i| rows[i / 3][i % 3])
    }

    pub(in crate::lower) fn point(&self, p: DVec3) -> DVec3 {
        self.linear * p + self.translation
    }

    /// The common length of the axes, or `None` when the transform is not a similarity.
    pub(super) fn uniform_scale(&self) -> Option<f64> {
        let axes = [self.linear.x_axis, self.linear.y_axis, self.linear.z_axis];
        let scale = axes[0].length();
        // Rotations written in degrees leave errors of a few units in the last place.
        let close = |value: f64, to: f64| libm::fabs(value - to) <= 1e-9 * scale * scale;
        let equal = axes.iter().all(|axis| close(axis.length_squared(), scale * scale));
        let square = (0..3).all(|k| close(axes[k].dot(axes[(k + 1) % 3]), 0.0));
        (equal && square && scale > 0.0).then_some(scale)
    }
}

/// A direction as two 16-bit signed normalised integers, x in the low half (Cigolle et al. 2014,
/// "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2)). Zero gives +z.
pub(in crate::lower) fn octahedral(n: DVec3) -> u32 {
    let sum = n.x.abs() + n.y.abs() + n.z.abs();
    let (mut x, mut y) = if sum > 0.0 { (n.x / sum, n.y / sum) } else { (0.0, 0.0) };
    if n.z < 0.0 {
        let sign = |v: f64| if v < 0.0 { -1.0 } else { 1.0 };
        (x, y) = ((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y));
    }
    let quantise = |v: f64| (libm::round(v.clamp(-1.0, 1.0) * 32767.0) as i16) as u16;
    u32::from(quantise(x)) | u32::from(quantise(y)) << 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octahedral_keeps_the_axes_exactly() {
        assert_eq!(octahedral(DVec3::Z), 0);
        assert_eq!(octahedral(DVec3::X), 32767);
        assert_eq!(octahedral(DVec3::NEG_Y), u32::from((-32767_i16) as u16) << 16);
        assert_eq!(octahedral(DVec3::ZERO), 0);
    }
}
