//! What stands in for the model when the description is wrong: the type and
//! its methods without meaning, so that an editor shows the description's
//! errors and no others.

use crate::description::Description;
use crate::scene::OBSERVABLE_SUFFIXES;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeSet;

/// Methods from two arrays to one.
const MAPS: [&str; 5] = [
    "momenta",
    "velocities",
    "symmetric_momenta",
    "symmetric_velocities",
    "transfer_quadratic_form",
];
/// Such methods that take the time first where there is a drive.
const MOTIONS: [&str; 2] = ["accelerations", "symmetric_accelerations"];
/// Methods from one array to one.
const TRANSFORMS: [&str; 2] = ["to_symmetric", "from_symmetric"];
/// Methods from one array to a matrix.
const MATRICES: [&str; 2] = ["mass_matrix", "stiffness_matrix"];
/// Methods from two arrays to a number.
const NUMBERS: [&str; 4] = [
    "kinetic_energy",
    "hamiltonian",
    "antiphase_energy",
    "antiphase_friction_power",
];
/// Methods from the time and two arrays to a number.
const POWERS: [&str; 2] = ["drive_power", "antiphase_drive_power"];
/// Methods from two arrays to a transfer.
const TRANSFERS: [&str; 2] = ["transfer_exact", "transfer_exact_from_rates"];

/// The type and its documented methods as stubs. They are never run: the
/// errors beside them keep the crate from compiling.
pub fn stub(description: &Description, runtime: &TokenStream) -> TokenStream {
    let item = &description.item;
    let constructors = constructors(description, runtime);
    let (attrs, vis, name) = (&item.attrs, &item.vis, &item.ident);
    let idents = |names: &[&str]| -> Vec<Ident> {
        names
            .iter()
            .map(|name| Ident::new(name, Span::call_site()))
            .collect()
    };
    let (maps, transforms, matrices) = (idents(&MAPS), idents(&TRANSFORMS), idents(&MATRICES));
    let (motions, powers) = (idents(&MOTIONS), idents(&POWERS));
    let time = description.drive.as_ref().map(|_| quote!(time: T,));
    let (mut numbers, mut transfers) = (idents(&NUMBERS), idents(&TRANSFERS));
    numbers.extend(observables(description));
    for order in 1..=8 {
        transfers.push(format_ident!("transfer_angle_{order}"));
        transfers.push(format_ident!("transfer_amplitude_{order}"));
    }
    let taylor = taylor(description, runtime);
    quote! {
        #(#attrs)*
        #vis struct #name<T = f64>(::core::marker::PhantomData<T>);

        #constructors

        #[allow(missing_docs, unused_variables, clippy::all)]
        impl<T: #runtime::Scalar> #name<T> {
            pub fn canonical_rates<const N: usize>(
                &self, #time theta: &[T; N], momenta: &[T; N],
            ) -> [[T; N]; 2] {
                ::core::unimplemented!()
            }
            #(pub fn #maps<const N: usize>(&self, first: &[T; N], second: &[T; N]) -> [T; N] {
                ::core::unimplemented!()
            })*
            #(pub fn #motions<const N: usize>(
                &self, #time first: &[T; N], second: &[T; N],
            ) -> [T; N] {
                ::core::unimplemented!()
            })*
            #(pub fn #powers<const N: usize>(
                &self, time: T, first: &[T; N], second: &[T; N],
            ) -> T {
                ::core::unimplemented!()
            })*
            #(pub fn #transforms<const N: usize>(&self, values: &[T; N]) -> [T; N] {
                ::core::unimplemented!()
            })*
            #(pub fn #matrices<const N: usize>(&self, theta: &[T; N]) -> [[T; N]; N] {
                ::core::unimplemented!()
            })*
            #(pub fn #numbers<const N: usize>(&self, first: &[T; N], second: &[T; N]) -> T {
                ::core::unimplemented!()
            })*
            #(pub fn #transfers<const N: usize>(
                &self, first: &[T; N], second: &[T; N],
            ) -> #runtime::Transfer<T> {
                ::core::unimplemented!()
            })*
            pub fn friction_power<const N: usize>(&self, omega: &[T; N]) -> T {
                ::core::unimplemented!()
            }
            pub fn potential_energy<const N: usize>(&self, theta: &[T; N]) -> T {
                ::core::unimplemented!()
            }
        }

        impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
            const LINKS: usize = 0;
            const LINK_NAMES: &'static [&'static str] = &[];
            fn accelerations_into(&self, _: T, _: &[T], _: &[T], _: &mut [T]) {}
        }

        impl<T: #runtime::Scalar> #runtime::SymmetricPendulum<T> for #name<T> {
            const COORDINATE_NAMES: &'static [&'static str] = &[];
            fn symmetric_accelerations_into(&self, _: T, _: &[T], _: &[T], _: &mut [T]) {}
        }

        impl<T: #runtime::Scalar> #runtime::Energy<T> for #name<T> {
            fn kinetic_energy_of(&self, _: &[T], _: &[T]) -> T { ::core::unimplemented!() }
            fn potential_energy_of(&self, _: &[T]) -> T { ::core::unimplemented!() }
        }

        #taylor
    }
}

