//! Candidates made of models and of the methods of this crate.

use std::fmt;
use std::rc::Rc;

use super::candidate::{Candidate, CandidateName};
use super::form::ModelForm;
use super::in_lanes::{IntegratedInLanes, LaneSamplable, LanesByRates, LanesBySeries};
use super::integrated::{ByRates, BySeries, Integrated, Samplable};
use crate::integrate::Method;
use crate::scalar::{Lane, Real};
use crate::system::{AbsoluteAngles, CastOde, LaneOde, TaylorOde, TaylorPendulum};

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

    /// Adds a system by the explicit pairs of `form` in the lanes of vector registers, in
    /// `f64` and in `f32`: for several starts.
    #[must_use]
    pub fn lanes<O>(mut self, form: &ModelForm<'a>, ode: O) -> Self
    where
        O: LaneOde<f64> + CastOde<f64, f32> + Sync + 'a,
        <O as CastOde<f64, f32>>::Of: LaneOde<f32> + Sync + 'a,
    {
        let single = ode.cast(|value: f64| value as f32);
        self.add_lanes(form, "f64", Rc::new(LanesByRates(ode)), false);
        self.add_lanes::<f32>(form, "f32", Rc::new(LanesByRates(single)), false);
        self
    }

    /// Adds a model in absolute angles by the explicit pairs of `form` and by Taylor
    /// series in the lanes of vector registers, in `f64`: for several starts.
    #[must_use]
    pub fn lanes_with_series<P>(mut self, form: &ModelForm<'a>, model: AbsoluteAngles<P>) -> Self
    where
        P: TaylorPendulum<f64> + Sync + 'a,
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
            self.all.push(Box::new(IntegratedInLanes {
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
