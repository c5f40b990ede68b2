//! A sky that is a light: record, light table and SKYTABLE, each broken in turn.

#![expect(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod common;

use common::{Draft, Scene, put32};
use pack::abi::{LightKind, NONE, SkyKind};
use pack::{Kind, Pack};

/// Section, byte, value of the wrong word, and the error.
type Case = (Kind, usize, u32, &'static str);

fn error(change: impl FnOnce(&mut Draft)) -> String {
    let mut draft = Draft::new(&Scene::with_sky_light().bytes());
    change(&mut draft);
    Pack::from_bytes(draft.seal()).unwrap_err().to_string()
}

fn check(cases: &[Case]) {
    for (kind, at, value, expected) in cases {
        let found = error(|draft| put32(draft.section(*kind), *at, *value));
        assert_eq!(&found, expected, "{kind} {at:#x}");
    }
}

#[test]
fn a_sky_can_be_a_light() {
    let scene = Scene::with_sky_light();
    let pack = Pack::from_bytes(scene.bytes()).unwrap();
    assert_eq!(pack.sky(), scene.sky.as_ref());
    let of_sky = SkyKind::Image.feature() | LightKind::Sky.feature();
    assert_eq!(pack.features() & of_sky, of_sky);
    let table = pack.section_bytes(Kind::SKYTABLE).unwrap();
    assert_eq!(table, bytemuck::cast_slice::<[f32; 4], u8>(&scene.sky_table));
    // A faint sky may be left out of the light table; then it has no table.
    let mut plain = scene;
    plain.sky.as_mut().unwrap().light = NONE;
    plain.lights.pop();
    plain.lights[2].cdf = 1.0;
    plain.render.n_lights = 3;
    plain.sky_table.clear();
    assert!(Pack::from_bytes(plain.bytes()).is_ok());
}

#[test]
fn the_record_names_its_light_and_image() {
    check(&[
        (Kind::SKY, 0x70, 4, "SKY[0] at byte 0x70: texture is 4, but TEXTURE has 4 elements"),
        (
            Kind::SKY,
            0x70,
            3,
            "SKY[0] at byte 0x70: texture is 3, which is a texture expression, expected an image",
        ),
        (
            Kind::SKY,
            0x70,
            NONE,
            "SKY[0] at byte 0x70: texture is 4294967295, but TEXTURE has 4 elements",
        ),
        (Kind::SKY, 0x74, 4, "SKY[0] at byte 0x74: light is 4, but LIGHT has 4 elements"),
        (Kind::SKY, 0x74, 1, "LIGHT[3] at byte 0xcc: kind is sky, but the light of SKY is 1"),
        (Kind::SKY, 0x74, NONE, "LIGHT[3] at byte 0xcc: kind is sky, but the light of SKY is none"),
        (
            Kind::LIGHT,
            0xcc,
            0,
            "LIGHT[3] at byte 0xd0: edge1 is 0, expected a finite number greater than 0",
        ),
        (
            Kind::SKY,
            0x6c,
            f32::NAN.to_bits(),
            "SKY[0] at byte 0x6c: rotation is NaN, expected a finite number",
        ),
        (
            Kind::SKY,
            0x5c,
            f32::NAN.to_bits(),
            "SKY[0] at byte 0x5c: blend_ground is NaN, expected a finite number",
        ),
    ]);
    let sphere = |draft: &mut Draft| {
        let lights = draft.section(Kind::LIGHT);
        put32(lights, 0xcc, 0);
        put32(lights, 0xd0, 1.0f32.to_bits());
    };
    assert_eq!(error(sphere), "SKY[0] at byte 0x74: light is 3, which is not a light of kind sky");
}

#[test]
fn the_table_has_the_promised_size() {
    check(&[
        (
            Kind::SKY,
            0x78,
            3,
            "the number of SKYTABLE values is 12, but what SKY.rows and SKY.columns need is 16",
        ),
        (
            Kind::SKY,
            0x7c,
            0,
            "the number of SKYTABLE values is 12, but what SKY.rows and SKY.columns need is 8",
        ),
        (
            Kind::SKY,
            0x7c,
            u32::MAX,
            "the number of SKYTABLE values is 12, but what SKY.rows and SKY.columns need is 8589934596",
        ),
    ]);
    let absent = error(|draft| draft.remove(Kind::SKYTABLE));
    assert_eq!(
        absent,
        "the number of SKYTABLE values is 0, but what SKY.rows and SKY.columns need is 12"
    );
    let mut lonely = Scene::full();
    lonely.sky_table = vec![[1.0; 4]];
    let error = lonely.writer().to_bytes().unwrap_err().to_string();
    assert_eq!(error, "section SKYTABLE must be absent, the sky is no light");
}

#[test]
fn sums_rise_to_one_and_edges_fall_from_one() {
    let of = |value: f32| value.to_bits();
    let cases = [
        (0x0, of(-0.5), "SKYTABLE[0] at byte 0x0: value is -0.5, less than the 0 before it"),
        (0x4, of(0.125), "SKYTABLE[0] at byte 0x4: value is 0.125, less than the 0.25 before it"),
        (0x4, of(0.5), "SKYTABLE[0] at byte 0x4: value is 0.5, the last must be exactly 1"),
        (0x4, of(2.0), "SKYTABLE[0] at byte 0x4: value is 2, the last must be exactly 1"),
        (0x0, of(f32::NAN), "SKYTABLE[0] at byte 0x0: value is NaN, less than the 0 before it"),
        (0x8, of(0.5), "SKYTABLE[0] at byte 0x8: value is 0.5, expected exactly 1"),
        (0x10, of(-0.5), "SKYTABLE[1] at byte 0x10: value is -0.5, expected exactly -1"),
        (0xc, of(1.0), "SKYTABLE[0] at byte 0xc: value is 1, not less than the 1 before it"),
        (0xc, of(f32::NAN), "SKYTABLE[0] at byte 0xc: value is NaN, not less than the 1 before it"),
        (0xc, of(-1.0), "SKYTABLE[1] at byte 0x10: value is -1, not less than the -1 before it"),
        (0x24, of(0.1), "SKYTABLE[2] at byte 0x24: value is 0.1, less than the 0.25 before it"),
        (0x1c, of(0.9), "SKYTABLE[1] at byte 0x1c: value is 0.9, the last must be exactly 1"),
        (
            0x2c,
            of(1.0),
            "SKYTABLE[2] at byte 0x2c: value is 0x3f800000, unused fields must be zero",
        ),
    ];
    check(&cases.map(|(at, value, text)| (Kind::SKYTABLE, at, value, text)));
}
