//! Scenes of shapes: many in one place, tiny, moved, scaled, open, inside each other.

use std::fmt::Write as _;
use std::path::Path;

use compiler::bvh::{Layout, Preset};
use compiler::lower::Lowered;
use runtime::Film;

use super::tools::{
    WHITE_SKY, count, diagnose, distance, equal, estimates, films, films_of, first_error, lit,
    means, same, shot, sized, view,
};
use super::{Case, Row};
use crate::scene;

/// The cases of this file.
pub const CASES: &[Case] = &[
    Case {
        id: "X03",
        input: "1e5 copies of one triangle in one place",
        must: "the image of one, bit for bit; the stack is at most 48 + 17 deep",
        measure: copies,
    },
    Case {
        id: "X04",
        input: "1e5 triangles with one centroid",
        must: "depth at most 48 + 17, exact (the time, below 1 s, is measured with --heavy)",
        measure: centroids,
    },
    Case {
        id: "X05",
        input: "faces of two colours in one plane",
        must: "each pixel one of the two, the same at any number of samples, exact",
        measure: coplanar,
    },
    Case {
        id: "X06",
        input: "scene moved to 1e6",
        must: "the image at 0, bit for bit where numbers hold the shift",
        measure: moved,
    },
    Case {
        id: "X07",
        input: "scene times 2^-20, 2^20, 1e-6, 1e6",
        must: "the same image: bit for bit for powers of two, 4 se otherwise",
        measure: scaled,
    },
    Case {
        id: "X08",
        input: "things of 1e-5 in a scene of radius 1",
        must: "seen, and tight: 4 se",
        measure: tiny,
    },
    Case {
        id: "X09",
        input: "gap of 1e-4 or 1e-5 of the size between two planes",
        must: "dark, as in f64",
        measure: contact,
    },
    Case {
        id: "X14",
        input: "camera inside a sphere, in glass, in water, on a surface",
        must: "the right medium from the start: analytic, 4 se",
        measure: cameras,
    },
    Case {
        id: "X16",
        input: "open mesh as the boundary of a medium",
        must: "no crash; leaks are counted",
        measure: open_mesh,
    },
    Case {
        id: "X17",
        input: "100 glass shells inside each other",
        must: "the value, 4 se, or a reported overflow",
        measure: shells,
    },
    Case {
        id: "X19",
        input: "tree of 1 triangle, of none (1e7: with --heavy)",
        must: "right, exact",
        measure: small_trees,
    },
    Case {
        id: "X20",
        input: "rectangle without width; rectangle light seen edge-on",
        must: "refused or never hit; light 0; exact",
        measure: thin_rectangles,
    },
];

/// Deepest stack that the trees may need.
const STACK: u32 = 48 + 17;

/// Compiles a scene of `thing.obj` under a white sky.
fn mesh(obj: &str, parts: &str, eye: &str) -> compiler::pipeline::Compiled {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("thing.obj"), obj).expect("writable");
    let text = format!("rts 1\nasset thing = obj(\"thing.obj\", unit: m, up: +y)\n{parts}{eye}");
    scene::compile_in(dir.path(), &text)
}

const CLAY: &str = "sky heaven: constant { color = linear(1) }
material m: diffuse { color = linear(0.5) }
instance it { shape = thing, material = m }
";

fn depth(lowered: &Lowered) -> Row {
    let need = lowered.render.stack_need;
    Row::fact("depth of the stack", &format!("≤ {STACK}"), &need.to_string(), need <= STACK)
}

fn copies() -> Vec<Row> {
    let films = |n: usize| {
        let obj = format!("v -1 -1 0\nv 1 -1 0\nv 0 1 0\n{}", "f 1 2 3\n".repeat(n));
        let compiled = mesh(&obj, CLAY, &shot([0.0, 0.0, 5.0], [0.0; 3], 30.0, 4));
        let films = films_of(&scene::bytes(&compiled), sized(24, 4));
        (compiled, films)
    };
    let ((_, one), (compiled, many)) = (films(1), films(100_000));
    let equal = [0, 1].map(|i| same(&one[i], &many[i]));
    vec![
        Row::fact(
            "image of 1e5 is that of one",
            "bit for bit",
            &format!("{equal:?}"),
            equal == [true; 2],
        ),
        depth(&compiled.lowered),
    ]
}

