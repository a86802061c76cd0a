//! Observables: quantities that the user defines by `observe(...)`, and their rates.

use std::collections::BTreeMap;

use branched_pendulum::scalar::{Double, Dual, Scalar};
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{NonConservative, StateInput, SymmetricTree};
use branched_pendulum::translational::TranslationalSpringDampers;
use branched_pendulum_codegen::scene::{
    CoordinateIndex, FrictionContact, FrictionLaw, Function, LinkId, Observed, ObservedAtom, Scene,
    Variable, VariableKind,
};

use crate::error::TreeError;
use crate::numbers::{self, evaluate};
use crate::symmetric::unchecked;
use crate::tree::PendulumTree;

/// A quantity of one tree that its description defines by `observe(NAME = EXPRESSION)`.
///
/// # Examples
///
/// ```
/// use branched_pendulum::transfer::StateInput;
/// use branched_pendulum_trees::PendulumTree;
///
/// let tree = PendulumTree::parse(
///     "gravity = 9.80665,
///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///          child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///      ],
///      observe(h_d = p_d^2 / (4 * inertia_child) + gravity_child * sin(theta_d)^2)",
/// )?;
/// assert_eq!(tree.observable_names().collect::<Vec<_>>(), ["h_d"]);
/// let h_d = tree.observable("h_d")?;
///
/// // The paper's H_d, and W: of a tree without friction and drive the rate of H_d.
/// let (theta, omega) = ([0.4, 0.3, -0.2], [1.0, -2.0, 0.5]);
/// let given = StateInput::Absolute { theta: &theta, omega: &omega };
/// let symmetric = tree.symmetric()?;
/// let mut energies = [[0.0; 2]; 2];
/// let workspace = &mut branched_pendulum::system::Workspace::new();
/// symmetric.energies(workspace, given, &mut energies);
/// assert!((h_d.value(given) - energies[1].iter().sum::<f64>()).abs() < 1e-15);
/// let mut w = [branched_pendulum::Transfer::default(); 2];
/// symmetric.exact_transfers(workspace, given, &mut w);
/// assert!((h_d.rate(0.0, given) - w[1].total()).abs() < 1e-13);
/// # Ok::<(), branched_pendulum_trees::TreeError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Observable {
    tree: PendulumTree<f64>,
    symmetric: SymmetricTree<f64>,
    moving: SymmetricTree<Dual<f64, 1>>,
    moving_springs: TranslationalSpringDampers<Dual<f64, 1>>,
    value: Observed,
    parameters: Vec<Double>,
    constants: BTreeMap<String, f64>,
}

impl PendulumTree<f64> {
    /// Returns the names of the observables that the description defines.
    pub fn observable_names(&self) -> impl Iterator<Item = &str> {
        let observables = self.description().scene.observables.iter();
        observables.map(|observable| observable.name.as_str())
    }

    /// Returns the observable with that name.
    ///
    /// # Errors
    /// [`TreeError::UnknownObservable`] if there is none, and [`TreeError::Constant`] if it uses
    /// constants of copies that differ.
    pub fn observable(&self, name: &str) -> Result<Observable, TreeError> {
        let scene = &self.description().scene;
        let mut observables = scene.observables.iter();
        let Some(found) = observables.find(|observable| observable.name == name) else {
            return Err(TreeError::UnknownObservable {
                name: name.to_owned(),
                observables: self.observable_names().map(str::to_owned).collect(),
            });
        };
        let values = self.described.values();
        let parameters: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
        let symmetric = unchecked(self.description(), values, self.described.symmetry())?;
        let constants = constants(scene, &parameters, &symmetric)?;
        if let Some(constant) = unknown(&found.value, &constants) {
            return Err(TreeError::Constant {
                observable: name.to_owned(),
                constant,
            });
        }
        Ok(Observable {
            tree: self.clone(),
            moving_springs: self.translational_spring_dampers().cast(Dual::constant),
            moving: symmetric.cast(Dual::constant),
            symmetric,
            value: found.value.clone(),
            parameters,
            constants,
        })
    }
}

impl Observable {
    /// Returns the value of the observable at a state; NaN if a slice does not have one number per
    /// link.
    #[must_use]
    pub fn value(&self, given: StateInput<'_, f64>) -> f64 {
        let Some([theta, omega]) = self.absolute(given) else {
            return f64::NAN;
        };
        let springs = self.tree.translational_spring_dampers();
        self.at((&self.symmetric, springs), [&theta, &omega])
    }

