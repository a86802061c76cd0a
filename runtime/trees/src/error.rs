//! Errors of descriptions, and of values for their parameters.

use std::fmt;

use branched_pendulum::analysis::EquilibriumError;
use branched_pendulum::analysis::normal_form::NormalFormError;
use branched_pendulum::emitted::shown;
use branched_pendulum_codegen::report::{Faults, Problem};
use thiserror::Error;

/// A tree that cannot be.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TreeError {
    /// The text does not describe a tree that can be computed.
    #[error(transparent)]
    Description(#[from] DescriptionError),
    /// Parameters without a value.
    #[error("no value for {}", quoted(.names))]
    MissingValues {
        /// Their names.
        names: Vec<String>,
    },
    /// A value was given for an unknown parameter.
    #[error("no parameter `{name}`: {}", known(.parameters))]
    UnknownParameter {
        /// The name.
        name: String,
        /// Names of all parameters.
        parameters: Vec<String>,
    },
    /// A value is not physical.
    #[error("{what} is {}, must be {requirement}", shown(*.value))]
    Value {
        /// Name of the quantity, such as "mass of `child`".
        what: String,
        /// Value of the quantity, in SI units.
        value: f64,
        /// Condition that the value violates, such as "positive".
        requirement: &'static str,
    },
    /// The description has no observable of this name.
    #[error("no observable `{name}`: {}", known(.observables))]
    UnknownObservable {
        /// The name.
        name: String,
        /// Names of all observables.
        observables: Vec<String>,
    },
    /// An observable uses a constant of copies that differ, which only compiled models support.
    #[error(
        "`{observable}` uses `{constant}`, a name that trees at run time do not have if copies \
         differ: write its value, or a parameter, instead"
    )]
    Constant {
        /// Name of the observable.
        observable: String,
        /// Name of the constant.
        constant: String,
    },
    /// Symmetric coordinates, or results that need them, were requested of a tree with springs that
    /// couple sectors.
    #[error(
        "springs `between(...)` links couple the tree's sectors, so that a sector has no energy by \
         itself: write `siblings(NODE, spring = ...)` for springs between all copies of a node \
         under one link, or define an energy of your own by `observe(...)`"
    )]
    CoupledSectors,
    /// Energies of sectors, or results that need them, were requested of a tree with straight
    /// springs.
    #[error(
        "sectors have an energy only if every straight spring has zero rest length and no \
         friction, and connects equal points of all copies of a node under one link; this tree has \
         the {line}: write `siblings(NODE, at = ..., spring = ...)`, or a torsion spring without `at`, \
         or define an energy of your own by `observe(...)`"
    )]
    StraightSpring {
        /// Straight spring or damper, with its clause, such as "straight spring `between(a, b)`".
        line: String,
    },
    /// Symmetric coordinates, or results that need them, were requested of a tree without copies.
    #[error(
        "the tree has no copies, so that there are no differences which could receive energy: \
         write equal subtrees once, as in `child(...) * 2`, or by `generations(...)`; copies \
         that move `in_phase(...)` have no differences"
    )]
    NoCopies,
    /// An in-phase motion was requested for links that are not identical or do not stay in phase.
    #[error(
        "the links do not stay in phase when they start in phase: name links that are copies of each \
         other, as in `child(...) * 2`, and whose springs and friction to other links are the same"
    )]
    NotInPhase,
    /// The normal form of a motion cannot be derived.
    #[error(transparent)]
    NormalForm(#[from] NormalFormError),
    /// No equilibrium of the tree was found.
    #[error(transparent)]
    Equilibrium(#[from] EquilibriumError),
}

fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

fn known(parameters: &[String]) -> String {
    match parameters {
        [] => "the description has none".to_owned(),
        names => format!("there are {}", quoted(names)),
    }
}

/// All mistakes in the text of a description. Displayed like compiler errors in the attribute:
/// message, line and column, the line with the mistake marked, and what to write instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DescriptionError {
    mistakes: Vec<Mistake>,
    text: String,
}

/// A mistake in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Statement of the mistake.
    pub message: String,
    /// Remark on the marked place.
    pub label: String,
    /// Correction to write instead.
    pub help: String,
}

impl DescriptionError {
    pub(crate) fn of(report: &Faults, source: &str) -> Self {
        let mistakes = report.diagnostics().iter().map(|diagnostic| {
            let start = diagnostic.span.start();
            let Problem { text, label, hint } = diagnostic.message.problem();
            Mistake {
                line: start.line,
                column: start.column + 1,
                message: text,
                label,
                help: hint,
            }
        });
        let mut mistakes: Vec<Mistake> = mistakes.collect();
        mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
        Self {
            mistakes,
            text: report.render(source),
        }
    }

    /// Returns the error for a text of more than `most` bytes.
    pub(crate) fn too_long(most: usize) -> Self {
        let mistake = Mistake {
            line: 1,
            column: 1,
            message: format!("a description of more than {most} bytes"),
            label: "too long".to_owned(),
            help: "write equal subtrees once, with `* 2` or `generations(...)`".to_owned(),
        };
        let text = format!("error: {}\nhelp: {}\n", mistake.message, mistake.help);
        Self {
            mistakes: vec![mistake],
            text,
        }
    }

    /// Returns the error for a text that looks like the name of a file.
    pub(crate) fn file_name(name: &str) -> Self {
        let mistake = Mistake {
            line: 1,
            column: 1,
            message: format!("`{name}` looks like the name of a file, not like a description"),
            label: "the name of a file".to_owned(),
            help: format!(
                "pass the text in the file, in Python `open({name:?}).read()`, in Rust \
                 `std::fs::read_to_string({name:?})?`"
            ),
        };
        let text = format!("error: {}\nhelp: {}\n", mistake.message, mistake.help);
        Self {
            mistakes: vec![mistake],
            text,
        }
    }

    /// Returns the mistakes (at least one), in the order of the text.
    pub fn mistakes(&self) -> &[Mistake] {
        &self.mistakes
    }
}

impl fmt::Display for DescriptionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text.trim_end())
    }
}

impl std::error::Error for DescriptionError {}
