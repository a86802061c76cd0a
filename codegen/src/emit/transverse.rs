//! Small differences beside an in-phase motion: docs, formulas and the runtime's trait.

use super::Emission;
use super::formulas::DocFormula;
use super::tokens::ident;
use crate::mechanics::TransverseFormulas;
use crate::mechanics::expression::Expr;
use crate::program::Purpose;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

impl Emission<'_> {
    /// Number of links of a transverse sector.
    pub(super) fn transverse_links(&self, sector: usize) -> usize {
        self.transverse_sector(sector).sector.links
    }

    pub(super) fn transverse_sector(&self, sector: usize) -> &TransverseFormulas {
        let transverse = self.mechanics.transverse.as_ref();
        match transverse.and_then(|transverse| transverse.sectors.get(sector)) {
            Some(formulas) => formulas,
            None => unreachable!("an entry of a transverse sector that was not derived"),
        }
    }

    pub(super) fn transverse_meaning(&self, purpose: Purpose) -> Vec<String> {
        let pattern = |sector: usize| {
            let sector = &self.transverse_sector(sector).sector;
            let (name, copies) = (&sector.name, sector.copies);
            match copies {
                2 => format!("the two copies of `{name}` have the angles θ ± δ"),
                _ => format!(
                    "the {copies} copies of `{name}` have the angles θ + e_c δ with Σ e_c = 0 and Σ e_c² = {copies}"
                ),
            }
        };
        let below = "and so do the links that hang from them";
        match purpose {
            Purpose::Transverse(sector) => vec![
                format!(
                    "Second time derivatives (in rad/s²) of small differences `difference` δ (in rad) with rates `difference_rate` (in rad/s) beside the {}in-phase motion: {}, {below}.",
                    self.at_time(),
                    pattern(sector)
                ),
                String::new(),
                "That motion has angles `theta` (in rad), angular velocities `omega` (in rad/s) and accelerations `alpha` (in rad/s²), as `accelerations` gives them. Linear in δ and exact for infinitesimal ones; for one link Hill's equation.".into(),
                String::new(),
                "```text".into(),
                "M(θ) δ̈ + r(θ, ω, α, δ, δ̇) = 0".into(),
                "```".into(),
            ],
            Purpose::TransverseEnergy(sector) => vec![format!(
                "Energy (in J) of small differences, quadratic in them, in the copies under one link: {}, {below}. Its potential part is that about hanging links.",
                pattern(sector)
            )],
            Purpose::TransverseTransfer(sector) => vec![format!(
                "Energy transfer W (in W) into small differences: the rate of their energy but for friction and drag, quadratic in them: {}, {below}.",
                pattern(sector)
            )],
            _ => vec!["Power (in W) of friction and drag on the energy of small differences.".into()],
        }
    }

    pub(super) fn transverse_formulas(&self, purpose: Purpose) -> Vec<DocFormula> {
        let simple = |left: &str, right: &Expr| {
            vec![DocFormula {
                left: left.to_owned(),
                left_latex: left.to_owned(),
                right: right.clone(),
            }]
        };
        match purpose {
            Purpose::Transverse(sector) => {
                let formulas = self.transverse_sector(sector);
                let mut rows = Vec::new();
                for (symbol, residual) in formulas.differences.iter().zip(&formulas.residual) {
                    let symbol = self.mechanics.symbols.get(*symbol);
                    let name = symbol.text.trim_start_matches("δ_");
                    let tex = symbol.latex.trim_start_matches("\\delta");
                    rows.push(DocFormula {
                        left: format!("r_{name}"),
                        left_latex: format!("r{tex}"),
                        right: residual.clone(),
                    });
                }
                rows
            }
            Purpose::TransverseEnergy(sector) => {
                simple("E", &self.transverse_sector(sector).energy)
            }
            Purpose::TransverseTransfer(sector) => {
                simple("W", &self.transverse_sector(sector).transfer)
            }
            Purpose::TransverseFriction(sector) => {
                simple("P", &self.transverse_sector(sector).friction)
            }
            _ => Vec::new(),
        }
    }

    /// `impl Transverse`; NaN for slices of a wrong length.
    pub(super) fn transverse_trait(&self) -> Option<TokenStream> {
        let transverse = self.mechanics.transverse.as_ref()?;
        let (name, runtime, links) = (&self.item.ident, self.runtime(), self.links());
        let sectors = transverse.sectors.iter().map(|formulas| {
            let sector = &formulas.sector;
            let [first, links, copies, holders] =
                [sector.first.0, sector.links, sector.copies, sector.holders]
                    .map(Literal::usize_unsuffixed);
            let name = &sector.name;
            quote! {
                #runtime::system::TransverseSector {
                    name: #name,
                    first: #first,
                    links: #links,
                    copies: #copies,
                    holders: #holders,
                }
            }
        });
        let arms = |call: &dyn Fn(&TransverseFormulas) -> TokenStream| -> Vec<TokenStream> {
            let arms = transverse
                .sectors
                .iter()
                .enumerate()
                .map(|(number, formulas)| {
                    let (number, call) = (Literal::usize_unsuffixed(number), call(formulas));
                    quote!(#number => #call,)
                });
            arms.collect()
        };
        let timed = self.mechanics.drive.is_some();
        let (time, handed) = match timed {
            true => (quote!(time), quote!(time,)),
            false => (quote!(_time), TokenStream::new()),
        };
        let nan = quote!(T::from_f64(f64::NAN));
        let array = |of: &Literal, what: TokenStream| quote!(<&[T; #of] as ::core::convert::TryFrom<&[T]>>::try_from(#what));
        let motion = ["theta", "omega", "alpha"].map(|field| {
            let field = ident(field);
            array(&links, quote!(motion.#field))
        });
        let small = |formulas: &TransverseFormulas| {
            let size = Literal::usize_unsuffixed(formulas.sector.links);
            ["difference", "difference_rate"].map(|argument| {
                let argument = ident(argument);
                array(&size, quote!(#argument))
            })
        };
        let ok = quote!(::core::result::Result::Ok);
        let accelerations = arms(&|formulas| {
            let function = format_ident!("transverse_accelerations_{}", formulas.sector.name);
            let small = small(formulas);
            let size = Literal::usize_unsuffixed(formulas.sector.links);
            quote! {
                match (#(#motion,)* #(#small,)*) {
                    (#ok(theta), #ok(omega), #ok(alpha), #ok(difference), #ok(difference_rate))
                        if accelerations.len() == #size =>
                    {
                        accelerations.copy_from_slice(&self.#function(
                            #handed theta, omega, alpha, difference, difference_rate,
                        ));
                    }
                    _ => accelerations.fill(#nan),
                }
            }
        });
        let energies = arms(&|formulas| {
            let function = format_ident!("transverse_energy_{}", formulas.sector.name);
            let small = small(formulas);
            let theta = array(&links, quote!(theta));
            quote! {
                match (#theta, #(#small,)*) {
                    (#ok(theta), #ok(difference), #ok(difference_rate)) => {
                        self.#function(theta, difference, difference_rate)
                    }
                    _ => #nan,
                }
            }
        });
        let transfers = arms(&|formulas| {
            let function = format_ident!("transverse_transfer_{}", formulas.sector.name);
            let small = small(formulas);
            quote! {
                match (#(#motion,)* #(#small,)*) {
                    (#ok(theta), #ok(omega), #ok(alpha), #ok(difference), #ok(difference_rate)) => {
                        self.#function(
                            #handed theta, omega, alpha, difference, difference_rate,
                        )
                    }
                    _ => #nan,
                }
            }
        });
        let powers = arms(&|formulas| {
            let size = Literal::usize_unsuffixed(formulas.sector.links);
            let rate = array(&size, quote!(difference_rate));
            let value = match formulas.friction.is_zero() {
                true => quote!(#ok(_) => T::from_f64(0.0)),
                false => {
                    let function =
                        format_ident!("transverse_friction_power_{}", formulas.sector.name);
                    quote!(#ok(difference_rate) => self.#function(difference_rate))
                }
            };
            quote! {
                match #rate {
                    #value,
                    ::core::result::Result::Err(_) => #nan,
                }
            }
        });
        Some(quote! {
            impl<T: #runtime::Scalar> #runtime::Transverse<T> for #name<T> {
                const TRANSVERSE: &'static [#runtime::system::TransverseSector] =
                    &[#(#sectors),*];

                #[inline]
                fn transverse_accelerations_into(
                    &self,
                    sector: usize,
                    #time: T,
                    motion: #runtime::system::InPhaseMotion<'_, T>,
                    difference: &[T],
                    difference_rate: &[T],
                    accelerations: &mut [T],
                ) {
                    match sector {
                        #(#accelerations)*
                        _ => accelerations.fill(#nan),
                    }
                }

                #[inline]
                fn transverse_energy_of(
                    &self,
                    sector: usize,
                    theta: &[T],
                    difference: &[T],
                    difference_rate: &[T],
                ) -> T {
                    match sector {
                        #(#energies)*
                        _ => #nan,
                    }
                }

                #[inline]
                fn transverse_transfer_of(
                    &self,
                    sector: usize,
                    #time: T,
                    motion: #runtime::system::InPhaseMotion<'_, T>,
                    difference: &[T],
                    difference_rate: &[T],
                ) -> T {
                    match sector {
                        #(#transfers)*
                        _ => #nan,
                    }
                }

                #[inline]
                fn transverse_friction_power_of(
                    &self,
                    sector: usize,
                    difference_rate: &[T],
                ) -> T {
                    match sector {
                        #(#powers)*
                        _ => #nan,
                    }
                }
            }
        })
    }
}
