//! Images in use become `Texture` records and one run of texels.
//!
//! An image used twice in the same way is stored once. Where a material takes single channels from
//! several images, they are gathered into one image, because the kernel reads roughness and
//! metallic from green and blue of one texture, and coverage from a fourth channel. No image is looked at before
//! somebody asks what is in it, or texels must be made.

pub(super) mod expression;
mod texels;

use std::collections::{BTreeMap, BTreeSet};

use lang::scene::{ColorSpace, Wrap};
use pack::abi::{self, TextureOp};
use pack::{Kind, Pack};
use rayon::prelude::*;

use super::files::{Files, ImageRef, Images, facts_of};
use super::rows::Rows;
use crate::import::ImportError;
use crate::stage::{Key, KeyOf, Stages};
use texels::Made;

pub(super) use texels::luminances;
pub use texels::srgb_table;

/// One channel of an image.
pub(super) type Channel = (ImageRef, u8);

/// How a texture is made; equal recipes are stored once.
#[derive(Clone, Debug, PartialEq)]
enum Recipe {
    Whole {
        image: ImageRef,
        space: ColorSpace,
        wrap: [Wrap; 2],
    },
    Gathered {
        channels: [Option<Channel>; 4],
        space: ColorSpace,
        wrap: [Wrap; 2],
    },
    /// Computed from textures of this table.
    Expression(Vec<TextureOp>),
}

/// Textures in the order in which materials asked for them.
pub(super) struct TextureTable<'a> {
    files: &'a dyn Files,
    stages: &'a Stages,
    recipes: Vec<Recipe>,
    /// The first image that could not be looked at.
    failed: Option<ImportError>,
}

/// Records and texels.
pub(super) struct Textures {
    pub(super) records: Vec<abi::Texture>,
    pub(super) texels: Rows<[u32; 4]>,
}

impl<'a> TextureTable<'a> {
    /// An empty table.
    pub(super) fn new(files: &'a dyn Files, stages: &'a Stages) -> Self {
        Self { files, stages, recipes: Vec::new(), failed: None }
    }

    /// The id of a whole image.
    pub(super) fn whole(&mut self, image: ImageRef, space: ColorSpace, wrap: [Wrap; 2]) -> u32 {
        self.id(Recipe::Whole { image, space, wrap })
    }

    /// The id of the image of the sky: it goes round along u, and ends at the poles along v.
    pub(super) fn environment(&mut self) -> u32 {
        let space = texels::space_of(facts_of(self.files, ImageRef::Sky).is_radiance);
        self.whole(ImageRef::Sky, space, [Wrap::Repeat, Wrap::Clamp])
    }

    /// The id of an image whose channels come from single channels; absent ones are 1. `space` is that of red,
    /// green and blue.
    pub(super) fn gathered(
        &mut self,
        channels: [Option<Channel>; 4],
        space: ColorSpace,
        wrap: [Wrap; 2],
    ) -> u32 {
        self.id(Recipe::Gathered { channels, space, wrap })
    }

    /// The id of a texture that these operations compute; the images among them are ids.
    pub(super) fn expression(&mut self, ops: Vec<TextureOp>) -> u32 {
        self.id(Recipe::Expression(ops))
    }

    /// Whether texture `id` reads the colours of vertices.
    pub(super) fn reads_vertex_colors(&self, id: u32) -> bool {
        match &self.recipes[id as usize] {
            Recipe::Expression(ops) => expression::reads_vertex_colors(ops),
            Recipe::Whole { .. } | Recipe::Gathered { .. } => false,
        }
    }

    /// Whether any texture does.
    pub(super) fn has_vertex_colors(&self) -> bool {
        (0..self.recipes.len() as u32).any(|id| self.reads_vertex_colors(id))
    }

    /// Whether texture `id` is looked up at texture coordinates.
    pub(super) fn reads_uvs(&self, id: u32) -> bool {
        match &self.recipes[id as usize] {
            Recipe::Expression(ops) => expression::reads_uvs(ops),
            Recipe::Whole { .. } | Recipe::Gathered { .. } => true,
        }
    }

    fn id(&mut self, recipe: Recipe) -> u32 {
        let known = self.recipes.iter().position(|known| *known == recipe);
        let id = known.unwrap_or_else(|| {
            self.recipes.push(recipe);
            self.recipes.len() - 1
        });
        id as u32
    }

    /// Whether an image has an alpha channel of its own.
    pub(super) fn has_alpha(&self, image: ImageRef) -> bool {
        facts_of(self.files, image).has_alpha
    }

    /// Mean of red, green, blue, alpha over the texels of texture `id`, linear.
    pub(super) fn mean(&mut self, id: u32) -> [f64; 4] {
        let recipe = self.recipes[id as usize].clone();
        if let Recipe::Expression(ops) = &recipe {
            let images: BTreeSet<u32> = ops.iter().filter_map(expression::image_of).collect();
            let means: BTreeMap<u32, [f64; 4]> =
                images.into_iter().map(|image| (image, self.mean(image))).collect();
            return expression::mean(ops, |image| means[&image]);
        }
        let mut key = KeyOf::stage("mean of a texture");
        recipe.read(self.files, &mut key);
        let mean = |images: &Images| recipe.make(images).map_or([1.0; 4], |made| made.mean);
        self.look(key.end(), recipe.images(), mean)
    }

