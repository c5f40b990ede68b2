//! The kinds of things a scene declares, and their keywords.

/// What a declaration is, or what a call makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A mesh file.
    Asset,
    /// An image file.
    Texture,
    /// How a surface scatters and emits.
    Material,
    /// What fills the inside of things, and the space around them.
    Medium,
    /// Geometry; only ever a value, never a declaration.
    Shape,
    /// A reusable thing.
    Object,
    /// A thing in the world.
    Instance,
    /// A light source without a mesh.
    Light,
    /// What a ray sees that leaves the scene.
    Sky,
    /// The eye.
    Camera,
    /// The picture.
    Film,
    /// How the picture is made.
    Render,
}

impl Kind {
    /// Every kind, in the order of the reference.
    pub const ALL: [Self; 12] = [
        Self::Asset,
        Self::Texture,
        Self::Material,
        Self::Medium,
        Self::Shape,
        Self::Object,
        Self::Instance,
        Self::Light,
        Self::Sky,
        Self::Camera,
        Self::Film,
        Self::Render,
    ];

    /// The keyword of its declarations.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Asset => "asset",
            Self::Texture => "texture",
            Self::Material => "material",
            Self::Medium => "medium",
            Self::Shape => "shape",
            Self::Object => "object",
            Self::Instance => "instance",
            Self::Light => "light",
            Self::Sky => "sky",
            Self::Camera => "camera",
            Self::Film => "film",
            Self::Render => "render",
        }
    }

    /// The kind with this keyword.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// With its article, as it stands in a message.
    #[must_use]
    pub fn with_article(self) -> &'static str {
        match self {
            Self::Asset => "an asset",
            Self::Texture => "a texture",
            Self::Material => "a material",
            Self::Medium => "a medium",
            Self::Shape => "a shape",
            Self::Object => "an object",
            Self::Instance => "an instance",
            Self::Light => "a light",
            Self::Sky => "a sky",
            Self::Camera => "a camera",
            Self::Film => "a film",
            Self::Render => "a render",
        }
    }
}
