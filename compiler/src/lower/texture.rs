//! Images in use become `Texture` records and one run of texels.
//!
//! An image used twice in the same way is stored once. Where a material takes single channels from
//! several images, they are gathered into one image, because the kernel reads roughness and
//! metallic from green and blue of one texture, and coverage from a fourth channel.

mod texels;

use std::sync::Arc;

use lang::scene::{ColorSpace, Wrap};
use pack::abi;
use serde::{Deserialize, Serialize};

use super::Loaded;
use crate::import::{Environment, Image};
use texels::Made;

pub(super) use texels::luminances;
pub use texels::srgb_table;

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
            texels::whole(loaded.image(image), space)
        })
    }

    /// The id of the image of the sky: it goes round along u, and ends at the poles along v.
    pub(super) fn environment(&mut self, environment: Option<&Environment>) -> u32 {
        self.id(Recipe::Environment { wrap: [Wrap::Repeat, Wrap::Clamp] }, |_| {
            let image = &environment.expect("the image of a sky has been loaded").image;
            texels::whole(image, texels::space_of(image))
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
            let image = |(image, channel)| (loaded.image(image), channel);
            texels::gather(channels.map(|of| of.map(image)), space)
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

    /// The least number in a channel of an image, see `texels::least`. What nobody asked for when the earlier pack was
    /// made is 0: the texture that is then asked for is none of that pack.
    pub(super) fn least(&mut self, (image, channel): Channel) -> f32 {
        match self.source {
            Source::Files(loaded) => {
                let found = texels::least(loaded.image(image), channel);
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
