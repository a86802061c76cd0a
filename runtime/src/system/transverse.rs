//! Small differences between copies that move in phase.

use super::by_reference::by_reference;
use super::function::{At, Computes, SliceCounts, compute_in, functions};
use super::second_order::{CastSecondOrder, SecondOrder, SecondOrderOde};
use super::{Pendulum, Workspace};
use crate::scalar::Scalar;

/// Copies that move in phase, whose small differences follow equations of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TransverseSector {
    /// Name of the model's link that stands for the copies.
    pub name: &'static str,
    /// Index of that link; the links that hang from it follow it.
    pub first: usize,
    /// Number of these links, itself included: of the differences.
    pub links: usize,
    /// Number of copies under one link of the whole tree.
    pub copies: usize,
    /// Number of links of the whole tree that hold such copies and move alike. Each has
    /// differences of its own, which follow the same equations.
    pub holders: usize,
}

/// An in-phase motion at one time, as slices of one value for each link.
#[derive(Clone, Copy, Debug)]
pub struct InPhaseMotion<'a, T> {
    /// Angles, rad.
    pub theta: &'a [T],
    /// Angular velocities, rad/s.
    pub omega: &'a [T],
    /// Angular accelerations, rad/s².
    pub alpha: &'a [T],
}

/// A model of copies in phase that knows how small differences between them go on:
/// `in_phase(…)` with `emit(transverse)`.
///
/// Copies of a sector have the angles θ + e δ, with any numbers e that add up to 0 over
/// the copies under one link and whose squares add up to the number of copies; ±1 for
/// two. The differences δ of the copies and of all that hangs from them follow linear
/// equations, exact for infinitesimal ones, whose coefficients are those of the in-phase
/// motion (physics (12.2); for one link, Hill's equation). So a threshold costs that motion and
/// a small linear system.
///
/// Sectors are counted in the order of [`TRANSVERSE`](Self::TRANSVERSE). Values are NaN
/// for a sector that does not exist and for slices of other lengths.
pub trait Transverse<T: Scalar>: Pendulum<T> + Computes<functions::LinearDifferences, T> {
    /// The sectors.
    const TRANSVERSE: &'static [TransverseSector];

    /// Writes the second time derivatives (in rad/s²) of the differences of a sector
    /// (in rad) with the given rates (in rad/s).
    fn transverse_accelerations_into(
        &self,
        sector: usize,
        time: T,
        motion: InPhaseMotion<'_, T>,
        difference: &[T],
        difference_rate: &[T],
        accelerations: &mut [T],
    );

    /// Writes the angular accelerations of the in-phase motion and after them those of the
    /// differences, with what both need formed once.
    #[inline]
    fn transverse_motion_into(
        &self,
        sector: usize,
        time: T,
        [theta, omega]: [&[T]; 2],
        [differences, rates]: [&[T]; 2],
        accelerations: &mut [T],
    ) {
        let at = At {
            time,
            index: sector,
        };
        let given = [theta, omega, differences, rates];
        self.compute_with(&mut Workspace::new(), at, &given, &mut [accelerations]);
    }

    /// Returns the energy (in J) of the differences in the copies under one link, with
    /// the potential energy of links that hang: quadratic.
    fn transverse_energy_of(
        &self,
        sector: usize,
        theta: &[T],
        difference: &[T],
        difference_rate: &[T],
    ) -> T;

    /// Returns the energy transfer W (in W) into the differences: the rate of their
    /// energy but for friction and drag.
    fn transverse_transfer_of(
        &self,
        sector: usize,
        time: T,
        motion: InPhaseMotion<'_, T>,
        difference: &[T],
        difference_rate: &[T],
    ) -> T;

    /// Returns the power (in W) of friction and drag on the energy of the differences. NaN
    /// where friction is not viscous: it depends on the motion then, see
    /// [`transverse_friction_power_along`](Self::transverse_friction_power_along).
    fn transverse_friction_power_of(&self, sector: usize, difference_rate: &[T]) -> T;

    /// Returns the power (in W) of friction and drag on the energy of the differences,
    /// viscous or not.
    fn transverse_friction_power_along(
        &self,
        sector: usize,
        _motion: InPhaseMotion<'_, T>,
        difference_rate: &[T],
    ) -> T {
        self.transverse_friction_power_of(sector, difference_rate)
    }
}

