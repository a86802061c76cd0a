//! The attribute `#[branched_pendulum(...)]`. Use it through the crate
//! `branched-pendulum`, which says what it accepts; all of it is in
//! `branched-pendulum-codegen`.

use branched_pendulum_codegen::{ExpansionCache, expand};
use proc_macro::TokenStream;

// Documented where users meet it, at its re-export.
#[allow(missing_docs)]
#[proc_macro_attribute]
pub fn branched_pendulum(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let (attribute, item) = (attribute.into(), item.into());
    let tokens = match ExpansionCache::of_this_build() {
        Some(cache) => cache.expand(attribute, item),
        None => expand(attribute, item),
    };
    tokens.into()
}
