//! Accelerations, and any other function of a model, of many states at once.
//!
//! States are stored as a structure of arrays: each link has a slice with its angle in every state.
//! [`Batch`] evaluates as many states at a time as fit into the widest vector registers of the
//! machine, and reads and writes them in place. [`state_function!`](crate::state_function) defines
//! functions other than the accelerations.
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
mod evaluate;
mod function;
mod registers;

use alloc::vec::Vec;

use crate::scalar::{InstructionSet, Lane, at};
use crate::simd::dispatch;
use crate::system::pendulum;
use crate::system::{Pendulum, Workspace};
use blocks::Blocks;

pub use error::BatchError;
pub use function::{StateFunction, StateValues};

/// Evaluates a pendulum for any number of states, one register at a time.
///
/// Memory is allocated only when the batch is created: for one state, and, if the model is a large
/// tree computed in loops, about nine numbers per link and lane. (If there are fewer states than
/// lanes, such a model allocates when it computes the first one.) Results have the same bits as
/// those of [`accelerations_into`](crate::Pendulum::accelerations_into), independent of the state's
/// index in the batch.
#[derive(Clone, Debug)]
pub struct Batch<'m, P, T> {
    pendulum: &'m P,
    instructions: InstructionSet,
    /// Angles, velocities and accelerations of a single state, for states that do not fill a
    /// register.
    alone: [Vec<T>; 3],
    workspace: Workspace<T>,
    /// Workspace for a register of states, for models that need one.
    buffer: Vec<T>,
}

impl<'m, P: Pendulum<T>, T: Lane> Batch<'m, P, T> {
    /// Creates a batch for a `pendulum` in `f64` or `f32`. It uses the widest registers of the
    /// machine.
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
            buffer: alloc::vec![T::from_f64(0.0); workspace_len::<T>(pendulum.workspace_len())],
        }
    }

    /// Restricts the batch to instruction sets no wider than `instructions`. With
    /// [`InstructionSet::Build`] it does not use fused multiply–add, and results have the same bits
    /// on every machine.
    #[must_use]
    pub fn no_wider_than(mut self, instructions: InstructionSet) -> Self {
        self.instructions = instructions.min(InstructionSet::widest());
        self
    }

    /// Returns the instruction set that the batch uses.
    #[must_use]
    pub fn instructions(&self) -> InstructionSet {
        self.instructions
    }

    /// Writes the angular accelerations (rad/s²) at `time` (s) of the states with angles `theta`
    /// (rad) and angular velocities `omega` (rad/s).
    ///
    /// Each argument has one slice per link, and each slice one number per state. A state with an
    /// angle that is NaN gets NaN; other states are not affected.
    ///
    /// # Errors
    /// [`BatchError`] unless there are as many slices as links and all have one length; nothing is
    /// written then.
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
            buffer: aligned(&mut self.buffer),
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
    /// Evaluates states one by one, because there are too few for a register.
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

/// Size of the widest register and of a cache line, in bytes. Data that cross two cache lines need
/// two accesses.
const LINE: usize = 64;

/// Returns the length of the workspace, in numbers, for `values` values in the widest registers;
/// the start of the workspace may have any alignment.
fn workspace_len<T>(values: usize) -> usize {
    match values {
        0 => 0,
        _ => (values + 1) * (LINE / size_of::<T>().max(1)),
    }
}

/// Returns the part of the workspace that begins at its first cache-line boundary.
fn aligned<T>(buffer: &mut [T]) -> &mut [T] {
    let unaligned = buffer.as_ptr().align_offset(LINE);
    buffer.get_mut(unaligned..).unwrap_or_default()
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
