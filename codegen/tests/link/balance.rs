//! The functions of links against the derived balance, symbol by symbol.

use branched_pendulum_codegen::functions::Argument;
use branched_pendulum_codegen::mechanics::algebra::{Formula, run};
use branched_pendulum_codegen::mechanics::expression::{Expr, SymbolId};
use branched_pendulum_codegen::mechanics::{LinkBalance, Mechanics};
use branched_pendulum_codegen::program::{Column, LoopTree, Program, Rebuilt};
use std::collections::BTreeMap;

use super::{BUSH, SEVERAL, compiled};
/// The functions of a program in symbols of the balance.
struct Algebra<'s> {
    program: &'s Program,
    mechanics: &'s Mechanics,
    balance: &'s LinkBalance,
    strips: &'s LoopTree,
    /// The link's own unit of length.
    unit: Formula,
    /// 1 where the link is held, 0 where it is free.
    prescribed: i64,
}

/// Reciprocal of the unit of torques of a bush: of the inertia of its leaf `right` about
/// its pivot, 0.1 kg · (0.25 m)² / 3.
const PER_TORQUE: i64 = 480;

/// Symbols that stand for elements of arguments.
fn stand_in(argument: Argument, index: usize) -> SymbolId {
    let known = ARGUMENTS.iter().position(|known| *known == argument);
    let number = known.expect("an argument of link functions");
    SymbolId(10_000 + 100 * number as u32 + index as u32)
}

const ARGUMENTS: [Argument; 7] = [
    Argument::Constants,
    Argument::Motion,
    Argument::Response,
    Argument::Sums,
    Argument::Elimination,
    Argument::Carried,
    Argument::Pivot,
];

