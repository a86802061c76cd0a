//! The flat program that code is written from.
//!
//! A [`Program`] is one list of definitions in which every value uses only
//! earlier ones; entry points name their outputs in it. Equal operations on
//! equal operands are one value. Constants of the model are a second, smaller
//! list of the same kind ([`Setup`]), evaluated once.

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
mod observables;
mod operation;
mod pair;
mod pass;
mod passes;
mod positions;
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

pub use choice::cost;
pub use constants::{ConstantDefinition, ConstantId, ConstantOp, Setup};
pub use count::Operations;
pub use entry::Entry;
pub use fuse::FusedSum;
pub use interpret::Interpreter;
pub use link::{
    Column, LINK_MOTION, LineConstants, LinePotentialConstants, LoopTree, SpringDamperConstants,
    StripConstants,
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

/// Lowers everything that the scene asks for into one program, without one of the passes
/// where the worth of that one is to be seen.
///
/// Linear in the size of the mechanics, times a logarithm.
///
/// # Errors
/// [`TooManyValues`] where there would be more than [`MOST_VALUES`].
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

/// The solve for the accelerations in absolute angles, and the cost of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SolveChoice {
    /// The solve that is emitted.
    pub solve: Solve,
    /// Operations of the factorisation; `None` where it is too long to be formed.
    pub factorization: Option<Operations>,
    /// Operations of the recursion.
    pub recursion: Operations,
}

/// All of a scene's code in one list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// Values; each uses earlier ones only.
    pub definitions: Vec<Definition>,
    /// Entry points in the order in which they are emitted.
    pub entries: Vec<Entry>,
    /// The model's constants.
    pub setup: Setup,
    /// The solve for the accelerations, and its cost.
    pub choice: SolveChoice,
    /// The constants by strip, where the code is loops.
    pub strips: Option<LoopTree>,
    /// The pass that was left out, for comparison.
    pub without: Option<Pass>,
}

/// Reason for which a program could not be written.
#[derive(Clone, Copy, Debug)]
pub struct TooManyValues;

/// Most values of a program before its passes: twice as many as all exact forms of the
/// budget of 31 links have.
pub const MOST_VALUES: usize = 120_000;

impl Program {
    /// The definition of a value.
    pub fn definition(&self, id: ValueId) -> &Definition {
        &self.definitions[id.0 as usize]
    }

    /// The entry point of that name.
    pub fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }
}
