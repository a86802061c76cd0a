//! Balance of force and torque of one link (physics §10). The articulated inertia and the bias
//! force of its children are unknowns. The balance is linear in the link's angular acceleration and
//! in the acceleration of its pivot, so that the coefficients can be read off.
//!
//! A subtree on the pivot (ℓ, w) responds to the pivot's acceleration a with the force σ a + γ − N
//! a. The mass σ can be chosen: it is the part of the subtree's mass that this link's constants
//! include. The articulated inertia is σ 1 − N, the bias force γ.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, NamedFormula, Role, SymbolId, Symbols};

/// Constants of a link with the mass σ of its subtrees at the pivot (ℓ, w).
#[derive(Clone, Debug, PartialEq)]
pub struct Composite {
    /// Moment of inertia M about the link's pivot.
    pub inertia: Expr,
    /// First moment of mass along and across the link.
    pub moment: [Expr; 2],
    /// Total mass S of the link and the subtrees that count as point masses.
    pub mass: Expr,
}

/// Symbols in the balance of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkSymbols {
    /// Mass m, and moment of inertia I about the centre of mass.
    pub body: [SymbolId; 2],
    /// Position (d, e) of the centre of mass, relative to the link's pivot.
    pub com: [SymbolId; 2],
    /// Mass σ of the subtrees that count as point masses.
    pub counted: SymbolId,
    /// Pivot (ℓ, w) of the subtrees.
    pub place: [SymbolId; 2],
    /// Symbols of M, h, the lateral part of h and S: the constants in [`Composite`].
    pub composite: [SymbolId; 4],
    /// Angle of the link.
    pub angle: SymbolId,
    /// Angular velocity of the link.
    pub omega: SymbolId,
    /// Cosine and sine of the angle.
    pub direction: [SymbolId; 2],
    /// Components xx, xy, yy of the matrix N of the subtrees.
    pub deficit: [SymbolId; 3],
    /// Bias force γ of the subtrees.
    pub bias_force: [SymbolId; 2],
    /// Sum of the torques on the link.
    pub torque: SymbolId,
    /// Acceleration of the link's pivot.
    pub pivot: [SymbolId; 2],
    /// Angular acceleration of the link.
    pub acceleration: SymbolId,
    /// Symbol J of the coefficient of the angular acceleration in the torque.
    pub joint_inertia: SymbolId,
    /// Symbol b of the coefficient of the pivot's acceleration in the torque.
    pub first_moment: [SymbolId; 2],
    /// Symbol κ of the remaining torque.
    pub bias: SymbolId,
    /// Symbol f of the remaining force.
    pub held_force: [SymbolId; 2],
}

/// Balance of one link: the torque J ω̇ + b·a + κ = 0, and the force S a + b ω̇ + f − N a on the
/// subtree. Here a is the acceleration of the pivot, and ω̇ the angular acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkBalance {
    /// Symbols from which the balance is formed.
    pub symbols: LinkSymbols,
    /// Constants of the link.
    pub composite: Composite,
    /// Coefficient J of ω̇ in the torque.
    pub joint_inertia: Expr,
    /// Coefficient b of a in the torque, and of ω̇ in the force.
    pub first_moment: [Expr; 2],
    /// Torque κ at zero accelerations.
    pub bias: Expr,
    /// Force f at zero accelerations.
    pub held_force: [Expr; 2],
    /// Matrix N of the subtree that begins with this link, for the mass S.
    pub deficit: [Expr; 3],
    /// Bias force γ of that subtree.
    pub bias_force: [Expr; 2],
    /// Solution of the torque balance for the angular acceleration ω̇.
    pub solution: Expr,
    /// Acceleration of the pivot of the children.
    pub child_pivot: [Expr; 2],
}

