//! Extensions that add to what a file holds: glossy materials, instances, compression, WebP.

use super::import_support::{Builder, compressed_triangle, tiny_png, triangle};
use super::{close, load, load_bytes, soup};
use compiler::import::{ErrorKind, Pixels};
use lang::scene::ColorSpace;
use serde_json::{Value, json};

#[test]
fn glossy_materials_keep_their_colours() {
    let mut document = triangle();
    let image = document.view(&tiny_png());
    document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    document.json["textures"] = json!([{"source": 0}]);
    document.json["extensionsRequired"] = json!(["KHR_materials_pbrSpecularGlossiness"]);
    document.json["materials"] = json!([{"alphaMode": "BLEND", "extensions": {
        "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.25, 0.5, 0.75, 0.5],
            "specularFactor": [1, 0.5, 0.02], "glossinessFactor": 0.8,
            "specularGlossinessTexture": {"index": 0}}
    }, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mesh = load(&document);
    let [paint] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((paint.color, paint.alpha, paint.metallic), ([0.25, 0.5, 0.75], 0.5, 0.0));
    let [r, g, b] = paint.specular_color;
    assert!(close(r, 25.0) && close(g, 12.5) && close(b, 0.5), "of a reflectance of 0.04");
    let (color, rough) = (paint.specular_color_map.expect("a map"), paint.metallic_roughness_map);
    let rough = rough.expect("a map");
    assert_eq!(
        (color.space, rough.space, paint.roughness),
        (ColorSpace::Srgb, ColorSpace::Data, 1.0)
    );
    let Pixels::Rgba8(texels) = &mesh.images[rough.image as usize].image.data else {
        panic!("8 bits");
    };
    // Alpha 255 and 64: 1 - 0.8 and 1 - 0.8 * 64 / 255.
    assert_eq!([texels[1], texels[5]], [51, 204]);
    document.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] =
        json!({"diffuseFactor": [1, 2]});
    let error = load_bytes(&document.glb(), &[]).expect_err("two numbers");
    assert!(error.to_string().contains("its diffuseFactor is not what KHR_"), "{error}");
}

/// `triangle()` at these places.
fn instances(attributes: &Value) -> Builder {
    let mut document = triangle();
    document.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    document.json["nodes"][0]["translation"] = json!([0, 0, 7]);
    document.json["nodes"][0]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": attributes}});
    document
}

#[test]
fn a_node_with_instances_is_there_as_often() {
    let mut document = instances(&json!({}));
    let moved = document.floats(&[[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0; 3]], "VEC3");
    let half = 0.5_f32.sqrt();
    let turned = document
        .floats(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, half, half], [0.0, 0.0, 0.0, 9.0]], "VEC4");
    let scaled = document.floats(&[[1.0; 3], [1.0; 3], [2.0, 3.0, 4.0]], "VEC3");
    document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] =
        json!({"TRANSLATION": moved, "ROTATION": turned, "SCALE": scaled});
    let mesh = load(&document);
    assert_eq!(mesh.parts.len(), 3);
    let corners: Vec<_> = mesh.parts.iter().map(|part| part.corners(0)).collect();
    assert_eq!(corners[0], [[1.0, 0.0, 7.0], [2.0, 0.0, 7.0], [1.0, 1.0, 7.0]]);
    // A quarter turn about z takes x to y.
    for (found, expected) in
        corners[1].iter().flatten().zip([0.0, 2.0, 7.0, 0.0, 3.0, 7.0, -1.0, 2.0, 7.0])
    {
        assert!((found - expected).abs() < 1e-6, "{:?}", corners[1]);
    }
    assert_eq!(corners[2], [[0.0, 0.0, 7.0], [2.0, 0.0, 7.0], [0.0, 3.0, 7.0]]);
    assert_eq!(mesh.report.n_triangles, 3);
    assert_eq!(mesh.report.warnings, []);
}

