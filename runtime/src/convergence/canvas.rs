//! Shapes → an SVG document. Units are pixels, origin top left.

use std::fmt::Write as _;

/// Red, green and blue as in sRGB, and opacity from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Colour(pub(super) [u8; 3], pub(super) f64);

impl Colour {
    fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Which end of a text its place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Something to draw.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    /// A polyline.
    Line { points: Vec<[f64; 2]>, colour: Colour, width: f64, dashed: bool },
    /// A filled polygon.
    Area { points: Vec<[f64; 2]>, colour: Colour },
    /// A disc.
    Dot { at: [f64; 2], radius: f64, colour: Colour },
    /// A line of text; `at` is on its base line, `size` in pixels.
    Text { at: [f64; 2], text: String, size: u32, anchor: Anchor, colour: Colour },
}

/// Length of a dash and of the gap after it.
pub(super) const DASH: [f64; 2] = [9.0, 6.0];

/// A picture of shapes, drawn in order over white.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Canvas {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) shapes: Vec<Shape>,
}

impl Canvas {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Self { width, height, shapes: Vec::new() }
    }

    pub(super) fn line(&mut self, points: Vec<[f64; 2]>, colour: Colour, width: f64, dashed: bool) {
        self.shapes.push(Shape::Line { points, colour, width, dashed });
    }

    pub(super) fn area(&mut self, points: Vec<[f64; 2]>, colour: Colour) {
        self.shapes.push(Shape::Area { points, colour });
    }

    pub(super) fn dot(&mut self, at: [f64; 2], radius: f64, colour: Colour) {
        self.shapes.push(Shape::Dot { at, radius, colour });
    }

    pub(super) fn text(
        &mut self,
        at: [f64; 2],
        text: &str,
        size: u32,
        anchor: Anchor,
        colour: Colour,
    ) {
        self.shapes.push(Shape::Text { at, text: text.to_owned(), size, anchor, colour });
    }

    /// The document.
    pub(super) fn svg(&self) -> String {
        let (w, h) = (self.width, self.height);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" \
             viewBox=\"0 0 {w} {h}\" font-family=\"Noto Sans Mono, DejaVu Sans Mono, monospace\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n"
        );
        for shape in &self.shapes {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{}", element(shape));
        }
        out + "</svg>\n"
    }
}

fn element(shape: &Shape) -> String {
    match shape {
        Shape::Line { points, colour, width, dashed } => {
            let dash = if *dashed {
                format!(" stroke-dasharray=\"{} {}\"", DASH[0], DASH[1])
            } else {
                String::new()
            };
            format!(
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"{dash}/>",
                list(points),
                colour.hex(),
            )
        }
        Shape::Area { points, colour } => format!(
            "<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>",
            list(points),
            colour.hex(),
            colour.1,
        ),
        Shape::Dot { at: [x, y], radius, colour } => {
            format!(
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{}\"/>",
                colour.hex()
            )
        }
        Shape::Text { at: [x, y], text, size, anchor, colour } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            format!(
                "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
                 fill=\"{}\">{}</text>",
                colour.hex(),
                escaped(text),
            )
        }
    }
}

fn list(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

/// Titles are names of files: strangers' text.
fn escaped(text: &str) -> String {
    let text: String = text.chars().filter(|c| !c.is_control()).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_become_markup() {
        let mut canvas = Canvas::new(10.0, 10.0);
        let black = Colour([0; 3], 1.0);
        canvas.text([0.0, 0.0], "<script>&\"\u{7}", 16, Anchor::Start, black);
        assert!(canvas.svg().contains(">&lt;script&gt;&amp;&quot;</text>"));
    }
}
