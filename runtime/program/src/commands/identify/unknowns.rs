//! Known facts about the parameters of a tree, and the tree as a family of models.

use branched_pendulum_trees::{ParameterUse, TreeDescription, TreeError};

use super::arguments::{Arguments, Law};
use crate::Failure;
use crate::subject::{Described, Subject};

/// A tree whose parameters are to be identified.
#[derive(Clone, Debug)]
pub struct Unknowns {
    pub(super) described: Described,
    /// All parameters of the description, in order.
    pub parameters: Vec<Parameter>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name in the description.
    pub name: String,
    /// Knowledge about the parameter.
    pub knowledge: Knowledge,
    uses: Vec<ParameterUse>,
}

/// Knowledge about a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Knowledge {
    /// The value.
    Known(f64),
    /// An approximate value at which the search starts.
    Guess(f64),
    /// Only its typical size is known; the search starts at 0.
    Size(f64),
}

impl Parameter {
    /// Returns the simplest friction law that the parameter belongs to; the simplest law of all if
    /// it is not a friction coefficient.
    pub fn law(&self) -> Law {
        let has = |of| self.uses.contains(&of);
        match self.is_friction() {
            true if has(ParameterUse::QuadraticFriction) => Law::All,
            true if has(ParameterUse::ViscousFriction) => Law::Viscous,
            true => Law::Coulomb,
            false => Law::Viscous,
        }
    }

    /// Returns true if the parameter is used as a friction coefficient only.
    pub fn is_friction(&self) -> bool {
        !self.uses.is_empty() && self.uses.iter().all(ParameterUse::is_friction)
    }

    /// Returns true if the parameter can be measured with scales or a ruler.
    pub fn is_measurable(&self) -> bool {
        let of_scale = |of: &ParameterUse| matches!(of, ParameterUse::Mass | ParameterUse::Place);
        self.uses.iter().any(of_scale)
    }

    /// Returns the typical size of a friction coefficient about which nothing is known: in N m s, N
    /// m or N m s².
    fn size(&self) -> Option<f64> {
        self.is_friction().then(|| match self.law() {
            Law::Viscous | Law::Coulomb => 1e-4,
            Law::All => 1e-5,
        })
    }
}

impl Unknowns {
    /// Reads the tree given in the arguments, and what is known about its parameters.
    ///
    /// # Errors
    /// [`Failure::NoTree`] and [`Failure::Tree`]; [`Failure::Lacking`] if nothing is known about a
    /// parameter, or if there is no unknown parameter.
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
                    "the tree `{}` has no unknown parameter: write names instead of numbers in \
                     its description, as in `mass = m`, and declare them by `--unknown m=0.1`",
                    unknowns.described.name
                ),
            }),
        }
    }

    /// Returns those of the requested laws that have more unknown parameters than the laws before
    /// them.
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

    /// Returns the parameter with this name; `None` for offsets and ratios.
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

    /// Returns the tree for the given values of all parameters.
    ///
    /// # Errors
    /// [`Failure::Tree`] for values that are not physical.
    pub fn subject(&self, values: &[f64]) -> Result<Subject, Failure> {
        let names = self.parameters.iter().map(|own| own.name.as_str());
        let values: Vec<_> = names.zip(values.iter().copied()).collect();
        self.described.subject(&values)
    }

    /// Returns the tree for values that need not be physical.
    ///
    /// # Errors
    /// [`Failure::Tree`] for too few values.
    pub fn subject_as_given(&self, values: &[f64]) -> Result<Subject, Failure> {
        let described = &self.described;
        let tree = described.description.tree_as_given(values);
        Ok(described.with_tree(tree.map_err(|source| described.refused(source))?))
    }

    /// Returns the values at which the search starts.
    pub fn guesses(&self) -> Vec<f64> {
        let values = self.parameters.iter().map(|own| match own.knowledge {
            Knowledge::Known(value) | Knowledge::Guess(value) => value,
            Knowledge::Size(_) => 0.0,
        });
        values.collect()
    }

    /// Returns the known offsets of the links' angles, in rad.
    pub fn offsets(&self) -> &[(String, f64)] {
        &self.described.offsets
    }

    /// Returns the values for a simulated tree: unknown parameters differ from their guesses by
    /// about 20 %.
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
    /// Returns true if a fit with this law searches for the parameter.
    fn is_searched(&self, law: Law) -> bool {
        !matches!(self.knowledge, Knowledge::Known(_)) && self.law() <= law
    }
}

/// Returns what is known about a parameter from the options and from the tree.
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
                    "`{name}` is given both as known (`--set`) and as unknown (`--unknown`): \
                     leave out one of them"
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
                "parameter `{name}`{} has no value: give its value by `--set {name}=VALUE`, or a \
                 starting value for the search by `--unknown {name}=GUESS`",
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

    /// Checks that the equations of a family are those of its trees, and that their derivatives by
    /// a parameter agree with differences.
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
