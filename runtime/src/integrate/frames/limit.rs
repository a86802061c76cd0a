//! Estimate of the largest rate at which the motion of a model can change.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::{FRAC_PI_2, TAU};

use crate::scalar::{Dual, Real, Scalar};
use crate::system::{Pendulum, Workspace};

/// Longest sub-step of any model, in s.
const LONGEST: f64 = 0.01;

/// Number of states at rest at which rates are examined.
const CONFIGURATIONS: usize = 10;

/// Numbers of steps of the power iteration: all, and the last ones that are averaged.
const ITERATIONS: usize = 24;
const COUNTED: usize = 8;

/// Returns the longest sub-step (s) for [`Frames`](super::Frames) of a model: 1/ρ,
/// and at most a hundredth of a second.
///
/// ρ = γ/2 + √(γ²/4 + ω²) bounds the rates at which small motions about a state at rest
/// change, with the largest eigenfrequency ω (rad/s) of stiffness and masses there, and
/// the largest rate γ (1/s) of friction and drag. Both are the largest of ten states: all links
/// hanging, all folded by right angles, and eight random ones. The classical Runge–Kutta method is
/// stable up to 2.61/ρ.
///
/// Takes 500 evaluations of the model in dual numbers. Returns NaN if the accelerations of the
/// model are not finite.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::integrate::longest_sub_step;
/// use branched_pendulum::prelude::*;
///
/// /// A stiff reed: √(κ/I) = √(300 / (0.1·0.1²/3)) ≈ 949 rad/s.
/// #[branched_pendulum(gravity = 0, reed: rod(mass = 0.1, length = 0.1, spring = 300))]
/// struct Reed;
///
/// let sub_step = longest_sub_step(&Reed::new());
/// assert!((1.0 / sub_step - 949.0).abs() < 1.0);
/// ```
pub fn longest_sub_step<T: Real, P: Pendulum<T>>(model: &P) -> T {
    let dual = model.cast(Dual::<T, 1>::constant);
    let mut largest = T::ZERO;
    let mut slopes = SlopeMemory::new(model.links());
    for configuration in 0..CONFIGURATIONS {
        let angle = |link: usize| match configuration {
            0 => 0.0,
            1 => FRAC_PI_2 * (link % 4) as f64,
            // Multiples of the golden ratio are spread evenly.
            _ => TAU * ((0.618_033_988_749_895 * (1 + link * 8 + configuration) as f64) % 1.0),
        };
        let (stiffness, friction) = (
            slopes.largest(&dual, angle, Of::Angles),
            slopes.largest(&dual, angle, Of::Rates),
        );
        let half = T::from_f64(0.5) * friction;
        let rate = half + Scalar::sqrt(half * half + stiffness);
        // Not `Real::max`, which ignores NaN.
        largest = if rate <= largest { largest } else { rate };
    }
    let longest = T::from_f64(LONGEST);
    let step = T::ONE / largest;
    if step > longest { longest } else { step }
}

/// Variable by which accelerations are differentiated: angle or angular velocity.
#[derive(Clone, Copy, PartialEq)]
enum Of {
    Angles,
    Rates,
}

/// Memory for derivatives of accelerations.
struct SlopeMemory<T> {
    theta: Vec<Dual<T, 1>>,
    omega: Vec<Dual<T, 1>>,
    alpha: Vec<Dual<T, 1>>,
    workspace: Workspace<Dual<T, 1>>,
}

impl<T: Real> SlopeMemory<T> {
    fn new(links: usize) -> Self {
        let zeros = || vec![Dual::constant(T::ZERO); links];
        Self {
            theta: zeros(),
            omega: zeros(),
            alpha: zeros(),
            workspace: Workspace::new(),
        }
    }

    /// Returns the largest magnitude of an eigenvalue of ∂α/∂θ or ∂α/∂ω for links at rest, by power
    /// iteration.
    fn largest(
        &mut self,
        model: &impl Pendulum<Dual<T, 1>>,
        angle: impl Fn(usize) -> f64,
        of: Of,
    ) -> T {
        for (link, (theta, omega)) in self.theta.iter_mut().zip(&mut self.omega).enumerate() {
            *theta = Dual::constant(T::from_f64(angle(link)));
            *omega = Dual::constant(T::ZERO);
            // A direction that shares no symmetry of the tree.
            let tangent = T::from_f64(0.3 + (0.618_033_988_749_895 * (link + 1) as f64) % 1.0);
            let moved = if of == Of::Angles { theta } else { omega };
            moved.tangents = [tangent];
        }
        let mut product = T::ONE;
        for iteration in 0..ITERATIONS {
            let time = Dual::constant(T::ZERO);
            let Self {
                theta,
                omega,
                alpha,
                workspace,
            } = self;
            model.accelerations_with(workspace, time, theta, omega, alpha);
            let moved = if of == Of::Angles { theta } else { omega };
            let norm = |values: &[Dual<T, 1>]| {
                let squares = values
                    .iter()
                    .map(|value| value.tangents[0] * value.tangents[0]);
                Scalar::sqrt(squares.fold(T::ZERO, |sum, square| sum + square))
            };
            let (before, after) = (norm(moved), norm(alpha));
            if after == T::ZERO {
                return T::ZERO;
            }
            if iteration >= ITERATIONS - COUNTED {
                product = product * (after / before);
            }
            for (moved, alpha) in moved.iter_mut().zip(alpha.iter()) {
                moved.tangents = [alpha.tangents[0] / after];
            }
        }
        product.powf(T::from_f64(1.0 / COUNTED as f64))
    }
}
