//! What is known of the parameters of a tree, and the tree as a family of models.

use branched_pendulum_trees::{ParameterUse, TreeDescription, TreeError};

use super::arguments::{Arguments, Law};
use crate::Failure;
use crate::subject::{Described, Subject};

/// A tree whose parameters are looked for.
#[derive(Clone, Debug)]
pub struct Unknowns {
    described: Described,
    /// All parameters of the description, in their order.
    pub parameters: Vec<Parameter>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name in the description.
    pub name: String,
    /// What is known of it.
    pub knowledge: Knowledge,
    uses: Vec<ParameterUse>,
}

/// What is known of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Knowledge {
    /// The value.
    Known(f64),
    /// A value from which it is searched.
    Guess(f64),
    /// The size that it may have; it is searched from 0.
    Size(f64),
}

impl Parameter {
    /// The poorest law of friction that it belongs to; the poorest of all for what is no
    /// coefficient of friction.
    pub fn law(&self) -> Law {
        let has = |of| self.uses.contains(&of);
        match self.is_friction() {
            true if has(ParameterUse::QuadraticFriction) => Law::All,
            true if has(ParameterUse::ViscousFriction) => Law::Viscous,
            true => Law::Coulomb,
            false => Law::Viscous,
        }
    }

    /// Returns true if it is a coefficient of friction and nothing else.
    pub fn is_friction(&self) -> bool {
        let of_friction = |of: &ParameterUse| {
            matches!(
                of,
                ParameterUse::ViscousFriction
                    | ParameterUse::CoulombFriction
                    | ParameterUse::QuadraticFriction
            )
        };
        !self.uses.is_empty() && self.uses.iter().all(of_friction)
    }

    /// Returns true if a scale or a ruler tells it.
    pub fn is_measurable(&self) -> bool {
        let of_scale = |of: &ParameterUse| matches!(of, ParameterUse::Mass | ParameterUse::Place);
        self.uses.iter().any(of_scale)
    }

    /// Size of a coefficient of friction that nothing is known of: N m s, N m or N m s².
    fn size(&self) -> Option<f64> {
        self.is_friction().then(|| match self.law() {
            Law::Viscous | Law::Coulomb => 1e-4,
            Law::All => 1e-5,
        })
    }
}

impl Unknowns {
    /// Reads the tree of the arguments, and what is known of it.
    ///
    /// # Errors
    /// [`Failure::NoTree`] and [`Failure::Tree`]; [`Failure::Lacking`] for parameters of which
    /// nothing is known, and where nothing is to be found.
    pub fn new(arguments: &Arguments) -> Result<Self, Failure> {
        let described = arguments.tree.described()?;
        let asked: Vec<_> = arguments.unknown.iter().flatten().collect();
        let names = || described.description.parameters();
        let set = described.set.iter().map(|(name, _)| name);
        for name in set.chain(asked.iter().map(|(name, _)| name)) {
            if names().all(|own| own != name) {
                return Err(described.refused(TreeError::UnknownParameter {
                    name: name.clone(),
                    parameters: names().map(str::to_owned).collect(),
                }));
            }
        }
        let mut parameters = Vec::new();
        for name in names() {
            let parameter = Parameter {
                name: name.to_owned(),
                knowledge: Knowledge::Known(f64::NAN),
                uses: described.description.uses_of(name),
            };
            let knowledge = knowledge(&described, &parameter, &asked)?;
            parameters.push(Parameter {
                knowledge,
                ..parameter
            });
        }
        let unknowns = Self {
            described,
            parameters,
        };
        let is_known = |parameter: &Parameter| matches!(parameter.knowledge, Knowledge::Known(_));
        match unknowns.parameters.iter().all(is_known) {
            false => Ok(unknowns),
            true => Err(Failure::Lacking {
                what: format!(
                    "nothing of the tree `{}` is to be found: write names in place of numbers in its \
                     description, as in `mass = m`, and name them by `--unknown m=0.1`",
                    unknowns.described.name
                ),
            }),
        }
    }

    /// The laws that search for other parameters than those before them.
    pub fn laws(&self, asked: &[Law]) -> Vec<Law> {
        let searched = |law: Law| {
            let all = self.parameters.iter();
            all.map(|own| own.is_searched(law)).collect::<Vec<bool>>()
        };
        let mut laws: Vec<Law> = Vec::new();
        for &law in asked {
            if laws.iter().all(|&own| searched(own) != searched(law)) {
                laws.push(law);
            }
        }
        laws
    }

