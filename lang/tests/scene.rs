//! Right scenes: what they become, and that the order in which they are written does not matter.

#![expect(clippy::float_cmp, reason = "the same text gives exactly the same numbers")]

mod common;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use common::{ROOT, check_files, check_text, describe};
use lang::material::Diffuse;
use lang::scene::{Color, MaterialModel, Projection, Sampler, Scene, Shape, SkyModel};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

/// The scene that has everything, with its imports.
fn files() -> BTreeMap<String, String> {
    let root = std::fs::read_to_string(folder().join("good.rts")).expect("the test's own file");
    let parts = [
        (
            "parts/lantern.rts",
            "rts 1\npub let size = 20cm\nmaterial paper: diffuse { color = linear(0.8) }\n\
             pub object body { shape = sphere(radius: size), material = paper }\n\
             pub instance wall: body { at = (9, 0, 0)m }\n\
             instance preview: body { }\n\
             camera preview_eye: perspective { from = (0, 0, 1)m, to = (0, 0, 0)m }\n\
             render preview_picture: path { }\n",
        ),
        (
            "parts/named.rts",
            "rts 1\npub material brass: metal { color = linear(0.9, 0.7, 0.3) }\npub let twice = 2\n",
        ),
        ("parts/all.rts", "rts 1\npub let plain_size = 30cm\n"),
    ];
    let mut files = BTreeMap::from([(ROOT.to_owned(), root)]);
    files.extend(parts.map(|(name, text)| (name.to_owned(), text.to_owned())));
    files
}

fn scene_of(files: &BTreeMap<String, String>, defines: &[(&str, &str)]) -> Scene {
    let defines: Vec<(String, String)> =
        defines.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
    let analysis = check_files(files, &defines);
    assert_eq!(describe(&analysis), "");
    analysis.scene.expect("a scene without diagnostics")
}

fn scene_of_text(text: &str) -> Scene {
    let analysis = check_text(text);
    assert!(analysis.scene.is_some(), "{}", describe(&analysis));
    analysis.scene.expect("asserted")
}

/// A whole scene around some declarations.
fn with_view(declarations: &str) -> String {
    format!(
        "rts 1\n{declarations}\nsky dome: constant {{ }}\n\
         camera c: perspective {{ from = (0, 1, 5)m, to = (0, 1, 0)m }}\nrender r: path {{ }}\n"
    )
}

#[test]
fn everything_is_resolved() {
    let found = lang::resolved(&scene_of(&files(), &[]));
    let path = folder().join("good.resolved");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &found).expect("the test's own file");
    }
    let expected = std::fs::read_to_string(&path).expect("the test's own file");
    assert_eq!(found, expected, "run with UPDATE=1 and review the difference");
}

#[test]
fn definitions_change_what_they_name() {
    let scene = scene_of(&files(), &[("final", "true"), ("hour", "7h + 30min")]);
    assert_eq!(scene.render.samples, 4096);
    let base = scene_of(&files(), &[]);
    assert_ne!(base.lights[1].center, scene.lights[1].center);
    let analysis = check_files(&files(), &[("hour".to_owned(), "7.5h".to_owned())]);
    let hour = &analysis.params[0];
    assert_eq!((hour.name.as_str(), hour.value.as_str(), hour.overridden), ("hour", "7.5h", true));
    assert_eq!(hour.docs, ["Hour of the day."]);
    assert_eq!(
        analysis.files,
        ["scene.rts", "parts/lantern.rts", "parts/all.rts", "parts/named.rts"]
    );
}

/// Splits a file at lines in column 1 that are neither doc comments nor closing braces.
fn declarations(text: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    let mut comment = String::new();
    for line in text.split_inclusive('\n').skip(1) {
        let inside = line.starts_with([' ', '}', '\n']);
        if line.starts_with("///") {
            comment.push_str(line);
        } else if inside && !parts.is_empty() {
            parts.last_mut().expect("not empty").push_str(line);
        } else {
            parts.push(std::mem::take(&mut comment) + line);
        }
    }
    parts
}

