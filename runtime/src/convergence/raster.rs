//! Shapes → a PNG file, with smooth edges.
//!
//! Each shape is first a mask, how much of every pixel it covers, then its colour is laid over what
//! is there. Lines are covered by distance, areas by four scan lines a pixel; letters come from a
//! font that is drawn already.

use super::canvas::{Anchor, Canvas, Colour, DASH, Shape};
use image::{ExtendedColorType, ImageEncoder as _, codecs::png::PngEncoder};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// Scan lines of a pixel of an area.
const SCANS: u32 = 4;

/// The picture as a PNG file.
pub(super) fn png(canvas: &Canvas) -> Vec<u8> {
    let image = draw(canvas);
    let mut file = Vec::new();
    let side = |n: usize| u32::try_from(n).expect("a chart is small");
    let (w, h) = (side(image.width), side(image.height));
    let written =
        PngEncoder::new(&mut file).write_image(&image.bytes, w, h, ExtendedColorType::Rgb8);
    written.expect("memory takes every picture of this size");
    file
}

#[expect(clippy::cast_possible_truncation, reason = "pixels of a chart; negative ones become 0")]
fn index(x: f64) -> usize {
    x as usize
}

struct Image {
    width: usize,
    height: usize,
    bytes: Vec<u8>,
}

/// How much of every pixel is covered, from 0 to 1.
struct Mask {
    width: usize,
    height: usize,
    cover: Vec<f64>,
}

fn draw(canvas: &Canvas) -> Image {
    let (width, height) = (index(canvas.width), index(canvas.height));
    let mut image = Image { width, height, bytes: vec![255; width * height * 3] };
    for shape in &canvas.shapes {
        let mut mask = Mask { width, height, cover: vec![0.0; width * height] };
        let colour = match shape {
            Shape::Line { points, colour, width, dashed } => {
                for [a, b] in if *dashed { dashes(points) } else { pairs(points) } {
                    mask.segment(a, b, 0.5 * width);
                }
                colour
            }
            Shape::Area { points, colour } => {
                mask.polygon(points);
                colour
            }
            Shape::Dot { at, radius, colour } => {
                mask.segment(*at, *at, *radius);
                colour
            }
            Shape::Text { at, text, size, anchor, colour } => {
                mask.text(*at, text, *size, *anchor);
                colour
            }
        };
        image.lay(&mask, *colour);
    }
    image
}

impl Image {
    fn lay(&mut self, mask: &Mask, colour: Colour) {
        debug_assert_eq!((self.width, self.height), (mask.width, mask.height));
        let covered = self.bytes.chunks_exact_mut(3).zip(&mask.cover).filter(|(_, c)| **c > 0.0);
        for (pixel, cover) in covered {
            let share = cover * colour.1;
            for (byte, new) in pixel.iter_mut().zip(colour.0) {
                let mixed = f64::from(*byte) * (1.0 - share) + f64::from(new) * share;
                #[expect(clippy::cast_possible_truncation, reason = "between two bytes")]
                let rounded = mixed.round() as u8;
                *byte = rounded;
            }
        }
    }
}

impl Mask {
    /// Pixels whose centres lie between, widened to whole pixels inside the picture.
    fn rows_and_columns(&self, lo: [f64; 2], hi: [f64; 2]) -> [std::ops::Range<usize>; 2] {
        let range = |lo: f64, hi: f64, n: usize| index(lo.floor())..(index(hi.ceil()) + 1).min(n);
        [range(lo[1], hi[1], self.height), range(lo[0], hi[0], self.width)]
    }

    /// Everything at most `radius` away from the segment.
    fn segment(&mut self, a: [f64; 2], b: [f64; 2], radius: f64) {
        let reach = radius + 1.0;
        let lo = [a[0].min(b[0]) - reach, a[1].min(b[1]) - reach];
        let hi = [a[0].max(b[0]) + reach, a[1].max(b[1]) + reach];
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let square = (dx * dx + dy * dy).max(1e-12);
        let [rows, columns] = self.rows_and_columns(lo, hi);
        for y in rows {
            for x in columns.clone() {
                let [px, py] = [x as f64 + 0.5 - a[0], y as f64 + 0.5 - a[1]];
                let t = ((px * dx + py * dy) / square).clamp(0.0, 1.0);
                let distance = (px - t * dx).hypot(py - t * dy);
                let cover = (radius + 0.5 - distance).clamp(0.0, 1.0);
                let at = &mut self.cover[y * self.width + x];
                *at = at.max(cover);
            }
        }
    }

