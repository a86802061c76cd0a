//! The runtime's traits for the model. Their slices may have any length; a wrong length gives NaN,
//! which integrators report at once.

use super::Emission;
use crate::functions::Purpose;
use crate::mechanics::Mechanics;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

impl Emission<'_> {
    pub(super) fn traits(&self) -> TokenStream {
        let pendulum = self.pendulum();
        let energy = self.scene.requests.energies.then(|| self.energy());
        let symmetric = self
            .mechanics
            .symmetric
            .is_some()
            .then(|| self.symmetric_pendulum());
        let sectors = self.mechanics.sectors.as_ref();
        let sectors = sectors.map(|sectors| self.sectors(sectors));
        let forms = self.transfer_forms();
        let positions = self.positions_trait();
        let transverse = self.transverse_trait();
        let small = self.small_trait();
        let functions = self.slice_functions();
        let prescribed = self.prescribed_trait();
        let taylor = self.scene.requests.taylor.then(|| self.taylor_pendulum());
        quote! {
            #pendulum
            #energy
            #symmetric
            #sectors
            #forms
            #positions
            #transverse
            #small
            #functions
            #prescribed
            #taylor
        }
    }

    pub(super) fn links(&self) -> Literal {
        Literal::usize_unsuffixed(self.scene.links.len())
    }

    /// Returns the name of the time argument of the equations of motion, which trees without a
    /// drive ignore.
    pub(super) fn time_name(&self) -> Ident {
        let name = match self.mechanics.drive {
            Some(_) => "time",
            None => "_time",
        };
        Ident::new(name, Span::call_site())
    }

    fn pendulum(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let call = match self.mechanics.drive.is_some() {
            true => quote!(self.accelerations(time, &theta, &omega)),
            false => quote!(self.accelerations(&theta, &omega)),
        };
        let time = self.time_name();
        let sunk = self.sunk();
        // As for the functions, see `emit`.
        let allow = sunk
            .is_some()
            .then(|| quote!(#[allow(clippy::possible_missing_comma)]));
        let body = sunk.unwrap_or_else(|| {
            quote! {
                let theta = ::core::array::from_fn(theta);
                let omega = ::core::array::from_fn(omega);
                let values = #call;
                for (link, value) in ::core::iter::Iterator::enumerate(
                    ::core::iter::IntoIterator::into_iter(values),
                ) {
                    alpha(link, value);
                }
            }
        });
        let model = self.model_of_constants();
        quote! {
            #model

            #allow
            impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
                #[inline(always)]
                fn evaluate(
                    &self,
                    #time: T,
                    theta: impl ::core::ops::Fn(usize) -> T,
                    omega: impl ::core::ops::Fn(usize) -> T,
                    mut alpha: impl ::core::ops::FnMut(usize, T),
                ) {
                    #body
                }
            }
        }
    }

    /// Emits `impl Model`, with the conversion of each stored constant to another scalar.
    fn model_of_constants(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let fields: Vec<Ident> = self
            .stored_constants()
            .into_iter()
            .map(|id| self.field(id))
            .collect();
        let convert = match fields.is_empty() {
            true => quote!(_convert),
            false => quote!(convert),
        };
        let other = super::other_scalar(name);
        self.model_trait(&quote! {
            #[inline(always)]
            fn cast<#other: #runtime::Scalar>(
                &self,
                #convert: impl ::core::ops::Fn(T) -> #other,
            ) -> #name<#other> {
                #name { #(#fields: convert(self.#fields)),* }
            }
        })
    }

    fn energy(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let kinetic = self.value_at_slices(Purpose::KineticEnergy);
        let potential = self.value_at_slices(Purpose::PotentialEnergy);
        quote! {
            impl<T: #runtime::Scalar> #runtime::Energy<T> for #name<T> {
                #[inline]
                fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T {
                    #kinetic
                }

                #[inline]
                fn potential_energy_of(&self, theta: &[T]) -> T {
                    #potential
                }
            }
        }
    }

    fn symmetric_pendulum(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let names = coordinate_names(self.mechanics);
        quote! {
            impl<T: #runtime::Scalar> #runtime::SymmetricPendulum<T> for #name<T> {
                const COORDINATE_NAMES: &'static [&'static str] = &[#(#names),*];
            }
        }
    }
}

/// Returns `theta_parent`, `theta_m`, ….
fn coordinate_names(mechanics: &Mechanics) -> Vec<String> {
    mechanics
        .symmetric
        .iter()
        .flat_map(|frame| &frame.coordinates)
        .map(|&id| mechanics.symbols.get(id).code.clone())
        .collect()
}