impl Algebra<'_> {
    fn s(&self, id: SymbolId) -> Formula {
        Formula::symbol(id)
    }

    fn named(&self, expr: &Expr) -> Formula {
        let s = &self.balance.symbols;
        let b = &self.balance;
        let first: Vec<(SymbolId, Formula)> = [
            (s.joint_inertia, &b.joint_inertia),
            (s.first_moment[0], &b.first_moment[0]),
            (s.first_moment[1], &b.first_moment[1]),
            (s.bias, &b.bias),
            (s.held_force[0], &b.held_force[0]),
            (s.held_force[1], &b.held_force[1]),
        ]
        .map(|(id, value)| (id, Formula::from_expr(value)))
        .to_vec();
        Formula::from_expr(expr).substitute(&first)
    }

    /// The outputs of an entry point, with these values of what it is given.
    fn outputs(&self, entry: &str, given: &[(Argument, Vec<Formula>)]) -> Vec<Formula> {
        let program = self.program;
        let mut symbols = BTreeMap::new();
        for argument in ARGUMENTS {
            for index in 0..self.strips.length(argument) {
                symbols.insert((argument, index), stand_in(argument, index));
            }
        }
        let rebuilt = Rebuilt::new(program, self.mechanics).with_symbols(symbols);
        let mut values = self.values();
        for (argument, elements) in given {
            for (index, value) in elements.iter().enumerate() {
                values.push((stand_in(*argument, index), value.clone()));
            }
        }
        let outputs = &program.entry(entry).expect("the entry point").outputs;
        outputs
            .iter()
            .map(|&id| Formula::from_expr(&rebuilt.value(id).expect("rebuilt")).substitute(&values))
            .collect()
    }

    /// Constants in units of the own length, motion, and torques that sum up to Q.
    fn values(&self) -> Vec<(SymbolId, Formula)> {
        let s = &self.balance.symbols;
        let (one, unit) = (Formula::integer(1), &self.unit);
        let inverse = &one / unit;
        let [inertia, along, across, mass] = s.composite.map(|id| self.s(id));
        let [ell, w] = s.place.map(|id| self.s(id));
        let mut values = Vec::new();
        for (index, column) in self.strips.columns.iter().enumerate() {
            let value = match column {
                Column::Inertia => &inertia * &(&inverse * &inverse),
                Column::Moment => &along * &inverse,
                Column::LateralMoment => &across * &inverse,
                Column::Mass => mass.clone(),
                Column::Length => unit.clone(),
                Column::InverseLength => inverse.clone(),
                Column::GainAlong => &(&along / &inertia) * unit,
                Column::GainAcross => &(&across / &inertia) * unit,
                Column::InverseInertia => &(unit * unit) / &inertia,
                Column::Along => &ell * &inverse,
                Column::Across => &w * &inverse,
                // Forces are whatever they are.
                _ => self.s(SymbolId(20_000 + *column as u32)),
            };
            values.push((stand_in(Argument::Constants, index), value));
        }
        let motion = [s.direction[1], s.direction[0], s.omega];
        for (index, id) in motion.into_iter().enumerate() {
            values.push((stand_in(Argument::Motion, index), self.s(id)));
        }
        values.push((
            stand_in(Argument::Motion, 6),
            Formula::integer(self.prescribed),
        ));
        values
    }

    /// What the joints below have to add to the link's own torques for Q in all.
    fn torque_below(&self) -> Formula {
        let s = &self.balance.symbols;
        let has = |column: Column| match self.strips.columns.contains(&column) {
            true => self.s(SymbolId(20_000 + column as u32)),
            false => Formula::zero(),
        };
        let joint = |index| self.s(stand_in(Argument::Motion, index));
        let outside = match self.strips.has_outside_torques {
            true => Formula::integer(PER_TORQUE * (1 - self.prescribed)),
            false => Formula::zero(),
        };
        let terms = [
            self.s(s.torque),
            &has(Column::Spring) * &(&joint(3) - &has(Column::Rest)),
            &has(Column::Friction) * &joint(4),
            &has(Column::Drag) * &self.s(s.omega),
            -has(Column::DriveTorque),
            -(&outside * &joint(5)),
        ];
        terms.into_iter().sum()
    }

    /// Fails unless both are equal where cos² + sin² = 1.
    fn assert_equal(&self, what: &str, found: &Formula, expected: &Formula) {
        let s = &self.balance.symbols;
        let fraction = |above: i64| &Formula::integer(above) / &Formula::integer(5);
        let circle = [
            (s.direction[0], fraction(3)),
            (s.direction[1], fraction(-4)),
        ];
        let difference = (found - expected).substitute(&circle);
        assert!(difference.together().is_zero(), "{what}: {difference:?}");
        assert!(
            !expected.substitute(&circle).together().is_zero(),
            "{what} is zero"
        );
    }

    fn elimination(&self) -> Vec<Formula> {
        let b = &self.balance;
        let over = |expr: &Expr| &(&self.named(expr) / &self.named(&b.joint_inertia)) * &self.unit;
        vec![
            over(&b.first_moment[0]),
            over(&b.first_moment[1]),
            over(&b.bias),
        ]
    }

    fn pivot(&self) -> Vec<Formula> {
        self.balance.symbols.pivot.map(|id| -self.s(id)).to_vec()
    }

    /// The responses of what hangs from the link, and the torque of their joints.
    fn below(&self) -> Vec<Formula> {
        let s = &self.balance.symbols;
        let ids = s.deficit.iter().chain(&s.bias_force);
        ids.map(|&id| self.s(id))
            .chain([self.torque_below()])
            .collect()
    }

    /// Fails unless these are the response and the elimination of the balance.
    fn assert_inner(&self, found: &[Formula]) {
        let b = &self.balance;
        let mass = self.s(b.symbols.composite[3]);
        let expected = [
            &self.named(&b.deficit[0]) - &mass,
            self.named(&b.deficit[1]),
            &self.named(&b.deficit[2]) - &mass,
            self.named(&b.bias_force[0]),
            self.named(&b.bias_force[1]),
        ];
        let split = self.strips.length(Argument::Response);
        let names = ["xx", "xy", "yy", "γ_x", "γ_y"];
        for ((found, expected), name) in found.iter().zip(&expected).zip(names) {
            self.assert_equal(name, found, expected);
        }
        let names = ["gain x", "gain y", "offset"];
        let kept = found[split..].iter().zip(self.elimination());
        for ((found, expected), name) in kept.zip(names) {
            self.assert_equal(name, found, &expected);
        }
    }

    /// Values of the balance without children, and without their joints.
    fn childless(&self) -> Vec<(SymbolId, Formula)> {
        let s = &self.balance.symbols;
        let none = s.deficit.iter().chain(&s.bias_force);
        let mut none: Vec<(SymbolId, Formula)> = none.map(|&id| (id, Formula::zero())).collect();
        let own = &self.s(s.torque) - &self.torque_below();
        none.push((s.torque, own));
        none
    }

    /// Fails unless these are the response and, behind it, what is kept of the balance of a
    /// link that has the given acceleration.
    fn assert_prescribed(&self, found: &[Formula], mass: &Formula, none: &[(SymbolId, Formula)]) {
        let (b, s) = (&self.balance, &self.balance.symbols);
        let given = self.given_acceleration();
        let along = |i: usize| self.named(&b.first_moment[i]);
        let force = |i: usize| &self.named(&b.held_force[i]) + &(&along(i) * &given);
        let response = [
            (&self.s(s.deficit[0]) - mass, "held xx"),
            (self.s(s.deficit[1]), "held xy"),
            (&self.s(s.deficit[2]) - mass, "held yy"),
            (force(0), "held γ_x"),
            (force(1), "held γ_y"),
        ];
        let steady = &(&self.named(&b.joint_inertia) * &given) + &self.named(&b.bias);
        let kept = [
            (&along(0) / &self.unit, "held gain x"),
            (&along(1) / &self.unit, "held gain y"),
            (&steady / &self.unit, "held offset"),
        ];
        let split = self.strips.length(Argument::Response);
        let pairs = found.iter().zip(response);
        let kept = found.iter().skip(split).zip(kept);
        for (found, (expected, name)) in pairs.chain(kept) {
            let driven = SymbolId(20_000 + Column::DriveTorque as u32);
            let mut none = none.to_vec();
            if !none.is_empty() {
                none.push((driven, Formula::zero()));
            }
            let expected = expected.substitute(&none);
            match name {
                // Of a leaf none.
                "held xx" | "held xy" | "held yy" if expected.is_zero() => {
                    assert!(found.is_zero(), "{name}");
                }
                _ => self.assert_equal(name, found, &expected),
            }
        }
    }

    /// The acceleration that is given in place of a torque.
    fn given_acceleration(&self) -> Formula {
        self.s(stand_in(Argument::Motion, 5))
    }

    /// Fails unless a link without children is the balance without them.
    fn assert_leaf(&self, found: &[Formula]) {
        let b = &self.balance;
        let none = self.childless();
        let expected = [
            &b.deficit[0],
            &b.deficit[1],
            &b.deficit[2],
            &b.bias_force[0],
            &b.bias_force[1],
        ];
        let names = ["leaf xx", "leaf xy", "leaf yy", "leaf γ_x", "leaf γ_y"];
        let driven = SymbolId(20_000 + Column::DriveTorque as u32);
        for ((found, expected), name) in found.iter().zip(expected).zip(names) {
            let expected = self.named(expected).substitute(&none);
            let expected = expected.substitute(&[(driven, Formula::zero())]);
            self.assert_equal(name, found, &expected);
        }
    }
}

