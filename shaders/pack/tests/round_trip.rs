//! What goes in comes out, the same bytes every time, mapped or read.

mod common;

use std::fs;

use common::{Draft, Scene, WAYS, manifest, map};
use pack::abi::{CameraKind, FilterKind, Light, LightKind, Material, Node, SkyKind};
use pack::abi::{Sphere, Texture, TriShade, Triangle, VertexColors};
use pack::{Kind, Manifest, Pack, PackWriter, describe, features};

fn assert_same(pack: &Pack, scene: &Scene) {
    assert_eq!(pack.render(), &scene.render);
    assert_eq!(pack.camera(), &scene.camera);
    assert_eq!(pack.sky(), scene.sky.as_ref());
    assert_eq!(pack.records::<Node>(), scene.nodes);
    assert_eq!(pack.records::<Triangle>(), scene.triangles);
    assert_eq!(pack.records::<TriShade>(), scene.shades);
    assert_eq!(pack.records::<VertexColors>(), scene.vertex_colors);
    assert_eq!(pack.records::<Sphere>(), scene.spheres);
    assert_eq!(pack.records::<Material>(), scene.materials);
    assert_eq!(pack.records::<Light>(), scene.lights);
    assert_eq!(pack.records::<Texture>(), scene.textures);
    assert_eq!(pack.texels(), scene.texels);
    assert_eq!(pack.srgb_table(), scene.srgb.as_ref());
    assert_eq!(pack.kernel(), scene.kernel);
    let manifest = pack.manifest().expect("the manifest is whole");
    assert_eq!(manifest, scene.manifest.clone().unwrap_or_default());
    assert!(pack.verify_hashes().is_ok());
}

#[test]
fn everything_comes_back() {
    for scene in [
        Scene::full(),
        Scene::with_keys(),
        Scene::full().and_links(),
        Scene::full().and_vertex_colors(),
        Scene::empty(),
    ] {
        let pack = Pack::from_bytes(scene.bytes()).unwrap();
        assert_same(&pack, &scene);
        assert_eq!(pack.recipe_id(), [7; 32]);
        assert_eq!(pack.render_id(), scene.writer().render_id().unwrap());
    }
}

#[test]
fn mapped_and_read_files_are_equal() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.pack");
    let scene = Scene::full();
    scene.writer().write(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), scene.bytes());
    let mapped = map(&path).unwrap();
    let read = Pack::read(&path).unwrap();
    assert_same(&mapped, &scene);
    assert_same(&read, &scene);
    assert_eq!(describe(&mapped), describe(&read));
}

#[test]
fn released_pages_are_gone_and_come_back() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("released.pack");
    let bytes = Scene::full().bytes();
    fs::write(&path, &bytes).unwrap();
    for open in WAYS {
        let pack = open(&path).unwrap();
        let sections: Vec<Vec<u8>> = pack.sections().map(|s| s.bytes.to_vec()).collect();
        #[cfg(target_os = "linux")]
        assert_eq!(resident(&path).is_some_and(|kib| kib > 0), pack.witness().is_some());
        pack.release_pages();
        #[cfg(target_os = "linux")]
        assert_eq!(resident(&path).unwrap_or(0), 0);
        pack.verify_hashes().unwrap();
        assert!(pack.sections().zip(&sections).all(|(now, before)| now.bytes == before));
    }
}

/// KiB of the mapped file that are in this process's memory; `None` if it is not mapped.
#[cfg(target_os = "linux")]
fn resident(path: &std::path::Path) -> Option<u64> {
    let maps = fs::read_to_string("/proc/self/smaps").ok()?;
    let mut lines = maps.lines().skip_while(|line| !line.ends_with(&*path.to_string_lossy()));
    let rss = lines.find_map(|line| line.strip_prefix("Rss:"))?;
    rss.split_whitespace().next()?.parse().ok()
}

#[test]
fn a_mapped_pack_survives_being_written_again() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.pack");
    let scene = Scene::full();
    scene.writer().write(&path).unwrap();
    let old = map(&path).unwrap();
    Scene::empty().writer().write(&path).unwrap();
    assert_same(&old, &scene);
    assert_same(&map(&path).unwrap(), &Scene::empty());
    let names: Vec<_> = fs::read_dir(dir.path()).unwrap().map(|f| f.unwrap()).collect();
    assert_eq!(names.len(), 1, "no temporary file stays");
}

#[test]
fn the_order_of_calls_and_the_number_of_threads_do_not_change_a_byte() {
    let scene = Scene::full();
    let expected = scene.bytes();
    let srgb = scene.srgb.unwrap();
    let mut writer = PackWriter::new();
    writer.manifest(&manifest()).unwrap();
    writer.recipe_id([7; 32]).kernel(&scene.kernel).srgb_table(&srgb).texels(&scene.texels);
    writer.records(&scene.textures).records(&scene.lights).records(&scene.materials);
    writer.records(&scene.spheres).records(&scene.shades).records(&scene.triangles);
    writer
        .records(&scene.media)
        .records(&scene.objects)
        .records(&scene.links)
        .records(&scene.motion)
        .records(&scene.camera_keys)
        .records(&scene.nodes)
        .record(scene.sky.as_ref().unwrap());
    writer.record(&scene.camera).record(&scene.render);
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| writer.to_bytes().unwrap()), expected, "{threads} threads");
    }
}