    /// The parameter of this name; none for offsets and ratios.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|own| own.name == name)
    }

    /// Names of the links.
    pub fn links(&self) -> Vec<String> {
        self.described.description.links()
    }

    /// The family of the trees.
    pub fn family(&self) -> TreeDescription {
        self.described.description.clone()
    }

    /// The tree with values of all parameters.
    ///
    /// # Errors
    /// [`Failure::Tree`] for values that no pendulum can have.
    pub fn subject(&self, values: &[f64]) -> Result<Subject, Failure> {
        let names = self.parameters.iter().map(|own| own.name.as_str());
        let values: Vec<_> = names.zip(values.iter().copied()).collect();
        self.described.subject(&values)
    }

    /// The tree with values that need not be possible.
    ///
    /// # Errors
    /// [`Failure::Tree`] for too few values.
    pub fn subject_as_given(&self, values: &[f64]) -> Result<Subject, Failure> {
        let described = &self.described;
        let tree = described.description.tree_as_given(values);
        Ok(described.with_tree(tree.map_err(|source| described.refused(source))?))
    }

    /// Values from which the search begins.
    pub fn guesses(&self) -> Vec<f64> {
        let values = self.parameters.iter().map(|own| match own.knowledge {
            Knowledge::Known(value) | Knowledge::Guess(value) => value,
            Knowledge::Size(_) => 0.0,
        });
        values.collect()
    }

    /// Offsets of links that are known, rad.
    pub fn offsets(&self) -> &[(String, f64)] {
        &self.described.offsets
    }

    /// Values of a simulated tree: unknown ones are some 20 % off from their guesses.
    pub fn simulated(&self) -> Vec<f64> {
        let mut guesses = (0..9).cycle();
        let values = self.parameters.iter().map(|own| match own.knowledge {
            Knowledge::Known(value) | Knowledge::Size(value) => value,
            Knowledge::Guess(value) => {
                let number = guesses.next().unwrap_or(0);
                value * (0.8 + 0.05 * f64::from(number))
            }
        });
        values.collect()
    }
}

impl Parameter {
    /// Returns true if a fit with this law searches for it.
    fn is_searched(&self, law: Law) -> bool {
        !matches!(self.knowledge, Knowledge::Known(_)) && self.law() <= law
    }
}

/// What is known of a parameter by the options and by the tree.
fn knowledge(
    described: &Described,
    parameter: &Parameter,
    asked: &[&(String, Option<f64>)],
) -> Result<Knowledge, Failure> {
    let name = &parameter.name;
    // What was given last counts.
    let set = described.set.iter().rfind(|(own, _)| own == name);
    let own = asked.iter().rfind(|(own, _)| own == name);
    let default = described.defaults.iter().find(|(own, _)| own == name);
    let default = default.map(|(_, value)| *value);
    if let Some((_, value)) = set {
        return match own {
            None => Ok(Knowledge::Known(*value)),
            Some(_) => Err(Failure::Lacking {
                what: format!(
                    "`{name}` is known by `--set` and unknown by `--unknown`: give one of them"
                ),
            }),
        };
    }
    let is_held = match asked.is_empty() {
        true => parameter.uses.contains(&ParameterUse::Gravity),
        false => own.is_none(),
    };
    if let (true, Some(value)) = (is_held, default) {
        return Ok(Knowledge::Known(value));
    }
    let guess = own.and_then(|(_, guess)| *guess).or(default);
    match (guess, parameter.size()) {
        (Some(guess), _) if guess != 0.0 && !is_held => Ok(Knowledge::Guess(guess)),
        (_, Some(size)) if !is_held => Ok(Knowledge::Size(size)),
        _ => Err(Failure::Lacking {
            what: format!(
                "of `{name}`{} nothing is known: give its value by `--set {name}=VALUE`, or one from \
                 which it is searched by `--unknown {name}=GUESS`",
                described
                    .description
                    .parameter_use(name)
                    .map_or(String::new(), |own| format!(" ({own})"))
            ),
        }),
    }
}

#[cfg(test)]
mod tests {
    use branched_pendulum::prelude::AbsoluteAngles;
    use branched_pendulum::scalar::Dual;
    use branched_pendulum::system::Ode;

