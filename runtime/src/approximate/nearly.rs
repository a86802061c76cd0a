//! Motions of copies that are nearly in phase, computed frame by frame.

use alloc::vec;
use alloc::vec::Vec;

use super::small_error::SmallError;
use super::{Approximation, ForcedApproximation};
use crate::integrate::{Frames, InputError};
use crate::scalar::Real;
use crate::system::{
    Computes, DifferencePatterns, Ode, SmallDifferences, SmallOde, SmallUnderTorques, State,
    functions,
};

/// The motion of a tree whose copies are nearly in phase, computed frame by frame with a model of
/// small differences ([`SmallDifferences`]).
///
/// Sub-steps are those of [`Frames`] on angles and differences. Only differences in the
/// [`DifferencePatterns`] are followed: a step drops all others from the state, and they count as
/// an error. The model must not have a drive, because approximations do not depend on time. With
/// [`under_torques`](NearlyInPhase::under_torques) it accepts external torques.
///
/// # Estimate of the error
///
/// A difference has the amplitude b with b² = δ² + (δ̇/Ω)², where Ω² = (∂²E/∂δ²)/(∂²E/∂δ̇²). It
/// really oscillates slower than in the model, by the relative amount b²/16: over one second this
/// is an error of (Ω/16) b³. With B² = Σ b², the highest Ω, and the rates ω of the angles in phase,
/// which add to the stiffness, the estimate is (Ω² + ω²)^½ B³/4. Let x be the energy of the motion
/// in phase over the energy that lifts the copies' links to the horizontal: for x > 1, differences
/// may grow by the factor e^(6x − 6) in a second, and the estimate is multiplied by it. Patterns
/// with uneven weights drive other differences, in proportion to B² and the angles in phase;
/// differences s, and differences t of copies within these copies, drive others in proportion to 2
/// B_s B_t. Errors of the sub-steps are added.
///
/// A test compares the estimate with the error for 400 random states of the paper's pendulum, whose
/// motion in phase has up to the energy of a release from 30° (x = 1), with differences up to 0.01,
/// 0.05, 0.2 and 0.5 rad: the estimate is between 0.8 and 30 times the error. For 400 states of a
/// binary tree of seven links it is between 0.3 and 30 times the error. Beyond x = 1.5, where
/// motions that turn copies over can multiply differences by a thousand in a second, the error is
/// unknown. There the estimate is infinite, so that [`Switched`](super::Switched) uses the full
/// model, or zero if there are no differences.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::approximate::{Approximation, NearlyInPhase};
/// use branched_pendulum::integrate::{Frames, longest_sub_step};
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::DifferencePatterns;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3) * 2],
///     in_phase(twig),
///     emit(small),
/// )]
/// struct Branch;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3) * 2],
/// )]
/// struct Whole;
///
/// let (branch, whole) = (Branch::<f64>::new(), Whole::<f64>::new());
/// let sub_step = longest_sub_step(&whole);
/// let patterns = DifferencePatterns::of(&branch, Branch::WHOLE)?;
/// let mut nearly = NearlyInPhase::new(branch, patterns, sub_step, 1.0 / 60.0)?;
///
/// // A second of motion with twigs 0.1 rad to each side of their mean.
/// let mut state = [0.3, 0.6, 0.4, 0.0, 0.0, 0.0];
/// let estimate = nearly.error(&state);
/// let mut full = Frames::new(AbsoluteAngles(whole), &State::at_rest(0.0, &state[..3]), sub_step)?;
/// for _ in 0..60 {
///     nearly.step(&mut state);
///     full.advance(1.0 / 60.0);
/// }
/// let error = (state[1] - full.state()[1]).abs();
/// assert!(error < estimate && estimate < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct NearlyInPhase<P, T, O = SmallOde<P>> {
    /// The model that `frames` integrates, from which the error is estimated.
    model: P,
    frames: Frames<O, T>,
    patterns: DifferencePatterns,
    frame: T,
    error: SmallError<T>,
    /// State of the model of small differences: angles, differences, then their rates.
    small: Vec<T>,
}

