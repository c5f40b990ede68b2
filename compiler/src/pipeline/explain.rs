//! Every feature of the kernel with the declaration that needs it, or with why it was left out.
//!
//! `features` decides, from the records; this finds words and a place in the text for the decision. A
//! feature that is left out although something of the scene could have needed it names that declaration.

use std::collections::BTreeMap;

use lang::scene::{Instance, MediumModel, Name, Parts, Scene, Shape, SkyModel};
use lang::source::Span;
use pack::abi::{
    CameraKind, FilterKind, LightKind, Material, MaterialKind, NONE, SamplerKind, SkyKind,
    TRI_SMOOTH, TextureFormat, material_flag,
};
use pack::features as bit;
use shaders::{FeatureSet, NodeLayout};

use crate::lower::Lowered;

/// A declaration: its name, and where it is, if it is in a text.
type Declared = (String, Option<Span>);

/// A feature.
pub(super) struct Row {
    /// As in `pack::features::NAMES`, or the name of a part of one.
    pub(super) name: &'static str,
    pub(super) kept: bool,
    pub(super) reason: String,
    pub(super) by: Option<Declared>,
}

/// What the reasons are read off.
pub(super) struct Explain<'a> {
    pub(super) scene: &'a Scene,
    pub(super) features: &'a FeatureSet,
    pub(super) lowered: &'a Lowered,
}

/// A reason and the declaration it is about.
type Reason = (String, Option<Declared>);

const NOTHING: &str = "nothing uses it";

fn because(text: &str) -> Reason {
    (text.to_owned(), None)
}

fn by(text: String, name: &Name) -> Reason {
    (text, Some(declared(name)))
}

fn declared(name: &Name) -> Declared {
    (name.text.clone(), Some(name.span))
}

/// The name of a feature bit.
fn name_of(wanted: u64) -> &'static str {
    bit::NAMES.iter().find(|(bit, _)| *bit == wanted).map_or("?", |(_, name)| name)
}

