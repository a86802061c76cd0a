//! Evaluation of any function of a model for many states.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::function::{StateFunction, StateValues};
use super::registers::{Applied, FunctionOfStates, ValuesOf};
use super::{Batch, BatchError};
use crate::scalar::Lane;
use crate::simd::dispatch;
use crate::system::{At, Computes, Pendulum, SliceFunction, functions};

impl<P: Pendulum<T>, T: Lane> Batch<'_, P, T> {
    /// Writes the values of a [`state_function!`](crate::state_function) at `time` (s). Each
    /// argument has one slice per link, `values` one slice per number that the function returns,
    /// and each slice one number per state.
    ///
    /// The bits of a state do not depend on its index in the batch. They are those that the
    /// function returns for that state alone, except where operations are
    /// [fused](crate::scalar#which-bits). Allocates some numbers per link.
    ///
    /// # Errors
    /// [`BatchError`] unless the numbers of slices match the links and values, and all slices have
    /// one length; nothing is written then.
    ///
    /// # Examples
    /// See [`state_function!`](crate::state_function).
    pub fn evaluate<F, const A: usize>(
        &mut self,
        function: F,
        time: T,
        arguments: [&[impl AsRef<[T]>]; A],
        values: &mut [impl AsMut<[T]>],
    ) -> Result<(), BatchError>
    where
        F: StateFunction<P, T, A>,
    {
        let _ = function;
        let first = arguments.first().and_then(|argument| argument.first());
        let count = first.map_or(0, |states| states.as_ref().len());
        for argument in arguments {
            let lengths = argument.iter().map(|s| s.as_ref().len());
            super::check(
                self.pendulum.links(),
                count,
                "arguments",
                argument.len(),
                lengths,
            )?;
        }
        let expected = number_of_values(F::call::<T>);
        if values.len() != expected {
            let found = values.len();
            return Err(BatchError::Values { expected, found });
        }
        let found = values.len();
        let lengths = values.iter_mut().map(|s| s.as_mut().len());
        super::check(found, count, "values", found, lengths)?;
        let states = FunctionOfStates {
            function: ValuesOf::<F, A>(PhantomData),
            pendulum: self.pendulum,
            time,
            count,
            arguments,
            values,
        };
        dispatch::run_in_registers(self.instructions, states);
        Ok(())
    }

    /// Writes the angular accelerations (rad/s²) at `time` (s) of many states under external
    /// torques (N m). The slices are like those of [`accelerations`](Self::accelerations).
    ///
    /// The bits of a state do not depend on its index in the batch. Allocates some numbers per
    /// link.
    ///
    /// # Errors
    /// As for [`accelerations`](Self::accelerations).
    pub fn accelerations_under(
        &mut self,
        time: T,
        [theta, omega, torques]: [&[impl AsRef<[T]>]; 3],
        alpha: &mut [impl AsMut<[T]>],
    ) -> Result<(), BatchError>
    where
        P: Computes<functions::AccelerationsUnderTorques, T>,
    {
        let count = theta.first().map_or(0, |states| states.as_ref().len());
        for (name, argument) in [("theta", theta), ("omega", omega), ("torques", torques)] {
            let lengths = argument.iter().map(|s| s.as_ref().len());
            super::check(self.pendulum.links(), count, name, argument.len(), lengths)?;
        }
        let found = alpha.len();
        let lengths = alpha.iter_mut().map(|s| s.as_mut().len());
        super::check(self.pendulum.links(), count, "alpha", found, lengths)?;
        let function = functions::AccelerationsUnderTorques;
        self.compute(function, At::time(time), [theta, omega, torques], [alpha])
    }

    /// Writes the results of one of the [`functions`] for many states. Each argument and each
    /// result has one slice per element (such as a link), and each slice has one number per state.
    /// If the number of slices is wrong, results are NaN.
    ///
    /// The bits of a state's results do not depend on its index in the batch. Allocates some
    /// numbers per link.
    ///
    /// # Errors
    /// [`BatchError`] unless all slices have one length; nothing is written then.
    ///
    /// # Examples
    /// The torques on a driven arm along a recorded motion:
    ///
    #[cfg_attr(feature = "macros", doc = "```")]
    #[cfg_attr(not(feature = "macros"), doc = "```ignore")]
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::{At, functions};
    ///
    /// #[branched_pendulum(
    ///     gravity = 9.80665,
    ///     arm: rod(mass = 2, length = 0.3),
    ///     emit(inverse_dynamics),
    /// )]
    /// struct Arm;
    ///
    /// let times: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i)).collect();
    /// let theta: Vec<f64> = times.iter().map(|t| t.sin()).collect();
    /// let omega: Vec<f64> = times.iter().map(|t| t.cos()).collect();
    /// let alpha: Vec<f64> = times.iter().map(|t| -t.sin()).collect();
    /// let mut torques = [vec![0.0; 100]];
    /// let arm = Arm::new();
    /// let given: [&[Vec<f64>]; 3] = [&[theta], &[omega], &[alpha]];
    /// Batch::new(&arm).compute(functions::InverseDynamics, At::time(0.0), given, [&mut torques[..]])?;
    /// let inertia = 2.0 * 0.3 * 0.3 / 3.0;
    /// let weight = 2.0 * 9.80665 * 0.15;
    /// let sine = times[50].sin();
    /// let expected = weight * sine.sin() - inertia * sine;
    /// assert!((torques[0][50] - expected).abs() < 1e-14);
    /// # Ok::<(), branched_pendulum::batch::BatchError>(())
    /// ```
    pub fn compute<F, const A: usize, const R: usize>(
        &mut self,
        function: F,
        at: At<T>,
        given: [&[impl AsRef<[T]>]; A],
        results: [&mut [impl AsMut<[T]>]; R],
    ) -> Result<(), BatchError>
    where
        F: SliceFunction,
        P: Computes<F, T>,
    {
        const { assert!(A == F::ARGUMENTS && R == F::RESULTS) }
        let _ = function;
        let first = given.iter().find_map(|argument| argument.first());
        let count = first.map_or(0, |states| states.as_ref().len());
        for argument in given {
            let (found, lengths) = (argument.len(), argument.iter().map(|s| s.as_ref().len()));
            super::check(found, count, "given", found, lengths)?;
        }
        let sizes = results.each_ref().map(|result| result.len());
        let mut values: Vec<&mut [T]> = Vec::with_capacity(sizes.iter().sum());
        for result in results {
            values.extend(result.iter_mut().map(AsMut::as_mut));
        }
        let found = values.len();
        super::check(
            found,
            count,
            "results",
            found,
            values.iter().map(|s| s.len()),
        )?;
        let states = FunctionOfStates {
            function: Applied::<F, A, R> {
                function: PhantomData,
                index: at.index,
                given: given.map(<[_]>::len),
                results: sizes,
            },
            pendulum: self.pendulum,
            time: at.time,
            count,
            arguments: given,
            values: &mut values,
        };
        dispatch::run_in_registers(self.instructions, states);
        Ok(())
    }
}

fn number_of_values<'a, M: 'a, S: 'a, V: StateValues<S>>(
    _: impl Fn(&'a M, S, &'a [S]) -> Option<V>,
) -> usize {
    V::COUNT
}