/// Triangles around 0, whose corners add up to 0.
pub(super) fn one_centroid(n: usize) -> String {
    let mut stream = crate::statistics::stream::Stream::new(131, 0);
    let mut obj = String::new();
    for i in 0..n {
        let (a, b) = (stream.direction(), stream.direction() * stream.unit());
        for p in [a, b, -(a + b)] {
            let _ = writeln!(obj, "v {:.5} {:.5} {:.5}", p.x, p.y, p.z);
        }
        let _ = writeln!(obj, "f {} {} {}", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    obj
}

fn centroids() -> Vec<Row> {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("thing.obj"), one_centroid(100_000)).expect("writable");
    let eye = shot([0.0, 0.0, 5.0], [0.0; 3], 30.0, 4);
    let text = format!("rts 1\nasset thing = obj(\"thing.obj\", unit: m, up: +y)\n{CLAY}{eye}");
    let binary = scene::compile_built(dir.path(), &text, Preset::default(), Layout::Binary);
    let wide = scene::compile_in(dir.path(), &text).lowered.render.stack_need;
    let room = runtime::kernel::f32::STACK_SIZE;
    let n = binary.lowered.triangles.len();
    let fits = Row::fact(
        "stack of the wide tree, up to three entries a level",
        &format!("≤ {room}, the kernel's"),
        &wide.to_string(),
        wide <= room,
    );
    vec![
        depth(&binary.lowered),
        fits,
        Row::fact("triangles", "≥ 100000", &n.to_string(), n >= 100_000),
    ]
}

fn coplanar() -> Vec<Row> {
    let text = |second: &str| {
        format!(
            "material red: emissive {{ color = linear(1, 0, 0) }}
material green: emissive {{ color = linear(0, 1, 0) }}
instance a {{ shape = rectangle(size: (20, 20)m), material = red }}
instance b {{ shape = rectangle(size: {second}), material = green }}
{}",
            shot([0.3, 5.0, 0.4], [0.0; 3], 40.0, 1)
        )
    };
    let mixed = |films: &[Film; 2]| {
        count(films, |rgb| !equal(rgb, [1.0, 0.0, 0.0]) && !equal(rgb, [0.0, 1.0, 0.0]))
    };
    let mut rows = Vec::new();
    for (name, second) in [("the same corners", "(20, 20)m"), ("other corners", "(23.7, 21.3)m")] {
        let [few, many] = [4, 64].map(|samples| films(&text(second), 24, samples));
        let mut row =
            Row::never(format!("{name}: pixels that mix the two, 64 samples"), 576, mixed(&many));
        let changed = [0, 1].map(|i| {
            let pairs = few[i].means().into_iter().zip(many[i].means());
            pairs.filter(|(a, b)| !equal(*a, *b)).count() as u64
        });
        let mut stable =
            Row::never(format!("{name}: pixels that 4 samples show otherwise"), 576, changed);
        if second != "(20, 20)m" {
            row = row.known(WHY_MIXED);
            stable = stable.known(WHY_MIXED);
        }
        rows.extend([row, stable]);
    }
    rows
}

const WHY_MIXED: &str = "distances to two triangles with other corners round differently, and the nearer wins; \
    only equal distances are decided by the lower number";

/// Some things at `shift`, with lengths times `by`.
fn things(shift: f64, by: f64) -> String {
    let p = |x: f64, y: f64, z: f64| {
        format!("({:e}, {:e}, {:e})m", x * by + shift, y * by + shift, z * by + shift)
    };
    format!(
        "material grey: diffuse {{ color = linear(0.6) }}
material glass: dielectric {{ ior = 1.5 }}
material lamp: emissive {{ color = linear(1), strength = 8 }}
instance floor {{ shape = rectangle(size: ({t:e}, {t:e})m), material = grey, at = {} }}
instance ball {{ shape = sphere(radius: {u:e}m), material = glass, at = {} }}
instance crate {{ shape = box(size: ({u:e}, {u:e}, {u:e})m), material = grey, at = {} }}
instance panel {{ shape = rectangle(size: ({u:e}, {u:e})m), material = lamp, at = {} }}
camera eye: perspective {{ from = {}, to = {}, fov.vertical = 40deg }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 6, seed = 3 }}
",
        p(0.0, 0.0, 0.0),
        p(0.5, 1.0, 0.5),
        p(-1.5, 0.5, 0.0),
        p(0.0, 4.0, 0.0),
        p(0.5, 2.0, 6.0),
        p(0.0, 0.5, 0.0),
        t = 8.0 * by,
        u = by,
    )
}

