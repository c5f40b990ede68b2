//! Layers: what they hold of a known scene, how an EXR names them, and that the picture stays what it is.

#![expect(clippy::float_cmp, reason = "numbers, counts and shares of few samples are exact")]

use clap::ValueEnum as _;
use runtime::layers::{Layer, LayerNames, Wanted};
use runtime::output::{self, encode_png, encode_png16, merge, read_exr};
use runtime::{Outcome, SampleRange};
use std::collections::BTreeMap;
use tests::exr_file::File;
use tests::picture;

/// A red cube, a mirror that shows a green wall beside the picture, nothing behind them.
const THINGS: &str = "material red: diffuse { color = linear(0.8, 0.1, 0.1) }
material green: diffuse { color = linear(0.1, 0.8, 0.1) }
material mirror: metal { color = linear(0.5) }
instance Cube { shape = box(size: (1, 1, 1)m), material = red, at = (-1.2, 0, 0)m }
instance pane { shape = rectangle(size: (1.6, 1.6)m), material = mirror, rotate = (90, 45, 0)deg, at = (1.2, 0, 0)m }
instance wall { shape = rectangle(size: (8, 8)m), material = green, rotate = (0, 0, 90)deg, at = (9, 0, 0)m }
light bulb: sphere { center = (0, 9, 9)m, radius = 30cm, strength = 200 }
";
const SKY: &str = "sky day: constant { color = linear(0.6, 0.8, 1.0) }\n";
const SIZE: usize = 48;

fn scene(things: &str) -> pack::Pack<pack::Checked> {
    tests::scene::pack(&format!(
        "rts 1\n{things}camera eye: perspective {{ from = (0, 0, 5)m, to = (0, 0, 0)m, fov.vertical = 42deg }}
film small {{ size = ({SIZE}, {SIZE})px }}
render main: path {{ camera = eye, film = small, samples = 32, depth = 6, seed = 7 }}\n"
    ))
}

const ALL: [Layer; 12] = [
    Layer::Albedo,
    Layer::Normal,
    Layer::Depth,
    Layer::Position,
    Layer::Uv,
    Layer::Object,
    Layer::Instance,
    Layer::Material,
    Layer::Crypto,
    Layer::Samples,
    Layer::Lights,
    Layer::Alpha,
];

fn render(things: &str, wanted: &Wanted, samples: SampleRange) -> Outcome {
    picture::cpu(scene(things), |job| {
        job.wanted = wanted.clone();
        job.samples = samples;
    })
}

fn range(start: u32, end: u32) -> SampleRange {
    SampleRange::new(start, end).expect("a range")
}

fn wanted(layers: &[Layer], names: LayerNames) -> Wanted {
    Wanted { layers: layers.iter().copied().collect(), transparent: false, names }
}

/// Some channels of one name at a pixel.
fn pixel<const N: usize>(file: &File, stem: &str, ends: [&str; N], [x, y]: [usize; 2]) -> [f32; N] {
    ends.map(|end| file.channels[&format!("{stem}{end}")][y * SIZE + x])
}

/// Where the cube, the mirror and nothing are.
const CUBE: [usize; 2] = [9, 24];
const PANE: [usize; 2] = [38, 24];
const NOTHING: [usize; 2] = [24, 2];

fn near<const N: usize>(found: [f32; N], expected: [f32; N], tolerance: f32) {
    let close = found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance);
    assert!(close, "{found:?} instead of {expected:?}");
}

#[test]
fn layers_hold_what_the_scene_says() {
    let outcome = render(THINGS, &wanted(&ALL, LayerNames::Blender), range(0, 32));
    let file = File::written(&outcome.picture, false);
    let layer = |name: &str| format!("ViewLayer.{name}.");
    let (rgb, xyz) = (["R", "G", "B"], ["X", "Y", "Z"]);
    // Denoisers look into the mirror, which keeps half of the light.
    near(pixel(&file, &layer("Denoising Albedo"), rgb, CUBE), [0.8, 0.1, 0.1], 1e-6);
    near(pixel(&file, &layer("Denoising Albedo"), rgb, PANE), [0.05, 0.4, 0.05], 1e-6);
    near(pixel(&file, &layer("Denoising Albedo"), rgb, NOTHING), [0.0; 3], 0.0);
    near(pixel(&file, &layer("Denoising Normal"), xyz, CUBE), [0.0, 0.0, 1.0], 1e-6);
    near(pixel(&file, &layer("Denoising Normal"), xyz, PANE), [-1.0, 0.0, 0.0], 1e-6);
    // The others are of what the camera ray meets.
    near(pixel(&file, &layer("Depth"), ["Z"], CUBE), [4.5], 1e-5);
    near(pixel(&file, &layer("Depth"), ["Z"], NOTHING), [1e10], 0.0);
    let [_, _, z] = pixel(&file, &layer("Position"), xyz, CUBE);
    near([z], [0.5], 1e-5);
    let [x, y, z] = pixel(&file, &layer("Position"), xyz, PANE);
    near([x + z, pixel(&file, &layer("Depth"), ["Z"], PANE)[0]], [1.2, 5.0 - z], 1e-5);
    assert!(y.abs() < 0.2);
    assert_eq!(pixel(&file, &layer("UV"), ["A"], PANE), [1.0]);
    for (name, numbers) in [
        ("Object Index", [1.0, 2.0, 0.0]),
        ("Instance Index", [1.0, 2.0, 0.0]),
        // Materials are numbered as they are used.
        ("Material Index", [1.0, 2.0, 0.0]),
    ] {
        let found = [CUBE, PANE, NOTHING].map(|at| pixel(&file, &layer(name), ["X"], at)[0]);
        assert_eq!(found, numbers, "{name}");
    }
    assert_eq!(pixel(&file, &layer("Debug Sample Count"), ["X"], PANE), [32.0]);
    let alpha = |place| pixel(&file, &layer("Combined"), ["A"], place);
    assert_eq!([CUBE, PANE, NOTHING].map(alpha), [[1.0], [1.0], [0.0]]);
}

