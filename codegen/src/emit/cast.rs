//! Models in loops on other scalars, and for many states at once.

use super::Emission;
use super::tokens::ident;
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// `impl Cast`, by what the model's field `loops` holds: generic functions, which
    /// cost a scene nothing that does not call them.
    pub(super) fn loop_cast(&self, loops: &str) -> TokenStream {
        let (name, runtime, loops) = (&self.item.ident, self.runtime(), ident(loops));
        let (fields, other) = (self.cast_fields(&loops), super::other_scalar(name));
        let (time, evaluate, drive) = match self.mechanics.drive {
            Some(_) => (
                quote!(time),
                quote!(driven_evaluate(self.root_drive(time), theta, omega, alpha)),
                quote!(::core::option::Option::Some(self.root_drive(time))),
            ),
            None => (
                quote!(_time),
                quote!(evaluate(theta, omega, alpha)),
                quote!(::core::option::Option::None),
            ),
        };
        quote! {
            impl<T: #runtime::Scalar> #runtime::Cast<T> for #name<T> {
                type Of<#other: #runtime::Scalar> = #name<#other>;

                fn cast<#other: #runtime::Scalar>(
                    &self,
                    convert: impl ::core::ops::Fn(T) -> #other,
                ) -> #name<#other> {
                    #name { #(#fields),* }
                }

                #[inline(always)]
                fn evaluate(
                    &self,
                    #time: T,
                    theta: impl ::core::ops::Fn(usize) -> T,
                    omega: impl ::core::ops::Fn(usize) -> T,
                    alpha: impl ::core::ops::FnMut(usize, T),
                ) {
                    self.#loops.#evaluate;
                }

                fn room(&self) -> usize {
                    self.#loops.room()
                }

                #[inline(always)]
                fn in_registers<R: #runtime::scalar::Register<Lane = T>>(
                    &self,
                    #time: T,
                    room: &mut [T],
                ) -> impl #runtime::system::InRegisters<R> {
                    self.#loops.in_registers(#drive, room)
                }
            }
        }
    }
}
