//! Docs of a model in loops, and of the equations of its links.

use super::Emission;
use crate::scene::Layout;

impl Emission<'_> {
    pub(super) fn strip_docs(&self) -> Vec<String> {
        let energies = match self.scene.requests.energies {
            true => "",
            false => " Energies can be requested with `emit(energies)`.",
        };
        let rows = self.scene.links.len();
        let vertical = self.scene.vertical();
        let mut lines = match self.scene.layout {
            Layout::Generations { branching, links } => vec![
                format!(
                    "A planar tree of {links} rigid links in {rows} generations, {branching} under each link except those of the last generation. Angles are absolute, in radians from the {vertical}; SI units throughout."
                ),
                String::new(),
                "Links are ordered generation by generation, and in a generation copy by copy: copy c (from 0) under link i of a generation of n links has the number c n + i in the next generation. `link` finds a link by its path.".into(),
                String::new(),
                format!(
                    "The code consists of loops over generations, O(links). They compute several siblings at once in vector registers, and large trees on all cores.{energies}"
                ),
            ],
            Layout::Unrolled | Layout::Links => vec![
                format!(
                    "A planar tree of {rows} rigid links. Angles are absolute, in radians from the {vertical}, in the order of `LINK_NAMES`; SI units throughout."
                ),
                String::new(),
                format!(
                    "The code is a loop over the links, O(links). The equations of one link are shown where they are defined.{energies}"
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
            "Subtrees that hang at (ℓ, w) respond to the acceleration **a** of their pivot with the force σ **a** + γ − N **a**. Their articulated inertia is σ − N; σ is the mass of those subtrees that are single links. J is the moment of inertia about the joint, b the first moment, κ the bias torque, f the force if the joint does not move. A prime marks N and γ of the subtree that begins with the link, and the acceleration of its children's pivot. The code uses −**a**, the apparent gravity. Masses and lengths are divided by the mass m and length l of the most frequent kind of leaf, and accelerations of a link are multiplied by its own unit of length.".to_owned(),
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
            lines.push("For a prescribed (held) link, the angular acceleration replaces the external torque among the arguments, and nothing is eliminated (ch. 9); in the place of its acceleration, the torque that it needs is returned, in N m.".into());
        }
        if let Some(link) = &self.mechanics.link {
            let formulas = link.formulas(&self.mechanics.symbols);
            self.show_text(&formulas, formulas.len(), &mut lines);
        }
        lines
    }
}