/// The Taylor coefficients, where they are asked for.
fn taylor(description: &Description, runtime: &TokenStream) -> Option<TokenStream> {
    let name = &description.item.ident;
    let wanted = description
        .requests
        .iter()
        .any(|request| request.name == "taylor");
    let time = description.drive.as_ref().map(|_| quote!(time: T,));
    wanted.then(|| {
        quote! {
            #[allow(missing_docs, unused_variables, clippy::all)]
            impl<T: #runtime::Scalar> #name<T> {
                pub fn taylor_coefficients<const N: usize>(
                    &self,
                    #time
                    theta: &[T; N],
                    omega: &[T; N],
                    coefficients: &mut [[[T; N]; 2]],
                    work: &mut [#runtime::taylor::Quad<T>],
                ) {
                    ::core::unimplemented!()
                }
            }

            impl<T: #runtime::Scalar> #runtime::TaylorPendulum<T> for #name<T> {
                fn taylor_workspace(_: usize) -> usize { 0 }
                fn taylor_coefficients_into(
                    &self, _: T, _: &[T], _: &[T], _: &mut [T],
                    _: &mut [#runtime::taylor::Quad<T>],
                ) {}
            }
        }
    })
}

/// The functions of observables, as far as they can stand beside the others.
fn observables(description: &Description) -> Vec<Ident> {
    let known = MAPS.iter().chain(&TRANSFORMS).chain(&MATRICES);
    let known = known.chain(&NUMBERS).chain(&TRANSFERS);
    let mut taken: BTreeSet<String> = known.map(|name| (*name).to_owned()).collect();
    taken.extend(["potential_energy", "new", "from_parameters"].map(str::to_owned));
    let mut functions = Vec::new();
    for observable in &description.observables {
        let name = observable.name.to_string();
        for suffix in OBSERVABLE_SUFFIXES {
            let function = format!("{name}{suffix}");
            let plain = syn::parse_str::<Ident>(&function);
            // Transfers have numbers in their names.
            if let Ok(plain) = plain
                && !function.starts_with("transfer_")
                && taken.insert(function)
            {
                functions.push(plain);
            }
        }
    }
    functions
}

/// As the model would have them: with the parameters that the description
/// names, or without any.
fn constructors(description: &Description, runtime: &TokenStream) -> TokenStream {
    let (vis, name) = (&description.item.vis, &description.item.ident);
    let names = description.parameter_names();
    if names.is_empty() {
        return quote! {
            #[allow(missing_docs, clippy::all)]
            impl #name<f64> {
                pub fn new() -> Self { ::core::unimplemented!() }
            }

            #[allow(missing_docs, clippy::all)]
            impl<T> ::core::default::Default for #name<T> {
                fn default() -> Self { ::core::unimplemented!() }
            }
        };
    }
    let parameters = format_ident!("{name}Parameters");
    quote! {
        #[allow(missing_docs)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        #vis struct #parameters<T = f64> { #(#vis #names: T),* }

        #[allow(missing_docs, unused_variables, clippy::all)]
        impl #name<f64> {
            pub fn new(
                parameters: #parameters<f64>,
            ) -> ::core::result::Result<Self, #runtime::ParameterError> {
                ::core::unimplemented!()
            }
        }

        #[allow(missing_docs, unused_variables, clippy::all)]
        impl<T: #runtime::Scalar> #name<T> {
            pub fn from_parameters(parameters: #parameters<T>) -> Self {
                ::core::unimplemented!()
            }
        }
    }
}