    use super::super::arguments::{Arguments, Law};
    use super::{Knowledge, Unknowns};
    use crate::frame::command_line::parse_line;

    fn unknowns(line: &str) -> Unknowns {
        let arguments: Arguments = parse_line(line).unwrap();
        Unknowns::new(&arguments).unwrap()
    }

    /// The equations of a family are those of its trees, and their derivatives with respect to a
    /// parameter those by differences.
    #[test]
    fn a_family_is_its_trees() {
        for tree in ["paper", "apparatus", "double-pendulum", "chain", "cascade"] {
            let unknowns = unknowns(&format!("--tree {tree}"));
            let family = unknowns.family();
            let values = unknowns.simulated();
            let count = 2 * family.links().len();
            let state: Vec<f64> = (0..count).map(|i| (1.7 * i as f64).sin()).collect();
            let rates = |values: &[f64]| {
                let tree = unknowns.subject(values).unwrap().tree;
                let mut rates = vec![0.0; count];
                AbsoluteAngles(&tree).rates(0.0, &state, &mut rates);
                rates
            };
            let (expected, mut found) = (rates(&values), vec![0.0; count]);
            family.equations(&values).rates(0.0, &state, &mut found);
            let size = expected
                .iter()
                .fold(1.0, |size: f64, rate| size.max(rate.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-12 * size, "{tree}");
            }
            for place in 0..values.len() {
                let step = 1e-5 * values[place].max(1e-4);
                let beside = |side: f64| {
                    let mut values = values.clone();
                    values[place] += side * step;
                    rates(&values)
                };
                let (above, below) = (beside(1.0), beside(-1.0));
                let lifted = values
                    .iter()
                    .enumerate()
                    .map(|(own, value)| match own == place {
                        true => Dual::<f64, 1>::variable(*value, 0),
                        false => Dual::constant(*value),
                    });
                let lifted: Vec<_> = lifted.collect();
                let given: Vec<_> = state.iter().copied().map(Dual::constant).collect();
                let mut found = given.clone();
                family
                    .equations(&lifted)
                    .rates(Dual::constant(0.0), &given, &mut found);
                for (found, (above, below)) in found.iter().zip(above.iter().zip(&below)) {
                    let [slope] = found.tangents;
                    let by_differences = (above - below) / (2.0 * step);
                    let error = (slope - by_differences).abs();
                    let near = 1e-6 * (slope.abs() + size / values[place].max(1e-4));
                    assert!(error < near, "{tree} {place}: {slope} {by_differences}");
                }
            }
        }
    }

    #[test]
    fn parameters_are_known_by_their_uses() {
        let all = unknowns("--tree double-pendulum --set mass_1=0.2");
        let known = |name: &str| all.parameter(name).unwrap().knowledge;
        assert_eq!(known("mass_1"), Knowledge::Known(0.2));
        assert_eq!(known("gravity"), Knowledge::Known(9.80858023));
        assert_eq!(known("com_2"), Knowledge::Guess(0.116779018));
        assert_eq!(known("coulomb_1"), Knowledge::Size(1e-4));
        assert_eq!(known("quadratic_2"), Knowledge::Size(1e-5));
        let law = |name: &str| all.parameter(name).unwrap().law();
        assert_eq!(law("viscous_1"), Law::Viscous);
        assert_eq!(law("coulomb_1"), Law::Coulomb);
        assert_eq!(law("quadratic_1"), Law::All);
        let is_measurable = |name: &str| all.parameter(name).unwrap().is_measurable();
        assert!(is_measurable("joint_1") && is_measurable("mass_2") && is_measurable("com_1"));
        assert!(!is_measurable("inertia_1") && !is_measurable("viscous_1"));
        let every = [Law::Viscous, Law::Coulomb, Law::All];
        assert_eq!(all.laws(&every), every);
        let one = unknowns("--tree double-pendulum --unknown com_1=0.1,coulomb_1");
        assert_eq!(one.laws(&every), [Law::Viscous, Law::Coulomb]);
        let names = one.parameters.iter();
        let found = names.filter(|own| !matches!(own.knowledge, Knowledge::Known(_)));
        let found: Vec<&str> = found.map(|own| own.name.as_str()).collect();
        assert_eq!(found, ["com_1", "coulomb_1"]);
    }
}
