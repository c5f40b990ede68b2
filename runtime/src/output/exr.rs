//! Film ⇄ EXR: linear `f32` means, exact enough to go on adding, with all that is known about them.
//!
//! Channels `R`, `G`, `B` hold the mean radiance; where that is denoised, `noisy.R` and so on hold it, and the attribute
//! `denoiser` says so. `residual.R` and so on, where present, hold what
//! rounding the `f64` mean to `f32` left over, so that mean + residual is good to about 2^-48.
//! `variance.Y` is the variance of the mean luminance, in pictures that are the mean of replicates.
//! `samples` is there where pixels have different numbers of samples.

use super::channel::{Source, combined, noisy};
use super::picture::{
    Meta, OutputError, Picture, clamp_text, parse_clamp, parse_ranges, ranges_text,
};
use super::planes::{self, COLOURS};
use crate::film::{BadSample, Counters, Film};
use crate::layers::{LayerNames, Layers};
use crate::region::{Rect, SampleRange};
use ::exr::meta::MetaData;
use ::exr::prelude::attribute::Chromaticities;
use ::exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, IntegerBounds, Layer,
    LayerAttributes, ReadChannels as _, ReadLayers as _, Text, Vec2, WritableImage as _,
};
use std::io::{BufReader, Cursor};
use std::path::Path;

const RESIDUALS: [&str; 3] = ["residual.R", "residual.G", "residual.B"];
const SAMPLES: &str = "samples";
const VARIANCE: &str = "variance.Y";
/// Attribute of pictures that are denoised.
const DENOISER: &str = "denoiser";

/// Bytes that one byte can stand for: deflate stores at most 1032, the other lossless compressions less.
const MOST_DEFLATED: u64 = 1032;

/// Chromaticities of Rec. 709 with white D65: red, green, blue, white.
const REC_709: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];