#[test]
fn sections_from_misaligned_bytes_are_the_same() {
    let scene = Scene::full();
    let texels: Vec<u8> = [&[0][..], bytemuck::cast_slice(&scene.texels)].concat();
    let srgb: Vec<u8> = [&[0][..], bytemuck::cast_slice(&scene.srgb.unwrap())].concat();
    let mut bare = Scene::full();
    bare.texels.clear();
    bare.srgb = None;
    let mut writer = bare.writer();
    writer.bytes(Kind::TEXEL, &texels[1..]).bytes(Kind::SRGBLUT, &srgb[1..]);
    assert_eq!(writer.to_bytes().unwrap(), scene.bytes());
}

#[test]
fn the_render_id_names_the_picture_and_not_its_history() {
    let scene = Scene::full();
    let id = scene.writer().render_id().unwrap();
    let mut other = Scene::full();
    other.manifest = None;
    assert_eq!(other.writer().recipe_id([8; 32]).render_id().unwrap(), id);
    other.render.seed += 1;
    assert_ne!(other.writer().render_id().unwrap(), id);
}

#[test]
fn features_are_those_of_the_contents() {
    let pack = Pack::from_bytes(Scene::full().bytes()).unwrap();
    // A pack has one sky, and this one is no light; few lights need no tree; none is tinted. The nodes are
    // binary, and no mesh is stored once. There is no table of what sheen reflects.
    let absent = SkyKind::Constant.feature()
        | SkyKind::Image.feature()
        | LightKind::Sky.feature()
        | LightKind::Directional.feature()
        | features::LIGHT_TREE
        | features::TINT
        | features::SPOT
        | features::PROFILE
        | features::UNSEEN
        | features::ALPHA_BLEND
        | features::INSTANCES
        | features::WIDE_NODES
        | features::SAMPLER_PCG
        | features::BLADES
        | features::UNLIMITED
        | features::PRINCIPLED_SHEEN
        | CameraKind::Orthographic.feature()
        | CameraKind::Panoramic.feature()
        | FilterKind::ALL.into_iter().map(FilterKind::feature).sum::<u64>();
    assert_eq!(pack.features(), features::KNOWN & !absent);
    let wide = Pack::from_bytes(Scene::wide().bytes()).unwrap();
    assert_eq!(wide.features(), pack.features() | features::WIDE_NODES);
    let mut scene = Scene::empty();
    assert_eq!(Pack::from_bytes(scene.bytes()).unwrap().features(), features::LENS);
    scene.camera.blades = 5;
    scene.render.max_depth = pack::abi::UNLIMITED_DEPTH;
    let endless = Pack::from_bytes(scene.bytes()).unwrap().features();
    assert_eq!(endless, features::LENS | features::BLADES | features::UNLIMITED);
    scene.render.max_depth = 8;
    let bladed = Pack::from_bytes(scene.bytes()).unwrap().features();
    assert_eq!(bladed, features::LENS | features::BLADES);
    scene.camera.lens_radius = 0.0;
    assert_eq!(Pack::from_bytes(scene.bytes()).unwrap().features(), 0);
    scene.render.sampler = pack::abi::SamplerKind::Pcg as u32;
    let found = Pack::from_bytes(scene.bytes()).unwrap().features();
    assert_eq!(found, features::SAMPLER_PCG);
    assert_eq!(features::names(features::LENS | features::SPHERES), ["spheres", "lens"]);
}

#[test]
fn absent_kinds_bring_no_section() {
    let kinds = |scene: &Scene| -> Vec<String> {
        let pack = Pack::from_bytes(scene.bytes()).unwrap();
        describe(&pack).into_iter().map(|row| row.kind).collect()
    };
    assert_eq!(kinds(&Scene::empty()), ["RENDER", "CAMERA", "KERNEL"]);
    // Nodes are of one layout.
    let but = |absent: Kind| -> Vec<String> {
        let there = pack::SECTIONS.iter().filter(|spec| spec.kind != absent);
        there.map(|spec| spec.kind.to_string()).collect()
    };
    let keyed = |scene: Scene| {
        let Scene { objects, motion, camera_keys, .. } = Scene::with_keys();
        Scene { objects, motion, camera_keys, ..scene }.and_links().and_vertex_colors()
    };
    let all = keyed(Scene::with_light_tree().and_instances().and_albedo());
    assert_eq!(kinds(&all), but(Kind::WIDENODE));
    let Scene { render, wide_nodes, nodes, .. } = Scene::wide();
    let render = pack::abi::RenderSettings {
        stack_need: render.stack_need,
        ..Scene::with_light_tree().render
    };
    let wide = keyed(Scene { render, nodes, wide_nodes, ..Scene::with_light_tree().and_albedo() });
    let mut others = but(Kind::NODE);
    others.retain(|kind| *kind != Kind::INSTANCE.to_string());
    assert_eq!(kinds(&wide), others);
}