impl Explain<'_> {
    /// Every feature once: shapes, materials, lights, view, textures, what paths do.
    pub(super) fn rows(&self) -> Vec<Row> {
        let mut rows = self.shapes();
        rows.extend(MaterialKind::ALL.map(|kind| self.material_kind(kind)));
        rows.extend(self.material_parts());
        rows.extend(LightKind::ALL.map(|kind| self.light_kind(kind)));
        rows.extend(self.light_parts());
        rows.extend(SkyKind::ALL.map(|kind| self.sky(kind)));
        rows.extend(self.view());
        rows.extend(TextureFormat::ALL.map(|format| self.texture(format)));
        rows.extend(self.paths());
        rows
    }

    /// A row for the feature `name`; the first reason is for one that is kept.
    fn row(name: &'static str, kept: bool, why: Option<Reason>, why_not: Option<Reason>) -> Row {
        let reason = if kept { why } else { why_not };
        let (reason, by) = reason.unwrap_or_else(|| because(NOTHING));
        Row { name, kept, reason, by }
    }

    fn shapes(&self) -> Vec<Row> {
        let Lowered { triangles, spheres, instances, wide_nodes, .. } = self.lowered;
        let ball = |shape: &Shape| match shape {
            Shape::Sphere { .. } => true,
            Shape::Rectangle { .. }
            | Shape::Quad { .. }
            | Shape::Box { .. }
            | Shape::Faces { .. }
            | Shape::Mesh { .. } => false,
        };
        let first = |wanted: &dyn Fn(&Shape) -> bool, text: String| {
            let found = self.scene.instances.iter().find(|instance| wanted(&instance.shape));
            found.map(|instance| by(text, &instance.name))
        };
        let n = triangles.len();
        let meshes =
            first(&|shape| !ball(shape), format!("{n} triangles in leaves, the first thing"));
        let text = format!("{} spheres, the first", spheres.len());
        let light = self.scene.lights.first().map(|light| by(text.clone(), &light.name));
        let balls = first(&ball, text).or(light);
        let smooth = self.lowered.shades.iter().find(|shade| shade.object & TRI_SMOOTH != 0);
        let smooth = smooth.map(|shade| {
            let text = "a mesh with normals is made of it".to_owned();
            (text, self.material_name(shade.material))
        });
        let shared = self.most_shown().map(|instance| {
            let text = format!("{} places of meshes that are stored once", instances.len());
            by(text, &instance.name)
        });
        let wide = self.features.layouts.contains(&NodeLayout::Wide);
        let nodes = format!("{} nodes with up to four children", wide_nodes.len());
        let binary = because("the tree is binary, or one leaf");
        vec![
            Self::row(name_of(bit::TRIANGLES), self.features.triangles, meshes, None),
            Self::row("smooth normals", self.features.smooth_normals, smooth, None),
            Self::row(name_of(bit::SPHERES), self.features.spheres, balls, None),
            Self::row(name_of(bit::INSTANCES), self.features.instances, shared, None),
            Self::row(name_of(bit::WIDE_NODES), wide, Some((nodes, None)), Some(binary)),
        ]
    }

    /// The first instance of the mesh that has most of them.
    fn most_shown(&self) -> Option<&Instance> {
        let mut shown: BTreeMap<(usize, &Parts), (usize, &Instance)> = BTreeMap::new();
        for instance in &self.scene.instances {
            if let Shape::Mesh { asset, parts } = &instance.shape {
                shown.entry((*asset, parts)).or_insert((0, instance)).0 += 1;
            }
        }
        // The last of the greatest in reverse order is the first.
        shown.into_values().rev().max_by_key(|(count, _)| *count).map(|(_, first)| first)
    }

    fn material_name(&self, index: u32) -> Option<Declared> {
        self.lowered.material_names.get(index as usize).cloned()
    }

    /// The first material that `wanted` is true of, and how many more there are.
    fn materials(&self, text: &str, wanted: impl Fn(&Material) -> bool) -> Option<Reason> {
        let (materials, names) = (&self.lowered.materials, &self.lowered.material_names);
        let mut found = materials.iter().zip(names).filter(|(material, _)| wanted(material));
        let (_, first) = found.next()?;
        let more = match found.count() {
            0 => String::new(),
            n => format!(", and {n} more"),
        };
        Some((format!("{text}{more}"), Some(first.clone())))
    }

    fn material_kind(&self, kind: MaterialKind) -> Row {
        let users = self.materials("a material", |material| material.kind == kind as u32);
        let kept = self.features.materials.contains(&kind);
        Self::row(name_of(kind.feature()), kept, users, None)
    }

    fn material_parts(&self) -> Vec<Row> {
        let features = self.features;
        let flag = |flag: u32| move |material: &Material| material.flags & flag != 0;
        let row = |wanted: u64, kept: bool, why: Option<Reason>, why_not: Option<Reason>| {
            Self::row(name_of(wanted), kept, why, why_not)
        };
        let clipped = self.materials("cut out by alpha", flag(material_flag::ALPHA_CLIP));
        let partial = self.materials("alpha is its coverage", Material::is_partial);
        let tangents = self.materials("has a direction", flag(material_flag::TANGENT));
        let objects = self.materials("depends on the thing", flag(material_flag::OBJECT));
        let maps = self.materials("has one", |material| material.normal_texture != NONE);
        let flat = self
            .scene
            .materials
            .iter()
            .find(|material| material.normal.is_some_and(|map| map.strength.abs() <= 0.0));
        let flat = flat.map(|material| by("its strength is 0".to_owned(), &material.name));
        let specular = self.materials("has a factor or a colour", Material::has_specular);
        let coat = self.materials("has one", Material::has_coat);
        let transmission = self.materials("lets light through", Material::has_transmission);
        let sheen = self.materials("has some", Material::has_sheen);
        let brushed = self.materials("is brushed", Material::is_brushed);
        let through = flag(material_flag::THROUGH);
        let through = self.materials("shadow rays go on behind it", through);
        let sheets = self.materials("light goes straight through it", Material::is_sheet);
        vec![
            row(bit::ALPHA_CLIP, features.alpha_clip, clipped, None),
            row(bit::ALPHA_BLEND, features.alpha_blend, partial, None),
            row(bit::TANGENTS, features.tangents, tangents, None),
            row(bit::OBJECTS, features.objects, objects, None),
            row(bit::NORMAL_MAPS, features.normal_maps, maps, flat),
            row(bit::PRINCIPLED_SPECULAR, features.principled_specular, specular, None),
            row(bit::PRINCIPLED_COAT, features.principled_coat, coat, None),
            row(bit::PRINCIPLED_TRANSMISSION, features.principled_transmission, transmission, None),
            row(bit::PRINCIPLED_SHEEN, features.principled_sheen, sheen, None),
            row(bit::PRINCIPLED_ANISOTROPY, features.principled_anisotropy, brushed, None),
            row(bit::THROUGH, features.through, through, None),
            row(bit::SHEETS, features.sheets, sheets, None),
        ]
    }

    /// The declaration of a light of the table.
    fn light_name(&self, light: &pack::abi::Light) -> Option<Declared> {
        if light.kind == LightKind::Sky as u32 {
            return self.scene.sky.as_ref().map(|sky| declared(&sky.name));
        }
        if light.kind == LightKind::Directional as u32 {
            let before = self.scene.instances.len() + self.scene.lights.len();
            let light = self.scene.directional.get(light.primitive as usize - before);
            return light.map(|light| declared(&light.name));
        }
        self.material_name(light.material)
    }

    fn light_kind(&self, kind: LightKind) -> Row {
        let mut found = self.lowered.lights.iter().filter(|light| light.kind == kind as u32);
        let first = found.next();
        let count = found.count() + usize::from(first.is_some());
        let why = first.map(|light| {
            (format!("{count} in the table of lights, the first"), self.light_name(light))
        });
        Self::row(name_of(kind.feature()), self.features.lights.contains(&kind), why, None)
    }

    /// What the camera does not see of sky and directional lights.
    fn unseen_at_infinity(&self) -> Option<Reason> {
        let sky = self.scene.sky.iter().find(|sky| !sky.visible).map(|sky| &sky.name);
        let light = || self.scene.directional.iter().find(|light| !light.visible);
        let name = sky.or_else(|| Some(&light()?.name))?;
        Some(by("is not visible".to_owned(), name))
    }

    fn light_parts(&self) -> Vec<Row> {
        let lights = &self.lowered.lights;
        let n = lights.len();
        let first = lights.first().and_then(|light| self.light_name(light));
        let several = Some((format!("{n} lights, the first"), first.clone()));
        let few = match first {
            Some(name) => ("it is the only one".to_owned(), Some(name)),
            None => because("no light is sampled"),
        };
        let tinted = self.materials("has a tint", |m| m.flags & material_flag::EMIT_TINT != 0);
        let spots = self.materials("is a spot light", |m| m.flags & material_flag::EMIT_SPOT != 0);
        let profiles =
            self.materials("has a profile", |m| m.flags & material_flag::EMIT_PROFILE != 0);
        let unseen = self.materials("is not visible", |m| m.flags & material_flag::UNSEEN != 0);
        let unseen = unseen.or_else(|| self.unseen_at_infinity());
        let white = self.scene.lights.iter().find(|light| light.tint.is_some());
        let white = white.map(|light| by("its tint changes nothing".to_owned(), &light.name));
        vec![
            Self::row(
                name_of(bit::LIGHT_CHOICE),
                self.features.light_choice,
                several.clone(),
                Some(few),
            ),
            Self::row(
                name_of(bit::LIGHT_TREE),
                self.features.light_tree,
                several,
                Some(because("the table of lights is good enough")),
            ),
            Self::row(name_of(bit::TINT), self.features.tint, tinted, white),
            Self::row(name_of(bit::SPOT), self.features.spot, spots, None),
            Self::row(name_of(bit::PROFILE), self.features.profile, profiles, None),
            Self::row(name_of(bit::UNSEEN), self.features.unseen, unseen, None),
        ]
    }

    fn sky(&self, kind: SkyKind) -> Row {
        let declared = self.scene.sky.as_ref();
        let why = declared.map(|sky| by("the sky".to_owned(), &sky.name));
        let fits = |model: &SkyModel| match model {
            SkyModel::Constant(_) => kind == SkyKind::Constant,
            SkyModel::Gradient { .. } => kind == SkyKind::Gradient,
            SkyModel::Image { .. } | SkyModel::SunSky(_) => kind == SkyKind::Image,
        };
        let text = match self.lowered.sky {
            Some(_) => "it has the same colour everywhere",
            None => "it is black",
        };
        let why_not = declared.filter(|sky| fits(&sky.model));
        let why_not = why_not.map(|sky| by(text.to_owned(), &sky.name));
        Self::row(name_of(kind.feature()), self.features.skies.contains(&kind), why, why_not)
    }

    fn view(&self) -> Vec<Row> {
        let Scene { camera, film, render, .. } = self.scene;
        let open = by("its aperture is open".to_owned(), &camera.name);
        let point = by("its aperture is 0".to_owned(), &camera.name);
        let corners = by("its opening has corners".to_owned(), &camera.name);
        let round = by("it has no opening with corners".to_owned(), &camera.name);
        let pcg = self.features.samplers.contains(&SamplerKind::Pcg);
        let chosen = by("its sampler".to_owned(), &render.name);
        let sobol = by("its sampler is another".to_owned(), &render.name);
        let endless = by("its depth is unlimited".to_owned(), &render.name);
        let limited = by("its depth is limited".to_owned(), &render.name);
        let kind = |kind: CameraKind| {
            let kept = self.features.cameras.contains(&kind);
            let seen = by("the camera".to_owned(), &camera.name);
            let other = by("it is of another kind".to_owned(), &camera.name);
            Self::row(name_of(kind.feature()), kept, Some(seen), Some(other))
        };
        let filter = |kind: FilterKind| {
            let kept = self.features.filters.contains(&kind);
            let [chosen, other] =
                ["its filter", "its filter is another"].map(|text| by(text.to_owned(), &film.name));
            Self::row(name_of(kind.feature()), kept, Some(chosen), Some(other))
        };
        vec![
            filter(FilterKind::Box),
            filter(FilterKind::Tent),
            filter(FilterKind::Gaussian),
            filter(FilterKind::BlackmanHarris),
            kind(CameraKind::Orthographic),
            kind(CameraKind::Panoramic),
            Self::row(name_of(bit::LENS), self.features.lens, Some(open), Some(point)),
            Self::row(name_of(bit::BLADES), self.features.blades, Some(corners), Some(round)),
            Self::row(
                name_of(bit::UNLIMITED),
                self.features.unlimited,
                Some(endless),
                Some(limited),
            ),
            Self::row(name_of(bit::SAMPLER_PCG), pcg, Some(chosen), Some(sobol)),
        ]
    }

    fn texture(&self, format: TextureFormat) -> Row {
        let textures = &self.lowered.textures;
        let of_format = |texture: &u32| {
            textures.get(*texture as usize).is_some_and(|t| t.format == format as u32)
        };
        let count = textures.iter().filter(|texture| texture.format == format as u32).count();
        let what = if format == TextureFormat::Expression { "expressions" } else { "images" };
        let text = format!("{count} {what}, the first of");
        let reads = |material: &Material| material.textures().iter().any(of_format);
        let sky = self.scene.sky.as_ref().zip(self.lowered.sky.as_ref());
        let sky = sky.filter(|(_, record)| of_format(&record.texture));
        let sky = sky.map(|(sky, _)| by(text.clone(), &sky.name));
        let users = self.materials(&text, reads).map(|(_, by)| (text.clone(), by));
        Self::row(
            name_of(format.feature()),
            self.features.textures.contains(&format),
            users.or(sky),
            None,
        )
    }

    fn paths(&self) -> Vec<Row> {
        let Scene { media, render, camera, instances, lights, .. } = self.scene;
        let air = render.atmosphere.map(|index| &media[index]);
        let fog = air.filter(|medium| matches!(medium.model, MediumModel::Fog { .. }));
        let air = air.filter(|medium| matches!(medium.model, MediumModel::Homogeneous { .. }));
        let around = (self.lowered.render.air != NONE).then_some(air).flatten();
        let around = around.map(|medium| by("it is around everything".to_owned(), &medium.name));
        let inside = self.materials("has an inside that counts", |material| {
            material.flags & material_flag::INTERIOR != 0
        });
        let clear = air.map(|medium| by("it is clear".to_owned(), &medium.name));
        let cloudy = media.iter().find(|medium| match medium.model {
            MediumModel::Homogeneous { sigma_s, .. } => sigma_s.iter().any(|sigma| *sigma > 0.0),
            MediumModel::Fog { .. } => false,
        });
        let scatters = cloudy.map(|medium| by("it scatters".to_owned(), &medium.name));
        let idle = cloudy.map(|medium| by("nothing is filled with it".to_owned(), &medium.name));
        let thick = fog.map(|medium| by("it is the atmosphere".to_owned(), &medium.name));
        let thin = fog.map(|medium| by("its density is 0".to_owned(), &medium.name));
        let fast = |velocity: &[f64; 3]| velocity.iter().any(|v| v.abs() > 0.0);
        let thing = instances.iter().find(|thing| fast(&thing.velocity) || thing.motion.is_some());
        let light = lights.iter().find(|light| fast(&light.velocity)).map(|light| &light.name);
        let eye = (!camera.keys.is_empty()).then_some(&camera.name);
        let mover = thing.map(|instance| &instance.name).or(light).or(eye);
        let moves = mover.map(|name| by("it moves while the shutter is open".to_owned(), name));
        let [open, close] = camera.shutter;
        let still = if close > open {
            mover.map(|name| by("it comes nowhere while the shutter is open".to_owned(), name))
        } else {
            mover.map(|_| by("its shutter is closed".to_owned(), &camera.name))
        };
        vec![
            Self::row(name_of(bit::MEDIA), self.features.media, around.or(inside), clear),
            Self::row(name_of(bit::SCATTERING), self.features.scattering, scatters, idle),
            Self::row(name_of(bit::FOG), self.features.fog, thick, thin),
            Self::row(name_of(bit::MOTION), self.features.motion, moves, still),
        ]
    }
}
