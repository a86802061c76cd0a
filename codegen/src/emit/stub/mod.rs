//! Stub that replaces the model if the description is wrong: the type and its methods without an
//! implementation, so that an editor shows only the errors of the description.

mod sectors;

use crate::description::Description;
use crate::emit::shapes::{argument_type, result_type};
use crate::functions::{Argument, Naming, Purpose, Signature, is_method};
use crate::scene::is_keyword;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};
use sectors::{difference_names, sector_count};
use std::collections::BTreeSet;

/// Stand-in for the number of links, which may be unknown in a wrong description.
const LINKS: usize = usize::MAX;

/// Emits the type and its documented methods as stubs. They never run, because the errors emitted
/// with them stop the build.
pub fn stub(description: &Description, runtime: &TokenStream) -> TokenStream {
    let item = &description.item;
    let constructors = constructors(description, runtime);
    let (attrs, vis, name) = (&item.attrs, &item.vis, &item.ident);
    let naming = naming(description);
    let functions = functions(&naming, runtime);
    let taylor = taylor(description, runtime);
    let (equations, quantities) = (equations(name, runtime), quantities(name, runtime));
    let on_slices = Purpose::all_slices().into_iter();
    let on_slices = on_slices.map(|function| computed(name, runtime, function.name));
    quote! {
        #(#attrs)*
        #vis struct #name<T = f64>(::core::marker::PhantomData<T>);

        #constructors

        #[allow(missing_docs, unused_variables, clippy::all)]
        impl<T: #runtime::Scalar> #name<T> {
            #functions
        }

        #equations

        #(#on_slices)*

        #quantities

        #taylor
    }
}

/// Emits the traits of a model's links and of its equations of motion.
fn equations(name: &Ident, runtime: &TokenStream) -> TokenStream {
    let other = super::other_scalar(name);
    quote! {
        impl<T: #runtime::Scalar> #runtime::Sectors for #name<T> {
            fn sectors(&self) -> &[#runtime::sectors::Sector] { &[] }
        }

        #[allow(missing_docs)]
        impl #name<f64> {
            pub const LINKS: usize = 0;
            pub const LINK_NAMES: &'static [&'static str] = &[];
            pub const SECTORS: &'static [#runtime::sectors::Sector] = &[];
        }

        impl<T: #runtime::Scalar> #runtime::Model<T> for #name<T> {
            type Of<#other: #runtime::Scalar> = #name<#other>;
            const KNOWN_LINKS: ::core::option::Option<usize> = ::core::option::Option::Some(0);
            fn links(&self) -> usize { 0 }
            fn link_name(
                &self, _: usize,
            ) -> ::core::option::Option<#runtime::system::LinkName<'_>> {
                ::core::option::Option::None
            }
            fn cast<#other: #runtime::Scalar>(
                &self, _: impl ::core::ops::Fn(T) -> #other,
            ) -> #name<#other> { ::core::unimplemented!() }
        }

        impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
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
        }
    }
}

/// Emits the traits of quantities other than accelerations that depend on a state.
fn quantities(name: &Ident, runtime: &TokenStream) -> TokenStream {
    quote! {
        impl<T: #runtime::Scalar> #runtime::TransferForms<T> for #name<T> {
            const TRANSFER_FORMS: &'static [#runtime::TransferForm] = &[];
            const RECEIVERS: &'static [&'static str] = &[];
            const SMALL_SECTORS: &'static [#runtime::transfer_forms::SmallSector] = &[];
            fn transfers_into(&self, _: usize, _: &[T], _: &[T], _: &mut [#runtime::Transfer<T>]) {}
            fn symmetric_momenta_into(&self, _: &[T], _: &[T], _: &mut [T]) {}
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

        impl<T: #runtime::Scalar> #runtime::Prescribed<T> for #name<T> {
            fn prescribed_links(&self, _: usize) -> ::core::option::Option<&[usize]> {
                ::core::option::Option::None
            }
        }

        impl<T: #runtime::Scalar> #runtime::Transverse<T> for #name<T> {
            const TRANSVERSE: &'static [#runtime::system::TransverseSector] = &[];
            fn transverse_accelerations_into(
                &self, _: usize, _: T, _: #runtime::system::InPhaseMotion<'_, T>,
                _: &[T], _: &[T], _: &mut [T],
            ) {}
            fn transverse_energy_of(&self, _: usize, _: &[T], _: &[T], _: &[T]) -> T {
                ::core::unimplemented!()
            }
            fn transverse_transfer_of(
                &self, _: usize, _: T, _: #runtime::system::InPhaseMotion<'_, T>,
                _: &[T], _: &[T],
            ) -> T { ::core::unimplemented!() }
            fn transverse_friction_power_of(&self, _: usize, _: &[T]) -> T {
                ::core::unimplemented!()
            }
        }

        impl<T: #runtime::Scalar> #runtime::SmallDifferences<T> for #name<T> {
            const SMALL: &'static [usize] = &[];
            fn small_energy_of(&self, _: &[T], _: &[T], _: &[T], _: &[T]) -> T {
                ::core::unimplemented!()
            }
        }

        impl<T: #runtime::Scalar> #runtime::Energy<T> for #name<T> {
            fn kinetic_energy_of(&self, _: &[T], _: &[T]) -> T { ::core::unimplemented!() }
            fn potential_energy_of(&self, _: &[T]) -> T { ::core::unimplemented!() }
        }
    }
}

