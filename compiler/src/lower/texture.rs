//! Images in use become `Texture` records and one run of texels.
//!
//! An image used twice in the same way is stored once. Where a material takes single channels from
//! several images, they are gathered into one image, because the kernel reads roughness and
//! metallic from green and blue of one texture, and coverage from a fourth channel.

use std::sync::Arc;

use lang::scene::{ColorSpace, Wrap};
use pack::abi::{self, TextureFormat};
use serde::{Deserialize, Serialize};

use super::Loaded;
use crate::import::{Environment, Image, Pixels};

/// Which file an image comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ImageRef {
    /// Index into `Scene::textures`.
    Scene(usize),
    /// Image of a mesh file.
    Asset {
        /// Index into `Scene::assets`.
        asset: usize,
        /// Index into `MeshFile::images`.
        image: usize,
    },
}

/// One channel of an image.
pub(super) type Channel = (ImageRef, u8);

/// How a texture is made; equal recipes are stored once.
#[derive(Clone, Debug, PartialEq)]
enum Recipe {
    Whole { image: ImageRef, space: ColorSpace, wrap: [Wrap; 2] },
    Environment { wrap: [Wrap; 2] },
    Gathered { channels: [Option<Channel>; 4], space: ColorSpace, wrap: [Wrap; 2] },
}

/// What is known of the textures of an earlier pack.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownTextures {
    /// How each was made.
    recipes: Vec<String>,
    /// Mean of each, linear.
    means: Vec<[f64; 4]>,
    /// Whether each of `Scene::textures` has an alpha channel of its own.
    has_alpha: Vec<bool>,
    /// Channels of which somebody asked for the least number, with it.
    least: Vec<(String, f32)>,
}

/// Where images come from.
#[derive(Clone, Copy)]
enum Source<'a> {
    Files(&'a Loaded),
    /// No image is looked at: the texels are those of an earlier pack.
    Earlier(&'a KnownTextures),
    /// All textures are there.
    Gone,
}

/// Textures in the order in which materials asked for them.
pub struct TextureTable<'a> {
    source: Source<'a>,
    /// `None` for one that was taken over from an earlier pack.
    recipes: Vec<Option<Recipe>>,
    records: Vec<abi::Texture>,
    texels: Vec<[u32; 4]>,
    means: Vec<[f64; 4]>,
    least: Vec<(Channel, f32)>,
}

impl<'a> TextureTable<'a> {
    /// An empty table over the images in `loaded`.
    #[must_use]
    pub fn new(loaded: &'a Loaded) -> Self {
        Self::over(Source::Files(loaded))
    }

    /// A table of textures that an earlier pack has.
    pub(super) fn again(known: &'a KnownTextures) -> Self {
        Self::over(Source::Earlier(known))
    }

    fn over(source: Source<'a>) -> Self {
        let (recipes, records, texels, means, least) = Default::default();
        Self { source, recipes, records, texels, means, least }
    }

    /// The same without the images: no other texture may be asked for.
    pub(super) fn without_images<'b>(self) -> TextureTable<'b> {
        let Self { source: _, recipes, records, texels, means, least } = self;
        TextureTable { source: Source::Gone, recipes, records, texels, means, least }
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.recipes.len()
    }

    /// What a later compilation may know of these textures.
    pub(super) fn known(&self) -> KnownTextures {
        let loaded = match self.source {
            Source::Files(loaded) => loaded,
            Source::Earlier(known) => return known.clone(),
            Source::Gone => {
                debug_assert!(
                    false,
                    "what is remembered of textures is asked for before their images go"
                );
                return KnownTextures::default();
            }
        };
        let has_alpha = |image: &Option<Arc<Image>>| image.as_ref().is_some_and(|i| i.has_alpha);
        KnownTextures {
            recipes: self.recipes.iter().flatten().map(|recipe| format!("{recipe:?}")).collect(),
            means: self.means.clone(),
            has_alpha: loaded.textures.iter().map(has_alpha).collect(),
            least: self.least.iter().map(|(of, least)| (format!("{of:?}"), *least)).collect(),
        }
    }

    /// Whether these are the textures of the earlier pack, in the same order.
    pub(super) fn is_as_known(&self) -> bool {
        let Source::Earlier(known) = self.source else { return false };
        let own = self.recipes.iter().map(|recipe| recipe.as_ref().map(|r| format!("{r:?}")));
        own.len() == known.recipes.len()
            && own.zip(&known.recipes).all(|(own, known)| own.is_none_or(|own| own == *known))
    }

