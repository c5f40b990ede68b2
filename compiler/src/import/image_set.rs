//! The images of one mesh file: each asked for once, decoded together.

use super::error::{ErrorKind, ImportError};
use super::file::Limits;
use super::image::{self, Image, Pixels};
use super::material::ImportedImage;
use super::report::ImportReport;
use rayon::prelude::*;
use std::borrow::Cow;

/// What the fourth channel is to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Alpha {
    /// The alpha of the file.
    Own,
    /// The alpha of the file, or its brightness when it has none: a mask painted in grey.
    Mask,
    /// Glossiness times a factor; what it leaves to 1 goes into green, as perceptual roughness. The bits of the factor,
    /// 0 ..= 1.
    Gloss(u32),
}

struct Request<'a> {
    name: String,
    place: String,
    alpha: Alpha,
    bytes: Cow<'a, [u8]>,
}

/// Images that have been asked for.
#[derive(Default)]
pub(super) struct ImageSet<'a> {
    requests: Vec<Request<'a>>,
}

impl<'a> ImageSet<'a> {
    /// The index of an image that has been asked for before.
    pub(super) fn find(&self, name: &str, alpha: Alpha) -> Option<u32> {
        let found = self.requests.iter().position(|r| r.name == name && r.alpha == alpha)?;
        u32::try_from(found).ok()
    }

    /// The same for the file that an image is in.
    pub(super) fn find_place(&self, place: &str, alpha: Alpha) -> Option<u32> {
        let found = self.requests.iter().position(|r| r.place == place && r.alpha == alpha)?;
        u32::try_from(found).ok()
    }

    /// Asks for an image; returns its index.
    pub(super) fn add(
        &mut self,
        name: String,
        place: String,
        alpha: Alpha,
        bytes: Cow<'a, [u8]>,
    ) -> Result<u32, ImportError> {
        let index = u32::try_from(self.requests.len());
        let index =
            index.map_err(|_| ImportError::new(ErrorKind::Limit, &place, "too many images"));
        self.requests.push(Request { name, place, alpha, bytes });
        index
    }

    /// Decodes all of them, in parallel, after their sizes have been checked together.
    pub(super) fn decode(
        self,
        limits: &Limits,
        report: &mut ImportReport,
    ) -> Result<Vec<ImportedImage>, ImportError> {
        let mut total: u64 = 0;
        for request in &self.requests {
            let [width, height] = image::size(&request.bytes, &request.place, limits)?;
            total = total.saturating_add(u64::from(width) * u64::from(height));
            if total > limits.total_pixels {
                let max = limits.total_pixels;
                let message = format!("with this image, all images exceed {max} pixels together");
                return Err(ImportError::new(ErrorKind::Limit, &request.place, message)
                    .with_help("scale the images down"));
            }
        }
        let images: Result<Vec<_>, _> = self
            .requests
            .into_par_iter()
            .map(|request| {
                let mut image = image::decode_image(&request.bytes, &request.place, limits)?;
                match request.alpha {
                    Alpha::Mask if !image.has_alpha => brightness_to_alpha(&mut image),
                    Alpha::Gloss(bits) => gloss_to_roughness(&mut image, f32::from_bits(bits)),
                    Alpha::Own | Alpha::Mask => {}
                }
                Ok(ImportedImage { name: request.name, image })
            })
            .collect();
        let images = images?;
        report.clamped_texels += images.iter().map(|image| image.image.clamped).sum::<u64>();
        Ok(images)
    }
}

/// Masks are grey, so the red channel is their brightness.
fn brightness_to_alpha(image: &mut Image) {
    match &mut image.data {
        Pixels::Rgba8(texels) => texels.chunks_exact_mut(4).for_each(|texel| texel[3] = texel[0]),
        Pixels::Rgba16F(texels) => texels.chunks_exact_mut(4).for_each(|texel| texel[3] = texel[0]),
    }
    image.has_alpha = true;
}

/// Green becomes 1 - `factor` alpha.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "0 ..= 255 by the range of both factors"
)]
fn gloss_to_roughness(image: &mut Image, factor: f32) {
    match &mut image.data {
        Pixels::Rgba8(texels) => texels.chunks_exact_mut(4).for_each(|texel| {
            texel[1] = (255.0 - factor * f32::from(texel[3])).round() as u8;
        }),
        Pixels::Rgba16F(texels) => texels.chunks_exact_mut(4).for_each(|texel| {
            let gloss = (factor * half::f16::from_bits(texel[3]).to_f32()).clamp(0.0, 1.0);
            texel[1] = half::f16::from_f32(1.0 - gloss).to_bits();
        }),
    }
}
