//! Checked declarations become the scene: names turn into indices, lists are sorted by name.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use super::instance::Placed;
use super::light::{Lit, Panel};
use super::render::name;
use super::transform::Way;
use super::{
    Checker, dark, ids_of, is_in_world, light, link_sets, material, medium, mix, motion, sky,
};
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::ShapeValue;
use crate::material::{Emissive, Reader, TextureProjection};
use crate::resolve::ItemId;
use crate::scene::{
    Asset, Directional, Instance, Light, Material, MaterialModel, MaterialOfFile, Medium, Name,
    Profile, Scalar, Scene, Shape, Texture, TextureExpression,
};
use crate::schema::Kind;
use crate::shape::{MeshEdit, Parts};

/// Indices in the scene of what materials name: textures, expressions of them, media, materials, mesh files.
type Index<'a> = (
    &'a dyn Fn(ItemId) -> usize,
    &'a dyn Fn(&TextureExpression<ItemId>) -> usize,
    [&'a BTreeMap<ItemId, usize>; 3],
);

impl Checker {
    /// Builds the scene, as far as it is sound.
    pub(super) fn build(mut self, ev: &mut Evaluator<'_>) -> Option<Scene> {
        let view = self.view(ev);
        let Lights { near, directional, panels, glows } = self.lights(ev);
        if ev.diagnostics.iter().any(Diagnostic::is_error) {
            return None;
        }
        let mut view = view?;
        let mut placed = std::mem::take(&mut self.world.placed);
        placed.sort_by(|a, b| a.key.cmp(&b.key));
        let used: BTreeSet<ItemId> = placed.iter().flat_map(Placed::materials).collect();
        let used = mix::with_parts(used, &self.fields);
        let read: BTreeSet<ItemId> =
            used.iter().filter_map(|id| self.sound(*id)).flat_map(material::textures).collect();
        let profiles = near.iter().filter_map(|(_, profile)| *profile);
        let read: BTreeSet<ItemId> = read.into_iter().chain(profiles).collect();
        let meshes = self.meshes(&placed, &used, view.camera_file);
        let (texture_order, material_order, asset_order) =
            (sorted(ev, &read), sorted(ev, &used), sorted(ev, &meshes));
        let interiors = used.iter().filter_map(|id| self.sound(*id)?.item("interior"));
        let filling: BTreeSet<ItemId> = interiors.chain(view.atmosphere).collect();
        let medium_order = sorted(ev, &filling);
        let medium_at = index(&medium_order);
        view.render.atmosphere = view.atmosphere.and_then(|id| medium_at.get(&id).copied());
        let texture_at = index(&texture_order);
        let texture = |id: ItemId| texture_at.get(&id).copied().unwrap_or(0);
        let expressions = RefCell::new(Vec::new());
        let expression = |of: &TextureExpression<ItemId>| {
            intern(&mut expressions.borrow_mut(), of.named(&|id| texture(*id)))
        };
        let material_at = index(&material_order);
        let asset_at = index(&asset_order);
        if let (Some(of_file), Some(asset)) = (&mut view.camera.of_file, view.camera_file) {
            of_file.base.asset = *asset_at.get(&asset)?;
        }
        let indices = [&medium_at, &material_at, &asset_at];
        let materials =
            self.materials(&material_order, &glows, (&texture, &expression, indices))?;
        let warnings = dark::groups(&placed, |id| materials.get(*material_at.get(&id)?));
        let mut scene = Scene {
            assets: self.assets(&asset_order)?,
            textures: textures(ev, &texture_order)?,
            expressions: expressions.into_inner(),
            materials,
            media: self.media(&medium_order)?,
            instances: instances(placed, &material_at, &asset_at)?,
            lights: near.into_iter().map(|light| profiled(light, &texture)).collect(),
            directional,
            sky: view.sky,
            camera: view.camera,
            film: view.film,
            render: view.render,
        };
        for panel in panels {
            add_panel(&mut scene, panel);
        }
        for warning in warnings {
            ev.tell(warning);
        }
        no_light(ev, &scene);
        nothing_in_the_air(ev, &scene);
        motion::check(ev, &scene);
        link_sets::check(ev, &scene);
        Some(scene)
    }

    /// Mesh files that are shown, or that materials in use or the camera are like something of.
    fn meshes(
        &self,
        placed: &[Placed],
        used: &BTreeSet<ItemId>,
        of_camera: Option<ItemId>,
    ) -> BTreeSet<ItemId> {
        let shown = placed.iter().filter_map(|placed| match *placed.shape {
            ShapeValue::Mesh(id, ..) => Some(id),
            ShapeValue::Plain(_) | ShapeValue::Object(..) | ShapeValue::Objects(_) => None,
        });
        let of_materials = used.iter().filter_map(|id| self.sound(*id)?.of_file.as_ref());
        shown.chain(of_materials.map(|base| base.asset)).chain(of_camera).collect()
    }