    /// Takes over textures of the earlier pack, until there are `n`.
    pub(super) fn skip_to(&mut self, n: usize) {
        self.recipes.resize(n.max(self.recipes.len()), None);
    }

    /// Records and texels, for the pack.
    #[must_use]
    pub fn into_records(self) -> (Vec<abi::Texture>, Vec<[u32; 4]>) {
        (self.records, self.texels)
    }

    /// Mean of red, green, blue, alpha over the texels of texture `id`, linear.
    pub(super) fn mean(&self, id: u32) -> [f64; 4] {
        match self.source {
            Source::Files(_) | Source::Gone => self.means[id as usize],
            // Where it is missing, the textures are others, and nothing is taken over.
            Source::Earlier(known) => known.means.get(id as usize).copied().unwrap_or_default(),
        }
    }

    /// The id of a whole image.
    pub(super) fn whole(&mut self, image: ImageRef, space: ColorSpace, wrap: [Wrap; 2]) -> u32 {
        self.id(Recipe::Whole { image, space, wrap }, |loaded| {
            let source = loaded.image(image);
            let (format, words, mean) = stored(source, space);
            Made { size: [source.width, source.height], format, words, mean }
        })
    }

    /// The id of the image of the sky: it goes round along u, and ends at the poles along v.
    pub(super) fn environment(&mut self, environment: Option<&Environment>) -> u32 {
        self.id(Recipe::Environment { wrap: [Wrap::Repeat, Wrap::Clamp] }, |_| {
            let image = &environment.expect("the image of a sky has been loaded").image;
            let (format, words, mean) = stored(image, space_of(image));
            Made { size: [image.width, image.height], format, words, mean }
        })
    }

    /// The id of an image whose channels come from single channels; absent ones are 1. `space` is that of red,
    /// green and blue.
    pub(super) fn gathered(
        &mut self,
        channels: [Option<Channel>; 4],
        space: ColorSpace,
        wrap: [Wrap; 2],
    ) -> u32 {
        self.id(Recipe::Gathered { channels, space, wrap }, |loaded| {
            gather(loaded, channels, space)
        })
    }

    /// The id of the texture with this recipe, which is made at its first use.
    fn id(&mut self, recipe: Recipe, make: impl FnOnce(&Loaded) -> Made) -> u32 {
        if let Some(id) = self.recipes.iter().position(|known| known.as_ref() == Some(&recipe)) {
            return id as u32;
        }
        if let Source::Files(loaded) = self.source {
            let made = make(loaded);
            self.push(recipe.wrap(), &made);
        }
        self.recipes.push(Some(recipe));
        self.recipes.len() as u32 - 1
    }

    fn push(&mut self, wrap: [Wrap; 2], made: &Made) {
        let [wrap_u, wrap_v] = wrap.map(|wrap| match wrap {
            Wrap::Repeat => abi::Wrap::Repeat as u32,
            Wrap::Clamp => abi::Wrap::Clamp as u32,
            Wrap::Mirror => abi::Wrap::Mirror as u32,
        });
        let [width, height] = made.size;
        self.records.push(abi::Texture {
            width,
            height,
            format: made.format as u32,
            offset: self.texels.len() as u32,
            wrap_u,
            wrap_v,
            ..Default::default()
        });
        let (whole, rest) = made.words.as_chunks::<4>();
        self.texels.extend(whole);
        if !rest.is_empty() {
            let mut last = [0; 4];
            last[..rest.len()].copy_from_slice(rest);
            self.texels.push(last);
        }
        self.means.push(made.mean);
    }

    /// Whether an image has an alpha channel of its own.
    pub(super) fn has_alpha(&self, image: ImageRef) -> bool {
        match (self.source, image) {
            (Source::Files(loaded), _) => loaded.image(image).has_alpha,
            (Source::Earlier(known), ImageRef::Scene(texture)) => {
                known.has_alpha.get(texture).copied().unwrap_or(false)
            }
            // Materials of mesh files are taken over as they are.
            (Source::Earlier(_), ImageRef::Asset { .. }) => false,
            (Source::Gone, _) => {
                debug_assert!(false, "no texture is asked for once their images are gone");
                false
            }
        }
    }

