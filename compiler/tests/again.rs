//! After an edit that leaves geometry as it is, the pack is the one that compiling everything gives, byte for byte;
//! and geometry is taken over where that is promised.

mod rtc_support;

use std::path::Path;

const SCENE: &str = "rts 1
param turn: number = 20
texture tile = image(\"tile.png\", space: srgb)
asset land = obj(\"hill.obj\", unit: m, up: +y)
medium milk: homogeneous { sigma_a = (0.1, 0.2, 0.3)/m, sigma_s = (9, 9, 9)/m, g = 0.5 }
medium haze: fog { visibility = 200m, color = linear(0.6, 0.7, 0.8) }
material clay: diffuse { color = tile }
material brass: metal { color = linear(0.9, 0.7, 0.3), fuzz = 0.2 }
material oak: wood { color = srgb(#8a5a33), grain = x }
material glow: emissive { color = linear(1, 0.5, 0.2), strength = 3 }
material sea: water { ior = 1.33, waves.height = 1, waves.scale = 2 }
material glass: dielectric { ior = 1.5, interior = milk }
instance hill { shape = land, material = clay }
instance near[i in 0..4] { shape = land, material = brass, at = (3 * i, 0.5, -4)m, rotate = (0, turn * i, 0)deg }
instance beam { shape = box(size: (2, 0.2, 0.2)m), material = oak, at = (0, 2, 0)m }
instance ball { shape = sphere(radius: 20cm), material = glass, at = (1, 1, 2)m }
instance panel { shape = rectangle(size: (1, 1)m), material = glow, at = (0, 4, 0)m }
instance sign { shape = land, material = glow, at = (0, 3.5, -2)m, scale = 0.1 }
instance floor { shape = rectangle(size: (40, 40)m), material = clay, at = (0, -1, 0)m }
instance moon { shape = sphere(radius: 10cm), material = clay, at = (0, 9, 0)m }
instance pond { shape = box(size: (2, 1, 2)m), material = sea, at = (6, 0, 0)m }
light lamp: sphere { center = (0, 3, 0)m, radius = 10cm, strength = 5 }
sky dusk: gradient {
  zenith = linear(0.2, 0.2, 0.4), middle = linear(0.3, 0.3, 0.4), horizon = linear(0.5, 0.4, 0.4)
  ground = linear(0.1, 0.1, 0.1), sun.direction = (1, 1, 0), disc.color = linear(9, 9, 8), disc.power = 60
}
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m }
film wide { size = (64, 36)px }
render main: path { samples = 1, sky = dusk, atmosphere = haze, film = wide }
";

/// What the last pack had.
#[derive(Debug, PartialEq, Eq)]
enum Reuse {
    Nothing,
    /// Triangles of some things.
    OfOthers,
    /// Everything but texels.
    Geometry,
    All,
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder"));
        folder.image([200, 90, 60]);
        folder.hill(0.0);
        folder.write("scene.rts", SCENE);
        folder
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path().join(name), text).expect("writable");
    }

    fn image(&self, color: [u8; 3]) {
        let image = image::RgbImage::from_pixel(4, 4, image::Rgb(color));
        image.save(self.path().join("tile.png")).expect("writable");
    }

    /// A hilly sheet of 800 triangles; one of its corners is higher by `bump`.
    fn hill(&self, bump: f64) {
        use std::fmt::Write as _;
        let mut text = String::new();
        let n = 20;
        for i in 0..=n {
            for j in 0..=n {
                let (x, z) = (f64::from(i) * 0.1 - 1.0, f64::from(j) * 0.1 - 1.0);
                let y =
                    0.1 * (x * 3.0).sin() * (z * 2.0).cos() + if i + j == 0 { bump } else { 0.0 };
                let _ = writeln!(text, "v {x} {y} {z}\nvt {} {}", x + 1.0, z + 1.0);
            }
        }
        for i in 0..n {
            for j in 0..n {
                let at = |i: i32, j: i32| i * (n + 1) + j + 1;
                let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
                let _ = writeln!(text, "f {a}/{a} {b}/{b} {c}/{c}\nf {a}/{a} {c}/{c} {d}/{d}");
            }
        }
        self.write("hill.obj", &text);
    }

    fn edit(&self, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.path().join("scene.rts")).expect("it is there");
        assert!(text.contains(from), "{from}");
        self.write("scene.rts", &text.replacen(from, to, 1));
    }

    fn rtc(&self, cache: &str, pack: &str, args: &[&str]) -> String {
        rtc_support::rtc(self.path(), cache, pack, args)
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path().join(name)).expect("it is there")
    }

    /// Compiles; says whether geometry was taken over. The pack is that of compiling everything.
    fn takes_over(&self, what: &str) -> bool {
        self.reuse(what) == Reuse::All
    }

    /// Compiles; says what of the geometry was taken over. The pack is that of compiling everything.
    fn reuse(&self, what: &str) -> Reuse {
        self.reuse_with(what, &[])
    }

    /// As `reuse`, with arguments. Everything that is warned of is what compiling everything warns of.
    fn reuse_with(&self, what: &str, args: &[&str]) -> Reuse {
        let log = self.rtc("cache", "a.pack", args);
        let whole = self.rtc("none", "b.pack", &[args, &["--no-cache"]].concat());
        assert!(self.read("a.pack") == self.read("b.pack"), "{what}: other bytes; {log}");
        assert_eq!(said(&log), said(&whole), "{what}");
        if log.contains("reused the geometry and the textures of the last pack") {
            Reuse::All
        } else if log.contains("reused the geometry of the last pack") {
            Reuse::Geometry
        } else if log.contains("the geometry of what has not moved") {
            Reuse::OfOthers
        } else {
            Reuse::Nothing
        }
    }
}

