//! Differences between two copies, as deviations from their motion in phase.

use super::{Grown, Growth, GrowthError};
use crate::analysis::variational::{Copies, Linearised};
use crate::system::{Ode, State, Workspace};

/// A system whose deviations are differences between copies that move in phase: those of two
/// copies are opposite, all that is no copy has none. Rounding would else let deviations in
/// phase grow beside them, which a chaotic motion makes large.
///
/// [`Growth::between_copies`] takes it for models without transverse equations; the motion
/// itself has to be in phase ([`Copies::are_in_phase`]). A difference of the first links that
/// does not reach what hangs from them, as that of two wheels that carry rods on their axes,
/// says nothing of those: [`Lyapunov::transverse`](crate::analysis::variational::Lyapunov)
/// looks at all differences.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::growth::{BetweenCopies, Growth, GrowthError};
/// use branched_pendulum::analysis::variational::{Copies, linearised};
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
/// )]
/// struct BranchedDouble;
///
/// let model = BranchedDouble::<f64>::new();
/// let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
/// let system = BetweenCopies::new(linearised(AbsoluteAngles(&model)), children.clone());
/// let growth = Growth {
///     frequency_hz: system.frequency_at_rest().unwrap(),
///     horizons: vec![10.0],
///     tolerance: 1e-9,
/// };
/// assert!((growth.frequency_hz - 1.2581).abs() < 1e-4);
/// let start = State::at_rest(0.0, &[44_f64.to_radians(), 0.0, 0.0]);
/// assert!(children.are_in_phase(&system, &start));
/// let grown = growth.between_copies(&system, &start)?;
/// assert!(grown.factors[0].value > 16.0);
/// # Ok::<(), GrowthError>(())
/// ```
#[derive(Clone, Debug)]
pub struct BetweenCopies<L> {
    system: L,
    copies: Copies,
}

impl<L: Ode<f64>> BetweenCopies<L> {
    /// Returns the system of angles followed by their rates, with its copies: the first two
    /// differ by the first of their angles at the start.
    pub fn new(system: L, copies: Copies) -> Self {
        Self { system, copies }
    }

    /// Index of the first angle that differs.
    fn first(&self) -> Option<usize> {
        self.copies.groups().first()?.first().copied()
    }
}

impl<L: Linearised<f64>> BetweenCopies<L> {
    /// Returns the frequency in hertz of a small difference of the first angles, beside all
    /// angles zero and at rest; none where it does not oscillate.
    pub fn frequency_at_rest(&self) -> Option<f64> {
        let dimension = self.system.dimension();
        let (zeros, mut rates) = (vec![0.0; dimension], vec![0.0; dimension]);
        let mut changes = vec![0.0; dimension];
        let workspace = &mut Workspace::new();
        let deviation = self.copies.opposite(dimension);
        self.linearised_rates(workspace, 0.0, &zeros, &deviation, &mut rates, &mut changes);
        let frequency =
            (-changes.get(dimension / 2 + self.first()?)?).sqrt() / std::f64::consts::TAU;
        (frequency > 0.0).then_some(frequency)
    }
}

impl<L: Ode<f64>> Ode<f64> for BetweenCopies<L> {
    fn dimension(&self) -> usize {
        self.system.dimension()
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.system.rates(time, state, rates);
    }
}

impl<L: Linearised<f64>> Linearised<f64> for BetweenCopies<L> {
    fn linearised_rates(
        &self,
        workspace: &mut Workspace<f64>,
        time: f64,
        state: &[f64],
        deviation: &[f64],
        rates: &mut [f64],
        deviation_rates: &mut [f64],
    ) {
        let (all, inner) = workspace.with_inner(deviation_rates.len());
        let system = &self.system;
        system.linearised_rates(inner, time, state, deviation, rates, all);
        self.copies.write_differences(all, deviation_rates);
    }
}

impl Growth {
    /// Returns the growth of a difference between copies along their motion in phase, looked
    /// at by the first of their angles.
    ///
    /// # Errors
    ///
    /// [`GrowthError`].
    pub fn between_copies<L: Linearised<f64>>(
        &self,
        system: &BetweenCopies<L>,
        start: &State<f64>,
    ) -> Result<Grown, GrowthError> {
        let angle = system.first().ok_or(GrowthError::Difference)?;
        let rate = system.dimension() / 2 + angle;
        let differences = [angle..angle + 1, rate..rate + 1];
        let opposite = system.copies.opposite(system.dimension());
        self.along(system, start, &opposite, differences)
    }
}
