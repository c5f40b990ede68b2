//! Manifest → the numbers and ids by which layers name objects, instances and materials.

use crate::layers::{Matte, MatteKind};
use pack::Manifest;
use std::collections::BTreeMap;

/// What names the scene has: number and id of the object and of the instance of each thing, of each material, and the
/// mattes without pixels.
#[expect(clippy::type_complexity, reason = "three tables that are taken apart at once")]
pub(super) fn names(manifest: &Manifest) -> (Vec<[(u32, u32); 2]>, Vec<(u32, u32)>, Vec<Matte>) {
    // In the order in which the compiler numbers things.
    let all = manifest.instances.iter().chain(&manifest.lights);
    let instances: Vec<&str> = all.map(|named| named.name.as_str()).collect();
    let objects: Vec<&str> = instances.iter().map(|name| object_of(name)).collect();
    let materials: Vec<&str> = manifest.materials.iter().map(|named| named.name.as_str()).collect();
    let [of_objects, of_instances, of_materials] =
        [&objects, &instances, &materials].map(|names| numbered(names));
    let things = of_objects.into_iter().zip(of_instances).map(|(o, i)| [o, i]).collect();
    let names = [objects, instances, materials];
    let mattes = MatteKind::ALL.into_iter().zip(names).map(|(kind, n)| Matte::new(kind, n));
    (things, of_materials, mattes.collect())
}

/// `petals` of `petals[3]`: all copies that one declaration makes.
fn object_of(instance: &str) -> &str {
    instance.split('[').next().unwrap_or(instance)
}

/// For each name the number of its first place, from 1, and its id.
fn numbered(names: &[&str]) -> Vec<(u32, u32)> {
    let mut first = BTreeMap::new();
    for (name, number) in names.iter().zip(1_u32..) {
        first.entry(*name).or_insert(number);
    }
    let of = |name: &&str| (first.get(name).copied().unwrap_or(0), crate::layers::id_of(name));
    names.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_of_an_instance_are_one_object() {
        assert_eq!((object_of("petals[3]"), object_of("floor")), ("petals", "floor"));
        let found = numbered(&["floor", "petals", "petals"]);
        assert_eq!(found.iter().map(|row| row.0).collect::<Vec<_>>(), [1, 2, 2]);
    }
}
