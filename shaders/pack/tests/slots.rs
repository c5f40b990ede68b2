//! How many files can be mapped at a time. Alone in its process, for it takes all there are.

#![cfg(unix)]

mod common;

use common::{Scene, map};

#[test]
fn slots_of_mappings_are_used_again() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.pack");
    Scene::full().writer().write(&path).unwrap();
    for _ in 0..2 {
        let packs: Vec<_> = (0..300).map(|_| map(&path)).collect();
        assert_eq!(packs.iter().filter(|pack| pack.is_ok()).count(), 256);
        let error = packs.iter().find_map(|pack| pack.as_ref().err()).unwrap().to_string();
        assert!(error.ends_with("256 files are mapped, and no more can be guarded"), "{error}");
    }
}
