//! A picture with its layers → the same picture without noise, by Open Image Denoise (OIDN) 2.
//!
//! The library is no part of `rtr`: it is found (`find.rs`) and loaded (`oidn.rs`) when it is asked for. Albedo and
//! normal are denoised first, each alone, and then guide the picture, as the documentation of its filter `RT` advises
//! ("prefiltering"). The sums of the picture stay as they are, so what merges, resumes or is compared is never a denoised
//! value. It does not know files of pictures.

#[cfg(feature = "denoise")]
mod find;
#[cfg(feature = "denoise")]
mod oidn;
#[cfg(not(feature = "denoise"))]
mod without;

#[cfg(feature = "denoise")]
use self::oidn::{Oidn, OidnError};
#[cfg(not(feature = "denoise"))]
use self::without::{Oidn, OidnError};
use crate::layers::Layers;
use crate::output::{Denoised, Picture};
use crate::zeros::{NoMemory, zeros};
use std::path::Path;
use thiserror::Error;

/// There is no denoiser, or it has failed.
#[derive(Debug, Error)]
pub enum DenoiseError {
    /// It cannot be loaded, or says what went wrong.
    #[error(transparent)]
    Oidn(#[from] OidnError),
    /// The system does not give the memory for the images.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    /// What it gave is of no use.
    #[error("Open Image Denoise gave pixels that are not finite")]
    NotFinite,
}

impl DenoiseError {
    /// Whether it was told to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Self::Oidn(OidnError::Cancelled))
    }
}

/// Open Image Denoise, ready to be used.
#[derive(Debug)]
pub struct Denoiser {
    oidn: Oidn,
    threads: Option<usize>,
}

impl Denoiser {
    /// Loads the library: `named` or its folder; else that of `OIDN_DIR`, else what the loader finds, else that of the
    /// Python wheel `pyoidn`. It runs on so many `threads`, or on one for each core.
    pub fn open(named: Option<&Path>, threads: Option<usize>) -> Result<Self, DenoiseError> {
        Ok(Self { oidn: Oidn::open(named)?, threads })
    }

    /// `Open Image Denoise 2.5.1`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("Open Image Denoise {}", self.oidn.version())
    }

    /// Gives `picture` its denoised pixels, guided by its layers `albedo` and `normal` where it has both; ends soon when
    /// `is_cancelled` says so, on any thread. After an error the picture is noisy.
    pub fn denoise(
        &self,
        picture: &mut Picture,
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<(), DenoiseError> {
        picture.denoised = None;
        let region = picture.film.region;
        let size = [region.w as usize, region.h as usize];
        let mut noisy = plane(region.pixels(), |i| picture.film.mean(i))?;
        let device = self.oidn.device(self.threads, is_cancelled)?;
        let mut guides = Vec::new();
        if let Some(layers) = picture.layers.as_ref().filter(|layers| is_guide(layers)) {
            // Albedo within [0, 1] and normals within [-1, 1] whatever was averaged.
            for (name, sums, least) in
                [(c"albedo", &layers.albedo, 0.0), (c"normal", &layers.normal, -1.0)]
            {
                let n = f64::from(layers.samples.max(1));
                let mut guide = plane(region.pixels(), |i| {
                    let sum = sums.get(i).copied().unwrap_or_default();
                    sum.map(|x| (x / n).clamp(least, 1.0))
                })?;
                device.prefilter(name, &mut guide, size)?;
                guides.push((name, guide));
            }
        }
        device.filter(&mut noisy, &mut guides, size)?;
        if !noisy.as_flattened().iter().all(|x| x.is_finite()) {
            return Err(DenoiseError::NotFinite);
        }
        if let Some(layers) = picture.layers.as_ref().filter(|layers| layers.wanted.transparent) {
            // Where nothing is nothing bleeds in.
            let empty = layers.covered.iter().map(|n| *n == 0);
            noisy
                .iter_mut()
                .zip(empty)
                .filter(|(_, empty)| *empty)
                .for_each(|(p, _)| *p = [0.0; 3]);
        }
        picture.denoised = Some(Denoised { pixels: noisy, by: self.name() });
        Ok(())
    }
}

/// Whether the layers guide a denoiser.
#[must_use]
pub fn is_guide(layers: &Layers) -> bool {
    !layers.albedo.is_empty() && !layers.normal.is_empty()
}

/// `n` pixels of 32 bits, each finite.
fn plane(n: u64, of: impl Fn(usize) -> [f64; 3]) -> Result<Vec<[f32; 3]>, NoMemory> {
    let mut pixels: Vec<[f32; 3]> = zeros(n)?;
    for (i, pixel) in pixels.iter_mut().enumerate() {
        *pixel = of(i).map(single);
    }
    Ok(pixels)
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
fn single(x: f64) -> f32 {
    (x as f32).clamp(f32::MIN, f32::MAX)
}
