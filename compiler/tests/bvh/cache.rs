//! Trees on disk: the same tree with and without, whatever happens to the files.

use std::fs;
use std::path::{Path, PathBuf};

use compiler::bvh::{self, Input, Preset, Primitives, Tree, build_scene};
use compiler::cache::{Cache, CacheStats, CacheWarning, EntryFault, MIN_PRIMITIVES, Source};

use crate::shapes::{Tri, degenerate};

/// Large enough to be stored.
const N: u32 = 20_000;

/// The only entry of a cache.
fn only_file(root: &Path) -> PathBuf {
    let mut files = Vec::new();
    for folder in fs::read_dir(root.join("bvh")).unwrap() {
        files.extend(fs::read_dir(folder.unwrap().path()).unwrap().map(|f| f.unwrap().path()));
    }
    assert_eq!(files.len(), 1, "{files:?}");
    files.remove(0)
}

fn soup() -> Tree {
    bvh::build(Preset::Default, Input::of_triangles(&degenerate("soup", N))).unwrap()
}

#[test]
fn the_second_time_is_loaded_and_equal() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let run = || cache.tree(Preset::Default, Input::of_triangles(&degenerate("soup", N))).unwrap();
    let (first, second) = (run(), run());
    assert!(matches!(first.source, Source::Stored { .. }), "{:?}", first.source);
    assert!(matches!(second.source, Source::Loaded { .. }), "{:?}", second.source);
    assert_eq!((&first.warning, &second.warning), (&None, &None));
    assert_eq!(first.tree, second.tree);
    assert_eq!(first.tree, soup());
    let file = only_file(dir.path());
    let name = file.strip_prefix(dir.path().join("bvh")).unwrap().to_str().unwrap();
    assert_eq!((name.len(), &name[65..]), (2 + 1 + 62 + 4, ".bvh"));
}

#[test]
fn other_boxes_are_another_entry() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let mut triangles = degenerate("soup", N);
    cache.tree(Preset::Default, Input::of_triangles(&triangles)).unwrap();
    triangles[777][1][2] += 0.125;
    let other = cache.tree(Preset::Default, Input::of_triangles(&triangles)).unwrap();
    assert!(matches!(other.source, Source::Stored { .. }));
    assert_eq!(cache.stats().unwrap().entries, 2);
}

#[test]
fn every_builder_has_its_own_entry() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let triangles = degenerate("long", N);
    let run = |preset| cache.tree(preset, Input::of_triangles(&triangles)).unwrap();
    for preset in Preset::ALL {
        assert!(matches!(run(preset).source, Source::Stored { .. }), "{preset}");
    }
    for preset in Preset::ALL {
        let loaded = run(preset);
        assert!(matches!(loaded.source, Source::Loaded { .. }), "{preset}");
        let built = bvh::build(preset, Input::of_triangles(&triangles)).unwrap();
        assert_eq!(loaded.tree.splits.is_empty(), !preset.splits_triangles(), "{preset}");
        assert_eq!(loaded.tree, built, "{preset}");
    }
}

/// Two triangles may have the same boxes and other parts.
#[test]
fn other_corners_are_another_entry_where_triangles_are_split() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let mut triangles = degenerate("long", N);
    let run = |preset, triangles: &[Tri]| {
        cache.tree(preset, Input::of_triangles(triangles)).unwrap().source
    };
    for preset in [Preset::Fast, Preset::Default] {
        run(preset, &triangles);
    }
    triangles[777].swap(0, 1);
    assert!(matches!(run(Preset::Fast, &triangles), Source::Loaded { .. }));
    assert!(matches!(run(Preset::Default, &triangles), Source::Stored { .. }));
}

#[test]
fn small_trees_and_disabled_caches_write_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let few = u32::try_from(MIN_PRIMITIVES).unwrap() - 1;
    let small = cache.tree(Preset::Default, Input::of_triangles(&degenerate("soup", few))).unwrap();
    assert!(matches!(small.source, Source::Built { .. }));
    let none = Cache::disabled()
        .tree(Preset::Default, Input::of_triangles(&degenerate("soup", N)))
        .unwrap();
    assert!(matches!(none.source, Source::Built { .. }));
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
    assert_eq!(Cache::disabled().stats().unwrap(), CacheStats::default());
}

