//! Small differences on an in-phase motion: docs, formulas and the runtime's trait.

use super::Emission;
use crate::functions::Purpose;
use crate::mechanics::TransverseFormulas;
use crate::mechanics::expression::NamedFormula;
use crate::scene::TransverseCopies;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// Returns the number of links in a transverse sector.
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

    /// Describes the angles of the copies in a transverse sector.
    fn copies_pattern(&self, sector: usize) -> String {
        let sector = &self.transverse_sector(sector).sector;
        let (name, copies) = (&sector.name, sector.copies);
        match copies {
            2 => format!("the two copies of `{name}` have the angles θ ± δ"),
            _ => format!(
                "the {copies} copies of `{name}` have the angles θ + e_c δ with Σ e_c = 0 and Σ e_c² = {copies}"
            ),
        }
    }

    /// Returns the documentation of the accelerations of small differences.
    pub(super) fn transverse_meaning(&self, sector: usize) -> Vec<String> {
        vec![
                format!(
                    "Second time derivatives (in rad/s²) of small differences `difference` δ (in rad) with rates `difference_rate` (in rad/s) from the {}in-phase motion: {}, as do the links that hang from them.",
                    self.at_time(),
                    self.copies_pattern(sector)
                ),
                String::new(),
                "That motion has angles `theta` (in rad), angular velocities `omega` (in rad/s) and accelerations `alpha` (in rad/s²), as `accelerations` returns them. The equations are linear in δ and exact for infinitesimal differences; for one link they are Hill's equation.".into(),
                String::new(),
                "```text".into(),
                "M(θ) δ̈ + r(θ, ω, α, δ, δ̇) = 0".into(),
                "```".into(),
            ]
    }

    /// Returns the documentation of the in-phase motion together with small differences.
    pub(super) fn transverse_motion_meaning(&self, sector: usize) -> Vec<String> {
        vec![format!(
            "Angular accelerations (in rad/s²) of the {}in-phase motion, as [`accelerations`](Self::accelerations) returns them, followed by those of small differences from it: {}, as do the links that hang from them. Sines, cosines and couplings are computed once for both.",
            self.at_time(),
            self.copies_pattern(sector)
        )]
    }

    /// Returns the documentation of the energy of small differences.
    pub(super) fn transverse_energy_meaning(&self, sector: usize) -> Vec<String> {
        vec![format!(
            "Energy (in J) of small differences, quadratic in them, in the copies under one link: {}, as do the links that hang from them. Its potential part is that about the hanging tree.",
            self.copies_pattern(sector)
        )]
    }

    /// Returns the documentation of the energy transfer into small differences.
    pub(super) fn transverse_transfer_meaning(&self, sector: usize) -> Vec<String> {
        vec![format!(
            "Energy transfer W (in W) into small differences: the rate of their energy without friction and drag, quadratic in them: {}, as do the links that hang from them.",
            self.copies_pattern(sector)
        )]
    }

    /// Returns the formulas of the residual torques on small differences, one row per difference.
    pub(super) fn transverse_residuals(&self, sector: usize) -> Vec<NamedFormula> {
        let formulas = self.transverse_sector(sector);
        let rows = formulas.differences.iter().zip(&formulas.residual);
        let rows = rows.map(|(symbol, residual)| {
            let symbol = self.mechanics.symbols.get(*symbol);
            let name = symbol.text.trim_start_matches("δ_");
            let tex = symbol.latex.trim_start_matches("\\delta");
            NamedFormula::new(format!("r_{name}"), format!("r{tex}"), residual)
        });
        rows.collect()
    }

    /// Emits `impl Transverse`; slices of a wrong length give NaN.
    pub(super) fn transverse_trait(&self) -> Option<TokenStream> {
        let transverse = self.mechanics.transverse.as_ref()?;
        let (name, runtime) = (&self.item.ident, self.runtime());
        let sectors = transverse.sectors.iter();
        let sectors = sectors.map(|formulas| self.sector_constant(&formulas.sector));
        let time = self.time_name();
        let unknown = self.unknown(&["accelerations"]);
        let accelerations = self.match_sector(&unknown, |number, _| {
            self.fill(&["accelerations"], Purpose::Transverse(number))
        });
        let energies = self.transverse_energies();
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
                    let #runtime::system::InPhaseMotion { theta, omega, alpha } = motion;
                    #accelerations
                }

                #energies
            }
        })
    }

    /// Emits the functions of the energy of small differences, and of its rates.
    fn transverse_energies(&self) -> TokenStream {
        let (runtime, time) = (self.runtime(), self.time_name());
        let energy = self.match_sector(&nan(), |number, _| {
            self.value_at_slices(Purpose::TransverseEnergy(number))
        });
        let transfer = self.match_sector(&nan(), |number, _| {
            self.value_at_slices(Purpose::TransverseTransfer(number))
        });
        let power = self.friction_by_sector();
        let along = self.braked_power();
        quote! {
            #[inline]
            fn transverse_energy_of(
                &self,
                sector: usize,
                theta: &[T],
                difference: &[T],
                difference_rate: &[T],
            ) -> T {
                #energy
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
                let #runtime::system::InPhaseMotion { theta, omega, alpha } = motion;
                #transfer
            }

            #[inline]
            fn transverse_friction_power_of(
                &self,
                sector: usize,
                difference_rate: &[T],
            ) -> T {
                #power
            }

            #along
        }
    }

    /// Emits the trait's power of friction at a state of motion, if in some sector this power
    /// depends on the motion.
    fn braked_power(&self) -> Option<TokenStream> {
        let transverse = self.mechanics.transverse.as_ref()?;
        let mut sectors = transverse.sectors.iter();
        sectors.any(|formulas| formulas.braked).then(|| {
            let (power, runtime) = (self.friction_along(), self.runtime());
            quote! {
                #[inline]
                fn transverse_friction_power_along(
                    &self,
                    sector: usize,
                    motion: #runtime::system::InPhaseMotion<'_, T>,
                    difference_rate: &[T],
                ) -> T {
                    #power
                }
            }
        })
    }

    /// Emits `TransverseCopies { … }`.
    fn sector_constant(&self, sector: &TransverseCopies) -> TokenStream {
        let TransverseCopies {
            name,
            first,
            links,
            copies,
            holders,
        } = sector;
        let [first, links, copies, holders] =
            [first.0, *links, *copies, *holders].map(Literal::usize_unsuffixed);
        let runtime = self.runtime();
        quote! {
            #runtime::system::TransverseSector {
                name: #name,
                first: #first,
                links: #links,
                copies: #copies,
                holders: #holders,
            }
        }
    }

    /// Emits the power of friction of the sectors in which it depends on the motion, and of the
    /// others.
    fn friction_along(&self) -> TokenStream {
        let runtime = self.runtime();
        self.match_sector(&nan(), |number, formulas| match formulas.braked {
            true => {
                let power = self.value_at_slices(Purpose::TransverseFriction(number, true));
                quote! {{
                    let omega = motion.omega;
                    #power
                }}
            }
            false => quote! {
                #runtime::Transverse::transverse_friction_power_of(self, sector, difference_rate)
            },
        })
    }

    /// Emits the power of friction of the sectors in which it depends on the motion, and of the
    /// other sectors.
    fn friction_by_sector(&self) -> TokenStream {
        let runtime = self.runtime();
        self.match_sector(&nan(), |number, formulas| {
            let links = Literal::usize_unsuffixed(formulas.sector.links);
            match (formulas.friction.is_zero(), formulas.braked) {
                (true, _) => quote! {
                    match #runtime::emitted::arrays::<T, #links, 1>([difference_rate]) {
                        ::core::option::Option::Some(_) => T::from_f64(0.0),
                        _ => T::from_f64(f64::NAN),
                    }
                },
                (_, true) => nan(),
                _ => self.value_at_slices(Purpose::TransverseFriction(number, false)),
            }
        })
    }

    /// Emits the function for the power of friction on the differences, which may be zero. `None`
    /// if the power depends on the in-phase motion too.
    fn match_sector(
        &self,
        none: &TokenStream,
        of_sector: impl Fn(usize, &TransverseFormulas) -> TokenStream,
    ) -> TokenStream {
        let transverse = self.mechanics.transverse.iter();
        let sectors = transverse.flat_map(|transverse| &transverse.sectors);
        let arms = sectors.enumerate().map(|(number, formulas)| {
            let value = of_sector(number, formulas);
            let number = Literal::usize_unsuffixed(number);
            quote!(#number => #value)
        });
        quote! {
            match sector {
                #(#arms,)*
                _ => #none,
            }
        }
    }
}

/// Returns an expression for NaN, which is returned for a quantity that does not exist.
fn nan() -> TokenStream {
    quote!(T::from_f64(f64::NAN))
}