#[test]
fn the_order_of_declarations_does_not_matter() {
    let files = files();
    let expected = lang::resolved(&scene_of(&files, &[]));
    let parts = declarations(&files[ROOT]);
    let mut state = 1_u64;
    for _ in 0..20 {
        let mut shuffled = parts.clone();
        for i in (1..shuffled.len()).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            shuffled.swap(i, (state >> 33) as usize % (i + 1));
        }
        let mut files = files.clone();
        files.insert(ROOT.to_owned(), format!("rts 1\n{}", shuffled.concat()));
        assert_eq!(lang::resolved(&scene_of(&files, &[])), expected);
    }
}

#[test]
fn a_long_chain_of_values_needs_no_stack_in_either_order() {
    for reversed in [false, true] {
        let mut lines: Vec<String> =
            (1..20_000).map(|i| format!("let v{i} = v{} + 1m\n", i - 1)).collect();
        lines.push("let v0 = 1m\n".to_owned());
        if reversed {
            lines.reverse();
        }
        let body = lines.concat()
            + "material m: diffuse { color = linear(0.5) }\n\
               instance s { shape = sphere(radius: v19999), material = m }";
        let scene = scene_of_text(&with_view(&body));
        assert_eq!(scene.instances[0].shape, Shape::Sphere { radius: 20_000.0 });
    }
}

#[test]
fn a_rotation_turns_about_x_then_y_then_z() {
    let scene = scene_of_text(&with_view(
        "material m: diffuse { color = linear(0.5) }\n\
         instance a { shape = sphere(radius: 1m), material = m, rotate = (90, 90, 0)deg, scale = 2, at = (1, 2, 3)m }",
    ));
    // y goes to z about x, then z goes to x about y.
    let m = scene.instances[0].world_from_object;
    assert_eq!(m, [[0.0, 2.0, 0.0, 1.0], [0.0, 0.0, -2.0, 2.0], [-2.0, 0.0, 0.0, 3.0]]);
}

#[test]
fn axes_are_the_columns_of_the_matrix() {
    let scene = scene_of_text(&with_view(
        "material clay: diffuse { color = linear(0.5) }\n\
         instance block { shape = box(size: (1, 1, 1)m), material = clay, at = (7, 8, 9)m, \
         axes.x = (0, 0, -2), axes.y = (0, 1, 0), axes.z = (1, 0, 0) }",
    ));
    let block = scene.instances.iter().find(|i| i.name.text == "block").expect("it is there");
    let expected = [[0.0, 0.0, 1.0, 7.0], [0.0, 1.0, 0.0, 8.0], [-2.0, 0.0, 0.0, 9.0]];
    assert_eq!(block.world_from_object, expected);
}

#[test]
fn objects_come_after_what_they_hold() {
    let scene = scene_of_text(&with_view(
        "material m: diffuse { color = linear(0.5) }\n\
         object inner { shape = sphere(radius: 1m), material = m, at = (1, 0, 0)m }\n\
         object outer { shape = [inner], rotate = (0, 0, 90)deg }\n\
         instance a: outer { at = (0, 0, 5)m }",
    ));
    assert_eq!(scene.instances[0].name.text, "a.inner");
    let m = scene.instances[0].world_from_object;
    assert_eq!([m[0][3], m[1][3], m[2][3]], [0.0, 1.0, 5.0]);
}

#[test]
fn what_a_group_holds_moves_with_the_group() {
    let scene = scene_of_text(&with_view(
        "material m: diffuse { color = linear(0.5) }\n\
         object inner { shape = sphere(radius: 1m), material = m, velocity = (1, 0, 0)m/s }\n\
         object outer { shape = [inner], rotate = (0, 0, 90)deg, scale = 2, velocity = (0, 0, 3)m/s }\n\
         instance a: outer { rotate = (90, 0, 0)deg, velocity = (0, 36, 0)km/h }\n\
         instance b: inner { }\n\
         light l: sphere { center = (0, 9, 0)m, radius = 1m, velocity = (0, 0, 50)mm/ms }",
    ));
    // x goes to 2y about z, then y to z and z to -y about x.
    let [a, b] = [0, 1].map(|i| scene.instances[i].velocity);
    assert_eq!((a, b), ([0.0, -3.0 + 10.0, 2.0], [1.0, 0.0, 0.0]));
    assert_eq!(scene.lights[0].velocity, [0.0, 0.0, 50.0]);
}

