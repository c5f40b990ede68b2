//! What lowering asks of the files of a scene: first what is known of them, then, where it must be, what they hold.
//!
//! It does not know where files are, nor how they are read.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::import::{
    Environment, EnvironmentFacts, Image, ImageFacts, ImportError, MeshFacts, MeshFile,
};

/// Mesh files by their index in `Scene::assets`.
pub type Meshes = BTreeMap<usize, Arc<MeshFile>>;

/// The files of a scene.
pub trait Files: Sync {
    /// Of `Scene::assets`, in the same order.
    fn assets(&self) -> &[MeshFacts];
    /// Of `Scene::textures`, in the same order.
    fn textures(&self) -> &[ImageFacts];
    /// Of the image of the sky, if it has one.
    fn environment(&self) -> Option<&EnvironmentFacts>;
    /// Loads mesh files.
    ///
    /// # Errors
    /// When there is no memory for them, or they changed since it was known what they hold.
    fn load_meshes(&self, assets: &BTreeSet<usize>) -> Result<Meshes, ImportError>;
    /// Loads images of `Scene::textures`.
    ///
    /// # Errors
    /// As `load_meshes`.
    fn load_images(
        &self,
        textures: &BTreeSet<usize>,
    ) -> Result<BTreeMap<usize, Arc<Image>>, ImportError>;
    /// Loads the image of the sky.
    ///
    /// # Errors
    /// As `load_meshes`; when it has none.
    fn load_environment(&self) -> Result<Arc<Environment>, ImportError>;
    /// What was loaded is not needed any more.
    fn release(&self);
}

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
    /// The image of the sky.
    Sky,
}

/// What is known of an image.
pub(super) fn facts_of(files: &dyn Files, image: ImageRef) -> ImageFacts {
    match image {
        ImageRef::Scene(texture) => files.textures()[texture],
        ImageRef::Asset { asset, image } => files.assets()[asset].images[image],
        ImageRef::Sky => files.environment().expect("the image of a sky has been read").image,
    }
}

/// Images that were loaded.
#[derive(Default)]
pub(super) struct Images {
    meshes: Meshes,
    textures: BTreeMap<usize, Arc<Image>>,
    sky: Option<Arc<Environment>>,
}

impl Images {
    pub(super) fn load(
        files: &dyn Files,
        wanted: impl IntoIterator<Item = ImageRef>,
    ) -> Result<Self, ImportError> {
        let (mut meshes, mut textures, mut sky) = (BTreeSet::new(), BTreeSet::new(), None);
        for image in wanted {
            match image {
                ImageRef::Scene(texture) => {
                    textures.insert(texture);
                }
                ImageRef::Asset { asset, .. } => {
                    meshes.insert(asset);
                }
                ImageRef::Sky => sky = Some(files.load_environment()?),
            }
        }
        let textures = files.load_images(&textures)?;
        Ok(Self { meshes: files.load_meshes(&meshes)?, textures, sky })
    }

    pub(super) fn get(&self, image: ImageRef) -> &Image {
        let found = match image {
            ImageRef::Scene(texture) => self.textures.get(&texture).map(AsRef::as_ref),
            ImageRef::Asset { asset, image } => {
                self.meshes.get(&asset).map(|file| &file.images[image].image)
            }
            ImageRef::Sky => self.sky.as_ref().map(|sky| &sky.image),
        };
        found.expect("images are asked for that were loaded")
    }
}
