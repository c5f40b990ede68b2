//! Values leave code out, not only kinds: a term that is 0, a factor that is 1, a choice of one. Each case is
//! a scene with such a value, the same scene without the field, and one where the value counts.
//!
//! The first two must have the very same kernel and the very same picture, the third what they lack.

use std::path::Path;

use pack::features as bit;
use pack::{Checked, Kind, Pack};
use tests::picture;
use tests::scene::{bytes, compile_in};

/// Three texts of the part that differs.
struct Case {
    name: &'static str,
    /// With a value that does nothing.
    idle: &'static str,
    /// Without it.
    without: &'static str,
    /// With one that does something.
    busy: &'static str,
    /// Feature bits that only the last has.
    bits: u64,
    /// Words that only the kernel of the last has.
    words: &'static [&'static str],
}

const CASES: &[Case] = &[
    Case {
        name: "fog of density 0",
        idle: "medium mist: fog { density = 0/m, color = linear(9) }\nAIR mist\n",
        without: "",
        busy: "medium mist: fog { density = 0.01/m, color = linear(9) }\nAIR mist\n",
        bits: bit::FOG,
        words: &["fog_segment", "load_frame_fog", "load_medium"],
    },
    Case {
        name: "clear air",
        idle: "medium thin: homogeneous { sigma_a = (0, 0, 0)/m }\nAIR thin\n",
        without: "",
        busy: "medium thin: homogeneous { sigma_s = (0.1, 0, 0)/m }\nAIR thin\n",
        bits: bit::MEDIA | bit::SCATTERING,
        words: &["homogeneous_weight", "phase_sample", "struct Volume"],
    },
    Case {
        name: "a medium that nothing is filled with",
        idle: "medium _smoke: homogeneous { sigma_s = (1, 1, 1)/m }\n",
        without: "",
        busy: "medium _smoke: homogeneous { sigma_s = (1, 1, 1)/m }\nAIR _smoke\n",
        bits: bit::MEDIA | bit::SCATTERING,
        words: &["phase_sample", "load_medium"],
    },
    Case {
        name: "a closed shutter",
        idle: "CAMERA shutter = 2ms..2ms\nTHING velocity = (0, 0, 0)m/s\n",
        without: "",
        busy: "CAMERA shutter = 0ms..9ms\nTHING velocity = (20, 0, 0)m/s\n",
        bits: bit::MOTION,
        words: &["motion_", "load_object_"],
    },
    Case {
        name: "an aperture of 0",
        idle: "CAMERA aperture = 0cm\n",
        without: "",
        busy: "CAMERA aperture = 40cm\n",
        bits: bit::LENS,
        words: &["thin_lens_ray", "PURPOSE_LENS"],
    },
    Case {
        name: "blades of an aperture of 0",
        idle: "CAMERA aperture = 0cm, blades = 6, rotation = 10deg\n",
        without: "",
        busy: "CAMERA aperture = 40cm, blades = 6, rotation = 10deg\n",
        bits: bit::LENS | bit::BLADES,
        words: &["thin_lens_ray", "blades_point"],
    },
    Case {
        name: "a box filter of one pixel",
        idle: "FILM filter = box, filter.width = 1px\n",
        without: "",
        busy: "FILM filter = box, filter.width = 2px\n",
        bits: pack::abi::FilterKind::Box.feature(),
        words: &["box_offset", "load_frame_filter_width"],
    },
    Case {
        name: "paths of limited length",
        idle: "",
        without: "",
        busy: "RENDER depth = unlimited\n",
        bits: bit::UNLIMITED,
        words: &["unlimited_survival"],
    },
    Case {
        name: "a normal map of strength 0",
        idle: "texture bumps = image(\"holes.png\", space: data)\nMATERIAL normal = bumps.rgb, normal.strength = 0\n",
        without: "",
        busy: "texture bumps = image(\"holes.png\", space: data)\nMATERIAL normal = bumps.rgb\n",
        bits: bit::NORMAL_MAPS | bit::TANGENTS | bit::TEXTURE_RGBA8_LINEAR,
        words: &["normal_map_tilt", "texel_words", "triangle_tangent"],
    },
    Case {
        name: "emission of strength 0 from a picture",
        idle: "texture glow = image(\"holes.png\", space: srgb)\nMATERIAL emission.color = glow.rgb, emission.strength = 0\n",
        without: "",
        busy: "texture glow = image(\"holes.png\", space: srgb)\nMATERIAL emission.color = glow.rgb, emission.strength = 1\n",
        bits: bit::TEXTURE_RGBA8_SRGB,
        words: &["texel_words", "bilinear_fetch"],
    },
    Case {
        name: "alpha that is 1 everywhere",
        idle: "texture full = image(\"full.png\", space: data)\nMATERIAL alpha = full.a, alpha.clip = 100%\n",
        without: "",
        busy: "texture full = image(\"holes.png\", space: data)\nMATERIAL alpha = full.a, alpha.clip = 100%\n",
        bits: bit::ALPHA_CLIP | bit::TEXTURE_RGBA8_LINEAR,
        words: &["alpha_exists", "texel_words"],
    },
    Case {
        name: "a cutoff of 0",
        idle: "texture some = image(\"holes.png\", space: data)\nMATERIAL alpha = some.a, alpha.clip = 0%\n",
        without: "",
        busy: "texture some = image(\"holes.png\", space: data)\nMATERIAL alpha = some.a, alpha.clip = 1%\n",
        bits: bit::ALPHA_CLIP | bit::TEXTURE_RGBA8_LINEAR,
        words: &["alpha_exists", "texel_words"],
    },
    Case {
        name: "coverage of 1",
        idle: "MATERIAL alpha = 1\n",
        without: "",
        busy: "MATERIAL alpha = 0.99\n",
        bits: bit::ALPHA_BLEND,
        words: &["coverage_", "PURPOSE_COVERAGE", "// Whose numbers decide which surfaces"],
    },
    Case {
        name: "coverage of a picture that is 1 everywhere",
        idle: "texture full = image(\"full.png\", space: data)\nMATERIAL alpha = full.a\n",
        without: "",
        busy: "texture full = image(\"holes.png\", space: data)\nMATERIAL alpha = full.a\n",
        bits: bit::ALPHA_BLEND | bit::TEXTURE_RGBA8_LINEAR,
        words: &["coverage_", "texel_words"],
    },
    Case {
        name: "a coat of weight 0",
        idle: "MATERIAL coat.weight = 0, coat.roughness = 0.3\n",
        without: "",
        busy: "MATERIAL coat.weight = 1, coat.roughness = 0.3\n",
        bits: bit::PRINCIPLED_COAT,
        words: &["// ---- bsdf/coat.wgsl"],
    },
    Case {
        name: "black sheen",
        idle: "MATERIAL sheen = linear(0), sheen.roughness = 0.5\n",
        without: "",
        busy: "MATERIAL sheen = linear(0.5), sheen.roughness = 0.5\n",
        bits: bit::PRINCIPLED_SHEEN,
        words: &["// ---- bsdf/sheen.wgsl", "under_sheen_"],
    },
    Case {
        name: "projection of nothing",
        idle: "MATERIAL projection = box\n",
        without: "",
        busy: "MATERIAL projection = box, metallic = 0.5 * checker(3)\n",
        bits: bit::OBJECTS,
        words: &["projection_apply(", "projection_on(", "projection_axis("],
    },
    Case {
        name: "anisotropy of 0",
        idle: "MATERIAL anisotropy = 0, anisotropy.rotation = 30deg\n",
        without: "",
        busy: "MATERIAL anisotropy = 0.5, anisotropy.rotation = 30deg\n",
        bits: bit::PRINCIPLED_ANISOTROPY | bit::TANGENTS,
        words: &["// ---- bsdf/brushed_gloss.wgsl", "ggx_anisotropic_"],
    },
    Case {
        name: "transmission of 0",
        idle: "MATERIAL transmission = 0\n",
        without: "",
        busy: "MATERIAL transmission = 0.5\n",
        bits: bit::PRINCIPLED_TRANSMISSION,
        words: &[],
    },
    Case {
        name: "a white tint",
        idle: "LIGHT tint.color = linear(1), tint.angle = 40deg\n",
        without: "",
        busy: "LIGHT tint.color = linear(1, 0.5, 0.2), tint.angle = 40deg\n",
        bits: bit::TINT,
        words: &["tint_radiance", "FLAG_EMIT_TINT"],
    },
    Case {
        name: "a light that shines all around",
        idle: "light beam: point { at = (0, 3, 0)m, intensity = 9cd }\n",
        without: "light beam: point { at = (0, 3, 0)m, intensity = 9cd }\n",
        busy: "light beam: spot { at = (0, 3, 0)m, cone = 30deg, intensity = 9cd }\n",
        bits: bit::SPOT,
        words: &["spot_radiance", "FLAG_EMIT_SPOT"],
    },
    Case {
        name: "a light without a profile",
        idle: "light lamp: point { at = (0, 3, 0)m, intensity = 9cd }\n",
        without: "light lamp: point { at = (0, 3, 0)m, intensity = 9cd }\n",
        busy: "texture dots = image(\"holes.png\", space: linear)\nlight lamp: point { at = (0, 3, 0)m, profile = dots }\n",
        bits: bit::PROFILE | bit::TEXTURE_RGBA8_LINEAR,
        words: &["profile_radiance", "FLAG_EMIT_PROFILE"],
    },
    Case {
        name: "a light that is visible",
        idle: "LIGHT visible = on\n",
        without: "",
        busy: "LIGHT visible = off\n",
        bits: bit::UNSEEN,
        words: &["unseen_pass", "FLAG_UNSEEN"],
    },
    Case {
        name: "a black light at infinity",
        idle: "light far: directional { direction = (0, 1, 0), color = linear(0), strength = 3 }\n",
        without: "",
        busy: "light far: directional { direction = (0, 1, 0), strength = 3 }\n",
        bits: bit::LIGHT_CHOICE | pack::abi::LightKind::Directional.feature(),
        words: &["directional_miss", "LIGHT_DIRECTIONAL", "directional_count"],
    },
    Case {
        name: "a gradient of one colour",
        idle: "SKY gradient { zenith = linear(0.5), middle = linear(0.5), horizon = linear(0.5), ground = linear(0.5) }\n",
        without: "SKY constant { color = linear(0.5) }\n",
        busy: "SKY gradient { zenith = linear(1) }\n",
        bits: pack::abi::SkyKind::Gradient.feature(),
        words: &["gradient_radiance"],
    },
    Case {
        name: "glass of roughness 0",
        idle: "MORE dielectric { roughness = 0 }\n",
        without: "MORE dielectric { }\n",
        busy: "MORE dielectric { roughness = 0.3 }\n",
        bits: pack::abi::MaterialKind::RoughDielectric.feature(),
        words: &["rough_dielectric_sample"],
    },
    Case {
        name: "one light",
        idle: "",
        without: "",
        busy: "light second: sphere { center = (-2, 4, 2)m, radius = 30cm, strength = 20 }\n",
        bits: bit::LIGHT_CHOICE,
        words: &["choose_light", "load_light_cdf", "PURPOSE_LIGHT_CHOICE", "load_light_pmf"],
    },
];

