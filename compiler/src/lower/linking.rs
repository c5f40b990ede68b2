//! Light linking: names of instances become sets of lights, and bits of what each set lights.

use lang::scene::{LightLinks, Scene};
use pack::abi::{self, LightKind, LightLink, MOVES, NONE, OBJECT_OF_INSTANCE, TRI_SMOOTH};

use super::world::Sections;

/// Number of the object that a light is; `None` for a sky.
pub(super) fn object_of(light: &abi::Light, sections: &Sections) -> Option<u32> {
    let primitive = light.primitive as usize;
    match LightKind::from_tag(light.kind)? {
        LightKind::Sphere => sections.spheres.get(primitive).map(|sphere| sphere.object & !MOVES),
        LightKind::Rectangle | LightKind::Triangle => {
            sections.shades.get(primitive).map(|shade| shade.object & !TRI_SMOOTH)
        }
        LightKind::Directional => Some(light.primitive),
        LightKind::Sky => None,
    }
}

/// The records of all lights, then those of all things; empty where every light lights everything.
pub(super) fn links(scene: &Scene, lights: &[abi::Light], sections: &Sections) -> Vec<LightLink> {
    let sets = LightLinks::sets(scene.light_links());
    if sets.is_empty() {
        return Vec::new();
    }
    let receives = |name: &str| bits(&sets, |links| links.light(name));
    let own = |links: &Option<LightLinks>| {
        links.as_ref().map_or(0, |own| bits(&sets, |links| links.is_same(own)))
    };
    let instance = scene.instances.iter().map(|instance| LightLink {
        receives: receives(&instance.name.text),
        own_set: own(&instance.links),
        ..LightLink::default()
    });
    let rest = bits(&sets, LightLinks::lights_the_rest);
    let lamps = scene.lights.iter().map(|light| &light.links);
    let far = scene.directional.iter().map(|light| &light.links);
    let lamps = lamps.chain(far);
    let lamp = lamps.map(|links| LightLink {
        receives: rest,
        own_set: own(links),
        ..LightLink::default()
    });
    let things: Vec<LightLink> = instance.chain(lamp).collect();
    let of_light = |light: &abi::Light| {
        let object = object_of(light, sections).and_then(|object| things.get(object as usize));
        LightLink { own_set: object.map_or(0, |link| link.own_set), ..LightLink::default() }
    };
    lights.iter().map(of_light).chain(things.iter().copied()).collect()
}

/// A bit for each set that is meant.
fn bits(sets: &[&LightLinks], meant: impl Fn(&LightLinks) -> bool) -> u32 {
    let bit = |(k, links): (u32, &&LightLinks)| if meant(links) { 1_u32 << k } else { 0 };
    (0..).zip(sets).map(bit).sum()
}

/// Says of each medium which lights light it: those of everything that it fills. `around`: what is around everything,
/// which no light can name.
pub(super) fn media(
    scene: &Scene,
    links: &[LightLink],
    (materials, media): (&[abi::Material], &mut [abi::Medium]),
    (sections, around): (&Sections, [u32; 2]),
) {
    if links.is_empty() || media.is_empty() {
        return;
    }
    let n_things = scene.instances.len() + scene.lights.len() + scene.directional.len();
    let things = &links[links.len() - n_things..];
    let mut fill = |material: u32, receives: u32| {
        let medium = materials.get(material as usize).map_or(NONE, |material| material.medium);
        if let Some(medium) = media.get_mut(medium as usize) {
            medium.receives |= receives;
        }
    };
    let of = |object: u32| things.get(object as usize).map_or(0, |link| link.receives);
    // Instances that show a mesh as its file has it may show any of its materials.
    let mut shown = 0;
    for instance in &sections.instances {
        let receives = of(instance.object & !MOVES);
        match instance.material {
            NONE => shown |= receives,
            material => fill(material, receives),
        }
    }
    for shade in &sections.shades {
        let object = shade.object & !TRI_SMOOTH;
        fill(shade.material, if object == OBJECT_OF_INSTANCE { shown } else { of(object) });
    }
    for sphere in &sections.spheres {
        fill(sphere.material, of(sphere.object & !MOVES));
    }
    if let Some(air) = media.get_mut(around[0] as usize) {
        let sets = LightLinks::sets(scene.light_links());
        air.receives |= bits(&sets, LightLinks::lights_the_rest);
    }
}
