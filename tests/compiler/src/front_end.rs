//! Runs the front end on source text.

use branched_pendulum_codegen::description::{self, Description};
use branched_pendulum_codegen::report::Faults;
use branched_pendulum_codegen::scene::{self, Scene};
use proc_macro2::{TokenStream, TokenTree};

/// All that the front end makes of an item with its attribute.
pub struct Outcome {
    /// None where the text cannot be read.
    pub description: Option<Description>,
    /// None where the description has mistakes.
    pub scene: Option<Scene>,
    /// All mistakes.
    pub report: Faults,
}

/// Runs the front end on the tokens of an attribute and of the item under it.
pub fn run(attribute: TokenStream, item: TokenStream) -> Outcome {
    let mut report = Faults::new();
    let description = description::parse(attribute, item, &mut report);
    let scene = description
        .as_ref()
        .and_then(|description| scene::resolve(description, &mut report));
    Outcome {
        description,
        scene,
        report,
    }
}

/// Splits `#[branched_pendulum(attribute)] item`.
pub fn split(source: &str) -> (TokenStream, TokenStream) {
    let tokens: TokenStream = source.parse().expect("the test's source has tokens");
    let mut tokens = tokens.into_iter();
    let hash = tokens.next();
    assert!(matches!(hash, Some(TokenTree::Punct(hash)) if hash.as_char() == '#'));
    let Some(TokenTree::Group(brackets)) = tokens.next() else {
        panic!("the test's source starts with an attribute");
    };
    let Some(TokenTree::Group(arguments)) = brackets.stream().into_iter().nth(1) else {
        panic!("the test's attribute has arguments");
    };
    (arguments.stream(), tokens.collect())
}

/// Runs the front end on `#[branched_pendulum(attribute)] item`.
pub fn run_source(source: &str) -> Outcome {
    let (attribute, item) = split(source);
    run(attribute, item)
}

/// The scene of a source without mistakes.
pub fn scene(source: &str) -> Scene {
    let Outcome { scene, report, .. } = run_source(source);
    let errors = report.render(source);
    scene.unwrap_or_else(|| panic!("the source has mistakes:\n{errors}"))
}

/// The errors of a source with mistakes, as text.
pub fn errors(source: &str) -> String {
    let Outcome { scene, report, .. } = run_source(source);
    assert!(scene.is_none(), "the source has no mistake:\n{source}");
    report.render(source)
}