impl LinkBalance {
    /// Returns the balance as formulas, in the order of their use.
    pub fn formulas(&self, symbols: &Symbols) -> Vec<NamedFormula> {
        let named = |id: SymbolId, right: &Expr| NamedFormula::of_symbol(symbols, id, right);
        let primed = |id: SymbolId, right: &Expr| {
            let mut formula = named(id, right);
            formula.left = prime(&formula.left);
            formula.left_latex = prime(&formula.left_latex);
            formula
        };
        let LinkSymbols {
            composite: [inertia, along, across, mass],
            deficit,
            bias_force,
            pivot,
            acceleration,
            joint_inertia,
            first_moment,
            bias,
            held_force,
            ..
        } = &self.symbols;
        let pairs = |ids: &[SymbolId; 2], exprs: &[Expr; 2]| {
            let both = ids.iter().zip(exprs);
            both.map(|(&id, expr)| named(id, expr)).collect::<Vec<_>>()
        };
        let mut formulas = vec![
            named(*mass, &self.composite.mass),
            named(*inertia, &self.composite.inertia),
            named(*along, &self.composite.moment[0]),
        ];
        if !self.composite.moment[1].is_zero() {
            formulas.push(named(*across, &self.composite.moment[1]));
        }
        formulas.push(named(*joint_inertia, &self.joint_inertia));
        formulas.extend(pairs(first_moment, &self.first_moment));
        formulas.extend(pairs(held_force, &self.held_force));
        formulas.push(named(*bias, &self.bias));
        let answers = deficit.iter().zip(&self.deficit);
        formulas.extend(answers.map(|(&id, expr)| primed(id, expr)));
        let answers = bias_force.iter().zip(&self.bias_force);
        formulas.extend(answers.map(|(&id, expr)| primed(id, expr)));
        formulas.push(named(*acceleration, &self.solution));
        let pivots = pivot.iter().zip(&self.child_pivot);
        formulas.extend(pivots.map(|(&id, expr)| primed(id, expr)));
        formulas
    }
}

/// Returns the letter with a prime, which marks a quantity of the whole subtree or of the children.
fn prime(name: &str) -> String {
    name.replacen('_', "'_", 1)
}

/// A vector in the plane, (x, y).
pub(super) type Plane = [Formula; 2];

pub(super) fn plus(a: &Plane, b: &Plane) -> Plane {
    [&a[0] + &b[0], &a[1] + &b[1]]
}

pub(super) fn times(factor: &Formula, a: &Plane) -> Plane {
    a.each_ref().map(|component| factor * component)
}

pub(super) fn dot(a: &Plane, b: &Plane) -> Formula {
    &(&a[0] * &b[0]) + &(&a[1] * &b[1])
}