/// The scene with these lines: most are declarations, the others begin with the place they belong to.
fn text(lines: &str) -> String {
    let take = |place: &str| {
        let found = lines.split('\n').filter_map(|line| line.strip_prefix(place));
        found.collect::<Vec<_>>().join(", ")
    };
    let fields = |place: &str| {
        let found = take(place);
        if found.is_empty() { found } else { format!(", {found}") }
    };
    let places =
        ["AIR ", "CAMERA ", "FILM ", "RENDER ", "THING ", "MATERIAL ", "LIGHT ", "SKY ", "MORE "];
    let own = lines.split('\n').filter(|line| !places.iter().any(|place| line.starts_with(place)));
    let declared = own.collect::<Vec<_>>().join("\n");
    let sky = take("SKY ");
    let sky =
        if sky.is_empty() { "constant { color = linear(0.2, 0.3, 0.4) }".to_owned() } else { sky };
    let more = take("MORE ");
    let more = if more.is_empty() {
        String::new()
    } else {
        format!(
            "material n: {more}\ninstance other {{ shape = sphere(radius: 40cm), material = n, at = (1.2, 0.4, 1.5)m }}\n"
        )
    };
    let depth = take("RENDER ");
    let depth = if depth.is_empty() { "depth = 6".to_owned() } else { depth };
    let air = take("AIR ");
    let air = if air.is_empty() { air } else { format!(", atmosphere = {air}") };
    format!(
        "rts 1
{declared}{more}sky day: {sky}
material m: principled {{ color = linear(0.5, 0.4, 0.3), roughness = 0.4{} }}
instance crate {{ shape = box(size: (1, 1, 1)m), material = m, at = (0, 0.7, 0)m, rotate = (10, 30, 0)deg{} }}
light bulb: sphere {{ center = (2, 4, 2)m, radius = 50cm, strength = 20{} }}
camera eye: perspective {{ from = (0, 1, 5)m, to = (0, 0.7, 0)m, fov.vertical = 40deg{} }}
film tiny {{ size = (24, 18)px{} }}
render main: path {{ camera = eye, film = tiny, samples = 8, {depth}, seed = 3{air} }}\n",
        fields("MATERIAL "),
        fields("THING "),
        fields("LIGHT "),
        fields("CAMERA "),
        fields("FILM "),
    )
}