impl<P: SmallDifferences<T> + Clone, T: Real> NearlyInPhase<P, T> {
    /// Creates the motion of a model (or of a reference to one) with frames of length `frame` (s).
    /// These are divided into sub-steps of at most `sub_step` (s), such as
    /// [`longest_sub_step`](crate::integrate::longest_sub_step) of the whole tree.
    ///
    /// # Errors
    ///
    /// [`InputError`] if a length of time is not positive and finite.
    pub fn new(
        model: P,
        patterns: DifferencePatterns,
        sub_step: T,
        frame: T,
    ) -> Result<Self, InputError<T>> {
        let equations = SmallOde(model.clone());
        Self::of(equations, model, patterns, [sub_step, frame])
    }
}

impl<P, T> NearlyInPhase<P, T, SmallUnderTorques<P, Vec<T>>>
where
    P: SmallDifferences<T> + Computes<functions::SmallDifferencesUnderTorques, T> + Clone,
    T: Real,
{
    /// Creates the motion like [`new`](NearlyInPhase::new) for a model that accepts external
    /// torques; the result is a [`ForcedApproximation`].
    ///
    /// Torques that differ between copies in other patterns than the [`DifferencePatterns`] cannot
    /// be represented.
    ///
    /// # Errors
    ///
    /// [`InputError`] if a length of time is not positive and finite.
    pub fn under_torques(
        model: P,
        patterns: DifferencePatterns,
        sub_step: T,
        frame: T,
    ) -> Result<Self, InputError<T>> {
        let none = vec![T::ZERO; patterns.half()];
        let equations = SmallUnderTorques::of(model.clone(), none);
        Self::of(equations, model, patterns, [sub_step, frame])
    }
}

impl<P: SmallDifferences<T>, T: Real, O: Ode<T>> NearlyInPhase<P, T, O> {
    fn of(
        equations: O,
        model: P,
        patterns: DifferencePatterns,
        [sub_step, frame]: [T; 2],
    ) -> Result<Self, InputError<T>> {
        if !(frame.is_finite() && frame > T::ZERO) {
            return Err(InputError::Step {
                name: "frame",
                value: frame,
            });
        }
        let small = vec![T::ZERO; 2 * patterns.half()];
        let rest = State::new(T::ZERO, small.clone());
        Ok(Self {
            error: SmallError::new(&model, &patterns),
            frames: Frames::new(equations, &rest, sub_step)?,
            model,
            patterns,
            frame,
            small,
        })
    }
}

impl<P: SmallDifferences<T>, T: Real, O: Ode<T>> Approximation<T> for NearlyInPhase<P, T, O> {
    fn frame(&self) -> T {
        self.frame
    }

    fn step(&mut self, state: &mut [T]) {
        let entered = self.patterns.small_into(state, &mut self.small);
        let time = self.frames.time();
        if !entered || self.frames.set_state(time, &self.small).is_err() {
            state.fill(T::NAN);
            return;
        }
        self.frames.advance(self.frame);
        self.patterns.whole_into(self.frames.state(), state);
    }

    fn validity(&self, state: &[T]) -> T {
        let [error, amplitude] = self.error.estimate(&self.model, &self.patterns, state);
        if error == T::ZERO {
            error
        } else {
            error / amplitude
        }
    }

    fn error(&self, state: &[T]) -> T {
        let [error, _] = self.error.estimate(&self.model, &self.patterns, state);
        error
    }
}

impl<P, T> ForcedApproximation<T> for NearlyInPhase<P, T, SmallUnderTorques<P, Vec<T>>>
where
    P: SmallDifferences<T> + Computes<functions::SmallDifferencesUnderTorques, T>,
    T: Real,
{
    fn step_under(&mut self, state: &mut [T], torques: &[T]) {
        let parts = &mut self.small[..self.patterns.half()];
        if !self.patterns.take_torques(torques, parts) {
            state.fill(T::NAN);
            return;
        }
        let held = self.frames.ode_mut().torques_mut();
        self.patterns.torques_into(torques, held);
        self.step(state);
        // Clears the torques, which act during this frame only.
        self.frames.ode_mut().torques_mut().fill(T::ZERO);
    }
}
