//! What of a description is enough to break the same thing.

use proc_macro2::{Group, TokenStream, TokenTree};

/// Leaves tokens out as long as `breaks` says of the rest that it breaks: neighbours, or
/// brackets around what stays, with neighbours in front of them. No single such step from
/// the result does.
pub(crate) fn smaller(
    tokens: TokenStream,
    breaks: &mut dyn FnMut(TokenStream) -> bool,
) -> TokenStream {
    let mut trees: Vec<TokenTree> = tokens.into_iter().collect();
    while let Some(rest) = one_step(&trees, breaks) {
        trees = rest;
    }
    trees.into_iter().collect()
}

/// The first step to less that breaks; those that leave out most come first.
fn one_step(
    trees: &[TokenTree],
    breaks: &mut dyn FnMut(TokenStream) -> bool,
) -> Option<Vec<TokenTree>> {
    let mut tried = |from: usize, to: usize, between: TokenStream| {
        let mut rest = trees[..from].to_vec();
        rest.extend(between);
        rest.extend_from_slice(&trees[to..]);
        breaks(rest.iter().cloned().collect()).then_some(rest)
    };
    for length in (1..=trees.len()).rev() {
        for from in 0..=trees.len() - length {
            let rest = tried(from, from + length, TokenStream::new());
            if rest.is_some() {
                return rest;
            }
        }
    }
    for (at, tree) in trees.iter().enumerate() {
        let TokenTree::Group(group) = tree else {
            continue;
        };
        for from in 0..=at {
            let rest = tried(from, at + 1, group.stream());
            if rest.is_some() {
                return rest;
            }
        }
        let inside: Vec<TokenTree> = group.stream().into_iter().collect();
        let mut rest = None;
        let _ = one_step(&inside, &mut |less| {
            let group = Group::new(group.delimiter(), less);
            rest = tried(at, at + 1, TokenTree::from(group).into());
            rest.is_some()
        });
        if rest.is_some() {
            return rest;
        }
    }
    None
}

#[test]
fn what_breaks_is_all_that_is_left() {
    let tokens = "a = 1, b(c = d * (e + f), g = 2) [h, i: k(l = 3) * 2], m".parse();
    let tokens: TokenStream = tokens.expect("tokens");
    let has = |text: &str, name: char| text.contains(name);
    let rest = smaller(tokens.clone(), &mut |rest| {
        let text = rest.to_string();
        has(&text, 'f') && has(&text, 'l')
    });
    assert_eq!(rest.to_string(), "f l");
    let whole = smaller(tokens.clone(), &mut |_| false);
    assert_eq!(whole.to_string(), tokens.to_string());
}
