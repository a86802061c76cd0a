//! Small differences beside an in-phase motion: docs, formulas and the runtime's trait.

use super::Emission;
use super::computes::SliceFunction;
use crate::functions::Purpose;
use crate::mechanics::TransverseFormulas;
use crate::mechanics::expression::{Expr, NamedFormula};
use crate::scene::TransverseCopies;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

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
            Purpose::TransverseMotion(sector) => vec![
                format!(
                    "Angular accelerations (in rad/s²) of the {}in-phase motion, as [`accelerations`](Self::accelerations) gives them, and after them those of small differences beside it: {}, {below}. Sines, cosines and couplings are formed once for both.",
                    self.at_time(),
                    pattern(sector)
                ),
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

    pub(super) fn transverse_formulas(&self, purpose: Purpose) -> Vec<NamedFormula> {
        let simple = |left: &str, right: &Expr| vec![NamedFormula::of_letter(left, right)];
        match purpose {
            Purpose::Transverse(sector) => {
                let formulas = self.transverse_sector(sector);
                let mut rows = Vec::new();
                for (symbol, residual) in formulas.differences.iter().zip(&formulas.residual) {
                    let symbol = self.mechanics.symbols.get(*symbol);
                    let name = symbol.text.trim_start_matches("δ_");
                    let tex = symbol.latex.trim_start_matches("\\delta");
                    let latex = format!("r{tex}");
                    rows.push(NamedFormula::new(format!("r_{name}"), latex, residual));
                }
                rows
            }
            Purpose::TransverseEnergy(sector) => {
                simple("E", &self.transverse_sector(sector).energy)
            }
            Purpose::TransverseTransfer(sector) => {
                simple("W", &self.transverse_sector(sector).transfer)
            }
            Purpose::TransverseFriction(sector, _) => {
                simple("P", &self.transverse_sector(sector).friction)
            }
            _ => Vec::new(),
        }
    }

    /// `impl Transverse`; NaN for slices of a wrong length.
    pub(super) fn transverse_trait(&self) -> Option<TokenStream> {
        let transverse = self.mechanics.transverse.as_ref()?;
        let (name, runtime) = (&self.item.ident, self.runtime());
        let sectors = transverse.sectors.iter();
        let sectors = sectors.map(|formulas| self.sector_constant(&formulas.sector));
        let time = self.time_name();
        let unknown = self.unknown(&["accelerations"]);
        let accelerations = self.match_sector(&unknown, |number, _| {
            self.fill("accelerations", Purpose::Transverse(number))
        });
        let energies = self.transverse_energies();
        let both = self.motion_with_differences();
        Some(quote! {
            #both

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

    /// The functions of the energy of small differences, and of what changes it.
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

    /// Accelerations of the in-phase motion and of small differences, as one function.
    fn motion_with_differences(&self) -> TokenStream {
        let unknown = self.unknown(&["accelerations"]);
        let accelerations = self.match_sector(&unknown, |number, _| {
            self.fill("accelerations", Purpose::TransverseMotion(number))
        });
        let function = SliceFunction {
            name: "LinearDifferences",
            given: &["theta", "omega", "difference", "difference_rate"],
            results: &["accelerations"],
            index: Some("sector"),
        };
        self.computes(&function, &accelerations, None)
    }

    /// The trait's power of friction at a motion, where some sector's depends on that.
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

    /// `TransverseCopies { … }`.
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

    /// The power of friction of sectors where it depends on the motion, and of the others.
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

    /// The function for the power of friction, which takes the rates alone and may be zero. None
    /// where it takes the motion too.
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

    /// `match sector { 0 => …, … }`, a value of each sector, and one where there is none.
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

/// Stand-in for a number that there is not.
fn nan() -> TokenStream {
    quote!(T::from_f64(f64::NAN))
}
