//! Surfaces of which a share is there: what is behind them, their shadows, lights that are there in part.

use super::{Check, WHITE_FLOOR, all, view};

const WHITE_SKY: &str = "rts 1\nsky day: constant { color = linear(1) }\n";

/// A black material of this coverage, with this emission.
fn black(name: &str, alpha: &str, emission: f64) -> String {
    format!(
        "material {name}: principled {{ color = linear(0), specular = 0, alpha = {alpha}, emission.color = linear(1), emission.strength = {emission} }}\n"
    )
}

/// A square at a height, of the material with its number.
fn card(i: usize, side: f64, height: f64) -> String {
    format!(
        "instance card{i} {{ shape = rectangle(size: ({side}, {side})m), material = m{i}, at = (0, {height}, 0)m }}\n"
    )
}

/// Cards, one behind the other, a camera before them.
fn cards(name: &str, expected: f64, cards: &[(f64, f64)]) -> Check {
    let mut text = WHITE_SKY.to_owned();
    for (i, (alpha, emission)) in cards.iter().enumerate() {
        text += &black(&format!("m{i}"), &alpha.to_string(), *emission);
        text += &card(i, 2.0, -0.5 * i as f64);
    }
    text += &view([0.1, 3.0, 0.2], [0.0, 0.0, 0.0], 2);
    Check::new(name, expected, text)
}

#[test]
fn cards_let_the_rest_of_what_is_behind_them_through() {
    all(&[
        cards("a card of alpha 0.3 before a white sky", 0.7, &[(0.3, 0.0)]),
        cards("a glowing card of alpha 0.3", 0.7 + 0.3 * 2.0, &[(0.3, 2.0)]),
        cards("two cards multiply", 0.7 * 0.4, &[(0.3, 0.0), (0.6, 0.0)]).samples(1024),
        cards("two cards of the same alpha", 0.25, &[(0.5, 0.0), (0.5, 0.0)]).samples(1024),
        cards("five cards", 0.8_f64.powi(5), &[(0.2, 0.0); 5]).samples(4096),
        cards(
            "glowing cards in their order",
            0.5 * 3.0 + 0.5 * (0.25 * 8.0 + 0.75),
            &[(0.5, 3.0), (0.25, 8.0)],
        )
        .samples(4096),
        // A sphere is met where the ray comes in, and where it goes out.
        Check::new(
            "a ball of alpha 0.3",
            0.7 * 0.7,
            format!(
                "{WHITE_SKY}{}instance ball {{ shape = sphere(radius: 1m), material = m }}\n{}",
                black("m", "0.3", 0.0),
                view([0.1, 3.0, 0.2], [0.0; 3], 2)
            ),
        )
        .samples(1024),
        // Independent numbers instead of Sobol's.
        {
            let card = cards("a card of alpha 0.3, independent samples", 0.7, &[(0.3, 0.0)]);
            let text = card.text.replace("seed = 11", "seed = 11, sampler = pcg");
            Check { text, ..card }.samples(1024)
        },
    ]);
}

/// A sphere light over a white floor, and cards between, far enough off the way of the camera.
fn shadow(name: &str, alphas: &[&str], share: f64) -> Check {
    let (s, distance) = (0.1, 4.0);
    let mut text = format!(
        "{WHITE_FLOOR}light sun: sphere {{ center = (0, {distance}, 0)m, radius = {}m }}\n",
        s * distance
    );
    for (i, alpha) in alphas.iter().enumerate() {
        text += &black(&format!("m{i}"), alpha, 0.0);
        text += &card(i, 1.4, 2.0 + 0.5 * i as f64);
    }
    text += &view([-3.0, 0.5, 0.0], [0.0; 3], 2);
    Check::new(name, share * s * s, text).samples(4096)
}

#[test]
fn shadows_of_cards_are_as_dark_as_their_coverage() {
    all(&[
        shadow("the shadow of a card of alpha 0.3", &["0.3"], 0.7),
        shadow("the shadow of two cards", &["0.3", "0.6"], 0.7 * 0.4),
    ]);
}

#[test]
fn light_that_is_scattered_goes_through_too() {
    // A floor under a dome, in a white sky that is no light of the table: only scattered rays find it.
    let text = format!(
        "{WHITE_SKY}material white: diffuse {{ color = linear(1) }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = white }}
{}instance dome {{ shape = sphere(radius: 8m), material = m }}
{}",
        black("m", "0.3", 0.0),
        view([-3.0, 0.5, 0.0], [0.0; 3], 2)
    );
    all(&[Check::new("a floor under a dome of alpha 0.3", 0.7, text)]);
}

/// A lamp of radiance 1 that is there in part, over a white floor: `form`, its form factor times its share.
fn lamp(name: &str, lamp: &str, form: f64, estimator: u32) -> Check {
    let text = format!(
        "{WHITE_FLOOR}{}instance lamp {{ {lamp}, material = m }}\n{}",
        black("m", "0.25", 1.0),
        view([-3.0, 0.5, 0.0], [0.0; 3], 2)
    );
    Check { estimator, ..Check::new(format!("{name}, estimator {estimator}"), form, text) }
        .samples(4096)
}

#[test]
fn lights_that_are_there_in_part_give_their_share() {
    // A parallel square of side 2 a at height h over the point: four of Modest 2013, app. D, no. 10.
    let square = |a: f64, h: f64| {
        let x = a / a.hypot(h);
        4.0 / std::f64::consts::PI * x * x.atan()
    };
    let flat = "shape = rectangle(size: (2, 2)m), at = (0, 2, 0)m";
    // A ray meets the near side of a ball, or else the far one from within.
    let ball = "shape = sphere(radius: 1m), at = (0, 2.5, 0)m";
    let sides = 0.25 + 0.75 * 0.25;
    let mut checks = Vec::new();
    for estimator in [0, 1, 2, 3] {
        let check = lamp("a square of alpha 0.25", flat, 0.25 * square(1.0, 2.0), estimator);
        checks.push(if estimator == 2 { check.samples(16384) } else { check });
    }
    // No light of the table, so only scattered rays find it.
    checks.push(lamp("a ball of alpha 0.25", ball, sides / 6.25, 0).samples(16384));
    all(&checks);
}