/// Returns the naming of functions, as far as the description determines it.
fn naming(description: &Description) -> Naming {
    // If there are several differences, each has its own functions.
    let places = difference_names(description).into_iter();
    let places = places.map(|place| format!("_{place}"));
    let prescribed = description.prescribed.iter().map(|clause| {
        let links: Vec<String> = clause.links.iter().map(Ident::to_string).collect();
        (links.join("_and_"), links.len())
    });
    let observables = description.observables.iter();
    let mut springs = description.spring_dampers.iter();
    Naming {
        driven: description.drive.is_some(),
        damped_by_angle: springs.any(|own| own.is_straight() && own.gives("friction")),
        links: LINKS,
        parameters: description.parameter_names().len(),
        sectors: sector_count(description),
        places: std::iter::once(String::new()).chain(places).collect(),
        prescribed: prescribed.collect(),
        observables: observables.map(|o| (o.name.to_string(), false)).collect(),
        transverse: Vec::new(),
    }
}

/// Emits the functions that the model may have, as far as they do not conflict; functions that do
/// not take plain arrays are left out.
fn functions(naming: &Naming, runtime: &TokenStream) -> TokenStream {
    use Purpose::{
        Drive, SmallAccelerations, SmallAccelerationsUnder, SmallEnergy, TaylorCoefficients,
    };
    let length = |count| match count {
        LINKS => quote!(N),
        count => Literal::usize_unsuffixed(count).into_token_stream(),
    };
    let mut taken = BTreeSet::new();
    let others = [
        Drive,
        SmallAccelerations,
        SmallAccelerationsUnder,
        SmallEnergy,
        TaylorCoefficients,
    ];
    let purposes = naming.purposes().into_iter();
    let purposes = purposes.filter(|purpose| !others.contains(purpose));
    let functions = purposes.filter_map(|purpose| {
        let Signature {
            name,
            arguments,
            shape,
        } = naming.signature(purpose);
        let clashes = matches!(purpose, Purpose::Observable(..)) && is_method(&name);
        if clashes || !is_plain(&name) || !taken.insert(name.clone()) {
            return None;
        }
        let name = format_ident!("{name}");
        let arguments = arguments.into_iter().map(|argument| {
            let count = match argument {
                Argument::Prescribed(set) => naming.prescribed[set].1,
                _ => LINKS,
            };
            let name = format_ident!("{}", argument.name());
            let kind = argument_type(argument, &length(count));
            quote!(#name: #kind)
        });
        let result = result_type(runtime, shape, LINKS, length);
        Some(quote! {
            pub fn #name<const N: usize>(&self, #(#arguments),*) -> #result {
                ::core::unimplemented!()
            }
        })
    });
    functions.collect()
}

/// Emits a function of a state.
fn computed(name: &Ident, runtime: &TokenStream, function: &str) -> TokenStream {
    let (other, function) = (super::other_scalar(name), format_ident!("{function}"));
    quote! {
        impl<T: #runtime::Scalar> #runtime::system::Computes<
            #runtime::system::functions::#function, T,
        > for #name<T> {
            type On<#other: #runtime::Scalar> = #name<#other>;
            fn on<#other: #runtime::Scalar>(
                &self, _: impl ::core::ops::Fn(T) -> #other,
            ) -> #name<#other> { ::core::unimplemented!() }
            fn compute(&self, _: #runtime::system::At<T>, _: &[&[T]], _: &mut [&mut [T]]) {}
        }
    }
}

/// Emits the Taylor coefficients, if requested.
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
                fn taylor_workspace(&self, _: usize) -> usize { 0 }
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

/// Returns true if a name may be used in a stub: it is not a keyword and has only one spelling.
fn is_plain(name: &str) -> bool {
    syn::parse_str::<Ident>(name).is_ok() && !is_keyword(name) && !name.starts_with("r#")
}

/// Emits the constructors of the model: with the parameters that the description names, or without
/// any.
fn constructors(description: &Description, runtime: &TokenStream) -> TokenStream {
    let (vis, name) = (&description.item.vis, &description.item.ident);
    let mut names = description.parameter_names();
    names.retain(|name| is_plain(&name.to_string()));
    if names.is_empty() {
        return constructor_of_numbers(description);
    }
    let parameters = format_ident!("{name}Parameters");
    let other = super::other_scalar(name);
    quote! {
        #[allow(missing_docs)]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        #vis struct #parameters<T = f64> { #(#vis #names: T),* }

        #[allow(missing_docs, unused_variables, clippy::all)]
        impl<T> #parameters<T> {
            pub fn set(
                &mut self,
                name: &str,
                value: T,
            ) -> ::core::result::Result<(), #runtime::UnknownParameter> {
                ::core::unimplemented!()
            }
        }

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

/// Emits the constructors of a model without parameters.
fn constructor_of_numbers(description: &Description) -> TokenStream {
    let name = &description.item.ident;
    // A derived `Default` is reported as an error, and exists nevertheless.
    let default = description.item.derived("Default").is_none().then(|| {
        quote! {
            #[allow(missing_docs, clippy::all)]
            impl<T> ::core::default::Default for #name<T> {
                fn default() -> Self { ::core::unimplemented!() }
            }
        }
    });
    quote! {
        #[allow(missing_docs, clippy::all)]
        impl #name<f64> {
            pub fn new() -> Self { ::core::unimplemented!() }
        }

        #default
    }
}
