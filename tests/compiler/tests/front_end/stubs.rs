//! The substitute of a model whose description is wrong has the functions that
//! the right one has.

use std::collections::BTreeMap;

use branched_pendulum_codegen::functions::is_method;
use branched_pendulum_codegen::{expand, stages};
use branched_pendulum_compiler_tests::source::{attributed_struct, fixture};
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

/// Number of arguments, and what a function returns: each public one of a type.
fn functions(tokens: TokenStream) -> BTreeMap<String, (usize, String)> {
    let file: syn::File = syn::parse2(tokens).expect("it is Rust");
    let blocks = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Impl(block) if block.trait_.is_none() => Some(block),
        _ => None,
    });
    let members = blocks.flat_map(|block| block.items);
    let functions = members.filter_map(|member| match member {
        syn::ImplItem::Fn(function) if matches!(function.vis, syn::Visibility::Public(_)) => {
            Some(function.sig)
        }
        _ => None,
    });
    functions
        .map(|sig| {
            let result = sig.output.to_token_stream().to_string();
            (sig.ident.to_string(), (sig.inputs.len(), result))
        })
        .collect()
}

/// The traits that a type has.
fn traits(tokens: TokenStream) -> Vec<String> {
    let file: syn::File = syn::parse2(tokens).expect("it is Rust");
    let named = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Impl(block) => block.trait_,
        _ => None,
    });
    let last = |path: syn::Path| {
        path.segments
            .last()
            .map(|segment| segment.ident.to_string())
    };
    named.filter_map(|(_, path, _)| last(path)).collect()
}

/// Names of the methods in implementations of traits.
fn trait_methods(tokens: TokenStream) -> Vec<String> {
    let file: syn::File = syn::parse2(tokens).expect("it is Rust");
    let blocks = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Impl(block) if block.trait_.is_some() => Some(block.items),
        _ => None,
    });
    let functions = blocks.flatten().filter_map(|member| match member {
        syn::ImplItem::Fn(function) => Some(function.sig.ident.to_string()),
        _ => None,
    });
    functions.collect()
}

#[test]
fn they_have_the_functions_and_traits_of_models() {
    let mut budgets = 0;
    for scene in [
        "paper",
        "branch",
        "triplet",
        "driven",
        "observed",
        "nested",
        "generations",
        "series",
        "unequal",
        "blades",
    ] {
        let source = std::fs::read_to_string(fixture(&format!("scenes/{scene}.rs")))
            .expect("the fixture exists");
        let (attribute, item) = attributed_struct(&source);
        let Ok(right) = stages(attribute.clone(), item.clone()) else {
            panic!("{scene} has no mistakes");
        };
        // Gravity twice.
        let wrong = expand(quote!(gravity = 1, #attribute), item);
        assert!(wrong.to_string().contains("compile_error"));
        let stub = functions(wrong.clone());
        // Functions that only a right model has: its constants.
        let constants = right.mechanics.constants.iter();
        let constants = constants.map(|c| right.mechanics.symbols.get(c.symbol).code.clone());
        let constants: Vec<String> = constants.collect();
        for (name, (arguments, result)) in functions(right.tokens().clone()) {
            if constants.contains(&name) || name == "new" || name == "from_parameters_unchecked" {
                continue;
            }
            let found = stub.get(&name);
            let (stub_arguments, stub_result) =
                found.unwrap_or_else(|| panic!("the stub of {scene} has no {name}"));
            assert_eq!(*stub_arguments, arguments, "arguments of {name}");
            if name.contains("budget") || name.contains("sector") {
                budgets += 1;
                assert_eq!(*stub_result, result, "{name} of {scene}");
            }
        }
        for method in trait_methods(wrong.clone()) {
            assert!(is_method(&method), "no observable may be called {method}");
        }
        let stub = traits(wrong);
        for name in traits(right.tokens().clone()) {
            let derived = ["Clone", "Debug", "PartialEq", "Copy", "Default"];
            let known = stub.contains(&name) || derived.contains(&name.as_str());
            assert!(known, "the stub of {scene} is no {name}");
        }
    }
    assert!(budgets > 10);
}