#[test]
fn the_lens_and_the_field_of_view_agree() {
    let camera = |fields: &str| {
        let text = format!(
            "rts 1\nsky s: constant {{ }}\nfilm f {{ size = (1600, 900)px }}\n\
             camera c: perspective {{ from = (0, 0, 3)m, to = (0, 0, 0)m, {fields} }}\n\
             render r: path {{ }}\n"
        );
        match scene_of_text(&text).camera.projection {
            Projection::Perspective(lens) => lens,
            other => panic!("{other:?}"),
        }
    };
    let lens = camera("lens = 50mm, f_stop = 2");
    assert!((lens.fov_horizontal.to_degrees() - 39.597_752).abs() < 1e-5);
    assert!((lens.fov_vertical.to_degrees() - 22.895_192).abs() < 1e-5);
    assert!((lens.radius - 0.0125).abs() < 1e-15);
    assert_eq!(lens.focus_distance, 3.0);
    let default = camera("");
    assert_eq!((default.fov_horizontal, default.radius), (lens.fov_horizontal, 0.0));
    let vertical = camera("fov.vertical = 22.8951922deg");
    assert!((vertical.fov_horizontal - lens.fov_horizontal).abs() < 1e-8);
    let horizontal = camera("fov.horizontal = 39.597752deg, f_stop = 2");
    assert!((horizontal.radius - 0.0125).abs() < 1e-9);
}

#[test]
fn of_a_camera_of_a_file_is_shown_what_the_text_says() {
    let shown = |fields: &str| {
        let text = with_view(&format!(
            "asset car = gltf(\"car.glb\")\ncamera eye like car.camera(\"Main eye\") {{ {fields} }}"
        ));
        let scene = scene_of_text(&text.replace("path { }", "path { camera = eye }"));
        let resolved = lang::resolved(&scene);
        let (_, rest) = resolved.split_once("camera ").expect("a camera");
        rest.split_once("\n}").expect("its end").0.to_owned()
    };
    let head = "eye like car.camera(\"Main eye\") {";
    let rest = "shutter = 0s..0s\n  aperture = 0m\n  sensor.width = 0.036m";
    assert_eq!(shown(""), format!("{head}\n  {rest}"));
    let (opening, sharp) = ("f_stop = 2", "focus = 3m");
    let expected =
        format!("{head}\n  {sharp}\n  shutter = 0s..0s\n  {opening}\n  sensor.width = 0.036m");
    assert_eq!(shown(&format!("{opening}, {sharp}")), expected);
    let seen = shown("fov.vertical = 30deg, up = (0, 0, 1), aperture = 2cm");
    assert!(seen.contains("up = (0, 0, 1)\n") && seen.contains("fov.vertical = 30deg"), "{seen}");
    assert!(seen.contains("aperture = 2cm") && !seen.contains("from"), "{seen}");
}

#[test]
fn what_is_metered_becomes_middle_grey() {
    let film = |fields: &str| {
        let text = format!(
            "rts 1\nsky s: constant {{ }}\nfilm f {{ {fields} }}\n\
             camera c: perspective {{ from = (0, 0, 3)m, to = (0, 0, 0)m }}\nrender r: path {{ }}\n"
        );
        scene_of_text(&text).film.exposure
    };
    // Sunny 16: EV 14.64 at ISO 100, 3200 nit.
    let sunny = film("f_number = 16, shutter = 10ms, iso = 100");
    assert!((2_f64.powf(sunny) * 3200.0 / 683.0 - 0.18).abs() < 1e-12, "{sunny}");
    // EV 0 at ISO 100 is 1/8 nit; ISO 100 is the default.
    let dark = film("f_number = 1, shutter = 1s");
    assert!((2_f64.powf(dark) * 0.125 / 683.0 - 0.18).abs() < 1e-12, "{dark}");
    // A stop is a stop, whichever way.
    assert!((film("f_number = 1, shutter = 2s") - dark - 1.0).abs() < 1e-12);
    assert!((film("f_number = 1, shutter = 1s, iso = 200") - dark - 1.0).abs() < 1e-12);
    assert!((film("f_number = 2, shutter = 1s") - dark + 2.0).abs() < 1e-12);
}

