//! Layers ⇄ channels of an EXR and what describes them: names in two styles, Cryptomatte's ranks and manifests.
//!
//! Everything is 32-bit: positions, depths and numbers need it, and readers take numbers of Cryptomatte as bits.

use super::channel::{
    Channel, Source, channel, channel_name, combined, plane, residual_name, round,
};
use super::groups;
use super::survey::Survey;
use crate::film::Film;
use crate::layers::{
    Layer, LayerNames, Layers, Matte, MatteKind, Nearest, Wanted, id_of, manifest_text,
};
use std::collections::BTreeMap;

/// Each layer's name in Blender, and of each of its channels the ending there and the plain name. Layers that are not
/// here have channels of their own kind.
type Row = (Layer, &'static str, &'static [(&'static str, &'static str)]);
const ROWS: [Row; 8] = [
    (Layer::Albedo, "Denoising Albedo", &[("R", "albedo.R"), ("G", "albedo.G"), ("B", "albedo.B")]),
    (Layer::Normal, "Denoising Normal", &[("X", "N.X"), ("Y", "N.Y"), ("Z", "N.Z")]),
    (Layer::Depth, "Depth", &[("Z", DEPTH)]),
    (Layer::Position, "Position", &[("X", "P.X"), ("Y", "P.Y"), ("Z", "P.Z")]),
    (Layer::Uv, "UV", &[("U", "uv.U"), ("V", "uv.V"), ("A", "uv.A")]),
    (Layer::Object, "Object Index", &[("X", "object")]),
    (Layer::Instance, "Instance Index", &[("X", "instance")]),
    (Layer::Material, "Material Index", &[("X", "material")]),
];
/// The picture itself.
pub(super) const COLOURS: [&str; 3] = ["R", "G", "B"];
const ALPHA: &str = "A";
const DEPTH: &str = "Z";
/// What Blender writes where nothing is, metres.
const FAR: f32 = 1e10;
/// Pairs of names that a finished picture keeps, as others do.
const LEVELS: usize = 3;

/// `ViewLayer.CryptoObject`.
fn matte_name(names: LayerNames, kind: MatteKind) -> String {
    match names {
        LayerNames::Blender => format!("ViewLayer.{}", kind.layer()),
        LayerNames::Plain => kind.layer().to_owned(),
    }
}

/// Whether the layers want the channel that says where samples differ, which is a plain name.
pub(super) fn counts_samples(layers: &Layers) -> bool {
    layers.has(Layer::Samples) && layers.wanted.names == LayerNames::Plain
}

/// The channels of all layers of the picture `film`. `residual`: those that are means also hold what rounding them left
/// over, and mattes every name, so that parts can be added without loss.
pub(super) fn channels(
    layers: &Layers,
    residual: bool,
    film: &Film,
    survey: &Survey,
) -> Vec<Channel> {
    let names = layers.wanted.names;
    let mut channels = Vec::new();
    for (layer, stem, components) in ROWS.into_iter().filter(|row| layers.has(row.0)) {
        for (c, component) in components.iter().enumerate() {
            let values = values(layers, layer, c);
            let rounded: Vec<f32> = values.iter().map(|x| round(*x)).collect();
            if residual && !layer.is_nearest() {
                let rest = values.iter().zip(&rounded).map(|(x, r)| round(x - f64::from(*r)));
                channels.push(channel(&residual_name(component.1), rest.collect()));
            }
            channels.push(channel(&channel_name(names, stem, *component), rounded));
        }
    }
    if residual && !layers.nearest.is_empty() && !layers.has(Layer::Depth) {
        let depths = values(layers, Layer::Depth, 0).iter().map(|x| round(*x)).collect();
        channels.push(channel(&residual_name(DEPTH), depths));
    }
    if layers.has(Layer::Alpha) {
        let alpha = (0..layers.covered.len()).map(|i| round(layers.alpha(i))).collect();
        channels.push(channel(&combined(names, ALPHA), alpha));
    }
    if layers.has(Layer::Samples) && names == LayerNames::Blender {
        let counts = film.counts.iter().map(|n| round(f64::from(*n))).collect();
        channels.push(channel("ViewLayer.Debug Sample Count.X", counts));
    }
    channels.extend(groups::channels(layers, residual, film, survey));
    for (i, matte) in layers.mattes.iter().enumerate() {
        let levels = if residual { survey.names(i).div_ceil(2).max(LEVELS) } else { LEVELS };
        channels.extend(matte_channels(matte, levels, names, layers.samples));
    }
    channels
}

