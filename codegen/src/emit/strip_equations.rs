//! Equations of one link of a tree in loops, as an implementation of the runtime's trait.

use super::Emission;
use super::doc_text::doc_lines;
use super::tokens::ident;
use crate::functions::{Argument, LinkFunction, Purpose};
use crate::program::{Entry, LoopTree, Op};
use crate::scene::Layout;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

impl Emission<'_> {
    /// Emits the equations of one link: a type without values, and its trait.
    pub(super) fn link_equations(&self, strips: &LoopTree) -> TokenStream {
        let (vis, name, runtime) = (&self.item.vis, self.equations_name(), self.runtime());
        let docs = doc_lines(&self.equations_docs());
        let length = |argument| Literal::usize_unsuffixed(strips.length(argument));
        let [constants, response, sums, elimination, carried] = [
            Argument::Constants,
            Argument::Response,
            Argument::Sums,
            Argument::Elimination,
            Argument::Carried,
        ]
        .map(length);
        let generations = self.generations();
        let parts = link_parts(strips);
        let functions = LinkFunction::ALL.into_iter();
        let functions = functions.filter_map(|function| self.link_function(function));
        quote! {
            #docs
            #[derive(
                ::core::clone::Clone,
                ::core::marker::Copy,
                ::core::fmt::Debug,
                ::core::cmp::PartialEq,
            )]
            #vis struct #name;

            // For the lint about commas: all tokens have the span of the attribute, see `emit`.
            #[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
            impl #runtime::tree::LinkEquations for #name {
                type Constants<T: #runtime::Scalar> = [T; #constants];
                type Response<T: #runtime::Scalar> = [T; #response];
                type Sums<T: #runtime::Scalar> = [T; #sums];
                type Elimination<T: #runtime::Scalar> = [T; #elimination];
                type Carried<T: #runtime::Scalar> = [T; #carried];

                #generations
                #parts

                #(#functions)*
            }
        }
    }

    /// Emits copies and names of the generations of a rule-based tree.
    fn generations(&self) -> TokenStream {
        let (mut copies, mut names) = (Vec::new(), Vec::new());
        if let Layout::Generations { branching, .. } = self.scene.layout {
            for (generation, link) in self.scene.links.iter().enumerate() {
                let number = if generation == 0 { 1 } else { branching };
                copies.push(Literal::usize_unsuffixed(number));
                names.push(&link.name);
            }
        }
        quote! {
            const COPIES: &'static [usize] = &[#(#copies),*];
            const NAMES: &'static [&'static str] = &[#(#names),*];
        }
    }

    /// Emits a function of the trait.
    fn link_function(&self, function: LinkFunction) -> Option<TokenStream> {
        let result = match function {
            LinkFunction::Leaf => quote!(Self::Response<T>),
            LinkFunction::Attach => quote!(Self::Sums<T>),
            LinkFunction::Inner => quote!((Self::Response<T>, Self::Elimination<T>)),
            LinkFunction::Pivot => quote!([T; 2]),
            LinkFunction::Accelerate => quote!((T, Self::Carried<T>)),
            LinkFunction::AccelerateLeaf => quote!(T),
        };
        self.equation_function(Purpose::Link(function), &result)
    }

    /// Emits a function of a trait that contains equations, from its entry point.
    pub(super) fn equation_function(
        &self,
        purpose: Purpose,
        result: &TokenStream,
    ) -> Option<TokenStream> {
        let entry = self.entry(purpose)?;
        let (runtime, docs, name) = (self.runtime(), self.entry_docs(entry), ident(&entry.name));
        let body = match self.last_argument(entry) {
            Some(body) => body,
            None => self.plain_body(entry),
        };
        let arguments = entry.arguments.iter().map(|&argument| {
            let name = ident(argument.name());
            let kind = match argument {
                Argument::Constants => quote!(&Self::Constants<T>),
                Argument::Body => quote!(&Self::Body<T>),
                Argument::Motion => quote!(#runtime::tree::LinkMotion<T>),
                Argument::Response => quote!(Self::Response<T>),
                Argument::Sums => quote!(Self::Sums<T>),
                Argument::Elimination => quote!(Self::Elimination<T>),
                Argument::Carried => quote!(Self::Carried<T>),
                Argument::Given(names) => {
                    let given = Literal::usize_unsuffixed(names.len());
                    quote!([T; #given])
                }
                Argument::Pivot => quote!([T; 2]),
                Argument::Time
                | Argument::Theta
                | Argument::Omega
                | Argument::AbsoluteMomenta
                | Argument::Coordinates
                | Argument::Rates
                | Argument::Momenta
                | Argument::Forces
                | Argument::Alpha
                | Argument::Weights
                | Argument::Actions
                | Argument::Difference(_)
                | Argument::DifferenceRate(_)
                | Argument::SmallDifferences
                | Argument::SmallRates
                | Argument::Torques
                | Argument::SmallTorques
                | Argument::Prescribed(_)
                | Argument::Absolute
                | Argument::Symmetric => {
                    unreachable!(
                        "`{}` is not an argument of one link's functions",
                        argument.name()
                    )
                }
            };
            quote!(#name: #kind)
        });
        Some(quote! {
            #docs
            #[inline(always)]
            fn #name<T: #runtime::Scalar>(#(#arguments),*) -> #result {
                #body
            }
        })
    }

    /// Returns the body of a function that returns its last argument unchanged.
    fn last_argument(&self, entry: &Entry) -> Option<TokenStream> {
        let (&last, others) = entry.arguments.split_last()?;
        let mut outputs = (0..).zip(&entry.outputs);
        let same = outputs.all(|(index, &id)| *self.op(id) == Op::Input(last, index));
        let names = others
            .iter()
            .map(|argument| format_ident!("{}", argument.name()));
        let last = format_ident!("{}", last.name());
        same.then(|| quote!(#(let _ = #names;)* #last))
    }
}

/// Emits those parts of the equations of one link that depend on the scene: torques in joints, of
/// the drive on the root, external torques, torques between links, and links with prescribed
/// motion.
fn link_parts(strips: &LoopTree) -> TokenStream {
    let (joints, torque) = (strips.has_joint_torques, strips.has_drive_torque);
    let forced = strips.has_outside_torques.then(|| {
        quote!(
            const FORCED: bool = true;
        )
    });
    let prescribed = strips.has_prescribed_links.then(|| {
        quote!(
            const PRESCRIBED: bool = true;
        )
    });
    let coupled = strips.is_coupled().then(|| {
        quote!(
            const COUPLED: bool = true;
        )
    });
    quote! {
        const JOINTS: bool = #joints;
        const TORQUE: bool = #torque;
        #forced
        #coupled
        #prescribed
    }
}