#[test]
fn a_scene_may_ask_for_every_layer() {
    let names: Vec<&str> = Layer::value_variants().iter().map(|layer| layer.name()).collect();
    let fields = lang::schema::types_of(lang::schema::Kind::Render).iter().flat_map(|ty| ty.fields);
    let words = fields.filter_map(|field| match field.ty {
        lang::schema::FieldType::Words(words) => Some(words),
        _ => None,
    });
    let words: Vec<&str> = words.flatten().map(|(word, _)| *word).collect();
    assert_eq!(words, names);
    let text = format!(
        "rts 1
{THINGS}camera eye: perspective {{ from = (0, 0, 5)m, to = (0, 0, 0)m }}
render main: path {{ camera = eye, layers = [{}] }}
",
        names.join(", ")
    );
    let manifest = tests::scene::pack(&text).manifest().expect("a manifest");
    assert_eq!(manifest.layers, names);
}

#[test]
fn names_are_those_of_blender_or_plain() {
    let layers = [Layer::Albedo, Layer::Normal, Layer::Depth, Layer::Alpha];
    for (names, expected) in [
        (
            LayerNames::Blender,
            "ViewLayer.Combined.A ViewLayer.Combined.B ViewLayer.Combined.G ViewLayer.Combined.R \
             ViewLayer.Denoising Albedo.B ViewLayer.Denoising Albedo.G ViewLayer.Denoising Albedo.R \
             ViewLayer.Denoising Normal.X ViewLayer.Denoising Normal.Y ViewLayer.Denoising Normal.Z \
             ViewLayer.Depth.Z",
        ),
        (LayerNames::Plain, "A B G N.X N.Y N.Z R Z albedo.B albedo.G albedo.R"),
    ] {
        let outcome = render(THINGS, &wanted(&layers, names), range(0, 4));
        let file = File::written(&outcome.picture, false);
        let found: Vec<&str> = file.channels.keys().map(String::as_str).collect();
        assert_eq!(found.join(" "), expected);
    }
}

#[test]
fn layers_leave_the_picture_alone() {
    let plain = render(THINGS, &Wanted::default(), range(0, 32));
    let layered = render(THINGS, &wanted(&ALL, LayerNames::Plain), range(0, 32));
    assert_eq!(plain.picture.film, layered.picture.film);
    assert!(plain.picture.layers.is_none());
    let names = File::written(&plain.picture, false).channels.into_keys().collect::<Vec<_>>();
    assert_eq!(names, ["B", "G", "R"]);
}

#[test]
fn coverage_adds_up_to_alpha_and_the_manifest_leads_back() {
    let outcome =
        render(THINGS, &wanted(&[Layer::Crypto, Layer::Alpha], LayerNames::Blender), range(0, 32));
    let file = File::written(&outcome.picture, false);
    for (kind, name) in [("Object", "Cube"), ("Instance", "Cube"), ("Material", "red")] {
        let layer = format!("ViewLayer.Crypto{kind}");
        let id = runtime::layers::id_of(name);
        let text = |what: &str| {
            let key = format!("{:08x}", runtime::layers::id_of(&layer));
            &file.texts[&format!("cryptomatte/{}/{what}", &key[..7])]
        };
        assert_eq!(text("name"), &layer);
        assert_eq!(
            (text("hash").as_str(), text("conversion").as_str()),
            ("MurmurHash3_32", "uint32_to_float32")
        );
        let manifest: BTreeMap<String, String> =
            serde_json::from_str(text("manifest")).expect("JSON");
        assert_eq!(manifest[name], format!("{id:08x}"));
        let [first, share] = pixel(&file, &format!("{layer}00."), ["r", "g"], CUBE);
        assert_eq!((first.to_bits(), share), (id, 1.0));
        let mut edges = 0;
        for i in 0..SIZE * SIZE {
            let at = [i % SIZE, i / SIZE];
            let shares: f32 = (0..3)
                .flat_map(|level| pixel(&file, &format!("{layer}{level:02}."), ["g", "a"], at))
                .sum();
            let [alpha] = pixel(&file, "ViewLayer.Combined.", ["A"], at);
            near([shares], [alpha], 1e-6);
            edges += u32::from(alpha > 0.0 && alpha < 1.0);
        }
        assert!(edges > 50, "{edges} pixels at edges");
    }
    assert_eq!(format!("{:08x}", runtime::layers::id_of("Cube")), "a8fce865");
}