/// Channel `c` of a layer, pixel by pixel.
fn values(layers: &Layers, layer: Layer, c: usize) -> Vec<f64> {
    let n = f64::from(layers.samples.max(1));
    let means = |sums: &[[f64; 3]]| sums.iter().map(|sum| sum[c % 3] / n).collect();
    let each = |of: &dyn Fn(&Nearest) -> f32| {
        layers.nearest.iter().map(|nearest| f64::from(of(nearest))).collect()
    };
    // Exact below 2^24, which no list of names exceeds.
    let number = |k: usize| each(&|nearest| nearest.numbers[k] as f32);
    match layer {
        Layer::Albedo => means(&layers.albedo),
        Layer::Normal => means(&layers.normal),
        Layer::Depth => each(&|nearest| nearest.depth.min(FAR)),
        Layer::Position => each(&|nearest| nearest.position[c % 3]),
        Layer::Uv if c == 2 => each(&|nearest| if nearest.depth < FAR { 1.0 } else { 0.0 }),
        Layer::Uv => each(&|nearest| nearest.uv[c % 2]),
        Layer::Object => number(0),
        Layer::Instance => number(1),
        Layer::Material => number(2),
        Layer::Crypto | Layer::Variance | Layer::Samples | Layer::Lights | Layer::Alpha => {
            Vec::new()
        }
    }
}

/// Pairs of a number and its share, largest share first.
fn matte_channels(matte: &Matte, levels: usize, names: LayerNames, samples: u32) -> Vec<Channel> {
    let mut planes = vec![vec![0.0_f32; matte.shares.len()]; 4 * levels];
    for (i, shares) in matte.shares.iter().enumerate() {
        for (rank, (id, n)) in Matte::ranked(shares).into_iter().take(2 * levels).enumerate() {
            planes[2 * rank][i] = f32::from_bits(id);
            planes[2 * rank + 1][i] = round(f64::from(n) / f64::from(samples.max(1)));
        }
    }
    let stem = matte_name(names, matte.kind);
    let name = |k: usize| format!("{stem}{:02}.{}", k / 4, ["r", "g", "b", "a"][k % 4]);
    planes.into_iter().enumerate().map(|(k, plane)| channel(&name(k), plane)).collect()
}

/// Attributes: what Cryptomatte's readers need, and what `rtr merge` does.
pub(super) fn attributes(layers: &Layers) -> Vec<(String, String)> {
    let names = layers.wanted.names;
    let mut list = vec![
        ("layers".to_owned(), layers.wanted.text()),
        ("layer_names".to_owned(), names.name().to_owned()),
        ("layer_samples".to_owned(), layers.samples.to_string()),
    ];
    if layers.wanted.transparent {
        list.push(("transparent".to_owned(), "1".to_owned()));
    }
    list.extend(groups::attribute(layers));
    for matte in &layers.mattes {
        let name = matte_name(names, matte.kind);
        let of = |what: &str| matte_attribute(&name, what);
        list.extend([
            (of("hash"), "MurmurHash3_32".to_owned()),
            (of("conversion"), "uint32_to_float32".to_owned()),
            (of("manifest"), manifest_text(&matte.names)),
            (of("name"), name.clone()),
        ]);
    }
    list
}

fn matte_attribute(name: &str, what: &str) -> String {
    let key = format!("{:08x}", id_of(name));
    format!("cryptomatte/{}/{what}", &key[..7])
}

/// The style of a file's names, if it has layers.
pub(super) fn names_of(source: &dyn Source) -> Option<LayerNames> {
    LayerNames::of_name(&source.text("layer_names")?)
}

/// The layers of a file without their pixels, if it has any.
pub(super) fn head(source: &dyn Source) -> Result<Option<Layers>, String> {
    let Some(text) = source.text("layers") else { return Ok(None) };
    let known =
        |name: &str| Layer::of_name(name).ok_or_else(|| format!("layer `{name}` is unknown"));
    let parts = text.split(',').filter(|name| !name.is_empty());
    let wanted = Wanted {
        layers: parts.map(known).collect::<Result<_, _>>()?,
        transparent: source.text("transparent").is_some(),
        names: names_of(source).ok_or("`layer_names` is malformed")?,
    };
    let samples: Option<u32> = source.text("layer_samples").and_then(|text| text.parse().ok());
    let samples = samples.ok_or("`layer_samples` is malformed")?;
    let mut layers = Layers { wanted, samples, ..Layers::default() };
    if layers.has(Layer::Lights) {
        layers.lights = groups::head(source)?;
    }
    if layers.has(Layer::Crypto) {
        let mattes = MatteKind::ALL.into_iter().map(|kind| matte(source, &layers, kind));
        layers.mattes = mattes.collect::<Result<_, _>>()?;
    }
    Ok(Some(layers))
}

/// The layers of `head` with the `n` pixels of `source`, without the names of mattes.
pub(super) fn pixels(head: &Layers, source: &dyn Source, n: usize) -> Result<Layers, String> {
    let mut layers = Layers { wanted: head.wanted.clone(), ..Layers::default() };
    layers.samples = head.samples;
    if layers.has(Layer::Albedo) {
        layers.albedo = sums(source, &layers, Layer::Albedo, n)?;
    }
    if layers.has(Layer::Normal) {
        layers.normal = sums(source, &layers, Layer::Normal, n)?;
    }
    let lights = head.lights.iter().map(|group| groups::pixels(source, &layers, &group.name, n));
    layers.lights = lights.collect::<Result<_, _>>()?;
    if layers.has(Layer::Alpha) {
        let alpha = plane(source, &combined(layers.wanted.names, ALPHA), n)?;
        layers.covered = alpha.iter().map(|share| samples_of(*share, layers.samples)).collect();
    }
    if layers.wanted.layers.iter().any(|layer| layer.is_nearest()) {
        layers.nearest = nearest(source, &layers, n)?;
    }
    let mattes = head.mattes.iter().map(|matte| {
        let (kind, names) = (matte.kind, BTreeMap::new());
        Ok(Matte { kind, names, shares: shares(source, &layers, kind, n)? })
    });
    layers.mattes = mattes.collect::<Result<_, String>>()?;
    Ok(layers)
}

