//! PLY and STL: the same mesh as the OBJ file of it, and everything wrong named with its place.

#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use compiler::import::{
    Attribute, Budget, ErrorKind, ImportError, Limits, MeshFile, read_obj, read_ply, read_stl,
    topology,
};
use lang::scene::Axis;
use std::path::Path;

/// A tetrahedron and a quadrilateral beside it: corners, faces.
const POINTS: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [5.0, 0.0, 0.0],
    [6.0, 0.0, 0.0],
    [6.0, 1.0, 0.0],
    [5.0, 1.0, 0.0],
];
const FACES: [&[u32]; 5] = [&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3], &[4, 5, 6, 7]];

/// How a PLY file stores its numbers.
#[derive(Clone, Copy)]
enum Order {
    Text,
    Little,
    Big,
}

fn words<T: ToString>(values: &[T]) -> String {
    values.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// Each with its end.
fn lines(texts: impl Iterator<Item = String>) -> String {
    texts.map(|text| text + "\n").collect()
}

/// The mesh as a PLY file with these vertices: of each all numbers, by these names.
fn ply(order: Order, names: &[&str], vertices: &[Vec<f32>], faces: &[&[u32]]) -> Vec<u8> {
    let format = match order {
        Order::Text => "ascii",
        Order::Little => "binary_little_endian",
        Order::Big => "binary_big_endian",
    };
    let properties = lines(names.iter().map(|name| format!("property float {name}")));
    let (n, m) = (vertices.len(), faces.len());
    let mut out = format!(
        "ply\nformat {format} 1.0\nelement vertex {n}\n{properties}element face {m}\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let number = |bytes: [u8; 4]| {
        if matches!(order, Order::Big) { bytes.into_iter().rev().collect() } else { bytes.to_vec() }
    };
    for vertex in vertices {
        match order {
            Order::Text => out.extend(format!("{}\n", words(vertex)).into_bytes()),
            Order::Little | Order::Big => {
                out.extend(vertex.iter().flat_map(|x| number(x.to_le_bytes())));
            }
        }
    }
    for face in faces {
        match order {
            Order::Text => out.extend(format!("{} {}\n", face.len(), words(face)).into_bytes()),
            Order::Little | Order::Big => {
                out.push(u8::try_from(face.len()).expect("few corners"));
                out.extend(face.iter().flat_map(|index| number(index.to_le_bytes())));
            }
        }
    }
    out
}

fn plain(order: Order) -> Vec<u8> {
    let vertices: Vec<Vec<f32>> = POINTS.iter().map(|p| p.to_vec()).collect();
    ply(order, &["x", "y", "z"], &vertices, &FACES)
}

fn obj() -> MeshFile {
    let points = lines(POINTS.iter().map(|p| format!("v {}", words(p))));
    let from_one = |face: &&[u32]| face.iter().map(|index| index + 1).collect::<Vec<_>>();
    let faces = lines(FACES.iter().map(|face| format!("f {}", words(&from_one(face)))));
    let text = points + &faces;
    read_obj(text.as_bytes(), Path::new("a.obj"), 0.01, Axis::PlusZ, &Limits::default())
        .expect("good")
}

fn load_ply(bytes: &[u8]) -> Result<MeshFile, ImportError> {
    read_ply(bytes, Path::new("a.ply"), 0.01, Axis::PlusZ, &Limits::default())
}

fn load_stl(bytes: &[u8]) -> Result<MeshFile, ImportError> {
    read_stl(bytes, Path::new("a.stl"), 0.01, Axis::PlusZ, &Limits::default())
}

/// Triangles without the quadrilateral's, as STL: text or binary.
fn stl(text: bool) -> Vec<u8> {
    let triangles: Vec<[[f32; 3]; 3]> =
        FACES[..4].iter().map(|face| [0, 1, 2].map(|k| POINTS[face[k] as usize])).collect();
    if text {
        let facet = |corners: &[[f32; 3]; 3]| {
            let vertices = lines(corners.iter().map(|p| format!("vertex {}", words(p))));
            format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
        };
        let facets: String = triangles.iter().map(facet).collect();
        return format!("solid a b\n{facets}endsolid a b\n").into_bytes();
    }
    let mut out = b"solid, says a binary file".to_vec();
    out.resize(80, 0);
    out.extend(4_u32.to_le_bytes());
    for corners in triangles {
        out.extend([0; 12]);
        out.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        out.extend([7, 7]);
    }
    out
}

#[test]
fn a_ply_file_is_the_obj_file_of_the_same_mesh() {
    let expected = obj();
    for order in [Order::Text, Order::Little, Order::Big] {
        let found = load_ply(&plain(order)).expect("a good file");
        let (part, other) = (&found.parts[0], &expected.parts[0]);
        assert_eq!((&part.positions, &part.triangles), (&other.positions, &other.triangles));
        assert_eq!((&part.normals, &part.uvs), (&other.normals, &other.uvs));
        let counts = |file: &MeshFile| {
            let report = &file.report;
            (report.n_triangles, report.n_polygons, report.computed_normals, report.bounds)
        };
        assert_eq!(counts(&found), counts(&expected));
    }
}

#[test]
fn normals_and_texture_coordinates_of_vertices_and_of_faces_are_read() {
    for uv in [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]] {
        let names = ["x", "y", "z", "nx", "ny", "nz", uv[0], uv[1], "quality"];
        let vertices: Vec<Vec<f32>> = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
            .iter()
            .map(|[x, y]| vec![*x, *y, 0.0, 0.0, 0.0, 2.0, *x, 1.0 - *y, 9.0])
            .collect();
        let found = load_ply(&ply(Order::Big, &names, &vertices, &[&[0, 1, 2]])).expect("good");
        let part = &found.parts[0];
        assert_eq!(part.corner_normals(0), Some([[0.0, 1.0, 0.0]; 3]), "turned and of length 1");
        assert_eq!(part.corner_uvs(0), Some([[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]));
        assert_eq!(found.report.computed_normals, 0);
    }
    let text = "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\n\
                property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
                property uchar blue\nelement face 2\nproperty list uchar int vertex_index\n\
                property list uchar float texcoord\nend_header\n0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n\
                3 0 1 2 6 0 .5 1. 0.5 0 1\n3 2 1 0 0";
    let found = load_ply(text.as_bytes()).expect("a good file");
    let part = &found.parts[0];
    assert_eq!(part.corner_uvs(0), Some([[0.0, 0.5], [1.0, 0.5], [0.0, 1.0]]));
    assert_eq!(part.corner_uvs(1), None);
    let said: Vec<&str> = found.report.warnings.iter().map(|w| w.message.as_str()).collect();
    let image = "the image `a.png` is not used; declare it as `texture` and give it to a material";
    assert_eq!(said, [image]);
}

#[test]
fn an_stl_file_is_welded_and_closed_whatever_its_form() {
    let expected = obj();
    for text in [true, false] {
        let found = load_stl(&stl(text)).expect("a good file");
        let part = &found.parts[0];
        assert_eq!(part.name, if text { "a b" } else { "" });
        assert_eq!((part.positions.len(), part.triangles.len()), (4, 4));
        for (tri, _) in part.triangles.iter().enumerate() {
            assert_eq!(part.corners(tri), expected.parts[0].corners(tri));
            assert_eq!(part.corner_normals(tri), expected.parts[0].corner_normals(tri));
        }
        assert_eq!(part.uvs, Attribute::Absent);
        let surface = topology(&[part]);
        assert_eq!((surface.boundary_edges, surface.flipped_edges), (0, 0));
        assert!(surface.signed_volume > 0.0);
    }
    let mut longer = stl(false);
    longer[..5].copy_from_slice(b"Magic");
    longer.extend([0; 9]);
    assert_eq!(load_stl(&longer).expect("more behind the last triangle").report.n_triangles, 4);
}

#[test]
fn solids_are_parts_and_words_may_be_shouted() {
    let text = "SOLID Lid\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1 0 0\r\n\
                VERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID\r\nsolid é\nfacet normal 0 0 1\n\
                outer loop\nvertex 0 0 5\nvertex 1 0 5\nvertex 0 1 5\nendloop\nendfacet\nendsolid\n";
    let latin: Vec<u8> =
        text.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect();
    let found = load_stl(&latin).expect("a good file");
    assert_eq!(found.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(), ["Lid", "é"]);
    assert_eq!(found.find_parts("lid"), [0]);
    assert_eq!(found.report.warnings[0].place, "a.stl:10");
}

const HEAD: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                    property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

#[test]
fn every_kind_of_bad_ply_file_is_named() {
    let rows = |rows: &str| format!("{HEAD}{rows}").into_bytes();
    let replaced = |from: &str, to: &str| {
        format!("{}0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", HEAD.replace(from, to)).into_bytes()
    };
    let cases: Vec<(Vec<u8>, ErrorKind, &str)> = vec![
        (
            b"solid x".to_vec(),
            ErrorKind::Format,
            "a.ply: this is not a PLY file but an STL file; read it with `stl(...)`",
        ),
        (
            b"v 0 0 0".to_vec(),
            ErrorKind::Format,
            "a.ply: this is not a PLY file: it does not begin with `ply`",
        ),
        (b"ply\n".to_vec(), ErrorKind::Format, "a.ply: its header has no line `end_header`"),
        (replaced("ascii", "utf8"), ErrorKind::Format, "a.ply: Unknown format: utf8"),
        (replaced("float x", "half x"), ErrorKind::Format, "a.ply: Unknown scalar type: half"),
        (
            replaced("float x", "float q"),
            ErrorKind::Format,
            "a.ply: its vertices do not have `x`, `y` and `z`",
        ),
        (
            replaced("face 1", "faces 1"),
            ErrorKind::Empty,
            "a.ply: the file has no faces; it has 3 vertex, 1 faces",
        ),
        (
            replaced("vertex 3", "vertex 4000000000"),
            ErrorKind::Format,
            "a.ply: it cannot hold the 4000000000 rows of `vertex` that its header claims",
        ),
        (
            replaced("element face", "element vertex"),
            ErrorKind::Format,
            "a.ply: `element vertex` stands twice in the header",
        ),
        (
            rows("0 0 0\n1 0 0\n0 1 x\n3 0 1 2\n"),
            ErrorKind::Format,
            "a.ply: vertex 2: Failed to parse f32 from ASCII",
        ),
        (
            rows("0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n"),
            ErrorKind::Number,
            "a.ply: vertex 1: `inf` is not a finite number",
        ),
        (
            rows("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            ErrorKind::Index,
            "a.ply: face 0: vertex 3, but there are 3 vertices",
        ),
        (
            rows("0 0 0\n1 0 0\n0 1 0\n3 0 1\n"),
            ErrorKind::Format,
            "a.ply: face 0: the file ends here; it should have 1 rows",
        ),
        (
            rows("0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n"),
            ErrorKind::Empty,
            "a.ply: none of its 1 faces has an area",
        ),
    ];
    for (bytes, kind, expected) in cases {
        let error = load_ply(&bytes).expect_err(expected);
        assert_eq!((error.to_string().as_str(), error.kind), (expected, kind));
    }
}

#[test]
fn a_binary_ply_file_that_is_cut_off_says_where() {
    for order in [Order::Little, Order::Big] {
        let whole = plain(order);
        let error = load_ply(&whole[..whole.len() - 1]).expect_err("cut off").to_string();
        assert_eq!(error, "a.ply: face 4: the file ends here; it should have 5 rows");
    }
}

#[test]
fn every_kind_of_bad_stl_file_is_named() {
    let facet = |rows: &str| {
        format!("solid q\nfacet normal 0 0 1\nouter loop\n{rows}endloop\n").into_bytes()
    };
    let mut cut = stl(false);
    cut[..5].copy_from_slice(b"Magic");
    cut.truncate(200);
    let mut infinite = stl(false);
    infinite[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (
            b"ply\n".to_vec(),
            "a.stl: this is not an STL file but a PLY file; read it with `ply(...)`",
        ),
        (Vec::new(), "a.stl: this is not an STL file but empty"),
        (b"v 0 0 0".to_vec(), "a.stl: this is no STL file: it does not begin with `solid`"),
        (
            cut,
            "a.stl: this is no STL file, or one that is cut off: a text begins with `solid`, and as a binary file it claims 4 triangles and has room for 2",
        ),
        (infinite, "a.stl: face 1: `NaN` is not a finite number"),
        (facet("vertex 0 0 0\nvertex 1 0 0\n"), "a.stl:6: a facet has 3 vertices, found 2"),
        (
            facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 1 1\n"),
            "a.stl:7: a facet has 3 vertices, this is the fourth",
        ),
        (facet("vertex 0 0\n"), "a.stl:4: a vertex has 3 numbers (x y z), found 2"),
        (facet("vertex 0 0 1e39\n"), "a.stl:4: `1e39` is not a finite number"),
        (b"solid q\nmesh\n".to_vec(), "a.stl:2: this is no STL keyword; is this an STL file?"),
        (b"solid q\nvertex 0 0 0".to_vec(), "a.stl:2: the file ends inside of a facet"),
        (b"solid q\nendsolid q".to_vec(), "a.stl: the file has no faces"),
    ];
    for (bytes, expected) in cases {
        assert_eq!(load_stl(&bytes).expect_err(expected).to_string(), expected);
    }
}

#[test]
fn limits_come_before_memory() {
    let few = Limits { triangles: 3, ..Limits::default() };
    let error = read_ply(&plain(Order::Text), Path::new("a.ply"), 1.0, Axis::PlusY, &few);
    assert_eq!(error.expect_err("5 faces").to_string(), "a.ply: 5 faces, the limit is 3");
    for text in [true, false] {
        let error = read_stl(&stl(text), Path::new("a.stl"), 1.0, Axis::PlusY, &few);
        assert_eq!(error.expect_err("4 triangles").kind, ErrorKind::Limit);
    }
    let vertices = vec![vec![0.0, 0.0, 0.0]; 100_000];
    let many = ply(Order::Little, &["x", "y", "z"], &vertices, &[&[0, 1, 2]]);
    let poor = Limits { memory: Budget::of(1_000_000), ..Limits::default() };
    let error = read_ply(&many, Path::new("a.ply"), 1.0, Axis::PlusY, &poor);
    assert_eq!(error.expect_err("no memory").kind, ErrorKind::Memory);
}

#[test]
fn colours_of_vertices_go_with_their_corners() {
    let colors: [[f32; 3]; 8] = std::array::from_fn(|i| {
        let x = i as f32 / 7.0;
        [x, 1.0 - x, (i % 2) as f32]
    });
    let names = ["x", "y", "z", "red", "green", "blue"];
    let vertices: Vec<Vec<f32>> =
        POINTS.iter().zip(colors).map(|(p, c)| p.iter().chain(&c).copied().collect()).collect();
    let found = load_ply(&ply(Order::Little, &names, &vertices, &FACES)).expect("a good file");
    let part = &found.parts[0];
    assert_eq!((part.triangles.len(), found.images.len(), found.materials.len()), (6, 0, 1));
    assert!(found.report.warnings.is_empty());
    assert!(found.materials[0].vertex_colors && !found.materials[0].vertex_alpha);
    for (tri_idx, corners) in part.triangles.iter().enumerate() {
        // Positions were copied in the order of their first use: found again by where they are.
        let of = |vertex: u32| {
            let p = part.positions[vertex as usize];
            let same = |q: &[f32; 3]| {
                let [x, y, z] = q.map(|x| x * 0.01);
                (p[0] - x).abs() + (p[1] - z).abs() + (p[2] + y).abs() < 1e-6
            };
            let [r, g, b] = colors[POINTS.iter().position(same).expect("one of the points")];
            [r, g, b, 1.0]
        };
        assert_eq!(part.corner_colors(tri_idx), corners.map(of));
    }
}

#[test]
fn one_colour_is_a_factor_and_integers_have_the_srgb_curve() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n\
                property list uchar int vertex_index\nend_header\n0 0 0 255 188 0\n1 0 0 255 188 0\n0 1 0 255 188 0\n3 0 1 2\n";
    let found = load_ply(text.as_bytes()).expect("a good file");
    let material = &found.materials[found.parts[0].material.expect("coloured") as usize];
    assert!(found.images.is_empty() && material.diffuse_only && !material.vertex_colors);
    assert_eq!(found.parts[0].colors.len(), 3, "for other materials");
    let [r, g, b] = material.color;
    assert!(r == 1.0 && (g - 0.5029).abs() < 1e-4 && b == 0.0, "{g}");
    // Alpha has no curve and covers nothing by itself; materials of a scene may ask for it.
    let text = text.replace("property uchar blue", "property uchar blue\nproperty uchar alpha");
    let text = text.replace("188 0\n", "188 0 51\n");
    let found = load_ply(text.as_bytes()).expect("a good file");
    assert!(found.parts[0].colors.iter().all(|color| (color[3] - 0.2).abs() < 1e-6));
    let material = &found.materials[found.parts[0].material.expect("coloured") as usize];
    assert!(!material.vertex_alpha && (material.alpha - 1.0).abs() < 1e-9);
    let text = text.replace("uchar alpha", "float alpha").replace("188 0 51", "188 0 0.75");
    let found = load_ply(text.as_bytes()).expect("a good file");
    assert!(found.parts[0].colors.iter().all(|color| (color[3] - 0.75).abs() < 1e-6));
    // OBJ: 0 to 1, or to 255; none where some vertices have none.
    for (rgb, expected) in [("1 0.5 0", 0.2140), ("255 188 0", 0.5029)] {
        let text = format!("v 0 0 0 {rgb}\nv 1 0 0 {rgb}\nv 0 1 0 {rgb}\nf 1 2 3\n");
        let found =
            read_obj(text.as_bytes(), Path::new("a.obj"), 1.0, Axis::PlusY, &Limits::default());
        let found = found.expect("a good file");
        assert!(
            (found.materials[0].color[1] - expected).abs() < 1e-4,
            "{:?}",
            found.materials[0].color
        );
    }
    let text = "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n";
    let found = read_obj(text.as_bytes(), Path::new("a.obj"), 1.0, Axis::PlusY, &Limits::default());
    let found = found.expect("a good file");
    assert_eq!(
        found.report.warnings[0].message,
        "2 vertices have a colour and others none; no colour is used"
    );
    assert!(found.materials.is_empty());
}
