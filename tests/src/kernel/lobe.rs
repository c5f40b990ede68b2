//! One scattering model at a surface, for both precisions of the generated kernel.

use glam::{DVec2, DVec3, Vec2, Vec3};
use pack::abi::{Material, MaterialKind, NONE};
use runtime::kernel::{f32 as single, f64 as double};

use super::Bench;

/// Mean reflectance of an interface of index `ior` for diffuse light from within, by quadrature over the
/// square of the cosine.
fn mean_from_within(ior: f64) -> f64 {
    let n = 20_000;
    let e = 1.0 / ior;
    let at = |i: u32| {
        let c = ((f64::from(i) + 0.5) / f64::from(n)).sqrt();
        let g2 = e * e - 1.0 + c * c;
        if g2 <= 0.0 {
            return 1.0;
        }
        let g = g2.sqrt();
        let (s, p) = ((c - g) / (c + g), (e * e * c - g) / (e * e * c + g));
        0.5 * (s * s + p * p)
    };
    (0..n).map(at).sum::<f64>() / f64::from(n)
}

/// A scattering model with its parameters, at a surface with one normal.
#[derive(Clone, Copy, Debug)]
pub struct Lobe {
    /// Which model.
    pub kind: MaterialKind,
    /// Grey reflectance or base colour.
    pub color: f32,
    /// Radius of the metal's ball.
    pub fuzz: f32,
    /// Perceptual roughness.
    pub roughness: f32,
    /// Metallic weight.
    pub metallic: f32,
    /// Refractive index.
    pub ior: f64,
    /// Brushed along the tangent, 0 ..= 1.
    pub anisotropy: f32,
    /// Share of a second lobe.
    pub weight: f32,
    /// 1 with the light of several reflections, 0 without.
    pub compensation: f32,
    /// Geometric and shading normal, unit.
    pub normal: DVec3,
    /// The path comes from the front side.
    pub front: bool,
    /// Texture coordinates.
    pub uv: DVec2,
    /// Where in its object, metres.
    pub place: DVec3,
    /// Key of the object.
    pub key: u32,
    /// Share of gloss over a matte base.
    pub gloss: f32,
    /// Sample number, for models that are found by a random walk.
    pub sample: u32,
}

impl Lobe {
    /// A white model of `kind` at a surface of no special direction.
    #[must_use]
    pub fn new(kind: MaterialKind) -> Self {
        Self {
            kind,
            color: 1.0,
            fuzz: 0.0,
            roughness: 0.0,
            metallic: 0.0,
            ior: 1.5,
            anisotropy: 0.0,
            weight: 0.0,
            compensation: 1.0,
            normal: DVec3::new(0.36, -0.48, 0.8),
            front: true,
            uv: DVec2::new(0.3, 0.6),
            place: DVec3::new(0.1, -0.7, 0.4),
            key: 0x9e37_79b9,
            gloss: 0.0,
            sample: 0,
        }
    }

    /// The material record, for what models read from it: textures none, second colour white.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the compiler does")]
    pub fn record(&self) -> Material {
        Material {
            color: [self.color; 3],
            kind: self.kind as u32,
            fuzz: self.fuzz,
            roughness: self.roughness,
            metallic: self.metallic,
            ior: self.ior as f32,
            ior_minus_1: (self.ior - 1.0) as f32,
            anisotropy: self.anisotropy,
            weight: self.weight,
            compensation: self.compensation,
            gloss: self.gloss,
            tint: [1.0; 3],
            specular: mean_from_within(self.ior) as f32,
            ..Material::default()
        }
    }

    /// A kernel whose material 0 is this model.
    #[must_use]
    pub fn bench(&self) -> Bench {
        Bench::new().materials(&[self.record()])
    }

    /// A white conductor with compensation.
    #[must_use]
    pub fn conductor(roughness: f32, anisotropy: f32) -> Self {
        Self { roughness, anisotropy, ..Self::new(MaterialKind::Conductor) }
    }

    /// Rough glass, seen from the outside or from within.
    #[must_use]
    pub fn rough_dielectric(roughness: f32, ior: f64, front: bool) -> Self {
        Self { roughness, ior, front, ..Self::new(MaterialKind::RoughDielectric) }
    }

    /// A white base under a coat of index 1.5.
    #[must_use]
    pub fn clearcoat(fuzz: f32) -> Self {
        Self { fuzz, ..Self::new(MaterialKind::Clearcoat) }
    }

    /// The direction in which u grows: some direction at a right angle to the normal.
    #[must_use]
    pub fn tangent(&self) -> DVec3 {
        self.normal.any_orthonormal_vector()
    }

    /// Lambert.
    #[must_use]
    pub fn diffuse() -> Self {
        Self::new(MaterialKind::Diffuse)
    }

    /// A white metal with a ball of radius `fuzz`.
    #[must_use]
    pub fn metal(fuzz: f32) -> Self {
        Self { fuzz, ..Self::new(MaterialKind::Metal) }
    }

    /// A white principled surface of index 1.5.
    #[must_use]
    pub fn principled(roughness: f32, metallic: f32) -> Self {
        Self { roughness, metallic, ..Self::new(MaterialKind::Principled) }
    }

    /// A unit direction at cosine `mu` to the normal, representable in single precision. Unit in
    /// double precision; its cosine is `mu` up to 1e-7.
    #[must_use]
    pub fn at_cosine(&self, mu: f64) -> DVec3 {
        let side = self.normal.any_orthonormal_vector();
        let d = self.normal * mu + side * (1.0 - mu * mu).max(0.0).sqrt();
        d.as_vec3().as_dvec3().normalize()
    }

    /// `wo` mirrored at the normal.
    #[must_use]
    pub fn mirror(&self, wo: DVec3) -> DVec3 {
        (self.normal * (2.0 * self.normal.dot(wo)) - wo).normalize()
    }

    /// For the kernel in single precision.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the compiler does")]
    pub fn single(&self) -> single::Scatter {
        single::Scatter {
            ng: self.normal.as_vec3(),
            ns: self.normal.as_vec3(),
            color: Vec3::splat(self.color),
            kind: self.kind as u32,
            material: 0,
            tangent: self.tangent().as_vec3(),
            anisotropy: self.anisotropy,
            at: single::TexturePoint { uv: self.uv.as_vec2(), w: 0.0, prim: NONE, b: Vec2::ZERO },
            place: single::Place { q: self.place.as_vec3(), key: self.key },
            fuzz: self.fuzz,
            roughness: self.roughness,
            metallic: self.metallic,
            ior: self.ior as f32,
            ior_minus_1: (self.ior - 1.0) as f32,
            front: self.front,
            key: single::SampleKey { pixel: 0, sample: self.sample, bounce: 0, seed: 7 },
        }
    }

    /// For the kernel in double precision.
    #[must_use]
    pub fn double(&self) -> double::Scatter {
        double::Scatter {
            ng: self.normal,
            ns: self.normal,
            color: DVec3::splat(f64::from(self.color)),
            kind: self.kind as u32,
            material: 0,
            tangent: self.tangent(),
            anisotropy: f64::from(self.anisotropy),
            at: double::TexturePoint { uv: self.uv, w: 0.0, prim: NONE, b: DVec2::ZERO },
            place: double::Place { q: self.place, key: self.key },
            fuzz: f64::from(self.fuzz),
            roughness: f64::from(self.roughness),
            metallic: f64::from(self.metallic),
            ior: self.ior,
            ior_minus_1: self.ior - 1.0,
            front: self.front,
            key: double::SampleKey { pixel: 0, sample: self.sample, bounce: 0, seed: 7 },
        }
    }
}
