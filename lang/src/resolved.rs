//! A scene as text in which nothing is left to be worked out: `rtc show --resolved`.
//!
//! The text reads like `.rts`, with every default written out, every `like` and index expanded and
//! every value in a unit that shows it exactly. It is for people and for comparing; the names of
//! expanded instances and their axes are not part of the language.

mod written;

pub(crate) use written::{Declared, length, number, vector};

use std::fmt::{self, Write as _};

use crate::check::brightness::profile_scale;
use crate::material::Shown;
use crate::scene::{
    AssetFormat, Axis, Camera, CameraKey, CameraOfFile, Directional, FileBase, FileFrame,
    GltfChoice, Instance, Light, LightLinks, MaterialOfFile, Motion, MotionKey, Opening,
    Projection, Scene, Shape, Wrap,
};
use crate::schema::{Kind, color_text};
use crate::shape::MeshEdit;
use crate::units::{self, Dim};

/// What fields may refer to; `materials`: names of them, for fields of materials.
fn shown<'a>(scene: &'a Scene, materials: &'a [&'a str]) -> Shown<'a> {
    Shown::new(&scene.textures, &scene.expressions, (&scene.media, materials))
}

/// Every declaration of the scene, sorted by kind and name.
#[must_use]
pub fn resolved(scene: &Scene) -> String {
    let mut out = String::from("rts 1\n");
    write_all(&mut out, scene).expect("a string takes all text");
    out
}

/// What of a glTF file is chosen, as arguments.
fn chosen(choice: &GltfChoice) -> String {
    let GltfChoice { time, animation, variant } = choice;
    let time = time.map(|time| format!(", time: {}", units::show(time, Dim::TIME)));
    let named = |field: &str, name: &Option<String>| {
        name.as_ref().map(|name| format!(", {field}: \"{name}\""))
    };
    [time, named("animation", animation), named("variant", variant)].into_iter().flatten().collect()
}

fn write_all(out: &mut String, scene: &Scene) -> fmt::Result {
    for asset in &scene.assets {
        let (name, path) = (&asset.name.text, &asset.path);
        let framed = |FileFrame { metres_per_unit, up }: FileFrame| {
            format!(", unit: {}, up: {}", length(metres_per_unit), axis(up))
        };
        let (format, more) = match &asset.format {
            AssetFormat::Obj(frame) => ("obj", framed(*frame)),
            AssetFormat::Ply(frame) => ("ply", framed(*frame)),
            AssetFormat::Stl(frame) => ("stl", framed(*frame)),
            AssetFormat::Gltf(choice) => ("gltf", chosen(choice)),
        };
        writeln!(out, "asset {name} = {format}(\"{path}\"{more})")?;
    }
    for texture in &scene.textures {
        let (name, path, space) = (&texture.name.text, &texture.path, texture.space.word());
        let [u, v] = texture.wrap.map(Wrap::word);
        writeln!(
            out,
            "texture {name} = image(\"{path}\", space: {space}, wrap_u: {u}, wrap_v: {v}{})",
            texture.placement.fields()
        )?;
    }
    let names: Vec<&str> = scene.materials.iter().map(|m| m.name.text.as_str()).collect();
    for material in &scene.materials {
        let mut shown = shown(scene, &names);
        let kind = material.model.show(&mut shown);
        let mut fields = shown.lines;
        if let Some(map) = &material.normal {
            fields.push(("normal", format!("{}.rgb", texture_name(scene, map.texture))));
            fields.push(("normal.strength", number(map.strength)));
        }
        fields.extend(material.projection.shown());
        let name = &material.name.text;
        let head = match &material.of_file {
            Some(MaterialOfFile { base, normal_strength }) => {
                if material.normal.is_none() {
                    fields.push(("normal.strength", number(*normal_strength)));
                    fields.push(("normal", "none".to_owned()));
                }
                fields.retain(|(field, _)| base.says(field).is_some());
                format!("material {name} like {}", in_file(scene, base, Kind::Material))
            }
            None => format!("material {name}: {kind}"),
        };
        block(out, &head, &fields)?;
    }
    for instance in &scene.instances {
        let fields = instance_fields(scene, instance);
        block(out, &format!("instance {}", instance.name.text), &fields)?;
    }
    for light in &scene.lights {
        let (kind, fields) = light_fields(scene, light);
        block(out, &format!("light {}: {kind}", light.name.text), &fields)?;
    }
    for light in &scene.directional {
        let fields = directional_fields(light);
        block(out, &format!("light {}: directional", light.name.text), &fields)?;
    }
    for medium in &scene.media {
        let (kind, fields) = medium.shown();
        block(out, &format!("medium {}: {kind}", medium.name.text), &fields)?;
    }
    if let Some(sky) = &scene.sky {
        let (kind, fields) = sky.shown();
        block(out, &format!("sky {}: {kind}", sky.name.text), &fields)?;
    }
    write_view(out, scene)
}

