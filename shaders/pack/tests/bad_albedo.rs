//! Tables of directional albedo: there when a material reads one, as many, and numbers of their size.

mod common;

use common::{Draft, Scene, put32};
use pack::abi::{AlbedoTable, albedo_tables, albedo_words};
use pack::{Kind, Pack};

fn error(change: impl Fn(&mut Draft)) -> String {
    let mut draft = Draft::new(&Scene::full().and_albedo().bytes());
    change(&mut draft);
    Pack::from_bytes(draft.seal()).expect_err("this pack must be refused").to_string()
}

#[test]
fn tables_are_those_that_materials_read() {
    let scene = Scene::full().and_albedo();
    let pack = Pack::from_bytes(scene.bytes()).expect("it is sound");
    let found = pack.section_bytes(Kind::ALBEDO).map_or(0, <[u8]>::len);
    assert_eq!(found, 16 * albedo_words(&scene.materials));
    let gloss = AlbedoTable::Gloss.words();
    assert_eq!(albedo_tables(&scene.materials), [Some(0), None, None, Some(gloss), None, None]);
    assert_eq!(albedo_tables(&Scene::full().materials), [None; 6]);
}

#[test]
fn a_section_that_does_not_fit_is_refused() {
    let needs = 4 * (AlbedoTable::Gloss.words() + AlbedoTable::Leaf.words());
    assert_eq!(
        error(|draft| draft.remove(Kind::ALBEDO)),
        format!("the number of ALBEDO values is 0, but what the materials read is {needs}")
    );
    assert_eq!(
        error(|draft| draft.section(Kind::ALBEDO).truncate(16)),
        format!("the number of ALBEDO values is 4, but what the materials read is {needs}")
    );
    let of = |value: f32| error(|draft| put32(draft.section(Kind::ALBEDO), 0x14, value.to_bits()));
    assert_eq!(of(f32::NAN), "ALBEDO[1] at byte 0x14: value is NaN, expected -2 to 2");
    assert_eq!(of(2.5), "ALBEDO[1] at byte 0x14: value is 2.5, expected -2 to 2");
    let unwanted = {
        let mut scene = Scene::full().and_albedo();
        scene.materials.clone_from(&Scene::full().materials);
        scene.writer().to_bytes()
    };
    let unwanted = unwanted.expect_err("no material reads it").to_string();
    assert_eq!(unwanted, "section ALBEDO must be absent, no material reads a table");
}