/// The film as it is: linear, no exposure, no tone curve; `residual` as for `encode`.
pub fn encode_exr(picture: &Picture, residual: bool) -> Result<Vec<u8>, OutputError> {
    let film = &picture.film;
    let means = film.means();
    let layers = picture.layers.as_ref();
    let style = layers.map_or(LayerNames::Plain, |layers| layers.wanted.names);
    let named = |name: fn(LayerNames, &str) -> String, values: &[[f64; 3]]| {
        let names = COLOURS.map(|component| name(style, component));
        names.into_iter().zip(colours(values, round)).map(|(n, p)| channel(&n, p))
    };
    let mut channels: Vec<_> = named(combined, &picture.shown()).collect();
    if picture.denoised.is_some() {
        channels.extend(named(noisy, &means));
    }
    if residual {
        let rest = colours(&means, |x| {
            let rest = round(x - f64::from(round(x)));
            if rest.is_finite() { rest } else { 0.0 }
        });
        channels.extend(RESIDUALS.iter().zip(rest).map(|(n, p)| channel(n, p)));
    }
    if !film.variance.is_empty() {
        channels.push(channel(VARIANCE, film.variance.iter().map(|v| round(*v)).collect()));
    }
    if let Some(layers) = layers {
        channels.extend(planes::channels(layers, residual, film));
    }
    if !film.is_even() || layers.is_some_and(planes::counts_samples) {
        channels.push(AnyChannel::new(SAMPLES, FlatSamples::U32(film.counts.clone())));
    }
    let mut attributes = LayerAttributes {
        layer_position: Vec2(signed(film.region.x), signed(film.region.y)),
        software_name: Some(Text::from(concat!("rtr ", env!("CARGO_PKG_VERSION")))),
        ..LayerAttributes::default()
    };
    attributes.other.extend(attributes_of(picture));
    let texts = layers.map(planes::attributes).unwrap_or_default();
    attributes.other.extend(texts.into_iter().map(|(name, value)| {
        let text = |s: &str| Text::new_or_none(s).unwrap_or_default();
        (text(&name), AttributeValue::Text(text(&value)))
    }));
    let size = (film.region.w as usize, film.region.h as usize);
    let layer = Layer::new(
        size,
        attributes,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut image = Image::from_layer(layer);
    let [w, h] = film.image_size;
    image.attributes.display_window = IntegerBounds::new(Vec2(0, 0), Vec2(w as usize, h as usize));
    let [red, green, blue, white] = REC_709.map(|[x, y]| Vec2(x, y));
    image.attributes.chromaticities = Some(Chromaticities { red, green, blue, white });
    let mut file = Cursor::new(Vec::new());
    let written = image.write().to_buffered(&mut file);
    written.map_err(|error| OutputError::Encode { message: error.to_string() })?;
    Ok(file.into_inner())
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
fn round(x: f64) -> f32 {
    x as f32
}

fn signed(x: u32) -> i32 {
    i32::try_from(x).unwrap_or(i32::MAX)
}

fn colours(means: &[[f64; 3]], f: impl Fn(f64) -> f32) -> [Vec<f32>; 3] {
    [0, 1, 2].map(|c| means.iter().map(|rgb| f(rgb[c])).collect())
}

fn channel(name: &str, values: Vec<f32>) -> AnyChannel<FlatSamples> {
    AnyChannel::new(name, FlatSamples::F32(values))
}

fn attributes_of(picture: &Picture) -> Vec<(Text, AttributeValue)> {
    let Picture { film, meta, .. } = picture;
    let text = |s: &str| AttributeValue::Text(Text::new_or_none(s).unwrap_or_default());
    let number = |n: u64| text(&n.to_string());
    let Counters { rays, bad, first_bad, depth, overflows, leaks, removed } = film.counters;
    let mut list = vec![
        ("render_id", text(&meta.render_id)),
        ("spp", AttributeValue::I32(signed(film.samples().1))),
        ("sample_ranges", text(&ranges_text(&film.ranges))),
        ("seed", number(u64::from(meta.seed))),
        ("estimator", number(u64::from(meta.estimator))),
        ("precision", text(&meta.precision)),
        ("device", text(&meta.device)),
        ("seconds", AttributeValue::F64(meta.seconds)),
        ("exposure_stops", AttributeValue::F32(meta.exposure)),
        ("tone_map", number(u64::from(meta.tone_map))),
        ("complete", number(u64::from(meta.complete))),
        ("rays", number(rays)),
        ("longest_path", number(u64::from(depth))),
        ("bad_samples", number(bad)),
        ("media_overflows", number(overflows)),
        ("media_leaks", number(leaks)),
    ];
    if let Some(first) = first_bad {
        list.push(("first_bad_sample", text(&first.to_string())));
    }
    if let Some(denoised) = &picture.denoised {
        list.push((DENOISER, text(&denoised.by)));
    }
    if meta.adaptive {
        list.push(("adaptive", text("1")));
    }
    if let Some(block) = meta.coarse_block {
        list.push(("coarse_block", number(u64::from(block))));
    }
    // Only where it is on: a picture without it is what it always was.
    if meta.clamp_indirect.is_some() {
        list.push(("clamp_indirect", text(&clamp_text(meta.clamp_indirect))));
        list.push(("clamp_indirect_removed", AttributeValue::F64(removed)));
        list.push(("clamp_indirect_removed_share", AttributeValue::F64(film.removed())));
    }
    list.into_iter().map(|(name, value)| (Text::from(name), value)).collect()
}

/// Reads what `encode_exr` made; of what is denoised, the noisy picture.
pub fn read_exr(path: &Path) -> Result<Picture, OutputError> {
    check_claims(path)?;
    let file = files::open_regular(path).map_err(OutputError::Open)?;
    let image = ::exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_unbuffered(file)
        .map_err(|error| OutputError::Read { path: path.to_owned(), message: error.to_string() })?;
    let foreign = |message: String| OutputError::Foreign { path: path.to_owned(), message };
    let fields = Fields { layer: &image.layer_data.attributes };
    let (film, meta, layers) = parse(&image, &fields).map_err(foreign)?;
    Ok(Picture { layers, ..Picture::new(film, meta) })
}

/// Before memory is taken: whether the file can hold the pixels that it claims, and holds them without loss. Sums are
/// to be gone on with, and decoders of what is lossy are the ones that damaged files confuse.
fn check_claims(path: &Path) -> Result<(), OutputError> {
    let read = |message: String| OutputError::Read { path: path.to_owned(), message };
    let foreign = |message: String| OutputError::Foreign { path: path.to_owned(), message };
    let file = files::open_regular(path).map_err(OutputError::Open)?;
    let length = file.metadata().map_err(|error| read(error.to_string()))?.len();
    let meta = MetaData::read_from_buffered(BufReader::new(file), false)
        .map_err(|error| read(error.to_string()))?;
    for header in &meta.headers {
        if header.compression.may_loose_data() {
            return Err(foreign(format!("it is compressed with loss ({})", header.compression)));
        }
        let [width, height] = [header.layer_size.x(), header.layer_size.y()];
        let bytes = [height, header.channels.bytes_per_pixel]
            .iter()
            .fold(width as u64, |product, factor| product.saturating_mul(*factor as u64));
        if bytes / MOST_DEFLATED > length {
            return Err(read(format!(
                "it claims {width}x{height} pixels, more than its {length} bytes can hold"
            )));
        }
    }
    Ok(())
}

type ReadImage = Image<Layer<AnyChannels<FlatSamples>>>;

/// What a file holds.
type Parsed = (Film, Meta, Option<Layers>);

fn parse(image: &ReadImage, fields: &Fields<'_>) -> Result<Parsed, String> {
    let meta = Meta {
        render_id: fields.text("render_id")?,
        seed: fields.number("seed")?,
        estimator: fields.number("estimator")?,
        clamp_indirect: match fields.text("clamp_indirect") {
            Ok(text) => parse_clamp(&text)?,
            Err(_) => None,
        },
        adaptive: fields.number::<u32>("adaptive").is_ok_and(|n| n == 1),
        precision: fields.text("precision")?,
        device: fields.text("device")?,
        seconds: fields.float("seconds")?,
        exposure: round(fields.float("exposure_stops")?),
        tone_map: fields.number("tone_map")?,
        complete: fields.number::<u32>("complete")? == 1,
        coarse_block: fields.number("coarse_block").ok(),
    };
    let ranges =
        parse_ranges(&fields.text("sample_ranges")?).ok_or("`sample_ranges` is malformed")?;
    let counters = Counters {
        rays: fields.number("rays")?,
        bad: fields.number("bad_samples")?,
        first_bad: fields.text("first_bad_sample").ok().and_then(|text| parse_bad(&text)),
        depth: fields.number("longest_path")?,
        overflows: fields.number("media_overflows")?,
        leaks: fields.number("media_leaks")?,
        removed: fields.float("clamp_indirect_removed").unwrap_or(0.0),
    };
    let source = Read { image, fields };
    let names = planes::names_of(&source).unwrap_or(LayerNames::Plain);
    let name = if fields.text(DENOISER).is_ok() { noisy } else { combined };
    let film = parse_film(image, &COLOURS.map(|colour| name(names, colour)), ranges, counters)?;
    let layers = planes::parse(&source, film.sums.len())?;
    Ok((film, meta, layers))
}

/// Channels and texts of a file.
struct Read<'a> {
    image: &'a ReadImage,
    fields: &'a Fields<'a>,
}

impl Source for Read<'_> {
    fn floats(&self, channel: &str) -> Option<&[f32]> {
        let list = &self.image.layer_data.channel_data.list;
        match list.iter().find(|c| c.name.eq(channel)).map(|c| &c.sample_data) {
            Some(FlatSamples::F32(values)) => Some(values),
            _ => None,
        }
    }

    fn text(&self, attribute: &str) -> Option<String> {
        self.fields.text(attribute).ok()
    }
}