#[test]
fn power_is_spread_over_the_sphere() {
    let scene = scene_of_text(&with_view(
        "light l: sphere { center = (0, 0, 0)m, radius = 50cm, power = 10 }",
    ));
    let expected = 10.0 / (4.0 * std::f64::consts::PI.powi(2) * 0.25);
    assert!((scene.lights[0].radiance[0] - expected).abs() < 1e-12);
}

#[test]
fn a_mesh_of_the_text_has_points_and_faces() {
    let mesh = |points: &str, faces: &str| {
        let clay = "material clay: diffuse { color = linear(0.5) }";
        let shape = format!("mesh(points: {points}, faces: {faces})");
        with_view(&format!("{clay}\ninstance roof {{ shape = {shape}, material = clay }}"))
    };
    let tent = "[(0, 0, 0)m, (1, 0, 0)m, (1, 0, -1)m, (0, 0, -1)m, (50, 100, -50)cm]";
    let closed = "[(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (3, 2, 1, 0)]";
    let scene = scene_of_text(&mesh(tent, closed));
    let shape = &scene.instances[0].shape;
    let Shape::Faces { points, triangles } = shape else { panic!("{shape:?}") };
    assert_eq!((points[4], triangles.len()), ([0.5, 1.0, -0.5], 6));
    assert_eq!(triangles[4..], [[3, 2, 1], [3, 1, 0]]);
    assert_eq!(shape.bounds(), Some([[0.0, 0.0, -1.0], [1.0, 1.0, 0.0]]));
    assert_eq!(shape.open(), None);
    let volume = shape.signed_volume().expect("it is closed");
    assert!((volume - 1.0 / 3.0).abs() < 1e-12, "a third of the base times the height: {volume}");
    let open = scene_of_text(&mesh(tent, "[(0, 1, 4), (1, 2, 4)]"));
    assert_eq!(open.instances[0].shape.open(), Some("a mesh with open edges"));
    for (points, faces, wanted) in [
        (tent, "[(0, 1, 5)]", "this face has index 5, but there are 5 points"),
        (tent, "[(0, 1, 2.5)]", "an index of a point is a whole number from 0, found 2.5"),
        (tent, "[(0, 1)]", "a face needs three or four plain numbers, found two plain numbers"),
        (tent, "[(0, 1, -1)]", "an index of a point is a whole number from 0, found -1"),
        (tent, "7", "`faces` needs a list of faces such as `[(0, 1, 2)]`"),
        ("[(0, 0, 0)]", "[(0, 0, 0)]", "a point needs lengths, found plain numbers"),
        ("[(0, 0)m]", "[(0, 0, 0)]", "a point needs three lengths, found two lengths"),
    ] {
        let errors = describe(&check_text(&mesh(points, faces)));
        assert!(errors.contains(wanted), "{errors}");
    }
}

#[test]
fn a_quad_has_its_corners_and_an_area() {
    let quad = |corners: &str| {
        let clay = "material clay: diffuse { color = linear(0.5) }";
        with_view(&format!("{clay}\ninstance wall {{ shape = quad({corners}), material = clay }}"))
    };
    let scene = scene_of_text(&quad("a: (1, 2, 3)m, b: (200, 200, 300)cm, c: (2, 4, 3)m"));
    let shape = &scene.instances[0].shape;
    assert_eq!(
        *shape,
        Shape::Quad { corners: [[1.0, 2.0, 3.0], [2.0, 2.0, 3.0], [2.0, 4.0, 3.0]] }
    );
    assert_eq!(shape.bounds(), Some([[1.0, 2.0, 3.0], [2.0, 4.0, 3.0]]));
    assert_eq!((shape.size(), shape.reach()), (Some([1.0, 2.0, 0.0]), 4.0));
    for line in [
        "a: (0, 0, 0)m, b: (1, 1, 1)m, c: (3, 3, 3)m",
        "a: (0, 0, 0)m, b: (0, 0, 0)m, c: (1, 0, 0)m",
    ] {
        let text = quad(line);
        let errors = describe(&check_text(&text));
        assert!(
            errors.contains("the corners of this quad lie on a line: it has no area"),
            "{errors}"
        );
    }
}

