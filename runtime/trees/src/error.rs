//! Errors of descriptions and of values.

use std::fmt;

use branched_pendulum::emitted::shown;
use branched_pendulum_codegen::report::{Faults, Problem};
use thiserror::Error;

/// A tree that cannot be.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TreeError {
    /// The text is no description of a tree that can be computed.
    #[error(transparent)]
    Description(#[from] DescriptionError),
    /// Parameters without a value.
    #[error("no value for {}", quoted(.names))]
    MissingValues {
        /// Their names.
        names: Vec<String>,
    },
    /// A value for a name that is no parameter.
    #[error("no parameter `{name}`: {}", known(.parameters))]
    UnknownParameter {
        /// The name.
        name: String,
        /// Names of all parameters.
        parameters: Vec<String>,
    },
    /// A value that no pendulum can have.
    #[error("{what} is {}, must be {requirement}", shown(*.value))]
    Value {
        /// The quantity, as in "mass of `child`".
        what: String,
        /// Value of the quantity, in SI units.
        value: f64,
        /// The condition on it, as in "positive".
        requirement: &'static str,
    },
    /// A name that no observable of the description has.
    #[error("no observable `{name}`: {}", known(.observables))]
    UnknownObservable {
        /// The name.
        name: String,
        /// Names of all observables.
        observables: Vec<String>,
    },
    /// A constant between copies that differ, which compiled models alone name.
    #[error(
        "`{observable}` asks for `{constant}`, which trees at run time do not name where copies \
         differ: write its value, or a parameter, in its place"
    )]
    Constant {
        /// Name of the observable.
        observable: String,
        /// Name of the constant.
        constant: String,
    },
    /// Symmetric coordinates, or what is made of them, of a tree with springs that couple sectors.
    #[error(
        "springs `between(...)` links couple the tree's sectors, which have no energies by \
         themselves then: write `siblings(NODE, spring = ...)` for springs between all copies of a \
         node under one link, or watch an energy of your own by `observe(...)`"
    )]
    CoupledSectors,
    /// Energies of sectors, or what is made of them, of a tree with straight springs.
    #[error(
        "of straight springs a sector has those without length at rest and without friction \
         alone, between equal places of all copies of a node under one link, and the tree has the \
         {line}: write `siblings(NODE, at = ..., spring = ...)`, or a torsion spring without `at`, \
         or watch an energy of your own by `observe(...)`"
    )]
    StraightSpring {
        /// What acts along the line with its clause, as in "straight spring `between(a, b)`".
        line: String,
    },
    /// Symmetric coordinates, or what is made of them, of a tree without copies.
    #[error(
        "the tree has no copies, between which there are differences to transfer energy to: \
         write equal subtrees once, as in `child(...) * 2`, or by `generations(...)`; copies \
         that move `in_phase(...)` have no differences"
    )]
    NoCopies,
    /// A motion in phase of links that do not move alike.
    #[error(
        "the links do not move alike when they start alike: name links that are copies of each \
         other, as those of `child(...) * 2`, with nothing between them and other links that one \
         of them lacks"
    )]
    NotInPhase,
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

/// All mistakes in a text. Shown as the compiler shows those of an attribute: message,
/// line and column, the line with the wrong place marked, and what to write instead.
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

    /// Returns what is said of a text of more than `most` bytes.
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

    /// Returns the mistakes in the order of the text, one or more.
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
