//! A binary tree in the layout that packs have by default.
//!
//! Turns the nodes of a finished binary tree, one root at a time, into `pack::abi::WideNode`s in depth-first
//! order. Leaves keep their references. It keeps the invariants of the pack: children after their parent,
//! no box smaller than it was, no stack longer than `MAX_STACK`.

use std::fmt;
use std::str::FromStr;

use pack::abi::{CHILD_INNER, ChildRef, MAX_STACK, Node, WideNode};
use rayon::prelude::*;
use thiserror::Error;

use super::collapse::Collapse;
use super::quantize::quantize;
use super::words::shift_word;
use super::{BvhError, word_of};

/// How inner nodes are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Layout {
    /// Up to four children, their boxes in 8 bits a coordinate.
    #[default]
    Wide,
    /// Two children, their boxes as they are. The reference.
    Binary,
}

/// What is not the name of a layout.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("unknown node layout `{0}`; expected `wide` or `binary`")]
pub struct UnknownLayout(String);

impl Layout {
    /// Both, the default first.
    pub const ALL: [Self; 2] = [Self::Wide, Self::Binary];

    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wide => "wide",
            Self::Binary => "binary",
        }
    }

    /// Name and version of what makes the nodes. Any change of results must change this.
    #[must_use]
    pub fn recipe(self) -> &'static str {
        match self {
            Self::Wide => "wide4-q8-v1",
            Self::Binary => "binary-v1",
        }
    }
}

impl fmt::Display for Layout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Layout {
    type Err = UnknownLayout;

    fn from_str(name: &str) -> Result<Self, UnknownLayout> {
        let named = |layout: &Self| layout.name() == name;
        Self::ALL.into_iter().find(named).ok_or_else(|| UnknownLayout(name.to_owned()))
    }
}

/// Appends the wide form of the tree below `root` to `out`; returns the reference of its root there.
/// A root that is a leaf, or none, has no nodes.
///
/// # Errors
/// When a box came out smaller than it was: a bug of ours.
pub fn widen(nodes: &[Node], root: u32, out: &mut Vec<WideNode>) -> Result<u32, BvhError> {
    widen_one(&Collapse::best(nodes), nodes, root, out)
}

/// As [`widen`], for several trees in one list of nodes.
///
/// # Errors
/// As [`widen`].
pub fn widen_all(
    nodes: &[Node],
    roots: &[u32],
    out: &mut Vec<WideNode>,
) -> Result<Vec<u32>, BvhError> {
    let best = Collapse::best(nodes);
    roots.iter().map(|root| widen_one(&best, nodes, *root, out)).collect()
}

fn widen_one(
    best: &Collapse<'_>,
    nodes: &[Node],
    root: u32,
    out: &mut Vec<WideNode>,
) -> Result<u32, BvhError> {
    let mut wide = fork(best, root, FORKS)?;
    if wide.need > MAX_STACK {
        // Four children may wait where two did not: a tree that is as deep as binary trees may be stays binary.
        wide = fork(&Collapse::none(nodes), root, FORKS)?;
    }
    let word = shift_word(wide.word, word_of(out.len()), 0);
    wide.append(out);
    Ok(word)
}

/// Levels of nodes whose children are written side by side: work for many threads.
const FORKS: u32 = 3;

/// A subtree of wide nodes, its references from its own beginning.
struct Wide {
    nodes: Vec<WideNode>,
    word: u32,
    /// What may wait on the stack below it.
    need: u32,
}

impl Wide {
    fn append(self, out: &mut Vec<WideNode>) {
        let base = word_of(out.len());
        if out.is_empty() {
            *out = self.nodes;
            return;
        }
        out.extend(self.nodes.into_iter().map(|mut node| {
            for word in [&mut node.child0, &mut node.child1, &mut node.child2, &mut node.child3] {
                *word = shift_word(*word, base, 0);
            }
            node
        }));
    }
}

/// The subtree below `root`, its children side by side on as many levels as `forks` says.
fn fork(collapse: &Collapse<'_>, root: u32, forks: u32) -> Result<Wide, BvhError> {
    let ChildRef::Inner(index) = ChildRef::decode(root) else {
        return Ok(Wide { nodes: Vec::new(), word: root, need: 0 });
    };
    if forks == 0 {
        let mut nodes = Vec::new();
        let (word, need) = write(collapse, root, &mut nodes)?;
        return Ok(Wide { nodes, word, need });
    }
    let mut children = Vec::with_capacity(4);
    collapse.children_of(index, &mut children);
    let below: Vec<Wide> = children
        .par_iter()
        .map(|child| fork(collapse, child.1, forks - 1))
        .collect::<Result<_, _>>()?;
    let mut nodes =
        Vec::with_capacity(1 + below.iter().map(|wide| wide.nodes.len()).sum::<usize>());
    let mut node = quantize(&children)?;
    nodes.push(node);
    let fields = [&mut node.child0, &mut node.child1, &mut node.child2, &mut node.child3];
    let (mut others, mut need) = (0_u32, 0);
    for (field, wide) in fields.into_iter().zip(below) {
        *field = shift_word(wide.word, word_of(nodes.len()), 0);
        (others, need) = (others + 1, need.max(wide.need));
        wide.append(&mut nodes);
    }
    nodes[0] = node;
    Ok(Wide { nodes, word: CHILD_INNER, need: need + others - 1 })
}

/// Returns the reference and what may wait on the stack below it.
fn write(
    collapse: &Collapse<'_>,
    root: u32,
    out: &mut Vec<WideNode>,
) -> Result<(u32, u32), BvhError> {
    let ChildRef::Inner(index) = ChildRef::decode(root) else { return Ok((root, 0)) };
    let mut children = Vec::with_capacity(4);
    collapse.children_of(index, &mut children);
    let at = out.len();
    let mut node = quantize(&children)?;
    out.push(node);
    let fields = [&mut node.child0, &mut node.child1, &mut node.child2, &mut node.child3];
    let (mut others, mut below) = (0_u32, 0);
    for (field, (_, word)) in fields.into_iter().zip(&children) {
        let (word, need) = write(collapse, *word, out)?;
        *field = word;
        others += 1;
        below = need.max(below);
    }
    out[at] = node;
    Ok((CHILD_INNER | word_of(at), below + others - 1))
}