#[test]
fn a_rectangle_light_is_an_instance_that_faces_its_target() {
    let scene = scene_of_text(&with_view(
        "light key: rectangle { at = (0, 3, 4)m, to = (0, 0, 0)m, size = (2, 0.5)m, power = 60W }",
    ));
    let instance = scene.instances.iter().find(|i| i.name.text == "key").expect("it is there");
    assert_eq!(instance.shape, Shape::Rectangle { size: [2.0, 0.5] });
    let rows = instance.world_from_object;
    let expected = [[1.0, 0.0, 0.0, 0.0], [0.0, -0.6, 0.8, 3.0], [0.0, -0.8, -0.6, 4.0]];
    let near = rows.iter().flatten().zip(expected.iter().flatten());
    assert!(near.clone().all(|(a, b): (&f64, &f64)| (a - b).abs() < 1e-12), "{rows:?}");
    let material = &scene.materials[instance.material.expect("it has one")];
    let MaterialModel::Emissive(glow) = &material.model else { panic!("{material:?}") };
    let Color::Constant(radiance) = glow.color else { panic!("{glow:?}") };
    assert!((radiance[0] * glow.brightness.value() - 60.0 / std::f64::consts::PI).abs() < 1e-12);
}

#[test]
fn a_sun_is_placed_by_direction_distance_and_angle() {
    let scene = scene_of_text(&with_view(
        "light l: sphere { direction = (3, 0, 4), distance = 10m, angular_radius = 30deg, \
         tint.color = linear(1, 0.6, 0.2) }",
    ));
    let light = &scene.lights[0];
    let near = |found: [f64; 3], expected: [f64; 3]| {
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
    };
    assert!(near(light.center, [6.0, 0.0, 8.0]), "{light:?}");
    assert!((light.radius - 5.0).abs() < 1e-12, "{light:?}");
    let tint = light.tint.expect("a tint is written");
    assert!(near(tint.direction, [0.6, 0.0, 0.8]) && near(tint.color, [1.0, 0.6, 0.2]));
    assert!((tint.angle.to_degrees() - 18.0).abs() < 1e-12);
}

#[test]
fn the_base_scales_the_bands_alone() {
    let with = |base: &str| {
        let field = format!("sun.direction = (0, 1, 0), base = {base}");
        let text = with_view("").replace("constant { }", &format!("gradient {{ {field} }}"));
        match scene_of_text(&text).sky.map(|sky| sky.model) {
            Some(SkyModel::Gradient { zenith, ground, glow, disc, .. }) => {
                (zenith, ground, glow, disc)
            }
            other => panic!("{other:?}"),
        }
    };
    let (one, half) = (with("1"), with("0.5"));
    assert_eq!((half.0, half.1), (one.0.map(|c| c * 0.5), one.1.map(|c| c * 0.5)));
    assert_eq!((half.2, half.3), (one.2, one.3));
}