#[test]
fn rows_say_what_the_table_says() {
    let scene = Scene::full();
    let rows = describe(&Pack::from_bytes(scene.bytes()).unwrap());
    let row = rows.iter().find(|row| row.kind == "NODE").unwrap();
    assert_eq!((row.version, row.count, row.elem_size, row.bytes), (1, 3, 64, 192));
    let hash = blake3::hash(bytemuck::cast_slice(&scene.nodes)).to_hex();
    assert_eq!(row.hash, hash[..32]);
}

/// The published layout, byte by byte, on the smallest pack.
#[test]
fn the_file_has_the_published_layout() {
    let bytes = Scene::empty().bytes();
    assert_eq!(bytes[..8], [0x89, 0x52, 0x54, 0x50, 0x0d, 0x0a, 0x1a, 0x0a]);
    assert_eq!(bytes[8..16], [2, 0, 0, 0, 4, 3, 2, 1]);
    assert_eq!(bytes[16..24], [128, 0, 0, 0, 64, 0, 0, 0]);
    assert_eq!(common::get64(&bytes, 24), 128);
    assert_eq!(common::get32(&bytes, 32), 3);
    assert_eq!(common::get64(&bytes, 40), bytes.len() as u64);
    assert_eq!(common::get32(&bytes, 36), pack::layout_id());
    assert_eq!(&bytes[128..136], b"RENDER  ");
    assert_eq!(common::get64(&bytes, 128 + 16), 4096);
    assert_eq!(common::get64(&bytes, 128 + 24), 112);
    assert_eq!(common::get64(&bytes, 128 + 64 + 16), 8192);
    // A second implementation of the seal, in the tests, gives the same file.
    assert_eq!(Draft::new(&bytes).seal(), bytes);
    let full = Scene::full().bytes();
    assert_eq!(Draft::new(&full).seal(), full);
}

#[test]
fn a_newer_minor_format_may_add_sections() {
    let scene = Scene::full();
    let mut draft = Draft::new(&scene.bytes());
    draft.header[10] = 1;
    draft.add(3, Kind(*b"FANCY   "), 0, b"something new");
    let pack = Pack::from_bytes(draft.seal()).unwrap();
    assert_same(&pack, &scene);
    assert_eq!(pack.section_bytes(Kind(*b"FANCY   ")), Some(&b"something new"[..]));
    assert_eq!(describe(&pack)[3].kind, "FANCY");
}

#[test]
fn a_broken_manifest_does_not_hinder_rendering() {
    let scene = Scene::full();
    let mut draft = Draft::new(&scene.bytes());
    *draft.section(Kind::META) = vec![0xff; 40];
    let pack = Pack::from_bytes(draft.seal()).unwrap();
    assert_eq!(pack.render(), &scene.render);
    let text = pack.manifest().unwrap_err().to_string();
    assert!(text.starts_with("META: not readable: "), "{text}");
}

#[test]
fn without_a_manifest_there_is_an_empty_one() {
    let pack = Pack::from_bytes(Scene::empty().bytes()).unwrap();
    assert_eq!(pack.manifest().unwrap(), Manifest::default());
}

/// The writer refuses what the reader would refuse, and leaves the old file alone.
#[test]
fn a_bad_pack_is_never_written() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.pack");
    Scene::empty().writer().write(&path).unwrap();
    let before = fs::read(&path).unwrap();

    let mut scene = Scene::full();
    scene.spheres[1].material = 99;
    let text = scene.writer().write(&path).unwrap_err().to_string();
    assert_eq!(text, "SPHERE[1] at byte 0x30: material is 99, but MATERIAL has 15 elements");

    let scene = Scene::full();
    let mut writer = scene.writer();
    let text = writer.record(&scene.camera).to_bytes().unwrap_err().to_string();
    assert_eq!(text, "section CAMERA (entry 2): the section is duplicated");
    let mut writer = scene.writer();
    let text = writer.bytes(Kind(*b"FANCY   "), b"x").to_bytes().unwrap_err().to_string();
    assert_eq!(text, "section FANCY (entry 16): unknown section in format 2.0");
    let mut writer = PackWriter::new();
    let text = writer.bytes(Kind::CAMERA, &[0; 63]).to_bytes().unwrap_err().to_string();
    let ragged = "length is 63 bytes, but 0 elements of 80 bytes make 0";
    assert_eq!(text, format!("section CAMERA (entry 0): {ragged}"));
    let text = PackWriter::new().to_bytes().unwrap_err().to_string();
    assert_eq!(text, "section RENDER is missing");

    assert_eq!(fs::read(&path).unwrap(), before);
}

#[test]
fn a_folder_that_is_not_there_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("nowhere").join("scene.pack");
    let text = Scene::empty().writer().write(&path).unwrap_err().to_string();
    assert!(text.starts_with("cannot create ") && text.contains("scene.pack: "), "{text}");
    let text = map(&path).unwrap_err().to_string();
    assert!(text.starts_with("cannot open ") && text.contains("scene.pack: "), "{text}");
}