    /// Lights of the world.
    fn lights(&self, ev: &mut Evaluator<'_>) -> Lights {
        let Lights { near: mut lights, mut directional, mut panels, mut glows } = Lights::default();
        for id in ids_of(ev.program, Kind::Light) {
            let name = name(ev, id);
            let built = self.sound(id).and_then(|fields| light::light(ev, name, fields));
            match built.filter(|_| is_in_world(ev.program, id)) {
                Some(Lit::Ball(light)) => {
                    let profile = self.sound(id).and_then(|fields| fields.item("profile"));
                    lights.push((*light, profile));
                }
                Some(Lit::Directional(light)) => directional.push(*light),
                Some(Lit::Panel(panel)) => panels.push(*panel),
                Some(Lit::Glow(glow)) => {
                    glows.insert(id, *glow);
                }
                None => {}
            }
        }
        lights.sort_by(|a, b| a.0.name.text.cmp(&b.0.name.text));
        directional.sort_by(|a, b| a.name.text.cmp(&b.name.text));
        panels.sort_by(|a, b| a.name.text.cmp(&b.name.text));
        Lights { near: lights, directional, panels, glows }
    }

    fn materials(
        &self,
        order: &[(Name, ItemId)],
        glows: &BTreeMap<ItemId, Emissive>,
        (textures, expressions, [media, materials, assets]): Index<'_>,
    ) -> Option<Vec<Material>> {
        let material = |(name, id): &(Name, ItemId)| {
            if let Some(glow) = glows.get(id) {
                let model = MaterialModel::Emissive(glow.clone());
                let (normal, projection) = (None, TextureProjection::Uv);
                return Some(Material {
                    name: name.clone(),
                    model,
                    normal,
                    projection,
                    of_file: None,
                });
            }
            let written = self.sound(*id)?;
            let fields = &written.without_file();
            let reader = Reader { fields, textures, expressions, media, materials };
            let model = MaterialModel::read(&reader)?;
            let normal = material::normal(fields, textures);
            let projection = TextureProjection::of(fields);
            let of_file = match written.file_base(&|asset| assets.get(&asset).copied().unwrap_or(0))
            {
                Some(base) => {
                    let normal_strength = fields.number("normal.strength")?;
                    Some(MaterialOfFile { base, normal_strength })
                }
                None => None,
            };
            Some(Material { name: name.clone(), model, normal, projection, of_file })
        };
        order.iter().map(material).collect()
    }

    fn media(&self, order: &[(Name, ItemId)]) -> Option<Vec<Medium>> {
        order.iter().map(|(name, id)| medium::read(name.clone(), self.sound(*id)?)).collect()
    }

    fn assets(&self, order: &[(Name, ItemId)]) -> Option<Vec<Asset>> {
        order
            .iter()
            .map(|(name, id)| {
                let info = self.assets.get(id)?;
                Some(Asset {
                    name: name.clone(),
                    path: info.path.clone(),
                    path_span: info.path_span,
                    format: info.format.clone(),
                })
            })
            .collect()
    }
}

/// What the lights of a scene are in it, each list sorted by name.
#[derive(Default)]
struct Lights {
    /// With the textures of their profiles.
    near: Vec<(Light, Option<ItemId>)>,
    directional: Vec<Directional>,
    panels: Vec<Panel>,
    /// What things that are lights are made of.
    glows: BTreeMap<ItemId, Emissive>,
}

/// A light whose profile knows its texture.
fn profiled((light, profile): (Light, Option<ItemId>), texture: &dyn Fn(ItemId) -> usize) -> Light {
    let known = light.profile.zip(profile);
    Light { profile: known.map(|(of, id)| Profile { texture: texture(id), ..of }), ..light }
}

/// Adds a flat light as an instance and a material of its name, after those that are declared.
fn add_panel(scene: &mut Scene, panel: Panel) {
    let span = panel.name.span;
    scene.instances.push(Instance {
        name: panel.name.clone(),
        object: None,
        shape: panel.shape,
        shape_span: span,
        material: Some(scene.materials.len()),
        material_span: None,
        edits: Vec::new(),
        world_from_object: panel.pose.matrix,
        velocity: panel.pose.velocity,
        motion: None,
        group: panel.group,
        links: panel.links,
    });
    let mut material = panel.material;
    if panel.round {
        let disk = intern(&mut scene.expressions, TextureExpression::disk());
        (material.alpha, material.alpha_clip) = (Scalar::Expression(disk), Some(0.5));
    }
    let model = MaterialModel::Emissive(material);
    let (normal, projection) = (None, TextureProjection::Uv);
    scene.materials.push(Material { name: panel.name, model, normal, projection, of_file: None });
}

