//! Models by the methods of this crate: one start after the other, or as many at a time as
//! vector registers have lanes.

use std::error::Error;
use std::num::NonZeroUsize;
use std::rc::Rc;

use super::candidate::{Candidate, CandidateName, SettingRange, Visit};
use super::form::{ModelForm, of_scalar};
use crate::ensemble::Ensemble;
use crate::integrate::{Dop853, Dopri5, Integrator, LaneMethod, Method, Options, Verner98};
use crate::scalar::{Lane, Real};
use crate::system::{LaneOde, State, TaylorOde};

/// Starts of a model, and how they are to be followed.
pub(super) struct Following<'r, T> {
    pub(super) method: Method,
    /// Tolerance or step.
    pub(super) setting: T,
    pub(super) starts: &'r [State<T>],
    pub(super) times: &'r [T],
}

/// Receives states of the model: index of the start, index of the time, values.
pub(super) type VisitModel<'v, T> = dyn FnMut(usize, usize, &[T]) + 'v;

/// Number of steps, or why the last time is not reached.
pub(super) type StepCount = Result<u64, Box<dyn Error + Send + Sync>>;

/// Follows starts of a model.
pub(super) type Follow<'a, T> = dyn Fn(&Following<'_, T>, &mut VisitModel<'_, T>) -> StepCount + 'a;

/// A model by one method.
pub(super) struct Integrated<'a, T> {
    pub(super) form: ModelForm<'a>,
    pub(super) scalar: &'static str,
    pub(super) method: Method,
    pub(super) in_lanes: bool,
    pub(super) follow: Rc<Follow<'a, T>>,
}

/// Follows one start after the other.
pub(super) fn one_by_one<T: Real, O: TaylorOde<T>>(
    system: &O,
    following: &Following<'_, T>,
    visit: &mut VisitModel<'_, T>,
) -> StepCount {
    let method = following.method.with(following.setting);
    let mut steps = 0;
    for (index, start) in following.starts.iter().enumerate() {
        let mut number = 0;
        let solution = method.sample(system, start, following.times, |_, state: &[T]| {
            visit(index, number, state);
            number += 1;
        })?;
        steps += solution.report.accepted;
    }
    Ok(steps)
}

/// Follows starts in lanes, on one thread: what is measured is the cost of a core.
pub(super) fn in_lanes<T: Lane, O: LaneOde<T> + Sync>(
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

/// Follows starts in lanes by an explicit pair.
pub(super) fn in_lanes_by_pair<T: Lane, O: LaneOde<T> + Sync>(
    system: &O,
    following: &Following<'_, T>,
    visit: &mut VisitModel<'_, T>,
) -> StepCount {
    let options = Options::with_tolerance(following.setting);
    match following.method {
        Method::Dopri5 => in_lanes(&Dopri5::new(options), system, following, visit),
        Method::Verner98 => in_lanes(&Verner98::new(options), system, following, visit),
        _ => in_lanes(&Dop853::new(options), system, following, visit),
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

/// Where the tolerances and steps of a method may lie, in numbers of this type.
fn settings<T: Real>(method: Method) -> SettingRange {
    if method.is_adaptive() {
        // Below some ten roundings a step cannot be judged; a series has none to judge.
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

/// The lines for the attribute and for the method.
fn written(form: &ModelForm<'_>, method: Method, scalar: &str, setting: f64) -> Vec<String> {
    let mut form = form.clone();
    if method == Method::Taylor {
        form = form.entry("emit(taylor)");
    }
    let mut lines: Vec<String> = form.attribute().into_iter().collect();
    let options = match method {
        // As `Method::with` has it.
        Method::Taylor if setting < 1e-12 => {
            format!("Options {{ compensated: true, ..Options::with_tolerance({setting:e}) }}")
        }
        _ => format!("Options::with_tolerance({setting:e})"),
    };
    let of = match scalar {
        "f64" => String::new(),
        other => format!("::<{other}>"),
    };
    lines.push(match method {
        Method::Dopri5 => format!("let method = Dopri5{of}::new({options});"),
        Method::Dop853 => format!("let method = Dop853{of}::new({options});"),
        Method::Verner98 => format!("let method = Verner98{of}::new({options});"),
        Method::Taylor => format!("let method = Taylor{of}::new({options});"),
        Method::Rk4 => format!("let method = Rk4{of}::new({setting});"),
        Method::Animation => format!("let method = Gauss{of}::for_animation({setting});"),
        Method::Gauss(order) => {
            format!("let method = Gauss{of}::new(GaussOrder::{order:?}, {setting});")
        }
    });
    lines
}

/// The system in this scalar, as one writes it.
fn system_in(form: &ModelForm<'_>, scalar: &str) -> String {
    match scalar {
        "f64" => form.system.clone(),
        _ => format!("{}.cast(|value: f64| value as f32)", form.system),
    }
}
