//! The Taylor series method for many trajectories in the lanes of vector registers.

// One index into all lanes at once.
#![allow(clippy::needless_range_loop)]

use alloc::vec;
use alloc::vec::Vec;

use super::Taylor;
use super::root::least_inverse_roots;
use crate::integrate::error::InputError;
use crate::integrate::lanes::{Flags, LaneMethod, LaneSteps, Models, Runs};
use crate::integrate::options::Options;
use crate::integrate::registers::{
    Numbers, WIDEST, check_finite, numbers, numbers_in, register, set_lane, smallest_divisor,
};
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::steps::{Failure, StepLimits};
use crate::scalar::two_sum;
use crate::scalar::{Lane, Real};
use crate::simd::Simd;
use crate::simd::{Part, Quad, outlined};
use crate::system::{AbsoluteAngles, Model, Ode, Pendulum, State, TaylorPendulum};

impl<P: TaylorPendulum<T>, T: Lane> LaneMethod<AbsoluteAngles<P>, T> for Taylor<T> {
    type Steps<R: Simd<T>> = TaylorInLanes<P, T, R>;

    fn check(&self, dimension: usize) -> Result<(), InputError<T>> {
        self.options.validate(dimension)?;
        self.check_options()
    }

    fn check_start(&self, values: &[T]) -> Result<(), InputError<T>> {
        self.options
            .check_digits(values, super::smallest_tolerance())
    }

    fn steps<R: Simd<T>>(&self, system: &AbsoluteAngles<P>) -> TaylorInLanes<P, T, R> {
        let (n, order) = (system.dimension(), self.order());
        let zero = R::from_f64(0.0);
        let (relative, absolute) = tolerances(&self.options, n);
        TaylorInLanes {
            models: Models::splat(system),
            limits: StepLimits::new(&self.options),
            compensated: self.options.compensated,
            order,
            safety: super::safety(order),
            relative,
            absolute,
            start: vec![zero; n],
            end: vec![zero; n],
            start_residue: vec![zero; n],
            end_residue: vec![zero; n],
            coefficients: vec![zero; (order + 1) * n],
            work: vec![Quad([zero; 4]); system.0.taylor_workspace(order)],
            step: zero,
            finite: [T::ZERO; WIDEST],
        }
    }
}

/// Arguments of the function that computes Taylor coefficients: time, state, coefficients,
/// workspace.
type Expansion<'a, R> = (R, &'a [R], &'a mut [R], &'a mut [Quad<R>]);

/// Computes the Taylor coefficients in a separate function, which gets its own allocation of vector
/// registers.
impl<'a, P: TaylorPendulum<T>, T: Lane, R: Simd<T>> Part<0, Expansion<'a, R>>
    for Models<AbsoluteAngles<P>, T, R>
{
    type Output = ();

    #[inline(always)]
    fn part(&self, (time, state, coefficients, work): Expansion<'a, R>) {
        let Some((theta, omega)) = state.split_at_checked(self.registers.0.links()) else {
            return;
        };
        P::taylor_coefficients_of(&self.registers.0, time, theta, omega, coefficients, work);
    }
}

/// Data of the Taylor series method during a run in lanes: the polynomials, and the states and
/// steps of all lanes.
pub struct TaylorInLanes<P: Pendulum<T>, T: Lane, R: Simd<T>> {
    models: Models<AbsoluteAngles<P>, T, R>,
    limits: StepLimits<T>,
    compensated: bool,
    order: usize,
    safety: T,
    relative: Vec<R>,
    absolute: Vec<R>,
    start: Vec<R>,
    end: Vec<R>,
    /// Rounding errors of `start`, if the sums are compensated.
    start_residue: Vec<R>,
    /// Rounding error of `end`.
    end_residue: Vec<R>,
    /// Taylor coefficients at the start of the step, order by order.
    coefficients: Vec<R>,
    work: Vec<Quad<R>>,
    /// Lengths of the steps; negative in a run backwards in time.
    step: R,
    /// Zero in lanes whose state at the end of the step is finite, NaN in the others.
    finite: Numbers<T>,
}