#[test]
fn parts_add_up_to_the_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    for names in [LayerNames::Blender, LayerNames::Plain] {
        let wanted = wanted(&ALL, names);
        let part = |name: &str, samples| {
            let path = folder.path().join(name);
            let outcome = render(THINGS, &wanted, samples);
            output::write(&path, &outcome.picture, true).expect("it can be written");
            read_exr(&path).expect("it can be read")
        };
        let [a, b] = [("a.exr", range(0, 16)), ("b.exr", range(16, 32))].map(|(n, s)| part(n, s));
        let merged = merge(vec![b, a]).expect("they are parts");
        let whole = render(THINGS, &wanted, range(0, 32)).picture;
        let (merged, whole) = (File::written(&merged, false), File::written(&whole, false));
        assert_eq!(merged.channels.len(), whole.channels.len());
        for (name, values) in &whole.channels {
            let bits = |values: &[f32]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert!(bits(values) == bits(&merged.channels[name]), "{name} differs");
        }
        let crypto = |file: &File| {
            file.texts
                .iter()
                .filter(|(n, _)| n.starts_with("crypto"))
                .map(|(_, t)| t.clone())
                .collect::<Vec<_>>()
        };
        assert_eq!(crypto(&merged), crypto(&whole));
    }
    let plain = render(THINGS, &Wanted::default(), range(0, 16)).picture;
    let layered =
        render(THINGS, &wanted(&[Layer::Depth], LayerNames::Plain), range(16, 32)).picture;
    let error = merge(vec![plain, layered]).expect_err("the second has layers").to_string();
    assert!(error.contains("layers is depth (plain), but part 1 has none"), "{error}");
}

#[test]
fn a_transparent_picture_has_no_sky_and_a_png_with_alpha() {
    let things = format!("{SKY}{THINGS}");
    let transparent =
        |transparent| Wanted { transparent, ..wanted(&[Layer::Alpha], LayerNames::Plain) };
    let with_sky = render(&things, &transparent(false), range(0, 32)).picture;
    let without = render(&things, &transparent(true), range(0, 32)).picture;
    let (opaque, clear) = (File::written(&with_sky, false), File::written(&without, false));
    assert!(opaque.channels["A"].iter().all(|alpha| *alpha == 1.0));
    near(pixel(&opaque, "", ["R", "G", "B"], NOTHING), [0.6, 0.8, 1.0], 1e-6);
    near(pixel(&clear, "", ["R", "G", "B", "A"], NOTHING), [0.0; 4], 0.0);
    // Over the sky again it is the picture.
    for (c, sky) in [("R", 0.6), ("G", 0.8), ("B", 1.0)] {
        for (i, over) in opaque.channels[c].iter().enumerate() {
            let again = clear.channels[c][i] + (1.0 - clear.channels["A"][i]) * sky;
            near([again], [*over], 1e-5);
        }
    }
    let png = encode_png(&without).expect("a PNG");
    let png = image::load_from_memory(&png).expect("a PNG").into_rgba8();
    let alpha = |[x, y]: [usize; 2]| png.as_raw()[4 * (y * SIZE + x) + 3];
    assert_eq!([CUBE, PANE, NOTHING].map(alpha), [255, 255, 0]);
    assert!(png.pixels().any(|pixel| (1..255).contains(&pixel.0[3])));
    let fine = image::load_from_memory(&encode_png16(&without).expect("a PNG")).expect("a PNG");
    let image::DynamicImage::ImageRgba16(fine) = fine else { panic!("no 16 bits with alpha") };
    for (fine, coarse) in fine.pixels().zip(png.pixels()) {
        let close = |(a, b): (&u16, &u8)| (f64::from(*a) / 257.0 - f64::from(*b)).abs() <= 0.502;
        assert!(fine.0.iter().zip(&coarse.0).all(close), "{fine:?} {coarse:?}");
    }
}