    /// The least number in a channel of an image, see `texels::least`.
    pub(super) fn least(&mut self, (image, channel): Channel) -> f32 {
        let mut key = KeyOf::stage("least number of a channel");
        key.bytes(&facts_of(self.files, image).content).number(channel);
        let look = |images: &Images| texels::least(images.get(image), channel);
        self.look(key.end(), vec![image], look)
    }

    /// A number that is found in some images.
    fn look<T: Default + serde::Serialize + serde::de::DeserializeOwned>(
        &mut self,
        key: Key,
        images: Vec<ImageRef>,
        look: impl FnOnce(&Images) -> T,
    ) -> T {
        let found = self.stages.try_value(key, || Ok(look(&Images::load(self.files, images)?)));
        found.unwrap_or_else(|error| {
            self.failed.get_or_insert(error);
            T::default()
        })
    }

    /// Records and texels, those of the last pack if it has these very textures; and whether it has.
    ///
    /// # Errors
    /// When an image cannot be loaded.
    pub(super) fn made(&mut self) -> Result<(Textures, bool), ImportError> {
        if let Some(error) = self.failed.take() {
            return Err(error);
        }
        let mut key = KeyOf::stage("textures");
        for recipe in &self.recipes {
            recipe.read(self.files, &mut key);
        }
        let key = key.end();
        if let Some(((), pack)) = self.stages.in_pack(key) {
            let texels = Rows::kept(pack, Kind::TEXEL, Pack::texels);
            return Ok((Textures { records: pack.records().to_vec(), texels }, true));
        }
        let images = Images::load(self.files, self.recipes.iter().flat_map(Recipe::images))?;
        let made: Vec<Option<Made>> =
            self.recipes.par_iter().map(|recipe| recipe.make(&images)).collect();
        let (mut records, mut texels) = (Vec::with_capacity(made.len()), Vec::new());
        for (recipe, made) in self.recipes.iter().zip(made) {
            if let Recipe::Expression(ops) = recipe {
                let unit = TextureOp::WORDS as usize;
                texels.resize(texels.len().next_multiple_of(unit), [0; 4]);
                records.push(abi::Texture::expression(ops.len() as u32, texels.len() as u32));
                texels.extend(ops.iter().flat_map(TextureOp::words));
            }
            let Some(made) = made else { continue };
            records.push(record(recipe.wrap(), &made, texels.len()));
            let (whole, rest) = made.words.as_chunks::<4>();
            texels.extend(whole);
            if !rest.is_empty() {
                let mut last = [0; 4];
                last[..rest.len()].copy_from_slice(rest);
                texels.push(last);
            }
        }
        self.stages.put_in_pack(key, &());
        Ok((Textures { records, texels: texels.into() }, false))
    }
}

fn record(wrap: [Wrap; 2], made: &Made, offset: usize) -> abi::Texture {
    let [wrap_u, wrap_v] = wrap.map(|wrap| match wrap {
        Wrap::Repeat => abi::Wrap::Repeat as u32,
        Wrap::Clamp => abi::Wrap::Clamp as u32,
        Wrap::Mirror => abi::Wrap::Mirror as u32,
    });
    let [width, height] = made.size;
    let (format, offset) = (made.format as u32, offset as u32);
    abi::Texture { width, height, format, offset, wrap_u, wrap_v, ..Default::default() }
}

impl Recipe {
    fn images(&self) -> Vec<ImageRef> {
        match self {
            Self::Whole { image, .. } => vec![*image],
            Self::Gathered { channels, .. } => {
                channels.iter().flatten().map(|(image, _)| *image).collect()
            }
            Self::Expression(_) => Vec::new(),
        }
    }

    /// Its texels, if it has any.
    fn make(&self, images: &Images) -> Option<Made> {
        match self {
            Self::Whole { image, space, .. } => Some(texels::whole(images.get(*image), *space)),
            Self::Gathered { channels, space, .. } => {
                let channels = channels.map(|of| of.map(|(i, k)| (images.get(i), k)));
                Some(texels::gather(channels, *space))
            }
            Self::Expression(_) => None,
        }
    }

    fn wrap(&self) -> [Wrap; 2] {
        match self {
            Self::Whole { wrap, .. } | Self::Gathered { wrap, .. } => *wrap,
            Self::Expression(_) => [Wrap::Repeat; 2],
        }
    }

    /// Adds what it is made from.
    fn read(&self, files: &dyn Files, key: &mut KeyOf) {
        let content = |image: ImageRef| facts_of(files, image).content;
        let space = match self {
            Self::Whole { image, space, .. } => {
                key.number(1_u32).bytes(&content(*image));
                space
            }
            Self::Gathered { channels, space, .. } => {
                key.number(2_u32);
                for channel in channels {
                    match channel {
                        None => key.number(0_u32),
                        Some((image, channel)) => key.bytes(&content(*image)).number(*channel),
                    };
                }
                space
            }
            Self::Expression(ops) => {
                key.number(3_u32).bytes(bytemuck::cast_slice(ops));
                return;
            }
        };
        key.number(match space {
            ColorSpace::Srgb => 0_u32,
            ColorSpace::Linear => 1,
            ColorSpace::Data => 2,
        });
        for wrap in self.wrap() {
            key.number(match wrap {
                Wrap::Repeat => 0_u32,
                Wrap::Clamp => 1,
                Wrap::Mirror => 2,
            });
        }
    }
}
