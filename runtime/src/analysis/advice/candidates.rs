//! Candidates made of models and of the methods of this crate.

use std::error::Error;
use std::fmt;
use std::num::NonZeroUsize;
use std::rc::Rc;

use super::candidate::{Candidate, CandidateName, SettingRange, Visit};
use super::form::ModelForm;
use crate::ensemble::{Ensemble, Samples};
use crate::integrate::{
    AnyIntegrator, Dop853, Dopri5, IntegrationError, Integrator, Method, Options, Solution, Taylor,
    Verner98,
};
use crate::scalar::{Lane, Real};
use crate::system::{
    AbsoluteAngles, Cast, CastOde, Ode, RatesOnly, State, TaylorOde, TaylorPendulum,
};

/// Candidates among which [`Advisor::advise`](super::Advisor::advise) chooses.
#[derive(Default)]
pub struct Candidates<'a> {
    pub(super) all: Vec<Box<dyn Candidate + 'a>>,
}

impl<'a> Candidates<'a> {
    /// None yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of candidates.
    #[must_use]
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Returns true if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// A candidate by its index: the order in which they were added.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&(dyn Candidate + 'a)> {
        self.all.get(index).map(Box::as_ref)
    }

    /// Names of the candidates, in the order in which they were added.
    pub fn names(&self) -> impl Iterator<Item = CandidateName> + '_ {
        self.all.iter().map(|candidate| candidate.name())
    }

    /// Adds one that was made by hand.
    #[must_use]
    pub fn with(mut self, candidate: impl Candidate + 'a) -> Self {
        self.all.push(Box::new(candidate));
        self
    }

    /// Adds a system by every method of `form` but Taylor series, in `f64` and in `f32`.
    #[must_use]
    pub fn rates<O>(mut self, form: &ModelForm<'a>, ode: O) -> Self
    where
        O: CastOde<f64, f32> + 'a,
        O::Of: 'a,
    {
        let single = ode.cast(|value: f64| value as f32);
        self.add(form, "f64", Rc::new(ByRates(ode)), false);
        self.add::<f32>(form, "f32", Rc::new(ByRates(single)), false);
        self
    }

    /// Adds a system by every method of `form`, in `f64` and in `f32`.
    #[must_use]
    pub fn series<O>(mut self, form: &ModelForm<'a>, ode: O) -> Self
    where
        O: CastOde<f64, f32> + TaylorOde<f64> + 'a,
        O::Of: TaylorOde<f32> + 'a,
    {
        let single = ode.cast(|value: f64| value as f32);
        self.add(form, "f64", Rc::new(BySeries(ode)), true);
        self.add::<f32>(form, "f32", Rc::new(BySeries(single)), true);
        self
    }

    fn add<T: Real>(
        &mut self,
        form: &ModelForm<'a>,
        scalar: &'static str,
        system: Rc<dyn Samplable<T> + 'a>,
        has_series: bool,
    ) {
        let known = |method: &&Method| has_series || **method != Method::Taylor;
        for &method in form.methods.iter().filter(known) {
            self.all.push(Box::new(Integrated {
                form: form.clone(),
                scalar,
                method,
                system: Rc::clone(&system),
            }));
        }
    }

    /// Adds a model in absolute angles by the explicit pairs of `form` in the lanes of
    /// vector registers, in `f64` and in `f32`: for several starts.
    #[must_use]
    pub fn lanes<P>(mut self, form: &ModelForm<'a>, model: &'a P) -> Self
    where
        P: Cast<f64> + Sync,
        P::Of<f32>: Sync + 'a,
    {
        let single = model.cast(|value| value as f32);
        self.add_lanes(form, "f64", Rc::new(LanesByRates(model)), false);
        self.add_lanes::<f32>(form, "f32", Rc::new(LanesByRates(single)), false);
        self
    }

    /// Adds a model in absolute angles by the explicit pairs of `form` and by Taylor
    /// series in the lanes of vector registers, in `f64`: for several starts.
    #[must_use]
    pub fn lanes_with_series<P>(mut self, form: &ModelForm<'a>, model: &'a P) -> Self
    where
        P: TaylorPendulum<f64> + Sync,
    {
        self.add_lanes(form, "f64", Rc::new(LanesBySeries(model)), true);
        self
    }

    fn add_lanes<T: Lane>(
        &mut self,
        form: &ModelForm<'a>,
        scalar: &'static str,
        system: Rc<dyn LaneSamplable<T> + 'a>,
        has_series: bool,
    ) {
        let known =
            |method: &&Method| method.is_adaptive() && (has_series || **method != Method::Taylor);
        for &method in form.methods.iter().filter(known) {
            self.all.push(Box::new(InLanes {
                form: form.clone(),
                scalar,
                method,
                system: Rc::clone(&system),
            }));
        }
    }
}

impl fmt::Debug for Candidates<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}

/// A system that any method samples.
trait Samplable<T: Real> {
    fn sample(
        &self,
        method: &AnyIntegrator<T>,
        start: &State<T>,
        times: &[T],
        visit: &mut dyn FnMut(&[T]),
    ) -> Result<Solution<T>, IntegrationError<T>>;
}

struct ByRates<O>(O);

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

struct BySeries<O>(O);

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
struct Integrated<'a, T> {
    form: ModelForm<'a>,
    scalar: &'static str,
    method: Method,
    system: Rc<dyn Samplable<T> + 'a>,
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

/// A model that the methods for lanes sample.
trait LaneSamplable<T: Lane> {
    fn sample(
        &self,
        method: Method,
        tolerance: T,
        starts: &[State<T>],
        times: &[T],
    ) -> Vec<Samples<T>>;
}

/// One thread: what is measured is the cost of a core.
fn one_thread() -> Ensemble<'static> {
    Ensemble::new().threads(NonZeroUsize::MIN)
}

/// One of the explicit pairs in lanes.
fn by_pair<T: Lane, P: Cast<T> + Sync>(
    model: &P,
    method: Method,
    tolerance: T,
    starts: &[State<T>],
    times: &[T],
) -> Vec<Samples<T>> {
    let options = Options::with_tolerance(tolerance);
    let ensemble = one_thread();
    let model = &AbsoluteAngles(model);
    match method {
        Method::Dopri5 => ensemble.sample_in_lanes(&Dopri5::new(options), model, starts, times),
        Method::Verner98 => ensemble.sample_in_lanes(&Verner98::new(options), model, starts, times),
        _ => ensemble.sample_in_lanes(&Dop853::new(options), model, starts, times),
    }
}

struct LanesByRates<P>(P);

impl<T: Lane, P: Cast<T> + Sync> LaneSamplable<T> for LanesByRates<P> {
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

struct LanesBySeries<P>(P);

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
                one_thread().sample_in_lanes(&series, &AbsoluteAngles(&self.0), starts, times)
            }
            _ => by_pair(&self.0, method, tolerance, starts, times),
        }
    }
}

/// A model by one method, as many starts at a time as registers have lanes.
struct InLanes<'a, T> {
    form: ModelForm<'a>,
    scalar: &'static str,
    method: Method,
    system: Rc<dyn LaneSamplable<T> + 'a>,
}

impl<T: Lane> Candidate for InLanes<'_, T> {
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
        let model = match self.scalar {
            "f64" => "&model",
            _ => "&model.cast(|value| value as f32)",
        };
        lines.push(format!(
            "Ensemble::new().sample_in_lanes(&method, {model}, &starts, &times);"
        ));
        lines
    }
}

fn of_scalar<T: Real>(values: &[f64]) -> Vec<T> {
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