fn textures(ev: &Evaluator<'_>, order: &[(Name, ItemId)]) -> Option<Vec<Texture>> {
    order
        .iter()
        .map(|(name, id)| {
            let info = ev.textures.get(id)?;
            Some(Texture {
                name: name.clone(),
                path: info.path.clone(),
                path_span: info.path_span,
                space: info.space,
                wrap: info.wrap,
                placement: info.placement,
                of_mesh: None,
            })
        })
        .collect()
}

fn instances(
    placed: Vec<Placed>,
    material_at: &BTreeMap<ItemId, usize>,
    asset_at: &BTreeMap<ItemId, usize>,
) -> Option<Vec<Instance>> {
    placed
        .into_iter()
        .map(|placed| {
            let mut edits = Vec::new();
            let shape = match &*placed.shape {
                ShapeValue::Plain(shape) => shape.clone(),
                ShapeValue::Mesh(id, part, changes) => {
                    edits = changes
                        .iter()
                        .map(|edit| renamed(edit, material_at))
                        .collect::<Option<_>>()?;
                    let parts = part.clone().map_or(Parts::All, Parts::Named);
                    Shape::Mesh { asset: *asset_at.get(id)?, parts }
                }
                ShapeValue::Object(..) | ShapeValue::Objects(_) => return None,
            };
            let material = match placed.material {
                Some((id, _)) => Some(*material_at.get(&id)?),
                None => None,
            };
            Some(Instance {
                name: Name { text: placed.name, span: placed.name_span },
                object: placed.object.map(|(text, span)| Name { text, span }),
                shape,
                shape_span: placed.shape_span,
                material,
                material_span: placed.material.map(|(_, span)| span),
                edits,
                world_from_object: placed.pose.matrix,
                velocity: placed.pose.velocity,
                motion: match placed.pose.way {
                    Way::Keys(motion) => Some((*motion).clone()),
                    Way::Still | Way::Not(_) => None,
                },
                group: placed.group.map(|(name, _)| name.as_ref().to_owned()),
                links: placed.links,
            })
        })
        .collect()
}

/// A change with the index of its material.
fn renamed(
    edit: &MeshEdit<ItemId>,
    material_at: &BTreeMap<ItemId, usize>,
) -> Option<MeshEdit<usize>> {
    let material = match &edit.material {
        Some(id) => Some(*material_at.get(id)?),
        None => None,
    };
    let MeshEdit { of, pattern_span, material_span, .. } = *edit;
    Some(MeshEdit { of, pattern: edit.pattern.clone(), pattern_span, material, material_span })
}

/// The index of an expression, which is added if it is new.
fn intern(known: &mut Vec<TextureExpression<usize>>, of: TextureExpression<usize>) -> usize {
    known.iter().position(|known| *known == of).unwrap_or_else(|| {
        known.push(of);
        known.len() - 1
    })
}

/// Items by the names they have in the scene.
fn sorted(ev: &Evaluator<'_>, ids: &BTreeSet<ItemId>) -> Vec<(Name, ItemId)> {
    let mut named: Vec<(Name, ItemId)> = ids.iter().map(|id| (name(ev, *id), *id)).collect();
    named.sort_by(|a, b| a.0.text.cmp(&b.0.text));
    named
}

fn index(order: &[(Name, ItemId)]) -> BTreeMap<ItemId, usize> {
    order.iter().enumerate().map(|(i, (_, id))| (*id, i)).collect()
}

/// Reports an atmosphere with nothing in it: a picture of the sky alone has no distances.
fn nothing_in_the_air(ev: &mut Evaluator<'_>, scene: &Scene) {
    if scene.render.atmosphere.is_some() && scene.instances.is_empty() && scene.lights.is_empty() {
        let error = Diagnostic::error(Code("E0533"), "an atmosphere needs an instance or a light")
            .at(scene.render.name.span, "this scene has no instance")
            .with_help("add an instance, or leave `atmosphere` out");
        ev.fault(error);
    }
}

/// Reports a scene in which nothing gives off light. A mesh that brings its own materials may.
fn no_light(ev: &mut Evaluator<'_>, scene: &Scene) {
    let lit = scene.lights.iter().any(|light| light.radiance.iter().any(|c| *c > 0.0))
        || scene.directional.iter().any(|light| light.radiance.iter().any(|c| *c > 0.0))
        || scene.sky.as_ref().is_some_and(|sky| !sky::is_black(sky))
        || scene.instances.iter().any(|instance| {
            let emits = |material: usize| material::emits(&scene.materials[material]);
            instance.material.is_none_or(emits)
                || instance.edits.iter().filter_map(|edit| edit.material).any(emits)
        });
    if !lit {
        let text = "no light in this scene: the picture would be black";
        let error = Diagnostic::error(Code("E0710"), text)
            .at(scene.render.name.span, "this render")
            .with_help("declare a `light`, a `sky`, or an instance with an `emissive` material");
        ev.fault(error);
    }
}
