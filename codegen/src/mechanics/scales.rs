//! Energies by scale of one link, in a tree whose copies are equal (physics §18). Scale s contains
//! all differences between the branches that begin in generation s; scale 0 contains the means.
//!
//! The part of a quantity in a scale is linear in the quantity, and all links of a generation share
//! their constants. Formulas derived here for one link therefore hold for such parts as well as for
//! the whole. The energy of a scale is the energy of these parts. Its derivatives in the angular
//! velocity and in the angle follow by the chain rule, through the velocities of all centres of
//! mass that the link moves.

use super::algebra::Formula;
use super::body::{BodySymbols, LinkBody};
use super::derivation::Derivation;
use super::expression::{Expr, NamedFormula, Role, SymbolId, Symbols};
use super::joint_forces::{DerivedForces, JointForces};
use super::laws::{kinetic, stored};
use super::link::{LinkSymbols, Plane, dot, plus, times};

/// Symbols of a link's parts in a scale, in addition to those of its balance of forces, of its
/// torques and of its body.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleSymbols {
    /// Velocity V of the centre of mass.
    pub velocity: [SymbolId; 2],
    /// Momentum C of the link's descendants.
    pub carried: [SymbolId; 2],
    /// First moment B of the momentum, in the direction of the link and in that of its derivative.
    pub moment: [SymbolId; 2],
    /// Parts in a scale of the velocity V (two components), of ω, 1 − cos θ and sin θ, and of the
    /// strain of the spring.
    pub parts: [SymbolId; 6],
    /// Part in a scale of the springs' torques.
    pub spring_part: SymbolId,
    /// 1 for the means (scale 0), 0 for other scales.
    pub means: SymbolId,
    /// Angular velocity u along the flow of a scale's energy.
    pub flow: SymbolId,
    /// Change of the pivot's velocity along the flow, at constant ω.
    pub pivot_shift: [SymbolId; 2],
    /// First moment B of the changes of velocities along the flow.
    pub shift_moment: [SymbolId; 2],
}

/// Energies by scale of one link, and their derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkScales {
    /// Symbols of the link's parts in a scale.
    pub symbols: ScaleSymbols,
    /// First moment B, and the contribution of this link and its descendants to the parent's
    /// momentum C.
    pub moment: [Expr; 4],
    /// Energy of the parts in a scale.
    pub energy: Expr,
    /// Derivative of the energy by ω.
    pub rate_slope: Expr,
    /// Changes of the velocities along the flow, at constant ω.
    pub shift: [Expr; 4],
    /// Derivative of the energy by θ at constant ω, and the change of the momentum M ω along the
    /// flow caused by the angles.
    pub angle_slope: Expr,
}

/// Names of torques, velocities and the formulas in [`LinkScales`], in text and in LaTeX.
const NAMES: [(&str, &str); 20] = [
    ("strain", "\\epsilon"),
    ("spring torque", "\\tau_{spring}"),
    ("friction torque", "\\tau_{friction}"),
    ("drag torque", "\\tau_{drag}"),
    ("V_x", "V_x"),
    ("V_y", "V_y"),
    ("P'_x", "P'_x"),
    ("P'_y", "P'_y"),
    ("B_x", "B_x"),
    ("B_y", "B_y"),
    ("C'_x", "C'_x"),
    ("C'_y", "C'_y"),
    ("E", "E"),
    ("∂E/∂ω", "\\partial E/\\partial\\omega"),
    ("R_x", "R_x"),
    ("R_y", "R_y"),
    ("R'_x", "R'_x"),
    ("R'_y", "R'_y"),
    ("z", "z"),
    ("Q_moved", "Q_{moved}"),
];

impl LinkScales {
    /// Returns the formulas in the order of their use, together with those of the torques and of
    /// the body.
    pub fn formulas(&self, forces: &JointForces, body: &LinkBody) -> Vec<NamedFormula> {
        let Self {
            symbols: _,
            moment,
            energy,
            rate_slope,
            shift,
            angle_slope,
        } = self;
        let all = forces.all().into_iter().chain(&body.velocity);
        let all = all.chain(moment).chain([energy, rate_slope]).chain(shift);
        let all = all.chain([angle_slope, &body.inertial]);
        let named = NAMES.iter().zip(all);
        named
            .map(|(&(left, latex), right)| NamedFormula::new(left, latex, right))
            .collect()
    }
}

