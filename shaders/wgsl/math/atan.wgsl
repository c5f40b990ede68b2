// The angle of a plane vector, as a fraction of a turn. The built-in `atan2` promises 4096 ULP.

// atan2(y, x) / (2 pi), in [-0.5, 0.5]; 0 for the zero vector. Largest error 2.7e-8 turns:
// interpolation of atan(r) / r at Chebyshev nodes of r^2 in 0 ..= 1, degree 7.
fn atan_turns(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let longer = max(ax, ay);
    if (longer == 0.0) {
        return 0.0;
    }
    let r = min(ax, ay) / longer;
    let z = r * r;
    let high = 0.015706787 + z * (-0.009363046 + z * (0.003784787 - z * 0.0007257134));
    var turns = r * (0.15915492 + z * (-0.05304923 + z * (0.031778406 + z * (-0.022286929 + z * high))));
    turns = select(turns, 0.25 - turns, ay > ax);
    turns = select(turns, 0.5 - turns, x < 0.0);
    return select(turns, -turns, y < 0.0);
}
