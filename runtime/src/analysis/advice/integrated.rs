//! Models by the methods of this crate, one start after the other.

use std::error::Error;
use std::rc::Rc;

use super::candidate::{Candidate, CandidateName, SettingRange, Visit};
use super::form::ModelForm;
use crate::integrate::{AnyIntegrator, IntegrationError, Integrator, Method, Solution};
use crate::scalar::Real;
use crate::system::{Ode, RatesOnly, State, TaylorOde};

/// A system that any method samples.
pub(super) trait Samplable<T: Real> {
    fn sample(
        &self,
        method: &AnyIntegrator<T>,
        start: &State<T>,
        times: &[T],
        visit: &mut dyn FnMut(&[T]),
    ) -> Result<Solution<T>, IntegrationError<T>>;
}

pub(super) struct ByRates<O>(pub(super) O);

impl<T: Real, O: Ode<T>> Samplable<T> for ByRates<O> {
    fn sample(
        &self,
        method: &AnyIntegrator<T>,
        start: &State<T>,
        times: &[T],
        visit: &mut dyn FnMut(&[T]),
    ) -> Result<Solution<T>, IntegrationError<T>> {
        method.sample(&RatesOnly(&self.0), start, times, |_, values| visit(values))
    }
}

pub(super) struct BySeries<O>(pub(super) O);

impl<T: Real, O: TaylorOde<T>> Samplable<T> for BySeries<O> {
    fn sample(
        &self,
        method: &AnyIntegrator<T>,
        start: &State<T>,
        times: &[T],
        visit: &mut dyn FnMut(&[T]),
    ) -> Result<Solution<T>, IntegrationError<T>> {
        method.sample(&self.0, start, times, |_, values| visit(values))
    }
}

/// A model by one method, one start after the other.
pub(super) struct Integrated<'a, T> {
    pub(super) form: ModelForm<'a>,
    pub(super) scalar: &'static str,
    pub(super) method: Method,
    pub(super) system: Rc<dyn Samplable<T> + 'a>,
}

impl<T: Real> Candidate for Integrated<'_, T> {
    fn name(&self) -> CandidateName {
        CandidateName::new(&self.form.name, self.method.title(), self.scalar)
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
        let method = self.method.with(T::from_f64(setting));
        let times = of_scalar::<T>(times);
        let mut steps = 0;
        for (index, start) in starts.iter().enumerate() {
            let own = entered(&self.form, start);
            let (mut number, mut values) = (0, Vec::new());
            let solution = self.system.sample(&method, &own, &times, &mut |state| {
                values.clear();
                values.extend(state.iter().map(|value| value.to_f64()));
                left(&self.form, &values, &mut |state| {
                    visit(index, number, state)
                });
                number += 1;
            })?;
            steps += solution.report.accepted;
        }
        Ok(steps)
    }

    fn to_write(&self, setting: f64) -> Vec<String> {
        let mut lines = written(&self.form, self.method, self.scalar, setting);
        let system = system_in(&self.form, self.scalar);
        lines.push(format!(
            "method.sample(&{system}, &start, &times, |time, state| …)?;"
        ));
        lines
    }
}

pub(super) fn of_scalar<T: Real>(values: &[f64]) -> Vec<T> {
    values.iter().map(|&value| T::from_f64(value)).collect()
}

/// A start of the scene as one of the model.
pub(super) fn entered<T: Real>(form: &ModelForm<'_>, start: &State<f64>) -> State<T> {
    let own = form.enter.as_ref().map(|enter| enter(&start.values));
    let values = own.as_deref().unwrap_or(&start.values);
    State::new(T::from_f64(start.time), of_scalar(values))
}

/// A state of the model as one of the scene.
pub(super) fn left(form: &ModelForm<'_>, values: &[f64], visit: &mut dyn FnMut(&[f64])) {
    match &form.leave {
        Some(leave) => visit(&leave(values)),
        None => visit(values),
    }
}

/// Where the tolerances and steps of a method may lie, in numbers of this type.
pub(super) fn settings<T: Real>(method: Method) -> SettingRange {
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
pub(super) fn written(
    form: &ModelForm<'_>,
    method: Method,
    scalar: &str,
    setting: f64,
) -> Vec<String> {
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
pub(super) fn system_in(form: &ModelForm<'_>, scalar: &str) -> String {
    match scalar {
        "f64" => form.system.clone(),
        _ => format!("{}.cast(|value: f64| value as f32)", form.system),
    }
}
