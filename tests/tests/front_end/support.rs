//! Runs the front end on source text.

use branched_pendulum_codegen::description::{self, Description};
use branched_pendulum_codegen::report::Report;
use branched_pendulum_codegen::scene::{self, Scene};
use proc_macro2::{TokenStream, TokenTree};

/// All that the front end makes of an item with its attribute.
pub(crate) struct Outcome {
    pub(crate) description: Option<Description>,
    pub(crate) scene: Option<Scene>,
    pub(crate) report: Report,
}

/// Runs the front end on the tokens of an attribute and of the item under it.
pub(crate) fn run(attribute: TokenStream, item: TokenStream) -> Outcome {
    let mut report = Report::new();
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
pub(crate) fn split(source: &str) -> (TokenStream, TokenStream) {
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
pub(crate) fn run_source(source: &str) -> Outcome {
    let (attribute, item) = split(source);
    run(attribute, item)
}

/// The scene of a source without mistakes.
pub(crate) fn scene(source: &str) -> Scene {
    let Outcome { scene, report, .. } = run_source(source);
    let errors = report.render(source);
    scene.unwrap_or_else(|| panic!("the source has mistakes:\n{errors}"))
}

/// The errors of a source with mistakes, as text.
pub(crate) fn errors(source: &str) -> String {
    let Outcome { scene, report, .. } = run_source(source);
    assert!(scene.is_none(), "the source has no mistake:\n{source}");
    report.render(source)
}

/// A pseudo-random generator (splitmix64), so that every run is the same.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `limit`, which is not 0.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    /// One of `choices`, which are not empty.
    pub(crate) fn pick<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[self.below(choices.len())]
    }
}
