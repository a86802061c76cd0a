//! Integration of many systems in the lanes of vector registers.

use std::slice::ChunksExact;

use super::Ensemble;
use crate::integrate::lanes::{self, Cases, Outcome, Task};
use crate::integrate::{Ending, IntegrationError, LaneMethod, Solution};
use crate::scalar::{InstructionSet, Lane};
use crate::system::{CastOde, State};

impl Ensemble<'_> {
    /// Integrates a system from every start to the time `end`. Each thread integrates as many
    /// trajectories at once as the machine's widest vector registers have lanes: eight in `f64`
    /// with AVX-512.
    ///
    /// The system is any [`CastOde`]: a model in [`AbsoluteAngles`](crate::system::AbsoluteAngles),
    /// with external torques ([`UnderTorques`](crate::system::UnderTorques)), or with the small
    /// differences between its copies ([`TransverseOde`](crate::system::TransverseOde)). The method
    /// is [`Dop853`](crate::integrate::Dop853), [`Dopri5`](crate::integrate::Dopri5),
    /// [`Verner98`](crate::integrate::Verner98) or, for fixed steps, [`Rk4`](crate::integrate::Rk4)
    /// and [`Gauss`](crate::integrate::Gauss); for absolute angles of models with `emit(taylor)`
    /// also [`Taylor`](crate::integrate::Taylor).
    ///
    /// Each trajectory has its own steps, chosen by the rules of `method` from its own errors, and
    /// its own result and report, as from [`integrate`](Self::integrate). Its bits depend on its
    /// start alone, not on its lane, the other starts or the number of threads. Methods with
    /// adaptive steps fuse products and sums if the machine can, so that the bits differ from those
    /// of [`integrate`](Self::integrate); both keep the tolerance. Methods with fixed steps do not
    /// fuse: states, samples, reports and errors are identical to those of
    /// [`integrate`](Self::integrate) bit for bit, for equations that have the [same
    /// bits](crate::scalar#which-bits) in lanes and alone, as those of emitted models do. A lane
    /// whose trajectory has ended takes the next start.
    ///
    /// Memory per thread, for each component of a state: 22, 30 or 36 registers for the pairs of
    /// order 5, 8 and 9, six for [`Rk4`](crate::integrate::Rk4), 3 s + 7 for
    /// [`Gauss`](crate::integrate::Gauss) with s stages (and the matrix of each lane, with Newton's
    /// method), and about 20 + 4 p for a Taylor series of order p. Steps do not allocate.
    ///
    /// # Examples
    ///
    #[cfg_attr(feature = "macros", doc = "```")]
    #[cfg_attr(not(feature = "macros"), doc = "```ignore")]
    /// use branched_pendulum::prelude::*;
    ///
    /// #[branched_pendulum(gravity = 9.80665, rod(mass = 0.2, com = 0.25, inertia = 4e-3))]
    /// struct Rod;
    ///
    /// let rod = Rod::new();
    /// let starts: Vec<State<f64>> = (1..100)
    ///     .map(|i| State::at_rest(0.0, &[0.03 * f64::from(i)]))
    ///     .collect();
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let system = AbsoluteAngles(&rod);
    /// let lanes = Ensemble::new().integrate_in_lanes(&method, &system, &starts, 10.0);
    /// let plain = Ensemble::new().integrate(&method, &system, &starts, 10.0);
    /// for (lane, plain) in lanes.into_iter().zip(plain) {
    ///     let (lane, plain) = (lane?.state.values[0], plain?.state.values[0]);
    ///     assert!((lane - plain).abs() < 1e-7);
    /// }
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    pub fn integrate_in_lanes<T, O, M>(
        &self,
        method: &M,
        system: &O,
        starts: &[State<T>],
        end: T,
    ) -> Vec<Result<Solution<T>, IntegrationError<T>>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        self.ends(method, Cases::Starts(system, starts), end, &[])
    }

    /// Integrates a system from every start to the time `end`, or until one of the endings occurs,
    /// in lanes like [`integrate_in_lanes`](Self::integrate_in_lanes). Endings are, for example,
    /// times at which a link turns over, or at which a motion leaves a region.
    ///
    /// A trajectory that ends in this manner has the time and the state of the crossing, from the
    /// dense output of the method, and
    /// [`StopReason::StoppedByEvent`](crate::integrate::StopReason::StoppedByEvent); its lane takes
    /// the next start. Crossings are found as by
    /// [`integrate_with_events`](crate::integrate::Integrator::integrate_with_events), in each lane
    /// separately.
    ///
    /// # Examples
    ///
    /// Time until a rod goes over the top, depending on its initial speed:
    ///
    #[cfg_attr(feature = "macros", doc = "```")]
    #[cfg_attr(not(feature = "macros"), doc = "```ignore")]
    /// use branched_pendulum::integrate::{Crossing, Ending, StopReason};
    /// use branched_pendulum::prelude::*;
    ///
    /// #[branched_pendulum(gravity = 9.80665, rod(mass = 0.2, com = 0.25, inertia = 4e-3))]
    /// struct Rod;
    ///
    /// let starts = [5.0, 9.0, 12.0].map(|speed| State::new(0.0, vec![0.0, speed]));
    /// let top = |_: f64, state: &[f64]| state[0] - std::f64::consts::PI;
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let rod = AbsoluteAngles(Rod::new());
    /// let ends = Ensemble::new().integrate_in_lanes_until(
    ///     &method,
    ///     &rod,
    ///     &starts,
    ///     10.0,
    ///     &[Ending::new(Crossing::Rising, &top)],
    /// );
    /// let ends = ends.into_iter().collect::<Result<Vec<_>, _>>()?;
    /// assert_eq!(ends[0].report.stop, StopReason::EndReached);
    /// assert_eq!(ends[2].report.stop, StopReason::StoppedByEvent);
    /// assert!((ends[2].state.values[0] - std::f64::consts::PI).abs() < 1e-9);
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    pub fn integrate_in_lanes_until<T, O, M>(
        &self,
        method: &M,
        system: &O,
        starts: &[State<T>],
        end: T,
        endings: &[Ending<'_, T>],
    ) -> Vec<Result<Solution<T>, IntegrationError<T>>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        self.ends(method, Cases::Starts(system, starts), end, endings)
    }

    /// Integrates systems that differ in their constants, each from its own start, in lanes like
    /// [`integrate_in_lanes`](Self::integrate_in_lanes): for scans over friction, masses, lengths,
    /// drives.
    ///
    /// Every lane has the constants of its own system; a trajectory has the bits that
    /// [`integrate_in_lanes`](Self::integrate_in_lanes) gives it with that system. A system without
    /// finite rates, at once or later, fails alone, with its last valid state. The cost is that of
    /// the same number of starts of one system, plus copying the constants of the next system into
    /// a lane.
    ///
    /// The systems have one type and differ only in the constants that [`CastOde::cast`]
    /// converts.
    ///
    /// # Examples
    ///
    /// Speed of a rod after ten seconds, depending on its friction:
    ///
    #[cfg_attr(feature = "macros", doc = "```")]
    #[cfg_attr(not(feature = "macros"), doc = "```ignore")]
    /// use branched_pendulum::ParameterError;
    /// use branched_pendulum::prelude::*;
    ///
    /// #[branched_pendulum(
    ///     gravity = 9.80665,
    ///     rod(mass = 0.2, com = 0.25, inertia = 4e-3, friction = friction),
    /// )]
    /// struct Rod;
    ///
    /// let release = State::at_rest(0.0, &[1.0]);
    /// let scan = (0..30)
    ///     .map(|i| Rod::new(RodParameters { friction: 1e-4 * f64::from(i) }))
    ///     .map(|rod| Ok((AbsoluteAngles(rod?), release.clone())))
    ///     .collect::<Result<Vec<_>, ParameterError>>()?;
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let ends = Ensemble::new().integrate_models_in_lanes(&method, &scan, 10.0);
    /// let plain = Ensemble::new().integrate(&method, &scan[7].0, &[release], 10.0);
    /// let speeds = [&ends[7], &plain[0]].map(|end| end.as_ref().unwrap().state.values[1]);
    /// assert!((speeds[0] - speeds[1]).abs() < 1e-7);
    /// # Ok::<(), ParameterError>(())
    /// ```
    pub fn integrate_models_in_lanes<T, O, M>(
        &self,
        method: &M,
        releases: &[(O, State<T>)],
        end: T,
    ) -> Vec<Result<Solution<T>, IntegrationError<T>>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        self.ends(method, Cases::Pairs(releases), end, &[])
    }

    /// Integrates systems that differ in their constants, each from its own start, to the time
    /// `end`, or until one of the endings occurs. It combines
    /// [`integrate_in_lanes_until`](Self::integrate_in_lanes_until) with the arguments of
    /// [`integrate_models_in_lanes`](Self::integrate_models_in_lanes).
    pub fn integrate_models_in_lanes_until<T, O, M>(
        &self,
        method: &M,
        releases: &[(O, State<T>)],
        end: T,
        endings: &[Ending<'_, T>],
    ) -> Vec<Result<Solution<T>, IntegrationError<T>>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        self.ends(method, Cases::Pairs(releases), end, endings)
    }

    /// Returns the states of a system at the given times, from every start, in lanes like
    /// [`integrate_in_lanes`](Self::integrate_in_lanes).
    ///
    /// Times must go in one direction from every start; times equal to the start's return the start
    /// itself. The steps are those of [`integrate_in_lanes`](Self::integrate_in_lanes) to the last
    /// time. States between step ends come from the dense output of the method, also computed in
    /// lanes. Without times the end is the start.
    ///
    /// Memory, in addition to that of the steps: one state per time and start.
    ///
    /// # Examples
    ///
    /// The samples of a trajectory end where it fails; other trajectories are not affected:
    ///
    #[cfg_attr(feature = "macros", doc = "```")]
    #[cfg_attr(not(feature = "macros"), doc = "```ignore")]
    /// use branched_pendulum::prelude::*;
    ///
    /// #[branched_pendulum(gravity = 9.80665, rod(mass = 0.2, com = 0.25, inertia = 4e-3))]
    /// struct Rod;
    ///
    /// let starts = [0.1, f64::NAN, 0.2].map(|angle| State::at_rest(0.0, &[angle]));
    /// let times: Vec<f64> = (0..=100).map(|i| 0.1 * f64::from(i)).collect();
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let rod = AbsoluteAngles(Rod::new());
    /// let samples = Ensemble::new().sample_in_lanes(&method, &rod, &starts, &times);
    /// assert_eq!(samples[0].states().len(), 101);
    /// assert_eq!(samples[0].states().next(), Some([0.1, 0.0].as_slice()));
    /// assert_eq!(samples[1].states().len(), 0);
    /// assert!(samples[1].end.is_err() && samples[2].end.is_ok());
    /// ```
    pub fn sample_in_lanes<T, O, M>(
        &self,
        method: &M,
        system: &O,
        starts: &[State<T>],
        times: &[T],
    ) -> Vec<Samples<T>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        self.samples(method, Cases::Starts(system, starts), times)
    }

    /// Returns the states at the given times of systems that differ in their constants, each from
    /// its own start. It combines [`sample_in_lanes`](Self::sample_in_lanes) with the arguments of
    /// [`integrate_models_in_lanes`](Self::integrate_models_in_lanes).
    pub fn sample_models_in_lanes<T, O, M>(
        &self,
        method: &M,
        releases: &[(O, State<T>)],
        times: &[T],
    ) -> Vec<Samples<T>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        self.samples(method, Cases::Pairs(releases), times)
    }

    /// Samples the trajectories of systems like
    /// [`sample_models_in_lanes`](Self::sample_models_in_lanes), but with separate times for each
    /// system; a trajectory ends at its last time.
    pub(crate) fn sample_models_at_own_times<T, O, M>(
        &self,
        method: &M,
        releases: &[(O, State<T>)],
        times: &[&[T]],
    ) -> Vec<Samples<T>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        self.samples(method, Cases::Timed(releases, times), &[])
    }

    fn ends<T, O, M>(
        &self,
        method: &M,
        cases: Cases<'_, O, T>,
        end: T,
        endings: &[Ending<'_, T>],
    ) -> Vec<Result<Solution<T>, IntegrationError<T>>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        let outcomes = self.in_lanes(method, cases, &[], Some(end), endings);
        outcomes.map(|outcome| outcome.end).collect()
    }

    fn samples<T, O, M>(&self, method: &M, cases: Cases<'_, O, T>, times: &[T]) -> Vec<Samples<T>>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        let dimension = cases.get(0).map_or(0, |(system, _)| system.dimension());
        let outcomes = self.in_lanes(method, cases, times, times.last().copied(), &[]);
        outcomes
            .map(|Outcome { end, samples }| Samples {
                dimension,
                values: samples,
                end,
            })
            .collect()
    }

    /// Integrates every trajectory through its output times to its end; returns the outcomes in
    /// order.
    fn in_lanes<T, O, M>(
        &self,
        method: &M,
        cases: Cases<'_, O, T>,
        times: &[T],
        end: Option<T>,
        endings: &[Ending<'_, T>],
    ) -> impl Iterator<Item = Outcome<T>> + use<T, O, M>
    where
        T: Lane,
        O: CastOde<T> + Sync,
        M: LaneMethod<O, T>,
    {
        let task = Task {
            instructions: InstructionSet::widest(),
            method,
            cases,
            times,
            end,
            endings,
        };
        let outcomes = self.on_threads(task.cases.len(), |queue| {
            let mut results = Vec::new();
            let mut done = |index, outcome| {
                results.push((index, outcome));
                queue.done();
            };
            lanes::integrate(&task, &mut || queue.next(), &mut done);
            results
        });
        outcomes.into_iter()
    }
}

/// Samples of a trajectory at given times.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples<T> {
    dimension: usize,
    values: Vec<T>,
    /// Last state and report of the trajectory, or the error that ended it early.
    pub end: Result<Solution<T>, IntegrationError<T>>,
}

impl<T> Samples<T> {
    /// Returns the states at the requested times, in order: one per time. If the trajectory failed,
    /// only those up to its last valid state, and none within its last step if the rates became
    /// infinite or NaN there.
    pub fn states(&self) -> ChunksExact<'_, T> {
        self.values.chunks_exact(self.dimension.max(1))
    }
}
