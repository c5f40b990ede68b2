//! What geometry depends on, as texts that can be compared.
//!
//! A scene without everything that only makes other numbers in records: where its declarations stand, cameras,
//! films, colours and the like. What is not taken away here counts, so a field that somebody adds to the language
//! counts until it is named below.

use lang::scene::{Material, Medium, MediumModel, Name, Sampler, Scene, SkyModel, ToneMap};
use lang::source::{SourceSet, Span};

use super::load::beside;

/// See the module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Essence {
    /// Name of everything that geometry and what is checked of it depend on.
    pub(super) geometry: [u8; 32],
    /// The same without where instances and lights stand.
    pub(super) placeless: [u8; 32],
    /// All that is said of the sky.
    pub(super) sky: String,
}

impl Essence {
    /// Of a scene; `sources` tell where its paths begin.
    #[must_use]
    pub fn new(scene: &Scene, sources: &SourceSet) -> Self {
        let mut scene = scene.clone();
        for (path, span) in paths(&mut scene) {
            let full = beside(sources, *span, path);
            *path = full.display().to_string();
            *span = Span::default();
        }
        let sky = format!("{:?}", scene.sky.take().map(|sky| sky.model));
        forget_views(&mut scene);
        for instance in &mut scene.instances {
            forget_place(&mut instance.name);
            instance.shape_span = Span::default();
            instance.material_span = None;
        }
        scene.materials.iter_mut().for_each(forget_numbers);
        scene.media.iter_mut().for_each(forget_light);
        for light in &mut scene.lights {
            forget_place(&mut light.name);
            light.radiance = [f64::from(light.radiance.iter().any(|c| *c > 0.0)); 3];
            if let Some(tint) = &mut light.tint {
                tint.color = [1.0; 3];
            }
        }
        let assets = scene.assets.iter_mut().map(|asset| &mut asset.name);
        let textures = scene.textures.iter_mut().map(|texture| &mut texture.name);
        assets.chain(textures).for_each(forget_place);
        let name = |scene: &Scene| *blake3::hash(format!("{scene:?}").as_bytes()).as_bytes();
        let geometry = name(&scene);
        for instance in &mut scene.instances {
            instance.world_from_object = [[0.0; 4]; 3];
        }
        scene.lights.iter_mut().for_each(|light| light.center = [0.0; 3]);
        Self { geometry, placeless: name(&scene), sky }
    }
}

/// Every path in the text, with where it stands.
fn paths(scene: &mut Scene) -> Vec<(&mut String, &mut Span)> {
    let assets = scene.assets.iter_mut().map(|asset| (&mut asset.path, &mut asset.path_span));
    let textures = scene.textures.iter_mut();
    let textures = textures.map(|texture| (&mut texture.path, &mut texture.path_span));
    let sky = scene.sky.iter_mut().filter_map(|sky| match &mut sky.model {
        SkyModel::Image { path, path_span, .. } => Some((path, path_span)),
        SkyModel::Constant(_) | SkyModel::Gradient { .. } => None,
    });
    assets.chain(textures).chain(sky).collect()
}

fn forget_place(name: &mut Name) {
    name.span = Span::default();
}

/// Who looks, and how the picture is made: all of it but the shutter, which moves things, and the air.
fn forget_views(scene: &mut Scene) {
    let Scene { camera, film, render, .. } = scene;
    [&mut camera.name, &mut film.name, &mut render.name].into_iter().for_each(forget_place);
    for vector in [&mut camera.from, &mut camera.to, &mut camera.up] {
        *vector = [0.0; 3];
    }
    (camera.fov_horizontal, camera.fov_vertical) = (0.0, 0.0);
    (camera.lens_radius, camera.focus_distance) = (0.0, 0.0);
    (film.size, film.exposure, film.tone_map) = ([1; 2], 0.0, ToneMap::None);
    (render.samples, render.max_depth, render.roulette_depth, render.seed) = (1, 1, 1, 1);
    (render.sampler, render.output) = (Sampler::Pcg, None);
}

