//! Emitted functions stay short enough to be read and compiled.

use branched_pendulum_codegen::layout;
use branched_pendulum_compiler_tests::source::stages_of;
use syn::spanned::Spanned;
use syn::visit::Visit;

/// Names and lines of all functions of a source text.
#[derive(Default)]
struct Functions(Vec<(usize, String)>);

impl<'ast> Visit<'ast> for Functions {
    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        let lines = function.block.span();
        let lines = lines.end().line - function.sig.span().start().line + 1;
        self.0.push((lines, function.sig.ident.to_string()));
    }
}

/// The longest function that a scene of five generations of rods with friction
/// emits.
fn longest(requests: &str) -> (usize, String) {
    let source = format!(
        "/// Rods.
        #[branched_pendulum(
            gravity = 9.80665,
            arm: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
                mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
            emit({requests}),
        )]
        pub struct Tree;"
    );
    let stages = stages_of(&source);
    assert_eq!(stages.scene.links.len(), 31);
    // Lines count as they are formatted.
    let formatted = layout(stages.tokens().clone()).expect("the code is Rust");
    let mut functions = Functions::default();
    functions.visit_file(&syn::parse_str(&formatted).expect("it is Rust still"));
    functions.0.into_iter().max().expect("it has functions")
}

#[test]
fn no_budget_of_31_links_has_a_function_of_a_thousand_lines() {
    let (lines, name) = longest("budget(canonical, parseval, velocity, rest, matrix)");
    assert!(lines < 1000, "{name} has {lines} lines");
}

/// The mass matrix alone has 961 elements, each on a line of its own.
#[test]
fn no_motion_of_31_links_has_a_function_of_fifteen_hundred_lines() {
    let (lines, name) = longest("energies, momenta, modes, symmetric");
    assert!(lines < 1500, "{name} has {lines} lines");
}