/// The type of a light and its fields.
fn light_fields(scene: &Scene, light: &Light) -> (&'static str, Vec<(&'static str, String)>) {
    let mut fields = vec![("radius", length(light.radius)), ("color", color_text(light.radiance))];
    let kind = if let Some(beam) = &light.beam {
        let (outer, inner) = (libm::acos(beam.outer), libm::acos(beam.inner));
        // Of a lamp of radiance 1.
        let intensity = std::f64::consts::PI * light.radius * light.radius;
        fields.insert(0, ("at", vector(light.center, "m")));
        fields.push(("intensity", format!("{}W/sr", number(intensity))));
        fields.push(("direction", vector(beam.direction, "")));
        fields.push(("cone", units::show(outer, Dim::ANGLE)));
        fields.push(("edge", units::show(outer - inner, Dim::ANGLE)));
        "spot"
    } else if let Some(profile) = &light.profile {
        fields.insert(0, ("at", vector(light.center, "m")));
        fields.push(("profile", texture_name(scene, profile.texture).to_owned()));
        fields.push(("profile.scale", number(profile_scale(light.radiance, light.radius))));
        fields.push(("direction", vector(profile.direction, "")));
        "point"
    } else {
        fields.insert(0, ("center", vector(light.center, "m")));
        fields.push(("strength", "1".to_owned()));
        "sphere"
    };
    if let Some(tint) = &light.tint {
        fields.push(("tint.color", color_text(tint.color)));
        fields.push(("tint.angle", units::show(tint.angle, Dim::ANGLE)));
        fields.push(("tint.direction", vector(tint.direction, "")));
    }
    if light.velocity.iter().any(|c| c.abs() > 0.0) {
        fields.push(("velocity", vector(light.velocity, "m/s")));
    }
    if !light.visible {
        fields.push(("visible", "off".to_owned()));
    }
    fields.extend(group(light.group.as_ref()));
    fields.extend(links(light.links.as_ref()));
    (kind, fields)
}

fn directional_fields(light: &Directional) -> Vec<(&'static str, String)> {
    let mut fields = vec![
        ("direction", vector(light.direction, "")),
        ("angular_diameter", units::show(2.0 * light.half_angle, Dim::ANGLE)),
        ("color", color_text(light.radiance)),
        ("strength", "1".to_owned()),
    ];
    if !light.visible {
        fields.push(("visible", "off".to_owned()));
    }
    fields.extend(group(light.group.as_ref()));
    fields.extend(links(light.links.as_ref()));
    fields
}

/// A declaration with its fields, one on each line.
fn block(out: &mut String, head: &str, fields: &[(&str, String)]) -> fmt::Result {
    writeln!(out, "{head} {{")?;
    for (name, value) in fields {
        writeln!(out, "  {name} = {value}")?;
    }
    writeln!(out, "}}")
}

/// A light group, where there is one.
fn group(name: Option<&String>) -> Option<(&'static str, String)> {
    name.map(|name| ("group", format!("\"{name}\"")))
}

/// What a light lights, where that is not everything.
fn links(links: Option<&LightLinks>) -> Option<(&'static str, String)> {
    let links = links?;
    let field = match links {
        LightLinks::Only(_) => "only",
        LightLinks::Except(_) => "except",
    };
    let names: Vec<&str> = links.names().iter().map(|name| name.text.as_str()).collect();
    Some((field, format!("[{}]", names.join(", "))))
}