impl<P: Pendulum<T>, T: Lane, R: Simd<T>> TaylorInLanes<P, T, R> {
    /// Returns zero in lanes in which all these numbers are finite, NaN in the others.
    #[inline(always)]
    fn check(values: &[R]) -> Numbers<T> {
        numbers(check_finite(R::from_f64(0.0), values))
    }

    /// Returns the number of components of a state, as a compile-time constant if possible.
    #[inline(always)]
    fn dimension(&self) -> usize {
        match P::KNOWN_LINKS {
            Some(links) => 2 * links,
            None => self.start.len(),
        }
    }

    /// Returns the sizes of the last two terms of the polynomial relative to their tolerances, each
    /// the largest of all components.
    #[inline(always)]
    fn last_two(&self) -> [R; 2] {
        let n = self.dimension();
        let last_two = &self.coefficients[(self.order - 1) * n..][..2 * n];
        let (before, last) = last_two.split_at(n);
        let zero = R::from_f64(0.0);
        let (mut of_before, mut of_last) = (zero, zero);
        for i in 0..n {
            let size = self.start[i].larger_size(zero);
            let inverse = R::from_f64(1.0) / self.relative[i].mul_add(size, self.absolute[i]);
            of_before = of_before.larger_size(before[i] * inverse);
            of_last = of_last.larger_size(last[i] * inverse);
        }
        [of_before, of_last]
    }

    /// Returns Σ y\[k\] τᵏ over k ≥ 1 for component i, by Horner's rule in τ², separately for odd
    /// and even k.
    #[inline(always)]
    fn increment(&self, i: usize, tau: R) -> R {
        let n = self.dimension();
        let square = tau * tau;
        let zero = R::from_f64(0.0);
        let (mut odd, mut even) = (zero, zero);
        let rows = &self.coefficients[n..];
        // Pairs of an odd and an even order; the highest odd one may be alone.
        let (pairs, alone) = rows.split_at((self.order - self.order % 2) * n);
        if let Some(highest) = alone.get(i) {
            odd = *highest;
        }
        for pair in pairs.chunks_exact(2 * n).rev() {
            odd = odd.mul_add(square, pair[i]);
            even = even.mul_add(square, pair[n + i]);
        }
        even.mul_add(tau, odd) * tau
    }

    /// Ends the trajectory in a lane whose state at the end of the step is not finite.
    #[cold]
    fn fail(&self, runs: &mut Runs<T>, lane: usize) {
        let start = self.state(lane, runs.time[lane]);
        // What is not finite further down shows in the end of the step.
        let place = if Self::check(&self.coefficients)[lane].is_finite() {
            (runs.end_time[lane], numbers_in(&self.end, lane))
        } else {
            (start.time, start.values.clone())
        };
        runs.non_finite(lane, place, start);
    }

    fn state(&self, lane: usize, time: T) -> State<T> {
        State {
            time,
            values: numbers_in(&self.start, lane),
        }
    }
}

impl<P: TaylorPendulum<T>, T: Lane, R: Simd<T>> LaneSteps<T, R> for TaylorInLanes<P, T, R> {
    type System = AbsoluteAngles<P>;

    fn models(&mut self) -> &mut Models<AbsoluteAngles<P>, T, R> {
        &mut self.models
    }

    fn set(&mut self, lane: usize, values: Option<&[T]>) {
        for i in 0..self.start.len() {
            let value = values.map_or(T::ZERO, |values| values[i]);
            set_lane(&mut self.start[i], lane, value);
            set_lane(&mut self.start_residue[i], lane, T::ZERO);
        }
    }

    fn start(&self) -> &[R] {
        &self.start
    }

    fn end(&self) -> &[R] {
        &self.end
    }