fn with_algebra(
    text: &str,
    own_unit: bool,
    prescribed: i64,
    work: impl FnOnce(&Algebra<'_>) + Send,
) {
    let stages = compiled(text, "loops");
    let (mechanics, program) = (&stages.mechanics, &stages.program);
    let balance = mechanics.link.as_ref().expect("a tree in loops");
    let strips = program.strips.as_ref().expect("a tree in loops");
    run(|| {
        let unit = match own_unit {
            true => Formula::symbol(SymbolId(30_000)),
            false => Formula::integer(1),
        };
        let algebra = Algebra {
            program,
            mechanics,
            balance,
            strips,
            unit,
            prescribed,
        };
        work(&algebra);
    })
    .expect("the algebra runs");
}

#[test]
fn the_functions_of_a_bush_are_the_balance() {
    functions_are_the_balance(BUSH);
    functions_are_the_balance(&format!("{BUSH}, emit(forces)"));
    functions_are_the_balance(&format!("{BUSH}, prescribed(left)"));
}

/// A link that is held hands on what its acceleration does, and tells its reaction.
#[test]
fn the_functions_of_a_held_link_are_the_balance() {
    let text = format!("{BUSH}, prescribed(left, tip)");
    with_algebra(&text, true, 1, |algebra| {
        let (b, s) = (algebra.balance, &algebra.balance.symbols);
        let below = (Argument::Sums, algebra.below());
        let inner = algebra.outputs("inner", &[below]);
        algebra.assert_prescribed(&inner, &algebra.s(s.composite[3]), &[]);
        let leaf = algebra.outputs("leaf", &[]);
        algebra.assert_prescribed(&leaf, &Formula::zero(), &algebra.childless());
        let split = algebra.strips.length(Argument::Response);
        let given = [
            (Argument::Elimination, inner[split..].to_vec()),
            (Argument::Pivot, algebra.pivot()),
        ];
        let found = algebra.outputs("accelerate", &given);
        let alpha = algebra.given_acceleration();
        let pulls = [0, 1].map(|i| {
            let component = algebra.s(s.pivot[i]);
            &algebra.named(&b.first_moment[i]) * &component
        });
        let torque = [
            &algebra.named(&b.joint_inertia) * &alpha,
            algebra.named(&b.bias),
        ];
        let torque: Formula = pulls.into_iter().chain(torque).sum();
        let reaction = &torque / &Formula::integer(PER_TORQUE);
        algebra.assert_equal("the reaction", &found[0], &reaction);
        let turned = [(s.acceleration, alpha)];
        for (found, expected) in found[1..].iter().zip(&b.child_pivot) {
            let expected = -Formula::from_expr(expected).substitute(&turned);
            algebra.assert_equal("the children's pivot", found, &expected);
        }
    });
}

fn functions_are_the_balance(text: &str) {
    with_algebra(text, true, 0, |algebra| {
        let below = (Argument::Sums, algebra.below());
        algebra.assert_inner(&algebra.outputs("inner", &[below]));
        algebra.assert_leaf(&algebra.outputs("leaf", &[]));
        let b = algebra.balance;
        let given = [
            (Argument::Elimination, algebra.elimination()),
            (Argument::Pivot, algebra.pivot()),
        ];
        let found = algebra.outputs("accelerate", &given);
        let alpha = algebra.named(&b.solution);
        algebra.assert_equal("α", &found[0], &alpha);
        let turned = [(b.symbols.acceleration, alpha)];
        for (found, expected) in found[1..].iter().zip(&b.child_pivot) {
            let expected = -Formula::from_expr(expected).substitute(&turned);
            algebra.assert_equal("the children's pivot", found, &expected);
        }
    });
}

#[test]
fn the_functions_of_several_attachments_are_the_balance() {
    with_algebra(SEVERAL, false, 0, |algebra| {
        let mut response = algebra.below();
        let response_length = algebra.strips.length(Argument::Response);
        response.truncate(response_length);
        let attached = algebra.outputs("attach", &[(Argument::Response, response)]);
        algebra.assert_inner(&algebra.outputs("inner", &[(Argument::Sums, attached)]));
        let b = algebra.balance;
        let given = [
            (Argument::Elimination, algebra.elimination()),
            (Argument::Pivot, algebra.pivot()),
        ];
        let mut found = algebra.outputs("accelerate", &given);
        let carried = found.split_off(1);
        let alpha = algebra.named(&b.solution);
        algebra.assert_equal("α", &found[0], &alpha);
        let turned = [(b.symbols.acceleration, alpha)];
        let found = algebra.outputs("pivot", &[(Argument::Carried, carried)]);
        for (found, expected) in found.iter().zip(&b.child_pivot) {
            let expected = -Formula::from_expr(expected).substitute(&turned);
            algebra.assert_equal("the child's pivot", found, &expected);
        }
    });
}
