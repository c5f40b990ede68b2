//! Rows of layers, and those of crops that are put in their place.

use super::{Group, Layer, Layers, Matte, Nearest};
use crate::plane::place;
use crate::region::Rect;
use std::collections::BTreeMap;
use std::ops::Range;

impl Layers {
    /// The same layers without pixels.
    pub(crate) fn head(&self) -> Self {
        let mut head = self.pixels(&(0..0));
        head.take_names(self);
        head
    }

    /// Some of the pixels. The names of mattes, of which there may be thousands, are left to the head.
    pub(crate) fn pixels(&self, at: &Range<usize>) -> Self {
        let group = |group: &Group| Group { sums: some(&group.sums, at), ..named(group) };
        let matte = |matte: &Matte| Matte {
            kind: matte.kind,
            names: BTreeMap::new(),
            shares: some(&matte.shares, at),
        };
        Self {
            wanted: self.wanted.clone(),
            samples: self.samples,
            albedo: some(&self.albedo, at),
            normal: some(&self.normal, at),
            lights: self.lights.iter().map(group).collect(),
            covered: some(&self.covered, at),
            nearest: some(&self.nearest, at),
            mattes: self.mattes.iter().map(matte).collect(),
        }
    }

    /// Takes the names of mattes from the head of the same layers.
    pub(crate) fn take_names(&mut self, head: &Self) {
        let mattes = self.mattes.iter_mut().zip(&head.mattes);
        mattes.for_each(|(matte, head)| matte.names.clone_from(&head.names));
    }

    /// The same layers with `n` pixels that show nothing, without the names of mattes.
    pub(crate) fn blank(&self, n: usize) -> Self {
        let sums = |layer| if self.has(layer) { vec![[0.0; 3]; n] } else { Vec::new() };
        let group = |group: &Group| Group { sums: vec![[0.0; 3]; n], ..named(group) };
        let matte = |matte: &Matte| Matte {
            kind: matte.kind,
            names: BTreeMap::new(),
            shares: vec![Vec::new(); n],
        };
        let is_nearest = self.wanted.layers.iter().any(|layer| layer.is_nearest());
        Self {
            wanted: self.wanted.clone(),
            samples: self.samples,
            albedo: sums(Layer::Albedo),
            normal: sums(Layer::Normal),
            lights: self.lights.iter().map(group).collect(),
            covered: if self.has(Layer::Alpha) { vec![0; n] } else { Vec::new() },
            nearest: if is_nearest { vec![Nearest::NONE; n] } else { Vec::new() },
            mattes: self.mattes.iter().map(matte).collect(),
        }
    }

    /// Takes the pixels of a part of the picture: `region` is that of these layers, `of` lies inside of it.
    pub(crate) fn place(&mut self, region: Rect, part: &Self, of: Rect) {
        place((&mut self.albedo, region), (&part.albedo, of));
        place((&mut self.normal, region), (&part.normal, of));
        place((&mut self.covered, region), (&part.covered, of));
        place((&mut self.nearest, region), (&part.nearest, of));
        for (group, part) in self.lights.iter_mut().zip(&part.lights) {
            place((&mut group.sums, region), (&part.sums, of));
        }
        for (matte, part) in self.mattes.iter_mut().zip(&part.mattes) {
            place((&mut matte.shares, region), (&part.shares, of));
        }
    }
}

fn named(group: &Group) -> Group {
    Group { name: group.name.clone(), sums: Vec::new() }
}

/// Some values of a plane, none of one that is not there.
fn some<T: Clone>(plane: &[T], at: &Range<usize>) -> Vec<T> {
    plane.get(at.clone()).unwrap_or_default().to_vec()
}