/// How many samples a share of them is.
#[expect(clippy::cast_possible_truncation, reason = "saturates on purpose")]
fn samples_of(share: f32, samples: u32) -> u32 {
    ((f64::from(share) * f64::from(samples)).round() as u32).min(samples)
}

fn row(layer: Layer) -> Result<Row, String> {
    let found = ROWS.into_iter().find(|row| row.0 == layer);
    found.ok_or_else(|| format!("layer `{}` has no channels", layer.name()))
}

fn sums(
    source: &dyn Source,
    layers: &Layers,
    layer: Layer,
    n: usize,
) -> Result<Vec<[f64; 3]>, String> {
    let (_, stem, components) = row(layer)?;
    let mut sums = vec![[0.0; 3]; n];
    for (c, component) in components.iter().enumerate() {
        let means = plane(source, &channel_name(layers.wanted.names, stem, *component), n)?;
        let rest = source.floats(&residual_name(component.1));
        for (i, (sum, mean)) in sums.iter_mut().zip(means).enumerate() {
            let rest = rest.and_then(|rest| rest.get(i)).copied().unwrap_or(0.0);
            sum[c % 3] = (f64::from(*mean) + f64::from(rest)) * f64::from(layers.samples);
        }
    }
    Ok(sums)
}

/// The nearest surfaces; which of two parts' is nearer is known by depth.
fn nearest(source: &dyn Source, layers: &Layers, n: usize) -> Result<Vec<Nearest>, String> {
    let mut pixels = vec![Nearest { depth: FAR, ..Nearest::NONE }; n];
    for (layer, stem, components) in ROWS.into_iter().filter(|row| layers.has(row.0)) {
        if !layer.is_nearest() {
            continue;
        }
        for (c, component) in components.iter().enumerate() {
            let values = plane(source, &channel_name(layers.wanted.names, stem, *component), n)?;
            for (pixel, value) in pixels.iter_mut().zip(values) {
                set(pixel, layer, c, *value);
            }
        }
    }
    if let Some(depths) = source.floats(&residual_name(DEPTH)) {
        for (pixel, depth) in pixels.iter_mut().zip(depths) {
            pixel.depth = *depth;
        }
    }
    Ok(pixels)
}

#[expect(clippy::cast_possible_truncation, reason = "saturates on purpose")]
fn set(pixel: &mut Nearest, layer: Layer, c: usize, value: f32) {
    match layer {
        Layer::Depth => pixel.depth = value,
        Layer::Position => pixel.position[c % 3] = value,
        Layer::Uv if c < 2 => pixel.uv[c] = value,
        Layer::Object => pixel.numbers[0] = value as u32,
        Layer::Instance => pixel.numbers[1] = value as u32,
        Layer::Material => pixel.numbers[2] = value as u32,
        _ => {}
    }
}

/// The names of a matte.
fn matte(source: &dyn Source, layers: &Layers, kind: MatteKind) -> Result<Matte, String> {
    let name = matte_name(layers.wanted.names, kind);
    let text = source.text(&matte_attribute(&name, "manifest")).unwrap_or_default();
    let listed: BTreeMap<String, String> = serde_json::from_str(&text)
        .map_err(|_| format!("the manifest of `{name}` is malformed"))?;
    let names = listed.into_keys().map(|name| (name.clone(), id_of(&name))).collect();
    Ok(Matte { kind, names, shares: Vec::new() })
}

/// Number and samples of every name in `n` pixels.
fn shares(
    source: &dyn Source,
    layers: &Layers,
    kind: MatteKind,
    n: usize,
) -> Result<Vec<Vec<(u32, u32)>>, String> {
    let name = matte_name(layers.wanted.names, kind);
    let mut shares: Vec<Vec<(u32, u32)>> = vec![Vec::new(); n];
    for pair in ["r", "b"].into_iter().cycle().enumerate() {
        let (level, first) = (pair.0 / 2, pair.1);
        let second = if first == "r" { "g" } else { "a" };
        let Some(ids) = source.floats(&format!("{name}{level:02}.{first}")) else { break };
        let parts = plane(source, &format!("{name}{level:02}.{second}"), n)?;
        for ((shares, id), part) in shares.iter_mut().zip(ids).zip(parts) {
            let samples = samples_of(*part, layers.samples);
            if samples > 0 {
                shares.push((id.to_bits(), samples));
            }
        }
    }
    Ok(shares)
}
