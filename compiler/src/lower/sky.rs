//! The sky declaration becomes the `Sky` record and the table by which bright skies are sampled.
//!
//! Images are sampled always; gradients if they have a glow or a disc, whose light paths would find only by
//! chance. A sky of bands alone, or of one colour, is found by every path that leaves the scene.

use std::f64::consts::{PI, TAU};

use lang::scene::{Rgb, Sky, SkyModel};
use pack::Kind;
use pack::abi::{self, NONE, SkyKind};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::files::Files;
use super::light::luminance;
use super::sky_table::{Cells, SkyTable, sky_table};
use super::texture::{TextureTable, luminances};
use crate::import::{Environment, ImportError};
use crate::stage::{Key, KeyOf, Stages};

/// A sky that is not black.
pub(super) struct LoweredSky {
    pub(super) record: abi::Sky,
    /// Present if directions towards it are to be sampled.
    pub(super) table: Option<SkyTable>,
}

impl LoweredSky {
    /// The integral of its luminance over all directions, if it is to be sampled.
    pub(super) fn flux(&self) -> Option<f64> {
        self.table.as_ref().map(|table| table.flux)
    }
}

/// `None` for a sky that is black everywhere: it then leaves no section and no code.
///
/// # Errors
/// When its image cannot be loaded.
pub(super) fn sky(
    sky: Option<&Sky>,
    (files, stages): (&dyn Files, &Stages),
    textures: &mut TextureTable<'_>,
) -> Result<Option<LoweredSky>, ImportError> {
    let Some(sky) = sky else { return Ok(None) };
    let unseen = u32::from(!sky.visible);
    let seen = visible(&sky.model, (files, stages), textures)?;
    let hidden = |sky: LoweredSky| LoweredSky { record: abi::Sky { unseen, ..sky.record }, ..sky };
    Ok(seen.map(hidden))
}

/// The same of a sky that the camera sees.
fn visible(
    model: &SkyModel,
    (files, stages): (&dyn Files, &Stages),
    textures: &mut TextureTable<'_>,
) -> Result<Option<LoweredSky>, ImportError> {
    let plain = |record| LoweredSky { record, table: None };
    Ok(match model {
        SkyModel::Constant(radiance) => (!is_black(radiance)).then(|| plain(constant(*radiance))),
        SkyModel::Gradient { zenith, middle, horizon, ground, glow, disc, .. } => {
            let bands = [zenith, middle, horizon, ground, glow, disc];
            if bands.iter().all(|color| is_black(color)) {
                return Ok(None);
            }
            let dull = is_black(glow) && is_black(disc);
            let flat = bands[..4].iter().all(|color| same(color, zenith));
            // A gradient without a gradient needs no gradient code.
            if dull && flat {
                return Ok(Some(plain(constant(*zenith))));
            }
            let record = gradient(model);
            let mut key = KeyOf::stage("table of a gradient");
            key.bytes(bytemuck::bytes_of(&record));
            let cells = || Ok(gradient_cells(&record));
            let table = if dull { None } else { table_of(stages, key.end(), cells)? };
            Some(LoweredSky { record, table })
        }
        SkyModel::Image { rotate, strength, .. } => {
            image((*rotate, *strength), (files, stages), textures)?
        }
        SkyModel::SunSky(day) => {
            // Its image has the sun above the middle, which lies towards -z.
            let [x, _, z] = day.sun_direction;
            image((libm::atan2(-x, -z), 1.0), (files, stages), textures)?
        }
    })
}

/// An image, turned about +y by so many radians, times a factor; `None` if it is black.
fn image(
    (rotate, strength): (f64, f64),
    (files, stages): (&dyn Files, &Stages),
    textures: &mut TextureTable<'_>,
) -> Result<Option<LoweredSky>, ImportError> {
    let facts = files.environment().expect("the image of a sky has been read");
    let mut key = KeyOf::stage("table of an image");
    key.bytes(&facts.image.content).number(facts.image.is_radiance);
    let cells = || Ok(image_cells(&*files.load_environment()?));
    let Some(table) = table_of(stages, key.end(), cells)? else { return Ok(None) };
    let flux = strength * facts.scale * table.flux;
    let record = abi::Sky {
        zenith: [(strength * facts.scale) as f32; 3],
        kind: SkyKind::Image as u32,
        texture: textures.environment(),
        rotation: turns(rotate),
        ..blank()
    };
    Ok(Some(LoweredSky { record, table: Some(SkyTable { flux, ..table }) }))
}

