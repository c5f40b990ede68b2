//! An error curve → a chart: error over seconds with its interval, and below it the figure of merit.
//!
//! Both axes of the upper panel are logarithmic, so that an error that falls with a power of time is
//! a straight line. This module lays shapes out; `canvas` makes SVG of them, `raster` PNG.

use super::canvas::{Anchor, Canvas, Colour};
use super::goal::Quantity;
use super::raster;
use super::track::{Convergence, Point, digits};

const WIDTH: f64 = 1200.0;
const HEIGHT: f64 = 900.0;
/// Between two labels of samples, in pixels.
const LABEL_GAP: f64 = 52.0;

const INK: Colour = Colour([0x22, 0x22, 0x22], 1.0);
const GREY: Colour = Colour([0x66, 0x66, 0x66], 1.0);
const GRID: Colour = Colour([0xe2, 0xe2, 0xe2], 1.0);
const GUIDE: Colour = Colour([0xa0, 0xa0, 0xa0], 1.0);
const CURVE: Colour = Colour([0x1f, 0x5f, 0xb4], 1.0);
const BAND: Colour = Colour([0x1f, 0x5f, 0xb4], 0.22);
const TRUTH: Colour = Colour([0xc0, 0x4a, 0x00], 1.0);
const GOAL: Colour = Colour([0x1a, 0x7f, 0x37], 1.0);

/// The chart as an SVG document.
#[must_use]
pub fn chart_svg(title: &str, convergence: &Convergence) -> String {
    chart(title, convergence).svg()
}

/// The chart as a PNG file.
#[must_use]
pub fn chart_png(title: &str, convergence: &Convergence) -> Vec<u8> {
    raster::png(&chart(title, convergence))
}

/// A rectangle of the chart and what its edges mean. Logarithms are to base 10.
struct Panel {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    x: [f64; 2],
    y: [f64; 2],
}

impl Panel {
    fn px(&self, x: f64) -> f64 {
        self.left + (x - self.x[0]) / (self.x[1] - self.x[0]) * (self.right - self.left)
    }

    fn py(&self, y: f64) -> f64 {
        self.bottom - (y - self.y[0]) / (self.y[1] - self.y[0]) * (self.bottom - self.top)
    }

    fn at(&self, x: f64, y: f64) -> [f64; 2] {
        [self.px(x), self.py(y)]
    }

    fn frame(&self, canvas: &mut Canvas) {
        let [l, r, t, b] = [self.left, self.right, self.top, self.bottom];
        canvas.line(vec![[l, t], [l, b], [r, b], [r, t], [l, t]], GREY, 1.0, false);
    }

    /// Lines and labels of a logarithmic axis in seconds.
    fn seconds(&self, canvas: &mut Canvas) {
        for value in ticks(self.x) {
            let x = self.px(value.log10());
            canvas.line(vec![[x, self.top], [x, self.bottom]], GRID, 1.0, false);
            canvas.text([x, self.bottom + 20.0], &short(value), 16, Anchor::Middle, INK);
        }
        let name = "seconds of rendering";
        canvas.text([self.right, self.bottom + 42.0], name, 16, Anchor::End, GREY);
    }

    /// A line through `(x, y)` with this slope, clipped to the panel.
    fn guide(&self, canvas: &mut Canvas, through: [f64; 2], slope: f64, name: &str) {
        let y = |x: f64| through[1] + slope * (x - through[0]);
        let x = |y: f64| through[0] + (y - through[1]) / slope;
        let from = self.x[0].max(x(self.y[1]));
        let to = self.x[1].min(x(self.y[0]));
        if from < to {
            let start = self.at(from, y(from));
            canvas.line(vec![start, self.at(to, y(to))], GUIDE, 1.5, true);
            // Below the flatter one, right of the steeper one.
            let [dx, dy] = if slope > -0.6 { [6.0, 36.0] } else { [38.0, 16.0] };
            canvas.text([start[0] + dx, start[1] + dy], name, 16, Anchor::Start, GREY);
        }
    }
}

/// The points that have a place on a logarithmic chart.
fn visible(convergence: &Convergence) -> Vec<&Point> {
    let shown = |point: &&Point| point.t_render > 0.0 && point.noise.rel > 0.0;
    convergence.points.iter().filter(shown).collect()
}