fn write_images(dir: &Path) {
    let save = |name: &str, alpha: fn(u32) -> u8| {
        let texel = |x, y| image::Rgba([120, 90, 240, alpha(x + y)]);
        image::RgbaImage::from_fn(5, 4, texel).save(dir.join(name)).expect("writable");
    };
    save("full.png", |_| 255);
    save("holes.png", |at| if at % 2 == 0 { 255 } else { 0 });
}

fn compiled(dir: &Path, lines: &str) -> Pack<Checked> {
    let bytes = bytes(&compile_in(dir, &text(lines)));
    Pack::from_bytes(bytes).expect("what was written can be read")
}

fn pixels(pack: Pack<Checked>) -> Vec<[u64; 3]> {
    let outcome = picture::cpu(pack, |_| {});
    outcome.film().means().into_iter().map(|rgb| rgb.map(f64::to_bits)).collect()
}

/// Names of the features that the manifest says are kept, and of those left out.
fn told(pack: &Pack<Checked>) -> [Vec<String>; 2] {
    let manifest = pack.manifest().expect("readable");
    [manifest.features_kept, manifest.features_left_out]
        .map(|list| list.into_iter().map(|feature| feature.name).collect())
}

#[test]
fn a_value_that_does_nothing_leaves_no_code_and_changes_no_bit() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_images(dir.path());
    for case in CASES {
        let name = case.name;
        let [idle, without, busy] =
            [case.idle, case.without, case.busy].map(|lines| compiled(dir.path(), lines));
        assert!(idle.kernel() == without.kernel(), "{name}: another kernel than without it");
        assert_eq!(idle.features() & case.bits, 0, "{name}");
        assert_eq!(busy.features() & case.bits, case.bits, "{name}, where it counts");
        for word in case.words {
            assert!(!idle.kernel().contains(word), "{name}: `{word}` is in the kernel");
            assert!(busy.kernel().contains(word), "{name}: `{word}` is never in a kernel");
        }
        assert!(pixels(idle) == pixels(without), "{name}: another picture than without it");
    }
}

