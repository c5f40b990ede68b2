//! glTF files at one moment: animations, skins, morph targets; and variants of materials.

mod import_support;

use compiler::import::{ErrorKind, ImportError, Limits, MeshFile, read_gltf};
use import_support::{Builder, compressed_triangle, tiny_png, triangle};
use lang::scene::GltfChoice;
use serde_json::{Value, json};
use std::path::Path;

fn read(document: &Builder, choice: &GltfChoice) -> Result<MeshFile, ImportError> {
    read_gltf(&document.glb(), Path::new("a.glb"), choice, &Limits::default())
}

fn at(time: f64) -> GltfChoice {
    GltfChoice { time: Some(time), ..GltfChoice::default() }
}

/// The corners of the only triangle.
fn corners(document: &Builder, choice: &GltfChoice) -> [[f32; 3]; 3] {
    let mesh = read(document, choice).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(mesh.parts.len(), 1);
    mesh.parts[0].corners(0)
}

#[track_caller]
fn assert_near(found: [[f32; 3]; 3], expected: [[f32; 3]; 3]) {
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    let close = pairs.clone().all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(close, "{found:?} instead of {expected:?}");
}

/// Gives node 0 an animation of one channel.
fn animate(document: &mut Builder, path: &str, interpolation: &str, [input, output]: [usize; 2]) {
    let animation = json!({"name": path, "samplers": [
            {"input": input, "output": output, "interpolation": interpolation}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": path}}]});
    if document.json.get("animations").is_none() {
        document.json["animations"] = json!([]);
    }
    document.push("animations", animation);
}

/// The triangle of `triangle()`, moved.
fn moved(by: [f32; 3]) -> [[f32; 3]; 3] {
    [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|p: [f32; 3]| [0, 1, 2].map(|k| p[k] + by[k]))
}

#[test]
fn nodes_move_in_steps_lines_and_splines() {
    for mut document in [triangle(), compressed_triangle()] {
        let times = document.floats(&[[1.0], [3.0]], "SCALAR");
        let places = document.floats(&[[0.0; 3], [4.0, 0.0, 0.0]], "VEC3");
        // Tangent before, value, tangent after: it leaves at a speed of 2 and arrives at rest.
        let spline = document.floats(
            &[[0.0; 3], [0.0; 3], [2.0, 0.0, 0.0], [0.0; 3], [4.0, 0.0, 0.0], [0.0; 3]],
            "VEC3",
        );
        for (interpolation, output, middle) in
            [("STEP", places, 0.0), ("LINEAR", places, 1.0), ("CUBICSPLINE", spline, 1.1875)]
        {
            let mut document = document.clone();
            animate(&mut document, "translation", interpolation, [times, output]);
            // Before the first key and after the last one it stands still.
            for (time, x) in [(0.0, 0.0), (1.0, 0.0), (1.5, middle), (3.0, 4.0), (9.0, 4.0)] {
                assert_near(corners(&document, &at(time)), moved([x, 0.0, 0.0]));
            }
        }
    }
}

#[test]
fn rotations_go_the_shorter_way_round_and_scales_are_read() {
    let mut document = triangle();
    let times = document.floats(&[[0.0], [2.0]], "SCALAR");
    // From none to a quarter turn about z, told with the other sign.
    let half = 0.5_f32.sqrt();
    let turns = document.floats(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, -half, -half]], "VEC4");
    let scales = document.floats(&[[1.0; 3], [3.0; 3]], "VEC3");
    animate(&mut document, "rotation", "LINEAR", [times, turns]);
    animate(&mut document, "scale", "LINEAR", [times, scales]);
    // An eighth turn at twice the size.
    let side = 2.0 * half;
    let expected = [[0.0; 3], [side, side, 0.0], [-side, side, 0.0]];
    assert_near(corners(&document, &at(1.0)), expected);
    let stored = read(&document, &GltfChoice::default()).expect("a good file");
    assert_near(stored.parts[0].corners(0), moved([0.0; 3]));
    let warnings = &stored.report.warnings;
    let told = "its animations are `rotation`, `scale`; it is shown as stored";
    assert!(warnings.iter().any(|warning| warning.message.contains(told)), "{warnings:?}");
}

#[test]
fn animations_are_chosen_by_name() {
    let mut document = triangle();
    let times = document.floats(&[[0.0]], "SCALAR");
    let [here, there] = [[5.0, 0.0, 0.0], [0.0, 7.0, 0.0]].map(|p| document.floats(&[p], "VEC3"));
    animate(&mut document, "translation", "LINEAR", [times, here]);
    animate(&mut document, "translation", "LINEAR", [times, there]);
    document.json["animations"][0]["name"] = json!("Walk");
    document.json["animations"][1]["name"] = json!("Run");
    let named = |name: &str| GltfChoice { animation: Some(name.to_owned()), ..at(0.0) };
    assert_near(corners(&document, &named("Walk")), moved([5.0, 0.0, 0.0]));
    assert_near(corners(&document, &named("Run")), moved([0.0, 7.0, 0.0]));
    let fails = |choice: &GltfChoice, text: &str| {
        let error = read(&document, choice).expect_err(text);
        assert_eq!((error.kind, error.message.as_str()), (ErrorKind::Choice, text));
    };
    fails(&named("Fly"), "it has no animation `Fly`: its animations are `Walk`, `Run`");
    let text = "several animations move the same node: its animations are `Walk`, `Run`";
    fails(&at(0.0), text);
    let error = read(&triangle(), &at(1.0)).expect_err("nothing moves");
    assert_eq!(error.message, "it has no animation, so every `time` is the same");
}

/// Two joints, nodes 1 and 2, the second moved up by 2; the last corner hangs on both.
fn skinned() -> Builder {
    let mut document = triangle();
    let joints = document.view(&[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0]);
    let joints = document.push(
        "accessors",
        json!({"bufferView": joints, "componentType": 5121, "count": 3, "type": "VEC4"}),
    );
    let weights = [[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.25, 0.75, 0.0, 0.0]];
    let weights = document.floats(&weights, "VEC4");
    // Column-major: the second joint's frame begins at x = 1.
    let mut second = [0.0_f32; 16];
    for k in [0, 5, 10, 15] {
        second[k] = 1.0;
    }
    let first = second;
    second[12] = -1.0;
    let inverse = document.floats(&[first, second], "MAT4");
    document.push("nodes", json!({"translation": [0, 0, 3]}));
    document.push("nodes", json!({"translation": [1, 2, 0]}));
    document.json["nodes"][1]["children"] = json!([2]);
    document.json["scenes"][0]["nodes"] = json!([0, 1]);
    document.json["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": inverse}]);
    // The place of the node itself does not count.
    document.json["nodes"][0]["translation"] = json!([100, 0, 0]);
    document.json["nodes"][0]["skin"] = json!(0);
    let attributes = &mut document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    document
}

