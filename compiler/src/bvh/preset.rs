//! Which tree is built: names that `rtc --bvh` takes, and what they stand for.
//!
//! The first three are for use. The medians are what textbooks begin with; they are there so that
//! the others have something to be compared with.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::build::Rule;

/// A way to build trees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Preset {
    /// Binned surface-area heuristic, no spatial splits: every triangle is in one leaf. Quickest to
    /// build; the oracle for the others.
    Fast,
    /// Surface-area heuristic with spatial splits where they pay.
    #[default]
    Default,
    /// As `Default`, with twice the planes, tried in more nodes, and twice the room for references.
    Extreme,
    /// Halves by number along the widest axis. For comparison.
    ObjectMedian,
    /// Halves by space along the widest axis. For comparison.
    SpatialMedian,
}

/// What is not the name of a preset.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("unknown BVH builder `{0}`; expected one of {list}", list = Preset::list())]
pub struct UnknownPreset(String);

/// How many planes spatial splits are looked for among.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fineness {
    /// Between 16 slabs an axis, 8 in small nodes.
    Coarse,
    /// Between 32 slabs an axis, 16 in small nodes.
    Fine,
}

/// How spatial splits are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpatialRules {
    /// How many planes are tried.
    pub(super) bins: Fineness,
    /// References beyond one a triangle, in hundredths of the number of triangles.
    pub(super) extra: usize,
    /// Spatial splits are looked for where the children of the best object split overlap by this part
    /// of their parent's area.
    pub(super) min_overlap: f32,
    /// How many may be looked for in vain, one below the other, before only samples of large nodes are asked;
    /// `None`: any number.
    pub(super) patience: Option<u32>,
}

impl Preset {
    /// Every preset: those for use from quick to thorough, then those for comparison.
    pub const ALL: [Self; 5] =
        [Self::Fast, Self::Default, Self::Extreme, Self::ObjectMedian, Self::SpatialMedian];

    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Default => "default",
            Self::Extreme => "extreme",
            Self::ObjectMedian => "object-median",
            Self::SpatialMedian => "spatial-median",
        }
    }

    /// Name, version and parameters of the builder: everything that the shape of a tree depends on
    /// besides the primitives. Any change of results must change this.
    #[must_use]
    pub fn recipe(self) -> &'static str {
        match self {
            Self::Fast => "binned16-sweep24-v1, leaf 8, inner levels 47, node cost 1",
            Self::Default => {
                "sbvh16-v3, leaf 8, inner levels 47, node cost 1, extra 0.3, overlap 0.1, patience 6"
            }
            Self::Extreme => {
                "sbvh32-v3, leaf 8, inner levels 47, node cost 1, extra 0.6, overlap 0.01"
            }
            Self::ObjectMedian => "object-median-v1, leaf 2, inner levels 47",
            Self::SpatialMedian => "spatial-median-v1, leaf 2, inner levels 47",
        }
    }

    /// How triangles are split; `None` where they are not.
    pub(super) fn spatial(self) -> Option<SpatialRules> {
        match self {
            Self::Default => {
                let (bins, patience) = (Fineness::Coarse, Some(6));
                Some(SpatialRules { bins, extra: 30, min_overlap: 0.1, patience })
            }
            Self::Extreme => {
                let (bins, patience) = (Fineness::Fine, None);
                Some(SpatialRules { bins, extra: 60, min_overlap: 0.01, patience })
            }
            Self::Fast | Self::ObjectMedian | Self::SpatialMedian => None,
        }
    }

    /// Where ranges are divided that are not split in space.
    pub(super) fn rule(self) -> Rule {
        match self {
            Self::ObjectMedian => Rule::ObjectMedian,
            Self::SpatialMedian => Rule::SpatialMedian,
            Self::Fast | Self::Default | Self::Extreme => Rule::Cost,
        }
    }

    /// Whether trees depend on more than the boxes of the primitives.
    #[must_use]
    pub fn splits_triangles(self) -> bool {
        self.spatial().is_some()
    }

    fn list() -> String {
        Self::ALL.map(|p| format!("`{p}`")).join(", ")
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Preset {
    type Err = UnknownPreset;

    fn from_str(name: &str) -> Result<Self, UnknownPreset> {
        let named = |preset: &Self| preset.name() == name;
        Self::ALL.into_iter().find(named).ok_or_else(|| UnknownPreset(name.to_owned()))
    }
}