fn chart(title: &str, convergence: &Convergence) -> Canvas {
    let mut canvas = Canvas::new(WIDTH, HEIGHT);
    let heading = format!("{title}: error against time of rendering");
    canvas.text([90.0, 34.0], &heading, 24, Anchor::Start, INK);
    let points = visible(convergence);
    let Some(last) = points.last() else {
        canvas.text([90.0, 120.0], "no error: all replicates are equal", 20, Anchor::Start, INK);
        return canvas;
    };
    canvas.text([90.0, 60.0], &headline(last), 16, Anchor::Start, GREY);
    let seconds = extent(points.iter().map(|p| p.t_render.log10()), 0.03);
    errors(&mut canvas, convergence, &points, seconds);
    merits(&mut canvas, &points, seconds);
    canvas
}

fn headline(last: &Point) -> String {
    let noise = last.noise;
    let tail = if noise.is_heavy_tailed() { "; heavy tail: a lower bound" } else { "" };
    let slope = last.slope.map_or(String::new(), |slope| format!(", slope {slope:.2}"));
    format!(
        "{} % [{}, {}] after {} s and {} spp{slope}; 1 % in ~{} s{tail}",
        digits(100.0 * noise.rel, 3),
        digits(100.0 * noise.rel_lo, 3),
        digits(100.0 * noise.rel_hi, 3),
        digits(last.t_render, 3),
        last.spp,
        digits(last.ttu(), 2),
    )
}

/// The upper panel.
fn errors(canvas: &mut Canvas, convergence: &Convergence, points: &[&Point], x: [f64; 2]) {
    let goal = convergence.goal;
    let goals = goal.iter().map(|goal| goal.limit.log10());
    let ends = points.iter().flat_map(|p| [p.noise.rel_lo, p.noise.rel_hi, p.noise.rel]);
    let truths = points.iter().filter_map(|p| p.versus.map(|v| v.rel));
    let local = goal.is_some_and(|goal| goal.quantity == Quantity::P95);
    let locals = points.iter().filter(|_| local).map(|p| p.noise.p95);
    let values = ends.chain(truths).chain(locals).filter(|y| *y > 0.0 && y.is_finite());
    let y = extent(values.map(f64::log10).chain(goals), 0.06);
    let panel = Panel { left: 90.0, right: 1170.0, top: 80.0, bottom: 560.0, x, y };
    panel.seconds(canvas);
    for value in ticks(y) {
        let at = panel.py(value.log10());
        canvas.line(vec![[panel.left, at], [panel.right, at]], GRID, 1.0, false);
        let label = format!("{} %", short(100.0 * value));
        canvas.text([panel.left - 8.0, at + 5.0], &label, 16, Anchor::End, INK);
    }
    let last = points[points.len() - 1];
    let end = [last.t_render.log10(), last.noise.rel.log10()];
    panel.guide(canvas, end, -0.5, "t^-1/2");
    panel.guide(canvas, end, -0.75, "t^-3/4");
    let mut key = vec![(CURVE, "relative error, with its 95 % interval")];
    let curve = |f: &dyn Fn(&Point) -> f64| -> Vec<[f64; 2]> {
        let place = |p: &&Point| panel.at(p.t_render.log10(), f(p).log10().clamp(y[0], y[1]));
        points.iter().map(place).collect()
    };
    let mut band = curve(&|p| p.noise.rel_hi);
    band.extend(curve(&|p| p.noise.rel_lo).into_iter().rev());
    canvas.area(band, BAND);
    if let Some(goal) = goal {
        let at = panel.py(goal.limit.log10());
        canvas.line(vec![[panel.left, at], [panel.right, at]], GOAL, 2.0, true);
        key.push((GOAL, "goal"));
    }
    if local {
        canvas.line(curve(&|p| p.noise.p95), GREY, 2.0, false);
        key.push((GREY, "95th percentile of the pixels' errors"));
    }
    if points.iter().all(|p| p.versus.is_some()) {
        canvas.line(curve(&|p| p.versus.map_or(0.0, |v| v.rel)), TRUTH, 2.5, true);
        key.push((TRUTH, "error against the reference"));
    }
    let estimate = curve(&|p| p.noise.rel);
    canvas.line(estimate.clone(), CURVE, 2.5, false);
    spp_labels(canvas, points, &estimate);
    panel.frame(canvas);
    for (i, (colour, name)) in (0_u32..).zip(key) {
        let at = panel.top + 24.0 + 24.0 * f64::from(i);
        canvas.line(vec![[720.0, at - 5.0], [756.0, at - 5.0]], colour, 3.0, false);
        canvas.text([766.0, at], name, 16, Anchor::Start, INK);
    }
}

