//! The flat program from which code is emitted.
//!
//! A [`Program`] is one list of definitions in which every value uses earlier ones only; the
//! outputs of entry points are values of this list. Equal operations on equal operands are one
//! value. The constants of the model are a second, smaller list of the same kind ([`Setup`]),
//! evaluated once per model.

mod angles;
mod builder;
mod choice;
pub(crate) mod constant_names;
mod constants;
mod count;
mod dead;
mod drive;
mod entries;
mod entry;
mod entry_list;
mod entry_state;
mod factors;
mod friction;
mod fuse;
mod interpret;
mod link;
mod live;
mod lower;
mod named;
mod nested_observables;
mod normal_form;
mod observables;
mod operation;
mod pair;
mod pass;
mod passes;
mod positions;
mod pullback;
mod rebuild;
mod rotations;
mod rounding;
mod scale;
mod sectors;
mod small;
mod solve;
mod symmetric;
mod taylor;
mod terms;
mod text;
mod transfers;
mod transverse;
mod verify;
mod wide;

#[doc(hidden)]
pub use builder::Builder;
pub use choice::cost;
pub use constants::{ConstantDefinition, ConstantId, ConstantOp, Setup};
pub use count::Operations;
pub use entry::Entry;
#[doc(hidden)]
pub use factors::common_factors;
pub use fuse::FusedSum;
pub use interpret::Interpreter;
pub use link::{
    Column, ConstantSlope, LINK_MOTION, LineConstants, LinePotentialConstants, LoopTree,
    PowerConstants, SpringDamperConstants, StripConstants, passive_link_columns,
};
pub use operation::{Definition, Op, ValueId};
pub use pass::Pass;
use passes::PASSES;
pub use passes::worth;
pub use rebuild::Rebuilt;
pub use rounding::Rounding;
pub use taylor::TaylorOutputs;
pub use verify::Fault;

use crate::mechanics::Mechanics;
use crate::scene::{Scene, Solve};

/// Converts all requested quantities to one program. With `off`, leaves out one of the passes, to
/// measure what that pass gains.
///
/// Linear in the size of the mechanics, times a logarithm.
///
/// # Errors
/// [`TooManyValues`] if there would be more than [`MOST_VALUES`].
pub fn lower(
    off: Option<Pass>,
    scene: &Scene,
    mechanics: &Mechanics,
) -> Result<Program, TooManyValues> {
    let orbits = match mechanics.coordinates.as_slice() {
        [] => Vec::new(),
        coordinates => symmetric::orbits(scene, coordinates),
    };
    let mut lowering = lower::Lowering::new(mechanics, &orbits);
    lowering.builder.off = off;
    let (entries, choice, strips) = match scene.in_loops() {
        true => entries::link_entries(scene, &mut lowering),
        false => entries::entries(scene, &mut lowering),
    };
    let mut program = lowering.builder.finish(entries, choice)?;
    program.strips = strips;
    let passes = PASSES.iter().filter(|(pass, _)| off != Some(*pass));
    let mut program = passes.fold(program, |program, (_, pass)| {
        debug_assert_eq!(program.verify(), Ok(()), "before a pass");
        let program = pass(program);
        debug_assert_eq!(program.verify(), Ok(()), "after a pass");
        program
    });
    program.name_constants(mechanics);
    Ok(program)
}

/// Chosen method of solving for the accelerations in absolute angles, and the cost of both methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SolveChoice {
    /// The method that the code uses.
    pub solve: Solve,
    /// Operations of the factorisation; `None` if it is too long to be derived.
    pub factorization: Option<Operations>,
    /// Operations of the articulated recursion.
    pub recursion: Operations,
}

/// The code of a scene as one list of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// Values; each uses earlier ones only.
    pub definitions: Vec<Definition>,
    /// Entry points in the order in which they are emitted.
    pub entries: Vec<Entry>,
    /// Constants of the model.
    pub setup: Setup,
    /// Chosen method of solving for the accelerations, with its cost.
    pub choice: SolveChoice,
    /// Constants of the links, if the code is loops.
    pub strips: Option<LoopTree>,
    /// Pass that was left out, for comparison.
    pub without: Option<Pass>,
}

/// Error: the program would have more than [`MOST_VALUES`] values.
#[derive(Clone, Copy, Debug)]
pub struct TooManyValues;

/// Largest number of values of a program before its passes: twice as many as all exact forms of the
/// budget of 31 links need.
pub const MOST_VALUES: usize = 120_000;

impl Program {
    /// Returns the definition of a value.
    pub fn definition(&self, id: ValueId) -> &Definition {
        &self.definitions[id.0 as usize]
    }

    /// Returns the entry point with the given name.
    pub fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }
}
