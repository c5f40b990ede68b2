//! The one `render` declaration, and the camera, film and sky it takes.

use super::fields::Fields;
use super::{Checker, camera, film, ids_of, medium, sky};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::Evaluator;
use crate::resolve::{ItemId, quoted_list};
use crate::scene::{Camera, Film, Layer, Name, Render, Sampler, Sky};
use crate::schema::Kind;
use crate::source::Span;
use crate::syntax::{File, ItemKind};

/// What `render` decides.
pub(super) struct View {
    pub(super) camera: Camera,
    pub(super) film: Film,
    pub(super) sky: Option<Sky>,
    pub(super) render: Render,
    /// The medium that fills the space between things.
    pub(super) atmosphere: Option<ItemId>,
    /// The mesh file of the camera.
    pub(super) camera_file: Option<ItemId>,
}

impl Checker {
    /// Finds the render of the root file and what it uses.
    pub(super) fn view(&self, ev: &mut Evaluator<'_>) -> Option<View> {
        let id = one_render(ev)?;
        let fields = self.fields.get(&id)?;
        let name_span = ev.program.name_span(id);
        let camera = choose(ev, id, fields, Kind::Camera);
        let film = choose(ev, id, fields, Kind::Film);
        let sky = choose(ev, id, fields, Kind::Sky);
        if !fields.ok {
            return None;
        }
        let film = match film {
            Choice::Item(id) => film::film(name(ev, id), self.sound(id)?)?,
            Choice::Nothing => film::default_film(name_span),
            Choice::Fault => return None,
        };
        let Choice::Item(camera) = camera else { return None };
        let fields_of_camera = self.sound(camera)?;
        let framed = framed(ev, fields_of_camera);
        let camera = camera::camera(name(ev, camera), framed, fields_of_camera, &film)?;
        let camera_file = fields_of_camera.of_file.as_ref().map(|base| base.asset);
        if camera_file.is_none() {
            camera::check_built(ev, &camera);
        }
        let sky = match sky {
            Choice::Item(sky) => Some(sky::read(name(ev, sky), self.sound(sky)?)?),
            Choice::Nothing => None,
            Choice::Fault => return None,
        };
        let atmosphere = fields.item("atmosphere");
        let render = Render {
            name: name(ev, id),
            // Its index is known when all media in use are.
            atmosphere: None,
            samples: fields.integer("samples")?,
            max_depth: match fields.word("depth") {
                Some(_) => None,
                None => Some(fields.integer("depth")?),
            },
            roulette_depth: fields.integer("roulette")?,
            seed: fields.integer("seed")?,
            sampler: Sampler::of(fields.word("sampler")?)?,
            layers: fields.words("layers").into_iter().filter_map(Layer::of).collect(),
            output: fields.text("output"),
        };
        if let Some(fields) = atmosphere
            .and_then(|id| self.sound(id))
            .filter(|_| camera.fit.is_none() && camera_file.is_none())
        {
            medium::warn_of_blindness(ev, fields, &camera, &render);
        }
        warn_of_samples(ev, fields, &render);
        Some(View { camera, film, sky, render, atmosphere, camera_file })
    }

    /// Fields without a fault.
    pub(super) fn sound(&self, id: ItemId) -> Option<&Fields> {
        self.fields.get(&id).filter(|fields| fields.ok)
    }
}

/// The instance that a camera frames, and where it says so.
fn framed(ev: &Evaluator<'_>, camera: &Fields) -> Option<Name> {
    let (id, span) = (camera.item("fit")?, camera.value_span("fit")?);
    Some(Name { text: ev.program.full_name(id), span })
}

/// Sobol's points are evenly spread in aligned sets whose sizes are powers of two; sets of this size are rendered
/// together.
const SET: u32 = 16;

/// Warns where the last of those sets is not complete.
fn warn_of_samples(ev: &mut Evaluator<'_>, fields: &Fields, render: &Render) {
    let samples = render.samples;
    let even = samples.is_multiple_of(SET) || samples.is_power_of_two();
    let Some(span) = fields.value_span("samples").filter(|_| !even) else { return };
    if render.sampler != Sampler::Sobol {
        return;
    }
    let better =
        if samples < SET { samples.next_power_of_two() } else { samples.next_multiple_of(SET) };
    let text = format!("{samples} samples break up the last set of `sobol` points");
    let warning = Diagnostic::warning(Code("W0715"), "uneven_samples", text)
        .at(span, format!("neither a power of two nor a multiple of {SET}"))
        .with_note("points are evenly spread within complete sets; a part of one gains little")
        .with_help(format!("write `samples = {better}`"));
    ev.tell(warning);
}

/// Which declaration `render` takes.
#[derive(Clone, Copy)]
enum Choice {
    Item(ItemId),
    /// None is wanted, or there is none.
    Nothing,
    /// Already reported.
    Fault,
}

