//! Models in loops on other scalars, and for many states at once.

use super::Emission;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// `impl Rescale`, by what the model's one field holds: generic functions, which
    /// cost a scene nothing that does not call them.
    pub(super) fn loop_rescale(&self, field: &str) -> TokenStream {
        let placed = self
            .scene
            .table
            .as_ref()
            .is_some_and(|table| table.hanging.is_some());
        if self.scene.drive.is_some() || self.has_bodies() || placed {
            return TokenStream::new();
        }
        let (name, runtime) = (&self.item.ident, self.runtime());
        let field = Ident::new(field, Span::call_site());
        quote! {
            impl<T: #runtime::Scalar> #runtime::Rescale<T> for #name<T> {
                type Of<S: #runtime::Scalar> = #name<S>;

                fn rescale<S: #runtime::Scalar>(
                    &self,
                    convert: impl ::core::ops::Fn(T) -> S,
                ) -> #name<S> {
                    #name { #field: self.#field.rescale(convert) }
                }

                #[inline(always)]
                fn evaluate(
                    &self,
                    _time: T,
                    theta: impl ::core::ops::Fn(usize) -> T,
                    omega: impl ::core::ops::Fn(usize) -> T,
                    alpha: impl ::core::ops::FnMut(usize, T),
                ) {
                    self.#field.evaluate(theta, omega, alpha);
                }

                fn room(&self) -> usize {
                    self.#field.room()
                }

                #[inline(always)]
                fn in_registers<R: #runtime::scalar::Register<Lane = T>>(
                    &self,
                    room: &mut [T],
                ) -> impl #runtime::system::InRegisters<R> {
                    self.#field.in_registers(room)
                }
            }
        }
    }
}
