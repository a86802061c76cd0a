//! Substitute of the model when the description is wrong: the type and its
//! methods without meaning, so that an editor shows the description's errors
//! and no others.

use super::stub_sectors::{budgets, places};
use crate::description::Description;
use crate::program::PointKind;
use crate::scene::{OBSERVABLE_SUFFIXES, is_keyword, is_method};
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
const TRANSFERS: [&str; 6] = [
    "transfer_exact",
    "transfer_exact_from_rates",
    "transfer_forcing",
    "transfer_forcing_from_rates",
    "transfer_growth",
    "transfer_growth_from_rates",
];

/// The type and its documented methods as stubs. They are never run: the
/// errors beside them keep the crate from compiling.
pub fn stub(description: &Description, runtime: &TokenStream) -> TokenStream {
    let item = &description.item;
    let constructors = constructors(description, runtime);
    let (attrs, vis, name) = (&item.attrs, &item.vis, &item.ident);
    let other = super::other_scalar(name);
    let idents = |names: &[&str]| -> Vec<Ident> {
        names
            .iter()
            .map(|name| Ident::new(name, Span::call_site()))
            .collect()
    };
    let (transforms, matrices, motions) =
        (idents(&TRANSFORMS), idents(&MATRICES), idents(&MOTIONS));
    let (mut maps, mut powers) = (idents(&MAPS), idents(&POWERS));
    let time = description.drive.as_ref().map(|_| quote!(time: T,));
    let (mut numbers, mut transfers) = (idents(&NUMBERS), idents(&TRANSFERS));
    for order in 1..=8 {
        transfers.push(format_ident!("transfer_angle_{order}"));
        transfers.push(format_ident!("transfer_amplitude_{order}"));
    }
    // Where there are several differences, each has its functions.
    let places = places(description);
    for (functions, family) in [
        (&mut maps, "transfer_"),
        (&mut powers, "antiphase_"),
        (&mut numbers, "antiphase_"),
        (&mut transfers, "transfer_"),
    ] {
        let plain = functions.iter().map(Ident::to_string);
        let plain: Vec<String> = plain.filter(|name| name.starts_with(family)).collect();
        let placed = plain.iter().flat_map(|name| {
            let place = move |place| format_ident!("{name}_{place}");
            places.iter().map(place)
        });
        functions.extend(placed);
    }
    numbers.extend(observables(description));
    let of_points = |suffix: &'static str| {
        let kinds = PointKind::ALL.into_iter();
        kinds.map(move |kind| format_ident!("{}{suffix}", kind.name()))
    };
    let (points, velocities, torques) = (
        of_points("s"),
        of_points("_velocities"),
        of_points("_torques"),
    );
    let taylor = taylor(description, runtime);
    let prescribed = prescribed(description, runtime);
    let budgets = budgets(description, runtime);
    let mut outside_powers = vec![format_ident!("antiphase_outside_power")];
    let placed = places
        .iter()
        .map(|place| format_ident!("antiphase_outside_power_{place}"));
    outside_powers.extend(placed);
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
            #(pub fn #points<const N: usize>(&self, theta: &[T; N]) -> [[T; 2]; N] {
                ::core::unimplemented!()
            })*
            #(pub fn #velocities<const N: usize>(
                &self, theta: &[T; N], omega: &[T; N],
            ) -> [[T; 2]; N] {
                ::core::unimplemented!()
            })*
            #(pub fn #torques<const N: usize>(
                &self, theta: &[T; N], forces: &[[T; 2]; N],
            ) -> [T; N] {
                ::core::unimplemented!()
            })*
            pub fn accelerations_under<const N: usize>(
                &self, #time theta: &[T; N], omega: &[T; N], torques: &[T; N],
            ) -> [T; N] {
                ::core::unimplemented!()
            }
            pub fn outside_power<const N: usize>(&self, omega: &[T; N], torques: &[T; N]) -> T {
                ::core::unimplemented!()
            }
            #(pub fn #outside_powers<const N: usize>(
                &self, coordinates: &[T; N], rates: &[T; N], torques: &[T; N],
            ) -> T {
                ::core::unimplemented!()
            })*
            pub fn link_properties<const N: usize>(&self) -> [[T; 8]; N] {
                ::core::unimplemented!()
            }
            #budgets
        }

        impl<T: #runtime::Scalar> #runtime::Sectors for #name<T> {
            const SECTORS: &'static [#runtime::sectors::Sector] = &[];
        }

        impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
            const LINKS: usize = 0;
            const LINK_NAMES: &'static [&'static str] = &[];
            fn accelerations_into(&self, _: T, _: &[T], _: &[T], _: &mut [T]) {}
        }

        impl<T: #runtime::Scalar> #runtime::Canonical<T> for #name<T> {
            fn degrees_of_freedom(&self) -> usize { 0 }
            fn canonical_rates(&self, _: T, _: &[T], _: &[T], _: &mut [T], _: &mut [T]) {}
        }

        impl<T: #runtime::Scalar> #runtime::Cast<T> for #name<T> {
            type Of<#other: #runtime::Scalar> = #name<#other>;
            fn cast<#other: #runtime::Scalar>(
                &self, _: impl ::core::ops::Fn(T) -> #other,
            ) -> #name<#other> { ::core::unimplemented!() }
            fn evaluate(
                &self,
                _: T,
                _: impl ::core::ops::Fn(usize) -> T,
                _: impl ::core::ops::Fn(usize) -> T,
                _: impl ::core::ops::FnMut(usize, T),
            ) {}
        }

        impl<T: #runtime::Scalar> #runtime::SymmetricPendulum<T> for #name<T> {
            const COORDINATE_NAMES: &'static [&'static str] = &[];
            fn symmetric_accelerations_into(&self, _: T, _: &[T], _: &[T], _: &mut [T]) {}
        }

        impl<T: #runtime::Scalar> #runtime::TransferForms<T> for #name<T> {
            const TRANSFER_FORMS: &'static [#runtime::TransferForm] = &[];
            const RECEIVERS: &'static [&'static str] = &[];
            const SMALL_SECTORS: &'static [#runtime::transfer_forms::SmallSector] = &[];
            fn transfers_into(&self, _: usize, _: &[T], _: &[T], _: &mut [#runtime::Transfer<T>]) {}
            fn symmetric_momenta_into(&self, _: &[T], _: &[T], _: &mut [T]) {}
        }

        impl<T: #runtime::Scalar> #runtime::Forced<T> for #name<T> {
            fn accelerations_under_into(&self, _: T, _: &[T], _: &[T], _: &[T], _: &mut [T]) {}
            fn accelerations_under_of<#other: #runtime::Scalar>(
                _: &#name<#other>, _: #other, _: &[#other], _: &[#other], _: &[#other],
                _: &mut [#other],
            ) {}
        }

        impl<T: #runtime::Scalar> #runtime::Positions<T> for #name<T> {
            fn properties_of(
                &self, _: usize,
            ) -> ::core::option::Option<#runtime::system::LinkProperties<T>> {
                ::core::option::Option::None
            }
            fn points_into(&self, _: #runtime::system::LinkPoint, _: &[T], _: &mut [[T; 2]]) {}
            fn point_velocities_into(
                &self, _: #runtime::system::LinkPoint, _: &[T], _: &[T], _: &mut [[T; 2]],
            ) {}
            fn point_torques_into(
                &self, _: #runtime::system::LinkPoint, _: &[T], _: &[[T; 2]], _: &mut [T],
            ) {}
        }

        impl<T: #runtime::Scalar> #runtime::Energy<T> for #name<T> {
            fn kinetic_energy_of(&self, _: &[T], _: &[T]) -> T { ::core::unimplemented!() }
            fn potential_energy_of(&self, _: &[T]) -> T { ::core::unimplemented!() }
        }

        #prescribed

        #taylor
    }
}

