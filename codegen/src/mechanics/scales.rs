//! Energies by scale, of one link in a tree whose copies are equal (physics §18).
//!
//! The part of a quantity in a scale is linear in it, and constants are those of a whole
//! generation: what is derived here for one link holds for parts as for the whole. The
//! energy of a scale is that of parts; its slopes in the angular velocity and in the
//! angle come from it by the chain rule, through the velocities of all centres of mass
//! that the link moves.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, NamedFormula, Role, SymbolId, Symbols};
use super::link::{LinkSymbols, Plane, dot, plus, times};

/// Symbols of a link's scales beside those of its balance.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleSymbols {
    /// Stiffness κ and rest angle ρ of the spring, friction c in the pivot, drag k.
    pub joint: [SymbolId; 4],
    /// Angle and angular velocity against the parent.
    pub relative: [SymbolId; 2],
    /// Gravity g.
    pub gravity: SymbolId,
    /// First moment of all that the link carries about its pivot, along and across.
    pub carried_moment: [SymbolId; 2],
    /// Velocity of the pivot.
    pub pivot_velocity: [SymbolId; 2],
    /// Velocity V of the centre of mass.
    pub velocity: [SymbolId; 2],
    /// Momentum C of all that hangs from the link.
    pub carried: [SymbolId; 2],
    /// First moment B of the momentum, in the directions of v and of its derivative.
    pub moment: [SymbolId; 2],
    /// Parts in a scale: of V (two), ω, 1 − cos θ, sin θ, the strain of the spring.
    pub parts: [SymbolId; 6],
    /// Part of the springs' torques.
    pub spring_part: SymbolId,
    /// 1 for the means, 0 for other scales.
    pub means: SymbolId,
    /// Angular velocity u along the flow of a scale's energy.
    pub flow: SymbolId,
    /// Change of the pivot's velocity along the flow, at constant ω.
    pub pivot_shift: [SymbolId; 2],
    /// B of the changes of velocities along the flow.
    pub shift_moment: [SymbolId; 2],
    /// Acceleration of the root's pivot.
    pub root_acceleration: [SymbolId; 2],
}

/// Energies by scale of one link, and what changes them.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkScales {
    /// Symbols of the link.
    pub symbols: ScaleSymbols,
    /// Strain of the spring, and the torques of spring, friction and drag.
    pub torques: [Expr; 4],
    /// Velocities of the centre of mass and of the children's pivot.
    pub velocity: [Expr; 4],
    /// B, and the momentum of all that the parent carries in this link.
    pub moment: [Expr; 4],
    /// Energy of parts.
    pub energy: Expr,
    /// Derivative of the energy in ω.
    pub rate_slope: Expr,
    /// Changes of the velocities along the flow, at constant ω.
    pub shift: [Expr; 4],
    /// Derivative of the energy in θ at constant ω, and what the flow changes in the
    /// momentum M ω by the angles.
    pub angle_slope: Expr,
    /// Torque of the inertial forces of a moving pivot.
    pub inertial: Expr,
}

/// Names of what [`LinkScales`] holds, with their forms in LaTeX.
const NAMES: [(&str, &str); 19] = [
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
];

impl LinkScales {
    /// The formulas, in the order in which they are used.
    pub fn formulas(&self) -> Vec<NamedFormula> {
        let Self {
            symbols: _,
            torques,
            velocity,
            moment,
            energy,
            rate_slope,
            shift,
            angle_slope,
            inertial,
        } = self;
        let all = torques.iter().chain(velocity).chain(moment);
        let all = all.chain([energy, rate_slope]).chain(shift);
        let named = NAMES.iter().zip(all.chain([angle_slope]));
        let named = named.chain([(&("Q_moved", "Q_{moved}"), inertial)]);
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
        let mut constant = |text: &str, latex: &str| letter(Role::Constant, text, latex);
        let joint = [
            constant("κ_i", "\\kappa_i"),
            constant("ρ", "\\rho"),
            constant("c", "c"),
            constant("k", "k"),
        ];
        let gravity = constant("g_0", "g");
        let carried_moment = [constant("H", "H"), constant("H_⊥", "H_{\\perp}")];
        let means = constant("δ_s0", "\\delta_{s0}");
        let mut derived = |text: &str, latex: &str| letter(Role::Derived, text, latex);
        let mut pair = |text: &str| {
            ["x", "y"].map(|axis| {
                let name = format!("{text}_{axis}");
                derived(&name, &name)
            })
        };
        let [pivot_velocity, velocity, carried, moment] = ["P", "V", "C", "B"].map(&mut pair);
        let [pivot_shift, shift_moment, root_acceleration] = ["R", "D", "A"].map(&mut pair);
        let relative = [derived("φ", "\\varphi"), derived("φ̇", "\\dot\\varphi")];
        let parts = [
            derived("[V_x]", "[V_x]_s"),
            derived("[V_y]", "[V_y]_s"),
            derived("[ω]", "[\\omega]_s"),
            derived("[1 − cos θ]", "[1-\\cos\\theta]_s"),
            derived("[sin θ]", "[\\sin\\theta]_s"),
            derived("[strain]", "[\\epsilon]_s"),
        ];
        Self {
            joint,
            relative,
            gravity,
            carried_moment,
            pivot_velocity,
            velocity,
            carried,
            moment,
            parts,
            spring_part: derived("[springs]", "[\\tau]_s"),
            means,
            flow: derived("u", "u"),
            pivot_shift,
            shift_moment,
            root_acceleration,
        }
    }
}

