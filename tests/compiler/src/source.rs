//! Attributes read from fixture files and from text.

use branched_pendulum_codegen::{Stages, stages};
use proc_macro2::TokenStream;
use quote::ToTokens;
use std::path::PathBuf;

/// A file of the tests' `fixtures` folder.
pub fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../fixtures")
        .join(name)
}

/// The attribute's tokens and the item of the first attributed struct in a
/// source text.
///
/// # Panics
/// If there is none.
pub fn attributed_struct(source: &str) -> (TokenStream, TokenStream) {
    let file = syn::parse_file(source).expect("a fixture is Rust");
    for item in file.items {
        let syn::Item::Struct(mut item) = item else {
            continue;
        };
        let position = item
            .attrs
            .iter()
            .position(|attribute| attribute.path().is_ident("branched_pendulum"));
        if let Some(position) = position
            && let syn::Meta::List(list) = item.attrs.remove(position).meta
        {
            return (list.tokens, item.into_token_stream());
        }
    }
    panic!("no struct with the attribute");
}

/// All stages of a fixture scene.
///
/// # Panics
/// If the fixture has errors.
pub fn scene(name: &str) -> Stages {
    let path = fixture(&format!("scenes/{name}.rs"));
    let source = std::fs::read_to_string(&path).expect("the fixture exists");
    stages_of(&source)
}

/// All stages of the first attributed struct in a source text.
///
/// # Panics
/// If it has errors.
pub fn stages_of(source: &str) -> Stages {
    let (attribute, item) = attributed_struct(source);
    match stages(attribute, item) {
        Ok(stages) => stages,
        Err((report, _)) => panic!("{}", report.render(source)),
    }
}
