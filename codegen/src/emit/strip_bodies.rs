//! Energies, powers and positions of trees in loops: the functions of one link, as implementations
//! of the runtime's traits.

use super::Emission;
use crate::functions::{BodyFunction, Purpose};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// Emits `impl BodyEquations` if energies are requested, and `impl PointEquations` if positions
    /// are.
    pub(super) fn body_equations(&self) -> TokenStream {
        let requests = &self.scene.requests;
        let (runtime, equations) = (self.runtime(), self.equations_name());
        let functions = |of_point: bool| {
            let all = BodyFunction::ALL.into_iter();
            let own = all.filter(move |function| function.is_of_point() == of_point);
            let functions: Vec<TokenStream> = own
                .filter_map(|function| self.body_function(function))
                .collect();
            quote!(#(#functions)*)
        };
        let bodies = requests.energies.then(|| {
            let strips = self.program.strips.as_ref();
            let columns = strips.map_or(0, |strips| strips.body_columns.len());
            let (columns, functions) = (Literal::usize_unsuffixed(columns), functions(false));
            quote! {
                // For the lint about commas: all tokens have the span of the attribute, see `emit`.
                #[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
                impl #runtime::tree::BodyEquations for #equations {
                    type Body<T: #runtime::Scalar> = [T; #columns];

                    #functions
                }
            }
        });
        let points = requests.positions.then(|| {
            let functions = functions(true);
            quote! {
                #[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
                impl #runtime::tree::PointEquations for #equations {
                    #functions
                }
            }
        });
        quote!(#bodies #points)
    }

    fn body_function(&self, function: BodyFunction) -> Option<TokenStream> {
        let results = Literal::usize_unsuffixed(function.results());
        self.equation_function(Purpose::Body(function), &quote!([T; #results]))
    }
}
