//! A polygon in space becomes triangles, also where it is concave.

/// Triangles of a polygon as indices of its corners, in the winding of the polygon.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Cut {
    pub(super) triangles: Vec<[u32; 3]>,
    /// No sensible cut was found (crossing sides, no area): it is a fan from corner 0.
    pub(super) crooked: bool,
}

/// Point-in-triangle tests allowed for each corner; keeps the time for any polygon linear.
const TESTS_PER_CORNER: usize = 2048;

/// Cuts a polygon with at least three corners.
///
/// The corners are projected along the polygon's area vector (Newell). A quad is cut along the
/// diagonal that lies inside, the shorter one when both do; larger polygons that are convex become a
/// fan, others are cut ear by ear (Meisters 1975, "Polygons have ears").
pub(super) fn triangulate(corners: &[[f32; 3]]) -> Cut {
    let n = u32::try_from(corners.len()).unwrap_or(0);
    let Some(flat) = project(corners) else {
        return Cut { triangles: fan(n), crooked: n > 3 };
    };
    match n {
        3 => Cut { triangles: fan(3), crooked: false },
        4 => quad(corners, &flat),
        _ if is_convex(&flat) => Cut { triangles: fan(n), crooked: false },
        _ => ears(&flat),
    }
}

fn fan(n: u32) -> Vec<[u32; 3]> {
    (2..n).map(|corner| [0, corner - 1, corner]).collect()
}

/// Corners in the plane in which the polygon is counter-clockwise; `None` without an area.
fn project(corners: &[[f32; 3]]) -> Option<Vec<[f64; 2]>> {
    let origin = corners.first()?.map(f64::from);
    let local = |p: &[f32; 3]| {
        [f64::from(p[0]) - origin[0], f64::from(p[1]) - origin[1], f64::from(p[2]) - origin[2]]
    };
    let mut area = [0.0; 3];
    for (i, p) in corners.iter().enumerate() {
        let (p, q) = (local(p), local(&corners[(i + 1) % corners.len()]));
        area[0] += p[1] * q[2] - p[2] * q[1];
        area[1] += p[2] * q[0] - p[0] * q[2];
        area[2] += p[0] * q[1] - p[1] * q[0];
    }
    let sizes = area.map(f64::abs);
    // Drop the axis along which the area vector is longest; keep the winding counter-clockwise.
    let axis = if sizes[0] >= sizes[1] && sizes[0] >= sizes[2] {
        0
    } else if sizes[1] >= sizes[2] {
        1
    } else {
        2
    };
    if !(sizes[axis] > 0.0 && sizes[axis].is_finite()) {
        return None;
    }
    let (u, v) = if area[axis] > 0.0 {
        ((axis + 1) % 3, (axis + 2) % 3)
    } else {
        ((axis + 2) % 3, (axis + 1) % 3)
    };
    Some(corners.iter().map(|p| [local(p)[u], local(p)[v]]).collect())
}

/// Twice the signed area of `abc`; positive when it turns left at `b`.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn quad(corners: &[[f32; 3]], flat: &[[f64; 2]]) -> Cut {
    let [a, b, c, d] = [flat[0], flat[1], flat[2], flat[3]];
    // A diagonal lies inside when both triangles it makes keep the winding.
    let inside_ac = turn(a, b, c) >= 0.0 && turn(a, c, d) >= 0.0;
    let inside_bd = turn(b, c, d) >= 0.0 && turn(b, d, a) >= 0.0;
    let along_ac = vec![[0, 1, 2], [0, 2, 3]];
    let along_bd = vec![[1, 2, 3], [1, 3, 0]];
    match (inside_ac, inside_bd) {
        (true, false) => Cut { triangles: along_ac, crooked: false },
        (false, true) => Cut { triangles: along_bd, crooked: false },
        (true, true) => {
            let shorter_bd = distance2(corners[1], corners[3]) < distance2(corners[0], corners[2]);
            let triangles = if shorter_bd { along_bd } else { along_ac };
            Cut { triangles, crooked: false }
        }
        (false, false) => Cut { triangles: along_ac, crooked: true },
    }
}

fn distance2(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|i| (f64::from(a[i]) - f64::from(b[i])).powi(2)).sum()
}

/// Convex and wound once: never a turn to the right, nowhere back the way it came, and the
/// directions go round once. Corners that coincide with the one before do not count.
fn is_convex(flat: &[[f64; 2]]) -> bool {
    let mut corners = flat.to_vec();
    corners.dedup();
    while corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    let n = corners.len();
    let at = |i: usize| corners[i % n];
    let side = |i: usize| [at(i + 1)[0] - at(i)[0], at(i + 1)[1] - at(i)[1]];
    let onward = (0..n).all(|i| {
        let (here, next) = (side(i), side(i + 1));
        let area2 = turn(at(i), at(i + 1), at(i + 2));
        area2 > 0.0 || (area2 >= 0.0 && here[0] * next[0] + here[1] * next[1] > 0.0)
    });
    // A curve that only turns left but winds twice changes its direction in x more than twice.
    let signs = (0..n).map(|i| side(i)[0]).filter(|dx| *dx != 0.0).map(|dx| dx > 0.0);
    let signs: Vec<bool> = signs.collect();
    let changes = (0..signs.len()).filter(|&i| signs[i] != signs[(i + 1) % signs.len()]).count();
    onward && changes <= 2
}

fn ears(flat: &[[f64; 2]]) -> Cut {
    let mut ring: Vec<u32> = (0..).take(flat.len()).collect();
    let mut triangles = Vec::with_capacity(flat.len());
    let mut budget = TESTS_PER_CORNER * flat.len();
    let mut at = 0; // where to look next: the corner after the last ear
    let mut misses = 0; // corners in a row that are no ears
    while ring.len() > 3 {
        let n = ring.len();
        let here = [ring[(at + n - 1) % n], ring[at % n], ring[(at + 1) % n]];
        // Flat corners are cut off only when nothing else is left, so that they stay corners of
        // triangles where they can, as they are for the neighbours of this polygon.
        let flat_too = misses >= n;
        if is_ear(flat, &ring, here, flat_too, &mut budget) {
            triangles.push(here);
            ring.remove(at % n);
            at %= n - 1;
            misses = 0;
        } else {
            at = (at + 1) % n;
            misses += 1;
        }
        if misses > 2 * n || budget == 0 {
            triangles = fan(u32::try_from(flat.len()).unwrap_or(0));
            return Cut { triangles, crooked: true };
        }
    }
    triangles.push([ring[0], ring[1], ring[2]]);
    Cut { triangles, crooked: false }
}

fn same(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).abs() <= 0.0 && (a[1] - b[1]).abs() <= 0.0
}

/// Whether cutting off `here` leaves a simple polygon. Uses up `budget`, one for each test.
fn is_ear(
    flat: &[[f64; 2]],
    ring: &[u32],
    here: [u32; 3],
    flat_too: bool,
    budget: &mut usize,
) -> bool {
    let [a, b, c] = here.map(|corner| flat[corner as usize]);
    *budget = budget.saturating_sub(ring.len());
    let area2 = turn(a, b, c);
    if area2 <= 0.0 {
        return flat_too && area2 >= 0.0;
    }
    ring.iter().filter(|corner| !here.contains(corner)).all(|&corner| {
        let p = flat[corner as usize];
        let within = turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        !within || [a, b, c].iter().any(|corner| same(*corner, p)) // bridges to holes pass through a corner twice
    })
}
