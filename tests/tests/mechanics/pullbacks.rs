//! Derivatives by the reverse pass, in 31 digits against tangents of the same function by dual
//! numbers, and against central differences of a function that is computed in 31 digits.

use std::rc::Rc;

use branched_pendulum::Scalar;
use branched_pendulum::scalar::{Double, Dual, Real};
use branched_pendulum_codegen::functions::{Argument, Purpose};
use branched_pendulum_codegen::program::{ConstantId, ConstantOp, Entry, Op, Program, ValueId};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_tests::oracle::generator::{Coupling, Recipe, coupled_sample};
use branched_pendulum_tests::samples::seeds;

use crate::support::{Compiled, Worst, compile, compile_item};

/// The exact numbers of a program, each converted once to the sum of two `f64`.
struct Numbers {
    constants: Vec<Option<(f64, f64)>>,
    values: Vec<Option<(f64, f64)>>,
}

impl Numbers {
    fn new(program: &Program) -> Self {
        let constants = program.setup.definitions.iter();
        let constants = constants.map(|definition| match (&definition.exact, &definition.op) {
            (Some(exact), _)
            | (None, ConstantOp::Number(exact) | ConstantOp::Product(exact, _)) => {
                Some(exact.to_parts())
            }
            (
                None,
                ConstantOp::Parameter(_)
                | ConstantOp::Named(..)
                | ConstantOp::Called(_)
                | ConstantOp::Add(..)
                | ConstantOp::Sub(..),
            ) => None,
        });
        let values = program.definitions.iter();
        let values = values.map(|definition| match &definition.op {
            Op::Number(exact) => Some(exact.to_parts()),
            Op::Input(..)
            | Op::Constant(_)
            | Op::Sin(_)
            | Op::Cos(_)
            | Op::Sqrt(_)
            | Op::Neg(_)
            | Op::Add(..)
            | Op::Sub(..)
            | Op::Mul(..)
            | Op::Div(..) => None,
        });
        Self {
            constants: constants.collect(),
            values: values.collect(),
        }
    }
}

/// Values of an entry point in any number type. `at` gives elements of arguments.
fn evaluate<T: Scalar>(
    program: &Program,
    numbers: &Numbers,
    entry: &Entry,
    parameters: &[T],
    at: impl Fn(Argument, usize) -> T,
) -> Vec<T> {
    let number = |parts: Option<(f64, f64)>| {
        let (high, low) = parts.expect("an operation with a number");
        T::from_parts(high, low)
    };
    let mut constants: Vec<T> = Vec::new();
    for (definition, &parts) in program.setup.definitions.iter().zip(&numbers.constants) {
        let of = |id: ConstantId| constants[id.0 as usize];
        constants.push(match (&definition.exact, &definition.op) {
            (Some(_), _) | (None, ConstantOp::Number(_)) => number(parts),
            (None, &ConstantOp::Parameter(index)) => parameters[index],
            (None, &ConstantOp::Named(_, a) | &ConstantOp::Called(a)) => of(a),
            (None, ConstantOp::Product(_, powers)) => {
                let mut product = number(parts);
                for &(id, power) in powers {
                    for _ in 0..power.unsigned_abs() {
                        product = match power > 0 {
                            true => product * of(id),
                            false => product / of(id),
                        };
                    }
                }
                product
            }
            (None, &ConstantOp::Add(a, b)) => of(a) + of(b),
            (None, &ConstantOp::Sub(a, b)) => of(a) - of(b),
        });
    }
    let mut values: Vec<T> = Vec::new();
    let last = entry.outputs.iter().map(|id| id.0 as usize).max();
    let needed = &program.definitions[..=last.expect("outputs")];
    for (definition, &parts) in needed.iter().zip(&numbers.values) {
        let of = |id: ValueId| values[id.0 as usize];
        values.push(match &definition.op {
            // An argument of other functions: their values are not used.
            &Op::Input(argument, _) if !entry.arguments.contains(&argument) => T::from_f64(1.0),
            &Op::Input(argument, index) => at(argument, index),
            Op::Constant(id) => constants[id.0 as usize],
            Op::Number(_) => number(parts),
            &Op::Sin(a) => of(a).sin_cos().0,
            &Op::Cos(a) => of(a).sin_cos().1,
            &Op::Sqrt(a) => of(a).sqrt(),
            &Op::Neg(a) => -of(a),
            &Op::Add(a, b) => of(a) + of(b),
            &Op::Sub(a, b) => of(a) - of(b),
            &Op::Mul(a, b) => of(a) * of(b),
            &Op::Div(a, b) => of(a) / of(b),
        });
    }
    entry
        .outputs
        .iter()
        .map(|id| values[id.0 as usize])
        .collect()
}

