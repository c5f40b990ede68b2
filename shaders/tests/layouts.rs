//! The WGSL structs have the layout of the Rust records, and a difference is shown.

use naga::{Module, TypeInner, VectorSize};
use shaders::{abi_module, check_layouts, record_texts};
use std::collections::BTreeSet;

#[test]
fn every_record_of_the_kernel_has_its_struct() {
    let module = abi_module().expect("the structs parse");
    check_layouts(&module).expect("the structs are the records");
    let structs: BTreeSet<&str> =
        module.types.iter().filter_map(|(_, ty)| ty.name.as_deref()).collect();
    let records = pack::abi::records().into_iter().map(|record| record.name);
    assert_eq!(structs, records.chain(["MaterialHead"]).collect());
}

/// Names and types of a struct's members.
fn members(module: &Module, name: &str) -> Vec<(Option<String>, TypeInner)> {
    let ty = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let TypeInner::Struct { members, .. } = &ty.expect("is there").1.inner else {
        panic!("{name} is no struct")
    };
    members.iter().map(|m| (m.name.clone(), module.types[m.ty].inner.clone())).collect()
}

#[test]
fn the_head_of_a_record_is_its_beginning() {
    let module = abi_module().expect("the structs parse");
    let (head, whole) = (members(&module, "MaterialHead"), members(&module, "Material"));
    assert!(whole.len() > head.len() && whole.starts_with(&head), "{head:?} {whole:?}");
}

/// The record's struct with one text replaced, compared.
fn check_changed(from: &str, to: &str) -> String {
    let texts = record_texts();
    let (_, text) = texts.iter().find(|row| row.0 == "abi/node.wgsl").expect("exists");
    assert!(text.contains(from));
    let module = naga::front::wgsl::parse_str(&text.replace(from, to)).expect("parses");
    check_layouts(&module).expect_err("the struct differs").to_string()
}

#[test]
fn a_wrong_field_is_caught_and_both_tables_are_printed() {
    let renamed = check_changed("right: u32", "rigth: u32");
    let expected = "layout of `Node` differs
  Rust                       WGSL
     0 left_lo: vec3<f32>       0 left_lo: vec3<f32>
    12 left: u32               12 left: u32
    16 left_hi: vec3<f32>      16 left_hi: vec3<f32>
!   28 right: u32              28 rigth: u32
    32 right_lo: vec3<f32>     32 right_lo: vec3<f32>
    44 _pad0: u32              44 _pad0: u32
    48 right_hi: vec3<f32>     48 right_hi: vec3<f32>
    60 _pad1: u32              60 _pad1: u32
    64 end                     64 end
";
    assert_eq!(renamed, expected);
    assert!(
        check_changed("right: u32", "right: f32")
            .contains("!   28 right: u32              28 right: f32")
    );
    let shorter = check_changed("    right: u32,\n", "");
    assert!(shorter.contains("32 right_lo: vec3<f32>"), "{shorter}");
    let longer = check_changed("    _pad1: u32,\n", "    _pad1: u32,\n    more: vec4<f32>,\n");
    assert!(
        longer.contains(
            "!   64 end                     64 more: vec4<f32>\n!                              80 end"
        ),
        "{longer}"
    );
}

#[test]
fn every_vec3_of_a_record_has_its_fourth_lane_filled() {
    let holes = vec3_holes(&abi_module().expect("the structs parse"));
    assert_eq!(holes, BTreeSet::new());
    // The same question to a struct with a hole, so that the test can fail.
    let module = naga::front::wgsl::parse_str("struct S { a: vec3<f32>, b: vec3<f32>, c: u32 }")
        .expect("parses");
    assert_eq!(vec3_holes(&module), BTreeSet::from(["S.a".to_owned()]));
}

fn vec3_holes(module: &Module) -> BTreeSet<String> {
    let mut holes = BTreeSet::new();
    for (_, ty) in module.types.iter() {
        let TypeInner::Struct { members, .. } = &ty.inner else { continue };
        for (i, member) in members.iter().enumerate() {
            let inner = &module.types[member.ty].inner;
            let is_vec3 = matches!(inner, TypeInner::Vector { size: VectorSize::Tri, .. });
            let filled = members.get(i + 1).is_some_and(|next| next.offset == member.offset + 12);
            if is_vec3 && !filled {
                let (ty, member) = (ty.name.as_deref(), member.name.as_deref());
                holes.insert(format!("{}.{}", ty.unwrap_or("?"), member.unwrap_or("?")));
            }
        }
    }
    holes
}
