//! Models by the methods that take several starts at once, in the lanes of vector
//! registers.

use std::error::Error;
use std::num::NonZeroUsize;
use std::rc::Rc;

use super::candidate::{Candidate, CandidateName, SettingRange, Visit};
use super::form::ModelForm;
use super::integrated::{entered, left, of_scalar, settings, system_in, written};
use crate::ensemble::{Ensemble, Samples};
use crate::integrate::{Dop853, Dopri5, Method, Options, Taylor, Verner98};
use crate::scalar::Lane;
use crate::system::{AbsoluteAngles, LaneOde, State, TaylorPendulum};

/// A model that the methods for lanes sample.
pub(super) trait LaneSamplable<T: Lane> {
    fn sample(
        &self,
        method: Method,
        tolerance: T,
        starts: &[State<T>],
        times: &[T],
    ) -> Vec<Samples<T>>;
}

/// One thread: what is measured is the cost of a core.
pub(super) fn one_thread() -> Ensemble<'static> {
    Ensemble::new().threads(NonZeroUsize::MIN)
}

/// One of the explicit pairs in lanes.
pub(super) fn by_pair<T: Lane, O: LaneOde<T> + Sync>(
    system: &O,
    method: Method,
    tolerance: T,
    starts: &[State<T>],
    times: &[T],
) -> Vec<Samples<T>> {
    let options = Options::with_tolerance(tolerance);
    let ensemble = one_thread();
    match method {
        Method::Dopri5 => ensemble.sample_in_lanes(&Dopri5::new(options), system, starts, times),
        Method::Verner98 => {
            ensemble.sample_in_lanes(&Verner98::new(options), system, starts, times)
        }
        _ => ensemble.sample_in_lanes(&Dop853::new(options), system, starts, times),
    }
}

pub(super) struct LanesByRates<O>(pub(super) O);

impl<T: Lane, O: LaneOde<T> + Sync> LaneSamplable<T> for LanesByRates<O> {
    fn sample(
        &self,
        method: Method,
        tolerance: T,
        starts: &[State<T>],
        times: &[T],
    ) -> Vec<Samples<T>> {
        by_pair(&self.0, method, tolerance, starts, times)
    }
}

pub(super) struct LanesBySeries<P>(pub(super) AbsoluteAngles<P>);

impl<T: Lane, P: TaylorPendulum<T> + Sync> LaneSamplable<T> for LanesBySeries<P> {
    fn sample(
        &self,
        method: Method,
        tolerance: T,
        starts: &[State<T>],
        times: &[T],
    ) -> Vec<Samples<T>> {
        match method {
            Method::Taylor => {
                let series = Taylor::new(Options::with_tolerance(tolerance));
                one_thread().sample_in_lanes(&series, &self.0, starts, times)
            }
            _ => by_pair(&self.0, method, tolerance, starts, times),
        }
    }
}

/// A model by one method, as many starts at a time as registers have lanes.
pub(super) struct IntegratedInLanes<'a, T> {
    pub(super) form: ModelForm<'a>,
    pub(super) scalar: &'static str,
    pub(super) method: Method,
    pub(super) system: Rc<dyn LaneSamplable<T> + 'a>,
}

impl<T: Lane> Candidate for IntegratedInLanes<'_, T> {
    fn name(&self) -> CandidateName {
        CandidateName {
            in_lanes: true,
            ..CandidateName::new(&self.form.name, self.method.title(), self.scalar)
        }
    }

    fn settings(&self) -> SettingRange {
        settings::<T>(self.method)
    }

    fn run(
        &self,
        setting: f64,
        starts: &[State<f64>],
        times: &[f64],
        visit: &mut Visit<'_>,
    ) -> Result<u64, Box<dyn Error + Send + Sync>> {
        let own: Vec<State<T>> = starts
            .iter()
            .map(|start| entered(&self.form, start))
            .collect();
        let times = of_scalar::<T>(times);
        let runs = self
            .system
            .sample(self.method, T::from_f64(setting), &own, &times);
        let mut steps = 0;
        for (index, run) in runs.into_iter().enumerate() {
            for (number, state) in run.states().enumerate() {
                let values: Vec<f64> = state.iter().map(|value| value.to_f64()).collect();
                left(&self.form, &values, &mut |state| {
                    visit(index, number, state)
                });
            }
            steps += run.end?.report.accepted;
        }
        Ok(steps)
    }

    fn to_write(&self, setting: f64) -> Vec<String> {
        let mut lines = written(&self.form, self.method, self.scalar, setting);
        let system = system_in(&self.form, self.scalar);
        lines.push(format!(
            "Ensemble::new().sample_in_lanes(&method, &{system}, &starts, &times);"
        ));
        lines
    }
}