/// A function, its derivatives, and numbers at which both are compared.
struct Case<'a> {
    program: &'a Program,
    numbers: Rc<Numbers>,
    derivatives: &'a Entry,
    function: &'a Entry,
    time: f64,
    /// Values of the arguments other than the time, one after the other, then of the parameters.
    point: Vec<f64>,
    links: usize,
    /// Weights of the function's outputs.
    weights: Vec<f64>,
}

impl<'a> Case<'a> {
    /// All functions with derivatives, each at a random point.
    fn all(compiled: &'a Compiled, random: &mut Random) -> Vec<Self> {
        let program = &compiled.program;
        let numbers = Rc::new(Numbers::new(program));
        let of = |entry: &&Entry| {
            use Purpose::{AccelerationsPullback, AccelerationsUnderPullback, Gradient};
            let purpose = entry.purpose;
            matches!(
                purpose,
                AccelerationsPullback | AccelerationsUnderPullback | Gradient(_)
            )
        };
        let cases = program.entries.iter().filter(of).map(|derivatives| {
            let (name, _) = derivatives.name.rsplit_once('_').expect("a compound name");
            let function = program.entry(name).expect("the function is emitted");
            let arrays = function.arguments.iter();
            let arrays = arrays
                .filter(|argument| **argument != Argument::Time)
                .count();
            let links = compiled.scene.links.len();
            let mut point = random.around_zero(arrays * links, 2.0);
            point.extend(
                compiled
                    .scene
                    .parameters
                    .iter()
                    .map(|_| random.between(0.6, 1.1)),
            );
            let outputs = function.outputs.len();
            let weights = match derivatives.arguments.contains(&Argument::Weights) {
                true => random.around_zero(outputs, 1.0),
                false => vec![1.0; outputs],
            };
            let time = random.between(0.0, 5.0);
            Case {
                program,
                numbers: Rc::clone(&numbers),
                derivatives,
                function,
                time,
                point,
                links,
                weights,
            }
        });
        cases.collect()
    }

    /// Returns the function at another point, in any number type.
    fn values<T: Scalar>(&self, point: &[T]) -> Vec<T> {
        let (arguments, parameters) = point.split_at(self.arrays() * self.links);
        self.on(self.function, arguments, parameters)
    }

    fn arrays(&self) -> usize {
        let all = self.function.arguments.iter();
        all.filter(|argument| **argument != Argument::Time).count()
    }

    fn on<T: Scalar>(&self, entry: &Entry, arguments: &[T], parameters: &[T]) -> Vec<T> {
        let places: Vec<Argument> = entry.arguments.clone();
        let places: Vec<Argument> = places
            .into_iter()
            .filter(|argument| *argument != Argument::Time)
            .collect();
        evaluate(
            self.program,
            &self.numbers,
            entry,
            parameters,
            |argument, index| match argument {
                Argument::Time => T::from_f64(self.time),
                Argument::Weights => T::from_f64(self.weights[index]),
                argument => {
                    let place = places.iter().position(|known| *known == argument);
                    arguments[place.expect("an argument of the function") * self.links + index]
                }
            },
        )
    }

    /// Returns the derivatives by the reverse pass.
    fn reverse<T: Scalar>(&self) -> Vec<T> {
        let point: Vec<T> = self.point.iter().map(|&value| T::from_f64(value)).collect();
        let (arguments, parameters) = point.split_at(self.arrays() * self.links);
        self.on(self.derivatives, arguments, parameters)
    }

