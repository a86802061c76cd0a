//! Trees by rule: which of them get loops, and how much code these are.

use branched_pendulum_codegen::scene::Layout;
use branched_pendulum_codegen::stages;
use proc_macro2::{TokenStream, TokenTree};

use branched_pendulum_compiler_tests::front_end::scene;

/// Names and groups in the code of a binary tree of rods in loops: all tokens but
/// literals and signs, of which some constants have two.
fn tokens_of_loops(generations: usize) -> usize {
    fn count(tokens: TokenStream) -> usize {
        let size = |token| match token {
            TokenTree::Group(group) => 1 + count(group.stream()),
            TokenTree::Ident(_) => 1,
            TokenTree::Punct(_) | TokenTree::Literal(_) => 0,
        };
        tokens.into_iter().map(size).sum()
    }
    let attribute = format!(
        "gravity = 9.8, tree: generations(count = {generations}, branching = 2, shape = rod, \
         mass = 0.12, length = 0.3, mass_ratio = 0.5, length_ratio = 0.7), emit(energies)"
    );
    let item = "struct Tree;".parse().unwrap();
    let stages = stages(attribute.parse().unwrap(), item).ok().unwrap();
    let links = (1 << generations) - 1;
    let branching = 2;
    assert_eq!(
        stages.scene.layout,
        Layout::Generations { branching, links }
    );
    count(stages.tokens().clone())
}

#[test]
fn code_in_loops_grows_by_one_row_of_constants_a_generation() {
    let counts = [10, 20, 30].map(tokens_of_loops);
    assert_eq!(counts[1] - counts[0], counts[2] - counts[1]);
    let row = (counts[1] - counts[0]) / 10;
    assert!(row < 50, "{row} names a generation");
}

#[test]
fn large_rules_get_loops_unless_something_stands_against_it() {
    let links = |rule: &str| {
        let source = format!(
            "#[branched_pendulum(gravity = 9.8, a: generations(branching = 2, shape = rod, \
             mass = 1, length = 1, {rule})] struct Tree;"
        );
        match scene(&source).layout {
            Layout::Generations { links, .. } => Some(links),
            _ => None,
        }
    };
    assert_eq!(links("count = 5)"), None);
    assert_eq!(links("count = 6)"), Some(63));
    assert_eq!(links("count = 6, code = unrolled)"), None);
    assert_eq!(links("count = 7)"), Some(127));
    assert_eq!(links("count = 2, code = loops)"), Some(3));
    assert_eq!(links("count = 7, code = unrolled)"), None);
    assert_eq!(links("count = 7), emit(modes)"), None);
    assert_eq!(links("count = 7), emit(energies)"), Some(127));
    assert_eq!(links("count = 7, com = (0.5, 0.1))"), Some(127));
    assert_eq!(links("count = 7), drive(y = sin(t))"), Some(127));
    assert_eq!(links("count = 20)"), Some((1 << 20) - 1));
}
