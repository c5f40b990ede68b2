//! Luminaire files (IES, LM-63) become an image of what a lamp sends in each direction.
//!
//! Columns are horizontal angles, 0 to 360 degrees, or one for a lamp that is the same all around; rows are vertical
//! angles from the beam, 0 to 180 degrees. Values are thousands of candelas. Source: ANSI/IES LM-63-19, and its
//! forerunners of 1986 to 2002, of which only the first lines differ.

use super::format::{checked_size, kept};
use super::texels::HalfImage;
use crate::import::error::{ErrorKind, ImportError};
use crate::import::file::Limits;

/// Rows: half a degree each.
const ROWS: u32 = 360;
/// Columns of a lamp that is not the same all around: two degrees each.
const COLUMNS: u32 = 180;
/// Candelas of the value 1.
const UNIT: f64 = 1000.0;

/// Width and height of the image.
pub(super) fn size(bytes: &[u8], place: &str, limits: &Limits) -> Result<[u32; 2], ImportError> {
    let [width, height] = Profile::read(bytes, place)?.size();
    checked_size(width, height, place, limits)
}

/// Reads a whole file.
pub(super) fn decode(bytes: &[u8], place: &str, limits: &Limits) -> Result<HalfImage, ImportError> {
    let profile = Profile::read(bytes, place)?;
    let [width, height] = profile.size();
    let size = checked_size(width, height, place, limits)?;
    let kept = kept(size, 8, place, limits)?;
    let mut image = HalfImage::new(size).check(place)?;
    let middle = |i: u32, n: u32| (f64::from(i) + 0.5) / f64::from(n);
    for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
        let (vertical, horizontal) = (180.0 * middle(row, height), 360.0 * middle(column, width));
        #[expect(
            clippy::cast_possible_truncation,
            reason = "rounds, and it is half floats that are kept"
        )]
        let value = (profile.candelas(vertical, horizontal) / UNIT) as f32;
        image.set((row * width + column) as usize, [value, value, value, 1.0]);
    }
    kept.keep();
    Ok(image)
}

/// Luminous intensity by direction, as the file has it.
struct Profile {
    /// Degrees from the beam, rising.
    vertical: Vec<f64>,
    /// Degrees around it, rising.
    horizontal: Vec<f64>,
    /// Candelas, all vertical angles of the first horizontal one, then of the next.
    values: Vec<f64>,
}

impl Profile {
    fn read(bytes: &[u8], place: &str) -> Result<Self, ImportError> {
        let wrong = |message: String| ImportError::new(ErrorKind::Image, place, message);
        let text = String::from_utf8_lossy(bytes);
        let (_, rest) = text.split_once("TILT=").ok_or_else(|| {
            wrong(
                "this luminaire file has no line `TILT=`, after which its numbers begin".to_owned(),
            )
        })?;
        let (tilt, rest) = rest.split_once('\n').unwrap_or((rest, ""));
        let mut numbers = Numbers { left: rest, place };
        match tilt.trim() {
            "NONE" => {}
            "INCLUDE" => {
                // How the lamp fades when it is tilted: here it hangs as it was measured.
                numbers.next("the lamp's position")?;
                let n = numbers.count("the number of tilts")?;
                numbers.list(2 * n, "tilts")?;
            }
            _ => {
                return Err(wrong("its tilts are in another file".to_owned())
                    .with_help("write `TILT=NONE`: the lamp hangs as it was measured"));
            }
        }
        numbers.list(2, "lamps")?;
        let factor = numbers.next("the multiplier")?;
        let n_vertical = numbers.count("the number of vertical angles")?;
        let n_horizontal = numbers.count("the number of horizontal angles")?;
        if numbers.next("the photometric type")?.to_bits() != 1.0_f64.to_bits() {
            return Err(wrong("its photometry is not of type C".to_owned())
                .with_help("export it as type C, which nearly all luminaires are"));
        }
        // Units, three dimensions; the ballast's factor, one for future use, watts.
        numbers.list(4, "dimensions")?;
        let (ballast, future) = (numbers.next("the ballast factor")?, numbers.next("a factor")?);
        numbers.next("the watts")?;
        let factor = factor * ballast * future;
        let vertical = numbers.list(n_vertical, "vertical angles")?;
        let horizontal = numbers.list(n_horizontal, "horizontal angles")?;
        let values = numbers.list(n_vertical.saturating_mul(n_horizontal), "candelas")?;
        let values: Vec<f64> = values.into_iter().map(|value| value * factor).collect();
        if values.iter().any(|value| !(0.0..=1e12).contains(value)) {
            return Err(wrong("one of its intensities is negative or too large".to_owned()));
        }
        let rises = |angles: &[f64]| angles.windows(2).all(|pair| pair[0] < pair[1]);
        if !rises(&vertical) || !rises(&horizontal) {
            return Err(wrong("its angles do not rise".to_owned()));
        }
        let profile = Self { vertical, horizontal, values };
        if profile.fold(0.0).is_none() {
            let [first, last] = profile.ends();
            let message = format!("its horizontal angles go from {first} to {last} degrees");
            let help = "they begin at 0 and end at 0, 90, 180 or 360, or go from 90 to 270";
            return Err(wrong(message).with_help(help));
        }
        Ok(profile)
    }

