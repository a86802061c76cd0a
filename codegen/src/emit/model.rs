//! Emits the model type: constants, constructors, accessors.

use super::Emission;
use super::doc_text::doc_lines;
use super::tokens::float;
use crate::mechanics::constant_text;
use crate::mechanics::expression::Symbol;
use crate::program::ConstantId;
use crate::scene::{
    LinkId, Magnitudes, NEGLIGIBLE, Offset, ParameterId, Quantity, Requirement, Sign,
};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

/// Traits that the model derives, unless its author derives them.
const DERIVED: [&str; 4] = ["Clone", "Copy", "Debug", "PartialEq"];

impl Emission<'_> {
    pub(super) fn model(&self) -> TokenStream {
        let (attrs, vis, name) = (&self.item.attrs, &self.item.vis, &self.item.ident);
        let mut docs = self.model_docs();
        if attrs.iter().any(|written| written.is("doc")) {
            docs.insert(0, String::new());
        }
        let docs = doc_lines(&docs);
        let derives = self.missing_derives();
        let fields = self.stored_constants().into_iter().map(|id| {
            let (docs, field) = (self.shared_field(id), self.field(id));
            quote!(#docs #field: T)
        });
        let fields: Vec<TokenStream> = match self.scene.in_loops() {
            true => self.strip_fields(),
            false => fields.collect(),
        };
        let constructor = match self.scene.parameters.is_empty() {
            true => self.literal_constructor(),
            false => self.parameter_constructor(),
        };
        quote! {
            #(#attrs)*
            #docs
            #derives
            #vis struct #name<T = f64> {
                #(#fields),*
            }

            #constructor
        }
    }

    /// Returns docs that list all constants stored in the same field, if there are several.
    fn shared_field(&self, id: ConstantId) -> Option<TokenStream> {
        let read = self.program.setup.stand_ins.iter();
        let letters = read.filter(|(_, own)| **own == id);
        let letters: Vec<&str> = letters
            .map(|(&index, _)| self.letter(index).text.as_str())
            .collect();
        let docs = || doc_lines(&[format!("{}.", letters.join(" = "))]);
        (letters.len() > 1).then(docs)
    }

    fn missing_derives(&self) -> TokenStream {
        let missing = DERIVED
            .iter()
            .filter(|name| self.item.derived(name).is_none())
            // The constants of loops are on the heap.
            .filter(|name| **name != "Copy" || !self.scene.in_loops())
            .map(|name| {
                let name = Ident::new(name, Span::call_site());
                match name.to_string().as_str() {
                    "Clone" => quote!(::core::clone::Clone),
                    "Copy" => quote!(::core::marker::Copy),
                    "Debug" => quote!(::core::fmt::Debug),
                    _ => quote!(::core::cmp::PartialEq),
                }
            });
        quote!(#[derive(#(#missing),*)])
    }

    /// Emits the functions that compute the constants from numbers or from parameters.
    pub(super) fn values(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let constants = self.constants();
        if self.scene.parameters.is_empty() {
            return quote! {
                impl<T: #runtime::Scalar> ::core::default::Default for #name<T> {
                    fn default() -> Self {
                        #constants
                    }
                }
            };
        }
        let parameters = format_ident!("{}Parameters", name);
        quote! {
            // As for the functions, see `emit`.
            #[allow(dead_code, clippy::possible_missing_comma)]
            impl<T: #runtime::Scalar> #name<T> {
                /// Creates the model for the given parameters without checking
                /// them, for scalars that cannot be compared, such as lanes and
                /// dual numbers. For other scalars use `new`.
                #[must_use]
                pub fn from_parameters_unchecked(parameters: #parameters<T>) -> Self {
                    #constants
                }
            }
        }
    }

    fn literal_constructor(&self) -> TokenStream {
        let name = &self.item.ident;
        quote! {
            #[allow(dead_code)]
            impl #name<f64> {
                /// Creates the model in double precision, with constants that are
                /// rounded once from their exact values. `Default` creates it for
                /// other scalars.
                #[must_use]
                pub fn new() -> Self {
                    <Self as ::core::default::Default>::default()
                }
            }
        }
    }

    fn parameter_constructor(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let parameters = format_ident!("{}Parameters", name);
        let doubles = self.scene.parameters.iter().map(|parameter| {
            let field = format_ident!("{}", parameter.name);
            quote!(#field: #runtime::scalar::Real::to_f64(given.#field))
        });
        let finite = self.finite_parameters();
        let requirements = self.scene.requirements.iter();
        let requirements = requirements.map(|requirement| self.requirement(requirement));
        let regular = self.regularity();
        let parametric = self.parametric();
        let (given, setter) = (self.parameters(), self.setter());
        quote! {
            #given

            #setter

            // As for the functions below.
            #[allow(dead_code, clippy::possible_missing_comma)]
            impl<T: #runtime::scalar::Real> #name<T> {
                /// Creates the model for the given parameters, which are checked in
                /// double precision.
                ///
                /// # Errors
                /// Fails if a parameter is not finite or its magnitude is out of
                /// range, if a mass, an inertia or a friction coefficient is
                /// impossible, if gravity reverses its direction, or if the mass
                /// matrix is singular.
                pub fn new(
                    parameters: #parameters<T>,
                ) -> ::core::result::Result<Self, #runtime::ParameterError> {
                    let given = parameters;
                    let parameters = #parameters::<f64> {
                        #(#doubles),*
                    };
                    #(#finite)*
                    #(#requirements)*
                    #regular
                    ::core::result::Result::Ok(Self::from_parameters_unchecked(given))
                }
            }

            #parametric
        }
    }

    /// Emits the struct that holds the parameters.
    fn parameters(&self) -> TokenStream {
        let (vis, name) = (&self.item.vis, &self.item.ident);
        let parameters = format_ident!("{}Parameters", name);
        let fields = self.scene.parameters.iter().map(|parameter| {
            let field = format_ident!("{}", parameter.name);
            let docs = doc_lines(&[format!("{}.", parameter.doc)]);
            quote! {
                #docs
                #vis #field: T
            }
        });
        let docs = format!(" Parameters of [`{name}`]. SI units.");
        quote! {
            #[doc = #docs]
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
            #vis struct #parameters<T = f64> {
                #(#fields),*
            }
        }
    }

    /// Emits checks that parameters are finite, for parameters without further requirements.
    fn finite_parameters(&self) -> impl Iterator<Item = TokenStream> {
        let runtime = self.runtime();
        let required = |index: usize| {
            let own = Quantity::parameter(ParameterId(index));
            let mut requirements = self.scene.requirements.iter();
            requirements.any(|requirement| requirement.quantity == own)
        };
        self.scene
            .parameters
            .iter()
            .enumerate()
            .filter(move |(index, _)| !required(*index))
            .map(move |(_, parameter)| {
                let field = format_ident!("{}", parameter.name);
                let what = format!("parameter `{}`", parameter.name);
                quote!(#runtime::emitted::require_finite(#what, parameters.#field)?;)
            })
    }

    /// Emits a function that sets parameters by name, as from a file or a command line.
    fn setter(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let parameters = format_ident!("{}Parameters", name);
        let names = self.scene.parameters.iter();
        let names: Vec<&String> = names.map(|parameter| &parameter.name).collect();
        let fields = names.iter().map(|name| format_ident!("{name}"));
        quote! {
            #[allow(dead_code)]
            impl<T> #parameters<T> {
                /// Sets the parameter with this name.
                ///
                /// # Errors
                /// Fails if no parameter has this name.
                pub fn set(
                    &mut self,
                    name: &str,
                    value: T,
                ) -> ::core::result::Result<(), #runtime::UnknownParameter> {
                    let parameter = match name {
                        #(#names => &mut self.#fields,)*
                        _ => return ::core::result::Result::Err(
                            #runtime::UnknownParameter::new(name, &[#(#names),*]),
                        ),
                    };
                    *parameter = value;
                    ::core::result::Result::Ok(())
                }
            }
        }
    }

    /// Emits access to parameters by name and by index, for fits to data.
    fn parametric(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let (parameters, other) = (
            format_ident!("{}Parameters", name),
            super::other_scalar(name),
        );
        let names = self
            .scene
            .parameters
            .iter()
            .map(|parameter| &parameter.name);
        let fields = self.scene.parameters.iter().enumerate();
        let fields = fields.map(|(index, parameter)| {
            let (field, index) = (
                format_ident!("{}", parameter.name),
                Literal::usize_unsuffixed(index),
            );
            quote!(#field: values(#index))
        });
        let fields = quote!(#parameters { #(#fields),* });
        quote! {
            impl<T: #runtime::Scalar> #runtime::Parametric<T> for #name<T> {
                const PARAMETERS: &'static [&'static str] = &[#(#names),*];

                fn with_parameters<#other: #runtime::Scalar>(
                    values: impl ::core::ops::Fn(usize) -> #other,
                ) -> #name<#other> {
                    #name::from_parameters_unchecked(#fields)
                }

                fn check_parameters(
                    values: impl ::core::ops::Fn(usize) -> f64,
                ) -> ::core::result::Result<(), #runtime::ParameterError> {
                    ::core::result::Result::map(#name::<f64>::new(#fields), |_| ())
                }
            }
        }
    }

    /// Emits a check that returns an error unless a value meets its conditions; NaN never does.
    fn requirement(&self, requirement: &Requirement) -> TokenStream {
        let runtime = self.runtime();
        let value = self.quantity(&requirement.quantity);
        let check = match requirement.sign {
            Sign::Any => quote!(require_finite),
            Sign::Hanging => quote!(require_downward),
            Sign::Standing => quote!(require_upward),
            Sign::NonNegative => quote!(require_non_negative),
            Sign::Positive => quote!(require_positive),
        };
        let what = &requirement.what;
        let Magnitudes {
            least,
            largest,
            text,
        } = requirement.magnitudes;
        let [least, largest] = [least, largest].map(float);
        let named = requirement.describe_value(&self.scene.parameters);
        quote! {
            let value = #value;
            #runtime::emitted::#check(#what, value)?;
            #runtime::emitted::require_magnitude(#named, value, [#least, #largest], #text)?;
        }
    }

    /// Emits a check that refuses parameters for which the mass matrix is singular.
    fn regularity(&self) -> TokenStream {
        let runtime = self.runtime();
        let double = |quantity: &Quantity| self.quantity(quantity);
        let bodies = self.scene.links.iter().map(|link| {
            let what = format!(
                "moment of inertia of `{}` about its pivot, in some configuration,",
                link.name
            );
            let parent = match link.parent {
                Some(LinkId(index)) => {
                    let index = Literal::usize_unsuffixed(index);
                    quote!(::core::option::Option::Some(#index))
                }
                None => quote!(::core::option::Option::None),
            };
            let point = |offset: &Offset| {
                let (along, lateral) = (double(&offset.along), double(&offset.lateral));
                quote!([#along, #lateral])
            };
            let (mass, inertia) = (double(&link.mass), double(&link.inertia));
            let (com, pivot) = (point(&link.com), point(&link.pivot));
            quote! {
                #runtime::emitted::LinkBody {
                    what: #what,
                    parent: #parent,
                    mass: #mass,
                    inertia: #inertia,
                    com: #com,
                    pivot: #pivot,
                }
            }
        });
        let negligible = NEGLIGIBLE.map(float);
        quote!(#runtime::emitted::require_regular(&[#(#bodies),*], [#(#negligible),*])?;)
    }

    /// Emits one getter per named constant, separate from the functions of the state.
    pub(super) fn accessors(&self) -> TokenStream {
        let stored = self.stored_constants();
        let read = self.program.setup.stand_ins.iter();
        let mut read: Vec<(ConstantId, usize)> = read
            .filter(|(_, id)| stored.contains(id))
            .map(|(&index, &id)| (id, index))
            .collect();
        read.sort_unstable();
        let accessors = read.iter().map(|&(id, index)| {
            let constant = &self.mechanics.constants[index];
            let Symbol { text, code, .. } = self.letter(index);
            let value = constant_text(&constant.value, &self.mechanics.symbols);
            let docs = doc_lines(&[
                format!("{text} (in {}): {}.", constant.unit, constant.meaning),
                String::new(),
                format!("{text} = {value}"),
            ]);
            let (name, field) = (format_ident!("{code}"), self.field(id));
            quote! {
                #docs
                #[inline]
                #[must_use]
                pub fn #name(&self) -> T {
                    self.#field
                }
            }
        });
        let accessors: Vec<TokenStream> = accessors.collect();
        if accessors.is_empty() {
            return TokenStream::new();
        }
        let (name, runtime) = (&self.item.ident, self.runtime());
        quote! {
            /// Constants of the model.
            #[allow(dead_code)]
            impl<T: #runtime::Scalar> #name<T> {
                #(#accessors)*
            }
        }
    }
}
