//! The tree of lights: every light of a surface is in one leaf, at the end of its trail.
//!
//! The kernel walks down without looking: children must exist and come after their parents, and trails must
//! end where the walk for their light ends.

use crate::abi::{LIGHT_LEAF, Light, LightNode, MAX_LIGHT_DEPTH};
use crate::contents::Contents;
use crate::error::PackError;
use crate::fault::ElementFault;

use super::broken::element;

/// Checks the shape of the tree; fields of nodes have been checked. Scenes without a tree have no nodes.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let (nodes, lights) = (contents.light_nodes, contents.lights);
    // Without a tree there are no ways, and only surfaces are in one.
    let astray = |light: &Light| light.trail != 0 && (nodes.is_empty() || !light.has_surface());
    if let Some(index) = lights.iter().position(astray) {
        let fault = ElementFault::Trail { found: lights[index].trail, expected: 0 };
        return Err(element::<Light>(index, ("trail", fault)));
    }
    if nodes.is_empty() {
        return Ok(());
    }
    let fault = |node: usize, fault| Err(element::<LightNode>(node, ("child", fault)));
    // Nodes in the order of the walk: first children directly behind their parents.
    let mut open = vec![(0_usize, 0_u32, 0_u32)];
    let mut next = 0;
    let mut found = vec![false; lights.len()];
    while let Some((at, trail, depth)) = open.pop() {
        if at != next || at >= nodes.len() {
            return fault(at.min(nodes.len() - 1), ElementFault::LightOrder);
        }
        next += 1;
        let child = nodes[at].child;
        if child & LIGHT_LEAF == 0 {
            if depth == MAX_LIGHT_DEPTH {
                return fault(at, ElementFault::LightDepth);
            }
            open.push((child as usize, trail | 1 << depth, depth + 1));
            open.push((at + 1, trail, depth + 1));
            continue;
        }
        let light = child & !LIGHT_LEAF;
        let known = lights.get(light as usize).filter(|l| l.has_surface());
        let Some(known) = known.filter(|_| !found[light as usize]) else {
            return fault(at, ElementFault::LightLeaf(light));
        };
        found[light as usize] = true;
        if known.trail != trail {
            let fault = ElementFault::Trail { found: known.trail, expected: trail };
            return Err(element::<Light>(light as usize, ("trail", fault)));
        }
    }
    if next != nodes.len() {
        return fault(next, ElementFault::LightOrder);
    }
    let lost =
        |(index, found): (usize, &bool)| (!found && lights[index].has_surface()).then_some(index);
    match found.iter().enumerate().find_map(lost) {
        None => Ok(()),
        Some(index) => Err(element::<Light>(index, ("trail", ElementFault::LightLost))),
    }
}
