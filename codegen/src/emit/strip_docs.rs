//! Docs of a model in loops, and of the equations of its links.

use super::Emission;
use crate::scene::Layout;

impl Emission<'_> {
    pub(super) fn strip_docs(&self) -> Vec<String> {
        let energies = match self.scene.requests.energies {
            true => "",
            false => " Energies can be asked for with `emit(energies)`.",
        };
        let rows = self.scene.links.len();
        let vertical = self.scene.vertical();
        let mut lines = match self.scene.layout {
            Layout::Generations { branching, links } => vec![
                format!(
                    "A planar tree of {links} rigid links in {rows} generations, {branching} under each link but the last ones. Angles are absolute, in radians from the {vertical}; SI units throughout."
                ),
                String::new(),
                "Links stand generation by generation, and in a generation copy by copy: copy c (from 0) under link i of a generation of n links is number c n + i of the next one. `link` finds one by its path.".into(),
                String::new(),
                format!(
                    "The code is loops over generations, O(links), in vectors of siblings, and on all cores where there are many.{energies}"
                ),
            ],
            _ => vec![
                format!(
                    "A planar tree of {rows} rigid links. Angles are absolute, in radians from the {vertical}, in the order of `LINK_NAMES`; SI units throughout."
                ),
                String::new(),
                format!(
                    "The code is a loop over the links, O(links), of the equations that are shown where they stand.{energies}"
                ),
            ],
        };
        let between = self.scene.spring_dampers.iter();
        let between = between.filter(|own| !self.scene.pair_runs(&own.ends).is_empty());
        let between: Vec<String> = between.map(|own| format!("`{}`", own.what)).collect();
        if !between.is_empty() {
            lines.push(String::new());
            lines.push(format!(
                "Between two links {} has the torque −k (θ_a − θ_b − ρ) − (c + C/s + q s) w on a and its \
                 opposite on b, with the spring k, its rest ρ, friction c, C and q, \
                 w = ω_a − ω_b and s = √(w² + ε²). These torques are among the Q.",
                between.join(", ")
            ));
        }
        let along = self.scene.translational.iter();
        let along: Vec<String> = along.map(|own| format!("`{}`", own.what)).collect();
        if !along.is_empty() {
            lines.push(String::new());
            lines.push(format!(
                "Along the line between two points {} has on link i the torque \
                 −(dU/dℓ + c ℓ̇) ∂ℓ/∂θ_i with the length ℓ, the energy U(ℓ), ½ k (ℓ − L)² of a spring \
                 and A/ℓⁿ of a repulsion, and the friction c. These torques are among the Q.",
                along.join(", ")
            ));
        }
        if self.mechanics.drive.is_some() {
            lines.extend(self.drive_docs());
            self.show(&self.drive_formulas(), &mut lines);
        }
        lines.extend(self.example());
        lines
    }

    pub(super) fn equations_docs(&self) -> Vec<String> {
        let mut lines = vec![
            "The equations of one link, by articulated-body recursion in the plane (Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7).".to_owned(),
            String::new(),
            "Subtrees that hang at (ℓ, w) answer the acceleration **a** of their pivot with the force σ **a** + γ − N **a**. Their articulated inertia is σ − N; σ is the mass of those that are single links, and zero for others. J is the moment of inertia that the joint feels, b the first moment, κ the bias torque, f the force with the joint held; primed are N and γ of the subtree that the link carries, and the acceleration of its children's pivot. The code carries −**a**, the apparent gravity, has all masses over m and all lengths over l of the commonest leaf, and angles of a link by its own length.".to_owned(),
        ];
        if self.scene.stands() {
            lines.push(String::new());
            lines.push(
                "In these equations y is downwards, against the direction of links of angle 0."
                    .into(),
            );
        }
        if !self.scene.prescribed.is_empty() {
            lines.push(String::new());
            lines.push("Of a held link the angular acceleration is given where the torque from outside stands, nothing of it is eliminated (ch. 9), and where accelerations are told stands the torque that it takes, in N m.".into());
        }
        if let Some(link) = &self.mechanics.link {
            let formulas = link.formulas(&self.mechanics.symbols);
            self.show_text(&formulas, formulas.len(), &mut lines);
        }
        lines
    }
}
