//! Functions of u and v become PNG files. Colours are as seen on a screen (sRGB), 0..1.

use std::path::Path;

use image::{Rgba, RgbaImage};

use super::noise::tile_fbm;

/// Red, green, blue, alpha.
pub(super) type Texel = [f64; 4];

/// A picture that is painted when it is written.
pub(super) struct Picture {
    /// File name.
    pub(super) name: &'static str,
    size: [u32; 2],
    /// u to the right, v down, both 0..1.
    texel: fn(f64, f64) -> Texel,
}

impl Picture {
    /// A picture of `size` texels.
    pub(super) const fn new(
        name: &'static str,
        size: [u32; 2],
        texel: fn(f64, f64) -> Texel,
    ) -> Self {
        Self { name, size, texel }
    }

    /// Paints it.
    pub(super) fn paint(&self) -> RgbaImage {
        let [w, h] = self.size;
        RgbaImage::from_fn(w, h, |x, y| {
            let u = (f64::from(x) + 0.5) / f64::from(w);
            let v = (f64::from(y) + 0.5) / f64::from(h);
            Rgba((self.texel)(u, v).map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8))
        })
    }

    /// Paints it into a file of `dir`.
    pub(super) fn write(&self, dir: &Path) -> std::io::Result<()> {
        let mut png = std::io::Cursor::new(Vec::new());
        self.paint().write_to(&mut png, image::ImageFormat::Png).map_err(std::io::Error::other)?;
        super::super::file::write_atomically(&dir.join(self.name), png.get_ref())
    }
}

/// A colour given as on a screen.
pub(super) const fn hex(rgb: u32) -> [f64; 3] {
    [(rgb >> 16 & 255) as f64 / 255.0, (rgb >> 8 & 255) as f64 / 255.0, (rgb & 255) as f64 / 255.0]
}

/// `a` where `t` is 0, `b` where it is 1.
pub(super) fn mix(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    let t = t.clamp(0.0, 1.0);
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t)
}

/// Without holes.
pub(super) fn opaque([r, g, b]: [f64; 3]) -> Texel {
    [r, g, b, 1.0]
}

/// The same number in all channels.
pub(super) fn grey(x: f64) -> Texel {
    [x, x, x, 1.0]
}

/// Lighter or darker.
pub(super) fn shade(c: [f64; 3], f: f64) -> [f64; 3] {
    c.map(|x| x * f)
}

/// 0 below `low`, 1 above `high`.
pub(super) fn ramp(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The normal map of a height field that repeats; `steep`: heights of a texture one unit wide.
pub(super) fn bumps(height: impl Fn(f64, f64) -> f64, u: f64, v: f64, steep: f64) -> Texel {
    let e = 1.0 / 512.0;
    let du = (height(u + e, v) - height(u - e, v)) / (2.0 * e) * steep;
    // Green is up in the image, v is down.
    let dv = (height(u, v - e) - height(u, v + e)) / (2.0 * e) * steep;
    let l = libm::sqrt(du * du + dv * dv + 1.0);
    [0.5 - 0.5 * du / l, 0.5 - 0.5 * dv / l, 0.5 + 0.5 / l, 1.0]
}

/// A cloudy pattern that repeats, 0..1, `n` clouds along each side.
pub(super) fn cloud(u: f64, v: f64, n: i64, seed: u64) -> f64 {
    tile_fbm(u, v, [n, n], seed)
}
