//! Accelerations of many states at once.
//!
//! States lie as a structure of arrays: for each link a slice with its angle in
//! every state. [`Batch`] takes them `N` at a time through the emitted code, in
//! [`Lanes`], with the widest vector instructions that the machine has.
//!
//! ```
//! # use branched_pendulum::{Pendulum, Scalar};
//! use branched_pendulum::batch::Batch;
//! use branched_pendulum::scalar::Lanes;
//! # struct Rod<T>(T);
//! # impl<T: Scalar> Pendulum<T> for Rod<T> {
//! #     const LINKS: usize = 1;
//! #     const LINK_NAMES: &'static [&'static str] = &["rod"];
//! #     #[inline(always)]
//! #     fn accelerations_into(&self, _time: T, theta: &[T], _omega: &[T], alpha: &mut [T]) {
//! #         for (alpha, theta) in alpha.iter_mut().zip(theta) {
//! #             *alpha = -(self.0 * theta.sin_cos().0);
//! #         }
//! #     }
//! # }
//!
//! // A pendulum of one link, in eight lanes; emitted models have `default()`.
//! let model = Rod(Lanes::<f64, 8>::splat(9.80665));
//! let theta = [vec![0.1; 1001]];
//! let omega = [vec![0.0; 1001]];
//! let mut alpha = [vec![0.0; 1001]];
//! Batch::new(&model).accelerations(0.0, &theta, &omega, &mut alpha)?;
//! assert_eq!(alpha[0][1000], -9.80665 * Scalar::sin_cos(0.1_f64).0);
//! # Ok::<(), branched_pendulum::batch::BatchError>(())
//! ```

use alloc::vec::Vec;
use core::fmt;

use crate::scalar::dispatch::{self, Kernel};
use crate::scalar::{InstructionSet, Lane, Lanes};
use crate::system::Pendulum;

/// Evaluates a pendulum for any number of states, `N` at a time.
///
/// Room for one block is allocated when it is built, and nothing later. Each
/// state gets the bits that the same model gives it alone, whatever its place
/// in the batch and whatever the instruction set.
#[derive(Debug)]
pub struct Batch<'m, P, T, const N: usize> {
    model: &'m P,
    instructions: InstructionSet,
    theta: Vec<Lanes<T, N>>,
    omega: Vec<Lanes<T, N>>,
    alpha: Vec<Lanes<T, N>>,
}

impl<'m, P: Pendulum<Lanes<T, N>>, T: Lane, const N: usize> Batch<'m, P, T, N> {
    /// For a `model` whose constants are in lanes. Uses the widest instructions
    /// that the machine has.
    ///
    /// # Examples
    /// See the [module](self).
    #[must_use]
    pub fn new(model: &'m P) -> Self {
        let zeros = || alloc::vec![Lanes::splat(T::from_f64(0.0)); P::LINKS];
        Self {
            model,
            instructions: InstructionSet::widest(),
            theta: zeros(),
            omega: zeros(),
            alpha: zeros(),
        }
    }

    /// Uses instructions that are no wider than `instructions`, for comparison.
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
        check(
            P::LINKS,
            count,
            "theta",
            theta.len(),
            theta.iter().map(|s| s.as_ref().len()),
        )?;
        check(
            P::LINKS,
            count,
            "omega",
            omega.len(),
            omega.iter().map(|s| s.as_ref().len()),
        )?;
        let outputs = alpha.len();
        check(
            P::LINKS,
            count,
            "alpha",
            outputs,
            alpha.iter_mut().map(|s| s.as_mut().len()),
        )?;
        dispatch::run(
            self.instructions,
            Blocks {
                batch: self,
                time: Lanes::splat(time),
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
struct Blocks<'a, 'm, P, T, const N: usize, In, On, Out> {
    batch: &'a mut Batch<'m, P, T, N>,
    time: Lanes<T, N>,
    count: usize,
    theta: &'a [In],
    omega: &'a [On],
    alpha: &'a mut [Out],
}

impl<P, T, const N: usize, In, On, Out> Kernel for Blocks<'_, '_, P, T, N, In, On, Out>
where
    P: Pendulum<Lanes<T, N>>,
    T: Lane,
    In: AsRef<[T]>,
    On: AsRef<[T]>,
    Out: AsMut<[T]>,
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Batch {
            model,
            instructions: _,
            theta,
            omega,
            alpha,
        } = self.batch;
        let mut start = 0;
        while start < self.count {
            load(theta, self.theta, start);
            load(omega, self.omega, start);
            model.accelerations_into(self.time, theta, omega, alpha);
            store(alpha, self.alpha, start);
            start += N;
        }
    }
}

/// Fills lanes from `start` on. Past the end they repeat the last state, which
/// costs nothing beside it, while a number made up might be slow.
#[inline(always)]
fn load<T: Lane, const N: usize>(
    lanes: &mut [Lanes<T, N>],
    slices: &[impl AsRef<[T]>],
    start: usize,
) {
    for (lanes, slice) in lanes.iter_mut().zip(slices) {
        let rest = slice.as_ref().get(start..).unwrap_or_default();
        if let Some(whole) = rest.first_chunk() {
            lanes.0 = *whole;
        } else if let Some((&last, _)) = rest.split_last() {
            lanes.0 = core::array::from_fn(|i| rest.get(i).copied().unwrap_or(last));
        }
    }
}

/// Writes lanes from `start` on, as many as there are states.
#[inline(always)]
fn store<T: Lane, const N: usize>(
    lanes: &[Lanes<T, N>],
    slices: &mut [impl AsMut<[T]>],
    start: usize,
) {
    for (lanes, slice) in lanes.iter().zip(slices) {
        let rest = slice.as_mut().get_mut(start..).unwrap_or_default();
        if let Some(whole) = rest.first_chunk_mut() {
            *whole = lanes.0;
        } else {
            for (out, value) in rest.iter_mut().zip(lanes.0) {
                *out = value;
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
