//! Emits the list of sectors (independent sets of symmetric coordinates), and the docs of their
//! energies.

use super::Emission;
use crate::functions::{Counting, EnergyDefinition};
use crate::mechanics::OrbitMechanics;
use crate::mechanics::expression::Expr;
use crate::scene::LinkId;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// Emits `impl Sectors`: the coordinates of each sector, and the weights of the links in them.
    pub(super) fn sectors(&self, sectors: &OrbitMechanics) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let list = sectors.sectors.iter().map(|sector| {
            let sector_name = &sector.name;
            let coordinates = sector.coordinates.iter().map(|&index| {
                let coordinate = &self.mechanics.coordinates[index];
                let coordinate_name = format!("theta_{}", coordinate.name);
                let weights = coordinate.weights.iter().map(|&(LinkId(link), weight)| {
                    let link = Literal::usize_unsuffixed(link);
                    let size = Literal::f64_unsuffixed(weight.unsigned_abs() as f64);
                    let weight = if weight < 0 {
                        quote!(-#size)
                    } else {
                        quote!(#size)
                    };
                    quote!((#link, #weight))
                });
                quote! {
                    #runtime::sectors::SectorCoordinate::listed(#coordinate_name, &[#(#weights),*])
                }
            });
            quote! {
                #runtime::sectors::Sector::listed(#sector_name, const { &[#(#coordinates),*] })
            }
        });
        quote! {
            // As for the functions above.
            #[allow(dead_code, clippy::possible_missing_comma)]
            impl<T: #runtime::Scalar> #name<T> {
                /// Sectors, as `sectors::Sectors` lists them.
                pub const SECTORS: &'static [#runtime::sectors::Sector] = &[#(#list),*];
            }

            impl<T: #runtime::Scalar> #runtime::Sectors for #name<T> {
                fn sectors(&self) -> &[#runtime::sectors::Sector] {
                    Self::SECTORS
                }
            }
        }
    }

    fn sector_names(&self) -> String {
        let sectors = self.mechanics.sectors.iter();
        let names: Vec<String> = sectors
            .flat_map(|sectors| &sectors.sectors)
            .map(|sector| format!("`{}`", sector.name))
            .collect();
        format!("Sectors, in order: {}.", names.join(", "))
    }

    pub(super) fn budget_meaning(&self, definition: EnergyDefinition, powers: &str) -> Vec<String> {
        let [kinetic, formula, latex, closes] = definition_in_words(definition);
        let mut lines = vec![
            format!(
                "Energies E_s of all sectors (in J), the transfers W_s into them and the powers P_s of {powers} (in W), so that dE_s/dt = W_s + P_s without truncation. The kinetic energy of a sector is computed {kinetic}."
            ),
            String::new(),
        ];
        lines.extend(block(
            &[formula, "V_s = Σ G |[1 − e^{iθ}]_s|²/2 + springs"],
            &[
                latex,
                "V_s = \\tfrac12 \\sum G\\,|[1-e^{i\\theta}]_s|^2 + \\text{springs}",
            ],
        ));
        lines.extend([
            String::new(),
            format!(
                "`[x]_s` is the part of x in the symmetric coordinates of the sector, summed over links. The sum of all V_s is U; apart from springs, V_s has the period 2π in every angle. {closes}"
            ),
        ]);
        let lateral = self.mechanics.sectors.as_ref().is_some_and(|sectors| {
            sectors
                .orbits
                .iter()
                .any(|orbit| orbit.lateral_gravity != Expr::zero())
        });
        if lateral {
            lines.push(String::new());
            lines.push("The part F sin θ of the potential energy, caused by lateral offsets, is counted in the sector of the means; the energies of differences are then not those of the linear modes.".into());
        }
        let mut sectors = self.mechanics.sectors.iter();
        if sectors.any(|sectors| !sectors.chords.is_empty()) {
            lines.push(String::new());
            lines.push("In the sectors of differences between the k copies under one link, straight springs κ between these, at the distance r from their pivot, add k κ r² to G.".into());
        }
        lines.push(String::new());
        lines.push(self.sector_names());
        lines
    }

    pub(super) fn sector_transfers_meaning(&self, order: Option<(Counting, u32)>) -> Vec<String> {
        let mut lines = match order {
            None => vec![
                "Energy transfer W_s = {E_s, H} (in W) into every sector without truncation, split into the contributions of the kinetic and of the potential energy of the rest of the tree. E_s is defined as in `budget_canonical`.".to_owned(),
            ],
            Some((Counting::Angle, order)) => vec![
                format!("Energy transfer W_s = {{E_s, H}} (in W) into every sector with the kinetic energy through order {order} in the angles of all differences, without expansion in the momenta, as in Toda and Ooshida. The derivatives of that energy by the differences have one order less. E_s is defined as in `budget_canonical`."),
                String::new(),
                "In an oscillation, momenta are as small as angles; `sector_transfers_amplitude_…` count both as small.".into(),
            ],
            Some((Counting::Amplitude, order)) => vec![
                format!("Energy transfer W_s = {{E_s, H}} (in W) into every sector through order {order} in the amplitude ε of all differences (both angles and momenta). E_s is defined as in `budget_canonical`. The remainder is of order {} in ε, and one order higher if every branching has two copies and none is within another.", order + 1),
            ],
        };
        lines.push(String::new());
        lines.extend(block(
            &["kinetic = {E_s, K − T_s}, potential = {E_s, U − V_s}, T_s = E_s − V_s"],
            &[
                "W_{s,\\text{kinetic}} = \\{E_s, K - T_s\\}",
                "W_{s,\\text{potential}} = \\{E_s, U - V_s\\}",
                "T_s = E_s - V_s",
            ],
        ));
        lines.push(String::new());
        lines.push(self.sector_names());
        lines
    }

    pub(super) fn matrix_meaning(&self) -> Vec<String> {
        let mut lines = vec![
            "Transfer matrix (in W): row s, column r is W(r→s), the power that sector r gives to sector s. Energies are defined by Parseval's identity, as in `budget_parseval`.".into(),
            String::new(),
        ];
        lines.extend(block(
            &["W(r→s) = {E_s, E_r} = −W(s→r), Σ_r W(r→s) = W_s"],
            &[
                "W_{r\\to s} = \\{E_s, E_r\\} = -W_{s\\to r}",
                "\\sum_r W_{r\\to s} = W_s",
            ],
        ));
        lines.extend([
            String::new(),
            "The matrix is antisymmetric to the last bit; the sum of row s is the transfer into s."
                .into(),
            String::new(),
            self.sector_names(),
        ]);
        lines
    }
}

