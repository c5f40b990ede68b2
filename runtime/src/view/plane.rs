//! What the camera of a session sees beside light → numbers for the page, without rendering the picture again.
//!
//! A layer is made when it is asked for, of a few samples of every pixel, with the CPU kernel; the error of the pixels
//! comes from the picture. It knows neither pages nor requests.

use crate::film::Film;
use crate::gather::{Pass, gather};
use crate::job::Job;
use crate::layers::{Layer, Layers, Nearest, Wanted};
use crate::region::SampleRange;
use crate::scene::Scene;
use crate::signals::Signals;

/// Samples of every pixel: edges look smooth enough.
const SAMPLES: SampleRange = SampleRange { start: 0, end: 4 };
/// The plane that is no layer.
const ERROR: &str = "error";

/// What a page may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The relative standard error of every pixel of the picture.
    Error,
    /// A layer of a few numbers a pixel.
    Layer(Layer),
}

impl Kind {
    pub(super) fn of_name(name: &str) -> Option<Self> {
        let shown = |layer: &Layer| {
            !matches!(layer, Layer::Crypto | Layer::Variance | Layer::Samples | Layer::Lights)
        };
        match name {
            ERROR => Some(Self::Error),
            name => Layer::of_name(name).filter(shown).map(Self::Layer),
        }
    }
}

/// Why there is no plane.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Absent {
    /// There is no scene, or not enough of the picture; in words.
    Not(&'static str),
    /// Scene or camera have changed, or another plane is wanted.
    Stale,
    /// It cannot be made; in words.
    Failed(String),
}

/// Numbers of every pixel, row by row.
#[derive(Debug, PartialEq)]
pub(super) struct Plane {
    pub(super) size: [u32; 2],
    /// Numbers of a pixel.
    pub(super) channels: u32,
    /// Of the picture that it belongs to.
    pub(super) epoch: u64,
    /// Samples behind each pixel.
    pub(super) samples: u32,
    pub(super) values: Vec<f32>,
}

impl Plane {
    /// Size, channels, epoch and samples as five 32-bit numbers, then the values as 32-bit floats; little endian.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let [width, height] = self.size;
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the page only asks whether it is the one that it knows"
        )]
        let head = [width, height, self.channels, self.epoch as u32, self.samples];
        let mut bytes = Vec::with_capacity(size_of_val(&head) + 4 * self.values.len());
        bytes.extend(head.into_iter().flat_map(u32::to_le_bytes));
        bytes.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    }
}

/// Makes the plane of a layer of the job's image, in an epoch.
pub(super) fn make(
    scene: &Scene,
    job: &Job,
    (layer, epoch): (Layer, u64),
    signals: &Signals,
) -> Result<Plane, Absent> {
    let failed = |error: &dyn std::error::Error| Absent::Failed(error.to_string());
    // Alpha says where the scene is also where there is a sky.
    let wanted =
        Wanted { layers: [layer].into(), transparent: layer == Layer::Alpha, ..Wanted::default() };
    let job = Job { wanted, ..job.clone() };
    let film = Film::try_new(job.image_size, job.crop).map_err(|error| failed(&error))?;
    let mut film = Film { ranges: vec![SAMPLES], ..film };
    let pass = Pass {
        scene,
        job: &job,
        signals,
        #[cfg(feature = "gpu")]
        adapter: None,
    };
    let layers = gather(&pass, &mut film);
    if signals.is_cancelled() {
        return Err(Absent::Stale);
    }
    let (channels, values) = values(&layers.map_err(|error| failed(&error))?, layer);
    let (size, samples) = (job.image_size, SAMPLES.count());
    Ok(Plane { size, channels, epoch, samples, values })
}

/// Numbers of a pixel, and all of them; not a number where nothing is seen.
fn values(layers: &Layers, layer: Layer) -> (u32, Vec<f32>) {
    let scale = 1.0 / f64::from(layers.samples.max(1));
    let means =
        |sums: &[[f64; 3]]| (3, sums.as_flattened().iter().map(|x| single(x * scale)).collect());
    let one = |of: &dyn Fn(&Nearest) -> f32| (1, layers.nearest.iter().map(of).collect());
    let if_seen = |nearest: &Nearest, x: f32| if nearest.depth.is_finite() { x } else { f32::NAN };
    match layer {
        Layer::Albedo => means(&layers.albedo),
        Layer::Normal => means(&layers.normal),
        Layer::Depth => one(&|nearest| if_seen(nearest, nearest.depth)),
        Layer::Position => {
            let each = |nearest: &Nearest| nearest.position.map(|x| if_seen(nearest, x));
            (3, layers.nearest.iter().flat_map(each).collect())
        }
        Layer::Uv => {
            let each = |nearest: &Nearest| nearest.uv.map(|x| if_seen(nearest, x));
            (2, layers.nearest.iter().flat_map(each).collect())
        }
        Layer::Object => one(&|nearest| nearest.numbers[0] as f32),
        Layer::Instance => one(&|nearest| nearest.numbers[1] as f32),
        Layer::Material => one(&|nearest| nearest.numbers[2] as f32),
        Layer::Alpha => (1, (0..layers.covered.len()).map(|i| single(layers.alpha(i))).collect()),
        Layer::Crypto | Layer::Variance | Layer::Samples | Layer::Lights => (0, Vec::new()),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
pub(super) fn single(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_plane_has_no_name() {
        assert_eq!(Kind::of_name("error"), Some(Kind::Error));
        assert_eq!(Kind::of_name("depth"), Some(Kind::Layer(Layer::Depth)));
        for name in ["", "crypto", "variance", "samples", "lights", "Depth", "picture", "../depth"]
        {
            assert_eq!(Kind::of_name(name), None, "{name}");
        }
    }

    #[test]
    fn a_plane_is_its_head_and_its_numbers() {
        let values = vec![1.0, f32::NAN];
        let plane = Plane { size: [2, 1], channels: 1, epoch: (7 << 32) + 5, samples: 4, values };
        let bytes = plane.bytes();
        let words: Vec<u32> =
            bytes.chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
        assert_eq!(words, [2, 1, 1, 5, 4, 1.0_f32.to_bits(), f32::NAN.to_bits()]);
    }
}