    /// Compares ⟨w, J v⟩ by tangents with ⟨Jᵀ w, v⟩ for one direction v, both in 31 digits, so that
    /// cancellation in the function itself does not hide a mistake.
    fn against_tangents(&self, direction: &[f64], worst: &mut Worst, place: &str) {
        let double = Double::from_f64;
        let point = self.point.iter().zip(direction);
        let point: Vec<Dual<Double, 1>> = point
            .map(|(&value, &tangent)| Dual {
                value: double(value),
                tangents: [double(tangent)],
            })
            .collect();
        let forward = self.values(&point).into_iter().zip(&self.weights);
        let forward = forward.map(|(value, &weight)| value.tangents[0] * double(weight));
        let backward = self.reverse::<Double>();
        assert_eq!(backward.len(), direction.len(), "{place}");
        let backward = backward.into_iter().zip(direction);
        let backward = backward.map(|(slope, &tangent)| -slope * double(tangent));
        let terms: Vec<Double> = forward.chain(backward).collect();
        let size: f64 = terms.iter().map(|term| term.to_f64().abs()).sum();
        if size > 0.0 {
            let error = terms.into_iter().fold(double(0.0), |sum, term| sum + term);
            worst.note(error.to_f64(), size, || {
                format!("{} of {place}", self.function.name)
            });
        }
    }

    /// Compares every derivative with a central difference in 31 digits.
    fn against_differences(&self, worst: &mut Worst, place: &str) {
        const STEP: f64 = 1.0 / 1_048_576.0;
        let reverse = self.reverse::<f64>();
        let size = reverse
            .iter()
            .fold(0.0_f64, |size, value| size.max(value.abs()));
        for (index, &found) in reverse.iter().enumerate() {
            let at = |steps: f64| {
                let mut point: Vec<Double> = self
                    .point
                    .iter()
                    .map(|&value| Double::from_f64(value))
                    .collect();
                point[index] += Double::from_f64(steps * STEP);
                let weights = self.weights.iter().map(|&weight| Double::from_f64(weight));
                let terms = self.values(&point).into_iter().zip(weights);
                let terms = terms.map(|(value, weight)| value * weight);
                terms.fold(Double::from_f64(0.0), |sum, term| sum + term)
            };
            // Differences of order 6.
            let difference = |steps: f64| at(steps) - at(-steps);
            let sum = difference(1.0) * Double::from_f64(45.0)
                - difference(2.0) * Double::from_f64(9.0)
                + difference(3.0);
            let expected = sum / Double::from_f64(60.0 * STEP);
            let error = (Double::from_f64(found) - expected).to_f64();
            worst.note(error, size, || format!("{} of {place}", self.function.name));
        }
    }
}

/// The fixture scenes whose code is written out, with all derivatives.
const SCENES: [&str; 14] = [
    "blades",
    "branch",
    "chain",
    "damped_series",
    "driven",
    "driven_series",
    "free_series",
    "nested",
    "observed",
    "offset",
    "paper",
    "series",
    "simple",
    "unequal",
];

/// A fixture scene with `emit(gradient)` in addition to its own outputs.
fn scene(name: &str) -> Compiled {
    let path = branched_pendulum_compiler_tests::source::fixture(&format!("scenes/{name}.rs"));
    let text = std::fs::read_to_string(path).expect("the fixture exists");
    let more = match text.contains("emit(") {
        true => text.replacen("emit(", "emit(gradient, ", 1),
        false => text.replacen(
            "#[branched_pendulum(",
            "#[branched_pendulum(emit(gradient), ",
            1,
        ),
    };
    compile_item(&more)
}

#[test]
fn pullbacks_of_all_scenes_are_transposed_tangents() {
    let mut worst = Worst::default();
    let mut random = Random::new(7);
    for name in SCENES {
        let compiled = scene(name);
        for _ in 0..20 {
            let cases = Case::all(&compiled, &mut random);
            assert!(!cases.is_empty(), "{name}");
            for case in cases {
                let direction = random.around_zero(case.point.len(), 1.0);
                case.against_tangents(&direction, &mut worst, name);
            }
        }
    }
    worst.assert_below(1e-24, "⟨w, J v⟩ − ⟨Jᵀ w, v⟩");
}

