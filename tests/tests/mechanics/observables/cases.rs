//! Random trees with random observables, and what is known of them.

use std::sync::LazyLock;

use branched_pendulum_codegen::report::Faults;
use branched_pendulum_codegen::scene::coordinates::{Coordinate, symmetric_coordinates};
use branched_pendulum_codegen::{description, scene};
use branched_pendulum_compiler_tests::random::Random;
use branched_pendulum_compiler_tests::source::attributed_struct;
use branched_pendulum_tests::oracle::Tree;
use branched_pendulum_tests::oracle::cartesian::Motion;
use branched_pendulum_tests::oracle::generator::{Recipe, sample};
use branched_pendulum_tests::oracle::observable::Observable;
use nalgebra::DVector;

use crate::support::{Compiled, compile};
const TREES: u64 = 30;
pub(super) const OBSERVABLES: usize = 10;

/// A tree with observables, and all that is known of it.
pub(super) struct Case {
    pub(super) tree: Tree,
    coordinates: Vec<Coordinate>,
    observables: Vec<Observable>,
    pub(super) compiled: Compiled,
}

/// Thirty trees to 20 links with ten observables each.
pub(super) static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| (0..TREES).map(case).collect());

fn case(seed: u64) -> Case {
    let recipe = Recipe {
        links: match seed {
            9 => 20,
            other => 2 + other as usize % 10,
        },
        copies: &[1, 1, 2, 3],
        nested: true,
        requests: "momenta",
    };
    let sample = sample(&recipe, 7000 + seed);
    let (names, coordinates) = names(&sample.text);
    let mut symbols: Vec<String> = ["kinetic_energy", "potential_energy"]
        .map(str::to_owned)
        .to_vec();
    let mut add = |name: &str| {
        for prefix in ["theta", "omega", "p", "theta", "omega", "p"] {
            symbols.push(format!("{prefix}_{name}"));
        }
    };
    names.iter().for_each(|name| add(name));
    let absolute = symbols.clone();
    let mut add = |name: &str| {
        for prefix in ["theta", "omega", "p"] {
            symbols.push(format!("{prefix}_{name}"));
        }
    };
    coordinates.iter().for_each(|c| add(&c.name));
    let mut random = Random::new(8000 + seed);
    let observables: Vec<Observable> = (0..OBSERVABLES)
        .map(|number| {
            let symbols = if number % 2 == 0 { &absolute } else { &symbols };
            Observable::random(&mut random, symbols, 4)
        })
        .collect();
    let written: Vec<String> = observables
        .iter()
        .enumerate()
        .map(|(number, observable)| format!("o_{number} = {}", observable.text()))
        .collect();
    let text = format!("{}, observe({})", sample.text, written.join(", "));
    Case {
        tree: sample.tree,
        coordinates,
        observables,
        compiled: compile(&text),
    }
}

/// The names of the links and the symmetric coordinates of several links.
fn names(arguments: &str) -> (Vec<String>, Vec<Coordinate>) {
    let source = format!("#[branched_pendulum({arguments})] struct Sample;");
    let (attribute, item) = attributed_struct(&source);
    let mut report = Faults::new();
    let scene = description::parse(attribute, item, &mut report)
        .and_then(|description| scene::resolve(&description, &mut report))
        .expect("samples have no mistakes");
    let coordinates = match scene.groups.is_empty() {
        true => Vec::new(),
        false => symmetric_coordinates(&scene),
    };
    let names = scene.links.into_iter().map(|link| link.name).collect();
    let several = |coordinate: &Coordinate| coordinate.weights.len() > 1;
    (names, coordinates.into_iter().filter(several).collect())
}

/// A state and what observables may ask of it, with the sizes of the terms that
/// each figure is summed from.
pub(super) struct Point<'a> {
    case: &'a Case,
    theta: Vec<f64>,
    omega: Vec<f64>,
    motion: Motion,
    momenta: DVector<f64>,
    momenta_terms: DVector<f64>,
}

impl<'a> Point<'a> {
    pub(super) fn new(case: &'a Case, theta: &[f64], omega: &[f64]) -> Self {
        let motion = Motion::new(&case.tree, theta, omega);
        let velocities = DVector::from_column_slice(omega);
        Self {
            case,
            theta: theta.to_vec(),
            omega: omega.to_vec(),
            momenta: &motion.mass * &velocities,
            momenta_terms: &motion.mass_terms * velocities.abs(),
            motion,
        }
    }

    /// A symbol's value and the sum of its absolute terms.
    fn symbol(&self, name: &str) -> (f64, f64) {
        match name {
            "kinetic_energy" => return (self.motion.kinetic, self.motion.kinetic_terms),
            "potential_energy" => return (self.motion.potential, self.motion.potential_terms),
            _ => {}
        }
        let (kind, place) = name.split_once('_').expect("symbols have two parts");
        let n = self.theta.len();
        let (values, terms): (Vec<f64>, Vec<f64>) = match kind {
            "theta" => (0..n).map(|i| (self.theta[i], self.theta[i].abs())).unzip(),
            "omega" => (0..n).map(|i| (self.omega[i], self.omega[i].abs())).unzip(),
            _ => (0..n)
                .map(|i| (self.momenta[i], self.momenta_terms[i]))
                .unzip(),
        };
        let links = &self.case.compiled.scene.links;
        if let Some(link) = links.iter().position(|link| link.name == place) {
            return (values[link], terms[link]);
        }
        let mut coordinates = self.case.coordinates.iter();
        let coordinate = coordinates
            .find(|c| c.name == place)
            .expect("a symbol is a link's or a coordinate's");
        let norm = match kind {
            "p" => 1.0,
            _ => coordinate.norm() as f64,
        };
        let sum = |values: &[f64], size: fn(f64) -> f64| -> f64 {
            let weights = coordinate.weights.iter();
            weights.map(|(l, w)| size(*w as f64) * values[l.0]).sum()
        };
        (sum(&values, |w| w) / norm, sum(&terms, f64::abs) / norm)
    }

    pub(super) fn observable(&self, number: usize) -> (f64, f64) {
        self.case.observables[number].evaluate(&|name| self.symbol(name))
    }

    /// Inputs of the emitted functions: absolute or symmetric, velocities or
    /// momenta.
    fn inputs(&self, number: usize) -> [Vec<f64>; 3] {
        let compiled = &self.case.compiled;
        let momenta = self.momenta.as_slice();
        if !compiled.mechanics.observables.list[number].symmetric {
            return [self.theta.clone(), self.omega.clone(), momenta.to_vec()];
        }
        let weighted = |values: &[f64], normed: bool| -> Vec<f64> {
            let coordinates = compiled.mechanics.coordinates.iter();
            coordinates
                .map(|c| {
                    let sum: f64 = c.weights.iter().map(|(l, w)| *w as f64 * values[l.0]).sum();
                    sum / if normed { c.norm() as f64 } else { 1.0 }
                })
                .collect()
        };
        [
            weighted(&self.theta, true),
            weighted(&self.omega, true),
            weighted(momenta, false),
        ]
    }

    pub(super) fn evaluate(&self, number: usize, suffix: &str) -> f64 {
        let [q, v, p] = self.inputs(number);
        let second = if suffix.ends_with("momenta") { p } else { v };
        let compiled = &self.case.compiled;
        compiled.evaluate(&format!("o_{number}{suffix}"), &[&q, &second])[0]
    }
}
