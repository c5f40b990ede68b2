//! Materials of glTF, with their extensions and the colours of vertices.

use super::import_support::{tiny_png, triangle};
use super::{close, load, load_bytes};
use lang::scene::{ColorSpace, Wrap};
use serde_json::{Value, json};

/// glTF 2.0, 3.7.2.1: without a material a primitive has the default one.
#[test]
fn primitives_without_a_material_are_white_rough_metal() {
    let mesh = load(&triangle());
    let [default] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((default.name.as_str(), mesh.parts[0].material), ("default", Some(0)));
    assert_eq!((default.color, default.metallic, default.roughness), ([1.0; 3], 1.0, 1.0));
}

#[test]
fn materials_carry_factors_maps_and_extensions() {
    let mut document = triangle();
    let image = document.view(&tiny_png());
    document.json["images"] =
        json!([{"bufferView": image, "mimeType": "image/png"}, {"uri": "no such.png"}]);
    document.json["samplers"] = json!([{"wrapS": 33071, "wrapT": 33648}]);
    document.json["textures"] = json!([{"source": 0, "sampler": 0}, {"source": 1}]);
    document.json["materials"] = json!([
        {"name": "unused", "emissiveTexture": {"index": 1}},
        {"name": "wood", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
         "emissiveFactor": [1, 0.5, 0], "normalTexture": {"index": 0, "scale": 0.5, "extensions":
            {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 1], "rotation": 1.570_796_4}}},
         "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.6, 0.7, 0.8], "metallicFactor": 0.1,
            "roughnessFactor": 0.3, "baseColorTexture": {"index": 0, "extensions":
                {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 1], "rotation": 1.570_796_4}}}},
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4},
            "KHR_materials_ior": {"ior": 1.25}, "KHR_materials_transmission": {"transmissionFactor": 0.75}}}
    ]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(1);
    let mesh = load(&document);
    let [wood] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((wood.name.as_str(), mesh.parts[0].material), ("wood", Some(0)));
    assert!(close(wood.color[2], 0.7) && close(wood.metallic, 0.1) && close(wood.roughness, 0.3));
    assert_eq!((wood.emission, wood.alpha_clip), ([4.0, 2.0, 0.0], Some(0.25)));
    assert!(close(wood.alpha, 0.8) && close(wood.ior, 1.25) && close(wood.transmission, 0.75));
    let map = wood.color_map.expect("map");
    assert_eq!((map.wrap, wood.alpha_map), ([Wrap::Clamp, Wrap::Mirror], Some(map)));
    assert_eq!(mesh.images.len(), 1);
    // (1, 0) scaled (2, 0), turned counter-clockwise in the image (v downwards) (0, -2), moved, flipped.
    let [_, uv, _] = mesh.parts[0].corner_uvs(0).expect("uvs");
    assert!((uv[0] - 0.5).abs() < 1e-6 && (uv[1] - 3.0).abs() < 1e-6, "{uv:?}");
    let normal = wood.normal_map.expect("map");
    assert_eq!((normal.space, wood.normal_strength), (ColorSpace::Data, 0.5));
    assert_eq!(mesh.report.warnings, [], "looked up like the colour");
}

