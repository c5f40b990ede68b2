//! What is known of a picture ⇄ the header of its file.

use super::names::DENOISER;
use crate::film::{BadSample, Counters, Film};
use crate::output::picture::{Meta, Picture, clamp_text, parse_clamp, parse_ranges, ranges_text};
use crate::output::planes;
use crate::output::survey::Survey;
use crate::region::Rect;
use ::exr::image::write::layers::WritableLayers as _;
use ::exr::meta::Headers;
use ::exr::meta::header::{Header, ImageAttributes};
use ::exr::prelude::attribute::Chromaticities;
use ::exr::prelude::{
    AnyChannels, AttributeValue, Encoding, FlatSamples, IntegerBounds, Layer, LayerAttributes,
    Text, Vec2,
};

/// Chromaticities of Rec. 709 with white D65: red, green, blue, white.
const REC_709: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];

/// The header of the file of a picture without its pixels, with channels like these.
pub(super) fn headers(
    head: &Picture,
    survey: &Survey,
    channels: AnyChannels<FlatSamples>,
) -> Headers {
    let film = &head.film;
    let mut attributes = LayerAttributes {
        layer_position: Vec2(signed(film.region.x), signed(film.region.y)),
        software_name: Some(Text::from(concat!("rtr ", env!("CARGO_PKG_VERSION")))),
        ..LayerAttributes::default()
    };
    attributes.other.extend(attributes_of(head, survey));
    let texts = head.layers.as_ref().map(planes::attributes).unwrap_or_default();
    attributes.other.extend(texts.into_iter().map(|(name, value)| {
        let text = |s: &str| Text::new_or_none(s).unwrap_or_default();
        (text(&name), AttributeValue::Text(text(&value)))
    }));
    let size = (film.region.w as usize, film.region.h as usize);
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
    let [w, h] = film.image_size;
    let mut image =
        ImageAttributes::new(IntegerBounds::new(Vec2(0, 0), Vec2(w as usize, h as usize)));
    let [red, green, blue, white] = REC_709.map(|[x, y]| Vec2(x, y));
    image.chromaticities = Some(Chromaticities { red, green, blue, white });
    layer.infer_headers(&image)
}

fn signed(x: u32) -> i32 {
    i32::try_from(x).unwrap_or(i32::MAX)
}

fn attributes_of(head: &Picture, survey: &Survey) -> Vec<(Text, AttributeValue)> {
    let Picture { film, meta, .. } = head;
    let text = |s: &str| AttributeValue::Text(Text::new_or_none(s).unwrap_or_default());
    let number = |n: u64| text(&n.to_string());
    let Counters { rays, bad, first_bad, depth, overflows, leaks, removed } = film.counters;
    let mut list = vec![
        ("render_id", text(&meta.render_id)),
        ("spp", AttributeValue::I32(signed(survey.most_samples()))),
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
    if let Some(denoised) = &head.denoised {
        list.push((DENOISER, text(&denoised.by)));
    }
    if !meta.commit.is_empty() {
        list.push(("commit", text(&meta.commit)));
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
        list.push(("clamp_indirect_removed_share", AttributeValue::F64(survey.removed(film))));
    }
    list.into_iter().map(|(name, value)| (Text::from(name), value)).collect()
}

/// The picture of a header, without its pixels and layers.
pub(super) fn parse(header: &Header) -> Result<Picture, String> {
    let fields = Fields { header };
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
        commit: fields.text("commit").unwrap_or_default(),
        seconds: fields.float("seconds")?,
        exposure: single(fields.float("exposure_stops")?),
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
    let (image_size, region) = windows(header)?;
    let film = Film { ranges, counters, ..Film::without_pixels(image_size, region) };
    Ok(Picture::new(film, meta))
}

#[expect(clippy::cast_possible_truncation, reason = "it was written from an f32")]
fn single(x: f64) -> f32 {
    x as f32
}

/// Size of the image, and the part of it that is here.
fn windows(header: &Header) -> Result<([u32; 2], Rect), String> {
    let unsigned = |n: i32| u32::try_from(n).map_err(|_| "a window is out of range".to_owned());
    let length = |n: usize| u32::try_from(n).map_err(|_| "a window is out of range".to_owned());
    let window = header.shared_attributes.display_window.size;
    let image_size = [length(window.x())?, length(window.y())?];
    let position = header.own_attributes.layer_position;
    let region = Rect {
        x: unsigned(position.x())?,
        y: unsigned(position.y())?,
        w: length(header.layer_size.x())?,
        h: length(header.layer_size.y())?,
    };
    if !region.fits(image_size) {
        return Err("the data window lies outside the display window".to_owned());
    }
    Ok((image_size, region))
}

/// The inverse of `BadSample`'s text.
pub(crate) fn parse_bad(text: &str) -> Option<BadSample> {
    let mut numbers = text.split(',').map(|part| part.parse().ok());
    let mut next = || numbers.next().flatten();
    Some(BadSample { x: next()?, y: next()?, sample: next()? })
}

/// Attributes by name.
pub(super) struct Fields<'a> {
    pub(super) header: &'a Header,
}

impl Fields<'_> {
    fn get(&self, name: &str) -> Result<&AttributeValue, String> {
        let name = Text::from(name);
        let other = &self.header.own_attributes.other;
        other.get(&name).ok_or_else(|| format!("attribute `{name}` is missing"))
    }

    pub(super) fn text(&self, name: &str) -> Result<String, String> {
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