    #[inline(always)]
    fn prepare(&mut self, runs: &mut Runs<T>, _fresh: &Flags) {
        outlined::<0, R, _, _>(
            &self.models,
            (
                register(&runs.time),
                self.start.as_slice(),
                self.coefficients.as_mut_slice(),
                self.work.as_mut_slice(),
            ),
        );
        let n = self.dimension();
        let finite = Self::check(&self.coefficients[(self.order - 1) * n..]);
        let [before, last] = self.last_two().map(numbers);
        let roots = least_inverse_roots::<T, WIDEST>(
            R::LANES,
            (&before, self.order - 1),
            (&last, self.order),
        );
        let [first, longest] = [true, false].map(|first| self.limits.bound(first));
        let mut failed = false;
        for lane in 0..R::LANES {
            let longest = if runs.accepted[lane] == 0 {
                first
            } else {
                longest
            };
            // The larger of two sizes may lose a NaN, on some machines.
            let root = if finite[lane].is_finite() {
                roots[lane]
            } else {
                finite[lane]
            };
            let step = (self.safety * root).min(longest);
            let left = (runs.end[lane] - runs.time[lane]).abs();
            runs.evaluations[lane] += self.order as u64;
            runs.step[lane] = step;
            runs.next_step[lane] = if step.is_finite() { step } else { left };
            failed |= runs.active[lane] & !finite[lane].is_finite();
        }
        if failed {
            for lane in 0..R::LANES {
                if runs.active[lane] && !finite[lane].is_finite() {
                    let state = self.state(lane, runs.time[lane]);
                    runs.non_finite(lane, (state.time, state.values.clone()), state);
                }
            }
        }
    }

    #[inline(always)]
    fn plan(&mut self, runs: &mut Runs<T>) -> Flags {
        runs.plan(R::LANES, &self.limits)
    }

    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>> {
        runs.why_stuck(lane, &self.limits)
    }

    #[inline(always)]
    fn attempt(&mut self, span: StepSpan<R>, _size: R) {
        self.step = span.step;
        for i in 0..self.dimension() {
            let change = self.increment(i, span.step);
            if self.compensated {
                let change = change + self.start_residue[i];
                (self.end[i], self.end_residue[i]) = two_sum(self.start[i], change);
            } else {
                self.end[i] = self.start[i] + change;
            }
        }
        self.finite = Self::check(&self.end);
    }

    #[inline(always)]
    fn judge(&mut self, runs: &mut Runs<T>) -> Flags {
        let mut accepted = [false; WIDEST];
        for lane in 0..R::LANES {
            accepted[lane] = runs.active[lane] & self.finite[lane].is_finite();
        }
        runs.count(R::LANES, &accepted);
        if accepted != runs.active {
            for lane in 0..R::LANES {
                if runs.active[lane] && !accepted[lane] {
                    self.fail(runs, lane);
                }
            }
        }
        accepted
    }

    fn prepare_dense(&mut self, _span: StepSpan<R>) {}

    fn judge_dense(&self, _runs: &mut Runs<T>, _lane: usize) -> Result<(), (T, Vec<T>)> {
        Ok(())
    }

    #[inline(always)]
    fn value(&self, fraction: R, out: &mut [R]) {
        let tau = fraction * self.step;
        for (i, (out, &start)) in out.iter_mut().zip(&self.start).enumerate() {
            *out = start + self.increment(i, tau);
        }
    }

    #[inline(always)]
    fn advance(&mut self, accepted: R::Mask) {
        let n = self.dimension();
        for (start, &end) in self.start.iter_mut().zip(&self.end).take(n) {
            *start = end.choose(*start, accepted);
        }
        if self.compensated {
            for (start, &end) in self.start_residue.iter_mut().zip(&self.end_residue) {
                *start = end.choose(*start, accepted);
            }
        }
    }
}

/// Returns the relative tolerances, and the absolute tolerances (zeros replaced by the smallest
/// number), of each component in every lane. If a component is exactly zero by symmetry, so is its
/// error, and the ratio of error and tolerance must not be 0/0.
fn tolerances<T: Real, R: Simd<T>>(options: &Options<T>, dimension: usize) -> (Vec<R>, Vec<R>) {
    let smallest = smallest_divisor();
    let relative = options.relative.expand(dimension).into_iter();
    let absolute = options.absolute.expand(dimension).into_iter();
    (
        relative.map(R::splat).collect(),
        absolute
            .map(|absolute| R::splat(absolute.max(smallest)))
            .collect(),
    )
}
