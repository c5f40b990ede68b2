//! Maps beside the texture lookups that they stand for.
#![expect(clippy::cast_possible_truncation, reason = "numbers at random, of which each will do")]

use super::*;
use crate::kernel::{Bindings, TexturePoint};
use glam::UVec4;
use pack::abi::Frame;

/// From 0 to 1, the same for the same state.
fn random(state: &mut u32) -> f32 {
    *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*state >> 8) as f32 / (1 << 24) as f32
}

/// Alpha of an image: a disc with a soft edge, and noise beside it.
fn image(width: u32, height: u32, state: &mut u32) -> Vec<u32> {
    let texel = |i: u32| {
        let x = (i % width) as f32 / width as f32 - 0.4;
        let y = (i / width) as f32 / height as f32 - 0.5;
        let alpha = 255.0 * (2.0 - 6.0 * x.hypot(y)).clamp(0.0, 1.0);
        if x > 0.4 { (255.0 * random(state)) as u32 } else { alpha as u32 }
    };
    (0..width * height).map(texel).map(|alpha| alpha << 24).collect()
}

/// How often the map of an image answers, and how often it is asked; panics if an answer is wrong.
fn told(size: [u32; 2], wrap: [Wrap; 2], [alpha, alpha_cutoff]: [f32; 2]) -> [u32; 2] {
    let mut state = 1;
    // The image begins at the second word.
    let mut texels = vec![0; 4];
    texels.extend(image(size[0], size[1], &mut state));
    texels.resize(texels.len().next_multiple_of(4), 0);
    let [wrap_u, wrap_v] = wrap.map(|wrap| wrap as u32);
    let format = TextureFormat::Rgba8Srgb as u32;
    let [width, height] = size;
    let texture =
        Texture { width, height, format, offset: 1, wrap_u, wrap_v, ..Texture::default() };
    let flags = material_flag::ALPHA_CLIP;
    let material = Material { flags, alpha, alpha_cutoff, ..Material::default() };
    let maps = AlphaMaps::new(&[material], &[texture], &texels);
    let mut heap: Vec<UVec4> = bytemuck::pod_collect_to_vec(&[material]);
    let texture_at = u32::try_from(heap.len()).unwrap();
    heap.extend(bytemuck::pod_collect_to_vec::<_, UVec4>(&[texture]));
    let frame: Vec<UVec4> =
        bytemuck::pod_collect_to_vec(&[Frame { texture_at, ..Frame::default() }]);
    let words: Vec<UVec4> = bytemuck::pod_collect_to_vec(&texels);
    let mut kernel = Kernel::new(Bindings {
        frame_words: &frame,
        film_words: &mut [],
        heap_words: &heap,
        node_words: &[],
        tri_words: &[],
        shade_words: &[],
        sphere_words: &[],
        texel_words: &words,
    });
    let map = &maps.maps[0];
    let mut counts = [0, 0];
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e-30, -0.0, 1.0];
    for k in 0..4_000 {
        let mut along = |n: u32| match k % 16 {
            0 => odd[(7.0 * random(&mut state)) as usize],
            // Between two texels or in the middle of one.
            1..8 => (6.0 * n as f32 * random(&mut state)).round() / (2.0 * n as f32) - 1.0,
            _ => 3.0 * random(&mut state) - 1.0,
        };
        let uv = Vec2::new(along(width), along(height));
        counts[1] += 1;
        if let Some(there) = map.tell(&mut kernel, uv) {
            let at = TexturePoint { uv, ..TexturePoint::ZERO };
            assert_eq!(there, kernel.alpha_exists(0, at), "{uv} {size:?} {wrap:?}");
            counts[0] += 1;
        }
    }
    counts
}

#[test]
fn a_map_tells_nothing_but_what_the_texture_says() {
    let sizes = [[1, 1], [3, 2], [64, 33], [300, 200], [600, 5]];
    for size in sizes {
        for wrap_u in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            for wrap_v in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                for limits in [[1.0, 0.5], [0.7, 0.3], [1.0, 1.0], [1.0, 0.0]] {
                    told(size, [wrap_u, wrap_v], limits);
                }
            }
        }
    }
}

#[test]
fn a_map_tells_all_but_edges_and_noise() {
    let [answers, asked] = told([512, 512], [Wrap::Repeat; 2], [1.0, 0.5]);
    // A fifth of the image is noise.
    assert!(10 * answers > 7 * asked, "{answers} of {asked}");
}

#[test]
fn there_are_maps_of_what_images_clip_and_equals_share_one() {
    let image = Texture { width: 1, height: 1, ..Texture::default() };
    let halves = Texture { format: TextureFormat::Rgba16Float as u32, ..image };
    let material = |flags, alpha_cutoff, alpha_texture| Material {
        flags,
        alpha: 1.0,
        alpha_cutoff,
        alpha_texture,
        ..Material::default()
    };
    let (clip, blend) = (material_flag::ALPHA_CLIP, material_flag::ALPHA_BLEND);
    let materials = [
        material(0, 0.5, 0),
        material(clip, 0.5, 0),
        material(clip | blend, 0.5, 0),
        material(clip, 0.5, 1),
        material(clip, 0.5, 0),
        material(clip, 0.6, 0),
        material(clip, 0.5, 2),
    ];
    let maps = AlphaMaps::new(&materials, &[image, halves], &[0; 4]);
    assert_eq!(maps.of, [None, Some(0), None, None, Some(0), Some(1), None]);
    assert_eq!(maps.maps.len(), 2);
}