/// Returns formulas as a text block, followed by LaTeX in a collapsed block.
fn block(text: &[&str], latex: &[&str]) -> Vec<String> {
    let lines = ["```text"].iter().chain(text).chain(&[
        "```",
        "",
        "<details><summary>LaTeX</summary>",
        "",
        "```latex",
    ]);
    let lines = lines.chain(latex).chain(&["```", "</details>"]);
    lines.map(|&line| line.to_owned()).collect()
}

/// Describes a definition of a sector's kinetic energy: the variables that it uses, the energy in
/// text and in LaTeX, and the sum of all sectors' energies.
fn definition_in_words(definition: EnergyDefinition) -> [&'static str; 4] {
    match definition {
        EnergyDefinition::Rest => [
            "from its momenta and its block of the mass matrix at rest",
            "E_s = ½ p_sᵀ B_s(0)⁻¹ p_s + V_s",
            "E_s = \\tfrac12 p_s^{\\mathsf T} B_s(0)^{-1} p_s + V_s",
            "The energies leave out an interaction energy H − Σ E_s.",
        ],
        EnergyDefinition::Canonical => [
            "from its momenta and its block of the mass matrix at the configuration",
            "E_s = ½ p_sᵀ B_s(θ)⁻¹ p_s + V_s",
            "E_s = \\tfrac12 p_s^{\\mathsf T} B_s(\\theta)^{-1} p_s + V_s",
            "The energies leave out an interaction energy H − Σ E_s.",
        ],
        EnergyDefinition::Parseval => [
            "by Parseval's identity from the velocities of the centres of mass",
            "E_s = Σ (m |[v]_s|² + I [ω]_s²)/2 + V_s",
            "E_s = \\tfrac12 \\sum (m\\,|[v]_s|^2 + I\\,[\\omega]_s^2) + V_s",
            "The energies sum to H, the transfers to zero, the powers to the power of friction and drive on H.",
        ],
        EnergyDefinition::Velocity => [
            "from its velocities and its block of the mass matrix at the configuration",
            "E_s = ½ ω_sᵀ B_s(θ) ω_s + V_s",
            "E_s = \\tfrac12 \\omega_s^{\\mathsf T} B_s(\\theta)\\,\\omega_s + V_s",
            "The energies leave out an interaction energy H − Σ E_s.",
        ],
    }
}
