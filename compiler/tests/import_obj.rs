//! OBJ and MTL: what is understood, and that everything wrong names its line.

#![expect(clippy::float_cmp, reason = "these numbers are exact")]
#![expect(clippy::format_push_string, reason = "short texts")]

use compiler::import::{ErrorKind, ImportError, Limits, MeshFile, load_obj, topology};
use lang::scene::{Axis, ColorSpace};
use std::fs;
use tempfile::TempDir;

/// Loads `text` as `mesh.obj` beside the given other files; paths in messages are shortened.
fn load_with(text: &[u8], files: &[(&str, &[u8])]) -> Result<MeshFile, ImportError> {
    load_as(text, files, 1.0, Axis::PlusY)
}

fn load_as(
    text: &[u8],
    files: &[(&str, &[u8])],
    unit: f64,
    up: Axis,
) -> Result<MeshFile, ImportError> {
    let folder = TempDir::new().expect("temporary folder");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("write");
    }
    let path = folder.path().join("mesh.obj");
    fs::write(&path, text).expect("write");
    let prefix = format!("{}/", folder.path().display());
    let mut result = load_obj(&path, unit, up, &Limits::default());
    match &mut result {
        Ok(mesh) => {
            for warning in &mut mesh.report.warnings {
                warning.place = warning.place.replace(&prefix, "");
            }
            let report = &mut mesh.report;
            for finding in
                [&mut report.zero_area, &mut report.zero_normals, &mut report.crooked_polygons]
            {
                finding.first = finding.first.as_ref().map(|place| place.replace(&prefix, ""));
            }
        }
        Err(error) => error.place = error.place.replace(&prefix, ""),
    }
    result
}

fn load(text: &str) -> MeshFile {
    load_with(text.as_bytes(), &[]).expect("a good file")
}

