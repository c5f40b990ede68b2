//! What is remembered of each thing of a pack, so that those that stay need not be made again when others move.
//!
//! With the pack, whose triangles are in the order of leaves, it stands for the triangles of every instance as they
//! were declared. It grows with the triangles, four bytes each, and is kept apart from the sketch: most edits do
//! without it.

use std::ops::Range;

use lang::scene::{Scene, Shape};
use pack::Pack;
use pack::abi::{self, LightKind, NONE};
use serde::{Deserialize, Serialize};

use super::extent::Extent;
use super::geometry::{Ends, Placement};
use super::light::Emitter;
use super::share::{MeshFacts, Plan};
use super::stored::{KnownMesh, Stored};

/// See the module.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Roster {
    /// Instances, then lights.
    pub(super) things: Vec<KnownThing>,
    pub(super) plan: Plan,
    /// Those that are stored once.
    pub(super) meshes: Vec<KnownMesh>,
    /// What emits of the instances that show meshes, in order.
    pub(super) emitters: Vec<KnownTriangle>,
    /// Centre and radius of the ball around what receives light.
    pub(super) ball: Option<([f64; 3], f64)>,
    /// Where each triangle is in the pack, first those of the things, then those of `meshes`.
    #[serde(with = "words")]
    pub(super) at: Vec<u32>,
}

/// A thing of an earlier pack.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownThing {
    /// Where an instance was.
    world_from_object: [[f64; 4]; 3],
    /// Of the mesh that it shows.
    pub(super) facts: Option<MeshFacts>,
    /// Triangles of its own.
    pub(super) n_triangles: u32,
    /// Those that had no area.
    pub(super) dropped: u32,
    /// Those that emit, if it shows a mesh.
    n_emitters: u32,
    pub(super) extent: Extent,
}

/// A triangle that emits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownTriangle {
    /// Which of its instance.
    triangle: u32,
    material: u32,
    area: f64,
}

impl KnownThing {
    /// All things of a placement; `before`: what each brought with the triangles that had no area.
    pub(super) fn all(
        scene: &Scene,
        placement: &Placement,
        before: &[(Ends, Ends)],
        extents: Vec<Extent>,
        facts: &[Option<MeshFacts>],
    ) -> Vec<Self> {
        let n_triangles = |(from, to): &(Ends, Ends)| to.triangles - from.triangles;
        let spans: Vec<(Ends, Ends)> = placement.spans().collect();
        let thing = |(index, extent): (usize, Extent)| {
            let instance = scene.instances.get(index);
            let is_mesh = instance.is_some_and(|i| matches!(i.shape, Shape::Mesh { .. }));
            let (from, to) = spans[index];
            Self {
                world_from_object: instance.map_or([[0.0; 4]; 3], |i| i.world_from_object),
                facts: facts.get(index).copied().flatten(),
                n_triangles: n_triangles(&spans[index]),
                dropped: n_triangles(&before[index]) - n_triangles(&spans[index]),
                n_emitters: if is_mesh { to.emitters - from.emitters } else { 0 },
                extent,
            }
        };
        extents.into_iter().enumerate().map(thing).collect()
    }

    /// Whether it is an instance that stands where it stood.
    pub(super) fn stays(&self, world_from_object: &[[f64; 4]; 3]) -> bool {
        let bits = |rows: &[[f64; 4]; 3]| rows.map(|row| row.map(f64::to_bits));
        bits(world_from_object) == bits(&self.world_from_object)
    }
}

/// What emits of the instances that show meshes.
pub(super) fn emitters(things: &[KnownThing], placement: &Placement) -> Vec<KnownTriangle> {
    let mut found = Vec::new();
    for (thing, (from, _)) in things.iter().zip(placement.spans()) {
        let emitters = &placement.emitters[from.emitters as usize..];
        found.extend(emitters[..thing.n_emitters as usize].iter().map(|emitter| KnownTriangle {
            triangle: emitter.primitive - from.triangles,
            material: emitter.material,
            area: emitter.area,
        }));
    }
    found
}

