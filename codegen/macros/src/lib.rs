//! The attribute `#[branched_pendulum(...)]`. Use it through the crate
//! `branched-pendulum`, which says what it accepts; all of it is in
//! `branched-pendulum-codegen`.

use proc_macro::TokenStream;

/// Turns a struct into the model of a pendulum tree; see the crate
/// `branched-pendulum`.
#[proc_macro_attribute]
pub fn branched_pendulum(attribute: TokenStream, item: TokenStream) -> TokenStream {
    branched_pendulum_codegen::expand(attribute.into(), item.into()).into()
}