/// What is kept of a table beside its values, which the pack has.
#[derive(Serialize, Deserialize)]
struct TableSize {
    columns: u32,
    rows: u32,
    flux: f64,
    n_values: usize,
}

/// The table over some cells; `None` if all is black.
fn table_of(
    stages: &Stages,
    key: Key,
    cells: impl FnOnce() -> Result<Cells, ImportError>,
) -> Result<Option<SkyTable>, ImportError> {
    if let Some((size, pack)) = stages.in_pack::<Option<TableSize>>(key) {
        let Some(TableSize { columns, rows, flux, n_values }) = size else { return Ok(None) };
        let words: &[f32] = pack.section_bytes(Kind::SKYTABLE).map_or(&[], bytemuck::cast_slice);
        // A pack whose sky is too weak to be a light has no table.
        if words.len() == n_values.next_multiple_of(4) {
            let values = words[..n_values].to_vec();
            return Ok(Some(SkyTable { columns, rows, values, flux }));
        }
    }
    let table = sky_table(cells()?);
    let size = table.as_ref().map(|table| TableSize {
        columns: table.columns,
        rows: table.rows,
        flux: table.flux,
        n_values: table.values.len(),
    });
    stages.put_in_pack(key, &size);
    Ok(table)
}

fn same(a: &Rgb, b: &Rgb) -> bool {
    a.map(f64::to_bits) == b.map(f64::to_bits)
}

fn is_black(color: &Rgb) -> bool {
    color.iter().all(|&c| c == 0.0)
}

fn rgb(color: Rgb) -> [f32; 3] {
    color.map(|c| c as f32)
}

/// All fields 0 but those that name nothing.
fn blank() -> abi::Sky {
    abi::Sky { texture: NONE, light: NONE, ..Default::default() }
}

fn constant(radiance: Rgb) -> abi::Sky {
    abi::Sky { zenith: rgb(radiance), kind: SkyKind::Constant as u32, ..blank() }
}

/// `Sky::rotation` of a turn by `angle` radians: half a turn more, so that the middle of the image lies
/// towards -z; in 0 .. 1.
fn turns(angle: f64) -> f32 {
    let turns = angle / TAU + 0.5;
    let turns = (turns - libm::floor(turns)) as f32;
    if turns < 1.0 { turns } else { 0.0 }
}

fn gradient(model: &SkyModel) -> abi::Sky {
    let SkyModel::Gradient {
        zenith,
        middle,
        horizon,
        ground,
        blend_high,
        blend_low,
        blend_ground,
        sun_direction,
        glow,
        glow_power,
        disc,
        disc_power,
    } = *model
    else {
        return blank();
    };
    abi::Sky {
        zenith: rgb(zenith),
        kind: SkyKind::Gradient as u32,
        middle: rgb(middle),
        blend_high: (blend_low + blend_high * (1.0 - blend_low)) as f32,
        horizon: rgb(horizon),
        blend_low: blend_low as f32,
        ground: rgb(ground),
        blend_ground: (blend_low - blend_ground) as f32,
        sun_direction: rgb(sun_direction),
        glow_power: glow_power as f32,
        glow: rgb(glow),
        disc_power: disc_power as f32,
        disc: rgb(disc),
        rotation: turns(0.0),
        ..blank()
    }
}

/// Mean luminance of what the kernel interpolates between the texels: a bilinear function's integral over a
/// cell weighs the cell's own texel 6/8 along each axis and its neighbours 1/8.
fn image_cells(environment: &Environment) -> Cells {
    let image = &environment.image;
    let (columns, rows) = (image.width as usize, image.height as usize);
    let mix = |before: f64, own: f64, after: f64| (before + 6.0 * own + after) / 8.0;
    let row_means = |row: usize| {
        let above = luminances(image, row.saturating_sub(1));
        let own = luminances(image, row);
        let below = luminances(image, (row + 1).min(rows - 1));
        let mixed: Vec<f64> = (0..columns).map(|i| mix(above[i], own[i], below[i])).collect();
        let at = |i: usize| mixed[i % columns];
        (0..columns).map(|i| mix(at(i + columns - 1), at(i), at(i + 1))).collect::<Vec<f64>>()
    };
    let means = (0..rows).into_par_iter().flat_map_iter(row_means).collect();
    Cells { columns, rows, means }
}

/// Points along each side of a cell at which a gradient is averaged.
const FINE: usize = 3;