    /// The inside, by the even-odd rule.
    fn polygon(&mut self, points: &[[f64; 2]]) {
        for scan in 0..u32::try_from(self.height).unwrap_or(0) * SCANS {
            let y = (f64::from(scan) + 0.5) / f64::from(SCANS);
            let mut edges = pairs(points);
            if let (Some(first), Some(last)) = (points.first(), points.last()) {
                edges.push([*last, *first]);
            }
            let crossing = |[a, b]: &[[f64; 2]; 2]| {
                let crosses = (a[1] <= y) != (b[1] <= y);
                crosses.then(|| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            };
            let mut xs: Vec<f64> = edges.iter().filter_map(crossing).collect();
            xs.sort_by(f64::total_cmp);
            let row = scan as usize / SCANS as usize * self.width;
            for span in xs.chunks_exact(2) {
                for x in index(span[0])..(index(span[1]) + 1).min(self.width) {
                    let part = span[1].min(x as f64 + 1.0) - span[0].max(x as f64);
                    self.cover[row + x] += part.clamp(0.0, 1.0) / f64::from(SCANS);
                }
            }
        }
    }

    fn text(&mut self, at: [f64; 2], text: &str, size: u32, anchor: Anchor) {
        let height = match size {
            ..=16 => RasterHeight::Size16,
            17..=20 => RasterHeight::Size20,
            _ => RasterHeight::Size24,
        };
        let step = get_raster_width(FontWeight::Regular, height);
        let length = (step * text.chars().count()) as f64;
        let shift = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * length,
            Anchor::End => length,
        };
        // The base line of the font is at 0.77 of its height.
        let top = index((at[1] - 0.77 * height.val() as f64).round());
        let left = index((at[0] - shift).round());
        for (i, letter) in text.chars().enumerate() {
            let glyph = get_raster(letter, FontWeight::Regular, height)
                .or_else(|| get_raster('?', FontWeight::Regular, height));
            let rows = glyph.iter().flat_map(noto_sans_mono_bitmap::RasterizedChar::rows);
            for (y, row) in (top..self.height).zip(rows) {
                for (x, cover) in (left + i * step..self.width).zip(row) {
                    self.cover[y * self.width + x] = f64::from(*cover) / 255.0;
                }
            }
        }
    }
}

fn pairs(points: &[[f64; 2]]) -> Vec<[[f64; 2]; 2]> {
    points.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The dashes of a polyline; the pattern goes on around its corners.
fn dashes(points: &[[f64; 2]]) -> Vec<[[f64; 2]; 2]> {
    let mut list = Vec::new();
    let (mut drawn, mut left) = (true, DASH[0]);
    for [a, b] in pairs(points) {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let at = |s: f64| [0, 1].map(|i| a[i] + (b[i] - a[i]) * s / length.max(1e-9));
        let mut from = 0.0;
        while from < length {
            let to = length.min(from + left);
            if drawn {
                list.push([at(from), at(to)]);
            }
            left -= to - from;
            if left <= 0.0 {
                drawn = !drawn;
                left = DASH[usize::from(!drawn)];
            }
            from = to;
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: Colour = Colour([0; 3], 1.0);

    /// Sum of darkness in whole pixels.
    fn ink(canvas: &Canvas) -> f64 {
        let image = draw(canvas);
        image.bytes.chunks_exact(3).map(|p| f64::from(255 - p[0]) / 255.0).sum()
    }

    fn with(shape: Shape) -> Canvas {
        Canvas { shapes: vec![shape], ..Canvas::new(64.0, 48.0) }
    }

    #[test]
    fn shapes_have_the_area_that_they_should_have() {
        let triangle = vec![[10.3, 10.2], [50.3, 10.2], [10.3, 40.2]];
        let area = ink(&with(Shape::Area { points: triangle, colour: BLACK }));
        assert!((area - 600.0).abs() < 3.0, "{area}");
        let dot = ink(&with(Shape::Dot { at: [30.4, 20.7], radius: 8.0, colour: BLACK }));
        assert!((dot - 201.0).abs() < 4.0, "{dot}");
        let points = vec![[5.0, 20.0], [59.0, 20.0]];
        let (colour, width) = (BLACK, 3.0);
        let whole = Shape::Line { points: points.clone(), colour, width, dashed: false };
        let whole = ink(&with(whole));
        assert!((whole - 169.0).abs() < 4.0, "{whole}");
        let dashed = ink(&with(Shape::Line { points, colour, width, dashed: true }));
        assert!(dashed > 0.5 * whole && dashed < 0.95 * whole, "{dashed}");
    }

    #[test]
    fn text_is_drawn_at_the_end_it_is_anchored_to() {
        let text = |anchor| {
            let text = "11".to_owned();
            let canvas =
                with(Shape::Text { at: [32.0, 24.0], text, size: 16, anchor, colour: BLACK });
            let image = draw(&canvas);
            let dark = |x: usize| (0..48).any(|y| image.bytes[(y * 64 + x) * 3] < 128);
            ((0..32).any(dark), (32..64).any(dark))
        };
        assert_eq!(text(Anchor::Start), (false, true));
        assert_eq!(text(Anchor::End), (true, false));
        assert_eq!(text(Anchor::Middle), (true, true));
    }

    #[test]
    fn what_leaves_the_picture_is_cut() {
        let points = vec![[-20.0, -20.0], [90.0, 70.0]];
        assert!(ink(&with(Shape::Line { points, colour: BLACK, width: 2.0, dashed: true })) > 0.0);
        let text = "far out".to_owned();
        let (at, anchor) = ([60.0, 46.0], Anchor::Start);
        assert!(ink(&with(Shape::Text { at, text, size: 24, anchor, colour: BLACK })) > 0.0);
    }
}
