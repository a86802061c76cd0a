//! Accelerations, and any other function of a model, of many states at once.
//!
//! States lie as a structure of arrays: for each link a slice with its angle in
//! every state. [`Batch`] takes as many at a time as fit into the widest vector
//! registers that the machine has. The states are read and written where they
//! lie. [`state_function!`](crate::state_function) names other functions than the
//! accelerations.
//!
//! ```
//! # use branched_pendulum::{Model, Pendulum, Scalar};
//! # use branched_pendulum::system::LinkName;
//! use branched_pendulum::batch::Batch;
//! # struct Rod<T>(T);
//! # impl<T: Scalar> Model<T> for Rod<T> {
//! #     type Of<S: Scalar> = Rod<S>;
//! #     const KNOWN_LINKS: Option<usize> = Some(1);
//! #     fn links(&self) -> usize {
//! #         1
//! #     }
//! #     fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
//! #         LinkName::in_list(&["rod"], index)
//! #     }
//! #     fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Rod<S> {
//! #         Rod(convert(self.0))
//! #     }
//! # }
//! # impl<T: Scalar> Pendulum<T> for Rod<T> {
//! #     fn evaluate(
//! #         &self,
//! #         _time: T,
//! #         theta: impl Fn(usize) -> T,
//! #         _omega: impl Fn(usize) -> T,
//! #         mut alpha: impl FnMut(usize, T),
//! #     ) {
//! #         alpha(0, -(self.0 * theta(0).sin_cos().0));
//! #     }
//! # }
//!
//! // A pendulum of one link, or any model that the attribute writes.
//! let model = Rod(9.80665);
//! let theta = [vec![0.1; 1001]];
//! let omega = [vec![0.0; 1001]];
//! let mut alpha = [vec![0.0; 1001]];
//! Batch::new(&model).accelerations(0.0, &theta, &omega, &mut alpha)?;
//! let mut alone = [0.0];
//! model.accelerations_into(0.0, &[0.1], &[0.0], &mut alone);
//! assert_eq!(alpha[0][1000], alone[0]);
//! # Ok::<(), branched_pendulum::batch::BatchError>(())
//! ```

mod blocks;
mod error;
mod function;

use alloc::vec::Vec;

use crate::scalar::{InstructionSet, Lane, at};
use crate::simd::dispatch;
use crate::system::pendulum;
use crate::system::{Pendulum, Workspace};
use blocks::Blocks;

pub use error::BatchError;
pub use function::{StateFunction, StateValues};

/// Evaluates a pendulum for any number of states, a register at a time.
///
/// Room is allocated when it is built, and nothing later: for one state, and where the
/// model is loops over a large tree, for some nine numbers a link of as many states as a
/// register holds. (For fewer states than that, such a model allocates when it computes
/// the first.) Each state gets the bits that
/// [`accelerations_into`](crate::Pendulum::accelerations_into) gives it alone,
/// whatever its place in the batch.
#[derive(Clone, Debug)]
pub struct Batch<'m, P, T> {
    pendulum: &'m P,
    instructions: InstructionSet,
    /// One state: angles, velocities, accelerations.
    alone: [Vec<T>; 3],
    workspace: Workspace<T>,
    /// Memory for a register of states, where the model does not compute in
    /// registers.
    room: Vec<T>,
}

impl<'m, P: Pendulum<T>, T: Lane> Batch<'m, P, T> {
    /// For a `pendulum` in `f64` or `f32`. Uses the widest registers that the
    /// machine has.
    ///
    /// # Examples
    /// See the [module](self).
    #[must_use]
    pub fn new(pendulum: &'m P) -> Self {
        Self {
            pendulum,
            instructions: InstructionSet::widest(),
            alone: core::array::from_fn(|_| alloc::vec![T::from_f64(0.0); pendulum.links()]),
            workspace: Workspace::new(),
            room: alloc::vec![T::from_f64(0.0); room::<T>(pendulum.room())],
        }
    }

    /// Uses instructions that are no wider than `instructions`. With
    /// [`InstructionSet::Build`] nothing is fused, and the results have the same
    /// bits on every machine.
    #[must_use]
    pub fn no_wider_than(mut self, instructions: InstructionSet) -> Self {
        self.instructions = instructions.min(InstructionSet::widest());
        self
    }

