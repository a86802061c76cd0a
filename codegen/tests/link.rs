//! The equations of one link: the program of a tree in loops, taken through the tree by
//! its interpreter, gives what code written out gives; and its functions are the derived
//! balance, symbol by symbol.

use branched_pendulum_codegen::mechanics::algebra::{Formula, run};
use branched_pendulum_codegen::mechanics::expression::{Expr, SymbolId};
use branched_pendulum_codegen::mechanics::{LinkBalance, Mechanics};
use branched_pendulum_codegen::program::{Argument, Column, Program, Rebuilt, Strips};
use branched_pendulum_codegen::scene::Layout;
use branched_pendulum_codegen::{Stages, stages};
use std::collections::BTreeMap;

/// A tree by rule.
const RULE: &str = "gravity = 9.80665, tree: generations(count = 4, branching = 2, \
    mass = 0.12, com = 0.1, inertia = 1e-3, joint = 0.3, mass_ratio = 0.5, length_ratio = 0.7)";

/// Bent links with all forces, driven, the children of each on one pivot. The second leaf
/// has its centre of mass beside its pivot.
const BUSH: &str = "gravity = 9.80665, trunk(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, \
    joint = (0.3, 0.05), friction = 1e-3, drag = 2e-3, spring = 0.1) [ \
        left(mass = 0.2, com = 0.07, inertia = 1e-3, joint = 0.2, friction = 3e-3, spring = 0.2, \
        rest = -0.4) [ \
            tip: rod(mass = 0.05, length = 0.1, friction = 1e-3), \
            weight(mass = 0.04, com = (0, 0.03), inertia = 1e-4, drag = 1e-3) ], \
        right: rod(mass = 0.1, length = 0.25, spring = 0.05, rest = 0.3) ], \
    drive(torque = 0.4 * cos(3 * t), x = 0.2 * sin(5 * t), y = 0.1 * cos(4 * t))";

/// Several attachments on one link, one of them in its own pivot; a parameter.
const SEVERAL: &str = "gravity = 9.80665, trunk(mass = 0.3, com = (0.1, 0.02), inertia = 2e-3, \
    joint = 0.3, friction = c) [ \
        left: rod(mass = 0.2, length = 0.3) [ tip: rod(mass = 0.05, length = 0.1, at = 0.2) ], \
        right: rod(mass = 0.1, length = 0.25, at = (0.15, 0.04), friction = c), \
        middle: disc(mass = 0.1, length = 0.05, radius = 0.02, at = 0) ]";

fn compiled(text: &str, code: &str) -> Stages {
    let text = format!("code = {code}, {text}");
    let attribute = text.parse().expect("tokens");
    let item = "struct Sample;".parse().expect("tokens");
    stages(attribute, item).unwrap_or_else(|(report, _)| panic!("{}", report.render(&text)))
}

/// Strip and parent of every link, depth first.
fn tree(stages: &Stages) -> Vec<(usize, Option<usize>)> {
    match stages.scene.layout {
        Layout::Generations { branching, .. } => {
            let mut tree = vec![(0, None)];
            let generations = stages.scene.links.len();
            below(&mut tree, 0, branching, generations);
            tree
        }
        _ => {
            let links = stages.scene.links.iter().enumerate();
            links
                .map(|(index, link)| (index, link.parent.map(|parent| parent.0)))
                .collect()
        }
    }
}

fn below(
    tree: &mut Vec<(usize, Option<usize>)>,
    link: usize,
    branching: usize,
    generations: usize,
) {
    let strip = tree[link].0 + 1;
    if strip < generations {
        for _ in 0..branching {
            tree.push((strip, Some(link)));
            let child = tree.len() - 1;
            below(tree, child, branching, generations);
        }
    }
}

/// The recursion through a tree, by the interpreter.
struct Sweep<'s> {
    program: &'s Program,
    strips: &'s Strips,
    parameters: &'s [f64],
    constants: Vec<Vec<f64>>,
    motion: Vec<[f64; 5]>,
}

impl Sweep<'_> {
    fn call(
        &self,
        entry: &str,
        row: usize,
        motion: usize,
        others: &[(Argument, &[f64])],
    ) -> Vec<f64> {
        let input = |argument: Argument, index: usize| match argument {
            Argument::Constants => self.constants[row][index],
            Argument::Motion => self.motion[motion][index],
            _ => {
                let given = others.iter().find(|(name, _)| *name == argument);
                given.expect("the argument is given").1[index]
            }
        };
        let values = self
            .program
            .evaluate(f64::sin_cos, entry, self.parameters, input);
        values.expect("the entry point exists")
    }

    fn accelerations(&self, tree: &[(usize, Option<usize>)], root: [f64; 2]) -> Vec<f64> {
        let links = tree.len();
        let has_children: Vec<bool> = (0..links)
            .map(|link| tree.iter().any(|(_, parent)| *parent == Some(link)))
            .collect();
        let mut sums = vec![vec![0.0; self.strips.length(Argument::Sums)]; links];
        let mut eliminations = vec![Vec::new(); links];
        for link in (0..links).rev() {
            let response = if has_children[link] {
                let mut both = self.call("inner", link, link, &[(Argument::Sums, &sums[link])]);
                eliminations[link] = both.split_off(self.strips.length(Argument::Response));
                both
            } else {
                self.call("leaf", link, link, &[])
            };
            if let Some(parent) = tree[link].1 {
                let attached =
                    self.call("attach", link, parent, &[(Argument::Response, &response)]);
                for (sum, value) in sums[parent].iter_mut().zip(attached) {
                    *sum += value;
                }
            }
        }
        let mut carried = vec![Vec::new(); links];
        let mut alpha = Vec::new();
        for link in 0..links {
            let pivot = match tree[link].1 {
                None => root.to_vec(),
                Some(parent) => self.call(
                    "pivot",
                    link,
                    parent,
                    &[(Argument::Carried, &carried[parent])],
                ),
            };
            let pivot = (Argument::Pivot, pivot.as_slice());
            let mut values = match has_children[link] {
                true => {
                    let elimination = (Argument::Elimination, eliminations[link].as_slice());
                    self.call("accelerate", link, link, &[elimination, pivot])
                }
                false => self.call("accelerate_leaf", link, link, &[pivot]),
            };
            carried[link] = values.split_off(1);
            alpha.push(values[0]);
        }
        alpha
    }
}

