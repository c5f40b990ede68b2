//! A mesh file whose materials are replaced by name is the scene in which each part is an instance of its own.

#[path = "edited/of_file.rs"]
mod of_file;

use std::path::Path;

use compiler::pipeline::Compiled;
use tests::scene::compile_in;

/// Four triangles: two of red paint, one of which is a wheel, one of blue paint, one of glass.
const CAR: &str = "mtllib car.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n\
    o body\nusemtl Paint.red\nf 1 2 3\nusemtl Paint.blue\nf 1 2 4\n\
    o wheel.001\nusemtl Paint.red\nf 1 3 4\no window\nusemtl glass\nf 2 3 4\n";
const MTL: &str =
    "newmtl Paint.red\nKd 1 0 0\nnewmtl Paint.blue\nKd 0 0 1\nnewmtl glass\nKd 0 1 0\n";

const REST: &str = "asset car = obj(\"car.obj\", unit: m)
asset red = obj(\"car.obj\", unit: m)
material mine: metal { color = linear(0.9, 0.8, 0.1) }
material other: diffuse { color = linear(0.3) }
sky s: constant { }
camera c: perspective { from = (2, 2, 3)m, to = (0, 0, 0)m }
render r: path { camera = c, sky = s }
";

fn compile(folder: &Path, things: &str) -> Compiled {
    compile_in(folder, &format!("rts 1\n{REST}{things}\n"))
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("car.obj"), CAR).expect("writable");
    std::fs::write(folder.path().join("car.mtl"), MTL).expect("writable");
    folder
}

/// How many triangles are made of each material, by name.
fn made_of(compiled: &Compiled) -> Vec<(&str, usize)> {
    let lowered = &compiled.lowered;
    let names = lowered.material_names.iter().enumerate();
    let mut found: Vec<(&str, usize)> = names
        .map(|(index, (name, _))| {
            let shades = lowered.shades.iter();
            (name.as_str(), shades.filter(|shade| shade.material as usize == index).count())
        })
        .collect();
    found.sort_unstable();
    found
}

#[test]
fn patterns_choose_materials_and_parts_and_the_last_decides() {
    let folder = folder();
    let cases: [(&str, &[(&str, usize)]); 8] = [
        ("car", &[("car/Paint.blue", 1), ("car/Paint.red", 2), ("car/glass", 1)]),
        ("car { }", &[("car/Paint.blue", 1), ("car/Paint.red", 2), ("car/glass", 1)]),
        ("car { material \"Paint*\" = mine }", &[("car/glass", 1), ("mine", 3)]),
        (
            "car { material \"paint.RED\" = mine }",
            &[("car/Paint.blue", 1), ("car/glass", 1), ("mine", 2)],
        ),
        (
            "car { part \"wheel.*\" = none }",
            &[("car/Paint.blue", 1), ("car/Paint.red", 1), ("car/glass", 1)],
        ),
        (
            "car { material \"glass\" = none, part \"body\" = other }",
            &[("car/Paint.red", 1), ("other", 2)],
        ),
        (
            "car {\n  part \"*\" = none\n  material \"Paint.????\" = mine // blue\n  part \"wheel*\" = other\n}",
            &[("mine", 1), ("other", 1)],
        ),
        ("car.wheel_001 { material \"*\" = mine }", &[("mine", 1)]),
    ];
    for (shape, expected) in cases {
        let compiled = compile(folder.path(), &format!("instance a {{ shape = {shape} }}"));
        assert_eq!(made_of(&compiled), expected, "{shape}");
    }
    // A material of the instance is for what no line names; objects may be edited, too.
    let object = "object taxi { shape = car { part \"window\" = other } }\ninstance a: taxi { material = mine }";
    assert_eq!(made_of(&compile(folder.path(), object)), [("mine", 3), ("other", 1)]);
}

#[test]
fn the_records_are_those_of_parts_with_materials_of_their_own() {
    let folder = folder();
    let edited = compile(
        folder.path(),
        "instance a { shape = car { part \"body\" = mine, part \"wheel*\" = other, part \"window\" = none } }",
    );
    let by_hand = compile(
        folder.path(),
        "instance a { shape = car.body, material = mine }\ninstance b { shape = car.wheel_001, material = other }",
    );
    let (edited, by_hand) = (edited.lowered, by_hand.lowered);
    assert_eq!(edited.triangles, by_hand.triangles);
    assert_eq!(edited.shades, by_hand.shades);
    assert_eq!(edited.materials, by_hand.materials);
}
