//! Models integrated by the methods of this crate: one start after the other, or several at once in
//! the lanes of vector registers.

use std::error::Error;
use std::num::NonZeroUsize;
use std::rc::Rc;

use crate::candidate::{Candidate, CandidateName, SettingRange, Visit};
use crate::form::{ModelForm, of_scalar};
use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::integrate::{
    Dop853, Dopri5, Integrator, LaneMethod, Method, Options, Verner98,
};
use branched_pendulum::scalar::{Lane, Real};
use branched_pendulum::system::{CastOde, State, TaylorOde};

/// Starts of a model, with the setting and the sample times of a run.
pub(crate) struct Following<'r, T> {
    pub(crate) method: Method,
    /// Tolerance or step.
    pub(crate) setting: T,
    pub(crate) starts: &'r [State<T>],
    pub(crate) times: &'r [T],
}

/// Receives states of the model: index of the start, index of the time, values.
pub(crate) type VisitModel<'v, T> = dyn FnMut(usize, usize, &[T]) + 'v;

/// Number of steps, or the reason why the last time is not reached.
pub(crate) type StepCount = Result<u64, Box<dyn Error + Send + Sync>>;

/// Function that integrates all starts of a model.
pub(crate) type Follow<'a, T> = dyn Fn(&Following<'_, T>, &mut VisitModel<'_, T>) -> StepCount + 'a;

/// A model with one method.
pub(crate) struct Integrated<'a, T> {
    pub(crate) form: ModelForm<'a>,
    pub(crate) scalar: &'static str,
    pub(crate) method: Method,
    pub(crate) in_lanes: bool,
    pub(crate) follow: Rc<Follow<'a, T>>,
}

/// Integrates one start after the other. Takes `&dyn TaylorOde` so that the methods are compiled only
/// once per scalar type; the indirect call adds the same time to each evaluation of every method.
pub(crate) fn one_by_one<T: Real>(
    system: &dyn TaylorOde<T>,
    following: &Following<'_, T>,
    visit: &mut VisitModel<'_, T>,
) -> StepCount {
    let method = following.method.with(following.setting);
    let mut steps = 0;
    for (index, start) in following.starts.iter().enumerate() {
        let mut number = 0;
        let solution = method.sample(&system, start, following.times, |_, state: &[T]| {
            visit(index, number, state);
            number += 1;
        })?;
        steps += solution.report.accepted;
    }
    Ok(steps)
}

/// Integrates several starts at once in the lanes of vector registers, on one thread, so that the
/// cost on one core is measured.
pub(crate) fn in_lanes<T: Lane, O: CastOde<T> + Sync>(
    method: &impl LaneMethod<O, T>,
    system: &O,
    following: &Following<'_, T>,
    visit: &mut VisitModel<'_, T>,
) -> StepCount {
    let ensemble = Ensemble::new().threads(NonZeroUsize::MIN);
    let runs = ensemble.sample_in_lanes(method, system, following.starts, following.times);
    let mut steps = 0;
    for (index, run) in runs.into_iter().enumerate() {
        for (number, state) in run.states().enumerate() {
            visit(index, number, state);
        }
        steps += run.end?.report.accepted;
    }
    Ok(steps)
}

/// Integrates several starts at once by an explicit pair; returns an error for any other method.
pub(crate) fn in_lanes_by_pair<T: Lane, O: CastOde<T> + Sync>(
    system: &O,
    following: &Following<'_, T>,
    visit: &mut VisitModel<'_, T>,
) -> StepCount {
    let options = Options::with_tolerance(following.setting);
    match following.method {
        Method::Dopri5 => in_lanes(&Dopri5::new(options), system, following, visit),
        Method::Verner98 => in_lanes(&Verner98::new(options), system, following, visit),
        Method::Dop853 => in_lanes(&Dop853::new(options), system, following, visit),
        Method::Rk4 | Method::Taylor | Method::Gauss(_) | Method::Animation => {
            Err(format!("`{}` is not an explicit pair", following.method).into())
        }
    }
}

impl<T: Real> Candidate for Integrated<'_, T> {
    fn name(&self) -> CandidateName {
        CandidateName {
            in_lanes: self.in_lanes,
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
        let starts: Vec<State<T>> = starts
            .iter()
            .map(|start| self.form.entered(start))
            .collect();
        let following = Following {
            method: self.method,
            setting: T::from_f64(setting),
            starts: &starts,
            times: &of_scalar::<T>(times),
        };
        let mut values = Vec::new();
        (self.follow)(&following, &mut |start, time, state| {
            values.clear();
            values.extend(state.iter().map(|value| value.to_f64()));
            self.form
                .left(&values, &mut |state| visit(start, time, state));
        })
    }

    fn to_write(&self, setting: f64) -> Vec<String> {
        let mut lines = written(&self.form, self.method, self.scalar, setting);
        let system = system_in(&self.form, self.scalar);
        lines.push(match self.in_lanes {
            true => {
                format!("Ensemble::new().sample_in_lanes(&method, &{system}, &starts, &times);")
            }
            false => format!("method.sample(&{system}, &start, &times, |time, state| …)?;"),
        });
        lines
    }
}

/// Returns the range of tolerances or steps of a method, for this type of number.
fn settings<T: Real>(method: Method) -> SettingRange {
    if method.is_adaptive() {
        // Below some ten roundings the error estimate of a step is useless; a series has no such
        // estimate.
        let roundings = if method == Method::Taylor { 0.5 } else { 20.0 };
        SettingRange::Tolerance {
            coarsest: 1e-1,
            finest: roundings * T::EPSILON.to_f64(),
        }
    } else {
        SettingRange::Step {
            coarsest: 0.2,
            finest: 1e-5,
        }
    }
}

/// Returns the lines for the attribute and for the method.
fn written(form: &ModelForm<'_>, method: Method, scalar: &str, setting: f64) -> Vec<String> {
    let mut form = form.clone();
    if method == Method::Taylor {
        form = form.entry("emit(taylor)");
    }
    let mut lines: Vec<String> = form.attribute().into_iter().collect();
    lines.push(format!(
        "let method = {};",
        method.as_source(scalar, setting)
    ));
    lines
}

/// Returns the Rust expression of the system in this scalar type.
fn system_in(form: &ModelForm<'_>, scalar: &str) -> String {
    match scalar {
        "f64" => form.system.clone(),
        _ => format!("{}.cast(|value: f64| value as f32)", form.system),
    }
}