/// Everything before the line about the pack: what was warned of.
fn said(log: &str) -> &str {
    log.split("b.pack: ").next().and_then(|log| log.split("a.pack: ").next()).unwrap_or_default()
}

#[test]
fn what_is_taken_over_is_what_would_be_made() {
    let folder = Folder::new();
    assert!(!folder.takes_over("at first"));
    for (from, to) in [
        ("from = (0, 1, 6)m", "from = (0, 2, 7)m"),
        // Into the water, and out again.
        ("from = (0, 2, 7)m", "from = (6, 0.1, 0)m"),
        ("from = (6, 0.1, 0)m", "from = (0, 1, 6)m"),
        ("fuzz = 0.2", "fuzz = 0.3"),
        ("#8a5a33", "#70401f"),
        ("ior = 1.33", "ior = 1.34"),
        ("strength = 3", "strength = 4"),
        ("strength = 5", "strength = 50"),
        ("g = 0.5", "g = -0.2"),
        ("sigma_a = (0.1, 0.2, 0.3)/m", "sigma_a = (0.3, 0.2, 0.1)/m"),
        ("visibility = 200m", "visibility = 300m"),
        // Another sky, and the first again.
        ("disc.color = linear(9, 9, 8)", "disc.color = linear(9, 1, 1)"),
        ("disc.color = linear(9, 1, 1)", "disc.color = linear(9, 9, 8)"),
        ("disc.color = linear(9, 9, 8)", "disc.color = linear(0, 0, 0)"),
        ("disc.color = linear(0, 0, 0)", "disc.color = linear(9, 9, 8)"),
        ("size = (64, 36)px", "size = (80, 45)px, exposure = 1EV"),
        ("samples = 1", "samples = 2, depth = 4, sampler = pcg"),
        ("rts 1\n", "rts 1\n\n// A remark.\n"),
        ("param turn", "let unused = 1\nparam turn"),
        ("let unused = 1\n", ""),
        ("waves.height = 1", "waves.height = 0"),
        ("sigma_s = (9, 9, 9)/m", "sigma_s = (8, 9, 9)/m"),
        ("atmosphere = haze", "atmosphere = milk"),
        ("instance beam", "instance bean"),
    ] {
        folder.edit(from, to);
        assert!(folder.takes_over(to), "{to}");
    }
}