fn moved() -> Vec<Row> {
    let [base, far] = [0.0, 1e6].map(|shift| films(&things(shift, 1.0), 24, 16));
    let differ = [0, 1].map(|i| differing(&base[i], &far[i]));
    vec![Row::never("pixels that differ", 576, differ)]
}

fn differing(a: &Film, b: &Film) -> u64 {
    a.sums.iter().zip(&b.sums).filter(|(a, b)| a.map(f64::to_bits) != b.map(f64::to_bits)).count()
        as u64
}

fn scaled() -> Vec<Row> {
    let base = films(&things(0.0, 1.0), 24, 64);
    let mut rows = Vec::new();
    for power in [-20, 20] {
        let other = films(&things(0.0, 2.0_f64.powi(power)), 24, 64);
        let differ = [0, 1].map(|i| differing(&base[i], &other[i]));
        rows.push(Row::never(format!("2^{power}: pixels that differ"), 576, differ));
    }
    for by in [1e-6, 1e6] {
        let other = films(&things(0.0, by), 24, 64);
        let (a, b) = (estimates(&base), estimates(&other));
        rows.push(Row::below(
            format!("{by:e}: distance in se"),
            4.0,
            [0, 1].map(|i| distance(a[i], b[i])),
        ));
    }
    rows
}

fn tiny() -> Vec<Row> {
    // The film is 4e-5 m high.
    let eye = shot([0.0, 0.0, 1.0], [0.0; 3], 2.0 * 2e-5_f64.atan().to_degrees(), 2);
    let scene = |thing: &str| {
        format!(
            "material lamp: emissive {{ color = linear(1) }}
material black: diffuse {{ color = linear(0) }}
instance back {{ shape = rectangle(size: (1, 1)m), material = black, rotate = (90, 0, 0)deg, at = (0, 0, -0.9)m }}
{thing}{eye}"
        )
    };
    let ball = scene("instance dot { shape = sphere(radius: 0.01mm), material = lamp }\n");
    let cube = scene("instance dot { shape = box(size: (0.02, 0.02, 0.02)mm), material = lamp }\n");
    let shut = scene(
        "instance dot { shape = sphere(radius: 0.004mm), material = lamp }
instance hull { shape = box(size: (0.02, 0.02, 0.02)mm), material = black }\n",
    );
    let share = |text: &str, truth: f64| {
        let films = films(text, 64, 64);
        estimates(&films).map(|e| crate::picture::Estimate {
            mean: e.mean,
            error: (truth * (1.0 - truth) / (64.0 * 64.0 * 64.0)).sqrt(),
        })
    };
    let (disc, square) = (std::f64::consts::PI / 16.0, 0.25);
    vec![
        Row::mean("coverage by a sphere", disc, 1e-4, share(&ball, disc)),
        Row::mean("coverage by a box", square, 1e-4, share(&cube, square)),
        Row::never(
            "pixels that see a light in a closed box",
            4096,
            count(&films(&shut, 64, 64), lit),
        ),
    ]
}

fn contact() -> Vec<Row> {
    let mut rows = Vec::new();
    for gap in [1e-4, 1e-5] {
        let gap_m = 2.0 * gap;
        let text = format!(
            "{WHITE_SKY}material grey: diffuse {{ color = linear(0.5) }}
instance floor {{ shape = rectangle(size: (2, 2)m), material = grey }}
instance lid {{ shape = rectangle(size: (2, 2)m), material = grey, at = (0, {gap_m:e}, 0)m }}
{}",
            view([0.0, 0.5 * gap_m, 0.0], [0.0; 3], 8)
                .replace("fov.vertical = 0.001deg", "fov.vertical = 60deg")
        );
        let shining = count(&films(&text, 32, 64), lit);
        rows.push(Row::never(format!("gap {gap:e}: pixels with light"), 1024, shining));
    }
    rows
}