/// Multiplies some numbers of a description by parameters, each of which occurs in several places.
fn with_parameters(text: &str, random: &mut Random) -> String {
    let mut found = String::new();
    let mut rest = text;
    while let Some(end) = rest.find(" = ") {
        let (head, tail) = rest.split_at(end + 3);
        found.push_str(head);
        let names = [
            "mass",
            "length",
            "spring",
            "friction",
            "quadratic",
            "gravity",
            "inertia",
        ];
        let scaled = names
            .iter()
            .any(|name| head.ends_with(&format!("{name} = ")));
        if scaled && tail.starts_with(|first: char| first.is_ascii_digit()) && random.below(2) == 0
        {
            found.push_str(&format!("scale_{} * ", random.below(4)));
        }
        rest = tail;
    }
    found + rest
}

/// Returns the description of a tree with friction laws, springs, straight springs, drive, offsets
/// and parameters.
pub(crate) fn random_description(seed: u64, random: &mut Random) -> String {
    let recipe = Recipe {
        links: 2 + random.below(4),
        copies: &[1, 1, 2],
        nested: true,
        requests: "",
    };
    let sample = coupled_sample(&recipe, seed, Coupling::Any);
    let mut text = with_parameters(&sample.text, random);
    if random.below(3) == 0 {
        text += ", drive(torque = 0.2 * push * cos(3 * t + push), y = 0.01 * cos(pace * t))";
    }
    if random.below(2) == 0 {
        text += ", guy(link_0, at = (0.4, 0.1), to = (-0.4, height), spring = 6, rest = 0.5, \
                 friction = 0.2 * height)";
    }
    if text.contains("guy(") && text.contains("drive(") {
        // A guy beside a drive that moves the pivot is refused.
        text = text.replace(", y = 0.01 * cos(pace * t)", "");
    }
    text
}

/// Random trees with friction laws, springs, straight springs, drives, offsets and parameters.
#[test]
fn derivatives_of_random_trees_agree_with_differences_in_31_digits() {
    let mut worst = Worst::default();
    let mut with = 0;
    let seeds = seeds(50);
    for seed in seeds.clone() {
        let mut random = Random::new(9000 + seed);
        let text = random_description(seed, &mut random)
            + match random.below(2) {
                0 => ", emit(gradient(accelerations, energies))",
                _ => ", emit(forces, gradient(accelerations, energies))",
            };
        let compiled = compile(&text);
        with += u64::from(!compiled.scene.parameters.is_empty());
        for case in Case::all(&compiled, &mut random) {
            case.against_differences(&mut worst, &format!("tree {seed}"));
        }
    }
    assert!(2 * with > seeds.end, "{with} trees have parameters");
    worst.assert_below(1e-10, "derivatives");
}

/// All derivatives, with those by three parameters that each link has, cost some 2.5 evaluations:
/// a sine with its cosine counts as 19 products, a division as 6.
#[test]
fn pullbacks_cost_little_more_than_two_evaluations() {
    for links in [3, 7, 15, 31] {
        let mut text = "gravity = g, root: rod(mass = m, length = l) [".to_owned();
        let chain = (1..links).map(|link| format!("link_{link}: rod(mass = m, length = l)"));
        text += &chain.collect::<Vec<_>>().join(" [");
        text += &"]".repeat(links - 1);
        text += ", solve = recursion, emit(energies, gradient)";
        let program = compile(&text).program;
        let cost = |name: &str| {
            let entry = program.entry(name).expect("an entry point");
            let all = program.operations(&entry.outputs);
            let sums = all.additions + all.multiplications + all.negations;
            (sums + 6 * (all.divisions + all.roots) + 19 * all.sin_cos) as f64
        };
        let ratio = cost("accelerations_pullback") / cost("accelerations");
        println!("{links} links: {ratio:.2}");
        assert!(ratio <= 2.6, "{links} links: {ratio}");
    }
}
