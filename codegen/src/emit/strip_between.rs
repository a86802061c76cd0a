//! Springs and friction between links of trees in loops.

use super::Emission;
use crate::program::{ConstantId, LoopTree, SpringDamperConstants};
use crate::scene::{Layout, PairRun, PassiveTorques};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use std::collections::BTreeMap;

impl Emission<'_> {
    /// `.with_spring_dampers(…)`, where something acts between links that are not parent and
    /// child.
    pub(super) fn spring_dampers(
        &self,
        strips: &LoopTree,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> Option<TokenStream> {
        let runtime = self.runtime();
        let links = match self.scene.layout {
            Layout::Generations { links, .. } => Literal::usize_unsuffixed(links),
            _ => self.links(),
        };
        let runs = strips.spring_dampers.iter();
        let runs = runs.map(|own| self.runs_of(own, known));
        let all = runs.reduce(|all, own| quote!(::core::iter::Iterator::chain(#all, #own)))?;
        Some(quote! {
            .with_spring_dampers(
                #runtime::spring_dampers::SpringDampers::of_runs(#links, #all).unwrap_or_default()
            )
        })
    }

    /// Returns true if torques of that kind act between links that are not parent and child.
    pub(super) fn is_coupled_by(&self, kind: impl Fn(&PassiveTorques) -> bool) -> bool {
        let mut between = self.scene.spring_dampers.iter();
        between.any(|own| kind(&own.torques) && !self.scene.pair_runs(&own.ends).is_empty())
    }

    /// The runs of one of them, as an iterator.
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
                quote!(::core::option::Option::Some([#(#law),*]))
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