impl Derivation<'_> {
    /// ∂/∂θ of a vector.
    pub(super) fn turned(&self, s: &LinkSymbols, vector: &Plane) -> Plane {
        vector
            .each_ref()
            .map(|component| self.partial(component, s.angle))
    }

    /// ∂r/∂θ of a point of the link.
    pub(super) fn link_lever(&self, s: &LinkSymbols, [along, lateral]: Plane) -> Plane {
        let [cos, sin] = s.direction.map(Formula::symbol);
        let position = [
            &(&along * &sin) + &(&lateral * &cos),
            &(&lateral * &sin) - &(&along * &cos),
        ];
        self.turned(s, &position)
    }

    /// Derives the energies by scale of a link.
    pub(super) fn link_scales(&mut self, link: &LinkSymbols) -> LinkScales {
        let s = ScaleSymbols::new(&mut self.symbols);
        let symbol = Formula::symbol;
        let pair = |ids: [SymbolId; 2]| ids.map(symbol);
        let half = |formula: Formula| &formula / &Formula::integer(2);
        let lateral = self.scene.is_lateral();
        let point = |[along, across]: [SymbolId; 2]| match lateral {
            true => [symbol(along), symbol(across)],
            false => [symbol(along), Formula::zero()],
        };
        let [mass, inertia] = pair(link.body);
        let omega = symbol(link.omega);
        let [com, place] = [link.com, link.place].map(|ids| self.link_lever(link, point(ids)));

        // Velocities of points are those of the pivot and ω times their levers.
        let moving = |rate: &Formula, pivot: [SymbolId; 2]| {
            let pivot = pair(pivot);
            [&com, &place].map(|lever| plus(&pivot, &times(rate, lever)))
        };
        let [velocity, child_velocity] = moving(&omega, s.pivot_velocity);

        // Along a flow θ changes by u, and with it the levers.
        let flow = symbol(s.flow);
        let bends = [&com, &place].map(|lever| times(&(&flow * &omega), &self.turned(link, lever)));
        let shift = bends.map(|bend| plus(&pair(s.pivot_shift), &bend));

        // The spring's energy and Rayleigh's function by the angle and rate of the joint.
        let [stiffness, rest, friction, drag] = s.joint.map(symbol);
        let [relative, relative_rate] = pair(s.relative);
        let strain = &relative - &rest;
        let stored = half(&stiffness * &strain.pow(2));
        let lost = half(&friction * &relative_rate.pow(2));
        let dragged = half(&drag * &omega.pow(2));
        let torques = [
            strain.clone(),
            stored.derivative(s.relative[0]),
            lost.derivative(s.relative[1]),
            dragged.derivative(link.omega),
        ];

        // Energy of parts; what lateral offsets weigh is that of the means.
        let [v_x, v_y, rate, rise, side, part_strain] = s.parts.map(symbol);
        let moved = half(&mass * &dot(&[v_x.clone(), v_y.clone()], &[v_x, v_y]));
        let turning = half(&inertia * &rate.pow(2));
        let gravity = symbol(s.gravity);
        let [along, across] = point(s.carried_moment);
        let weight = half(&(&gravity * &along) * &(&rise.pow(2) + &side.pow(2)));
        let lateral = &(&(&gravity * &across) * &symbol(s.means)) * &side;
        let strained = half(&stiffness * &part_strain.pow(2));
        let energy: Formula = [moved, turning, weight, lateral, strained]
            .into_iter()
            .sum();

        // Momenta of parts, as sums over what a link moves: B is the moment of this
        // momentum, of which constants alone make the part in a scale.
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
        let heights = self.turned(link, &direction);
        let pulls = [3, 4].map(|part| energy.derivative(s.parts[part]));
        let angle_slope: Formula = [
            &omega * &self.partial(&momentum, link.angle),
            dot(&pulls, &heights),
            symbol(s.spring_part),
            along_moment(s.shift_moment),
        ]
        .into_iter()
        .sum();

        let lever = self.link_lever(link, [along, across]);
        let inertial = -dot(&pair(s.root_acceleration), &lever);
        let expr = |formula: &Formula| self.expr(&formula.expand());
        let four = |[a, b]: [&Plane; 2]| [expr(&a[0]), expr(&a[1]), expr(&b[0]), expr(&b[1])];
        LinkScales {
            torques: torques.each_ref().map(expr),
            velocity: four([&velocity, &child_velocity]),
            moment: four([&moment, &plus(&impulse, &carried)]),
            energy: expr(&energy),
            rate_slope: expr(&rate_slope),
            shift: four([&shift[0], &shift[1]]),
            angle_slope: expr(&angle_slope),
            inertial: expr(&inertial),
            symbols: s,
        }
    }
}
