//! Checks the invariants of a program. Later stages rely on them; a violation is a bug.

use crate::functions::ResultShape;

use super::{ConstantOp, Program};
use crate::exact::Rational;
use std::fmt;

/// A violation of an invariant of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A value uses a value that does not come before it.
    Order {
        /// Index of the invalid definition.
        definition: usize,
    },
    /// The number of an entry point's outputs does not match its result type.
    Outputs {
        /// Name of the entry point.
        entry: String,
    },
    /// An entry point reads an argument that it does not receive.
    Argument {
        /// Name of the entry point.
        entry: String,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Order { definition } => {
                write!(
                    f,
                    "definition {definition} uses a value that is not earlier"
                )
            }
            Self::Outputs { entry } => write!(f, "the outputs of `{entry}` do not fill its shape"),
            Self::Argument { entry } => {
                write!(f, "`{entry}` reads an argument that it does not receive")
            }
        }
    }
}

impl std::error::Error for Fault {}

fn is_unrepresentable(number: &Rational) -> bool {
    let value = number.to_f64();
    !value.is_finite() || (value == 0.0 && !number.is_zero())
}

impl super::Setup {
    /// Returns true if every constant without parameters has a value that an `f64` can hold.
    pub(super) fn is_representable(&self) -> bool {
        self.definitions.iter().all(|definition| {
            let exact = definition.exact.as_ref();
            exact.is_none_or(|exact| !is_unrepresentable(exact))
        })
    }
}

impl Program {
    /// Returns the name of a constant, or a description of a number, that some entry point needs
    /// and that no `f64` can hold: rounded, it would be infinite, or zero although it is not zero.
    pub fn unrepresentable_constant(&self) -> Option<&str> {
        let values = self
            .entries
            .iter()
            .flat_map(|entry| self.needed(&entry.outputs));
        let mut constants = Vec::new();
        for value in values {
            match self.definition(value).op {
                super::Op::Constant(id) => constants.push(id),
                super::Op::Number(ref number) if is_unrepresentable(number) => {
                    return Some("a number of an observable");
                }
                _ => {}
            }
        }
        constants.extend(self.strips.iter().flat_map(super::LoopTree::all_constants));
        // The model also stores the named constants that a product uses. Products are checked
        // before their factors, because their names say more.
        let stored = self.setup.behind(constants, |_| true);
        stored.into_iter().rev().find_map(|id| {
            let definition = self.setup.get(id);
            let factor = match &definition.op {
                ConstantOp::Number(number) | ConstantOp::Product(number, _) => Some(number),
                _ => None,
            };
            let mut numbers = definition.exact.iter().chain(factor);
            numbers.any(is_unrepresentable).then_some(&*definition.name)
        })
    }

    /// Checks that definitions are in order, that entry points receive the arguments that they
    /// read, and that outputs match their result types.
    ///
    /// # Errors
    /// The first [`Fault`] found.
    pub fn verify(&self) -> Result<(), Fault> {
        for (index, definition) in self.definitions.iter().enumerate() {
            if definition.op.operands().any(|id| id.0 as usize >= index) {
                return Err(Fault::Order { definition: index });
            }
        }
        for entry in &self.entries {
            let filled = match entry.shape {
                ResultShape::Scalar => entry.outputs.len() == 1,
                ResultShape::Vector => !entry.outputs.is_empty(),
                ResultShape::Rows(rows, length) => entry.outputs.len() == rows * length,
                ResultShape::Arrays(lengths) => {
                    entry.outputs.len() == lengths.into_iter().flatten().sum::<usize>()
                }
                ResultShape::Split(first) => (1..entry.outputs.len()).contains(&first),
                ResultShape::Transfer => entry.outputs.len() == 2,
                ResultShape::Transfers(count) => entry.outputs.len() == 2 * count,
                ResultShape::Budget(count) => entry.outputs.len() == 3 * count,
            };
            let in_range = entry
                .outputs
                .iter()
                .all(|id| (id.0 as usize) < self.definitions.len());
            if !filled || !in_range {
                return Err(Fault::Outputs {
                    entry: entry.name.clone(),
                });
            }
            let reads_only_its_own =
                self.needed(&entry.outputs)
                    .into_iter()
                    .all(|id| match self.definition(id).op {
                        super::Op::Input(argument, _) => entry.arguments.contains(&argument),
                        _ => true,
                    });
            if !reads_only_its_own {
                return Err(Fault::Argument {
                    entry: entry.name.clone(),
                });
            }
        }
        Ok(())
    }
}
