//! Pack + manifest → which light group everything that gives off light is in.

use crate::job::Job;
use crate::layers::{Group, Layer};
use crate::scene::Scene;
use pack::abi::{Instance, Light, LightKind, LightSurface, NONE, Sphere, TriShade};
use pack::manifest::{REST, SKY};

/// The bit beside the index of an object: `TRI_SMOOTH` or `MOVES`.
const OBJECT: u32 = (1 << 31) - 1;

/// What gave light.
#[derive(Clone, Copy, Debug)]
pub(super) enum Emitter {
    /// Index of the `Light` that a shadow ray has reached.
    Light(u32),
    /// Index of the sphere that a ray has hit.
    Sphere(u32),
    /// Index of the triangle that a ray has hit, and of the instance that it is of, or `NONE`.
    Triangle(u32, u32),
    /// A ray that has hit nothing.
    Sky,
}

/// Who is in which group.
pub(crate) struct LightGroups<'a> {
    /// In the order of files.
    pub(super) names: Vec<String>,
    /// Runs of objects: first, one behind the last, index of the group; ascending.
    runs: Vec<(u32, u32, usize)>,
    sky: usize,
    /// Index of [`REST`].
    pub(super) rest: usize,
    lights: &'a [Light],
    spheres: &'a [Sphere],
    shades: &'a [TriShade],
    instances: &'a [Instance],
}

impl<'a> LightGroups<'a> {
    pub(crate) fn of(scene: &'a Scene) -> Self {
        let pack = scene.pack();
        let named = pack.manifest().unwrap_or_default().groups;
        let sky = named.iter().find(|group| group.sky).map_or(SKY, |group| group.name.as_str());
        let mut names: Vec<String> = named.iter().map(|group| group.name.clone()).collect();
        names.push(REST.to_owned());
        if pack.sky().is_some() {
            names.push(sky.to_owned());
        }
        Group::sort(&mut names);
        names.dedup();
        let index = |name: &str| names.iter().position(|own| own == name);
        let rest = index(REST).unwrap_or(0);
        let run = |group: &pack::manifest::Group| {
            let own = index(&group.name).unwrap_or(rest);
            let run = move |(first, n): &(u32, u32)| (*first, first.saturating_add(*n), own);
            group.objects.iter().map(run).collect::<Vec<_>>()
        };
        let mut runs: Vec<_> = named.iter().flat_map(run).collect();
        runs.sort_unstable();
        Self {
            sky: index(sky).unwrap_or(rest),
            rest,
            runs,
            lights: pack.records(),
            spheres: pack.records(),
            shades: pack.records(),
            instances: pack.records(),
            names,
        }
    }

    /// How many of them the job wants.
    pub(crate) fn count(scene: &Scene, job: &Job) -> u64 {
        let wanted = job.wanted.layers.contains(&Layer::Lights);
        if wanted { LightGroups::of(scene).names.len() as u64 } else { 0 }
    }

    /// The groups, without light.
    pub(crate) fn empty(&self, pixels: usize) -> Vec<Group> {
        let group = |name: &String| Group { name: name.clone(), sums: vec![[0.0; 3]; pixels] };
        self.names.iter().map(group).collect()
    }

    pub(super) fn of_emitter(&self, emitter: Emitter) -> usize {
        let object = match emitter {
            Emitter::Sky => return self.sky,
            Emitter::Light(index) => return self.of_light(index),
            Emitter::Sphere(index) => self.spheres.get(at(index)).map(|sphere| sphere.object),
            Emitter::Triangle(index, NONE) => self.shades.get(at(index)).map(|shade| shade.object),
            Emitter::Triangle(_, index) => self.instances.get(at(index)).map(|place| place.object),
        };
        object.map_or(self.rest, |object| self.of_object(object & OBJECT))
    }

    fn of_light(&self, index: u32) -> usize {
        let Some(light) = self.lights.get(at(index)) else { return self.rest };
        let kind = LightKind::ALL.into_iter().find(|kind| *kind as u32 == light.kind);
        match kind.map(LightKind::surface) {
            Some(Some(LightSurface::Sphere)) => self.of_emitter(Emitter::Sphere(light.primitive)),
            Some(Some(LightSurface::Triangles)) => {
                self.of_emitter(Emitter::Triangle(light.primitive, NONE))
            }
            Some(None) if kind == Some(LightKind::Directional) => self.of_object(light.primitive),
            Some(None) => self.sky,
            None => self.rest,
        }
    }

    fn of_object(&self, object: u32) -> usize {
        let after = self.runs.partition_point(|(first, ..)| *first <= object);
        let run = after.checked_sub(1).and_then(|i| self.runs.get(i));
        run.filter(|(_, end, _)| object < *end).map_or(self.rest, |(.., group)| *group)
    }
}

fn at(index: u32) -> usize {
    usize::try_from(index).unwrap_or(usize::MAX)
}
