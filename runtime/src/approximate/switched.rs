//! Motion that switches between the full model and a cheaper approximation while that is accurate
//! enough.

use alloc::vec::Vec;
use core::fmt;

use super::{Approximation, ForcedApproximation};
use crate::integrate::Frames;
use crate::scalar::Real;
use crate::system::{Computes, Ode, UnderTorques, functions};

/// A motion, advanced frame by frame, that uses an approximation while its error is small enough,
/// and the full model otherwise.
///
/// Before each frame it multiplies the approximation's error over one second
/// ([`Approximation::error`]) by the number of seconds over which errors accumulate. If the result
/// is above the tolerance (rad), it switches to the full model; it switches back when the error has
/// been below half of the tolerance for a tenth of a second. Both continue from the same state.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::approximate::{Linear, Switched};
/// use branched_pendulum::integrate::{Frames, longest_sub_step};
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::UnderTorques;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5, friction = 0.05) [
///         twig: rod(mass = 0.1, length = 0.3, friction = 0.005) * 2
///     ],
///     emit(energies, forces),
/// )]
/// struct Branch;
///
/// let branch = Branch::<f64>::new();
/// let start = State::at_rest(0.0, &[1.0, 0.5, 0.8]);
/// let sub_step = longest_sub_step(&branch);
/// let full = Frames::new(UnderTorques::of(&branch, vec![0.0; 3]), &start, sub_step)?;
/// let linear = Linear::about(&branch, &[0.0; 3])?;
/// let seconds = linear.fading_time();
/// let mut motion = Switched::new(full, linear.frames(1.0 / 60.0)?, 1e-2, seconds);
/// for _ in 0..1200 {
///     motion.advance_under(&[0.0; 3]);
/// }
/// // It swings widely first, and comes to rest.
/// assert!(motion.log().full_frames > 60 && motion.log().approximate_frames > 600);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Switched<O, A, T> {
    /// The full model. Its state is the present state, even if the approximation computed it.
    full: Frames<O, T>,
    approximation: A,
    /// Largest error over one second (rad) at which the approximation may be used.
    limit: T,
    /// Buffer for the state that the approximation advances.
    moved: Vec<T>,
    approximate: bool,
    /// Number of successive frames for which the approximation has been accurate enough.
    calm: u64,
    calm_frames: u64,
    log: SwitchLog,
}

/// Numbers of frames and switches of a [`Switched`] motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SwitchLog {
    /// Frames by the full model.
    pub full_frames: u64,
    /// Number of frames computed by the approximation.
    pub approximate_frames: u64,
    /// Number of switches between the two models so far.
    pub switches: u64,
}

impl fmt::Display for SwitchLog {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            full_frames,
            approximate_frames,
            switches,
        } = self;
        write!(
            f,
            "{full_frames} frames by the full model, {approximate_frames} by the approximation, \
             {switches} switches"
        )
    }
}

/// Time (s) for which the approximation must be accurate enough before it is used again.
const CALM: f64 = 0.1;

impl<O: Ode<T>, A: Approximation<T>, T: Real> Switched<O, A, T> {
    /// Returns a motion from the state of `full`, with errors up to `tolerance` (rad). `seconds` is
    /// the time over which errors accumulate: the length of the run, or
    /// [`Linear::fading_time`](super::Linear::fading_time) if friction makes errors decay sooner.
    /// Less than one second counts as one. If the tolerance is NaN or not positive, only the full
    /// model is used.
    pub fn new(full: Frames<O, T>, approximation: A, tolerance: T, seconds: T) -> Self {
        let calm_frames = (CALM / approximation.frame().to_f64()) as u64;
        Self {
            moved: full.state().to_vec(),
            full,
            approximation,
            limit: tolerance / T::ONE.max(seconds),
            approximate: false,
            // Lets the motion start with the approximation if its error is small enough.
            calm: calm_frames,
            calm_frames,
            log: SwitchLog::default(),
        }
    }

    /// Advances the motion by one frame, of the length for which the approximation was made.
    pub fn advance(&mut self) {
        self.frame(|approximation, _, state| approximation.step(state));
    }

    /// Returns the state: angles (rad), then angular velocities (rad/s).
    pub fn state(&self) -> &[T] {
        self.full.state()
    }

    /// Returns the time of the state, s.
    pub fn time(&self) -> f64 {
        self.full.time()
    }

    /// Returns true while the approximation is in use.
    pub fn is_approximate(&self) -> bool {
        self.approximate
    }

    /// Returns the numbers of frames and switches up to now.
    pub fn log(&self) -> SwitchLog {
        self.log
    }

    fn frame(&mut self, step: impl FnOnce(&mut A, &O, &mut [T])) {
        self.choose();
        let frame = self.approximation.frame();
        if self.approximate {
            self.moved.copy_from_slice(self.full.state());
            step(&mut self.approximation, self.full.ode(), &mut self.moved);
            let time = self.full.time() + frame.to_f64();
            if self.full.set_state(time, &self.moved).is_ok() {
                self.log.approximate_frames += 1;
                return;
            }
            // The approximation cannot represent these torques: switches to the full model, which
            // can.
            self.switch(false);
        }
        self.full.advance(frame);
        self.log.full_frames += 1;
    }

    /// Decides which of the two models computes the next frame.
    fn choose(&mut self) {
        let error = self.approximation.error(self.full.state());
        if self.approximate {
            if error.to_f64().is_nan() || error > self.limit {
                self.switch(false);
            }
            return;
        }
        let half = T::from_f64(0.5) * self.limit;
        self.calm = if error < half { self.calm + 1 } else { 0 };
        if self.calm > self.calm_frames {
            self.switch(true);
        }
    }

    fn switch(&mut self, approximate: bool) {
        (self.approximate, self.calm) = (approximate, 0);
        self.log.switches += 1;
    }
}

impl<P, A, T> Switched<UnderTorques<P, Vec<T>>, A, T>
where
    P: Computes<functions::AccelerationsUnderTorques, T>,
    A: ForcedApproximation<T>,
    T: Real,
{
    /// Advances the motion by one frame under torques (N m) on the links that stay constant during
    /// it. Torques of another length than the number of links count as zero.
    pub fn advance_under(&mut self, torques: &[T]) {
        let links = self.full.ode_mut().dimension() / 2;
        let held = self.full.ode_mut().torques_mut();
        held.resize(links, T::ZERO);
        if torques.len() == held.len() {
            held.copy_from_slice(torques);
        } else {
            held.fill(T::ZERO);
        }
        self.frame(|approximation, ode, state| approximation.step_under(state, ode.torques()));
    }
}
