// An orthonormal frame around a unit vector.
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1): orthogonal to 2.2e-7
// everywhere, the direction -z included.

#import "math/vector.wgsl"

// Columns of a right-handed frame; `n` is its z axis. World frame.
struct Basis {
    t: vec3f,
    b: vec3f,
    n: vec3f,
}

// The frame around `n`, unit length.
fn basis_around(n: vec3f) -> Basis {
    let s = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (s + n.z);
    let c = n.x * n.y * a;
    let t = vec3f(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    return Basis(t, vec3f(c, s + n.y * n.y * a, -n.y), n);
}

// The frame around `n` whose x axis is `t` less its part along `n`; any frame around `n` where nothing
// of `t` is left, as where no tangent is known.
fn basis_along(n: vec3f, t: vec3f) -> Basis {
    let x = t - n * dot(n, t);
    if (dot(x, x) < 1e-6) {
        return basis_around(n);
    }
    let unit = vector_unit(x);
    return Basis(unit, vector_cross(n, unit), n);
}

// World frame from local frame.
fn basis_world_from_local(basis: Basis, v: vec3f) -> vec3f {
    return basis.t * v.x + basis.b * v.y + basis.n * v.z;
}

// Local frame from world frame.
fn basis_local_from_world(basis: Basis, v: vec3f) -> vec3f {
    return vec3f(dot(v, basis.t), dot(v, basis.b), dot(v, basis.n));
}