/// Meshes of `N` triangles in different places.
fn apart(n_meshes: u8) -> Vec<Tri> {
    let soup = degenerate("soup", N);
    let shifts = (0..n_meshes).map(|i| 10.0 * f32::from(i));
    shifts.flat_map(|s| soup.iter().map(move |t| t.map(|[x, y, z]| [x + s, y, z]))).collect()
}

/// Damages the entry, expects the warning, the right tree, and a repaired entry.
fn check_damage(damage: impl Fn(&mut Vec<u8>), expected: &EntryFault) {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let run = || cache.tree(Preset::Default, Input::of_triangles(&degenerate("soup", N))).unwrap();
    run();
    let file = only_file(dir.path());
    let mut bytes = fs::read(&file).unwrap();
    let good = bytes.clone();
    damage(&mut bytes);
    fs::write(&file, &bytes).unwrap();
    let repaired = run();
    let Some(CacheWarning::Damaged { path, fault }) = &repaired.warning else {
        panic!("{expected:?}: {:?}", repaired.warning)
    };
    assert_eq!(fault, expected);
    assert_eq!(dir.path().join(path), file);
    assert!(matches!(repaired.source, Source::Stored { .. }));
    assert_eq!(repaired.tree, soup());
    // All but the time of building and the checksum are as before.
    let now = fs::read(&file).unwrap();
    assert_eq!((&now[..24], &now[96..]), (&good[..24], &good[96..]));
    assert_eq!(run().warning, None);
}

#[test]
fn every_kind_of_damage_is_repaired_with_a_warning() {
    check_damage(Vec::clear, &EntryFault::Length);
    check_damage(|b| b.truncate(103), &EntryFault::Length);
    check_damage(|b| b.truncate(b.len() / 2), &EntryFault::Length);
    check_damage(|b| b.push(0), &EntryFault::Length);
    check_damage(|b| b.resize(1 << 22, 0), &EntryFault::Length);
    check_damage(|b| b[0] = 0, &EntryFault::Magic);
    check_damage(|b| b[8] = 9, &EntryFault::Version(9));
    check_damage(|b| b[16] ^= 1, &EntryFault::Length);
    check_damage(|b| b[40] ^= 1, &EntryFault::Key);
    check_damage(|b| b[12] ^= 1, &EntryFault::Checksum);
    check_damage(|b| b[24] ^= 1, &EntryFault::Checksum);
    check_damage(|b| b[70] ^= 1, &EntryFault::Checksum);
    check_damage(|b| b[96] ^= 1, &EntryFault::Length);
    check_damage(|b| b[104] ^= 1, &EntryFault::Checksum);
    check_damage(|b| *b.last_mut().unwrap() ^= 128, &EntryFault::Checksum);
    check_damage(|b| b.fill(0xff), &EntryFault::Magic);
}

#[test]
fn an_entry_under_another_name_is_not_taken() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    cache.tree(Preset::Default, Input::of_triangles(&degenerate("soup", N))).unwrap();
    let file = only_file(dir.path());
    let bytes = fs::read(&file).unwrap();
    cache.clear().unwrap();
    cache.tree(Preset::Default, Input::of_triangles(&degenerate("flat", N))).unwrap();
    fs::write(only_file(dir.path()), bytes).unwrap();
    let flat = cache.tree(Preset::Default, Input::of_triangles(&degenerate("flat", N))).unwrap();
    let Some(CacheWarning::Damaged { fault, .. }) = flat.warning else { panic!("no warning") };
    assert!(matches!(fault, EntryFault::Key | EntryFault::Length), "{fault:?}");
    assert_eq!(
        flat.tree,
        bvh::build(Preset::Default, Input::of_triangles(&degenerate("flat", N))).unwrap()
    );
}

