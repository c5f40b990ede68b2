//! Arrows between files become circles: sets of files of which each leads to every other.

use std::collections::BTreeSet;

/// The circles of a graph of `n` nodes: its strongly connected components of more than one node, each ascending.
#[must_use]
pub fn circles(n: usize, arrows: &BTreeSet<(usize, usize)>) -> Vec<Vec<usize>> {
    let forward: Vec<BTreeSet<usize>> = (0..n).map(|from| reached(n, arrows, from)).collect();
    let mut found: Vec<Vec<usize>> = Vec::new();
    for node in 0..n {
        if found.iter().any(|circle| circle.contains(&node)) || !forward[node].contains(&node) {
            continue;
        }
        let back = |other: &usize| forward[*other].contains(&node);
        found.push(forward[node].iter().copied().filter(back).collect());
    }
    found.retain(|circle| circle.len() > 1);
    found
}

/// Where one or more arrows lead from `from`.
fn reached(n: usize, arrows: &BTreeSet<(usize, usize)>, from: usize) -> BTreeSet<usize> {
    let mut seen = BTreeSet::new();
    let mut open = vec![from];
    while let Some(node) = open.pop() {
        for &(_, to) in arrows.range((node, 0)..(node, n)) {
            if seen.insert(to) {
                open.push(to);
            }
        }
    }
    seen
}