#[test]
fn what_is_not_read_has_no_section() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_images(dir.path());
    for case in CASES {
        let idle = compiled(dir.path(), case.idle);
        for kind in [Kind::MEDIUM, Kind::TEXTURE, Kind::TEXEL, Kind::SRGBLUT, Kind::OBJECT] {
            assert!(idle.section_bytes(kind).is_none(), "{}: {kind}", case.name);
        }
    }
}

/// The records that were left out, put back by hand: the CPU kernel, which has all code, then computes the
/// terms, and they change no bit.
#[test]
fn fog_of_density_0_and_clear_air_are_no_terms() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let plain = compile_in(dir.path(), &text(""));
    let pixels_of = |compiled: &compiler::pipeline::Compiled| {
        pixels(Pack::from_bytes(bytes(compiled)).expect("valid"))
    };
    let expected = pixels_of(&plain);
    let medium = pack::abi::Medium { color: [9.0; 3], reach: 7.0, ..Default::default() };
    for fog in [true, false] {
        let mut with = compile_in(dir.path(), &text(""));
        with.lowered.media = vec![medium];
        let index = if fog { &mut with.lowered.render.fog } else { &mut with.lowered.render.air };
        *index = 0;
        assert!(pixels_of(&with) == expected, "fog: {fog}");
        // The same record with some density does something.
        with.lowered.media[0].sigma_a = [0.5; 3];
        assert!(pixels_of(&with) != expected, "fog: {fog}");
    }
}

