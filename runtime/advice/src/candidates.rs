//! Candidates built from models and the methods of this crate.

use std::fmt;
use std::rc::Rc;

use crate::candidate::{Candidate, CandidateName};
use crate::form::ModelForm;
use crate::integrated::{
    Follow, Following, Integrated, StepCount, VisitModel, in_lanes, in_lanes_by_pair, one_by_one,
};
use branched_pendulum::integrate::{Method, Options, Taylor};
use branched_pendulum::scalar::Real;
use branched_pendulum::system::{AbsoluteAngles, CastOde, RatesOnly, TaylorOde, TaylorPendulum};

/// Candidates among which [`Advisor::advise`](super::Advisor::advise) chooses.
#[derive(Default)]
pub struct Candidates<'a> {
    pub(crate) all: Vec<Box<dyn Candidate + 'a>>,
}

impl<'a> Candidates<'a> {
    /// Creates an empty list.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the number of candidates.
    #[must_use]
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Returns true if the list is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Returns a candidate by its index, in the order in which they were added.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&(dyn Candidate + 'a)> {
        self.all.get(index).map(Box::as_ref)
    }

    /// Returns the names of the candidates, in the order in which they were added.
    pub fn names(&self) -> impl Iterator<Item = CandidateName> + '_ {
        self.all.iter().map(|candidate| candidate.name())
    }

    /// Adds a candidate implemented by the caller.
    #[must_use]
    pub fn with(mut self, candidate: impl Candidate + 'a) -> Self {
        self.all.push(Box::new(candidate));
        self
    }

    /// Adds a system of first-order equations, as one candidate for each method of `form` except
    /// Taylor series, in `f64` and in `f32`.
    #[must_use]
    pub fn rates<O>(self, form: &ModelForm<'a>, ode: O) -> Self
    where
        O: CastOde<f64> + 'a,
        O::Of<f32>: 'a,
    {
        let single = ode.cast(|value: f64| value as f32);
        let known = |method: Method| method != Method::Taylor;
        self.integrated::<f64>(form, "f64", known, false, move |following, visit| {
            one_by_one(&RatesOnly(&ode), following, visit)
        })
        .integrated::<f32>(form, "f32", known, false, move |following, visit| {
            one_by_one(&RatesOnly(&single), following, visit)
        })
    }

    /// Adds a system with Taylor coefficients, as one candidate for each method of `form`, in `f64`
    /// and in `f32`.
    #[must_use]
    pub fn series<O>(self, form: &ModelForm<'a>, ode: O) -> Self
    where
        O: CastOde<f64> + TaylorOde<f64> + 'a,
        O::Of<f32>: TaylorOde<f32> + 'a,
    {
        let single = ode.cast(|value: f64| value as f32);
        self.integrated::<f64>(
            form,
            "f64",
            |_| true,
            false,
            move |following, visit| one_by_one(&ode, following, visit),
        )
        .integrated::<f32>(
            form,
            "f32",
            |_| true,
            false,
            move |following, visit| one_by_one(&single, following, visit),
        )
    }

    /// Adds a system that integrates several starts at once in vector registers, as one candidate
    /// for each explicit pair of `form`, in `f64` and in `f32`.
    #[must_use]
    pub fn lanes<O>(self, form: &ModelForm<'a>, ode: O) -> Self
    where
        O: CastOde<f64> + Sync + 'a,
        O::Of<f32>: CastOde<f32> + Sync + 'a,
    {
        let single = ode.cast(|value: f64| value as f32);
        let known = |method: Method| method.is_adaptive() && method != Method::Taylor;
        self.integrated::<f64>(form, "f64", known, true, move |following, visit| {
            in_lanes_by_pair(&ode, following, visit)
        })
        .integrated::<f32>(form, "f32", known, true, move |following, visit| {
            in_lanes_by_pair(&single, following, visit)
        })
    }

    /// Adds a model in absolute angles that integrates several starts at once in vector registers,
    /// as one candidate for each explicit pair of `form` and for Taylor series, in `f64`.
    #[must_use]
    pub fn lanes_with_series<P>(self, form: &ModelForm<'a>, model: AbsoluteAngles<P>) -> Self
    where
        P: TaylorPendulum<f64> + Sync + 'a,
    {
        self.integrated::<f64>(
            form,
            "f64",
            Method::is_adaptive,
            true,
            move |following, visit| match following.method {
                Method::Taylor => {
                    let series = Taylor::new(Options::with_tolerance(following.setting));
                    in_lanes(&series, &model, following, visit)
                }
                _ => in_lanes_by_pair(&model, following, visit),
            },
        )
    }

    /// Adds a candidate for each method of `form` that `follow` supports.
    fn integrated<T: Real>(
        mut self,
        form: &ModelForm<'a>,
        scalar: &'static str,
        is_known: impl Fn(Method) -> bool,
        in_lanes: bool,
        follow: impl Fn(&Following<'_, T>, &mut VisitModel<'_, T>) -> StepCount + 'a,
    ) -> Self {
        let follow: Rc<Follow<'a, T>> = Rc::new(follow);
        for &method in form.methods.iter().filter(|&&method| is_known(method)) {
            self.all.push(Box::new(Integrated {
                form: form.clone(),
                scalar,
                method,
                in_lanes,
                follow: Rc::clone(&follow),
            }));
        }
        self
    }
}

impl fmt::Debug for Candidates<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}