#[test]
fn an_entry_that_is_a_folder_is_a_warning() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let run = || cache.tree(Preset::Default, Input::of_triangles(&degenerate("soup", N))).unwrap();
    run();
    let file = only_file(dir.path());
    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    let result = run();
    assert!(result.warning.is_some());
    assert_eq!(result.tree, soup());
}

#[test]
fn an_unwritable_cache_is_one_warning() {
    let dir = tempfile::tempdir().unwrap();
    // A file where the directory should be: unwritable for every user.
    let blocked = dir.path().join("blocked");
    fs::write(&blocked, "not a directory").unwrap();
    let triangles = apart(3);
    let sizes = [N as usize; 3];
    let primitives = Primitives {
        triangles: &triangles,
        mesh_sizes: &sizes,
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let (tree, report) = build_scene(&primitives, Preset::Default, &Cache::at(&blocked)).unwrap();
    assert_eq!(report.warnings.len(), 1, "{:?}", report.warnings);
    assert!(matches!(report.warnings[0], CacheWarning::Unwritable { .. }));
    assert_eq!(tree, build_scene(&primitives, Preset::Default, &Cache::disabled()).unwrap().0);
    assert_eq!(fs::read_to_string(&blocked).unwrap(), "not a directory");
}

#[test]
fn with_or_without_cache_the_scene_is_the_same() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let mut triangles = apart(2);
    triangles.splice(N as usize..N as usize, degenerate("soup", 30));
    let sizes = [N as usize, 30, N as usize];
    let primitives = Primitives {
        triangles: &triangles,
        mesh_sizes: &sizes,
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let run = |cache: &Cache| build_scene(&primitives, Preset::Default, cache).unwrap();
    let (cold, first) = run(&cache);
    let (warm, second) = run(&cache);
    assert_eq!((first.groups, first.stored, first.loaded), (3, 2, 0));
    assert_eq!((second.groups, second.stored, second.loaded), (3, 0, 2));
    assert_eq!(cold, warm);
    cache.clear().unwrap();
    assert_eq!(cold, run(&cache).0);
    assert_eq!(cold, run(&Cache::disabled()).0);
}

#[test]
fn clear_deletes_trees_and_nothing_else() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    assert_eq!(cache.clear().unwrap(), CacheStats::default());
    cache.tree(Preset::Default, Input::of_triangles(&degenerate("soup", N))).unwrap();
    let folder = only_file(dir.path()).parent().unwrap().to_owned();
    let keep = [dir.path().join("bvh/notes.bvh"), folder.join("mine.txt")];
    for path in &keep {
        fs::write(path, "precious").unwrap();
    }
    let stats = cache.stats().unwrap();
    assert_eq!(stats.entries, 1);
    assert_eq!(cache.clear().unwrap(), stats);
    assert_eq!(cache.stats().unwrap(), CacheStats::default());
    assert!(keep.iter().all(|path| path.is_file()));
}

#[test]
fn pruning_deletes_what_was_used_least_recently() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let run =
        |kind| cache.tree(Preset::Default, Input::of_triangles(&degenerate(kind, N))).unwrap();
    run("soup");
    let oldest = only_file(dir.path());
    let past = std::time::SystemTime::UNIX_EPOCH;
    let age = |path: &Path| fs::File::options().append(true).open(path).unwrap();
    age(&oldest).set_modified(past).unwrap();
    run("flat");
    // Reading makes it the newest again.
    assert!(matches!(run("soup").source, Source::Loaded { .. }));
    assert!(fs::metadata(&oldest).unwrap().modified().unwrap() > past);
    age(&oldest).set_modified(past).unwrap();
    let total = cache.stats().unwrap().bytes;
    assert_eq!(cache.prune().unwrap().entries, 0);
    let pruned = cache.clone().with_cap(total - 1).prune().unwrap();
    assert_eq!(pruned.entries, 1);
    assert!(!oldest.exists());
    assert!(matches!(run("flat").source, Source::Loaded { .. }));
}