/// Columns of a gradient's table: half the radius at which its narrowest lobe has fallen to 1/sqrt(e) is
/// one cell, within limits: 32 cells cost nothing, 2048 are 8 MiB.
fn gradient_columns(sky: &abi::Sky) -> usize {
    let lobes = [(sky.disc, sky.disc_power), (sky.glow, sky.glow_power)];
    let powers = lobes.iter().filter(|(color, _)| color.iter().any(|c| *c > 0.0));
    let narrowest = powers.map(|(_, power)| *power).fold(1.0, f32::max);
    let wanted = 2.0 * TAU * f64::from(narrowest).sqrt();
    (wanted as usize).next_power_of_two().clamp(32, 2048)
}

fn gradient_cells(sky: &abi::Sky) -> Cells {
    let columns = gradient_columns(sky);
    let rows = columns / 2;
    let mean = |cell: usize| {
        let at = |k: usize, sub: usize| k as f64 + (sub as f64 + 0.5) / FINE as f64;
        let (mut sum, mut area) = (0.0, 0.0);
        for i in 0..FINE {
            let theta = PI * at(cell / columns, i) / rows as f64;
            let (sin, cos) = (libm::sin(theta), libm::cos(theta));
            for j in 0..FINE {
                // Towards -z at the middle of the table, as in an image.
                let phi = TAU * (at(cell % columns, j) / columns as f64 - 0.5);
                let dir = [sin * libm::sin(phi), cos, -sin * libm::cos(phi)];
                sum += sin * gradient_luminance(sky, dir);
                area += sin;
            }
        }
        sum / area
    };
    Cells { columns, rows, means: (0..rows * columns).into_par_iter().map(mean).collect() }
}

/// Luminance of `gradient_radiance` of the kernel along the unit vector `dir`.
fn gradient_luminance(sky: &abi::Sky, dir: [f64; 3]) -> f64 {
    let light = |color: [f32; 3]| luminance(color.map(f64::from));
    let ramp = |a: [f32; 3], b: [f32; 3], y0: f32, y1: f32| {
        let (y0, y1) = (f64::from(y0), f64::from(y1));
        let t = ((dir[1] - y0) / (y1 - y0)).clamp(0.0, 1.0);
        let k = t * t * (3.0 - 2.0 * t);
        light(a) * (1.0 - k) + light(b) * k
    };
    let base = if dir[1] >= f64::from(sky.blend_high) {
        ramp(sky.middle, sky.zenith, sky.blend_high, 1.0)
    } else if dir[1] >= f64::from(sky.blend_low) {
        ramp(sky.horizon, sky.middle, sky.blend_low, sky.blend_high)
    } else {
        ramp(sky.ground, sky.horizon, sky.blend_ground, sky.blend_low)
    };
    let sun = sky.sun_direction.map(f64::from);
    let c = (dir[0] * sun[0] + dir[1] * sun[1] + dir[2] * sun[2]).clamp(0.0, 1.0);
    let lobe = |color, power: f32| light(color) * libm::pow(c, f64::from(power));
    base + lobe(sky.glow, sky.glow_power) + lobe(sky.disc, sky.disc_power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrower_discs_have_finer_tables() {
        let with = |disc: f32, power: f32| {
            gradient_columns(&abi::Sky { disc: [disc; 3], disc_power: power, ..blank() })
        };
        assert_eq!(with(1.0, 400.0), 256);
        assert_eq!(with(0.0, 400.0), 32);
        assert_eq!(with(1.0, 1e6), 2048);
    }

    #[test]
    fn a_lobe_has_the_flux_of_its_integral() {
        // The integral of cos^n over a hemisphere is 2 pi / (n + 1).
        let sky = abi::Sky {
            disc: [15.0; 3],
            disc_power: 400.0,
            sun_direction: [0.6, 0.48, 0.64],
            ..blank()
        };
        let table = sky_table(gradient_cells(&sky)).expect("it is bright");
        let expected = 15.0 * TAU / 401.0;
        assert!((table.flux / expected - 1.0).abs() < 2e-3, "{} {expected}", table.flux);
    }

    #[test]
    fn quarter_turns_are_exact() {
        let found = [0.0, PI / 2.0, PI, -PI / 2.0].map(turns);
        assert_eq!(found.map(f32::to_bits), [0.5, 0.75, 0.0, 0.25_f32].map(f32::to_bits));
    }
}
