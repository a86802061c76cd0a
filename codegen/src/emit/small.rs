//! Small differences that act back on the in-phase motion: names, docs, formulas and the runtime's
//! trait.

use super::Emission;
use crate::functions::Purpose;
use crate::mechanics::SmallMechanics;
use crate::mechanics::expression::NamedFormula;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// Documentation of the accelerations with small differences under torques.
pub(super) const UNDER_TORQUES: [&str; 3] = [
    "Second time derivatives (in rad/s²) like [`small_accelerations`](Self::small_accelerations), but under external generalized torques (in N m): `torques` Q on the in-phase angles, the sums of those on all copies, and `difference_torques` Σ e_c Q_c on the differences (`DifferencePatterns::torques`).",
    "",
    "Their power on E is Q·ω, plus the power of the torques on differences at `difference_rate`.",
];

impl Emission<'_> {
    fn small_mechanics(&self) -> Option<&SmallMechanics> {
        self.mechanics.transverse.as_ref()?.small.as_ref()
    }

    /// Returns the number of differences that act back.
    pub(super) fn small_count(&self) -> usize {
        let sectors = self.scene.requests.small.iter();
        sectors.map(|&sector| self.transverse_links(sector)).sum()
    }

    /// Returns `delta_child`, or `delta_arm_hand` if several sectors have a difference of the same
    /// link.
    pub(super) fn small_name(&self, letter: &str, index: usize) -> String {
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
        match links.filter(|(_, other)| *other == link).count() {
            1 => format!("{letter}_{link}"),
            _ => format!("{letter}_{sector}_{link}"),
        }
    }

    /// Returns the names of the sectors whose differences act back on the in-phase motion.
    fn small_sector_names(&self) -> String {
        let names = self.scene.requests.small.iter();
        let names: Vec<String> = names
            .map(|&sector| format!("`{}`", self.transverse_sector(sector).sector.name))
            .collect();
        names.join(", ")
    }

    /// Returns the documentation of the accelerations with small differences that act back.
    pub(super) fn small_accelerations_meaning(&self) -> Vec<String> {
        let names = self.small_sector_names();
        vec![
                format!(
                    "Second time derivatives (in rad/s²) of the in-phase angles, followed by those of small differences that act back on them, of the sectors {names}, from {}`theta` and `omega` in phase, `difference` δ (in rad) and `difference_rate` (in rad/s), derived from the Lagrangian through second order in δ.",
                    self.at_time()
                ),
                String::new(),
                "Copies have the angles θ + e_c δ, as for `transverse_accelerations_…`, with the mean angles θ `theta` (in rad) and their rates `omega` (in rad/s). Between two copies the error of the differences is of third order in them, and that of the means of fourth order.".into(),
            ]
    }

    /// Returns the documentation of the energy with small differences that act back.
    pub(super) fn small_energy_meaning(&self) -> Vec<String> {
        let names = self.small_sector_names();
        vec![format!(
            "Energy E (in J) of the whole tree through second order in the differences of {names}: kinetic and potential energy, which the motion of `small_accelerations` conserves without friction and drive."
        )]
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

    /// Emits `impl SmallDifferences`; slices of a wrong length give NaN.
    pub(super) fn small_trait(&self) -> Option<TokenStream> {
        self.small_mechanics()?;
        let (name, runtime) = (&self.item.ident, self.runtime());
        let sectors = self.scene.requests.small.iter();
        let sectors = sectors.map(|&sector| Literal::usize_unsuffixed(sector));
        let energy = self.value_at_slices(Purpose::SmallEnergy);
        Some(quote! {
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
}