    /// The least number in a channel of an image, see [`least`]. What nobody asked for when the earlier pack was
    /// made is 0: the texture that is then asked for is none of that pack.
    pub(super) fn least(&mut self, (image, channel): Channel) -> f32 {
        match self.source {
            Source::Files(loaded) => {
                let found = least(loaded.image(image), channel);
                self.least.push(((image, channel), found));
                found
            }
            Source::Earlier(known) => {
                let name = format!("{:?}", (image, channel));
                let found = known.least.iter().find(|(of, _)| *of == name);
                found.map_or(0.0, |(_, least)| *least)
            }
            Source::Gone => {
                debug_assert!(false, "no texture is asked for once their images are gone");
                0.0
            }
        }
    }
}

/// The least number in a channel of an image, as a texture of it may hold it: bytes round down.
fn least(image: &Image, channel: u8) -> f32 {
    let channel = usize::from(channel);
    match &image.data {
        Pixels::Rgba8(bytes) => {
            let texels = bytes.as_chunks::<4>().0.iter();
            let least = texels.map(|texel| texel[channel]).min().unwrap_or(u8::MAX);
            f32::from(least) / 255.0
        }
        Pixels::Rgba16F(bits) => {
            let texels = bits.as_chunks::<4>().0.iter();
            let values = texels.map(|texel| half::f16::from_bits(texel[channel]).to_f32());
            // `f32::min` would forget a NaN.
            let least = |a: f32, b: f32| if b < a || b.is_nan() { b } else { a };
            libm::floorf(values.fold(1.0, least) * 255.0) / 255.0
        }
    }
}

impl Recipe {
    fn wrap(&self) -> [Wrap; 2] {
        match self {
            Self::Whole { wrap, .. } | Self::Gathered { wrap, .. } | Self::Environment { wrap } => {
                *wrap
            }
        }
    }
}

impl Loaded {
    fn image(&self, image: ImageRef) -> &Image {
        let found = match image {
            ImageRef::Scene(texture) => self.textures[texture].as_deref(),
            ImageRef::Asset { asset, image } => {
                self.assets[asset].as_ref().map(|file| &file.images[image].image)
            }
        };
        found.expect("every image that a used material names has been loaded")
    }
}

/// A texture on its way into the pack.
struct Made {
    size: [u32; 2],
    format: TextureFormat,
    words: Vec<u32>,
    mean: [f64; 4],
}

/// An image as large as the largest of those that its channels come from.
fn gather(loaded: &Loaded, channels: [Option<Channel>; 4], space: ColorSpace) -> Made {
    let sources = channels.map(|channel| channel.map(|(image, _)| loaded.image(image)));
    let largest = |side: fn(&Image) -> u32| sources.iter().flatten().map(|i| side(i)).max();
    let size = [largest(|i| i.width).unwrap_or(1), largest(|i| i.height).unwrap_or(1)];
    let mut bytes = Vec::with_capacity(4 * size[0] as usize * size[1] as usize);
    for y in 0..size[1] {
        for x in 0..size[0] {
            bytes.extend((0..4).map(|k| match (sources[k], channels[k]) {
                (Some(image), Some((_, channel))) => nearest(image, [x, y], size, channel),
                _ => u8::MAX,
            }));
        }
    }
    let (format, mean) = match space {
        ColorSpace::Srgb => (TextureFormat::Rgba8Srgb, byte_mean(&bytes, srgb_to_linear)),
        _ => (TextureFormat::Rgba8Linear, byte_mean(&bytes, |x| x)),
    };
    Made { size, format, words: byte_words(&bytes), mean }
}

/// Format, words and mean of an image whose numbers are to be read as `space` says.
fn stored(source: &Image, space: ColorSpace) -> (TextureFormat, Vec<u32>, [f64; 4]) {
    match (&source.data, space) {
        (Pixels::Rgba8(bytes), ColorSpace::Srgb) => {
            (TextureFormat::Rgba8Srgb, byte_words(bytes), byte_mean(bytes, srgb_to_linear))
        }
        (Pixels::Rgba8(bytes), _) => {
            (TextureFormat::Rgba8Linear, byte_words(bytes), byte_mean(bytes, |x| x))
        }
        (Pixels::Rgba16F(bits), space) => {
            let decode = if space == ColorSpace::Srgb { srgb_to_linear } else { |x| x };
            let (words, mean) = half_words(bits, decode);
            (TextureFormat::Rgba16Float, words, mean)
        }
    }
}

