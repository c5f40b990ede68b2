//! The whole way from text to a checked [`Scene`]: names, values, fields, and how they go together.
//!
//! Every phase goes on past faults; a scene is returned only if there was none. Files are seen only
//! through the [`Loader`].

use std::collections::BTreeMap;

use crate::diagnostic::{self, Diagnostic};
use crate::eval::Evaluator;
use crate::resolve::{self, ItemId, Program};
use crate::scene::Scene;
use crate::schema::Kind;
use crate::source::{Loader, SourceSet};
use crate::syntax::ItemKind;
use crate::{medium, sky};

pub(crate) mod brightness;
// In what checks kinds, a kind that a match forgets is an error, not what the last arm says.
#[warn(clippy::wildcard_enum_match_arm)]
pub(crate) mod camera;
pub(crate) mod collect;
mod dark;
mod define;
pub(crate) mod exclusive;
mod field;
pub(crate) mod fields;
pub(crate) mod file;
mod film;
mod followers;
pub(crate) mod given;
mod group;
mod index;
mod instance;
mod keys;
#[warn(clippy::wildcard_enum_match_arm)]
pub(crate) mod light;
mod link_sets;
mod linked;
mod lint;
#[warn(clippy::wildcard_enum_match_arm)]
mod material;
mod mix;
mod motion;
mod named;
mod object;
mod pattern;
#[warn(clippy::wildcard_enum_match_arm)]
mod render;
#[warn(clippy::wildcard_enum_match_arm)]
mod scene;
#[warn(clippy::wildcard_enum_match_arm)]
pub(crate) mod texture;
mod transform;
mod tuples;
mod unused;

pub use define::Options;
pub(crate) use fields::Fields;
use file::AssetInfo;
use index::refuse_index;

/// Everything known about a scene.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Every text that was read, for drawing the diagnostics.
    pub sources: SourceSet,
    /// The scene, if nothing is wrong with it.
    pub scene: Option<Scene>,
    /// Errors and warnings, sorted by place.
    pub diagnostics: Vec<Diagnostic>,
    /// The parameters of the root file, in the order of the text.
    pub params: Vec<ParamInfo>,
    /// Names of the files that were read, the root first, in the order of reading.
    pub files: Vec<String>,
}

/// A parameter of the root file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParamInfo {
    /// Its name.
    pub name: String,
    /// The word after the colon.
    pub ty: String,
    /// Its value as text, in a readable unit; empty where it could not be computed.
    pub value: String,
    /// The value comes from outside.
    pub overridden: bool,
    /// Lines of its `///` comment.
    pub docs: Vec<String>,
}

/// Checks a scene: reads the root text and everything it imports, and reports all that is wrong.
pub fn analyze(
    root_name: &str,
    root_text: &str,
    loader: &mut dyn Loader,
    options: &Options,
) -> Analysis {
    let mut sources = SourceSet::new();
    let (program, mut diagnostics) = resolve::load(&mut sources, root_name, root_text, loader);
    let files: Vec<String> = sources.ids().map(|id| sources.name(id).to_owned()).collect();
    let n_files = files.len();
    let defines = define::read(&mut sources, options, &mut diagnostics);
    let (models, faults) = resolve::like::models(&program);
    diagnostics.extend(faults);
    let mut ev = Evaluator::new(&sources, &program, &models, diagnostics);
    ev.defines = defines;
    ev.evaluate_bindings();
    let scene = Checker::new().run(&mut ev);
    let params = params(&ev);
    let mut diagnostics = ev.into_diagnostics();
    for diagnostic in &mut diagnostics {
        define::keep_editable(&sources, diagnostic, n_files);
    }
    diagnostic::sort(&mut diagnostics);
    diagnostics.dedup_by(|a, b| a.code == b.code && a.message == b.message && a.span() == b.span());
    let scene = scene.filter(|_| !diagnostics.iter().any(Diagnostic::is_error));
    Analysis { sources, scene, diagnostics, params, files }
}