fn parse_film(
    image: &ReadImage,
    colours: &[String; 3],
    ranges: Vec<SampleRange>,
    counters: Counters,
) -> Result<Film, String> {
    let layer = &image.layer_data;
    let unsigned = |n: i32| u32::try_from(n).map_err(|_| "a window is out of range".to_owned());
    let length = |n: usize| u32::try_from(n).map_err(|_| "a window is out of range".to_owned());
    let window = image.attributes.display_window.size;
    let image_size = [length(window.x())?, length(window.y())?];
    let position = layer.attributes.layer_position;
    let region = Rect {
        x: unsigned(position.x())?,
        y: unsigned(position.y())?,
        w: length(layer.size.x())?,
        h: length(layer.size.y())?,
    };
    if !region.fits(image_size) {
        return Err("the data window lies outside the display window".to_owned());
    }
    let film = Film::try_new(image_size, region).map_err(|error| error.to_string())?;
    let mut film = Film { ranges, counters, ..film };
    let find = |name: &str| layer.channel_data.list.iter().find(|c| c.name.eq(name));
    if let Some(FlatSamples::F32(variance)) = find(VARIANCE).map(|channel| &channel.sample_data) {
        film.variance = variance.iter().map(|v| f64::from(*v)).collect();
    }
    let replicates = film.replicates();
    match find(SAMPLES).map(|channel| &channel.sample_data) {
        Some(FlatSamples::U32(counts)) => film.counts.clone_from(counts),
        Some(_) => return Err(format!("channel `{SAMPLES}` is not of whole numbers")),
        None => {
            let count: u32 = film.ranges.iter().map(|range| range.count()).sum();
            film.counts.fill(count.saturating_mul(replicates));
        }
    }
    for (c, (colour, residual)) in colours.iter().zip(RESIDUALS).enumerate() {
        let Some(FlatSamples::F32(mean)) = find(colour).map(|channel| &channel.sample_data) else {
            return Err(format!("channel `{colour}` of 32-bit floats is missing"));
        };
        for (i, mean) in mean.iter().enumerate() {
            film.sums[i][c] = f64::from(*mean);
        }
        if let Some(FlatSamples::F32(rest)) = find(residual).map(|channel| &channel.sample_data) {
            for (i, rest) in rest.iter().enumerate() {
                film.sums[i][c] += f64::from(*rest);
            }
        }
    }
    for (sum, count) in film.sums.iter_mut().zip(&film.counts) {
        *sum = sum.map(|mean| mean * f64::from(*count));
    }
    Ok(film)
}