    /// The instructions that it uses.
    #[must_use]
    pub fn instructions(&self) -> InstructionSet {
        self.instructions
    }

    /// Writes the angular accelerations (rad/s²) at `time` (s) of the states
    /// with angles `theta` (rad) and angular velocities `omega` (rad/s).
    ///
    /// Each argument holds one slice a link, each slice one number a state. A
    /// state with an angle that is no number gets NaN, and no other one does.
    ///
    /// # Errors
    /// [`BatchError`] unless there are as many slices as links and all have one
    /// length; nothing is written then.
    pub fn accelerations(
        &mut self,
        time: T,
        theta: &[impl AsRef<[T]>],
        omega: &[impl AsRef<[T]>],
        alpha: &mut [impl AsMut<[T]>],
    ) -> Result<(), BatchError> {
        let links = self.pendulum.links();
        let count = theta.first().map_or(0, |angles| angles.as_ref().len());
        let lengths = theta.iter().map(|s| s.as_ref().len());
        check(links, count, "theta", theta.len(), lengths)?;
        let lengths = omega.iter().map(|s| s.as_ref().len());
        check(links, count, "omega", omega.len(), lengths)?;
        let outputs = alpha.len();
        let lengths = alpha.iter_mut().map(|s| s.as_mut().len());
        check(links, count, "alpha", outputs, lengths)?;
        let blocks = Blocks {
            pendulum: self.pendulum,
            time,
            count,
            room: aligned(&mut self.room),
            theta,
            omega,
            alpha,
        };
        let done = dispatch::run_in_registers(self.instructions, blocks);
        for state in done..count {
            self.one_by_one(time, state, theta, omega, alpha);
        }
        Ok(())
    }
}

impl<P: Pendulum<T>, T: Lane> Batch<'_, P, T> {
    /// Evaluates states one by one, where there are too few for a register.
    fn one_by_one(
        &mut self,
        time: T,
        state: usize,
        theta: &[impl AsRef<[T]>],
        omega: &[impl AsRef<[T]>],
        alpha: &mut [impl AsMut<[T]>],
    ) {
        let [own_theta, own_omega, own_alpha] = &mut self.alone;
        for (own, slice) in own_theta.iter_mut().zip(theta) {
            *own = at(slice.as_ref(), state);
        }
        for (own, slice) in own_omega.iter_mut().zip(omega) {
            *own = at(slice.as_ref(), state);
        }
        if self.instructions == InstructionSet::Build {
            pendulum::unfused(self.pendulum, time, own_theta, own_omega, own_alpha);
        } else {
            let pendulum = self.pendulum;
            let workspace = &mut self.workspace;
            pendulum.accelerations_with(workspace, time, own_theta, own_omega, own_alpha);
        }
        for (own, slice) in own_alpha.iter().zip(alpha) {
            pendulum::put(slice.as_mut(), state, *own);
        }
    }
}

/// Bytes in the widest register, and in a line of the cache: what lies across two
/// lines takes two accesses.
const LINE: usize = 64;

/// Numbers of workspace for `values` values in the widest registers, wherever
/// it starts.
fn room<T>(values: usize) -> usize {
    match values {
        0 => 0,
        _ => (values + 1) * (LINE / size_of::<T>().max(1)),
    }
}

/// The workspace from its first line of the cache on.
fn aligned<T>(room: &mut [T]) -> &mut [T] {
    let unaligned = room.as_ptr().align_offset(LINE);
    room.get_mut(unaligned..).unwrap_or_default()
}

fn check(
    links: usize,
    count: usize,
    argument: &'static str,
    slices: usize,
    lengths: impl Iterator<Item = usize>,
) -> Result<(), BatchError> {
    if slices != links {
        return Err(BatchError::Links {
            argument,
            expected: links,
            found: slices,
        });
    }
    for (link, found) in lengths.enumerate() {
        if found != count {
            return Err(BatchError::States {
                argument,
                link,
                expected: count,
                found,
            });
        }
    }
    Ok(())
}