fn instance_fields(scene: &Scene, instance: &Instance) -> Vec<(&'static str, String)> {
    let shape = match (&instance.shape, instance.shape.shown()) {
        (Shape::Mesh { asset, parts }, _) => {
            let asset = scene.assets.get(*asset).map_or("", |asset| asset.name.text.as_str());
            let shape = match parts.name() {
                Some(part) => format!("{asset}.part(\"{part}\")"),
                None => asset.to_owned(),
            };
            shape + &edits(scene, instance)
        }
        (_, shown) => shown.unwrap_or_default(),
    };
    let material = instance.material.and_then(|material| scene.materials.get(material));
    let material = material.map_or("none", |material| material.name.text.as_str());
    let mut fields = vec![("shape", shape), ("material", material.to_owned())];
    let m = &instance.world_from_object;
    let column = |i: usize| [m[0][i], m[1][i], m[2][i]];
    let keyed = |place: fn(&MotionKey) -> [f64; 3], unit: &'static str| {
        let motion = instance.motion.as_ref();
        motion.map(|motion| keys(motion.keys.iter().map(|key| (key.time, place(key))), unit))
    };
    let at = keyed(|key| key.at, "m").unwrap_or_else(|| vector(column(3), "m"));
    fields.push(("at", at));
    if instance.motion.as_ref().is_some_and(Motion::turns) {
        fields.extend(keyed(|key| key.rotate.map(f64::to_degrees), "deg").map(|k| ("rotate", k)));
    }
    let diagonal = (0..3).all(|row| (0..3).all(|i| row == i || m[row][i] == 0.0));
    if diagonal {
        fields.push(("scale", vector([m[0][0], m[1][1], m[2][2]], "")));
    } else {
        fields.push(("x_axis", vector(column(0), "")));
        fields.push(("y_axis", vector(column(1), "")));
        fields.push(("z_axis", vector(column(2), "")));
    }
    if instance.velocity.iter().any(|c| c.abs() > 0.0) {
        fields.push(("velocity", vector(instance.velocity, "m/s")));
    }
    fields.extend(group(instance.group.as_ref()));
    fields.extend(links(instance.links.as_ref()));
    fields
}

/// Keys as they are written.
fn keys(keys: impl Iterator<Item = (f64, [f64; 3])>, unit: &str) -> String {
    let key = |(time, v)| format!("{}: {}", units::show(time, Dim::TIME), vector(v, unit));
    format!("[{}]", keys.map(key).collect::<Vec<_>>().join(", "))
}

/// What is changed of a mesh file, behind its name.
fn edits(scene: &Scene, instance: &Instance) -> String {
    let edit = |edit: &MeshEdit<usize>| {
        let material = edit.material.and_then(|material| scene.materials.get(material));
        let material = material.map_or("none", |material| material.name.text.as_str());
        format!("{} \"{}\" = {material}", edit.of.word(), edit.pattern)
    };
    if instance.edits.is_empty() {
        return String::new();
    }
    format!(" {{ {} }}", instance.edits.iter().map(edit).collect::<Vec<_>>().join(", "))
}

fn write_view(out: &mut String, scene: &Scene) -> fmt::Result {
    let (camera, film, render) = (&scene.camera, &scene.film, &scene.render);
    let name = &camera.name.text;
    let kind = match camera.projection {
        Projection::Perspective(_) => "perspective",
        Projection::Orthographic { .. } => "orthographic",
        Projection::Panoramic { .. } => "panoramic",
    };
    let mut fields = camera_fields(camera);
    let head = match &camera.of_file {
        Some(of_file) => {
            retain_said(of_file, &mut fields);
            format!("camera {name} like {}", in_file(scene, &of_file.base, Kind::Camera))
        }
        None => format!("camera {name}: {kind}"),
    };
    block(out, &head, &fields)?;
    let [width, height] = film.size;
    let fields = [
        ("size", format!("({width}, {height})px")),
        ("filter", film.filter.word().to_owned()),
        ("filter.width", units::show(film.filter_width, Dim::PIXEL)),
        ("exposure", units::show(film.exposure, Dim::EV)),
        ("tone_map", film.tone_map.word().to_owned()),
    ];
    block(out, &format!("film {}", film.name.text), &fields)?;
    let sky = scene.sky.as_ref().map_or("none", |sky| sky.name.text.as_str());
    let mut output = String::from("none");
    if let Some(path) = &render.output {
        output.clear();
        write!(output, "\"{path}\"")?;
    }
    let layers: Vec<&str> = render.layers.iter().map(|layer| layer.word()).collect();
    let layers =
        if layers.is_empty() { "none".to_owned() } else { format!("[{}]", layers.join(", ")) };
    let fields = [
        ("camera", camera.name.text.clone()),
        ("film", film.name.text.clone()),
        ("sky", sky.to_owned()),
        ("atmosphere", shown(scene, &[]).medium(render.atmosphere)),
        ("samples", render.samples.to_string()),
        (
            "depth",
            render.max_depth.map_or_else(|| "unlimited".to_owned(), |depth| depth.to_string()),
        ),
        ("roulette", render.roulette_depth.to_string()),
        ("seed", render.seed.to_string()),
        ("sampler", render.sampler.word().to_owned()),
        ("layers", layers),
        ("output", output),
    ];
    block(out, &format!("render {}: path", render.name.text), &fields)
}