#[test]
fn layers_of_a_material_are_read_from_their_extensions() {
    let mut document = triangle();
    let image = document.view(&tiny_png());
    document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    document.json["textures"] = json!([{"source": 0}]);
    document.json["extensionsRequired"] =
        json!(["KHR_materials_clearcoat", "KHR_materials_volume"]);
    document.json["materials"] = json!([{"name": "paint", "extensions": {
        "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 0.5],
            "specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25,
            "clearcoatTexture": {"index": 0}, "clearcoatNormalTexture": {"index": 0}},
        "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": {"index": 0}},
        "KHR_materials_volume": {"thicknessFactor": 0.1, "attenuationDistance": 2,
            "attenuationColor": [0.5, 1, 1]}
    }, "pbrMetallicRoughness": {"metallicFactor": 0}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mesh = load(&document);
    let [paint] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((paint.specular, paint.specular_color), (0.5, [2.0, 1.0, 0.5]));
    assert_eq!((paint.coat, paint.coat_roughness, paint.transmission), (0.75, 0.25, 1.0));
    let spaces =
        [paint.specular_map, paint.specular_color_map, paint.coat_map, paint.transmission_map]
            .map(|map| map.map(|map| map.space));
    let (data, srgb) = (Some(ColorSpace::Data), Some(ColorSpace::Srgb));
    assert_eq!((spaces, paint.coat_roughness_map), ([data, srgb, data, data], None));
    assert!(paint.solid && paint.is_glass());
    let said: Vec<&str> = mesh.report.warnings.iter().map(|w| w.message.as_str()).collect();
    assert_eq!(
        said,
        [
            "normal maps of coats are not used (1 material)",
            "colour, roughness, coat and opaque part of solid glass are not used (1 material)",
        ]
    );
    // Half of the red is left after two metres.
    let expected = std::f64::consts::LN_2 / 2.0;
    assert!(close(paint.sigma_a[0], expected) && paint.sigma_a[1..] == [0.0, 0.0]);
}

#[test]
fn sheen_is_read_with_its_images() {
    let mut document = triangle();
    let image = document.view(&tiny_png());
    document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    document.json["textures"] = json!([{"source": 0}]);
    document.json["extensionsRequired"] = json!(["KHR_materials_sheen"]);
    let sheen = json!({"sheenColorFactor": [0.5, 0.25, 2], "sheenRoughnessFactor": 0.75,
        "sheenColorTexture": {"index": 0}, "sheenRoughnessTexture": {"index": 0}});
    document.json["materials"] = json!([{"extensions": {"KHR_materials_sheen": sheen}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mesh = load(&document);
    let velvet = &mesh.materials[0];
    assert_eq!((velvet.sheen, velvet.sheen_roughness), ([0.5, 0.25, 1.0], 0.75));
    let spaces = [velvet.sheen_map, velvet.sheen_roughness_map].map(|map| map.map(|map| map.space));
    assert_eq!(spaces, [Some(ColorSpace::Srgb), Some(ColorSpace::Data)]);
    assert_eq!(mesh.report.warnings, []);
    document.json["materials"][0]["extensions"]["KHR_materials_sheen"] =
        json!({"sheenColorFactor": [1, 2]});
    let error = load_bytes(&document.glb(), &[]).expect_err("two numbers");
    assert!(error.to_string().contains("the colour of its sheen is not three numbers"), "{error}");
}

#[test]
fn brushed_materials_keep_their_wider_width() {
    let load_with = |material: Value| {
        let mut document = triangle();
        let image = document.view(&tiny_png());
        document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
        document.json["textures"] = json!([{"source": 0}]);
        document.json["extensionsRequired"] = json!(["KHR_materials_anisotropy"]);
        document.json["materials"] = json!([material]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        load(&document)
    };
    let brushed = |extension: Value, roughness: f64| {
        load_with(json!({"extensions": {"KHR_materials_anisotropy": extension},
            "pbrMetallicRoughness": {"roughnessFactor": roughness}}))
    };
    let mesh = brushed(json!({"anisotropyStrength": 0.5, "anisotropyRotation": 1.5}), 0.5);
    let steel = &mesh.materials[0];
    // alpha 1/4 across, 1/4 + 3/4 * 1/4 along.
    let aspect = (1.0 - 0.9 * steel.anisotropy).sqrt();
    let alpha = steel.roughness.powi(2);
    assert!(close(alpha * aspect, 0.25) && close(alpha / aspect, 0.4375), "{steel:?}");
    assert_eq!((steel.anisotropy_rotation, steel.anisotropy_map), (1.5, None));
    assert_eq!(mesh.report.warnings, []);
    let mesh = brushed(json!({"anisotropyStrength": 1, "anisotropyTexture": {"index": 0}}), 0.1);
    let steel = &mesh.materials[0];
    assert!(close(steel.anisotropy, 1.0) && close(steel.roughness.powi(4), 0.1), "{steel:?}");
    assert_eq!(steel.anisotropy_map.map(|map| map.space), Some(ColorSpace::Data));
    assert_eq!(mesh.report.warnings.len(), 2, "{:?}", mesh.report.warnings);
    let sheen = json!({"sheenColorFactor": [1, 1, 1], "sheenColorTexture": {"index": 0}});
    let mesh = load_with(json!({"pbrMetallicRoughness": {"roughnessFactor": 0.5}, "extensions":
        {"KHR_materials_sheen": sheen, "KHR_materials_anisotropy": {"anisotropyStrength": 0.5}}}));
    assert_eq!((mesh.materials[0].sheen, mesh.materials[0].sheen_map), ([0.0; 3], None));
    let message = "sheen is left out of what is coated or brushed (1 material)";
    assert_eq!(mesh.report.warnings[0].message, message);
    let plain = brushed(json!({"anisotropyRotation": 1}), 0.5);
    assert_eq!((plain.materials[0].anisotropy, plain.materials[0].roughness), (0.0, 0.5));
}

#[test]
fn a_thin_pane_is_no_glass() {
    let mut document = triangle();
    document.json["materials"] = json!([{"extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 0}
    }, "pbrMetallicRoughness": {"metallicFactor": 0}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mesh = load(&document);
    assert!(!mesh.materials[0].is_glass() && mesh.materials[0].transmission > 0.0);
}

#[test]
fn a_clear_coat_that_is_not_gltf_is_an_error() {
    for (coat, expected) in [
        (json!({"clearcoatFactor": "much"}), "a factor of its clear coat is not a number"),
        (json!({"clearcoatTexture": 3}), "its clearcoatTexture is not glTF"),
        (json!({"clearcoatTexture": {"index": 7}}), "there is no texture 7"),
    ] {
        let mut document = triangle();
        document.json["materials"] = json!([{"extensions": {"KHR_materials_clearcoat": coat}}]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let error = load_bytes(&document.glb(), &[]).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
    }
}

#[test]
fn opaque_ignores_alpha_and_blend_is_coverage() {
    for (mode, expected) in [("OPAQUE", (1.0, None)), ("BLEND", (0.5, None))] {
        let mut document = triangle();
        document.json["materials"] = json!([{"alphaMode": mode, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let mesh = load(&document);
        let material = &mesh.materials[0];
        assert_eq!((material.alpha, material.alpha_clip), expected);
        assert_eq!(mesh.report.warnings, []);
    }
}

#[test]
fn vertex_colours_are_factors_beside_images_too_and_alpha_where_the_file_asks() {
    for (kind, mode, has_image) in [
        ("VEC3", "OPAQUE", false),
        ("VEC4", "OPAQUE", true),
        ("VEC4", "BLEND", false),
        ("VEC4", "MASK", true),
        ("VEC3", "BLEND", true),
    ] {
        let mut document = triangle();
        let colors = match kind {
            "VEC3" => document.floats(&[[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [0.0, 0.0, 0.5]], kind),
            _ => document
                .floats(&[[1.0, 0.0, 0.5, 1.0], [0.0, 1.0, 0.5, 0.0], [0.0, 0.0, 0.5, 1.0]], kind),
        };
        document.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let mut material = json!({
            "name": "m",
            "alphaMode": mode,
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1]}
        });
        if has_image {
            let png = document.view(&tiny_png());
            document.json["images"] = json!([{"bufferView": png, "mimeType": "image/png"}]);
            document.json["textures"] = json!([{"source": 0}]);
            material["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
        }
        document.json["materials"] = json!([material]);
        let mesh = load(&document);
        let part = &mesh.parts[0];
        let found = &mesh.materials[part.material.expect("a material") as usize];
        assert_eq!((found.name.as_str(), found.color), ("m", [0.5, 1.0, 1.0]));
        assert_eq!(
            (found.color_map.is_some(), mesh.images.len()),
            (has_image, usize::from(has_image))
        );
        let alpha = kind == "VEC4" && mode != "OPAQUE";
        assert_eq!((found.vertex_colors, found.vertex_alpha), (true, alpha), "{kind} {mode}");
        // Materials of the scene may ask for alpha that the file does not.
        let second = [0.0, 1.0, 0.5, if kind == "VEC4" { 0.0 } else { 1.0 }];
        assert_eq!(part.corner_colors(0), [[1.0, 0.0, 0.5, 1.0], second, [0.0, 0.0, 0.5, 1.0]]);
        assert_eq!(part.corner_uvs(0), Some([[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]));
        assert!(mesh.report.warnings.is_empty());
    }
}