/// An in-phase motion and the small differences of one sector as a first-order system:
/// the state is the angles, the differences, the angular velocities and the rates of
/// the differences. Differences of any size belong to it, since their equations are
/// linear. Torques from outside that are equal on all copies change the in-phase motion
/// alone.
///
/// ```
/// # #[cfg(feature = "macros")] {
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::TransverseOde;
///
/// /// The paper's pendulum, its children in phase.
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     in_phase(child),
///     emit(transverse),
/// )]
/// struct InPhase;
///
/// // Growth of the antiphase mode within 10 s of a release with vertical children.
/// let model = InPhase::new();
/// let ode = TransverseOde::new(&model, 0).unwrap();
/// let growth = |degrees: f64| {
///     let start = State::at_rest(0.0, &[degrees.to_radians(), 0.0, 1.0]);
///     let mut largest = 0.0_f64;
///     let method = Dop853::new(Options::with_tolerance(1e-10));
///     method.integrate(&ode, &start, 10.0, |step| {
///         largest = largest.max(step.end()[2].abs());
///         ControlFlow::Continue(())
///     })?;
///     Ok::<_, IntegrationError<f64>>(largest)
/// };
/// assert!(growth(42.0).unwrap() < 10.0 && growth(44.0).unwrap() > 10.0);
/// # }
/// ```
pub type TransverseOde<P> = SecondOrderOde<Beside<P>>;

/// A model and one of its sectors: [`TransverseOde`].
#[derive(Clone, Copy, Debug)]
pub struct Beside<P> {
    model: P,
    index: usize,
    sector: TransverseSector,
}

impl<P> SecondOrderOde<Beside<P>> {
    /// The differences of the sector with that index beside the motion of a model, or
    /// of a reference to one; `None` without such a sector.
    pub fn new<T: Scalar>(model: P, sector: usize) -> Option<Self>
    where
        P: Transverse<T>,
    {
        Some(SecondOrderOde(Beside {
            model,
            index: sector,
            sector: *P::TRANSVERSE.get(sector)?,
        }))
    }

    /// The sector.
    pub fn sector(&self) -> &TransverseSector {
        &self.0.sector
    }
}

impl<T: Scalar, P: Computes<functions::LinearDifferences, T>> SecondOrder<T> for Beside<P> {
    fn coordinates(&self) -> usize {
        self.model.links() + self.sector.links
    }

    #[inline(always)]
    fn rates(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: [&[T]; 2],
        rates: [&mut [T]; 2],
    ) {
        let at = At {
            time,
            index: self.index,
        };
        with_differences(&self.model, workspace, at, state, rates);
    }
}

impl<T: Scalar, P: Transverse<T>> CastSecondOrder<T> for Beside<P> {
    type On<S: Scalar> = Beside<<P as Computes<functions::LinearDifferences, T>>::On<S>>;

    const COORDINATES: Option<usize> = match (P::KNOWN_LINKS, common_links(P::TRANSVERSE)) {
        (Some(motion), Some(links)) => Some(motion + links),
        _ => None,
    };

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        Beside {
            model: self.model.on(convert),
            index: self.index,
            sector: self.sector,
        }
    }

    fn shape(&self) -> usize {
        self.model.shape().wrapping_add(self.index)
    }
}

/// Returns the number of links that all sectors have, if it is one.
const fn common_links(sectors: &[TransverseSector]) -> Option<usize> {
    let mut index = 0;
    while index < sectors.len() {
        if sectors[index].links != sectors[0].links {
            return None;
        }
        index += 1;
    }
    match sectors {
        [] => None,
        [first, ..] => Some(first.links),
    }
}

/// Writes the rates of angles and differences, and of their velocities, by a function of
/// angles, angular velocities, differences and their rates.
#[inline(always)]
pub(super) fn with_differences<F: SliceCounts, T: Scalar, P: Computes<F, T>>(
    model: &P,
    workspace: Option<&mut Workspace<T>>,
    at: At<T>,
    [angles, velocities]: [&[T]; 2],
    [angle_rates, accelerations]: [&mut [T]; 2],
) {
    angle_rates.copy_from_slice(velocities);
    let ([theta, difference], [omega, rate]) = (
        parts(model.links(), angles),
        parts(model.links(), velocities),
    );
    let given = [theta, omega, difference, rate];
    compute_in(model, workspace, at, &given, &mut [accelerations]);
}

/// Returns the values of angles in phase, and those of differences.
#[inline(always)]
pub(super) fn parts<T>(links: usize, values: &[T]) -> [&[T]; 2] {
    let (in_phase, differences) = values.split_at(links.min(values.len()));
    [in_phase, differences]
}

by_reference! {
    impl<T: Scalar> Transverse<T> for &P {
        const TRANSVERSE: &'static [TransverseSector];
        fn transverse_accelerations_into(
            &self, sector: usize, time: T, motion: InPhaseMotion<'_, T>, difference: &[T],
            difference_rate: &[T], accelerations: &mut [T]
        );
        fn transverse_energy_of(
            &self, sector: usize, theta: &[T], difference: &[T], difference_rate: &[T]
        ) -> T;
        fn transverse_transfer_of(
            &self, sector: usize, time: T, motion: InPhaseMotion<'_, T>, difference: &[T],
            difference_rate: &[T]
        ) -> T;
        fn transverse_friction_power_of(&self, sector: usize, difference_rate: &[T]) -> T;
        fn transverse_friction_power_along(
            &self, sector: usize, motion: InPhaseMotion<'_, T>, difference_rate: &[T]
        ) -> T;
    }
}
