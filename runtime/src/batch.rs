//! Accelerations of many states at once.
//!
//! States lie as a structure of arrays: for each link a slice with its angle in
//! every state. [`Batch`] takes as many at a time as fit into the widest vector
//! registers that the machine has. The states are read and written where they
//! lie.
//!
//! ```
//! # use branched_pendulum::{Pendulum, Rescale, Scalar};
//! use branched_pendulum::batch::Batch;
//! # struct Rod<T>(T);
//! # impl<T: Scalar> Pendulum<T> for Rod<T> {
//! #     const LINKS: usize = 1;
//! #     const LINK_NAMES: &'static [&'static str] = &["rod"];
//! #     fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
//! #         T::accelerate(self, time, theta, omega, alpha);
//! #     }
//! # }
//! # impl<T: Scalar> Rescale<T> for Rod<T> {
//! #     type Of<S: Scalar> = Rod<S>;
//! #     fn rescale<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Rod<S> {
//! #         Rod(convert(self.0))
//! #     }
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

use alloc::vec::Vec;
use core::fmt;

use crate::scalar::dispatch::{self, RegisterKernel};
use crate::scalar::register::Register;
use crate::scalar::{InstructionSet, Lane};
use crate::system::Rescale;

/// Room for the widest register.
const MOST_LANES: usize = 16;

/// Evaluates a pendulum for any number of states, a register at a time.
///
/// Room for one block is allocated when it is built, and nothing later. Each
/// state gets the bits that
/// [`accelerations_into`](crate::Pendulum::accelerations_into) gives it alone,
/// whatever its place in the batch.
#[derive(Clone, Debug)]
pub struct Batch<'m, P, T> {
    pendulum: &'m P,
    instructions: InstructionSet,
    /// A last block that is not full: angles, velocities, accelerations.
    rest: [Vec<T>; 3],
}

impl<'m, P: Rescale<T>, T: Lane> Batch<'m, P, T> {
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
            rest: core::array::from_fn(|_| alloc::vec![T::from_f64(0.0); P::LINKS * MOST_LANES]),
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
        let count = theta.first().map_or(0, |angles| angles.as_ref().len());
        let lengths = theta.iter().map(|s| s.as_ref().len());
        check(P::LINKS, count, "theta", theta.len(), lengths)?;
        let lengths = omega.iter().map(|s| s.as_ref().len());
        check(P::LINKS, count, "omega", omega.len(), lengths)?;
        let outputs = alpha.len();
        let lengths = alpha.iter_mut().map(|s| s.as_mut().len());
        check(P::LINKS, count, "alpha", outputs, lengths)?;
        dispatch::run_in_registers(
            self.instructions,
            Blocks {
                pendulum: self.pendulum,
                rest: &mut self.rest,
                time,
                count,
                theta,
                omega,
                alpha,
            },
        );
        Ok(())
    }
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

/// The whole evaluation, lengths checked.
struct Blocks<'a, P, T, In, On, Out> {
    pendulum: &'a P,
    rest: &'a mut [Vec<T>; 3],
    time: T,
    count: usize,
    theta: &'a [In],
    omega: &'a [On],
    alpha: &'a mut [Out],
}

impl<P, T, In, On, Out> RegisterKernel<T> for Blocks<'_, P, T, In, On, Out>
where
    P: Rescale<T>,
    T: Lane,
    In: AsRef<[T]>,
    On: AsRef<[T]>,
    Out: AsMut<[T]>,
{
    type Output = ();

    #[inline(always)]
    fn run<R: Register<Lane = T>>(self) {
        let pendulum = self.pendulum.rescale(R::splat);
        let [rest_theta, rest_omega, rest_alpha] = self.rest;
        let mut start = 0;
        while start < self.count {
            let full = self.count - start >= R::LANES;
            if !full {
                fill::<R>(rest_theta, self.theta, start);
                fill::<R>(rest_omega, self.omega, start);
            }
            // One body serves both kinds of blocks: they differ in where the
            // numbers lie.
            pendulum.evaluate(
                R::splat(self.time),
                |link| load(self.theta, rest_theta, link, start, full),
                |link| load(self.omega, rest_omega, link, start, full),
                |link, value: R| {
                    let block = match self.alpha.get_mut(link) {
                        Some(slice) if full => slice.as_mut().get_mut(start..),
                        _ => rest_alpha.get_mut(link * R::LANES..),
                    };
                    value.store(block.unwrap_or_default());
                },
            );
            if !full {
                for (link, slice) in self.alpha.iter_mut().enumerate() {
                    let from = rest_alpha.get(link * R::LANES..).unwrap_or_default();
                    let to = slice.as_mut().get_mut(start..).unwrap_or_default();
                    for (to, from) in to.iter_mut().zip(from) {
                        *to = *from;
                    }
                }
            }
            start += R::LANES;
        }
    }
}

/// One register of one link.
#[inline(always)]
fn load<R: Register>(
    slices: &[impl AsRef<[R::Lane]>],
    rest: &[R::Lane],
    link: usize,
    start: usize,
    full: bool,
) -> R {
    let block = match slices.get(link) {
        Some(slice) if full => slice.as_ref().get(start..),
        _ => rest.get(link * R::LANES..),
    };
    match R::load(block.unwrap_or_default()) {
        Some(register) => register,
        // Lengths have been checked.
        None => R::from_f64(f64::NAN),
    }
}

/// The last states, a register a link. Past the end they repeat the last state,
/// which costs nothing beside it, while a number made up might be slow.
fn fill<R: Register>(rest: &mut [R::Lane], slices: &[impl AsRef<[R::Lane]>], start: usize) {
    for (block, slice) in rest.chunks_exact_mut(R::LANES).zip(slices) {
        let states = slice.as_ref().get(start..).unwrap_or_default();
        if let Some(&last) = states.last() {
            for (i, number) in block.iter_mut().enumerate() {
                *number = states.get(i).copied().unwrap_or(last);
            }
        }
    }
}

/// Arguments of a batch that do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BatchError {
    /// An argument has another number of slices than the pendulum has links.
    Links {
        /// Its name.
        argument: &'static str,
        /// Number of links.
        expected: usize,
        /// Number of slices.
        found: usize,
    },
    /// A slice has another length than the first one of the angles.
    States {
        /// Name of the argument.
        argument: &'static str,
        /// Index of the link.
        link: usize,
        /// Length of the first slice of angles.
        expected: usize,
        /// Length of this slice.
        found: usize,
    },
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Links {
                argument,
                expected,
                found,
            } => write!(
                f,
                "`{argument}` needs one slice for each of {expected} links, but has {found}"
            ),
            Self::States {
                argument,
                link,
                expected,
                found,
            } => write!(
                f,
                "`{argument}[{link}]` holds {found} states, but `theta[0]` holds {expected}"
            ),
        }
    }
}

impl core::error::Error for BatchError {}