#[test]
fn what_does_not_move_is_taken_over() {
    let folder = Folder::new();
    assert_eq!(folder.reuse("at first"), Reuse::Nothing);
    for (from, to) in [
        // A mesh with triangles of its own, and away from the others.
        ("shape = land, material = clay", "shape = land, material = clay, at = (0.1, 0, 0)m"),
        ("at = (0.1, 0, 0)m", "at = (0.5, 0, 0)m, rotate = (0, 30, 5)deg, scale = (0.9, -1, 0.5)"),
        ("at = (0.5, 0, 0)m, rotate", "at = (0.5, 0.5, 0.5)m, rotate"),
        // One that gives light.
        ("at = (0, 3.5, -2)m", "at = (0.5, 3, -1)m"),
        // Places of a mesh that is stored once.
        ("turn: number = 20", "turn: number = 21"),
        ("at = (3 * i, 0.5, -4)m", "at = (3 * i, 0.5 + 0.1 * i, -4)m"),
        // A box of wood, a ball that is filled, a panel that gives light, and a light.
        ("at = (0, 2, 0)m", "at = (0.25, 2, 0)m, rotate = (0, 10, 0)deg"),
        ("at = (1, 1, 2)m", "at = (1, 1.2, 2)m"),
        ("at = (0, 4, 0)m", "at = (0, 4, 1)m, scale = 2"),
        ("center = (0, 3, 0)m", "center = (1, 3, 0)m"),
        // The camera comes to be inside of the ball, with which everything else changes, too.
        ("from = (0, 1, 6)m", "from = (1, 1.2, 2)m"),
        ("at = (1, 1.2, 2)m", "at = (1, 1, 2)m, scale = 2"),
        ("fuzz = 0.2", "fuzz = 0.3"),
        ("turn: number = 21", "turn: number = 22"),
        ("at = (0.5, 0.5, 0.5)m, rotate = (0, 30, 5)deg, scale = (0.9, -1, 0.5)", "scale = 0.5"),
        // Another sky, while something moves.
        ("disc.color = linear(9, 9, 8), disc.power = 60\n}", "disc.color = linear(0, 0, 0)\n}"),
        ("scale = 0.5 }\ninstance near", "scale = 0.25 }\ninstance near"),
        // One place more of a mesh that is stored once, and one less.
        ("near[i in 0..4]", "near[i in 0..5]"),
        ("near[i in 0..5]", "near[i in 0..3]"),
        // A light at infinity, which is before all others in the table of lights, and none again.
        (
            "sky dusk: gradient",
            "light sun: directional { direction = (1, 1, 0), illuminance = 9W/m2 }\nsky dusk: gradient",
        ),
        ("illuminance = 9W/m2", "illuminance = 5W/m2"),
        ("illuminance = 5W/m2", "illuminance = 0W/m2"),
        // A thing before all others.
        (
            "instance hill",
            "instance peg { shape = sphere(radius: 1cm), material = clay }\ninstance hill",
        ),
    ] {
        folder.edit(from, to);
        let reuse = folder.reuse(to);
        assert_ne!(reuse, Reuse::Nothing, "{to}");
    }
    folder.edit("at = (0.5, 3, -1)m", "at = (0.5, 3, -0.5)m");
    folder.edit("fuzz = 0.3", "fuzz = 0.1");
    assert_eq!(folder.reuse("a move and a number"), Reuse::OfOthers);
}

#[test]
fn moves_may_change_everything() {
    let folder = Folder::new();
    assert_eq!(folder.reuse("at first"), Reuse::Nothing);
    for (from, to) in [
        // The frame of the scene.
        ("at = (6, 0, 0)m", "at = (60, 0, 0)m"),
        // Other triangles have no area.
        ("at = (60, 0, 0)m", "at = (600000000, 0, 0)m"),
        ("at = (600000000, 0, 0)m", "at = (6, 0, 0)m"),
    ] {
        folder.edit(from, to);
        assert_ne!(folder.reuse(to), Reuse::All, "{to}");
    }
    folder.edit("at = (0, 2, 0)m", "at = (0, 2, 0.1)m");
    assert_eq!(folder.reuse("a beam within"), Reuse::OfOthers);
}

