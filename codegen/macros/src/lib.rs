//! The attribute `#[branched_pendulum(...)]`. Use it through the crate `branched-pendulum`, whose
//! docs describe its syntax; the implementation is in `branched-pendulum-codegen`.

use branched_pendulum_codegen::{ExpansionCache, expand};
use proc_macro::TokenStream;

// Documented at its re-export, where users see it.
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