    fn size(&self) -> [u32; 2] {
        [if self.horizontal.len() == 1 { 1 } else { COLUMNS }, ROWS]
    }

    /// First and last horizontal angle.
    fn ends(&self) -> [f64; 2] {
        [self.horizontal.first(), self.horizontal.last()].map(|end| end.copied().unwrap_or(0.0))
    }

    /// The angle in the file that stands for `angle`, 0 ..= 360: lamps that are symmetrical are measured in part.
    fn fold(&self, angle: f64) -> Option<f64> {
        match self.ends() {
            _ if self.horizontal.len() == 1 => Some(self.ends()[0]),
            [0.0, 90.0] => Some(90.0 - (90.0 - angle % 180.0).abs()),
            [0.0, 180.0] => Some(180.0 - (180.0 - angle).abs()),
            [90.0, 270.0] => {
                let mirrored = (540.0 - angle) % 360.0;
                Some(if (90.0..=270.0).contains(&angle) { angle } else { mirrored })
            }
            // The last one may be left out, because it is the first.
            [0.0, last] if last > 180.0 && last <= 360.0 => Some(angle),
            _ => None,
        }
    }

    /// Between the angles of the file, in proportion; 0 where it has no vertical angle.
    fn candelas(&self, vertical: f64, horizontal: f64) -> f64 {
        let Some((row, along)) = between(&self.vertical, vertical) else { return 0.0 };
        let horizontal = self.fold(horizontal).unwrap_or(0.0);
        let n = self.horizontal.len();
        let [first, last] = self.ends();
        let (column, next, around) = match between(&self.horizontal, horizontal) {
            Some((column, around)) => (column, (column + 1).min(n - 1), around),
            // Between the last and the first.
            None => (n - 1, 0, (horizontal - last) / (first + 360.0 - last)),
        };
        let at = |column: usize| {
            let column = &self.values[column * self.vertical.len()..][..self.vertical.len()];
            let below = column[(row + 1).min(column.len() - 1)];
            column[row] * (1.0 - along) + below * along
        };
        at(column) * (1.0 - around) + at(next) * around
    }
}

/// The last of the rising `angles` that is not above `angle`, and how far that is on the way to the next, 0 ..= 1.
fn between(angles: &[f64], angle: f64) -> Option<(usize, f64)> {
    let after = angles.partition_point(|known| *known <= angle);
    let before = after.checked_sub(1)?;
    match angles.get(after) {
        Some(next) => Some((before, (angle - angles[before]) / (next - angles[before]))),
        None => (angle <= angles[before]).then_some((before, 0.0)),
    }
}

/// The numbers of a file, which stand between blanks, commas or ends of lines.
struct Numbers<'a> {
    left: &'a str,
    place: &'a str,
}