#[test]
fn warnings_of_moves_are_those_of_compiling_everything() {
    let folder = Folder::new();
    assert_eq!(folder.reuse("at first"), Reuse::Nothing);
    // The ball, filled with milk, and the pond overlap.
    folder.edit("at = (1, 1, 2)m", "at = (5.1, 0.5, 0)m, scale = 3");
    assert_eq!(folder.reuse("an overlap"), Reuse::OfOthers);
    assert!(folder.rtc("none", "b.pack", &["--no-cache"]).contains("warning[W0526]"));
    // What warned is known all the same.
    folder.edit("at = (0, 2, 0)m", "at = (0, 2, 0.1)m");
    assert_eq!(folder.reuse("after warnings"), Reuse::OfOthers);
    folder.edit("from = (0, 1, 6)m", "from = (0, 1, 7)m");
    assert_eq!(folder.reuse("a camera after warnings"), Reuse::All);
}

#[test]
fn a_parameter_is_another_text() {
    let folder = Folder::new();
    assert_eq!(folder.reuse_with("at first", &["-D", "turn=0"]), Reuse::Nothing);
    assert_eq!(folder.reuse_with("turned", &["-D", "turn=10"]), Reuse::OfOthers);
    assert_eq!(folder.reuse_with("back", &["-D", "turn=0"]), Reuse::OfOthers);
    folder.edit("fuzz = 0.2", "fuzz = 0.3");
    assert_eq!(folder.reuse_with("a material", &["-D", "turn=0"]), Reuse::All);
    assert_eq!(folder.reuse("without"), Reuse::OfOthers);
}

#[test]
fn models_with_warnings_are_known() {
    let folder = Folder::new();
    // A library that is not there, a triangle without area, and a material that nobody defines.
    let obj = "mtllib crate.mtl other.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 2 0 0\nvt 0 0\n\
               usemtl wood\nf 1/1 2/1 3/1\nf 1/1 2/1 5/1\nusemtl iron\nf 1/1 3/1 4/1\n";
    folder.write("crate.obj", obj);
    folder.write(
        "crate.mtl",
        "newmtl wood\nKd 0.5 0.3 0.1\nmap_Kd none.png\nnewmtl iron\nKd 2 0 0\n",
    );
    folder.edit(
        "instance hill",
        "asset crate = obj(\"crate.obj\", unit: m, up: +y)\n\
         instance box { shape = crate, at = (-3, 0, 0)m }\ninstance hill",
    );
    assert_eq!(folder.reuse("at first"), Reuse::Nothing);
    let log = folder.rtc("cache", "a.pack", &[]);
    assert!(log.contains("W0520") && log.contains("W0524") && log.contains("up to date"), "{log}");
    folder.edit("from = (0, 1, 6)m", "from = (0, 1, 7)m");
    assert_eq!(folder.reuse("a camera"), Reuse::All);
    folder.edit("at = (-3, 0, 0)m", "at = (-3, 0, 1)m");
    assert_eq!(folder.reuse("the crate moves"), Reuse::OfOthers);
    // Another material in the library.
    folder.write(
        "crate.mtl",
        "newmtl wood\nKd 0.4 0.3 0.1\nmap_Kd none.png\nnewmtl iron\nKd 2 0 0\n",
    );
    assert_eq!(folder.reuse("a colour of the model"), Reuse::All);
    // What was not there appears.
    let image = image::RgbImage::from_pixel(2, 2, image::Rgb([1, 2, 3]));
    image.save(folder.path().join("none.png")).expect("writable");
    assert_eq!(folder.reuse("an image appears"), Reuse::Geometry);
    folder.write("other.mtl", "newmtl iron\nKd 0.1 0.1 0.1\n");
    assert_eq!(folder.reuse("a library appears"), Reuse::All);
    std::fs::remove_file(folder.path().join("none.png")).expect("it is there");
    assert_eq!(folder.reuse("an image is gone"), Reuse::Geometry);
}

#[test]
fn texels_are_those_of_the_image_that_was_there_before() {
    let folder = Folder::new();
    assert_eq!(folder.reuse("at first"), Reuse::Nothing);
    folder.image([9, 90, 60]);
    assert_eq!(folder.reuse("another image"), Reuse::Geometry);
    folder.image([200, 90, 60]);
    assert_eq!(folder.reuse("the first image"), Reuse::Geometry);
}

