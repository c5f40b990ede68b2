// What is hard on invocations that run side by side: where they part, and what those must not feel that stand still.

struct Pair {
    a: f32,
    n: u32,
    v: vec3f,
    odd: bool,
}

struct Pairs {
    first: Pair,
    second: Pair,
}

@group(0) @binding(0) var<storage, read> given: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> found: array<vec4<u32>>;

// A return inside a loop inside a switch; others go on.
fn parting(kind: u32, n: u32) -> u32 {
    var sum = 1u;
    switch kind % 5u {
        case 0u: {
            for (var i = 0u; i < n; i++) {
                sum = sum * 3u + i;
                if (sum % 7u == 3u) {
                    return sum;
                }
            }
            sum += 1000u;
        }
        case 1u, 2u: {
            if (n % 3u == 1u) { break; }
            sum += 20u;
        }
        case 3u: { return 7u; }
        default: { sum += 30u; }
    }
    return sum + kind;
}

// Lanes end at different turns, skip some, and leave the inner loop alone.
fn turns(n: u32) -> u32 {
    var sum = 0u;
    var i = 0u;
    loop {
        if (i >= n) { break; }
        var inner = 0u;
        loop {
            inner += 1u;
            if (inner > i) { break; }
            if ((inner & 1u) == 0u) { continue; }
            sum += inner;
            continuing {
                sum += 1u;
                break if inner == 5u;
            }
        }
        i += 1u;
        if (i % 4u == 2u) { continue; }
        if (sum > 60u) { return sum + 500u; }
        sum += 2u;
    }
    return sum;
}

// What lanes compute that do not take a side must not be seen.
fn guarded(x: f32) -> f32 {
    var y = x;
    if (x > 0.0) {
        y = sqrt(x) / x;
    } else if (x < -1.0) {
        y = sqrt(-x) - 1.0 / x;
    }
    return y;
}

fn change(pair: ptr<function, Pair>, x: f32) -> bool {
    if (x < 0.0) {
        (*pair).n += 5u;
        return false;
    }
    (*pair).v.y = x;
    (*pair).a *= 2.0;
    return (*pair).odd;
}

// Through pointers into parts, in lanes that have parted.
fn pointed(x: f32, n: u32) -> vec4f {
    var pair = Pair(x, n, vec3f(x, 1.0, 2.0), (n & 1u) == 1u);
    var other = Pair(1.0, 2u, vec3f(3.0), false);
    var sum = 0.0;
    if (n % 3u == 0u) {
        if (change(&pair, x)) {
            sum = 10.0;
        }
    } else if (n % 3u == 1u) {
        other = pair;
        sum += select(1.0, 2.0, change(&other, -x));
        pair.v = other.v * 2.0;
    }
    return vec4f(pair.v, sum + pair.a + other.a + f32(pair.n + other.n));
}

// A struct within a struct that is a value; members of a variable that change places in lanes that have parted.
fn exchanged(p: Pairs, n: u32) -> vec4f {
    var q = p.second;
    if (n % 3u != 0u) {
        q = Pair(q.v.y, q.n + p.first.n, vec3f(q.a, p.first.v.x, q.v.z), !q.odd);
    }
    return vec4f(q.v, q.a + f32(q.n) + select(0.0, 0.5, q.odd));
}

// A variable of the loop's body begins anew in each turn, however lanes leave the turn before.
fn anew(n: u32) -> u32 {
    var sum = 0u;
    for (var i = 0u; i < 6u; i++) {
        var part: vec2u;
        part = vec2u(i, n);
        if ((n + i) % 3u == 0u) { continue; }
        part.x += 7u;
        if ((n ^ i) % 5u == 0u) { break; }
        part.y += i;
        sum = sum * 5u + part.x + part.y;
    }
    return sum;
}

// One that does not begin anew keeps what a lane had, which missed a turn.
fn kept(n: u32) -> u32 {
    var last = n;
    var sum = 0u;
    for (var i = 0u; i < 6u; i++) {
        if ((n + i) % 2u == 0u) { continue; }
        sum += last;
        last = i * 3u;
    }
    return sum * 8u + last;
}

// Under an index that differs, and is outside of what there is.
fn indexed(n: i32, x: f32) -> vec4f {
    var list = array<f32, 4>(x, 2.0, 3.0, 4.0);
    var v = vec3f(x, 5.0, 6.0);
    let i = n % 6;
    list[u32(i) % 4u] += 10.0;
    if (x > 0.5) {
        v[u32(n) % 3u] = -x;
    }
    return vec4f(list[i], v[u32(n) & 3u], list[0] + list[3], v.z);
}

fn integers(a: u32, b: i32) -> vec4u {
    let c = bitcast<i32>(a);
    let d = bitcast<u32>(b);
    return vec4u(
        (a / d) ^ (a % d) ^ reverseBits(a) ^ (a << (d & 31u)) ^ (a >> (d % 40u)),
        bitcast<u32>((c / b) ^ (c % b) ^ (c >> (d & 31u)) ^ -b ^ abs(c)),
        select(a, d, a < d) ^ select(1u, 2u, c < b) ^ min(a, d) ^ (max(a, d) * 3u) ^ ~a,
        bitcast<u32>(min(c, b) - max(c, 3)) ^ select(4u, 8u, a >= d) ^ select(16u, 32u, c >= b),
    );
}

fn floats(x: f32, y: f32) -> vec4f {
    return vec4f(
        min(x, y) + floor(x) * ceil(y) - trunc(x),
        max(x, y) - clamp(x, -1.0, y) + fract(y),
        f32(u32(x)) + f32(i32(y)) - abs(x) + round(y),
        dot(vec3f(x, y, 1.0), cross(vec3f(y, x, 2.0), vec3f(1.0, x, y))),
    );
}

fn conversions(a: u32, x: f32) -> vec4u {
    let bytes = unpack4xU8(a);
    let truth = vec3<bool>(a > 5u, x > 0.0, (a & 2u) == 2u);
    return vec4u(
        bitcast<u32>(f32(a)),
        bitcast<u32>(f32(bitcast<i32>(a))),
        u32(x) ^ bitcast<u32>(i32(x)),
        bytes.x + bytes.y * 3u + bytes.w * 5u + u32(all(truth)) + u32(any(truth)) + u32(truth.z),
    );
}

@compute @workgroup_size(8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    let word = given[i];
    let x = bitcast<f32>(word.z);
    let y = bitcast<f32>(word.w);
    if (word.x == 77u) {
        return;
    }
    let at = i * 10u;
    found[at] = vec4u(parting(word.x, word.y % 9u), turns(word.x % 9u), anew(word.x), kept(word.y));
    found[at + 1u] = vec4u(bitcast<u32>(guarded(x)), bitcast<u32>(guarded(y)), i, 0u);
    found[at + 2u] = bitcast<vec4u>(pointed(x, word.x));
    found[at + 3u] = bitcast<vec4u>(indexed(bitcast<i32>(word.y), x));
    found[at + 4u] = integers(word.x, bitcast<i32>(word.y));
    found[at + 5u] = bitcast<vec4u>(floats(x, y));
    found[at + 6u] = conversions(word.y, x);
    // The same element for all, and one that is not there.
    found[at + 7u] = given[2] + given[3].wzyx;
    found[at + 8u] = given[i ^ word.x] + given[word.x % 11u];
    let second = Pair(y, 3u, vec3f(x, 2.0, y), (word.x & 1u) == 1u);
    let pairs = Pairs(Pair(x, word.y, vec3f(y, x, 1.0), true), second);
    found[at + 9u] = bitcast<vec4u>(exchanged(pairs, word.x));
}
