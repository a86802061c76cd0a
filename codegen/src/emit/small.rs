//! Small differences that act back: names, docs, formulas and the runtime's trait.

use super::Emission;
use super::computes::SliceFunction;
use crate::functions::{Argument, Purpose};
use crate::mechanics::SmallMechanics;
use crate::mechanics::expression::NamedFormula;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    fn small_mechanics(&self) -> Option<&SmallMechanics> {
        self.mechanics.transverse.as_ref()?.small.as_ref()
    }

    /// Number of differences that act back.
    pub(super) fn small_count(&self) -> usize {
        let sectors = self.scene.requests.small.iter();
        sectors.map(|&sector| self.transverse_links(sector)).sum()
    }

    /// `delta_child`, or `delta_arm_hand` where several sectors have a difference of one
    /// link.
    pub(super) fn small_name(&self, argument: Argument, index: usize) -> String {
        let sectors = &self.scene.requests.small;
        let links = sectors.iter().flat_map(|&sector| {
            let of_sector = self.transverse_sector(sector);
            let sector = &of_sector.sector;
            let links = &self.scene.links[sector.first.0..sector.first.0 + sector.links];
            links.iter().map(move |link| (&sector.name, &link.name))
        });
        let (sector, link) = match links.clone().nth(index) {
            Some(found) => found,
            None => unreachable!("a difference {index} behind the last one"),
        };
        let letter = match argument {
            Argument::SmallDifferences => "delta",
            Argument::SmallTorques => "outside_delta",
            _ => "delta_rate",
        };
        match links.filter(|(_, other)| *other == link).count() {
            1 => format!("{letter}_{link}"),
            _ => format!("{letter}_{sector}_{link}"),
        }
    }

    pub(super) fn small_meaning(&self, purpose: Purpose) -> Vec<String> {
        let names = self.scene.requests.small.iter();
        let names: Vec<String> = names
            .map(|&sector| format!("`{}`", self.transverse_sector(sector).sector.name))
            .collect();
        let names = names.join(", ");
        match purpose {
            Purpose::SmallAccelerations => vec![
                format!(
                    "Second time derivatives (in rad/s²) of the angles in phase and, behind them, of small differences that act back on these, of the sectors {names}, from {}`theta` and `omega` in phase, `difference` δ (in rad) and `difference_rate` (in rad/s): by the Lagrangian through second order in δ.",
                    self.at_time()
                ),
                String::new(),
                "Copies have the angles θ + e_c δ, as for `transverse_accelerations_…`, with the mean angles θ `theta` (in rad) and their rates `omega` (in rad/s). For pairs the differences are wrong by terms of third order in them, and the means of fourth.".into(),
            ],
            Purpose::SmallAccelerationsUnder => vec![
                "Second time derivatives (in rad/s²) as [`small_accelerations`](Self::small_accelerations), with generalized torques (in N m) from outside: `torques` Q on the angles in phase, the sums of those on all copies, and `difference_torques` Σ e_c Q_c on the differences (`DifferencePatterns::torques`).".into(),
                String::new(),
                "Their power on E is Q·ω with what the torques on differences do on `difference_rate`.".into(),
            ],
            _ => vec![format!(
                "Energy E (in J) of the whole tree through second order in the differences of {names}: kinetic and potential, which the motion of `small_accelerations` keeps without friction and drive."
            )],
        }
    }

    pub(super) fn small_formulas(&self) -> Vec<NamedFormula> {
        let Some(small) = self.small_mechanics() else {
            return Vec::new();
        };
        let parts = small.sectors.iter().map(|of_sector| {
            let name = &self.transverse_sector(of_sector.sector).sector.name;
            let latex = format!("E_{{\\mathrm{{{}}}}}", name.replace('_', "\\_"));
            NamedFormula::new(format!("E_{name}"), latex, &of_sector.energy)
        });
        let whole = NamedFormula::of_letter("E_0", &small.energy);
        std::iter::once(whole).chain(parts).collect()
    }

    /// `impl SmallDifferences`; NaN for slices of a wrong length.
    pub(super) fn small_trait(&self) -> Option<TokenStream> {
        self.small_mechanics()?;
        let (name, runtime) = (&self.item.ident, self.runtime());
        let sectors = self.scene.requests.small.iter();
        let sectors = sectors.map(|&sector| Literal::usize_unsuffixed(sector));
        let function = SliceFunction {
            name: "SmallDifferences",
            given: &["theta", "omega", "difference", "difference_rate"],
            results: &["accelerations"],
            index: None,
        };
        let body = self.fill("accelerations", Purpose::SmallAccelerations);
        let accelerations = self.computes(&function, &body, None);
        let energy = self.value_at_slices(Purpose::SmallEnergy);
        let forced = self.forced_differences();
        Some(quote! {
            #forced

            #accelerations

            impl<T: #runtime::Scalar> #runtime::SmallDifferences<T> for #name<T> {
                const SMALL: &'static [usize] = &[#(#sectors),*];

                #[inline]
                fn small_energy_of(
                    &self,
                    theta: &[T],
                    omega: &[T],
                    difference: &[T],
                    difference_rate: &[T],
                ) -> T {
                    #energy
                }
            }
        })
    }

    /// The accelerations under torques, where these are asked for; NaN for slices of a wrong
    /// length.
    fn forced_differences(&self) -> Option<TokenStream> {
        self.entry(Purpose::SmallAccelerationsUnder)?;
        let function = SliceFunction {
            name: "SmallDifferencesUnderTorques",
            given: &[
                "theta",
                "omega",
                "difference",
                "difference_rate",
                "torques",
                "difference_torques",
            ],
            results: &["accelerations"],
            index: None,
        };
        let body = self.fill("accelerations", Purpose::SmallAccelerationsUnder);
        Some(self.computes(&function, &body, None))
    }
}