#[test]
fn instances_that_make_no_sense_are_errors() {
    let check = |document: &Builder, expected: &str| {
        let error = load_bytes(&document.glb(), &[]).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
    };
    check(&instances(&json!({})), "its instances have neither TRANSLATION nor ROTATION nor SCALE");
    check(
        &instances(&json!({"TRANSLATION": "all"})),
        "TRANSLATION of its instances is no accessor",
    );
    check(&instances(&json!({"TRANSLATION": 99})), "accessor 99");
    // Positions and indices of the triangle have three elements each, two of them floats.
    let mut document = instances(&json!({}));
    let two = document.floats(&[[1.0; 3]; 2], "VEC3");
    let attributes = |value| json!({"EXT_mesh_gpu_instancing": {"attributes": value}});
    document.json["nodes"][0]["extensions"] = attributes(json!({"TRANSLATION": 0, "SCALE": two}));
    check(&document, "it has 2 elements, but there are 3 instances");
    let none = document.floats(&[[0.0; 4]], "VEC4");
    document.json["nodes"][0]["extensions"] = attributes(json!({"ROTATION": none}));
    check(&document, "the rotation of its instance 0 is none");
    let many = document
        .push("accessors", json!({"componentType": 5126, "count": 4_000_000, "type": "VEC3"}));
    document.json["nodes"][0]["extensions"] = attributes(json!({"TRANSLATION": many}));
    check(&document, "it has 4000000 instances, the limit is 1048576");
}

#[test]
fn compressed_buffer_views_are_what_they_were() {
    let plain = load(&triangle());
    let document = compressed_triangle();
    assert_eq!(soup(&load(&document)), soup(&plain));
    let check = |key: &str, value: Value, expected: &str| {
        let mut document = document.clone();
        document.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
        let error = load_bytes(&document.glb(), &[]).expect_err(expected);
        let expected = format!("a.glb: buffer view 0: {expected}");
        assert_eq!((error.kind, error.to_string()), (ErrorKind::Accessor, expected));
    };
    let wrong = "it is not what EXT_meshopt_compression says";
    check("mode", json!("SQUARES"), wrong);
    check("filter", json!("BLUR"), wrong);
    check("byteStride", json!(13), wrong);
    check("count", json!(0), wrong);
    check("byteLength", json!("all"), wrong);
    check("count", json!(4), "it is not as long as what EXT_meshopt_compression says");
    check("byteOffset", json!(1_000_000), "its compressed bytes are not inside their buffer");
    check("buffer", json!(1), "its compressed bytes are not inside their buffer");
    let mut damaged = document.clone();
    let at = &damaged.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
    let at = usize::try_from(at["byteOffset"].as_u64().expect("a number")).expect("small");
    damaged.binary[at] = 0;
    let error = load_bytes(&damaged.glb(), &[]).expect_err("no header");
    assert!(error.to_string().contains("its compressed bytes are damaged: "), "{error}");
}

#[test]
fn textures_may_be_webp_with_another_image_for_others() {
    let mut document = triangle();
    let mut webp = Vec::new();
    let encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut webp);
    encoder.encode(&[9, 8, 7, 6], 1, 1, image::ExtendedColorType::Rgba8).expect("encode");
    let [png, webp] = [tiny_png(), webp].map(|bytes| document.view(&bytes));
    document.json["images"] = json!([{"bufferView": png, "mimeType": "image/png"},
        {"bufferView": webp, "mimeType": "image/webp"}]);
    document.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
    document.json["materials"] =
        json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    for source in [json!({}), json!({"source": 0})] {
        let mut texture = source;
        texture["extensions"] = json!({"EXT_texture_webp": {"source": 1}});
        document.json["textures"] = json!([texture]);
        let mesh = load(&document);
        assert_eq!(mesh.images.len(), 1);
        let Pixels::Rgba8(texels) = &mesh.images[0].image.data else { panic!("8 bits") };
        assert_eq!(texels.as_slice(), [9, 8, 7, 6]);
    }
    document.json["textures"][0]["extensions"]["EXT_texture_webp"] = json!({"source": "one"});
    let error = load_bytes(&document.glb(), &[]).expect_err("a text as an index");
    assert!(error.to_string().contains("is not what EXT_texture_webp says"), "{error}");
}
