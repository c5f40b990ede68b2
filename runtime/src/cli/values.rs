//! Texts of flags → sizes, ranges, numbers and times.

use crate::region::{Rect, SampleRange};
use std::time::Duration;

pub(super) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let size = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    size.filter(|size: &[u32; 2]| !size.contains(&0)).ok_or("write it as 640x360".to_owned())
}

pub(super) fn parse_pixel(text: &str) -> Result<[u32; 2], String> {
    let pixel = text.split_once(',').and_then(|(x, y)| Some([x.parse().ok()?, y.parse().ok()?]));
    pixel.ok_or("write it as x,y in pixels".to_owned())
}

pub(super) fn parse_rect(text: &str) -> Result<Rect, String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(str::parse).collect();
    match numbers.as_deref() {
        Ok(&[x, y, w, h]) if w > 0 && h > 0 => Ok(Rect { x, y, w, h }),
        _ => Err("write it as x,y,width,height in pixels".to_owned()),
    }
}

pub(super) fn parse_samples(text: &str) -> Result<SampleRange, String> {
    text.split_once("..")
        .and_then(|(start, end)| SampleRange::new(start.parse().ok()?, end.parse().ok()?))
        .ok_or(
            "write it as 0..32: from the first index up to, not including, the second".to_owned(),
        )
}

pub(super) fn parse_clamp(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(most) if most > 0.0 && most < f32::INFINITY => Ok(most),
        _ => Err("a number above 0, such as 10".to_owned()),
    }
}

pub(super) fn parse_threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n @ 1..=4096) => Ok(n),
        _ => Err("a number from 1 to 4096".to_owned()),
    }
}

/// How often a run is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Every {
    Never,
    After(Duration),
}

pub(super) fn parse_every(text: &str) -> Result<Every, String> {
    match text {
        "never" => Ok(Every::Never),
        time => parse_duration(time)
            .map(Every::After)
            .map_err(|_| "write it as 60s, 5m or never".to_owned()),
    }
}

/// `90`, `90s`, `1.5m`, `1m30s`, `500ms`, `2h`.
pub(super) fn parse_duration(text: &str) -> Result<Duration, String> {
    let wrong = || "write it as 60s, 1m30s, 500ms or 2h".to_owned();
    let (mut rest, mut seconds) = (text, 0.0);
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let (number, tail) = rest.split_at(digits);
        let letters = tail.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(tail.len());
        let (unit, tail) = tail.split_at(letters);
        let scale = match unit {
            "" | "s" => 1.0,
            "ms" => 1e-3,
            "m" | "min" => 60.0,
            "h" => 3600.0,
            _ => return Err(wrong()),
        };
        seconds += number.parse::<f64>().map_err(|_| wrong())? * scale;
        rest = tail;
    }
    Duration::try_from_secs_f64(seconds).ok().filter(|d| !d.is_zero()).ok_or_else(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_read_and_nonsense_is_refused() {
        for (text, seconds) in [
            ("60s", 60.0),
            ("90", 90.0),
            ("1m30s", 90.0),
            ("500ms", 0.5),
            ("1.5m", 90.0),
            ("2h", 7200.0),
        ] {
            assert_eq!(parse_duration(text), Ok(Duration::from_secs_f64(seconds)), "{text}");
        }
        for text in ["", "s", "60x", "-1s", "0s", "1..2s", "1e9s", "999999999999999999999h"] {
            assert!(parse_duration(text).is_err(), "{text}");
        }
    }

    #[test]
    fn checkpoints_are_made_after_a_time_or_never() {
        assert_eq!(parse_every("never"), Ok(Every::Never));
        assert_eq!(parse_every("5m"), Ok(Every::After(Duration::from_mins(5))));
        for text in ["", "no", "0s", "soon"] {
            assert!(parse_every(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_crops_and_samples_are_read_and_nonsense_is_refused() {
        assert_eq!(parse_size("640x360"), Ok([640, 360]));
        assert_eq!(parse_rect("1,2,3,4"), Ok(Rect { x: 1, y: 2, w: 3, h: 4 }));
        assert_eq!(parse_samples("16..32"), Ok(SampleRange { start: 16, end: 32 }));
        for text in ["", "640", "0x5", "5x-1", "axb", "1x2x3", "99999999999x1"] {
            assert!(parse_size(text).is_err(), "{text}");
        }
        for text in ["", "1,2,3", "1,2,0,4", "1,2,3,4,5", "-1,2,3,4"] {
            assert!(parse_rect(text).is_err(), "{text}");
        }
        for text in ["", "32", "5..5", "9..3", "a..b", "0..99999999999"] {
            assert!(parse_samples(text).is_err(), "{text}");
        }
    }
}