/// By the interpreter, in loops.
fn in_loops(
    stages: &Stages,
    parameters: &[f64],
    time: f64,
    theta: &[f64],
    omega: &[f64],
) -> Vec<f64> {
    let program = &stages.program;
    let strips = program.strips.as_ref().expect("a tree in loops");
    let tree = tree(stages);
    let values = program.setup.evaluate(parameters);
    let row = |strip: usize| -> Vec<f64> {
        let constants = strips.strips[strip].constants.iter();
        constants.map(|id| values[id.0 as usize]).collect()
    };
    let mut constants: Vec<Vec<f64>> = tree.iter().map(|(strip, _)| row(*strip)).collect();
    let at_time = |entry: &str| program.evaluate(f64::sin_cos, entry, parameters, |_, _| time);
    let mut root = at_time("root_gravity").expect("every tree has gravity");
    if let Some(drive) = at_time("root_drive") {
        root = vec![root[0] + drive[0], root[1] + drive[1]];
        if strips.has_drive_torque {
            *constants[0].last_mut().expect("a column for the torque") = drive[2];
        }
    }
    let motion = tree.iter().enumerate().map(|(link, (_, parent))| {
        let (sine, cosine) = theta[link].sin_cos();
        let relative = |state: &[f64]| state[link] - parent.map_or(0.0, |parent| state[parent]);
        [sine, cosine, omega[link], relative(theta), relative(omega)]
    });
    let sweep = Sweep {
        program,
        strips,
        parameters,
        constants,
        motion: motion.collect(),
    };
    sweep.accelerations(&tree, [root[0], root[1]])
}

/// Numbers without pattern between −1 and 1.
fn scattered(seed: usize, count: usize) -> Vec<f64> {
    (0..count)
        .map(|index| ((1 + seed * 37 + index * 101) as f64 * 12.9898).sin())
        .collect()
}

fn agree(text: &str, parameters: &[f64]) {
    let (loops, unrolled) = (compiled(text, "loops"), compiled(text, "unrolled"));
    let links = unrolled.scene.links.len();
    assert_eq!(tree(&loops).len(), links);
    let mut worst = 0.0_f64;
    for seed in 0..40 {
        let theta: Vec<f64> = scattered(seed, links).iter().map(|x| 3.0 * x).collect();
        let omega: Vec<f64> = scattered(seed + 500, links)
            .iter()
            .map(|x| 5.0 * x)
            .collect();
        let time = 0.1 * seed as f64;
        let input = |argument: Argument, index: usize| match argument {
            Argument::Theta => theta[index],
            Argument::Omega => omega[index],
            _ => time,
        };
        let expected = unrolled
            .program
            .evaluate(f64::sin_cos, "accelerations", parameters, input)
            .expect("accelerations");
        let found = in_loops(&loops, parameters, time, &theta, &omega);
        let scale = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for (found, expected) in found.iter().zip(&expected) {
            worst = worst.max((found - expected).abs() / scale);
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn a_tree_by_rule_moves_as_written_out() {
    agree(RULE, &[]);
}

#[test]
fn a_driven_bush_moves_as_written_out() {
    agree(BUSH, &[]);
}

#[test]
fn several_attachments_move_as_written_out() {
    agree(SEVERAL, &[2e-3]);
}

/// The functions of a program in symbols of the balance.
struct Algebra<'s> {
    program: &'s Program,
    mechanics: &'s Mechanics,
    balance: &'s LinkBalance,
    strips: &'s Strips,
    /// The link's own unit of length.
    unit: Formula,
}

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
                Column::Friction
                | Column::Drag
                | Column::Spring
                | Column::Rest
                | Column::DriveTorque => self.s(SymbolId(20_000 + *column as u32)),
            };
            values.push((stand_in(Argument::Constants, index), value));
        }
        let motion = [s.direction[1], s.direction[0], s.omega];
        for (index, id) in motion.into_iter().enumerate() {
            values.push((stand_in(Argument::Motion, index), self.s(id)));
        }
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
        let terms = [
            self.s(s.torque),
            &has(Column::Spring) * &(&joint(3) - &has(Column::Rest)),
            &has(Column::Friction) * &joint(4),
            &has(Column::Drag) * &self.s(s.omega),
            -has(Column::DriveTorque),
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

    /// Fails unless a link without children is the balance without them.
    fn assert_leaf(&self, found: &[Formula]) {
        let s = &self.balance.symbols;
        let b = &self.balance;
        let none = s.deficit.iter().chain(&s.bias_force);
        let mut none: Vec<(SymbolId, Formula)> = none.map(|&id| (id, Formula::zero())).collect();
        // No joints below.
        let own = &self.s(s.torque) - &self.torque_below();
        none.push((s.torque, own));
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

fn with_algebra(text: &str, own_unit: bool, work: impl FnOnce(&Algebra<'_>) + Send) {
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
        };
        work(&algebra);
    })
    .expect("the algebra runs");
}

#[test]
fn the_functions_of_a_bush_are_the_balance() {
    with_algebra(BUSH, true, |algebra| {
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
    with_algebra(SEVERAL, false, |algebra| {
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