impl ScaleSymbols {
    fn new(symbols: &mut Symbols) -> Self {
        let mut letter = |role: Role, text: &str, latex: &str| {
            let code = text.replace(['[', ']', '\''], "");
            symbols.intern(role, &code, text, latex)
        };
        let means = letter(Role::Constant, "δ_s0", "\\delta_{s0}");
        let mut derived = |text: &str, latex: &str| letter(Role::Derived, text, latex);
        let mut pair = |text: &str| {
            ["x", "y"].map(|axis| {
                let name = format!("{text}_{axis}");
                derived(&name, &name)
            })
        };
        let [velocity, carried, moment] = ["V", "C", "B"].map(&mut pair);
        let [pivot_shift, shift_moment] = ["R", "D"].map(&mut pair);
        let parts = [
            derived("[V_x]", "[V_x]_s"),
            derived("[V_y]", "[V_y]_s"),
            derived("[ω]", "[\\omega]_s"),
            derived("[1 − cos θ]", "[1-\\cos\\theta]_s"),
            derived("[sin θ]", "[\\sin\\theta]_s"),
            derived("[strain]", "[\\epsilon]_s"),
        ];
        Self {
            velocity,
            carried,
            moment,
            parts,
            spring_part: derived("[springs]", "[\\tau]_s"),
            means,
            flow: derived("u", "u"),
            pivot_shift,
            shift_moment,
        }
    }
}

impl Derivation<'_> {
    /// Derives the energies by scale of a link.
    pub(super) fn link_scales(
        &mut self,
        link: &LinkSymbols,
        forces: &DerivedForces,
        body: &BodySymbols,
    ) -> LinkScales {
        let s = ScaleSymbols::new(&mut self.symbols);
        let symbol = Formula::symbol;
        let pair = |ids: [SymbolId; 2]| ids.map(symbol);
        let omega = symbol(link.omega);
        let [com, place] =
            [link.com, link.place].map(|ids| self.link_lever(link, self.point_on_link(ids)));

        // Along the flow θ changes by u, and the levers change with it.
        let flow = symbol(s.flow);
        let bends = [&com, &place]
            .map(|lever| times(&(&flow * &omega), &self.angle_derivative(link, lever)));
        let shift = bends.map(|bend| plus(&pair(s.pivot_shift), &bend));

        let energy = self.energy_of_parts(&s, link, forces, body);

        // Momenta of parts, as sums over all that a link moves. The part of B in a scale is the
        // moment of this momentum, because only constants enter B.
        let impulse = [0, 1].map(|axis| {
            let part = energy.derivative(s.parts[axis]);
            part.substitute(&[(s.parts[axis], symbol(s.velocity[axis]))])
        });
        let carried = pair(s.carried);
        let torque = (&dot(&com, &impulse) + &dot(&place, &carried)).expand();
        let [cos, sin] = link.direction;
        let moment = [cos, sin].map(|id| torque.derivative(id).expand());
        let along_moment = |moment: [SymbolId; 2]| dot(&pair(moment), &pair(link.direction));
        let momentum = along_moment(s.moment);
        let rate_slope = &momentum + &energy.derivative(s.parts[2]);

        let one = Formula::integer(1);
        let [cosine, sine] = pair(link.direction);
        let direction = [&one - &cosine, sine];
        let heights = self.angle_derivative(link, &direction);
        let pulls = [3, 4].map(|part| energy.derivative(s.parts[part]));
        let angle_slope: Formula = [
            &omega * &self.partial(&momentum, link.angle),
            dot(&pulls, &heights),
            symbol(s.spring_part),
            along_moment(s.shift_moment),
        ]
        .into_iter()
        .sum();

        let expr = |formula: &Formula| self.expr(&formula.expand());
        let four = |[a, b]: [&Plane; 2]| [expr(&a[0]), expr(&a[1]), expr(&b[0]), expr(&b[1])];
        LinkScales {
            moment: four([&moment, &plus(&impulse, &carried)]),
            energy: expr(&energy),
            rate_slope: expr(&rate_slope),
            shift: four([&shift[0], &shift[1]]),
            angle_slope: expr(&angle_slope),
            symbols: s,
        }
    }

    /// Returns the energy of the parts of a link in a scale. The weight of lateral offsets
    /// contributes to the means only.
    fn energy_of_parts(
        &self,
        s: &ScaleSymbols,
        link: &LinkSymbols,
        forces: &DerivedForces,
        body: &BodySymbols,
    ) -> Formula {
        let symbol = Formula::symbol;
        let [mass, inertia] = link.body.map(symbol);
        let [v_x, v_y, rate, rise, side, strain] = s.parts.map(symbol);
        let moved = kinetic([&mass, &inertia], &[v_x, v_y], &rate);
        let gravity = symbol(body.gravity);
        let [along, across] = self.point_on_link(body.carried_moment);
        let squares = &rise.pow(2) + &side.pow(2);
        let weight = &(&(&gravity * &along) * &squares) / &Formula::integer(2);
        let lateral = &(&(&gravity * &across) * &symbol(s.means)) * &side;
        let strained = stored(&symbol(forces.symbols.constants[0]), &strain);
        [moved, weight, lateral, strained].into_iter().sum()
    }
}