#[test]
fn an_absent_sun_adds_nothing() {
    let text = with_view("").replace("constant", "gradient");
    match scene_of_text(&text).sky.map(|sky| sky.model) {
        Some(SkyModel::Gradient { glow, disc, horizon, .. }) => {
            assert_eq!((glow, disc, horizon), ([0.0; 3], [0.0; 3], [0.245, 0.105, 0.03]));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn random_numbers_are_evenly_spread_unless_they_are_to_be_independent() {
    let sampler = |field: &str| {
        let text = format!(
            "rts 1\nsky dim: constant {{ }}
camera eye: perspective {{ from = (0, 1, 5)m, to = (0, 1, 0)m }}
render main: path {{ {field} }}\n"
        );
        scene_of_text(&text).render.sampler
    };
    assert_eq!(sampler(""), Sampler::Sobol);
    assert_eq!(sampler("sampler = sobol"), Sampler::Sobol);
    assert_eq!(sampler("sampler = pcg"), Sampler::Pcg);
}

#[test]
fn names_point_at_their_text() {
    let files = files();
    let analysis = check_files(&files, &[]);
    let scene = analysis.scene.expect("a scene");
    for material in &scene.materials {
        let text = analysis.sources.slice(material.name.span);
        assert!(material.name.text.ends_with(text) && !text.is_empty());
    }
    for instance in &scene.instances {
        let text = analysis.sources.slice(instance.name.span);
        assert!(instance.name.text.contains(text) && !text.is_empty());
        assert!(!analysis.sources.slice(instance.shape_span).is_empty());
    }
    for asset in &scene.assets {
        assert_eq!(analysis.sources.slice(asset.path_span), format!("\"{}\"", asset.path));
    }
    let wall = scene.instances.iter().find(|i| i.name.text == "lantern.wall").expect("is public");
    assert_eq!(analysis.sources.name(wall.name.span.file), "parts/lantern.rts");
}

#[test]
fn only_what_is_used_is_in_the_scene() {
    let scene = scene_of_text(&with_view(
        "texture t = image(\"t.png\", space: srgb)\n\
         material used: diffuse { color = t.rgb }\n\
         material unused: diffuse { color = linear(0.5) }\n\
         asset a = gltf(\"a.glb\")\n\
         instance s { shape = sphere(radius: 1m), material = used }",
    ));
    assert_eq!((scene.materials.len(), scene.textures.len(), scene.assets.len()), (1, 1, 0));
    assert_eq!(
        scene.materials[0].model,
        MaterialModel::Diffuse(Diffuse { color: Color::Texture(0) })
    );
}

#[test]
fn expanded_instances_are_in_order_of_their_index() {
    let scene = scene_of_text(&with_view(
        "material m: diffuse { color = linear(0.5) }\n\
         instance s[i in -1..11] { shape = sphere(radius: 1m), material = m, at = (1m * i, 0m, 0m) }",
    ));
    let names: Vec<&str> = scene.instances.iter().map(|i| i.name.text.as_str()).collect();
    assert_eq!(names[..4], ["s[-1]", "s[0]", "s[1]", "s[2]"]);
    assert_eq!((names.len(), names[11]), (12, "s[10]"));
}

#[test]
fn the_number_of_instances_is_limited() {
    let text = with_view(
        "material m: diffuse { color = linear(0.5) }\n\
         object a { shape = sphere(radius: 1m), material = m }\n\
         object b { shape = sphere(radius: 2m), material = m }\n\
         object pair { shape = [a, b] }\n\
         instance s[i in 0..500_001]: pair { }",
    );
    let analysis = check_text(&text);
    let codes: Vec<&str> = analysis.diagnostics.iter().map(|d| d.code.0).collect();
    assert_eq!(codes, ["E0801"], "{}", describe(&analysis));
}

/// One line for each number below `n`.
fn lines(n: usize, line: impl Fn(usize) -> String) -> String {
    (0..n).map(line).collect::<Vec<String>>().join("\n") + "\n"
}

/// Names separated by commas.
fn names(n: usize, prefix: &str) -> String {
    (0..n).map(|i| format!("{prefix}{i}")).collect::<Vec<String>>().join(", ")
}

#[test]
fn hostile_scenes_end_soon() {
    // Groups that multiply and hold nothing.
    let mut groups = lines(300, |i| format!("object o{i} {{ shape = nothing }}"));
    let mut members = names(300, "o");
    for level in 0..6 {
        groups += &lines(30, |i| format!("object g{level}_{i} {{ shape = [{members}] }}"));
        members = names(30, &format!("g{level}_"));
    }
    groups += &lines(1, |_| format!("instance s {{ shape = [{members}] }}"));
    // A list with many copies, and as many groups of it.
    let list = format!("let l = [{}]\n", names(20_000, "o"))
        + &lines(20_000, |i| format!("let c{i} = l"))
        + &lines(20_000, |i| format!("object o{i} {{ shape = l }}"));
    let unknown = lines(20_000, |i| format!("let u{i} = unknown{i}"));
    // A chain in which the last refers to all before it.
    let cycle = format!("let y = [{}]\n", names(3_000, "x"))
        + &lines(3_000, |i| format!("let x{i} = [x{}, y]", i + 1));
    for body in [groups, list, unknown, cycle] {
        let start = std::time::Instant::now();
        assert!(!check_text(&with_view(&body)).diagnostics.is_empty());
        let seconds = start.elapsed().as_secs();
        assert!(seconds < 30, "{seconds} s for {}", &body[..60]);
    }
}
