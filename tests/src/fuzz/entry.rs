//! An entry of the tree cache: what is loaded is a tree of the very primitives, and what is refused
//! changes nothing but the time.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use compiler::bvh::{self, Input, Preset, Tree};
use compiler::cache::{Cache, MIN_PRIMITIVES, Source};
use pack::abi::ChildRef;

/// The quickest to build.
const PRESET: Preset = Preset::ObjectMedian;
/// Where BLAKE3 of all other bytes is, as `compiler/src/cache/entry.rs` describes the layout.
const HASH: std::ops::Range<usize> = 64..96;

/// Just enough to be kept.
static TRIANGLES: LazyLock<Vec<[[f32; 3]; 3]>> = LazyLock::new(|| {
    let at = |i: usize| [i % 16, i / 16, i % 7].map(|x| u8::try_from(x).map_or(0.0, f32::from));
    let triangle = |i: usize| {
        let [x, y, z] = at(i);
        [[x, y, z], [x + 1.5, y, z], [x, y + 1.25, z + 0.5]]
    };
    (0..MIN_PRIMITIVES).map(triangle).collect()
});

static BUILT: LazyLock<Tree> = LazyLock::new(|| {
    bvh::build(PRESET, Input::of_triangles(&TRIANGLES)).expect("a tree of 256 triangles")
});

/// The entry as the cache writes it, and its place in the cache.
static STORED: LazyLock<(PathBuf, Vec<u8>)> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a temporary folder");
    tree(folder.path());
    let entries = |folder: &Path| {
        let entries = fs::read_dir(folder).expect("a folder of the cache");
        entries.map(|entry| entry.expect("an entry").path()).next().expect("one entry")
    };
    let path = entries(&entries(&folder.path().join("bvh")));
    let bytes = fs::read(&path).expect("the entry can be read");
    (path.strip_prefix(folder.path()).expect("inside").to_owned(), bytes)
});

fn tree(folder: &Path) -> compiler::cache::Cached {
    let input = Input::of_triangles(&TRIANGLES);
    Cache::at(folder).tree(PRESET, input).expect("there is always a tree")
}

pub(super) fn seed() -> Vec<u8> {
    let mut bytes = STORED.1.clone();
    // How long building took is the only thing that changes from run to run.
    bytes[24..32].fill(0);
    repair(&mut bytes);
    bytes
}

pub(super) fn check(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    let path = folder.join(&STORED.0);
    let written = path.parent().map_or(Ok(()), fs::create_dir_all);
    written.and_then(|()| fs::write(&path, bytes)).map_err(|e| e.to_string())?;
    let found = tree(folder);
    if let Source::Loaded { .. } = found.source {
        assert!(found.warning.is_none());
        assert_covers(&found.tree);
        return Ok(());
    }
    assert_eq!(found.tree, *BUILT);
    Err(found.warning.expect("a refused entry is a warning").to_string())
}

/// Every triangle is in one leaf, and leaves and nodes are reached once.
fn assert_covers(tree: &Tree) {
    assert_eq!(tree.order.len(), TRIANGLES.len() + tree.splits.len());
    let mut order = tree.order.clone();
    order.sort_unstable();
    assert!(order.iter().zip(0..).all(|(found, expected)| *found == expected));
    let (mut nodes, mut pieces, mut open) = (0, vec![0; tree.order.len()], vec![tree.root]);
    while let Some(word) = open.pop() {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                let node = &tree.nodes[index as usize];
                open.extend([node.left, node.right]);
                nodes += 1;
                assert!(nodes <= tree.nodes.len(), "a node is reached twice");
            }
            ChildRef::Triangles { first, count } => {
                for piece in first..first + count {
                    pieces[piece as usize] += 1;
                }
            }
            other => panic!("a tree of triangles holds {other:?}"),
        }
    }
    assert!(pieces.iter().all(|n| *n == 1), "a piece is not in exactly one leaf");
}

/// Makes the checksum true again.
pub(super) fn repair(bytes: &mut [u8]) {
    if bytes.len() >= HASH.end {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&bytes[..HASH.start]).update(&bytes[HASH.end..]);
        bytes[HASH].copy_from_slice(hasher.finalize().as_bytes());
    }
}
