//! The optimisation passes over programs, one idea per file, and a table of their effects.
//!
//! | pass | where | acts |
//! |---|---|---|
//! | signs, folding, sharing | `builder/rules/` | on an operation when it is built |
//! | angle addition | `angles.rs` | on the sine or cosine of a difference when it is built |
//! | choice of solve | `choice.rs` | on the accelerations, derived by both methods |
//! | common factors | `factors.rs` | on whole programs |
//! | fusing | `fuse.rs` | on an entry point, for emission and interpreter |
//! | dead code | `dead.rs` | on an entry point, which is the program pruned to its outputs |
//! | order | `emit/sink.rs` | on accelerations with more values than registers |
//! | splitting | `emit/parts/` | on functions that are too long for the compiler |
//!
//! Every pass preserves the properties that [`Program::verify`] checks, and the values: exactly, or
//! within the roundings that its file states.

use super::count::{Operations, operations};
use super::{Entry, Pass, Program, ValueId, factors, lower};
use crate::functions::LinkFunction;
use crate::mechanics::Mechanics;
use crate::scene::Scene;
use std::fmt::Write;

/// A function that transforms a whole program.
type ProgramPass = fn(Program) -> Program;

/// Passes over whole programs, in their order.
pub(super) const PASSES: [(Pass, ProgramPass); 1] =
    [(Pass::CommonFactors, factors::common_factors)];

/// Returns a table of the effects of the passes, with a row for all passes and a row without each
/// of them. Its columns are the operations of the accelerations, the number of their fused sums,
/// their largest number of live values, and the operations of all entry points. Without the removal
/// of dead code, every entry point would be the whole program.
pub fn worth(scene: &Scene, mechanics: &Mechanics) -> String {
    let motion = match scene.in_loops() {
        true => "one link with children",
        false => "accelerations",
    };
    let mut table = format!(
        "| without | {motion} | fused | waiting | all functions |\n|---|---|---:|---:|---:|\n"
    );
    let all = Pass::ALL.into_iter().filter(|pass| pass.is_counted());
    for off in std::iter::once(None).chain(all.map(Some)) {
        // Without a pass there may be too many values.
        let Ok(program) = lower(off, scene, mechanics) else {
            continue;
        };
        let Some(motion) = program.motion() else {
            continue;
        };
        let entries = program.entries.iter();
        let total: usize = entries
            .map(|entry| program.operations(&entry.outputs).total())
            .sum();
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "| {} | {} | {} | {} | {total} |",
            off.map_or("–", Pass::name),
            program.operations(&motion.outputs),
            program.fused(&motion).len(),
            program.live(&motion),
        );
        if off.is_none() {
            let whole = whole(&program);
            let total = whole.total() * program.entries.len();
            let _ = writeln!(table, "| dead code | {whole} | | | {total} |");
        }
    }
    table
}

impl Program {
    /// Returns the entry point of the accelerations; for a tree in loops, one with all operations
    /// for a link with children.
    fn motion(&self) -> Option<Entry> {
        if self.strips.is_none() {
            return self.entry("accelerations").cloned();
        }
        let functions = [
            LinkFunction::Attach,
            LinkFunction::Inner,
            LinkFunction::Pivot,
            LinkFunction::Accelerate,
        ];
        let mut all = self.entry(LinkFunction::Inner.name())?.clone();
        let functions = functions.map(|function| self.entry(function.name()));
        all.outputs = functions
            .into_iter()
            .flatten()
            .flat_map(|entry| entry.outputs.iter().copied())
            .collect();
        Some(all)
    }
}

/// Counts the operations of all definitions, including unused ones.
fn whole(program: &Program) -> Operations {
    let all: Vec<ValueId> = (0..program.definitions.len() as u32).map(ValueId).collect();
    operations(&program.definitions, &all)
}
