//! The modules that come with the language.

mod common;

use common::check_text;

/// Names that the text of a module makes public.
fn public_names(text: &str) -> Vec<&str> {
    text.lines()
        .filter_map(|line| line.strip_prefix("pub material "))
        .filter_map(|rest| rest.split([':', ' ']).next())
        .collect()
}

#[test]
fn every_standard_material_can_be_imported_and_changed() {
    let text = lang::standard_module("materials").expect("it comes with the language");
    let names = public_names(text);
    assert!(names.len() >= 4, "{names:?}");
    for name in names {
        let scene = format!(
            "rts 1\nimport \"std:materials\" {{ {name} }}\nmaterial mine like {name} {{ }}
instance a {{ shape = sphere(radius: 1m), material = {name} }}
instance b {{ shape = sphere(radius: 1m), material = mine, at = (3, 0, 0)m }}
sky day: constant {{ }}
camera eye: perspective {{ from = (0, 0, 9)m, to = (0, 0, 0)m }}
film small {{ size = (8, 8)px }}
render main: path {{ camera = eye, film = small }}\n"
        );
        let analysis = check_text(&scene);
        assert!(analysis.scene.is_some(), "{name}: {}", common::describe(&analysis));
        assert!(analysis.diagnostics.is_empty(), "{name}: {}", common::describe(&analysis));
    }
}

#[test]
fn the_modules_are_written_as_the_formatter_writes_them() {
    let text = lang::standard_module("materials").expect("it comes with the language");
    assert_eq!(lang::format::format(text).expect("it is a scene text"), text);
}

#[test]
fn a_module_that_there_is_not_gets_an_answer() {
    let analysis = check_text("rts 1\nimport \"std:material\" { glass }\n");
    let text = common::describe(&analysis);
    assert!(text.contains("unknown module `std:material`"), "{text}");
    assert!(analysis.diagnostics[0].fixes[0].message.contains("std:materials"), "{text}");
    let analysis = check_text("rts 1\nimport \"std:lights\" { sun }\n");
    assert!(analysis.diagnostics[0].notes[0].contains("`std:materials`"));
}
