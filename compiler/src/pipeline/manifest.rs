//! Names, places and counts for people who look into a pack, and the name of its inputs.

use std::collections::BTreeMap;

use lang::scene::{Instance, Name, Scene, Shape};
use lang::source::{SourceSet, Span};
use pack::Manifest;
use pack::manifest::{Feature, Group, KernelSize, Named, Shown};
use shaders::FeatureSet;

use super::explain::{Explain, Row};
use super::files::{FileRead, relative};
use super::options::Options;
use crate::bvh::{Layout, Preset};
use crate::lower::{Instancing, Lowered, Trees, Visibility};

/// What a manifest is made from.
pub(super) struct Context<'a> {
    pub(super) scene: &'a Scene,
    pub(super) sources: &'a SourceSet,
    pub(super) options: &'a Options<'a>,
    pub(super) files: &'a [FileRead],
}

impl Context<'_> {
    pub(super) fn manifest(
        &self,
        lowered: &Lowered,
        features: &FeatureSet,
        kernel: KernelSize,
    ) -> Manifest {
        let scene = self.scene;
        let counters = &lowered.counters;
        let texts = self.sources.ids().map(|id| self.file_name(self.sources.name(id)));
        let assets = self.files.iter().map(|file| file.name.clone());
        let rows = Explain { scene, features, lowered }.rows();
        let (kept, left): (Vec<_>, Vec<_>) = rows.into_iter().partition(|row| row.kept);
        let features_kept = kept.into_iter().map(|row| self.feature(row)).collect();
        let features_left_out = left.into_iter().map(|row| self.feature(row)).collect();
        Manifest {
            scene: scene.render.name.text.clone(),
            rtc_version: env!("CARGO_PKG_VERSION").to_owned(),
            output: scene.render.output.clone(),
            layers: scene.render.layers.iter().map(|l| l.word().to_owned()).collect(),
            files: texts.chain(assets).collect(),
            materials: lowered
                .material_names
                .iter()
                .map(|(name, span)| self.named(name, *span))
                .collect(),
            instances: scene.instances.iter().map(|i| self.declared(&i.name)).collect(),
            shown: scene.instances.iter().map(|i| self.shown(i)).collect(),
            textures: scene.textures.iter().map(|t| self.declared(&t.name)).collect(),
            lights: scene
                .lights
                .iter()
                .map(|l| &l.name)
                .chain(scene.directional.iter().map(|l| &l.name))
                .map(|name| self.declared(name))
                .collect(),
            groups: groups(scene),
            cameras: vec![self.declared(&scene.camera.name)],
            features_kept,
            features_left_out,
            kernel,
            options: self.named_options(),
            counters: vec![
                ("triangles".to_owned(), counters.triangles),
                ("triangles in leaves".to_owned(), counters.references),
                ("meshes stored once".to_owned(), counters.meshes),
                ("instances of them".to_owned(), counters.instances),
                ("triangles shown".to_owned(), counters.shown),
                ("triangles without area, left out".to_owned(), counters.dropped_triangles),
                ("vertices".to_owned(), counters.vertices),
                ("spheres".to_owned(), counters.spheres),
                ("lights".to_owned(), counters.lights),
            ],
        }
    }

    /// What was asked for on the command line, where it is not what everybody gets.
    fn named_options(&self) -> Vec<String> {
        let Trees { preset, layout, instancing, visibility, .. } = self.options.trees;
        let bvh = (preset != Preset::default()).then(|| format!("--bvh {preset}"));
        let defines = self.options.defines.iter().map(|(n, v)| format!("-D {n}={v}"));
        let nodes = (layout != Layout::default()).then(|| format!("--nodes {layout}"));
        let instances =
            (instancing != Instancing::default()).then(|| format!("--instances {instancing}"));
        let visibility =
            (visibility != Visibility::default()).then(|| format!("--visibility {visibility}"));
        defines.chain(bvh).chain(nodes).chain(instances).chain(visibility).collect()
    }

    /// BLAKE3 over compiler version, tree builder, layout of nodes, overrides, scene texts and files.
    pub(super) fn recipe_id(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        let mut field = |bytes: &[u8]| {
            // The length first: no two lists of fields hash the same bytes.
            hasher.update(&(bytes.len() as u64).to_le_bytes());
            hasher.update(bytes);
        };
        field(env!("CARGO_PKG_VERSION").as_bytes());
        field(self.options.trees.preset.recipe().as_bytes());
        field(self.options.trees.layout.recipe().as_bytes());
        field(self.options.trees.instancing.to_string().as_bytes());
        field(self.options.trees.visibility.to_string().as_bytes());
        for (name, value) in self.options.defines {
            field(name.as_bytes());
            field(value.as_bytes());
        }
        for id in self.sources.ids() {
            field(self.sources.text(id).as_bytes());
        }
        for file in self.files {
            field(file.name.as_bytes());
            field(&file.hash);
        }
        *hasher.finalize().as_bytes()
    }

    fn feature(&self, Row { name, reason, by, .. }: Row) -> Feature {
        let by = by.map(|(name, span)| self.named(&name, span));
        Feature { name: name.to_owned(), reason, by }
    }

    fn shown(&self, instance: &Instance) -> Shown {
        let (shape, mesh) = match &instance.shape {
            Shape::Sphere { .. } => ("sphere", None),
            Shape::Rectangle { .. } => ("rectangle", None),
            Shape::Quad { .. } => ("quad", None),
            Shape::Box { .. } => ("box", None),
            Shape::Faces { .. } => ("mesh", None),
            Shape::Mesh { asset, parts } => ("mesh", Some((*asset, parts))),
        };
        let asset = mesh.and_then(|(asset, _)| self.scene.assets.get(asset));
        Shown {
            object: instance.object.as_ref().map(|name| self.declared(name)),
            shape: self.named(shape, Some(instance.shape_span)),
            asset: asset.map(|asset| self.declared(&asset.name)),
            part: mesh.and_then(|(_, parts)| parts.name().map(str::to_owned)),
        }
    }

    fn declared(&self, name: &Name) -> Named {
        self.named(&name.text, Some(name.span))
    }

    fn named(&self, name: &str, span: Option<Span>) -> Named {
        let name = name.to_owned();
        match span {
            Some(span) => Named { name, file: span.file.0, line: self.sources.start(span).line },
            None => Named { name, file: u32::MAX, line: 0 },
        }
    }

    fn file_name(&self, name: &str) -> String {
        relative(name.as_ref(), self.options.root)
    }
}

/// The light groups that the scene names, and the objects of the pack that are in each: instances first, then lights,
/// those at infinity last.
fn groups(scene: &Scene) -> Vec<Group> {
    let instances = scene.instances.iter().map(|instance| instance.group.as_ref());
    let lights = scene.lights.iter().map(|light| light.group.as_ref());
    let far = scene.directional.iter().map(|light| light.group.as_ref());
    let mut runs: BTreeMap<&str, Vec<(u32, u32)>> = BTreeMap::new();
    for (object, group) in (0..).zip(instances.chain(lights).chain(far)) {
        let Some(group) = group else { continue };
        let runs = runs.entry(group).or_default();
        match runs.last_mut() {
            Some((first, count)) if *first + *count == object => *count += 1,
            _ => runs.push((object, 1)),
        }
    }
    let sky = scene.sky.as_ref().and_then(|sky| sky.group.as_deref());
    if let Some(sky) = sky {
        runs.entry(sky).or_default();
    }
    let group = |(name, objects): (&str, _)| Group {
        name: name.to_owned(),
        sky: sky == Some(name),
        objects,
    };
    runs.into_iter().map(group).collect()
}
