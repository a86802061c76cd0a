//! The model type: constants, constructors, accessors.

use super::Emission;
use super::doc_text::doc_lines;
use super::quantities::{enclosed, product, sum};
use super::tokens::{Binding, number_tokens};
use crate::program::{ConstantDefinition, ConstantId, ConstantOp};
use crate::scene::{LinkId, Offset, ParameterId, Quantity, Sign};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

/// Traits that the model derives where its author does not.
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
            let field = self.field(id);
            quote!(#field: T)
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

    fn missing_derives(&self) -> TokenStream {
        let written: String = self
            .item
            .attrs
            .iter()
            .filter(|attribute| attribute.is("derive"))
            .map(|attribute| quote!(#attribute).to_string())
            .collect();
        let words: Vec<&str> = written
            .split(|c: char| !c.is_alphanumeric() && c != '_')
            .collect();
        let missing = DERIVED
            .iter()
            .filter(|name| !words.contains(*name))
            // Loops hold their constants on the heap.
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

    /// `let` lines for all stored constants, and the struct literal.
    fn constants(&self) -> TokenStream {
        if let Some(strips) = &self.program.strips {
            return self.strip_values(strips);
        }
        let (lines, fields) = self.constant_lines();
        quote! {
            #(#lines)*
            Self { #(#fields),* }
        }
    }

    /// `let` lines for all stored constants, and the names of their fields.
    fn constant_lines(&self) -> (Vec<TokenStream>, Vec<Ident>) {
        let stored = self.stored_constants();
        let fields: BTreeMap<ConstantId, Ident> =
            stored.iter().map(|&id| (id, self.field(id))).collect();
        let mut formed = self.shared_constants(&stored);
        formed.extend(stored);
        let (lines, _) = self.formed_lines(formed, |id| fields.get(&id).cloned());
        (lines, fields.into_values().collect())
    }

    /// Sums and products that several of the stored constants, or one in several places,
    /// are formed of: written out everywhere, code would grow as a power of their depth.
    fn shared_constants(&self, stored: &[ConstantId]) -> BTreeSet<ConstantId> {
        let setup = &self.program.setup;
        let is_formed = |definition: &ConstantDefinition| definition.exact.is_none();
        let mut readers: BTreeMap<ConstantId, usize> = BTreeMap::new();
        for id in setup.behind(stored.iter().copied(), is_formed) {
            let definition = setup.get(id);
            if is_formed(definition) {
                for (operand, times) in definition.op.readings() {
                    *readers.entry(operand).or_default() += times;
                }
            }
        }
        let is_shared = |&(id, count): &(ConstantId, usize)| {
            let definition = setup.get(id);
            let arithmetic = matches!(
                definition.op,
                ConstantOp::Product(..) | ConstantOp::Add(..) | ConstantOp::Sub(..)
            );
            count > 1 && arithmetic && is_formed(definition)
        };
        let shared = readers.into_iter().filter(is_shared);
        shared.map(|(id, _)| id).collect()
    }

    /// `let` lines for constants, operands first, with the names they have there: those by
    /// `field`, or their own.
    pub(super) fn formed_lines(
        &self,
        formed: BTreeSet<ConstantId>,
        field: impl Fn(ConstantId) -> Option<Ident>,
    ) -> (Vec<TokenStream>, BTreeMap<ConstantId, Ident>) {
        let mut known = BTreeMap::new();
        let mut lines = Vec::new();
        for id in formed {
            let own = || format_ident!("{}", self.program.setup.get(id).name);
            let name = field(id).unwrap_or_else(own);
            let (value, _) = self.constant_value(id, &known);
            lines.push(quote!(let #name = #value;));
            known.insert(id, name);
        }
        (lines, known)
    }

    pub(super) fn constant_value(
        &self,
        id: ConstantId,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> (TokenStream, Binding) {
        let definition = self.program.setup.get(id);
        if let Some(exact) = &definition.exact {
            return (number_tokens(exact), Binding::Atom);
        }
        let at = |operand: ConstantId| match known.get(&operand) {
            Some(name) => (quote!(#name), Binding::Atom),
            None => self.constant_value(operand, known),
        };
        match definition.op {
            ConstantOp::Number(ref number) => (number_tokens(number), Binding::Atom),
            ConstantOp::Parameter(index) => {
                let name = format_ident!("{}", self.scene.parameters[index].name);
                (quote!(parameters.#name), Binding::Atom)
            }
            ConstantOp::Named(_, formed) | ConstantOp::Called(formed) => at(formed),
            ConstantOp::Product(ref number, ref powers) => {
                let mut above = vec![(number_tokens(number), Binding::Atom)];
                let mut below = Vec::new();
                for &(id, power) in powers {
                    let side = if power > 0 { &mut above } else { &mut below };
                    side.extend(vec![at(id); power.unsigned_abs() as usize]);
                }
                // Multiplying by one changes no bit.
                if number.is_one() && above.len() > 1 {
                    above.remove(0);
                }
                let above = product(above);
                if below.is_empty() {
                    return above;
                }
                let above = enclosed(above, Binding::Product);
                let below = enclosed(product(below), Binding::Prefix);
                (quote!(#above / #below), Binding::Product)
            }
            ConstantOp::Add(a, b) => sum(vec![at(a), at(b)]),
            ConstantOp::Sub(a, b) => {
                let (a, b) = (at(a).0, enclosed(at(b), Binding::Product));
                (quote!(#a - #b), Binding::Sum)
            }
        }
    }

    /// Functions that form the constants, of numbers or of parameters.
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
                /// The model for the given parameters, taken as they are: for
                /// scalars without an order by which masses could be checked,
                /// as lanes and dual numbers. Others have `new`.
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
                /// The model in double precision, its constants rounded once
                /// from their exact values. `Default` builds it for other
                /// scalars.
                #[must_use]
                pub fn new() -> Self {
                    <Self as ::core::default::Default>::default()
                }
            }
        }
    }

    fn parameter_constructor(&self) -> TokenStream {
        let (vis, name, runtime) = (&self.item.vis, &self.item.ident, self.runtime());
        let parameters = format_ident!("{}Parameters", name);
        let fields = self.scene.parameters.iter().map(|parameter| {
            let field = format_ident!("{}", parameter.name);
            let docs = doc_lines(&[format!("{}.", parameter.doc)]);
            quote! {
                #docs
                #vis #field: T
            }
        });
        let doubles = self.scene.parameters.iter().map(|parameter| {
            let field = format_ident!("{}", parameter.name);
            quote!(#field: #runtime::scalar::Real::to_f64(given.#field))
        });
        let docs = format!(" Parameters of [`{name}`]. SI units.");
        let signed = |index: usize| {
            self.scene
                .requirements
                .iter()
                .any(|r| r.quantity == Quantity::Parameter(ParameterId(index)))
        };
        let finite = self
            .scene
            .parameters
            .iter()
            .enumerate()
            .filter(|(index, _)| !signed(*index))
            .map(|(_, parameter)| {
                let field = format_ident!("{}", parameter.name);
                let what = format!("parameter `{}`", parameter.name);
                self.requirement(&what, &quote!(parameters.#field), Sign::Any)
            });
        let signs = self.scene.requirements.iter().map(|requirement| {
            let value = self.quantity(&requirement.quantity);
            self.requirement(&requirement.what, &value, requirement.sign)
        });
        let regular = self.regularity();
        let parametric = self.parametric();
        quote! {
            #[doc = #docs]
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
            #vis struct #parameters<T = f64> {
                #(#fields),*
            }

            // As for the functions below.
            #[allow(dead_code, clippy::possible_missing_comma)]
            impl<T: #runtime::scalar::Real> #name<T> {
                /// The model for the given parameters, which are checked in
                /// double precision.
                ///
                /// # Errors
                /// A parameter that is not finite, one that makes a mass, an
                /// inertia or a friction coefficient impossible, or ones that
                /// make the mass matrix singular.
                pub fn new(
                    parameters: #parameters<T>,
                ) -> ::core::result::Result<Self, #runtime::ParameterError> {
                    let given = parameters;
                    let parameters = #parameters::<f64> {
                        #(#doubles),*
                    };
                    #(#finite)*
                    #(#signs)*
                    #regular
                    ::core::result::Result::Ok(Self::from_parameters_unchecked(given))
                }
            }

            #parametric
        }
    }

    /// Parameters by name and number, for what fits them to data.
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

    /// Returns an error unless the value meets the condition; a NaN never does.
    fn requirement(&self, what: &str, value: &TokenStream, sign: Sign) -> TokenStream {
        let runtime = self.runtime();
        let check = match sign {
            Sign::Any => quote!(require_finite),
            Sign::NonNegative => quote!(require_non_negative),
            Sign::Positive => quote!(require_positive),
        };
        quote!(#runtime::emitted::#check(#what, #value)?;)
    }

    /// Refuses parameters that make the mass matrix singular.
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
        quote!(#runtime::emitted::require_regular(&[#(#bodies),*])?;)
    }

    /// One reading function for each named constant.
    pub(super) fn accessors(&self) -> TokenStream {
        let accessors = self.stored_constants().into_iter().filter_map(|id| {
            let definition = self.program.setup.get(id);
            let ConstantOp::Named(index, _) = definition.op else {
                return None;
            };
            let constant = &self.mechanics.constants[index];
            let symbol = self.mechanics.symbols.get(constant.symbol);
            let docs = doc_lines(&[
                format!(
                    "{} (in {}): {}.",
                    symbol.text, constant.unit, constant.meaning
                ),
                String::new(),
                format!("{} = {}", symbol.text, self.text(&constant.value)),
            ]);
            let name = self.field(id);
            Some(quote! {
                #docs
                #[inline]
                #[must_use]
                pub fn #name(&self) -> T {
                    self.#name
                }
            })
        });
        quote!(#(#accessors)*)
    }
}