/// The functions of prescribed links.
fn prescribed(description: &Description, runtime: &TokenStream) -> Option<TokenStream> {
    let name = &description.item.ident;
    if description.prescribed.is_empty() {
        return None;
    }
    let mut functions: Vec<Ident> = Vec::new();
    for clause in &description.prescribed {
        let links: Vec<String> = clause.links.iter().map(Ident::to_string).collect();
        let function = format!("accelerations_prescribed_{}", links.join("_and_"));
        let known = functions.iter().any(|known| *known == function);
        if is_plain(&function) && !known {
            functions.push(format_ident!("{function}"));
        }
    }
    let time = description.drive.as_ref().map(|_| quote!(time: T,));
    Some(quote! {
        #[allow(missing_docs, unused_variables, clippy::all)]
        impl<T: #runtime::Scalar> #name<T> {
            #(pub fn #functions<const N: usize, const K: usize>(
                &self, #time theta: &[T; N], omega: &[T; N], torques: &[T; N], prescribed: &[T; K],
            ) -> ([T; N], [T; K]) {
                ::core::unimplemented!()
            })*
        }

        impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
            const PRESCRIBED: &'static [#runtime::system::PrescribedLinks] = &[];
            fn accelerations_prescribed_into(
                &self, _: usize, _: T, _: #runtime::system::PrescribedMotion<'_, T>,
                _: &mut [T], _: &mut [T],
            ) {}
        }
    })
}