impl Numbers<'_> {
    fn next(&mut self, what: &str) -> Result<f64, ImportError> {
        let is_between = |c: char| c.is_whitespace() || c == ',';
        let text = self.left.trim_start_matches(is_between);
        let (word, left) = text.split_at(text.find(is_between).unwrap_or(text.len()));
        self.left = left;
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| {
            let message = match word {
                "" => format!("this luminaire file ends before {what}"),
                // Nothing of it is shown: a scene may name any file of its reader.
                _ => format!("this luminaire file has no number for {what}"),
            };
            ImportError::new(ErrorKind::Image, self.place, message)
        })
    }

    fn list(&mut self, n: usize, what: &str) -> Result<Vec<f64>, ImportError> {
        (0..n).map(|_| self.next(what)).collect()
    }

    /// A number of things, at least one, of which each takes two bytes.
    fn count(&mut self, what: &str) -> Result<usize, ImportError> {
        let number = self.next(what)?;
        let most = self.left.len() as f64;
        if number >= 1.0 && number <= most && number.fract() == 0.0 {
            #[expect(clippy::cast_possible_truncation, reason = "a whole number up to a length")]
            return Ok(number as usize);
        }
        let message = format!("{what} of this luminaire file is wrong, or it is cut off");
        Err(ImportError::new(ErrorKind::Image, self.place, message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn profile(horizontal: &str, values: &str) -> Profile {
        let n = horizontal.split(' ').count();
        let text = format!(
            "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 2 3 {n} 1 2 0 0 0\n0.5 1 60\n0 45 90\n{horizontal}\n{values}\n"
        );
        Profile::read(text.as_bytes(), "a.ies").expect("sound")
    }

    #[track_caller]
    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
    }

    #[test]
    fn values_are_read_between_angles_and_nothing_shines_beyond_them() {
        let lamp = profile("0", "100 50 10");
        close(lamp.candelas(0.0, 300.0), 100.0);
        close(lamp.candelas(22.5, 10.0), 75.0);
        close(lamp.candelas(90.0, 10.0), 10.0);
        close(lamp.candelas(90.5, 10.0), 0.0);
    }

    #[test]
    fn symmetrical_lamps_are_unfolded() {
        let quarter = profile("0 90", "100 100 100, 20 20 20");
        for (around, expected) in [(0.0, 100.0), (90.0, 20.0), (135.0, 60.0), (180.0, 100.0)] {
            close(quarter.candelas(10.0, around), expected);
            close(quarter.candelas(10.0, 360.0 - around), expected);
        }
        let half = profile("0 180", "100 100 100 20 20 20");
        for (around, expected) in [(0.0, 100.0), (90.0, 60.0), (180.0, 20.0), (270.0, 60.0)] {
            close(half.candelas(10.0, around), expected);
        }
        let other = profile("90 270", "100 100 100 20 20 20");
        for (around, expected) in [(90.0, 100.0), (180.0, 60.0), (0.0, 60.0), (315.0, 40.0)] {
            close(other.candelas(10.0, around), expected);
        }
        let open = profile("0 120 240", "90 90 90 30 30 30 60 60 60");
        for (around, expected) in [(120.0, 30.0), (180.0, 45.0), (300.0, 75.0), (360.0, 90.0)] {
            close(open.candelas(10.0, around), expected);
        }
    }

    #[test]
    fn damaged_files_are_refused_in_words() {
        let whole = "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 60 0 90 0 100 50";
        assert!(Profile::read(whole.as_bytes(), "a.ies").is_ok());
        for (from, to, part) in [
            ("TILT=NONE", "TILT=lamp.tlt", "in another file"),
            ("TILT=", "tilt ", "no line `TILT=`"),
            ("1 -1 1 2 1 1", "1 -1 1 2 1 3", "not of type C"),
            ("1 -1 1 2 1 1", "1 -1 1 1e9 1 1", "cut off"),
            ("1 -1 1 2 1 1", "1 -1 1 2.5 1 1", "cut off"),
            ("1 -1 1 2 1 1", "1 -1 nan 2 1 1", "no number for the multiplier"),
            (" 100 50", " 100", "ends before candelas"),
            (" 100 50", " 100 -50", "negative"),
            ("0 90 0", "90 0 0", "do not rise"),
        ] {
            let text = whole.replace(from, to);
            let error = Profile::read(text.as_bytes(), "a.ies").err().expect("damaged");
            assert!(error.to_string().contains(part), "{error}: not `{part}`");
        }
    }
}