/// What a declaration is like.
fn in_file(scene: &Scene, base: &FileBase, kind: Kind) -> String {
    let asset = scene.assets.get(base.asset).map_or("", |asset| asset.name.text.as_str());
    format!("{asset}.{}(\"{}\")", kind.name(), base.name.text)
}

/// Leaves out what only the file of a camera says, or what follows from that.
fn retain_said(of_file: &CameraOfFile, fields: &mut Vec<(&'static str, String)>) {
    let CameraOfFile { base, lens } = of_file;
    let any = |names: &[&str]| names.iter().any(|name| base.says(name).is_some());
    let sees = any(&["lens", "fov.horizontal", "fov.vertical"]);
    fields.retain(|(field, _)| match *field {
        "from" | "to" | "up" | "focus" => any(&[field]),
        "fov.horizontal" | "fov.vertical" | "aperture" => sees,
        _ => true,
    });
    if !sees {
        fields.push(match lens.opening {
            Opening::Diameter(opening) => ("aperture", length(opening)),
            Opening::FStop(f_stop) => ("f_stop", number(f_stop)),
        });
        fields.push(("sensor.width", length(lens.sensor)));
    }
}

fn camera_fields(camera: &Camera) -> Vec<(&'static str, String)> {
    let [open, close] = camera.shutter;
    let shutter = format!("{}..{}", units::show(open, Dim::TIME), units::show(close, Dim::TIME));
    let fit = camera.fit.as_ref().map(|fit| ("fit", fit.instance.text.clone()));
    let place = |place: fn(&CameraKey) -> [f64; 3], here| match camera.keys.as_slice() {
        [] => vector(here, "m"),
        list => keys(list.iter().map(|key| (key.time, place(key))), "m"),
    };
    let place = [
        ("from", place(|key| key.from, camera.from)),
        ("to", place(|key| key.to, camera.to)),
        ("up", vector(camera.up, "")),
    ];
    let view = match &camera.projection {
        Projection::Perspective(lens) => {
            let mut fields = vec![
                ("fov.horizontal", units::show(lens.fov_horizontal, Dim::ANGLE)),
                ("fov.vertical", units::show(lens.fov_vertical, Dim::ANGLE)),
                ("aperture", length(2.0 * lens.radius)),
                ("focus", length(lens.focus_distance)),
            ];
            if let Some(blades) = lens.blades {
                fields.push(("blades", blades.to_string()));
                fields.push(("rotation", units::show(lens.rotation, Dim::ANGLE)));
            }
            fields
        }
        Projection::Orthographic { size, .. } => {
            let side = |name, side: f64| (name, length(side));
            size.iter().flat_map(|[w, h]| [side("width", *w), side("height", *h)]).collect()
        }
        Projection::Panoramic { fov_horizontal } => {
            vec![("fov.horizontal", units::show(*fov_horizontal, Dim::ANGLE))]
        }
    };
    fit.into_iter().chain(place).chain(view).chain([("shutter", shutter)]).collect()
}

fn texture_name(scene: &Scene, texture: usize) -> &str {
    scene.textures.get(texture).map_or("", |texture| texture.name.text.as_str())
}

fn axis(axis: Axis) -> &'static str {
    match axis {
        Axis::PlusX => "+x",
        Axis::MinusX => "-x",
        Axis::PlusY => "+y",
        Axis::MinusY => "-y",
        Axis::PlusZ => "+z",
        Axis::MinusZ => "-z",
    }
}