#[test]
fn the_stack_is_as_long_as_the_tree_needs() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    for lines in ["", "MORE dielectric { }\n"] {
        let pack = compiled(dir.path(), lines);
        let need = pack.render().stack_need.max(1);
        assert!(pack.kernel().contains(&format!("const STACK_SIZE: u32 = {need:#x}u;")));
    }
}

#[test]
fn the_manifest_tells_every_feature_once_and_as_the_pack_has_it() {
    let every: Vec<&str> = bit::NAMES.iter().map(|(_, name)| *name).collect();
    for case in tests::features::CASES {
        let pack = tests::features::case_pack(case);
        let [kept, left] = told(&pack);
        let mut all: Vec<&str> = kept.iter().chain(&left).map(String::as_str).collect();
        all.retain(|name| *name != "smooth normals");
        all.sort_by_key(|name| every.iter().position(|known| known == name));
        assert_eq!(all, every, "{}", case.name);
        let bits: Vec<&str> = bit::names(pack.features());
        let unsaid = kept.iter().filter(|name| *name != "smooth normals");
        assert!(unsaid.clone().all(|name| bits.contains(&name.as_str())), "{}", case.name);
        assert_eq!(unsaid.count(), bits.len(), "{}", case.name);
    }
}

#[test]
fn kept_features_name_a_declaration_and_its_line() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_images(dir.path());
    let lines = "medium mist: fog { density = 0.01/m, color = linear(9) }\nAIR mist\nMATERIAL coat.weight = 1\n";
    let pack = compiled(dir.path(), lines);
    let manifest = pack.manifest().expect("readable");
    let place = |name: &str| {
        let all = manifest.features_kept.iter().chain(&manifest.features_left_out);
        let feature = all.into_iter().find(|feature| feature.name == name)?;
        let by = feature.by.as_ref()?;
        Some(format!("{} {}", manifest.place(by)?, by.name))
    };
    let line_of = |start: &str| {
        1 + text(lines).lines().position(|line| line.starts_with(start)).expect("it is there")
    };
    for (feature, start, name) in [
        ("fog", "medium mist", "mist"),
        ("principled coat", "material m", "m"),
        ("principled", "material m", "m"),
        ("triangles", "instance crate", "crate"),
        ("sphere lights", "light bulb", "bulb"),
        ("constant sky", "sky day", "day"),
        ("lens", "camera eye", "eye"),
        ("several lights", "light bulb", "bulb"),
    ] {
        let expected = format!("test.rts:{} {name}", line_of(start));
        assert_eq!(place(feature).as_deref(), Some(expected.as_str()), "{feature}");
    }
    let kernel = manifest.kernel;
    assert_eq!(kernel.lines, pack::manifest::KernelSize::lines_of(pack.kernel()));
    let full = compiler::pipeline::full_kernel_size().expect("it links");
    assert!(kernel.words > 1000 && kernel.words < full.words / 2, "{kernel:?} of {full:?}");
}
