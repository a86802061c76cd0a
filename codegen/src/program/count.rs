//! Operation counts of entry points.

use super::{Definition, Op, Program, ValueId};
use std::collections::BTreeSet;
use std::fmt;

/// Number of operations of one evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Pairs of the sine and cosine of one angle.
    pub sin_cos: usize,
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
    /// Changes of sign.
    pub negations: usize,
}

impl Operations {
    /// Returns the number of all operations; a sine and its cosine count as one.
    pub fn total(&self) -> usize {
        let Self {
            sin_cos,
            additions,
            multiplications,
            divisions,
            roots,
            negations,
        } = self;
        sin_cos + additions + multiplications + divisions + roots + negations
    }
}

impl Program {
    /// Counts the operations that `outputs` need.
    pub fn operations(&self, outputs: &[ValueId]) -> Operations {
        operations(&self.definitions, outputs)
    }
}

/// Counts operations as [`Program::operations`] does.
pub(super) fn operations(definitions: &[Definition], outputs: &[ValueId]) -> Operations {
    let mut count = Operations::default();
    let mut angles = BTreeSet::new();
    for id in super::dead::needed(definitions, outputs) {
        match definitions[id.0 as usize].op {
            Op::Input(..) | Op::Constant(_) | Op::Number(_) => {}
            Op::Sin(angle) | Op::Cos(angle) => {
                angles.insert(angle);
            }
            Op::Sqrt(_) => count.roots += 1,
            Op::Neg(_) => count.negations += 1,
            Op::Add(..) | Op::Sub(..) => count.additions += 1,
            Op::Mul(..) => count.multiplications += 1,
            Op::Div(..) => count.divisions += 1,
        }
    }
    count.sin_cos = angles.len();
    count
}

impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.sin_cos, "sin_cos"),
            (self.multiplications, "×"),
            (self.additions, "±"),
            (self.divisions, "÷"),
            (self.roots, "√"),
            (self.negations, "negations"),
        ];
        let mut first = true;
        for (count, what) in parts.into_iter().filter(|(count, _)| *count > 0) {
            if !first {
                f.write_str(", ")?;
            }
            let what = if count == 1 && what == "negations" {
                "negation"
            } else {
                what
            };
            write!(f, "{count} {what}")?;
            first = false;
        }
        if first {
            f.write_str("none")?;
        }
        Ok(())
    }
}
