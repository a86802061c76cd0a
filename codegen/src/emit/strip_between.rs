//! Springs and friction between links of trees in loops, and forces along lines between their
//! points.

use super::Emission;
use crate::program::{
    ConstantId, LineConstants, LinePotentialConstants, LoopTree, SpringDamperConstants,
};
use crate::scene::{Layout, PairRun, PassiveTorques};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeMap;

impl Emission<'_> {
    /// Emits `.with_spring_dampers(…)`, if springs or friction act between links that are not
    /// parent and child.
    pub(super) fn spring_dampers(
        &self,
        strips: &LoopTree,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> Option<TokenStream> {
        let (runtime, links) = (self.runtime(), self.links_in_loops());
        let runs = strips.spring_dampers.iter();
        let runs = runs.map(|own| self.runs_of(own, known));
        let all = runs.reduce(|all, own| quote!(::core::iter::Iterator::chain(#all, #own)))?;
        Some(quote! {
            .with_spring_dampers(
                #runtime::spring_dampers::SpringDampers::of_runs(#links, #all).unwrap_or_default()
            )
        })
    }

    /// Emits `.with_translational_spring_dampers(…)`, if forces act along lines.
    pub(super) fn translational_spring_dampers(
        &self,
        strips: &LoopTree,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> Option<TokenStream> {
        let (runtime, links) = (self.runtime(), self.links_in_loops());
        let runs = strips.lines.iter().map(|own| self.lines_of(own, known));
        let all = runs.reduce(|all, own| quote!(::core::iter::Iterator::chain(#all, #own)))?;
        let of_runs = quote!(#runtime::translational::TranslationalSpringDampers::of_runs);
        Some(quote! {
            .with_translational_spring_dampers(#of_runs(#links, #all).unwrap_or_default())
        })
    }

    fn links_in_loops(&self) -> Literal {
        match self.scene.layout {
            Layout::Generations { links, .. } => Literal::usize_unsuffixed(links),
            Layout::Unrolled | Layout::Links => self.links(),
        }
    }

    /// Emits the runs of lines with the same constants, as an iterator.
    fn lines_of(&self, own: &LineConstants, known: &BTreeMap<ConstantId, Ident>) -> TokenStream {
        let lines = {
            let runtime = self.runtime();
            quote!(#runtime::translational)
        };
        let value = |id: ConstantId| self.known_value(id, known);
        let option = |id: Option<ConstantId>| match id.map(value) {
            Some(value) => quote!(::core::option::Option::Some(#value)),
            None => quote!(::core::option::Option::None),
        };
        let list = |members: Vec<TokenStream>| {
            quote! {
                ::core::iter::Iterator::collect(::core::iter::IntoIterator::into_iter([#(#members),*]))
            }
        };
        let links: Vec<Ident> = (1..=own.arms.len())
            .map(|number| format_ident!("link_{number}"))
            .collect();
        let arms = links.iter().zip(&own.arms);
        let arms = arms.map(|(link, &[along, across])| {
            let [along, across] = [along, across].map(value);
            quote!(#lines::LineArm { link: #link, along: #along, lateral: #across })
        });
        let potentials = own.potentials.iter().map(|potential| match *potential {
            LinePotentialConstants::Spring { stiffness, rest } => {
                let (stiffness, rest) = (value(stiffness), option(rest));
                quote!(#lines::LinePotential::Spring { stiffness: #stiffness, rest: #rest })
            }
            LinePotentialConstants::InversePower { strength, exponent } => {
                let strength = value(strength);
                let exponent = Literal::u32_unsuffixed(exponent);
                quote! {
                    #lines::LinePotential::InversePower { strength: #strength, exponent: #exponent }
                }
            }
        });
        let (arms, potentials) = (list(arms.collect()), list(potentials.collect()));
        let [x, y] = own.offset.map(value);
        let friction = option(own.friction);
        let runs = own.runs.iter().map(|(links, count)| {
            let numbers = links.iter().chain([count]);
            let numbers = numbers.map(|&number| Literal::usize_unsuffixed(number));
            quote!([#(#numbers),*])
        });
        quote! {
            ::core::iter::IntoIterator::into_iter([#(#runs),*].map(|[#(#links,)* count]| {
                let first = #lines::TranslationalSpringDamper {
                    arms: #arms,
                    offset: [#x, #y],
                    potentials: #potentials,
                    friction: #friction,
                };
                (first, count)
            }))
        }
    }

    /// Returns true if some line stores energy.
    pub(super) fn stores_along_lines(&self) -> bool {
        let mut lines = self.scene.translational.iter();
        lines.any(|own| !own.potentials.is_empty())
    }

    /// Returns true if some line has a viscous damper.
    pub(super) fn is_damped_along_lines(&self) -> bool {
        let mut lines = self.scene.translational.iter();
        lines.any(|own| !own.friction.is_zero())
    }

    /// Returns true if torques for which `kind` is true act between links that are not parent and
    /// child.
    pub(super) fn is_coupled_by(&self, kind: impl Fn(&PassiveTorques) -> bool) -> bool {
        let mut between = self.scene.spring_dampers.iter();
        between.any(|own| kind(&own.torques) && !self.scene.pair_runs(&own.ends).is_empty())
    }

    /// Emits the runs of one spring-damper, as an iterator.
    fn runs_of(
        &self,
        own: &SpringDamperConstants,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> TokenStream {
        let runtime = self.runtime();
        let [spring, rest, friction] =
            [own.spring, own.rest, own.friction].map(|id| self.known_value(id, known));
        let law = match &own.law {
            Some(law) => {
                let law = law.map(|id| self.known_value(id, known));
                quote! {
                    ::core::option::Option::Some(
                        #runtime::friction::FrictionLaw::of_constants([#(#law),*]),
                    )
                }
            }
            None => quote!(::core::option::Option::None),
        };
        let pairs = own.pairs.iter().map(|PairRun { first, count }| {
            let [a, b, count] = [first[0], first[1], *count].map(Literal::usize_unsuffixed);
            quote!([#a, #b, #count])
        });
        quote! {
            ::core::iter::IntoIterator::into_iter([#(#pairs),*].map(|[a, b, count]| {
                let first = #runtime::spring_dampers::SpringDamper {
                    links: [a, b],
                    spring: #spring,
                    rest: #rest,
                    friction: #friction,
                    law: #law,
                };
                (first, count)
            }))
        }
    }
}