fn cameras() -> Vec<Row> {
    let f = 0.04;
    let t = (-0.5_f64).exp();
    let ball = |ior: f64| {
        format!(
            "{WHITE_SKY}medium ink: homogeneous {{ sigma_a = 0.5/m }}
material m: dielectric {{ ior = {ior}, interior = ink }}
instance ball {{ shape = sphere(radius: 1m), material = m }}
{}",
            view([0.0; 3], [0.0, 0.0, -9.0], 1000)
        )
    };
    let water = format!(
        "{WHITE_SKY}material wet: water {{ waves = off, sigma_a = 0.25/m }}
instance pool {{ shape = box(size: (40, 8, 40)m), material = wet }}
{}",
        view([0.0, 2.0, 0.0], [0.0, 9.0, 0.0], 1000)
    );
    // From 2 m below the surface: up through it, or mirrored to the floor 8 m below, and so on.
    let (fw, n2) = ((0.333_f64 / 2.333).powi(2), 1.333_f64 * 1.333);
    let (first, round) = ((-0.5_f64).exp(), (-2.0_f64).exp());
    let pool = n2 * (1.0 - fw) * first / (1.0 - fw * round);
    let on = |to: [f64; 3]| {
        format!(
            "{WHITE_SKY}material m: diffuse {{ color = linear(0.5) }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = m }}
{}",
            view([0.0; 3], to, 8)
        )
    };
    vec![
        Row::mean("in an absorbing ball of index 1", t, 3e-6, means(&ball(1.0), 16, 64)),
        Row::mean(
            "in an absorbing ball of index 1.5",
            2.25 * (1.0 - f) * t / (1.0 - f * t * t),
            3e-6,
            means(&ball(1.5), 16, 1024),
        ),
        Row::mean("in water, looking up", pool, 3e-6, means(&water, 16, 1024)),
        Row::mean("on a surface, looking up", 1.0, 0.0, means(&on([0.1, 5.0, 0.0]), 16, 16)),
        Row::mean(
            "on a surface, looking down through it",
            1.0,
            0.0,
            means(&on([0.1, -5.0, 0.0]), 16, 16),
        ),
    ]
}

fn open_mesh() -> Vec<Row> {
    let obj = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let scene = |glass: &str| {
        format!(
            "asset thing = obj(\"thing.obj\", unit: m, up: +y)
{WHITE_SKY}medium ink: homogeneous {{ sigma_a = 0.5/m }}
material m: dielectric {{ ior = 1.5, {glass} }}
material n: dielectric {{ ior = 1.3, interior = ink, priority = 1 }}
instance it {{ shape = thing, material = m }}
instance ball {{ shape = sphere(radius: 1.2m), material = n }}\n{}",
            shot([1.0, 1.5, 5.0], [0.0; 3], 40.0, 16)
        )
    };
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("thing.obj"), obj).expect("writable");
    let (compiled, said) = diagnose(dir.path(), &scene("interior = ink"));
    let told = first_error(&said);
    let told = told.rsplit("error").next().unwrap_or("").to_owned();
    let refused = compiled.is_none() && told.contains("is open");
    let mut rows = vec![Row::fact("with an interior", "an error that says so", &told, refused)];
    let (compiled, said) = diagnose(dir.path(), &scene("priority = 2"));
    let Some(compiled) = compiled else {
        rows.push(Row::fact("with a priority", "a pack", &said, false));
        return rows;
    };
    let films = films_of(&scene::bytes(&compiled), sized(24, 16));
    let leaks = [0, 1].map(|i| films[i].counters.leaks);
    let bad = [0, 1].map(|i| films[i].counters.bad);
    let counted = leaks.iter().all(|n| *n > 0);
    rows.push(Row::fact(
        "leaks counted",
        "> 0",
        &format!("{} and {}", leaks[0], leaks[1]),
        counted,
    ));
    rows.push(Row::never("samples that are not finite", 9216, bad));
    rows
}