fn params(ev: &Evaluator<'_>) -> Vec<ParamInfo> {
    let mut params = Vec::new();
    for id in ev.program.ids().filter(|id| id.module == 0) {
        let item = ev.program.item(id);
        let ItemKind::Param(param) = &item.kind else { continue };
        let value = ev.known_binding(id).filter(|value| value.is_sound());
        params.push(ParamInfo {
            name: param.name.text.clone(),
            ty: param.ty.text.clone(),
            value: value.map(crate::eval::value::Value::shown).unwrap_or_default(),
            overridden: ev.defines.contains_key(&param.name.text),
            docs: item.docs.clone(),
        });
    }
    params
}

/// Declarations that have been checked.
#[derive(Default)]
struct Checker {
    assets: BTreeMap<ItemId, AssetInfo>,
    /// Media, materials, lights, skies, cameras, films and renders.
    fields: BTreeMap<ItemId, Fields>,
    world: instance::World,
}

impl Checker {
    fn new() -> Self {
        Self::default()
    }

    fn run(mut self, ev: &mut Evaluator<'_>) -> Option<Scene> {
        self.check_files(ev);
        for kind in [
            Kind::Medium,
            Kind::Material,
            Kind::Light,
            Kind::Sky,
            Kind::Camera,
            Kind::Film,
            Kind::Render,
        ] {
            for id in ids_of(ev.program, kind) {
                self.check_decl(ev, kind, id);
            }
        }
        mix::check(ev, &self.fields);
        let objects = ids_of(ev.program, Kind::Object);
        self.world.objects.check(ev, &objects);
        for id in ids_of(ev.program, Kind::Instance) {
            self.world.instance(ev, id, is_in_world(ev.program, id));
        }
        for (id, fields) in self.fields.iter().filter(|(_, fields)| light::is_thing(fields)) {
            self.world.light(ev, *id, fields, is_in_world(ev.program, *id));
        }
        check_asserts(ev);
        let scene = self.build(ev);
        followers::leave_out(ev);
        if !ev.has_errors() {
            unused::check(ev);
        }
        scene
    }

    fn check_files(&mut self, ev: &mut Evaluator<'_>) {
        let program = ev.program;
        for id in program.ids() {
            match &program.item(id).kind {
                ItemKind::Asset(binding) => {
                    if let Some(info) = texture::asset(ev, id, binding) {
                        self.assets.insert(id, info);
                    }
                }
                ItemKind::Texture(binding) => {
                    if let Some(info) = texture::texture(ev, id, binding) {
                        ev.textures.insert(id, info);
                    }
                }
                _ => {}
            }
        }
    }

    fn check_decl(&mut self, ev: &mut Evaluator<'_>, kind: Kind, id: ItemId) {
        if refuse_index(ev, kind, id) {
            return;
        }
        let Some(fields) = ev.fields_of(id) else { return };
        match kind {
            Kind::Material => material::check(ev, &fields),
            Kind::Medium => medium::check(ev, ev.program.name_span(id), &fields),
            Kind::Light => light::check_light(ev, id, &fields),
            Kind::Sky => sky::check(ev, &fields),
            Kind::Camera => camera::check(ev, &fields),
            Kind::Film => film::check(ev, &fields),
            _ => {}
        }
        self.fields.insert(id, fields);
    }
}

/// Reports assertions that do not hold.
fn check_asserts(ev: &mut Evaluator<'_>) {
    let program = ev.program;
    for id in program.ids() {
        let ItemKind::Assert(assert) = &program.item(id).kind else { continue };
        let scope = crate::eval::Scope { module: id.module, local: None };
        if ev.condition(&assert.condition, scope) == Some(false) {
            let error = Diagnostic::error(diagnostic::Code("E0403"), &assert.message.text)
                .at(assert.condition.span, "this does not hold");
            let error = ev.explain_values(error, &assert.condition, scope);
            ev.fault(error);
        }
    }
}

/// Declarations of one kind, in order.
fn ids_of(program: &Program, kind: Kind) -> Vec<ItemId> {
    program.ids().filter(|id| resolve::item_kind(program.item(*id)) == Some(kind)).collect()
}

/// Instances and lights of the root, and public ones of imported files.
fn is_in_world(program: &Program, id: ItemId) -> bool {
    id.module == 0 || program.item(id).public
}