#[test]
fn colours_of_vertices_are_taken_over_with_their_triangles() {
    let folder = Folder::new();
    let stain = |blue: f64| {
        folder.hill(0.0);
        let text = String::from_utf8(folder.read("hill.obj")).expect("a text");
        let line = |line: &str| match line.split(' ').collect::<Vec<_>>()[..] {
            ["v", x, _, z] => {
                let [x, z] = [x, z].map(|x| 0.5 + 0.5 * x.parse::<f64>().expect("a number"));
                format!("{line} {x} {z} {blue}\n")
            }
            _ => format!("{line}\n"),
        };
        folder.write("hill.obj", &text.lines().map(line).collect::<String>());
    };
    stain(0.5);
    assert_eq!(folder.reuse("at first"), Reuse::Nothing);
    for (from, to, expected) in [
        // Every triangle gets colours, of meshes that are stored once, too.
        ("color = tile }", "color = tile.rgb * vertex_color.rgb }", Reuse::Nothing),
        ("from = (0, 1, 6)m", "from = (0, 1, 7)m", Reuse::All),
        ("turn: number = 20", "turn: number = 21", Reuse::OfOthers),
        ("at = (0, 3.5, -2)m", "at = (0.5, 3, -1)m", Reuse::OfOthers),
        ("* vertex_color.rgb }", "* vertex_color.g }", Reuse::Geometry),
        ("* vertex_color.g }", "* linear(0.5) }", Reuse::Nothing),
        ("* linear(0.5) }", "* vertex_color.rgb }", Reuse::Nothing),
    ] {
        folder.edit(from, to);
        assert_eq!(folder.reuse(to), expected, "{to}");
    }
    stain(0.25);
    assert_eq!(folder.reuse("other colours"), Reuse::Nothing);
    folder.hill(0.0);
    assert_eq!(folder.reuse("no colours"), Reuse::Nothing);
    let log = folder.rtc("none", "b.pack", &["--no-cache"]);
    assert!(log.contains("has no vertex colours: `vertex_color` is white there"), "{log}");
}

#[test]
fn what_geometry_depends_on_is_made_anew() {
    let folder = Folder::new();
    assert!(!folder.takes_over("at first"));
    for (from, to) in [
        ("radius: 20cm", "radius: 21cm"),
        ("material = oak", "material = brass"),
        ("material = brass, at = (0, 2, 0)m", "material = oak, at = (0, 2, 0)m"),
        ("strength = 3", "strength = 0"),
        ("color = tile", "color = linear(0.5, 0.5, 0.5)"),
    ] {
        folder.edit(from, to);
        assert!(!folder.takes_over(to), "{to}");
    }
    folder.hill(0.25);
    assert!(!folder.takes_over("a vertex"));
    folder.edit("color = linear(0.5, 0.5, 0.5)", "color = tile");
    folder.takes_over("a texture");
    folder.image([9, 90, 60]);
    assert!(!folder.takes_over("an image"));
    folder.edit("fuzz = 0.2", "fuzz = 0.1");
    assert!(folder.takes_over("an edit after all of them"));
}

#[test]
fn a_pack_or_a_memory_that_is_damaged_or_gone_is_made_anew() {
    let folder = Folder::new();
    assert!(!folder.takes_over("at first"));
    let mut bytes = folder.read("a.pack");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(folder.path().join("a.pack"), bytes).expect("writable");
    folder.edit("fuzz = 0.2", "fuzz = 0.1");
    assert!(!folder.takes_over("a flipped bit"));
    std::fs::remove_file(folder.path().join("a.pack")).expect("it is there");
    folder.edit("fuzz = 0.1", "fuzz = 0.3");
    assert!(!folder.takes_over("no pack"));
    for folders in std::fs::read_dir(folder.path().join("cache/done")).expect("records") {
        for record in std::fs::read_dir(folders.expect("a folder").path()).expect("a folder") {
            let path = record.expect("a record").path();
            let mut bytes = std::fs::read(&path).expect("it is there");
            if bytes.first() != Some(&b'{') {
                let middle = bytes.len() / 2;
                bytes[middle] ^= 1;
                std::fs::write(&path, bytes).expect("writable");
            }
        }
    }
    folder.edit("fuzz = 0.3", "fuzz = 0.2");
    assert!(!folder.takes_over("a damaged memory"));
    folder.edit("fuzz = 0.2", "fuzz = 0.4");
    assert!(folder.takes_over("all is well again"));
}