/// Scattering is compared with the size of things; absorption and colour are not.
fn forget_light(medium: &mut Medium) {
    forget_place(&mut medium.name);
    medium.sky_distance = 0.0;
    match &mut medium.model {
        MediumModel::Homogeneous { sigma_a, sigma_s: _, g } => (*sigma_a, *g) = ([0.0; 3], 0.0),
        MediumModel::Fog { density, color } => (*density, *color) = (0.0, [0.0; 3]),
    }
}

/// Numbers that only the record of the material has. Whether it gives light, is cut out by alpha and so on is
/// compared in the records themselves, when they are made again.
fn forget_numbers(material: &mut Material) {
    forget_place(&mut material.name);
    if let Some(map) = &mut material.normal {
        map.strength = 1.0;
    }
    material.model.forget_numbers();
}

#[cfg(test)]
mod tests {
    use lang::source::LoadError;

    use super::*;

    struct Alone;

    impl lang::source::Loader for Alone {
        fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
            Err(LoadError::NotFound)
        }
    }

    const SCENE: &str = "rts 1
material oak: wood { color = srgb(#8a5a33), grain = x }
material clay: diffuse { color = linear(0.8, 0.4, 0.2) }
instance beam { shape = box(size: (2, 0.2, 0.2)m), material = oak }
instance ball { shape = sphere(radius: 20cm), material = clay }
light lamp: sphere { center = (0, 3, 0)m, radius = 10cm, strength = 5 }
sky dusk: constant { color = linear(0.1, 0.1, 0.2) }
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m }
render main: path { samples = 1 }
";

    fn essence(text: &str) -> Essence {
        let found = lang::analyze("a.rts", text, &mut Alone, &lang::Options::default());
        Essence::new(&found.scene.expect("the text is a scene"), &found.sources)
    }

    fn edited(from: &str, to: &str) -> [bool; 2] {
        let [geometry, sky, _] = same(from, to);
        [geometry, sky]
    }

    fn same(from: &str, to: &str) -> [bool; 3] {
        assert!(SCENE.contains(from), "{from}");
        let (before, after) = (essence(SCENE), essence(&SCENE.replace(from, to)));
        [
            before.geometry == after.geometry,
            before.sky == after.sky,
            before.placeless == after.placeless,
        ]
    }

    #[test]
    fn a_thing_that_moves_is_the_same_elsewhere() {
        for (from, to) in [
            ("(0, 3, 0)m", "(0, 3, 1)m"),
            ("material = oak }", "material = oak, at = (1, 0, 0)m }"),
            ("material = clay }", "material = clay, rotate = (0, 10, 0)deg, scale = 2 }"),
        ] {
            assert_eq!(same(from, to), [false, true, true], "{from}");
        }
        assert_eq!(same("20cm", "21cm"), [false, true, false]);
        assert_eq!(same("radius = 10cm", "radius = 11cm"), [false, true, false]);
    }

    #[test]
    fn views_and_colours_and_places_in_the_text_are_forgotten() {
        for (from, to) in [
            ("(0, 1, 6)m", "(0, 2, 7)m"),
            ("samples = 1", "samples = 4, depth = 3"),
            ("linear(0.8, 0.4, 0.2)", "linear(0.1, 0.1, 0.1)"),
            ("#8a5a33", "#70401f"),
            ("strength = 5", "strength = 7"),
            ("rts 1\n", "rts 1\n\n// A remark.\n"),
        ] {
            assert_eq!(edited(from, to), [true, true], "{from}");
        }
        assert_eq!(edited("linear(0.1, 0.1, 0.2)", "linear(0.2, 0.1, 0.2)"), [true, false]);
    }

    #[test]
    fn what_geometry_knows_counts() {
        for (from, to) in [
            ("20cm", "21cm"),
            ("(2, 0.2, 0.2)m", "(2, 0.2, 0.3)m"),
            ("(0, 3, 0)m", "(0, 3, 1)m"),
            ("strength = 5", "strength = 0"),
            ("grain = x", "grain = z"),
            ("instance ball", "instance bowl"),
            ("material = clay", "material = oak"),
            ("diffuse { color = linear(0.8, 0.4, 0.2) }", "emissive { color = linear(1, 1, 1) }"),
        ] {
            assert_eq!(edited(from, to), [false, true], "{from}");
        }
    }
}
