// Control flow: what leaves what, and in which order.

var<private> trace: u32;

fn note(digit: u32) -> bool {
    trace = trace * 10u + digit;
    return digit > 4u;
}

// `break` inside the switch leaves the switch only: the loop goes on.
fn break_in_switch(n: u32) -> u32 {
    var sum = 0u;
    for (var i = 0u; i < n; i++) {
        switch i {
            case 1u: {
                if i == 1u { break; }
                sum += 1000u;
            }
            case 2u, 3u: { sum += 10u; }
            default: { sum += 1u; }
        }
        sum += 100u;
    }
    return sum;
}

fn switch_default_first(x: i32) -> i32 {
    switch x {
        default: { return 0; }
        case -7: { return 1; }
        case 3: { return 2; }
    }
}

fn switch_default_shared(x: u32) -> u32 {
    var r = 7u;
    switch x {
        case 4u: { r = 1u; }
        case 5u, default: { r = 2u; }
    }
    return r;
}

// `continue` inside a switch belongs to the loop, and runs the update of `for`.
fn continue_in_switch(n: u32) -> u32 {
    var sum = 0u;
    for (var i = 0u; i < n; i++) {
        switch i % 3u {
            case 0u: { continue; }
            default: {}
        }
        sum += i;
    }
    return sum;
}

fn continue_runs_continuing(n: u32) -> u32 {
    var i = 0u;
    var odd = 0u;
    loop {
        if i >= n { break; }
        let next = i + 1u;
        if i % 2u == 0u { continue; }
        odd += i;
        continuing { i = next; }
    }
    return odd;
}

fn break_if(n: i32) -> i32 {
    var i = 0;
    var sum = 0;
    loop {
        sum += i;
        if sum == 3 { continue; }
        sum += 100;
        continuing {
            i += 1;
            break if i >= n;
        }
    }
    return sum;
}

fn nested_loops(n: u32) -> u32 {
    var count = 0u;
    for (var i = 0u; i < n; i++) {
        for (var j = 0u; j < n; j++) {
            if j > i { break; }
            if (i + j) % 2u == 1u { continue; }
            var k = 0u;
            while true {
                k++;
                if k == 3u { break; }
            }
            count += k;
        }
        count += 100u;
    }
    return count;
}

fn while_loop(start: u32) -> u32 {
    var x = start;
    var steps = 0u;
    while x != 1u && steps < 200u {
        x = select(3u * x + 1u, x / 2u, x % 2u == 0u);
        steps++;
    }
    return steps;
}

fn early_return(values: array<u32, 4>, wanted: u32) -> i32 {
    for (var i = 0; i < 4; i++) {
        if values[i] == wanted { return i; }
    }
    return -1;
}

// A local declared in a loop body starts at zero in every round.
fn zeroed_in_loop(n: u32) -> u32 {
    var last = 0u;
    for (var i = 0u; i < n; i++) {
        var fresh: u32;
        var list: array<u32, 3>;
        fresh += 1u;
        list[i % 3u] += fresh;
        last = fresh * 10u + list[0] + list[1] + list[2];
    }
    return last;
}

fn and_evaluates_left_first(a: u32, b: u32) -> u32 {
    trace = 0u;
    if note(a) && note(b) { return trace + 1000u; }
    return trace;
}

fn or_evaluates_left_first(a: u32, b: u32) -> u32 {
    trace = 0u;
    if note(a) || note(b) { return trace + 1000u; }
    return trace;
}

// The load stands before the store, and must be done before it.
fn load_before_store() -> u32 {
    var x = 1u;
    let before = x;
    x = 5u;
    let after = x;
    x = before;
    return before * 100u + after * 10u + x;
}

fn call_between_loads() -> u32 {
    trace = 3u;
    let before = trace;
    let high = note(9u);
    let after = trace;
    return before * 1000u + after + select(0u, 500u, high);
}

fn else_if_chain(x: f32) -> u32 {
    if x < 0.0 { return 0u; } else if x < 1.0 { return 1u; } else if x < 2.0 { return 2u; }
    return 3u;
}

fn only_else(x: bool) -> u32 {
    var r = 1u;
    if x { } else { r = 2u; }
    return r;
}

fn shadowed(x: u32) -> u32 {
    var y = x;
    {
        var y = 7u;
        y += 1u;
        { let y = 3u; _ = y; }
    }
    let z = y + 1u;
    { let z = 9u; y += z; }
    return y + z;
}

// Switches in switches, `continue` from the innermost, a loop in the continuing block.
fn deep(n: u32) -> u32 {
    var sum = 0u;
    var i = 0u;
    var seen = array<u32, 4>(0u, 0u, 0u, 0u);
    loop {
        if i >= n { break; }
        let slot = &seen[i % 4u];
        let step = i + 1u;
        switch i % 4u {
            case 0u, 1u: {
                switch i % 2u {
                    case 0u: { if i > 4u { break; } sum += 1u; continue; }
                    default: { sum += 10u; break; }
                }
                sum += 100u;
            }
            case 2u: { continue; }
            default: { if i == 7u { break; } sum += 1000u; }
        }
        sum += 10000u;
        continuing {
            for (var k = 0u; k < step; k++) {
                if k == 2u { break; }
                *slot += 1u;
            }
            i = step;
        }
    }
    return sum + 1000000u * (seen[0] + seen[1] + seen[2] + seen[3]);
}

fn loops_and_returns(n: u32) -> u32 {
    // Two loops that leave through each other's values.
    var a = n;
    var b = 0u;
    for (; a > 0u; a /= 2u) {
        var c = a;
        loop {
            if c < 3u { break; }
            c -= 3u;
            b += 1u;
            if b > 50u { return 1000u + a; }
        }
        if c == 1u { continue; }
        b += 100u * c;
    }
    return b;
}
