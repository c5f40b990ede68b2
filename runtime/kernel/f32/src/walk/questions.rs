//! What has to be asked about a hit on a triangle.
//!
//! Turns a triangle's light and material into two bits, which a block keeps beside its number: whether the hit may not
//! count, and whether a shadow ray may go on behind it. Of most triangles neither has to be asked, and the records that
//! would answer lie far away in memory. It does not know the answers.

use pack::abi::{Instance, Material, NONE, TriShade, material_flag};
use std::ops::BitOr;

/// What has to be asked about a hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Questions(u32);

impl Questions {
    /// None: it counts, and hides every light.
    const NOTHING: Self = Self(0);
    /// Whether it counts: alpha may cut it out, or it is a light, which a shadow ray may be on its way to.
    const COUNTS: Self = Self(1 << 31);
    /// Whether it ends a shadow ray.
    const ENDS: Self = Self(1 << 30);
    const ALL: Self = Self(Self::COUNTS.0 | Self::ENDS.0);

    fn of_material(materials: &[Material], i: u32) -> Self {
        let Some(material) = materials.get(i as usize) else { return Self::ALL };
        let cut = material_flag::ALPHA_CLIP | material_flag::ALPHA_BLEND;
        let if_any = |flags: u32, question| {
            if material.flags & flags == 0 { Self::NOTHING } else { question }
        };
        if_any(cut, Self::COUNTS) | if_any(material_flag::THROUGH, Self::ENDS)
    }

    /// Those about a triangle with the material of its own mesh.
    pub(super) fn of(materials: &[Material], shade: Option<&TriShade>) -> Self {
        let Some(shade) = shade else { return Self::ALL };
        let light = if shade.light == NONE { Self::NOTHING } else { Self::COUNTS };
        light | Self::of_material(materials, shade.material)
    }

    /// What there is to ask of a triangle beside its own questions in any of the instances.
    pub(super) fn of_instances(materials: &[Material], instances: &[Instance]) -> Self {
        let replaced = instances.iter().filter(|instance| instance.material != NONE);
        let each = replaced.map(|instance| Self::of_material(materials, instance.material));
        each.fold(Self::NOTHING, |all, new| all | new)
    }

    /// Whether a hit has to be asked whether it counts.
    #[must_use]
    #[inline(always)]
    pub fn counts(self) -> bool {
        self.0 & Self::COUNTS.0 != 0
    }

    /// Whether a hit has to be asked whether it ends a shadow ray.
    #[must_use]
    #[inline(always)]
    pub fn ends(self) -> bool {
        self.0 & Self::ENDS.0 != 0
    }
}

impl BitOr for Questions {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

/// A triangle of the pack, and what has to be asked about a hit on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marked(u32);

impl Marked {
    /// No triangle.
    pub(super) const NONE: Self = Self(NONE);

    /// Triangle `i`, below 2^27 as in every tree.
    pub(super) fn new(i: u32, questions: Questions) -> Self {
        Self(i | questions.0)
    }

    /// Its number; for `NONE` one that no triangle has.
    #[must_use]
    #[inline(always)]
    pub fn index(self) -> u32 {
        self.0 & !Questions::ALL.0
    }

    /// Whether there is none.
    #[must_use]
    #[inline(always)]
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// What has to be asked.
    #[must_use]
    #[inline(always)]
    pub fn questions(self) -> Questions {
        Questions(self.0 & Questions::ALL.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plain material, one that is clipped, one that blends, and one that lets light through.
    fn materials() -> [Material; 4] {
        let flags =
            [0, material_flag::ALPHA_CLIP, material_flag::ALPHA_BLEND, material_flag::THROUGH];
        flags.map(|flags| Material { flags, ..Material::default() })
    }

    fn of(material: u32, light: u32) -> [bool; 2] {
        let shade = TriShade { material, light, ..TriShade::default() };
        let questions = Questions::of(&materials(), Some(&shade));
        [questions.counts(), questions.ends()]
    }

    #[test]
    fn what_is_asked_depends_on_the_material_and_on_the_light() {
        let each = [0, 1, 2, 3, 4].map(|material| of(material, NONE));
        let [nothing, counts, ends] = [[false, false], [true, false], [false, true]];
        assert_eq!(each, [nothing, counts, counts, ends, [true, true]]);
        assert_eq!(of(0, 7), counts);
        assert_eq!(of(3, 7), [true, true]);
        assert_eq!(Questions::of(&materials(), None), Questions::ALL);
    }

    #[test]
    fn instances_add_what_their_own_materials_ask() {
        let instance = |material| Instance { material, ..Instance::default() };
        let of = |each: &[u32]| {
            let instances: Vec<Instance> = each.iter().map(|i| instance(*i)).collect();
            let questions = Questions::of_instances(&materials(), &instances);
            [questions.counts(), questions.ends()]
        };
        assert_eq!(of(&[NONE, 0]), [false, false]);
        assert_eq!(of(&[1, NONE]), [true, false]);
        assert_eq!(of(&[0, 3, 2]), [true, true]);
    }

    #[test]
    fn a_triangle_keeps_its_number_beside_the_questions() {
        for i in [0, 1, (1 << 27) - 1] {
            for questions in
                [Questions::NOTHING, Questions::COUNTS, Questions::ENDS, Questions::ALL]
            {
                let marked = Marked::new(i, questions);
                assert_eq!((marked.index(), marked.questions()), (i, questions));
                assert!(!marked.is_none());
            }
        }
        assert!(Marked::NONE.is_none());
    }
}
