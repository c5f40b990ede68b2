//! Colours of vertices become images: factors on the base colour of materials that have no images of their own.
//!
//! Every triangle has a block of 2 x 2 texels: the colours of its corners at three of them, and the fourth so that what
//! is read between their centres is the plane through the three. Bilinear lookups are then exact, and the kernel
//! need not know that there are colours. Where all colours of a part are one, that is a factor alone.

use super::error::ImportError;
use super::file::Limits;
use super::image::{Image, Pixels};
use super::material::{ImportedImage, ImportedMaterial, MapUse};
use super::mesh::{MeshFile, Part};
use super::paint::Paint;
use half::f16;
use lang::scene::{ColorSpace, Wrap};
use std::collections::BTreeMap;

/// Bytes of a texel, four half floats.
const TEXEL: u64 = 8;
/// The half float 1.
const ONE: u16 = 0x3c00;

/// Turns `Part::colors` of all parts into images and factors, and says how many are not used.
pub(super) fn bake(
    mut file: MeshFile,
    place: &str,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let mut baker = Baker {
        materials: file.materials,
        images: file.images,
        factors: BTreeMap::new(),
        n_beside_images: 0,
        n_too_large: 0,
    };
    for part in &mut file.parts {
        let colors = std::mem::take(&mut part.colors);
        if !colors.is_empty() {
            baker.part(part, &colors, place, limits)?;
        }
    }
    (file.materials, file.images) = (baker.materials, baker.images);
    let unused = [
        (baker.n_beside_images, "vertex colours beside images"),
        (baker.n_too_large, "vertex colours and more triangles than an image has room for"),
    ];
    for (count, what) in unused.into_iter().filter(|(count, _)| *count > 0) {
        let (many, have) = if count == 1 { ("part", "has") } else { ("parts", "have") };
        file.report.warn(place, format!("{count} {many} {have} {what}: the colours are not used"));
    }
    Ok(file)
}

/// What the parts done so far have become.
struct Baker {
    materials: Vec<ImportedMaterial>,
    images: Vec<ImportedImage>,
    /// Materials with one colour as a factor, by what they were and the bits of the colour.
    factors: BTreeMap<(Option<u32>, [u32; 3]), u32>,
    n_beside_images: u64,
    n_too_large: u64,
}

impl Baker {
    /// `colors`: one for each vertex, at least one.
    fn part(
        &mut self,
        part: &mut Part,
        colors: &[[f32; 3]],
        place: &str,
        limits: &Limits,
    ) -> Result<(), ImportError> {
        let known = part.material.and_then(|material| self.materials.get(material as usize));
        let base = known.cloned().unwrap_or_else(|| ImportedMaterial {
            diffuse_only: true,
            metallic: 0.0,
            ..ImportedMaterial::named("vertex colours".to_owned())
        });
        let bits = |color: [f32; 3]| color.map(f32::to_bits);
        let first = colors[0];
        if colors.iter().all(|color| bits(*color) == bits(first)) {
            if part.material.is_some() && bits(first) == bits([1.0; 3]) {
                return Ok(()); // many exporters write white
            }
            let key = (part.material, bits(first));
            let color = [0, 1, 2].map(|k| base.color[k] * f64::from(first[k]));
            let new = || push(&mut self.materials, ImportedMaterial { color, ..base });
            part.material = Some(*self.factors.entry(key).or_insert_with(new));
            return Ok(());
        }
        if base.has_images() {
            self.n_beside_images += 1;
            return Ok(());
        }
        let Some(paint) = self.room(part.triangles.len(), limits) else {
            self.n_too_large += 1;
            return Ok(());
        };
        limits.memory.take(paint.n_pixels() * TEXEL, place)?.keep();
        let name = format!("colours of `{}`", part.name);
        let image = u32::try_from(self.images.len()).unwrap_or(u32::MAX);
        self.images.push(ImportedImage { name, image: painted(part, colors, paint) });
        let map = MapUse { image, space: ColorSpace::Linear, wrap: [Wrap::Clamp; 2] };
        let material = ImportedMaterial { color_map: Some(map), ..base };
        part.material = Some(push(&mut self.materials, material));
        part.paint = Some(paint);
        Ok(())
    }

    /// A layout for so many triangles, if the limits allow one more such image.
    fn room(&self, n_triangles: usize, limits: &Limits) -> Option<Paint> {
        let size =
            |image: &ImportedImage| u64::from(image.image.width) * u64::from(image.image.height);
        let taken: u64 = self.images.iter().map(size).sum();
        let fits = |paint: &Paint| {
            let pixels = paint.n_pixels();
            pixels <= limits.pixels && taken.saturating_add(pixels) <= limits.total_pixels
        };
        Paint::of(n_triangles).filter(fits)
    }
}

fn push(materials: &mut Vec<ImportedMaterial>, material: ImportedMaterial) -> u32 {
    materials.push(material);
    u32::try_from(materials.len() - 1).unwrap_or(u32::MAX)
}

/// The image of the colours of a part, linear.
fn painted(part: &Part, colors: &[[f32; 3]], paint: Paint) -> Image {
    let [width, height] = paint.size();
    let (columns, row) = (paint.columns(), 4 * width as usize);
    let mut texels = vec![0; row * height as usize];
    for (tri_idx, corners) in part.triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|vertex| colors[vertex as usize]);
        let across = [0, 1, 2].map(|k| b[k] + c[k] - a[k]);
        let at = 2 * (tri_idx / columns) * row + 8 * (tri_idx % columns);
        for (color, at) in [(a, at), (b, at + 4), (c, at + row), (across, at + row + 4)] {
            let [r, g, b] = color.map(|x| f16::from_f32(x).to_bits());
            texels[at..at + 4].copy_from_slice(&[r, g, b, ONE]);
        }
    }
    let data = Pixels::Rgba16F(texels);
    Image { width, height, data, has_alpha: false, clamped: 0, is_radiance: false }
}

/// The linear value of a channel with the sRGB curve (IEC 61966-2-1), between 0 and 1.
pub(super) fn linear(x: f32) -> f32 {
    let x = f64::from(x.clamp(0.0, 1.0));
    let [linear] = super::check::single([if x <= 0.04045 {
        x / 12.92
    } else {
        libm::pow((x + 0.055) / 1.055, 2.4)
    }]);
    linear
}