fn shells() -> Vec<Row> {
    let mut text = String::from(WHITE_SKY);
    for i in 0..100 {
        let size = 4.0 - 0.02 * f64::from(i);
        let _ = writeln!(
            text,
            "material g_{i}: dielectric {{ ior = {}, priority = {} }}\ninstance s_{i} {{ shape = box(size: ({size}, {size}, {size})m), material = g_{i} }}",
            if i % 2 == 0 { 1.5 } else { 1.2 },
            i + 1
        );
    }
    text += &shot([0.0, 0.0, 9.0], [0.0; 3], 20.0, 1000);
    let (compiled, said) = diagnose(Path::new(""), &text);
    let Some(compiled) = compiled else {
        let refused = said.lines().next().unwrap_or("").to_owned();
        let holds = refused.contains("error[");
        return vec![Row::fact("100 shells", "a value, an overflow, or an error", &refused, holds)];
    };
    let films = films_of(&scene::bytes(&compiled), sized(16, 16));
    let over = [0, 1].map(|i| films[i].counters.overflows);
    let lossless = estimates(&films);
    vec![
        Row::fact(
            "overflows counted",
            "> 0",
            &format!("{} and {}", over[0], over[1]),
            over[0] > 0 && over[1] > 0,
        ),
        Row::mean("radiance under a white sky all the same", 1.0, 1e-5, lossless),
    ]
}

fn small_trees() -> Vec<Row> {
    let one = mesh(
        "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n",
        CLAY,
        &view([0.0, 0.0, 5.0], [0.0, 0.0, 0.0], 2),
    );
    let one = estimates(&films_of(&scene::bytes(&one), sized(8, 256)));
    let sky = format!("{WHITE_SKY}{}", view([0.0, 0.0, 5.0], [0.0; 3], 2));
    vec![
        // A white sky on one side of a triangle of albedo 1/2.
        Row::mean("one triangle", 0.5, 1e-6, one),
        Row::mean("no triangle: the sky", 1.0, 0.0, means(&sky, 8, 16)),
    ]
}

fn thin_rectangles() -> Vec<Row> {
    let lamp = "material lamp: emissive { color = linear(1) }\nmaterial white: diffuse { color = linear(1) }\n";
    let flat = format!(
        "{lamp}instance r {{ shape = rectangle(size: (0, 2)m), material = lamp }}\n{}",
        view([0.0, 1.0, 5.0], [0.0; 3], 2)
    );
    let (compiled, said) = diagnose(Path::new(""), &flat);
    let line = first_error(&said);
    let refused = compiled.is_none() && line.contains("error[");
    let edge = format!(
        "{lamp}instance r {{ shape = rectangle(size: (2, 2)m), material = lamp }}
instance dark {{ shape = rectangle(size: (1, 1)m), material = white, at = (0, -1, 0)m }}\n{}",
        shot([0.0, 0.0, 5.0], [0.0; 3], 40.0, 2)
    );
    // The camera is in the plane of the lamp; the upper half of the picture is empty, too.
    let eye = edge.replace("up = (0.1, 0.2, 1)", "up = (0, 1, 0)");
    let bright = count(&films(&eye, 32, 64), |c| c.iter().any(|x| *x >= 0.99));
    let coplanar = format!(
        "{lamp}instance r {{ shape = rectangle(size: (2, 2)m), material = lamp, at = (4, 0, 0)m }}
instance floor {{ shape = rectangle(size: (2, 2)m), material = white }}\n{}",
        view([0.0, 2.0, 0.5], [0.0; 3], 2)
    );
    let shining = count(&films(&coplanar, 16, 64), lit);
    vec![
        Row::fact("rectangle of width 0", "error", &line, refused),
        Row::never("pixels that see the lamp edge-on", 1024, bright),
        Row::never("lit pixels of a floor in the plane of the lamp", 256, shining),
    ]
}