/// The Taylor coefficients, where they are asked for.
fn taylor(description: &Description, runtime: &TokenStream) -> Option<TokenStream> {
    let name = &description.item.ident;
    let other = super::other_scalar(name);
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
                    work: &mut [#runtime::emitted::taylor::Quad<T>],
                ) {
                    ::core::unimplemented!()
                }
            }

            impl<T: #runtime::Scalar> #runtime::TaylorPendulum<T> for #name<T> {
                fn taylor_workspace(_: usize) -> usize { 0 }
                fn taylor_coefficients_of<#other: #runtime::Scalar>(
                    _: &#name<#other>, _: #other, _: &[#other], _: &[#other], _: &mut [#other],
                    _: &mut [#runtime::emitted::taylor::Quad<#other>],
                ) {}
                fn taylor_coefficients_into(
                    &self, _: T, _: &[T], _: &[T], _: &mut [T],
                    _: &mut [#runtime::emitted::taylor::Quad<T>],
                ) {}
            }
        }
    })
}

/// The functions of observables, as far as they can stand beside the others.
fn observables(description: &Description) -> Vec<Ident> {
    let mut taken = BTreeSet::new();
    let mut functions = Vec::new();
    for observable in &description.observables {
        let name = observable.name.to_string();
        for suffix in OBSERVABLE_SUFFIXES {
            let function = format!("{name}{suffix}");
            if is_plain(&function) && !is_method(&function) && taken.insert(function.clone()) {
                functions.push(format_ident!("{function}"));
            }
        }
    }
    functions
}

/// Returns true if a name may stand in a stub: no keyword, and spelt in one way only.
pub(super) fn is_plain(name: &str) -> bool {
    syn::parse_str::<Ident>(name).is_ok() && !is_keyword(name) && !name.starts_with("r#")
}

/// As the model would have them: with the parameters that the description
/// names, or without any.
fn constructors(description: &Description, runtime: &TokenStream) -> TokenStream {
    let (vis, name) = (&description.item.vis, &description.item.ident);
    let mut names = description.parameter_names();
    names.retain(|name| is_plain(&name.to_string()));
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
    let other = super::other_scalar(name);
    quote! {
        #[allow(missing_docs)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        #vis struct #parameters<T = f64> { #(#vis #names: T),* }

        #[allow(missing_docs, unused_variables, clippy::all)]
        impl<T: #runtime::scalar::Real> #name<T> {
            pub fn new(
                parameters: #parameters<T>,
            ) -> ::core::result::Result<Self, #runtime::ParameterError> {
                ::core::unimplemented!()
            }
        }

        #[allow(missing_docs, unused_variables, clippy::all)]
        impl<T: #runtime::Scalar> #name<T> {
            pub fn from_parameters_unchecked(parameters: #parameters<T>) -> Self {
                ::core::unimplemented!()
            }
        }

        impl<T: #runtime::Scalar> #runtime::Parametric<T> for #name<T> {
            const PARAMETERS: &'static [&'static str] = &[];
            fn with_parameters<#other: #runtime::Scalar>(
                _: impl ::core::ops::Fn(usize) -> #other,
            ) -> #name<#other> { ::core::unimplemented!() }
            fn check_parameters(
                _: impl ::core::ops::Fn(usize) -> f64,
            ) -> ::core::result::Result<(), #runtime::ParameterError> {
                ::core::unimplemented!()
            }
        }
    }
}