/// A roster and the pack that was made with it, which fit each other.
pub(super) struct Earlier<'a> {
    roster: &'a Roster,
    triangles: &'a [abi::Triangle],
    shades: &'a [abi::TriShade],
    /// Where the triangles and the emitters of each thing begin.
    starts: Vec<[u32; 2]>,
}

impl<'a> Earlier<'a> {
    /// `None` if they do not fit.
    pub(super) fn new(roster: &'a Roster, pack: &'a Pack) -> Option<Self> {
        let (mut starts, mut next) = (Vec::with_capacity(roster.things.len()), [0_u32; 2]);
        for thing in &roster.things {
            starts.push(next);
            let end = |k: usize, n: u32| next[k].checked_add(n);
            next = [end(0, thing.n_triangles)?, end(1, thing.n_emitters)?];
        }
        let stored: usize = roster.meshes.iter().map(|mesh| mesh.n_triangles).sum();
        let (triangles, shades): (&[abi::Triangle], &[abi::TriShade]) =
            (pack.records(), pack.records());
        let fits = next[0] as usize + stored == roster.at.len()
            && next[1] as usize == roster.emitters.len()
            && triangles.len() == shades.len()
            && roster.at.iter().all(|at| (*at as usize) < triangles.len());
        fits.then_some(Self { roster, triangles, shades, starts })
    }

    /// Triangles of a thing, by their number in the roster.
    pub(super) fn triangles_of(&self, thing: usize) -> Range<usize> {
        let first = self.starts[thing][0] as usize;
        first..first + self.roster.things[thing].n_triangles as usize
    }

    /// A triangle and what is known of it, without its light.
    pub(super) fn triangle(&self, number: usize) -> (&abi::Triangle, abi::TriShade) {
        let at = self.roster.at[number] as usize;
        (&self.triangles[at], abi::TriShade { light: NONE, ..self.shades[at] })
    }

    /// The emitters of a thing, whose triangles now begin at `first`.
    pub(super) fn emitters_of(&self, thing: usize, first: u32) -> impl Iterator<Item = Emitter> {
        let from = self.starts[thing][1] as usize;
        let all = &self.roster.emitters[from..][..self.roster.things[thing].n_emitters as usize];
        all.iter().map(move |known| Emitter {
            kind: LightKind::Triangle,
            primitive: first + known.triangle,
            count: 1,
            material: known.material,
            area: known.area,
            tint: [0.0; 4],
        })
    }

    /// The meshes that are stored once, and the ids of the corners of all their triangles.
    pub(super) fn meshes(&self) -> (Vec<Stored>, Vec<[u32; 3]>) {
        let mut ids = Vec::new();
        let mut number = self.roster.at.len();
        number -= self.roster.meshes.iter().map(|mesh| mesh.n_triangles).sum::<usize>();
        let mesh = |known: &KnownMesh| {
            let numbers = number..number + known.n_triangles;
            number = numbers.end;
            let (corners, shades) = numbers
                .map(|number| {
                    let (triangle, shade) = self.triangle(number);
                    ids.push([triangle.id0, triangle.id1, triangle.id2]);
                    ([triangle.v0, triangle.v1, triangle.v2], shade)
                })
                .unzip();
            Stored::again(known, corners, shades)
        };
        (self.roster.meshes.iter().map(mesh).collect(), ids)
    }
}

/// A list of numbers as its bytes.
mod words {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(
        words: &[u32],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(bytemuck::cast_slice(words))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<u32>, D::Error> {
        let bytes = Vec::<u8>::deserialize(deserializer)?;
        let (words, []) = bytes.as_chunks::<4>() else {
            return Err(D::Error::custom("another length"));
        };
        Ok(words.iter().map(|word| u32::from_le_bytes(*word)).collect())
    }
}