    /// Returns the rate of change of the observable along the motion under all forces, at a time
    /// (s) of the drive, computed with dual numbers. NaN if a slice does not have one number per
    /// link.
    #[must_use]
    pub fn rate(&self, time: f64, given: StateInput<'_, f64>) -> f64 {
        let Some([theta, omega]) = self.absolute(given) else {
            return f64::NAN;
        };
        let alpha = self.tree.accelerations(time, &theta, &omega);
        self.changing([along(&theta, &omega), along(&omega, &alpha)])
    }

    /// Returns the part of the rate of change that is caused by friction and drag.
    #[must_use]
    pub fn friction_rate(&self, given: StateInput<'_, f64>) -> f64 {
        let Some([theta, omega]) = self.absolute(given) else {
            return f64::NAN;
        };
        let mut alpha = vec![0.0; theta.len()];
        let workspace = &mut Workspace::new();
        let symmetric = &self.symmetric;
        symmetric.accelerations_by(workspace, NonConservative::Friction, given, &mut alpha);
        let still = vec![0.0; theta.len()];
        let dampers = self.tree.translational_spring_dampers();
        if !dampers.is_empty() {
            let [mut torques, mut own] = [(); 2].map(|()| still.clone());
            dampers.add_friction([&theta, &omega], &mut torques);
            self.tree.solve_mass(workspace, &theta, &torques, &mut own);
            for (alpha, own) in alpha.iter_mut().zip(own) {
                *alpha += own;
            }
        }
        self.changing([along(&theta, &still), along(&omega, &alpha)])
    }

    /// Returns the derivative of the observable, given angles and velocities with their
    /// derivatives.
    fn changing(&self, [theta, omega]: [Vec<Dual<f64, 1>>; 2]) -> f64 {
        let [rate] = self
            .at((&self.moving, &self.moving_springs), [&theta, &omega])
            .tangents;
        rate
    }

    /// Returns angles and angular velocities of a state; `None` if a slice does not have one number
    /// per link.
    fn absolute(&self, given: StateInput<'_, f64>) -> Option<[Vec<f64>; 2]> {
        let symmetric = &self.symmetric;
        let mut found = [(); 2].map(|()| vec![0.0; symmetric.links()]);
        let [theta, omega] = &mut found;
        symmetric.absolute(&mut Workspace::new(), given, [theta, omega]);
        theta
            .iter()
            .chain(&*omega)
            .all(|value| !value.is_nan())
            .then_some(found)
    }

    /// Returns the value of the observable for a tree with straight springs, at the given angles
    /// and velocities.
    fn at<S: Scalar>(
        &self,
        (tree, springs): (&SymmetricTree<S>, &TranslationalSpringDampers<S>),
        [theta, omega]: [&[S]; 2],
    ) -> S {
        let (workspace, plain) = (&mut Workspace::new(), Normalisation::Plain);
        let given = StateInput::Absolute { theta, omega };
        let zeros = vec![S::from_f64(0.0); theta.len()];
        let [mut coordinates, mut rates, mut momenta, mut absolute] =
            [(); 4].map(|()| zeros.clone());
        tree.coordinates(workspace, given, &mut coordinates);
        tree.rates(workspace, given, &mut rates);
        tree.momenta(workspace, given, &mut momenta);
        tree.absolute_momenta_from_symmetric(plain, &momenta, &mut absolute);
        let [kinetic, mut potential] = tree.kinetic_and_potential_energy(workspace, given);
        if !springs.is_empty() {
            potential = potential + springs.energy(theta);
        }
        let values = Values {
            absolute: [theta, omega, &absolute],
            symmetric: [&coordinates, &rates, &momenta],
            kinetic,
            potential,
            parameters: &self.parameters,
            constants: &self.constants,
        };
        values.of(&self.value)
    }
}

fn along(values: &[f64], rates: &[f64]) -> Vec<Dual<f64, 1>> {
    let pairs = values.iter().zip(rates);
    let moving = |(&value, &rate): (&f64, &f64)| Dual {
        value,
        tangents: [rate],
    };
    pairs.map(moving).collect()
}