#[test]
fn vertices_follow_their_joints() {
    let document = skinned();
    let rest = GltfChoice::default();
    let expected = [[0.0, 0.0, 3.0], [1.0, 2.0, 3.0], [0.0, 2.5, 3.0]];
    assert_near(corners(&document, &rest), expected);
    // A quarter turn of the first joint about z takes everything with it.
    let mut turned = document;
    let times = turned.floats(&[[0.0]], "SCALAR");
    let half = 0.5_f32.sqrt();
    let turn = turned.floats(&[[0.0, 0.0, half, half]], "VEC4");
    animate(&mut turned, "rotation", "STEP", [times, turn]);
    turned.json["animations"][0]["channels"][0]["target"]["node"] = json!(1);
    let expected = [[0.0, 0.0, 3.0], [-2.0, 1.0, 3.0], [-2.5, 0.0, 3.0]];
    assert_near(corners(&turned, &at(0.0)), expected);
    let mesh = read(&turned, &at(0.0)).expect("a good file");
    assert_eq!(mesh.report.warnings, []);
    let normals = mesh.parts[0].corner_normals(0).expect("normals");
    assert_near(normals, [[0.0, 0.0, 1.0]; 3]);
}

#[test]
fn a_joint_that_mirrors_keeps_outside_outside() {
    let mut document = skinned();
    document.json["nodes"][1]["scale"] = json!([-1, 1, 1]);
    let [a, b, c] = corners(&document, &GltfChoice::default());
    assert_near([a, b, c], [[0.0, 0.0, 3.0], [0.0, 2.5, 3.0], [-1.0, 2.0, 3.0]]);
}

