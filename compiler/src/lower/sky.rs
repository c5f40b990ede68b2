//! The sky declaration becomes the `Sky` record.

use lang::scene::{Rgb, Sky, SkyModel};
use pack::abi::{self, SkyKind};

/// `None` for a sky that is black everywhere: it then leaves no section and no code.
pub(super) fn sky(sky: &Sky) -> Option<abi::Sky> {
    match &sky.model {
        SkyModel::Constant(radiance) => (!is_black(radiance)).then(|| constant(*radiance)),
        SkyModel::Gradient { zenith, middle, horizon, ground, glow, disc, .. } => {
            let bands = [zenith, middle, horizon, ground, glow, disc];
            if bands.iter().all(|color| is_black(color)) {
                return None;
            }
            let plain = is_black(glow) && is_black(disc);
            let flat = bands[..4].iter().all(|color| same(color, zenith));
            // A gradient without a gradient needs no gradient code.
            Some(if plain && flat { constant(*zenith) } else { gradient(&sky.model) })
        }
    }
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

fn constant(radiance: Rgb) -> abi::Sky {
    abi::Sky { zenith: rgb(radiance), kind: SkyKind::Constant as u32, ..Default::default() }
}

fn gradient(model: &SkyModel) -> abi::Sky {
    let SkyModel::Gradient {
        zenith,
        middle,
        horizon,
        ground,
        blend_high,
        blend_low,
        sun_direction,
        glow,
        glow_power,
        disc,
        disc_power,
    } = *model
    else {
        return abi::Sky::default();
    };
    abi::Sky {
        zenith: rgb(zenith),
        kind: SkyKind::Gradient as u32,
        middle: rgb(middle),
        blend_high: blend_high as f32,
        horizon: rgb(horizon),
        blend_low: blend_low as f32,
        ground: rgb(ground),
        glow_power: glow_power as f32,
        sun_direction: rgb(sun_direction),
        disc_power: disc_power as f32,
        glow: rgb(glow),
        _pad0: 0,
        disc: rgb(disc),
        _pad1: 0,
    }
}
