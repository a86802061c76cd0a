//! What is done to a program while it is formed, and what each step is worth.
//!
//! The steps act value by value in `builder.rs`, on the last operation; `choice.rs`
//! compares whole solves. Values that nothing uses are left out of every entry
//! point by `Program::needed`.

use super::{Program, lower_without};
use crate::mechanics::Mechanics;
use crate::scene::Scene;
use std::fmt::Write;

/// A step that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// Equal operations on equal operands are one value.
    Sharing,
    /// Operations on constants become constants of the model, exactly.
    Folding,
    /// Signs move outwards and into sums and differences.
    Signs,
    /// Sines and cosines of differences are formed from those of single angles.
    AngleAddition,
    /// A common factor of several terms is multiplied once.
    CommonFactors,
    /// Of two solves the cheaper one.
    Choice,
}

impl Pass {
    const ALL: [Self; 6] = [
        Self::Sharing,
        Self::Folding,
        Self::Signs,
        Self::AngleAddition,
        Self::CommonFactors,
        Self::Choice,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Sharing => "sharing",
            Self::Folding => "exact folding",
            Self::Signs => "signs",
            Self::AngleAddition => "angle addition",
            Self::CommonFactors => "common factors",
            Self::Choice => "choice of solve",
        }
    }
}

/// A table of the operations of the accelerations and of all entry points, and
/// of the values that wait at most, with all passes and without each.
pub fn worth(scene: &Scene, mechanics: &Mechanics) -> String {
    let mut table = String::from(
        "| without | accelerations | waiting | all functions |\n|---|---|---:|---:|\n",
    );
    let all = std::iter::once(None).chain(Pass::ALL.map(Some));
    for off in all {
        let program = lower_without(off, scene, mechanics);
        let total: usize = program
            .entries
            .iter()
            .map(|entry| size(&program, entry))
            .sum();
        let Some(motion) = program.entry("accelerations") else {
            continue;
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "| {} | {} | {} | {total} |",
            off.map_or("–", Pass::name),
            program.operations(&motion.outputs),
            program.live(motion),
        );
    }
    table
}

/// Operations of an entry point, a sine and cosine counting as one.
fn size(program: &Program, entry: &super::Entry) -> usize {
    let count = program.operations(&entry.outputs);
    count.sin_cos
        + count.additions
        + count.multiplications
        + count.divisions
        + count.roots
        + count.negations
}