/// The inverse of `BadSample`'s text.
pub(crate) fn parse_bad(text: &str) -> Option<BadSample> {
    let mut numbers = text.split(',').map(|part| part.parse().ok());
    let mut next = || numbers.next().flatten();
    Some(BadSample { x: next()?, y: next()?, sample: next()? })
}

/// Attributes by name.
struct Fields<'a> {
    layer: &'a LayerAttributes,
}

impl Fields<'_> {
    fn get(&self, name: &str) -> Result<&AttributeValue, String> {
        let name = Text::from(name);
        self.layer.other.get(&name).ok_or_else(|| format!("attribute `{name}` is missing"))
    }

    fn text(&self, name: &str) -> Result<String, String> {
        match self.get(name)? {
            AttributeValue::Text(text) => Ok(text.to_string()),
            _ => Err(format!("attribute `{name}` is not a text")),
        }
    }

    fn number<T: std::str::FromStr>(&self, name: &str) -> Result<T, String> {
        self.text(name)?.parse().map_err(|_| format!("attribute `{name}` is not a number"))
    }

    fn float(&self, name: &str) -> Result<f64, String> {
        match self.get(name)? {
            AttributeValue::F64(x) => Ok(*x),
            AttributeValue::F32(x) => Ok(f64::from(*x)),
            _ => Err(format!("attribute `{name}` is not a number")),
        }
    }
}