/// Values of all symbols in the expression: angles, velocities and momenta, of links and of
/// symmetric coordinates.
struct Values<'a, S> {
    absolute: [&'a [S]; 3],
    symmetric: [&'a [S]; 3],
    kinetic: S,
    potential: S,
    parameters: &'a [Double],
    constants: &'a BTreeMap<String, f64>,
}

impl<S: Scalar> Values<'_, S> {
    fn of(&self, expression: &Observed) -> S {
        evaluate(expression, &|atom| self.atom(atom))
    }

    fn atom(&self, atom: &ObservedAtom) -> S {
        match atom {
            ObservedAtom::Known(quantity) => {
                let value = numbers::value(quantity, self.parameters);
                S::from_parts(value.high(), value.low())
            }
            ObservedAtom::Variable(variable) => self.variable(variable),
            ObservedAtom::Constant(name) => {
                S::from_f64(self.constants.get(name).copied().unwrap_or(f64::NAN))
            }
            ObservedAtom::KineticEnergy => self.kinetic,
            ObservedAtom::PotentialEnergy => self.potential,
            ObservedAtom::Call(function, argument) => {
                let argument = self.of(argument);
                match function {
                    Function::Sin => argument.sin_cos().0,
                    Function::Cos => argument.sin_cos().1,
                    Function::Sqrt => argument.sqrt(),
                }
            }
        }
    }

    fn variable(&self, variable: &Variable) -> S {
        let (kinds, index) = match variable.coordinate {
            CoordinateIndex::Absolute(index) => (&self.absolute, index),
            CoordinateIndex::Symmetric(index) => (&self.symmetric, index),
        };
        let [angles, velocities, momenta] = kinds;
        let values = match variable.kind {
            VariableKind::Angle => angles,
            VariableKind::Velocity => velocities,
            VariableKind::Momentum => momenta,
        };
        values.get(index).copied().unwrap_or(S::from_f64(f64::NAN))
    }
}

/// Returns the constants of the model by name, except those of copies that differ.
fn constants(
    scene: &Scene,
    parameters: &[Double],
    tree: &SymmetricTree<f64>,
) -> Result<BTreeMap<String, f64>, TreeError> {
    let links = numbers::links(scene, parameters)?;
    let orbit = |link: usize| {
        let link = scene.links.get(link)?;
        scene.orbits.get(link.orbit.0)
    };
    let mut constants = BTreeMap::new();
    for own in &scene.orbits {
        let Some(&LinkId(first)) = own.links.first() else {
            continue;
        };
        let mut add =
            |word: &str, value: f64| constants.insert(format!("{word}_{}", own.name), value);
        let [gravity, lateral] = tree.gravity(first);
        add("inertia", tree.inertia(first));
        add("gravity", gravity);
        add("lateral_gravity", lateral);
        if let Some(passive) = links.get(first).map(|link| link.passive) {
            for (word, value) in [
                ("friction", &passive.friction),
                ("drag", &passive.drag),
                ("spring", &passive.spring),
                ("rest", &passive.rest),
            ] {
                add(word, value.high());
            }
            for place in FrictionContact::ALL {
                let names = FrictionLaw::NAMES.into_constants().into_iter();
                let values = passive.law(place).into_constants();
                for (constant, value) in names.zip(values) {
                    if let Some(word) = constant.words[place as usize] {
                        add(word, value.high());
                    }
                }
            }
        }
        let above = |link: usize| scene.links.get(link)?.parent.map(|LinkId(parent)| parent);
        let mut other = above(first);
        while let Some(ancestor) = other {
            let [coupling, lateral] = tree.coupling(first, ancestor);
            let name = orbit(ancestor).map_or("", |orbit| &orbit.name);
            for (word, value) in [("coupling", coupling), ("lateral_coupling", lateral)] {
                constants.insert(format!("{word}_{}_{name}", own.name), value);
            }
            other = above(ancestor);
        }
    }
    Ok(constants)
}

/// Returns a constant that the expression uses but that is not among `constants`, if there is one.
fn unknown(value: &Observed, constants: &BTreeMap<String, f64>) -> Option<String> {
    value.atoms().into_iter().find_map(|atom| match atom {
        ObservedAtom::Constant(name) => (!constants.contains_key(name)).then(|| name.clone()),
        ObservedAtom::Call(_, argument) => unknown(argument, constants),
        _ => None,
    })
}