/// Images of the sky are radiance, or pictures with the sRGB curve.
fn space_of(image: &Image) -> ColorSpace {
    if image.is_radiance { ColorSpace::Linear } else { ColorSpace::Srgb }
}

/// Luminance of each texel of a row of an image of the sky.
pub(super) fn luminances(image: &Image, row: usize) -> Vec<f64> {
    let width = image.width as usize;
    let decode = if image.is_radiance { |x| x } else { srgb_to_linear };
    let texels = 4 * row * width..4 * (row + 1) * width;
    let light = |rgb: [f64; 3]| super::light::luminance(rgb.map(decode));
    match &image.data {
        Pixels::Rgba8(bytes) => {
            let value = |byte: u8| f64::from(byte) / 255.0;
            let texels = bytes[texels].as_chunks::<4>().0.iter();
            texels.map(|[r, g, b, _]| light([*r, *g, *b].map(value))).collect()
        }
        Pixels::Rgba16F(bits) => {
            let value = |bits: u16| f64::from(half::f16::from_bits(bits).to_f32());
            let texels = bits[texels].as_chunks::<4>().0.iter();
            texels.map(|[r, g, b, _]| light([*r, *g, *b].map(value))).collect()
        }
    }
}

/// The linear value of each sRGB byte (IEC 61966-2-1), as the SRGBLUT section holds it.
#[must_use]
pub fn srgb_table() -> [f32; 256] {
    std::array::from_fn(|byte| srgb_to_linear(byte as f64 / 255.0) as f32)
}

fn srgb_to_linear(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}

fn byte_words(bytes: &[u8]) -> Vec<u32> {
    bytes.as_chunks::<4>().0.iter().map(|texel| u32::from_le_bytes(*texel)).collect()
}

/// Mean over texels; `decode` is applied to the colour channels only.
fn byte_mean(bytes: &[u8], decode: fn(f64) -> f64) -> [f64; 4] {
    let mut counts = [[0_u64; 256]; 4];
    for texel in bytes.as_chunks::<4>().0 {
        for (count, byte) in counts.iter_mut().zip(texel) {
            count[usize::from(*byte)] += 1;
        }
    }
    let texels = (bytes.len() / 4).max(1) as f64;
    [0, 1, 2, 3].map(|k| {
        let value = |byte: usize| byte as f64 / 255.0;
        let decoded = |byte| if k < 3 { decode(value(byte)) } else { value(byte) };
        let sum: f64 = (0..256).map(|byte| counts[k][byte] as f64 * decoded(byte)).sum();
        sum / texels
    })
}

/// Two words a texel, colour channels decoded; and the mean.
fn half_words(bits: &[u16], decode: fn(f64) -> f64) -> (Vec<u32>, [f64; 4]) {
    let mut words = Vec::with_capacity(bits.len() / 2);
    let mut sum = [0.0; 4];
    for texel in bits.as_chunks::<4>().0 {
        let mut halves = *texel;
        for (k, half) in halves.iter_mut().enumerate() {
            let raw = f64::from(half::f16::from_bits(*half).to_f32());
            let value = if k < 3 { decode(raw) } else { raw };
            if value.to_bits() != raw.to_bits() {
                *half = half::f16::from_f64(value).to_bits();
            }
            sum[k] += value;
        }
        words.push(u32::from(halves[0]) | u32::from(halves[1]) << 16);
        words.push(u32::from(halves[2]) | u32::from(halves[3]) << 16);
    }
    let texels = (bits.len() / 4).max(1) as f64;
    (words, sum.map(|s| s / texels))
}

/// The texel of `image` at the place of texel `at` of a picture of `size`, one channel as a byte.
fn nearest(image: &Image, at: [u32; 2], size: [u32; 2], channel: u8) -> u8 {
    let scale =
        |x: u32, to: u32, from: u32| (u64::from(x) * u64::from(to) / u64::from(from)) as usize;
    let (x, y) = (scale(at[0], image.width, size[0]), scale(at[1], image.height, size[1]));
    let index = 4 * (y * image.width as usize + x) + usize::from(channel);
    match &image.data {
        Pixels::Rgba8(bytes) => bytes[index],
        Pixels::Rgba16F(bits) => {
            let value = half::f16::from_bits(bits[index]).to_f32();
            (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
        }
    }
}
