//! Control flow.

use crate::kernels::control::{Bindings, Kernel};

fn kernel() -> Kernel<'static> {
    Kernel::new(Bindings { unused: core::marker::PhantomData })
}

#[test]
fn break_in_a_switch_leaves_the_switch_only() {
    // 0: 1 + 100, 1: left early + 100, 2 and 3: 10 + 100 each, 4: 1 + 100.
    assert_eq!(kernel().break_in_switch(5), 522);
}

#[test]
fn switch_default_may_stand_anywhere() {
    let mut k = kernel();
    assert_eq!([3, -7, 0, 7].map(|x| k.switch_default_first(x)), [2, 1, 0, 0]);
    assert_eq!([4, 5, 6].map(|x| k.switch_default_shared(x)), [1, 2, 2]);
}

#[test]
fn continue_in_a_switch_continues_the_loop() {
    assert_eq!(kernel().continue_in_switch(6), 1 + 2 + 4 + 5);
}

#[test]
fn continue_runs_the_continuing_block() {
    assert_eq!(kernel().continue_runs_continuing(6), 1 + 3 + 5);
}

#[test]
fn break_if_ends_the_loop_after_its_block() {
    // i: 0 -> 100, 1 -> 201, 2 -> 303, 3 -> 406; never equal to 3 in between.
    assert_eq!(kernel().break_if(4), 406);
    assert_eq!(kernel().break_if(-5), 100);
}

#[test]
fn nested_loops_break_and_continue_their_own() {
    // j <= i with i + j even: 1 + 1 + 2 + 2 rounds of 3.
    assert_eq!(kernel().nested_loops(4), 6 * 3 + 400);
}

#[test]
fn while_loops_count() {
    assert_eq!(kernel().while_loop(27), 111);
    assert_eq!(kernel().while_loop(1), 0);
}

#[test]
fn return_leaves_loops() {
    let mut k = kernel();
    assert_eq!([7, 9, 5].map(|x| k.early_return([9, 8, 7, 7], x)), [2, 0, -1]);
}

#[test]
fn locals_of_a_loop_body_start_at_zero_each_round() {
    assert_eq!(kernel().zeroed_in_loop(5), 11);
}

#[test]
fn short_circuits_skip_the_right_side() {
    let mut k = kernel();
    assert_eq!(k.and_evaluates_left_first(1, 9), 1);
    assert_eq!(k.and_evaluates_left_first(5, 2), 52);
    assert_eq!(k.and_evaluates_left_first(5, 6), 1056);
    assert_eq!(k.or_evaluates_left_first(5, 2), 1005);
    assert_eq!(k.or_evaluates_left_first(1, 2), 12);
    assert_eq!(k.or_evaluates_left_first(1, 8), 1018);
}

#[test]
fn loads_keep_their_place_among_stores_and_calls() {
    assert_eq!(kernel().load_before_store(), 151);
    assert_eq!(kernel().call_between_loads(), 3000 + 39 + 500);
}

#[test]
fn branches_are_taken_in_order() {
    let mut k = kernel();
    assert_eq!([-1.0, 0.5, 1.5, 2.0].map(|x| k.else_if_chain(x)), [0, 1, 2, 3]);
    assert_eq!([k.only_else(true), k.only_else(false)], [1, 2]);
    assert_eq!(k.shadowed(4), 13 + 5);
}

/// What the probe `deep` says, written as Rust says it.
fn deep(n: u32) -> u32 {
    let (mut sum, mut seen) = (0, [0_u32; 4]);
    for i in 0..n {
        sum += match (i % 4, i) {
            (0, 0..=4) => 1,
            (0, _) => 10100,
            (1, _) => 10110,
            (2, _) => 0,
            (_, 7) => 10000,
            _ => 11000,
        };
        seen[i as usize % 4] += (i + 1).min(2);
    }
    sum + 1_000_000 * seen.iter().sum::<u32>()
}

#[test]
fn deep_nesting_goes_where_it_says() {
    let mut k = kernel();
    for n in 0..14 {
        assert_eq!(k.deep(n), deep(n), "{n}");
    }
    assert_eq!(
        [k.loops_and_returns(1), k.loops_and_returns(8), k.loops_and_returns(300)],
        [0, 1004, 1300]
    );
}
