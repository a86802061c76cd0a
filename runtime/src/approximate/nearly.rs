//! Copies nearly in phase, frame by frame.

use alloc::vec;
use alloc::vec::Vec;

use super::Approximation;
use crate::integrate::{Frames, InputError};
use crate::scalar::{Real, Scalar};
use crate::system::{DifferencePatterns, SmallDifferences, SmallOde, State};

/// A tree whose copies are nearly in phase, by the model of small differences that act
/// back ([`SmallDifferences`]), in frames.
///
/// Steps are those of [`Frames`] on angles and differences. What a state has of other
/// differences than the [`DifferencePatterns`] is dropped by a step, and counts as an
/// error. For models without a drive, whose time is not told.
///
/// # Estimate of the error
///
/// A difference of amplitude b, b² = δ² + (δ̇/Ω)² with Ω² = ∂²E/∂δ² / ∂²E/∂δ̇², swings
/// more slowly by b²/16 than the model has it: over a second that is an error of
/// (Ω/16) b³. With B² = Σ b², the highest Ω, and the rates ω of the angles in phase, which
/// add to stiffness, the estimate is (Ω² + ω²)^½ B³/8; patterns with uneven
/// weights drive other differences, by B² and the angles in phase. It is between 0.3 and
/// 30 times the error for releases of the paper's pendulum up to 60°, with differences up to
/// 0.5 rad.
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
/// assert!(error < estimate && estimate < 3e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct NearlyInPhase<P, T> {
    frames: Frames<SmallOde<P>, T>,
    patterns: DifferencePatterns,
    frame: T,
    /// Ω² of each difference.
    squares: Vec<T>,
    /// Largest [`DifferencePatterns::unevenness`] of a sector.
    unevenness: T,
    /// State of the model.
    small: Vec<T>,
}

impl<P: SmallDifferences<T>, T: Real> NearlyInPhase<P, T> {
    /// A model in frames of `frame` (s), cut into sub-steps no longer than `sub_step` (s);
    /// [`longest_sub_step`](crate::integrate::longest_sub_step) of the whole tree is one.
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
        if !(frame.is_finite() && frame > T::ZERO) {
            return Err(InputError::Step {
                name: "frame",
                value: frame,
            });
        }
        let sectors = 0..P::SMALL.len();
        let uneven = sectors.map(|sector| patterns.unevenness(sector));
        let unevenness = T::from_f64(uneven.fold(0.0, f64::max));
        let squares = squares(&model);
        let small = vec![T::ZERO; 2 * patterns.half()];
        let rest = State::new(T::ZERO, small.clone());
        Ok(Self {
            frames: Frames::new(SmallOde(model), &rest, sub_step)?,
            patterns,
            frame,
            squares,
            unevenness,
            small,
        })
    }

    /// Returns the error of an angle over a second, and the amplitude of all angles.
    fn estimate(&self, state: &[T]) -> [T; 2] {
        let small = self.patterns.to_small(state);
        let (Some(&slowest), false) = (
            self.squares
                .iter()
                .min_by(|a, b| a.to_f64().total_cmp(&b.to_f64())),
            small.is_empty(),
        ) else {
            return [T::NAN; 2];
        };
        let (angles, rates) = small.split_at(self.patterns.half());
        let (theta, difference) = angles.split_at(self.patterns.links());
        let (omega, difference_rate) = rates.split_at(self.patterns.links());
        let square = |value: T| value * value;
        let sum = |values: &[T]| {
            values
                .iter()
                .fold(T::ZERO, |sum, &value| sum + value * value)
        };
        let differences = difference.iter().zip(difference_rate).zip(&self.squares);
        let amplitudes =
            differences.map(|((&angle, &rate), &of)| square(angle) + square(rate) / of);
        let small_square = amplitudes.fold(T::ZERO, |sum, part| sum + part);
        let swing_square = sum(theta) + sum(omega) / slowest;
        let fastest = self
            .squares
            .iter()
            .fold(slowest, |most, &of| Real::max(most, of));
        let pace = omega
            .iter()
            .fold(T::ZERO, |most, &rate| Real::max(most, square(rate)));
        let rate = Scalar::sqrt(fastest + pace);
        let amplitude = Scalar::sqrt(small_square);
        let even = T::from_f64(0.125) * rate * amplitude * small_square;
        let swing = Real::min(Scalar::sqrt(swing_square), T::ONE);
        let uneven = self.unevenness * small_square * swing;
        let dropped = self.dropped(state, &small, slowest);
        [
            even + uneven + dropped,
            Scalar::sqrt(small_square + swing_square),
        ]
    }

    /// Amplitude of what the patterns leave out, the largest of an angle.
    fn dropped(&self, state: &[T], small: &[T], slowest: T) -> T {
        let (angles, rates) = small.split_at(self.patterns.half());
        let (whole_angles, whole_rates) = state.split_at(state.len() / 2);
        let links = whole_angles.iter().zip(whole_rates).enumerate();
        let largest = links.fold(T::ZERO, |largest, (link, (&angle, &rate))| {
            let angle = angle
                - T::from_f64(self.patterns.angle(link))
                - self.patterns.of_link(link, angles);
            let rate = rate - self.patterns.of_link(link, rates);
            Real::max(largest, angle * angle + rate * rate / slowest)
        });
        // Below the rounding of means there is nothing.
        let left = Scalar::sqrt(largest);
        let rounding = T::from_f64(8.0) * T::EPSILON;
        if left <= rounding { T::ZERO } else { left }
    }
}

/// Ω² of each difference where all hang, as energies have it.
fn squares<T: Real, P: SmallDifferences<T>>(model: &P) -> Vec<T> {
    let hanging = vec![T::ZERO; P::LINKS];
    let sectors = P::SMALL.iter().flat_map(|&sector| {
        let links = P::TRANSVERSE[sector].links;
        let energy = move |angle: Option<usize>, rate: Option<usize>| -> (Vec<T>, Vec<T>) {
            let unit = |place: Option<usize>| {
                let at = |link| if Some(link) == place { T::ONE } else { T::ZERO };
                (0..links).map(at).collect()
            };
            (unit(angle), unit(rate))
        };
        (0..links).map(move |link| (sector, energy(Some(link), None), energy(None, Some(link))))
    });
    let square = |(sector, held, moving): (usize, (Vec<T>, Vec<T>), (Vec<T>, Vec<T>))| {
        let energy = |(difference, rate): &(Vec<T>, Vec<T>)| {
            model.transverse_energy_of(sector, &hanging, difference, rate)
        };
        // Without stiffness, or with less than none, rates count as angles in a second.
        Real::max(energy(&held) / energy(&moving), T::ONE)
    };
    sectors.map(square).collect()
}

impl<P: SmallDifferences<T>, T: Real> Approximation<T> for NearlyInPhase<P, T> {
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

    /// Torques from outside, which differ between copies in general, are not known to the
    /// model: where one is not zero, the state is NaN.
    fn step_under(&mut self, state: &mut [T], torques: &[T]) {
        let none = torques.iter().all(|&torque| torque == T::ZERO);
        if torques.len() == self.patterns.whole_links() && none {
            self.step(state);
        } else {
            state.fill(T::NAN);
        }
    }

    fn validity(&self, state: &[T]) -> T {
        let [error, amplitude] = self.estimate(state);
        if error == T::ZERO {
            error
        } else {
            error / amplitude
        }
    }

    fn error(&self, state: &[T]) -> T {
        let [error, _] = self.estimate(state);
        error
    }
}