/// The error of `text` must be exactly `expected`.
fn check_error(text: &[u8], expected: &str) {
    let error = load_with(text, &[]).expect_err("a bad file");
    assert_eq!(error.to_string(), expected);
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const BOX: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// Every triangle as its three positions.
fn soup(mesh: &MeshFile) -> Vec<[[f32; 3]; 3]> {
    let parts = mesh.parts.iter();
    parts.flat_map(|part| (0..part.triangles.len()).map(|tri| part.corners(tri))).collect()
}

fn area(mesh: &MeshFile) -> f64 {
    let area = |[a, b, c]: [[f32; 3]; 3]| {
        let (u, v) =
            ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
        let x = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        x.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt() / 2.0
    };
    soup(mesh).into_iter().map(area).sum()
}

#[test]
fn negative_indices_count_from_the_end() {
    let plain = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 4 5 6\n");
    let relative =
        load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
    assert_eq!(soup(&plain), soup(&relative));
}

#[test]
fn box_is_closed_and_keeps_sharp_edges() {
    let mesh = load(BOX);
    let parts: Vec<_> = mesh.parts.iter().collect();
    let found = topology(&parts);
    assert_eq!((mesh.report.n_triangles, mesh.report.n_polygons), (12, 6));
    assert_eq!((found.boundary_edges, found.non_manifold_edges, found.flipped_edges), (0, 0, 0));
    assert!((found.signed_volume - 8.0).abs() < 1e-12, "{}", found.signed_volume);
    for tri in 0..12 {
        let normals = mesh.parts[0].corner_normals(tri).expect("computed");
        assert_eq!(normals[0], normals[1]);
        assert_eq!(normals[0].iter().filter(|x| **x == 0.0).count(), 2, "{normals:?}");
    }
}

#[test]
fn shallow_edges_become_smooth_unless_the_file_says_off() {
    // Two squares that meet at 30 degrees along x = 0.
    let bent = "v -1 0 0\nv -1 1 0\nv 0 0 0\nv 0 1 0\nv 0.866025 0 0.5\nv 0.866025 1 0.5\n\
        SMOOTH\nf 1 3 4 2\nf 3 5 6 4\n";
    let differ = |mesh: &MeshFile| {
        let normals = mesh.parts[0].corner_normals(0).expect("computed");
        normals.iter().any(|n| *n != normals[0])
    };
    assert!(differ(&load(&bent.replace("SMOOTH", ""))));
    assert!(differ(&load(&bent.replace("SMOOTH", "s 3"))));
    assert!(!differ(&load(&bent.replace("SMOOTH", "s off"))));
    assert!(!differ(&load(&bent.replace("SMOOTH\n", "").replace("f 3", "s 2\nf 3"))));
}

#[test]
fn concave_polygons_keep_their_area() {
    // An arrow head, a comb with seven teeth, and a quad with an inner corner at each position.
    let arrow = "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\n";
    for first in 0..4 {
        let order: Vec<String> = (0..4).map(|i| ((first + i) % 4 + 1).to_string()).collect();
        let mesh = load(&format!("{arrow}f {}\n", order.join(" ")));
        assert!((area(&mesh) - 1.0).abs() < 1e-6, "{}", area(&mesh));
        assert_eq!(mesh.report.crooked_polygons.count, 0);
    }
    let mut comb = String::from("v 0 -1 0\nv 14 -1 0\n");
    for tooth in (0..7).rev() {
        comb +=
            &format!("v {0} 0 0\nv {1} 3 0\nv {2} 0 0\n", 2 * tooth + 2, 2 * tooth + 1, 2 * tooth);
    }
    let corners: Vec<String> = (1..=23).map(|i| i.to_string()).collect();
    let mesh = load(&format!("{comb}f {}\n", corners.join(" ")));
    assert!((area(&mesh) - 35.0).abs() < 1e-4, "{}", area(&mesh));
    assert_eq!(mesh.report.crooked_polygons.count, 0);
}

#[test]
fn crossing_polygon_is_counted_with_its_line() {
    let mesh = load(&format!("{SQUARE}\nf 1 3 2 4\n"));
    assert_eq!(mesh.report.crooked_polygons.first.as_deref(), Some("mesh.obj:6"));
}

#[test]
fn groups_objects_and_materials_make_parts() {
    let text = format!(
        "mtllib a.mtl\n{SQUARE}o table\ng top\nusemtl wood\nf 1 2 3\nusemtl steel\nf 1 3 4\n\
         g leg left\nusemtl wood\nf 1 2 4\ng top\nf 2 3 4\n"
    );
    let mtl: &[u8] =
        b"newmtl wood\nKd 0.5 0.25 0.125\nnewmtl steel\nKd 0 0 0\nKs 0.5 0.5 0.6\nNs 98\n";
    let mesh = load_with(text.as_bytes(), &[("a.mtl", mtl)]).expect("good");
    let names: Vec<_> = mesh.parts.iter().map(|p| (p.name.as_str(), p.material)).collect();
    let expected = [("table/top", Some(0)), ("table/top", Some(1)), ("table/leg left", Some(0))];
    assert_eq!(names, expected);
    assert_eq!(mesh.parts[0].triangles.len(), 2);
    assert_eq!(mesh.find_parts("top"), [0, 1]);
    assert_eq!(mesh.find_parts("left"), [2]);
    assert_eq!(mesh.find_parts("table"), [0, 1, 2]);
    assert_eq!(mesh.find_parts("Leg_Left"), [2]);
    assert!(mesh.find_parts("chair").is_empty());
    let [wood, steel] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((wood.color, wood.diffuse_only, wood.metallic), ([0.5, 0.25, 0.125], true, 0.0));
    assert!((steel.color[2] - 0.6).abs() < 1e-6 && steel.metallic == 1.0 && !steel.diffuse_only);
    // alpha = sqrt(2 / 100), roughness its square root.
    assert!((steel.roughness - 0.02_f64.sqrt().sqrt()).abs() < 1e-9);
}

#[test]
fn corners_with_and_without_normals_do_not_mix_up() {
    let text = format!("{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 -1\nf 1/1/1 2/2/1 3/3/1\nf 1 3 4\n");
    let mesh = load(&text);
    let part = &mesh.parts[0];
    assert_eq!(part.corner_normals(0), Some([[0.0, 0.0, -1.0]; 3]));
    assert_eq!(part.corner_normals(1), Some([[0.0, 0.0, 1.0]; 3]));
    assert_eq!(part.corner_uvs(0), Some([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]));
    assert_eq!(part.corner_uvs(1), None);
    assert_eq!(mesh.report.computed_normals, 1);
}

#[test]
fn every_up_axis_becomes_plus_y_by_a_rotation() {
    let axes = [
        (Axis::PlusX, [1, 0, 0]),
        (Axis::MinusX, [-1, 0, 0]),
        (Axis::PlusY, [0, 1, 0]),
        (Axis::MinusY, [0, -1, 0]),
        (Axis::PlusZ, [0, 0, 1]),
        (Axis::MinusZ, [0, 0, -1]),
    ];
    for (axis, [x, y, z]) in axes {
        let tip =
            format!("{BOX}v 0 0 0\nv 0 0 1e-3\nv {0} {1} {2}\nf 9 10 11\n", 5 * x, 5 * y, 5 * z);
        let tip = if z == 0 { tip } else { tip.replace("v 0 0 1e-3", "v 1e-3 0 0") };
        let mesh = load_as(tip.as_bytes(), &[], 0.01, axis).expect("good");
        let [_, high] = mesh.report.bounds.expect("bounds");
        assert!((high[1] - 0.05).abs() < 1e-7, "{axis:?} {high:?}");
        let parts: Vec<_> = mesh.parts.iter().collect();
        let volume = topology(&parts).signed_volume;
        assert!((volume - 8e-6).abs() < 1e-9, "{axis:?} turns the box inside out: {volume}");
    }
}

#[test]
fn zero_area_triangles_are_dropped_and_counted() {
    let mesh = load(&format!("{SQUARE}f 1 2 3\nf 1 1 2\nv 2 0 0\nf 1 2 5\n"));
    assert_eq!(mesh.report.n_triangles, 1);
    assert_eq!(mesh.report.zero_area.count, 2);
    assert_eq!(mesh.report.zero_area.first.as_deref(), Some("mesh.obj:6"));
    check_error(
        format!("{SQUARE}f 1 1 2\n").as_bytes(),
        "mesh.obj: none of its 1 faces has an area",
    );
}

#[test]
fn zero_normals_are_replaced_and_counted() {
    let mesh = load(&format!("{SQUARE}vn 0 0 0\n\nf 1//1 2//1 3//1\n"));
    assert_eq!(mesh.report.zero_normals.first.as_deref(), Some("mesh.obj:7"));
    assert_eq!(mesh.parts[0].corner_normals(0), Some([[0.0, 0.0, 1.0]; 3]));
}

#[test]
fn needles_and_duplicates_are_counted_and_kept() {
    let mesh = load("v 0 0 0\nv 1 0 0\nv 0.5 1e-7 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 2 4 1\n");
    assert_eq!((mesh.report.needles.count, mesh.report.n_triangles), (1, 3));
    let parts: Vec<_> = mesh.parts.iter().collect();
    let found = topology(&parts);
    assert_eq!((found.duplicates, found.first_duplicate), (1, Some((0, 2))));
}

#[test]
fn odd_but_legal_text_is_read() {
    let text =
        b"\xef\xbb\xbf# caf\xe9\r\nv 0 0 0 1.0\r\nv 2 \\\r\n 0 0 2.0\r\nv\t0 1 0 # corner\r\n\
        vt 0.5\r\nvt 1 1 0\r\nl 1 2\r\nf 1/1/ 2/2 3/1\r\n";
    let mesh = load_with(text, &[]).expect("good");
    assert_eq!(soup(&mesh), [[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    assert_eq!(mesh.parts[0].corner_uvs(0), Some([[0.5, 0.0], [1.0, 1.0], [0.5, 0.0]]));
    assert_eq!(mesh.report.warnings[0].place, "mesh.obj:8");
    let colored = load("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(colored.report.n_triangles, 1);
}

#[test]
fn every_kind_of_bad_line_is_named() {
    let cases: &[(&str, &str)] = &[
        ("v 1 2 nan\n", "5: `nan` is not a finite number"),
        ("v 1 2 inf\n", "5: `inf` is not a finite number"),
        ("v 1 2 1e39\n", "5: `1e39` is not a finite number"),
        ("v 1 2 three\n", "5: `three` is not a number"),
        ("v 1,0 2,0 3,0\n", "5: `1,0` is not a number"),
        ("v 1 2\n", "5: a vertex has 3 numbers (x y z), found 2"),
        ("v 1 2 3 0\n", "5: the weight w makes this vertex infinite"),
        ("vn 0 1\n", "5: a normal has 3 numbers, found 2"),
        ("vt\n", "5: `vt` has 1 to 3 numbers (u v w), found 0"),
        ("f 1 2\n", "5: a face has at least 3 corners, found 2"),
        ("f\n", "5: a face has at least 3 corners, found 0"),
        ("f 1 2 9\n", "5: vertex index 9, but only 4 are defined above this line"),
        ("f 1 2 -5\n", "5: vertex index -5, but only 4 are defined above this line"),
        ("f 1 2 0\n", "5: vertex index 0; indices begin at 1"),
        ("vt 0 0\nf 1/2 2/1 3/1\n", "6: UV index 2, but only 1 are defined above this line"),
        ("f 1//x 2//1 3//1\n", "5: `x` is not an index in `1//x`"),
        ("f 1 2 3.0\n", "5: `3.0` is not an index in `3.0`"),
        (
            "f 1 2 99999999999999999999\n",
            "5: `99999999999999999999` is not an index in `99999999999999999999`",
        ),
        ("f 1 2 /3\n", "5: `/3` is not of the form v/vt/vn"),
        ("f 1 2 3/1/1/1\n", "5: `3/1/1/1` is not of the form v/vt/vn"),
        ("s many\n", "5: `s` takes `off` or a group number, found `many`"),
        (
            "vt 0 0\nf 1 2/1 3\n",
            "6: corner 2 `2/1` has other indices than the corners before it; all \
          corners of a face must have the form v, v/vt, v//vn or v/vt/vn alike",
        ),
        ("\u{1}\u{2}\n", "5: this is no OBJ keyword; is this an OBJ file?"),
    ];
    for (line, expected) in cases {
        check_error(format!("{SQUARE}{line}").as_bytes(), &format!("mesh.obj:{expected}"));
    }
    check_error(SQUARE.as_bytes(), "mesh.obj: the file has no faces");
    check_error(b"", "mesh.obj: this is not an OBJ file but empty");
    let ply = "mesh.obj: this is not an OBJ file but a PLY file; read it with `ply(...)`";
    check_error(b"ply\n", ply);
    check_error(
        b"glTF",
        "mesh.obj: this is not an OBJ file but a GLB file; read it with `gltf(...)`",
    );
    check_error(b"v 0 0 0\0", "mesh.obj: this is not an OBJ file but binary data");
}

#[test]
fn endless_lines_and_polygons_are_refused() {
    let long = vec![b'1'; 10_000_000];
    check_error(&long, "mesh.obj:1: this line is longer than 1048576 bytes; no OBJ line is");
    let continued = b"v \\\n".repeat(1_000_000);
    let error = load_with(&continued, &[]).expect_err("endless");
    assert_eq!(error.kind, ErrorKind::Format);
    let corners = format!("{SQUARE}f{}\n", " 1".repeat(5000));
    check_error(corners.as_bytes(), "mesh.obj:5: a face has at most 4096 corners, found 5000");
}

#[test]
fn limits_and_overflow_are_errors() {
    let folder = TempDir::new().expect("temporary folder");
    let path = folder.path().join("mesh.obj");
    fs::write(&path, BOX).expect("write");
    let limits = Limits { triangles: 11, ..Limits::default() };
    let error = load_obj(&path, 1.0, Axis::PlusY, &limits).expect_err("too many");
    assert_eq!(error.kind, ErrorKind::Limit);
    let limits = Limits { file_bytes: 10, ..Limits::default() };
    let error = load_obj(&path, 1.0, Axis::PlusY, &limits).expect_err("too long");
    assert_eq!(error.kind, ErrorKind::Limit);
    let error = load_as(b"v 0 0 0\nv 1e38 0 0\nv 0 1 0\nf 1 2 3\n", &[], 1000.0, Axis::PlusY);
    assert_eq!(error.expect_err("infinite").kind, ErrorKind::Number);
    let error = load_obj(&folder.path().join("Mesh.OBJ"), 1.0, Axis::PlusY, &Limits::default());
    let error = error.expect_err("other case");
    assert_eq!(
        (error.kind, error.help.as_str()),
        (ErrorKind::Missing, "there is `mesh.obj`: upper and lower case differ")
    );
    let error = load_obj(folder.path(), 1.0, Axis::PlusY, &Limits::default()).expect_err("folder");
    assert_eq!(error.kind, ErrorKind::Io);
}

#[test]
fn missing_libraries_and_images_are_warnings() {
    let text = format!("mtllib no such.mtl\n{SQUARE}usemtl wood\nf 1 2 3\n");
    let mesh = load(&text);
    assert_eq!(mesh.parts[0].material, None);
    let warning = &mesh.report.warnings[0];
    assert_eq!(warning.place, "mesh.obj:1");
    assert_eq!(warning.message, "there is no `no such.mtl`; its materials are not known");
    let mtl: &[u8] = b"newmtl wood\nmap_Kd -s 1 1 1 C:\\textures\\wood.png\n";
    let text = text.replace("no such", "a");
    let mesh = load_with(text.as_bytes(), &[("a.mtl", mtl)]).expect("good");
    assert_eq!(mesh.report.warnings[0].message, "there is no image `C:/textures/wood.png`");
}

/// `place: message` of every warning.
fn warnings(mesh: &MeshFile) -> Vec<String> {
    let warnings = mesh.report.warnings.iter();
    warnings.map(|warning| format!("{}: {}", warning.place, warning.message)).collect()
}

#[test]
fn names_in_latin_1_are_read_and_said() {
    let obj = [b"mtllib gr\xfcn.mtl\n", SQUARE.as_bytes(), b"o T\xfcr\nusemtl Gr\xfcn\nf 1 2 3\n"];
    let mtl = b"# \xa9\nnewmtl Gr\xfcn\nKd 0 1 0\nmap_Kd t\xfcr.png\nmap_Ke t\xfcr.png\n";
    let files: [(&str, &[u8]); 1] = [("gr\u{fc}n.mtl", mtl)];
    let mesh = load_with(&obj.concat(), &files).expect("a good file");
    assert_eq!(mesh.parts[0].name, "T\u{fc}r");
    assert_eq!(mesh.materials[0].name, "Gr\u{fc}n");
    let expected = [
        "mesh.obj:1: 3 names are not UTF-8 and were read as Latin-1; this is the first",
        "gr\u{fc}n.mtl:2: this is not UTF-8; such lines are read as Latin-1",
        "gr\u{fc}n.mtl: material `Gr\u{fc}n`: there is no image `t\u{fc}r.png`",
        "gr\u{fc}n.mtl: material `Gr\u{fc}n`: there is no image `t\u{fc}r.png`",
    ];
    assert_eq!(warnings(&mesh), expected);
}

#[test]
fn indices_of_what_a_file_has_none_of_are_left_out() {
    let text = format!("{SQUARE}f 1//1 2//7 3//-1\nvt 0 0\nf 1/1/9 3/1/9 4/1/9\n");
    let mesh = load(&text);
    let expected = "mesh.obj:5: 2 faces have normal indices, but there are no `vn` lines above them: \
                    their normals are computed";
    assert_eq!(warnings(&mesh), [expected]);
    assert_eq!((mesh.report.n_triangles, mesh.report.computed_normals), (2, 2));
    let mesh = load(&format!("{SQUARE}vn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1/4 3/4 4/4\n"));
    let expected = "mesh.obj:6: 2 faces have UV indices, but there are no `vt` lines above them";
    assert_eq!(warnings(&mesh), [expected]);
    assert_eq!((mesh.report.n_triangles, mesh.report.computed_normals), (2, 1));
    assert_eq!(mesh.parts[0].uvs, compiler::import::Attribute::Absent);
    // Where there are some, an index that is wrong stays an error.
    let error = "mesh.obj:6: normal index 2, but only 1 are defined above this line";
    check_error(format!("{SQUARE}vn 0 0 1\nf 1//2 2//1 3//1\n").as_bytes(), error);
    check_error(
        format!("{SQUARE}f 1//0 2//0 3//0\n").as_bytes(),
        "mesh.obj:5: normal index 0; indices begin at 1",
    );
}

#[test]
fn a_material_without_a_name_and_a_library_that_is_absent_leave_the_others() {
    let text = format!("mtllib a.mtl no.mtl b.mtl\n{SQUARE}usemtl x\nf 1 2 3\nusemtl y\nf 1 3 4\n");
    let files: [(&str, &[u8]); 2] =
        [("a.mtl", b"newmtl\nKd 1 x 0\nnewmtl x\nKd 1 0 0\n"), ("b.mtl", b"newmtl y\nKd 0 1 0\n")];
    let mesh = load_with(text.as_bytes(), &files).expect("a good file");
    let colors: Vec<_> = mesh.materials.iter().map(|material| material.color).collect();
    assert_eq!(colors, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let expected = [
        "mesh.obj:1: there is no `no.mtl`; its materials are not known",
        "a.mtl:1: `newmtl` without a name; this material is left out",
    ];
    assert_eq!(warnings(&mesh), expected);
}

#[test]
fn the_colour_space_of_a_map_is_understood() {
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(1, 1).write_to(&mut png, image::ImageFormat::Png).expect("in memory");
    let space = |written: &str| {
        let text = format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3\n");
        let mtl = format!("newmtl m\n{written}\n");
        let files = [("a.mtl", mtl.as_bytes()), ("x.png", png.get_ref().as_slice())];
        let mesh = load_with(text.as_bytes(), &files).expect("a good file");
        let material = &mesh.materials[0];
        let map = material.color_map.or(material.normal_map).expect("a map");
        (map.space, mesh.report.warnings.len())
    };
    assert_eq!(space("map_Kd -colorspace sRGB x.png"), (ColorSpace::Srgb, 0));
    assert_eq!(space("map_Kd -colorspace linear -clamp on x.png"), (ColorSpace::Linear, 0));
    assert_eq!(space("norm -colorspace linear x.png"), (ColorSpace::Data, 0));
    assert_eq!(space("norm -colorspace sRGB x.png"), (ColorSpace::Data, 1));
    assert_eq!(space("map_Kd -colorspace ACEScg x.png"), (ColorSpace::Srgb, 1));
}

#[test]
fn bad_mtl_lines_are_named() {
    let text = format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3\n");
    let cases: [(&[u8], &str); 5] = [
        (b"newmtl m\nKd 1 2\n", "a.mtl:2: `Kd` has 3 numbers, found 2"),
        (b"newmtl m\nKd 1 2 x\n", "a.mtl:2: `x` is not a number"),
        (b"newmtl m\n\nNs nan\n", "a.mtl:3: `nan` is not a finite number"),
        (b"newmtl m\nd\n", "a.mtl:2: `d` has 1 number, found 0"),
        (b"Kd 1 1 1\n", "a.mtl:1: `Kd` before the first `newmtl`"),
    ];
    for (mtl, expected) in cases {
        let error = load_with(text.as_bytes(), &[("a.mtl", mtl)]).expect_err("bad");
        assert_eq!(error.to_string(), expected);
    }
}

#[test]
fn mtl_transparency_emission_and_images() {
    let mtl: &[u8] = b"newmtl glass\nKd 1 1 1\nillum 7\nd 0.1\nNi 1.45\nKs 1 1 1\nNs 1000\n\
        newmtl leaf\nKd 0 0 0\nmap_Kd leaf.png\nmap_d -clamp on leaf.png\n\
        newmtl lamp\nKe 5 4 3\nTr 0.25\nnewmtl odd\nKd 0.5\nKa spectral x\nunknown 1\nillum 99999\n";
    let mut leaf = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut leaf);
    image::ImageEncoder::write_image(encoder, &[7, 200], 2, 1, image::ExtendedColorType::L8)
        .expect("encode");
    let text = format!(
        "mtllib a.mtl\n{SQUARE}usemtl glass\nf 1 2 3\nusemtl leaf\nf 1 2 3\nusemtl lamp\nf 1 2 3\n\
         usemtl odd\nf 1 2 3\n"
    );
    let files: [(&str, &[u8]); 2] = [("a.mtl", mtl), ("leaf.png", &leaf)];
    let mesh = load_with(text.as_bytes(), &files).expect("good");
    let [glass, leaf, lamp, odd] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert!((glass.transmission - 0.9).abs() < 1e-6 && (glass.ior - 1.45).abs() < 1e-6);
    assert_eq!(leaf.color, [1.0; 3], "black beside an image is white");
    assert_eq!(leaf.alpha_clip, None, "a dissolve is a share");
    let (color, alpha) = (leaf.color_map.expect("map"), leaf.alpha_map.expect("map"));
    assert_ne!(color.image, alpha.image, "the mask has its brightness in alpha");
    let compiler::import::Pixels::Rgba8(mask) = &mesh.images[alpha.image as usize].image.data
    else {
        panic!("8 bits");
    };
    assert_eq!(mask[..], [7, 7, 7, 7, 200, 200, 200, 200]);
    assert_eq!((lamp.emission, lamp.alpha), ([5.0, 4.0, 3.0], 0.75));
    assert_eq!(odd.color, [0.5; 3]);
    assert_eq!(mesh.report.files.len(), 4, "the mesh, the library, the image in two roles");
}

/// Some programs write `Tr 1` for what is opaque.
#[test]
fn what_would_be_invisible_is_opaque() {
    let mtl: &[u8] = b"newmtl a\nTr 1\nillum 2\nnewmtl b\nd 0\nTr 1\n";
    let text = format!("mtllib a.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
    let mesh = load_with(text.as_bytes(), &[("a.mtl", mtl)]).expect("good");
    let [a, b] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((a.alpha, b.alpha), (1.0, 0.0));
    let said = warnings(&mesh);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].ends_with("`Tr 1` would make this material invisible; it is read as opaque"),
        "{said:?}"
    );
}

#[test]
fn thread_count_does_not_change_the_result() {
    let mut text = String::new();
    for i in 0..40 {
        for j in 0..40 {
            let height = f64::from((i * 7 + j * 13) % 11) * 0.05;
            text += &format!("v {i} {height} {j}\n");
        }
    }
    for i in 0..39 {
        for j in 1..40 {
            let a = 40 * i + j;
            text += &format!("f {} {} {} {}\n", a, a + 1, a + 41, a + 40);
        }
    }
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        pool.install(|| load(&text))
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(one.parts[0].normals, three.parts[0].normals);
    assert_eq!(one.parts[0].triangles, three.parts[0].triangles);
}

/// A wheel of triangles around one vertex must not take quadratic time.
#[test]
fn crowded_vertices_take_linear_time() {
    let n = 60_000;
    let mut text = String::from("v 0 0 0\n");
    for i in 0..n {
        let angle = f64::from(i) * std::f64::consts::TAU / f64::from(n);
        text +=
            &format!("v {} {} {}\n", 100.0 * angle.cos(), f64::from(i % 3), 100.0 * angle.sin());
    }
    for i in 0..n {
        text += &format!("f 1 {} {}\n", (i + 1) % n + 2, i + 2);
    }
    let start = std::time::Instant::now();
    let mesh = load(&text);
    assert_eq!(mesh.report.n_triangles, 60_000);
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}