impl Derivation<'_> {
    fn link_symbols(&mut self) -> LinkSymbols {
        let angle = self.coordinate("i");
        let direction = [self.cos(angle), self.sin(angle)];
        let omega = self.velocity("i");
        let mut letter =
            |role: Role, text: &str, latex: &str| self.symbols.intern(role, text, text, latex);
        let mut constant = |text: &str, latex: &str| letter(Role::Constant, text, latex);
        let body = [constant("m", "m"), constant("I", "I")];
        let com = [constant("d", "d"), constant("e", "e")];
        let counted = constant("σ", "\\sigma");
        let place = [constant("ℓ", "\\ell"), constant("w", "w")];
        let composite = [
            constant("M", "M"),
            constant("h", "h"),
            constant("h_⊥", "h_{\\perp}"),
            constant("S", "S"),
        ];
        let mut derived = |text: &str, latex: &str| letter(Role::Derived, text, latex);
        let deficit = [
            derived("N_xx", "N_{xx}"),
            derived("N_xy", "N_{xy}"),
            derived("N_yy", "N_{yy}"),
        ];
        let bias_force = [derived("γ_x", "\\gamma_x"), derived("γ_y", "\\gamma_y")];
        let torque = derived("Q", "Q");
        let joint_inertia = derived("J", "J");
        let first_moment = [derived("b_x", "b_x"), derived("b_y", "b_y")];
        let held_force = [derived("f_x", "f_x"), derived("f_y", "f_y")];
        let bias = derived("κ", "\\kappa");
        let mut acceleration_letter =
            |text: &str, latex: &str| letter(Role::Acceleration, text, latex);
        let pivot = [
            acceleration_letter("a_x,i", "a_{x,i}"),
            acceleration_letter("a_y,i", "a_{y,i}"),
        ];
        let acceleration = acceleration_letter("α_i", "\\alpha_i");
        LinkSymbols {
            body,
            com,
            counted,
            place,
            composite,
            angle,
            omega,
            direction,
            deficit,
            bias_force,
            torque,
            pivot,
            acceleration,
            joint_inertia,
            first_moment,
            bias,
            held_force,
        }
    }

    /// Derives the balance of torque and force of one link.
    pub(super) fn link_balance(&mut self) -> LinkBalance {
        let s = self.link_symbols();
        let lateral = self.scene.is_lateral();
        let symbol = Formula::symbol;
        let across = |id: SymbolId| if lateral { symbol(id) } else { Formula::zero() };
        let [mass, inertia] = s.body.map(symbol);
        let counted = symbol(s.counted);
        let pivot = s.pivot.map(symbol);
        let (com, com_lever) = self.point_derivatives(&s, [symbol(s.com[0]), across(s.com[1])]);
        let (place, place_lever) =
            self.point_derivatives(&s, [symbol(s.place[0]), across(s.place[1])]);
        let com = plus(&pivot, &com);
        let place = plus(&pivot, &place);
        let [xx, xy, yy] = s.deficit.map(symbol);
        let deficit = [dot(&[xx, xy.clone()], &place), dot(&[xy, yy], &place)];
        let bias_force = s.bias_force.map(symbol);
        let below = plus(&times(&counted, &place), &bias_force);
        let below = [&below[0] - &deficit[0], &below[1] - &deficit[1]];
        let own = times(&mass, &com);
        let force = plus(&own, &below);
        let angular = symbol(s.acceleration);
        let torque = [
            &inertia * &angular,
            dot(&com_lever, &own),
            dot(&place_lever, &below),
            -symbol(s.torque),
        ];
        let torque: Formula = torque.into_iter().sum();
        self.read_off(s, &torque, &force, &place)
    }

    /// Returns the acceleration of a point of the link relative to its pivot, and the derivative
    /// ∂r/∂θ of its position.
    fn point_derivatives(&self, s: &LinkSymbols, point: Plane) -> (Plane, Plane) {
        let lever = self.link_lever(s, point);
        let bend = self.angle_derivative(s, &lever);
        let square = Formula::symbol(s.omega).pow(2);
        let acceleration = plus(
            &times(&Formula::symbol(s.acceleration), &lever),
            &times(&square, &bend),
        );
        (acceleration, lever)
    }

    fn read_off(
        &self,
        s: LinkSymbols,
        torque: &Formula,
        force: &Plane,
        child_pivot: &Plane,
    ) -> LinkBalance {
        let unknown = [s.acceleration, s.pivot[0], s.pivot[1]];
        let part = |formula: &Formula, exponents: [u32; 3]| {
            let found = formula.coefficients(&unknown).remove(exponents.as_slice());
            found.unwrap_or_else(Formula::zero)
        };
        let (rest, turned) = ([0, 0, 0], [1, 0, 0]);
        let joint_inertia = part(torque, turned);
        let first_moment = [part(torque, [0, 1, 0]), part(torque, [0, 0, 1])];
        let bias = part(torque, rest);
        let held = force.each_ref().map(|component| part(component, rest));
        debug_assert!(
            first_moment == force.each_ref().map(|component| part(component, turned)),
            "the balance of one link is symmetric"
        );
        // Without the responses of subtrees only the link's constants remain.
        let answers = s.deficit.iter().chain(&s.bias_force);
        let none: Vec<(SymbolId, Formula)> = answers.map(|&id| (id, Formula::zero())).collect();
        let bare = |formula: &Formula| formula.substitute(&none).expand();
        let constant = |formula: &Formula| self.circular(&s, &bare(formula));
        let coefficient = |formula: &Formula, id: SymbolId| bare(formula).derivative(id).expand();
        let [cos, sin] = s.direction;
        let inertia = constant(&joint_inertia);
        let along = coefficient(&first_moment[0], cos);
        let across = -coefficient(&first_moment[0], sin);
        let mass = bare(&part(&force[0], [0, 1, 0]));
        let names = [(inertia, 0), (along, 1), (across.expand(), 2)];
        let named = |formula: &Formula| {
            let answers = formula - &bare(formula);
            (&answers + &self.in_composites(&s, &constant(formula), &names)).expand()
        };
        let symbol = Formula::symbol;
        let joint = symbol(s.joint_inertia);
        let b = s.first_moment.map(symbol);
        let (kappa, held_symbols) = (symbol(s.bias), s.held_force.map(symbol));
        let [xx, xy, yy] = s.deficit.map(symbol);
        let taken = |i: usize, j: usize| &(&b[i] * &b[j]) / &joint;
        let passed = |i: usize| &held_symbols[i] - &(&(&b[i] * &kappa) / &joint);
        let driven = &dot(&b, &s.pivot.map(symbol)) + &kappa;
        let expr = |formula: Formula| self.expr(&formula);
        let [(inertia, _), (along, _), (across, _)] = names.clone();
        LinkBalance {
            composite: Composite {
                inertia: expr(inertia),
                moment: [expr(along), expr(across)],
                mass: expr(mass),
            },
            joint_inertia: expr(named(&joint_inertia)),
            first_moment: first_moment.each_ref().map(|b| expr(named(b))),
            bias: expr(bias),
            held_force: held.each_ref().map(|force| expr(named(force))),
            deficit: [
                expr(&xx + &taken(0, 0)),
                expr(&xy + &taken(0, 1)),
                expr(&yy + &taken(1, 1)),
            ],
            bias_force: [expr(passed(0)), expr(passed(1))],
            solution: expr(-(&driven / &joint)),
            child_pivot: child_pivot.each_ref().map(|a| expr(a.expand())),
            symbols: s,
        }
    }

    /// Returns the formula with sin² of the link's angle replaced by 1 − cos².
    fn circular(&self, s: &LinkSymbols, formula: &Formula) -> Formula {
        let [cos, sin] = s.direction;
        let (one, sine) = (Formula::integer(1), Formula::symbol(sin));
        let square = &one - &Formula::symbol(cos).pow(2);
        let terms = formula.coefficients(&[sin]).into_iter();
        let terms = terms.map(|(exponents, coefficient)| {
            let mut term = coefficient;
            for _ in 0..exponents[0] / 2 {
                term = &term * &square;
            }
            match exponents[0] % 2 {
                0 => term,
                _ => &term * &sine,
            }
        });
        terms.sum::<Formula>().expand()
    }

    /// Rewrites a formula in terms of M, h and the lateral moment: each coefficient of the powers
    /// of ω and of the angle's cosine and sine is one of them.
    fn in_composites(
        &self,
        s: &LinkSymbols,
        formula: &Formula,
        names: &[(Formula, usize)],
    ) -> Formula {
        let [cos, sin] = s.direction;
        let powers = [s.omega, cos, sin];
        let terms = formula.coefficients(&powers).into_iter();
        let terms = terms.map(|(exponents, coefficient)| {
            let same = |value: &Formula| (&coefficient - value).expand().is_zero();
            let found = names.iter().find_map(|(value, index)| {
                let symbol = Formula::symbol(s.composite[*index]);
                match (same(value), same(&-value.clone())) {
                    (true, _) => Some(symbol),
                    (_, true) => Some(-symbol),
                    _ => None,
                }
            });
            let factors = powers.iter().zip(exponents);
            factors.fold(found.unwrap_or(coefficient), |product, (&id, power)| {
                &product * &Formula::symbol(id).pow(power as i32)
            })
        });
        terms.sum()
    }
}