/// The declaration that `render` names, or the only one of the root file.
fn choose(ev: &mut Evaluator<'_>, render: ItemId, fields: &Fields, kind: Kind) -> Choice {
    let word = kind.name();
    if let Some(id) = fields.item(word) {
        return Choice::Item(id);
    }
    if fields.is_none(word) && kind == Kind::Sky {
        return Choice::Nothing;
    }
    if fields.span(word).is_some() && !fields.ok {
        return Choice::Fault;
    }
    let here: Vec<ItemId> =
        ids_of(ev.program, kind).into_iter().filter(|id| id.module == 0).collect();
    match here.as_slice() {
        [only] => {
            ev.used.insert(*only);
            Choice::Item(*only)
        }
        [] if kind != Kind::Camera => Choice::Nothing,
        [] => {
            if !has_errors(&ev.program.modules[0].tree) {
                let text = "there is no camera to render from";
                let error = Diagnostic::error(Code("E0712"), text)
                    .at(ev.program.name_span(render), "this render needs one")
                    .with_help(
                        "declare `camera hero: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }`",
                    );
                ev.fault(error);
            }
            Choice::Fault
        }
        several => {
            let names: Vec<String> =
                several.iter().map(|id| ev.program.name(*id).to_owned()).collect();
            let text = format!("which {word}? there are {}", quoted_list(&names));
            let mut error = Diagnostic::error(Code("E0712"), text)
                .at(ev.program.name_span(render), format!("this render names no {word}"));
            for id in several.iter().take(4) {
                error = error.because(ev.program.name_span(*id), "one of them");
            }
            ev.fault(error.with_help(format!("write `{word} = {}`", names[0])));
            Choice::Fault
        }
    }
}

/// The name of an item in the scene.
pub(super) fn name(ev: &Evaluator<'_>, id: ItemId) -> Name {
    Name { text: ev.program.full_name(id), span: ev.program.name_span(id) }
}

fn has_errors(tree: &File) -> bool {
    tree.has_errors || tree.items.iter().any(|item| matches!(item.kind, ItemKind::Poisoned(_)))
}

/// Most declarations that are marked in one message.
const MOST_NAMED: usize = 8;

/// The render of the root file; reports that there is none, or more than one.
fn one_render(ev: &mut Evaluator<'_>) -> Option<ItemId> {
    let here: Vec<ItemId> =
        ids_of(ev.program, Kind::Render).into_iter().filter(|id| id.module == 0).collect();
    match here.as_slice() {
        [only] => return Some(*only),
        [] => {
            let root = ev.program.modules.first()?;
            if has_errors(&root.tree) {
                return None;
            }
            let error = no_render(ev, root.file);
            ev.fault(error);
        }
        [first, rest @ ..] => {
            let mut error =
                Diagnostic::error(Code("E0711"), "a scene has one `render`, this has more");
            for id in rest.iter().take(MOST_NAMED) {
                error = error.at(ev.program.name_span(*id), "one too many");
            }
            if rest.len() > MOST_NAMED {
                error = error.with_note(format!("there are {} in all", here.len()));
            }
            error = error.because(ev.program.name_span(*first), "the first one");
            ev.fault(error);
        }
    }
    None
}

fn no_render(ev: &Evaluator<'_>, file: crate::source::FileId) -> Diagnostic {
    let text = ev.sources.text(file);
    let end = u32::try_from(text.len()).unwrap_or(u32::MAX);
    let last = u32::try_from(text.trim_end().len()).unwrap_or(u32::MAX);
    let at = Span { file, start: last, end: last };
    let error = Diagnostic::error(Code("E0711"), "the scene has no `render`")
        .at(at, "nothing says what to draw");
    let cameras: Vec<ItemId> =
        ids_of(ev.program, Kind::Camera).into_iter().filter(|id| id.module == 0).collect();
    match cameras.as_slice() {
        [only] => {
            // Before the last line break, so that what is proposed is seen to be a line of its own.
            let line = if text.ends_with("\r\n") { "\r\n" } else { "\n" };
            let end =
                end - u32::try_from(if text.ends_with('\n') { line.len() } else { 0 }).unwrap_or(0);
            let camera = ev.program.name(*only);
            let names = &ev.program.modules[0].names;
            let name = ["main", "picture", "final", "view"].into_iter();
            let name = name.clone().find(|name| !names.contains_key(*name)).unwrap_or("main");
            let text = format!("{line}render {name}: path {{ camera = {camera} }}");
            let end = Span { file, start: end, end };
            error.with_fix(Fix::sure("render what this camera sees", end, text))
        }
        _ => error.with_help("declare `render main: path { camera = name }`"),
    }
}