#[test]
fn skins_that_make_no_sense_are_errors() {
    let check = |change: &dyn Fn(&mut Value), expected: &str| {
        let mut document = skinned();
        change(&mut document.json);
        let error = read(&document, &GltfChoice::default()).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
    };
    check(&|json| json["nodes"][0]["skin"] = json!(7), "skin 7: there is no such skin");
    check(&|json| json["skins"][0]["joints"] = json!([1]), "but there are 1 joints");
    check(&|json| json["skins"][0]["joints"] = json!([1, 2, 2]), "fewer inverse bind matrices");
    check(&|json| json["skins"][0]["joints"] = json!([1, 9]), "is not in the scene");
    let no_weights = |json: &mut Value| {
        let attributes = &mut json["meshes"][0]["primitives"][0]["attributes"];
        attributes.as_object_mut().expect("attributes").remove("WEIGHTS_0");
    };
    check(&no_weights, "it has no JOINTS_0 and WEIGHTS_0");
    let times = |json: &mut Value| {
        json["animations"] = json!([{"samplers": [{"input": 2, "output": 0}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]);
    };
    let mut document = skinned();
    times(&mut document.json);
    let error = read(&document, &at(0.5)).expect_err("times of two numbers");
    assert!(error.to_string().contains("accessor 2"), "{error}");
    let backwards = document.floats(&[[1.0], [0.0], [2.0]], "SCALAR");
    document.json["animations"][0]["samplers"][0]["input"] = json!(backwards);
    let error = read(&document, &at(0.5)).expect_err("times that fall");
    assert!(error.to_string().contains("channel 0: its times do not rise"), "{error}");
}

#[test]
fn morph_targets_weigh_what_mesh_node_or_animation_says() {
    let mut document = triangle();
    let up = document.floats(&[[0.0, 0.0, 2.0]; 3], "VEC3");
    let aside = document.floats(&[[8.0, 0.0, 0.0], [0.0; 3], [0.0; 3]], "VEC3");
    let primitive = &mut document.json["meshes"][0]["primitives"][0];
    primitive["targets"] = json!([{"POSITION": up}, {"POSITION": aside, "NORMAL": up}]);
    let rest = GltfChoice::default();
    assert_near(corners(&document, &rest), moved([0.0; 3]));
    document.json["meshes"][0]["weights"] = json!([0.5, 0]);
    assert_near(corners(&document, &rest), moved([0.0, 0.0, 1.0]));
    document.json["nodes"][0]["weights"] = json!([1, 0.25]);
    let [_, b, c] = moved([0.0, 0.0, 2.0]);
    assert_near(corners(&document, &rest), [[2.0, 0.0, 2.0], b, c]);
    // Two weights a key.
    let times = document.floats(&[[0.0], [1.0]], "SCALAR");
    let weights = document.floats(&[[0.0], [0.0], [1.0], [0.0]], "SCALAR");
    animate(&mut document, "weights", "LINEAR", [times, weights]);
    assert_near(corners(&document, &at(0.25)), moved([0.0, 0.0, 0.5]));
    let short = document.floats(&[[0.0; 3]; 2], "VEC3");
    document.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = json!(short);
    let error = read(&document, &at(1.0)).expect_err("two moves for three corners");
    assert!(error.to_string().contains("it has 2 elements, but there are 3 positions"), "{error}");
}

#[test]
fn variants_choose_materials() {
    let mut document = triangle();
    document.json["materials"] = json!([{"name": "day"}, {"name": "night"}]);
    document.json["extensionsUsed"] = json!(["KHR_materials_variants"]);
    document.json["extensions"] =
        json!({"KHR_materials_variants": {"variants": [{"name": "noon"}, {"name": "midnight"}]}});
    let primitive = &mut document.json["meshes"][0]["primitives"][0];
    primitive["material"] = json!(0);
    primitive["extensions"] = json!({"KHR_materials_variants":
        {"mappings": [{"material": 1, "variants": [1]}]}});
    let image = document.view(&tiny_png());
    document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    document.json["textures"] = json!([{"source": 0}]);
    document.json["materials"][1]["pbrMetallicRoughness"] =
        json!({"baseColorTexture": {"index": 0}});
    let choose =
        |name: &str| GltfChoice { variant: Some(name.to_owned()), ..GltfChoice::default() };
    let names = |choice: &GltfChoice| {
        let mesh = read(&document, choice).unwrap_or_else(|error| panic!("{error}"));
        // Images of materials that are not shown are not loaded.
        assert_eq!(mesh.images.len(), usize::from(mesh.materials[0].name == "night"));
        mesh.materials.iter().map(|material| material.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(&GltfChoice::default()), ["day"]);
    assert_eq!(names(&choose("midnight")), ["night"]);
    // The mapping has nothing for this one.
    assert_eq!(names(&choose("noon")), ["day"]);
    let error = read(&document, &choose("dusk")).expect_err("no such variant");
    let expected = "it has no variant `dusk`: its variants are `noon`, `midnight`";
    assert_eq!((error.kind, error.message.as_str()), (ErrorKind::Choice, expected));
    let error = read(&triangle(), &choose("dusk")).expect_err("no variants");
    assert_eq!(error.message, "it has no variant `dusk`: it has none at all");
}