/// A dot at every point, its samples above where there is room; those of the last one below.
fn spp_labels(canvas: &mut Canvas, points: &[&Point], places: &[[f64; 2]]) {
    let end = places.last().map_or(0.0, |place| place[0]);
    let mut free = 0.0;
    for (i, (point, place)) in points.iter().zip(places).enumerate() {
        canvas.dot(*place, 4.0, CURVE);
        let is_last = i + 1 == places.len();
        if is_last || (place[0] >= free && place[0] < end - LABEL_GAP) {
            let unit = if i == 0 || is_last { " spp" } else { "" };
            let text = format!("{}{unit}", point.spp);
            let (dx, dy, anchor) =
                if is_last { (6.0, 26.0, Anchor::End) } else { (2.0, -14.0, Anchor::Start) };
            canvas.text([place[0] + dx, place[1] + dy], &text, 16, anchor, CURVE);
            free = place[0] + LABEL_GAP + if i == 0 { 30.0 } else { 0.0 };
        }
    }
}

/// The lower panel.
fn merits(canvas: &mut Canvas, points: &[&Point], x: [f64; 2]) {
    let most = points.iter().map(|p| p.fom()).fold(0.0, f64::max);
    let step = nice(most / 3.0);
    let y = [0.0, most * 1.12];
    let panel = Panel { left: 90.0, right: 1170.0, top: 640.0, bottom: 840.0, x, y };
    panel.seconds(canvas);
    let mut value = 0.0;
    while value <= y[1] {
        let at = panel.py(value);
        canvas.line(vec![[panel.left, at], [panel.right, at]], GRID, 1.0, false);
        canvas.text([panel.left - 8.0, at + 5.0], &short(value), 16, Anchor::End, INK);
        value += step;
    }
    let name = "figure of merit 1 / (rel^2 t), 1/s: flat is Monte Carlo, rising is better";
    canvas.text([panel.left, panel.top - 10.0], name, 16, Anchor::Start, INK);
    let places: Vec<_> = points.iter().map(|p| panel.at(p.t_render.log10(), p.fom())).collect();
    canvas.line(places.clone(), CURVE, 2.5, false);
    for place in places {
        canvas.dot(place, 4.0, CURVE);
    }
    panel.frame(canvas);
}

/// Smallest and largest, with a margin, at least a factor of 2 apart.
fn extent(values: impl Iterator<Item = f64>, margin: f64) -> [f64; 2] {
    let (lo, hi) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
    let room = (margin * (hi - lo)).max(0.0) + (0.15 - 0.5 * (hi - lo)).max(0.0);
    [lo - room, hi + room]
}

/// 1, 2 and 5 of every decade between the logarithms; over four decades only 1.
fn ticks([lo, hi]: [f64; 2]) -> Vec<f64> {
    #[expect(clippy::cast_possible_truncation, reason = "decades of seconds and of errors")]
    let (first, last) = (lo.floor() as i32, hi.ceil() as i32);
    let steps: &[f64] = if hi - lo > 4.0 { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let all = (first..=last).flat_map(|k| steps.iter().map(move |s| s * 10_f64.powi(k)));
    all.filter(|v| (lo..=hi).contains(&v.log10())).collect()
}

/// The next of 1, 2, 5 times a power of ten.
fn nice(step: f64) -> f64 {
    let decade = 10_f64.powf(step.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|s| s * decade).find(|s| *s >= step).unwrap_or(step)
}

/// A tick's number.
fn short(value: f64) -> String {
    let text = digits(value, 3);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::super::Times;
    use super::*;

    #[test]
    fn ticks_are_one_two_and_five() {
        let values = ticks([-1.0, 0.8]);
        let expected = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0];
        assert!(values.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{values:?}");
        assert_eq!(values.len(), 6);
        assert_eq!((nice(130.0), nice(0.4), nice(7.0)), (200.0, 0.5, 10.0));
        assert_eq!(
            (short(0.5), short(20.0), short(1000.0)),
            ("0.5".into(), "20".into(), "1000".into())
        );
    }

    #[test]
    fn a_chart_without_errors_says_so() {
        let empty = Convergence { points: Vec::new(), times: Times::default(), goal: None };
        assert!(chart_svg("black", &empty).contains("no error"));
    }
}
