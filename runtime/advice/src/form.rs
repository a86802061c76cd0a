//! Form of a model as a candidate: its name, its methods, and the map between its states and those
//! of the scene.

use std::fmt;
use std::rc::Rc;

use branched_pendulum::integrate::{GaussOrder, Method};
use branched_pendulum::scalar::Real;
use branched_pendulum::system::{DifferencePatterns, State, WholeTree};

/// Maps a state of the scene to a state of the model, or back.
type StateMap<'a> = Rc<dyn Fn(&[f64]) -> Vec<f64> + 'a>;

/// Name of a model, the text that a user writes for it, and the map between its states and those of
/// the scene.
#[derive(Clone)]
pub struct ModelForm<'a> {
    pub(crate) name: String,
    pub(crate) system: String,
    /// Entries of the attribute; `None` for a model without an attribute.
    entries: Option<Vec<String>>,
    pub(crate) methods: Vec<Method>,
    enter: Option<StateMap<'a>>,
    leave: Option<StateMap<'a>>,
}

impl<'a> ModelForm<'a> {
    /// Creates a model whose states are those of the scene, with all methods except low-order ones
    /// that others always beat.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            system: String::from("AbsoluteAngles(&model)"),
            entries: Some(Vec::new()),
            methods: vec![
                Method::Dop853,
                Method::Verner98,
                Method::Taylor,
                Method::Dopri5,
                Method::Rk4,
                Method::Gauss(GaussOrder::Four),
                Method::Gauss(GaussOrder::Six),
                Method::Gauss(GaussOrder::Eight),
                Method::Animation,
            ],
            enter: None,
            leave: None,
        }
    }

    /// Marks the model as read at run time; it then has no attribute.
    #[must_use]
    pub fn read_at_run_time(mut self) -> Self {
        self.entries = None;
        self
    }

    /// Adds an entry of the attribute that distinguishes this model.
    #[must_use]
    pub fn entry(mut self, entry: impl Into<String>) -> Self {
        if let Some(entries) = &mut self.entries {
            entries.push(entry.into());
        }
        self
    }

    /// Sets the Rust expression of the system: `AbsoluteAngles(&model)` by default.
    #[must_use]
    pub fn system(mut self, system: impl Into<String>) -> Self {
        self.system = system.into();
        self
    }

    /// Restricts the methods to these.
    #[must_use]
    pub fn methods(mut self, methods: &[Method]) -> Self {
        self.methods = methods.to_vec();
        self
    }

    /// Sets the maps from states of the scene to states of the model, and back.
    #[must_use]
    pub fn through(
        mut self,
        enter: impl Fn(&[f64]) -> Vec<f64> + 'a,
        leave: impl Fn(&[f64]) -> Vec<f64> + 'a,
    ) -> Self {
        self.enter = Some(Rc::new(enter));
        self.leave = Some(Rc::new(leave));
        self
    }

    /// Marks the model as a reduction of the scene: identical branches that move in phase, or
    /// locked joints. A start is mapped to the mean of the links that move identically, and the
    /// state of the model to all of them; differences between such links appear as errors.
    #[must_use]
    pub fn reduced(self, whole: WholeTree) -> Self {
        let mut links = Vec::new();
        whole.for_each(|link, angle| links.push((link, angle)));
        let count = links.iter().map(|&(link, _)| link + 1).max().unwrap_or(0);
        let back = links.clone();
        self.through(
            move |state| {
                let mut own = vec![0.0; 2 * count];
                let mut copies = vec![0.0_f64; count];
                let (theta, omega) = state.split_at(state.len() / 2);
                for ((theta, omega), &(link, angle)) in theta.iter().zip(omega).zip(&links) {
                    own[link] += theta - angle;
                    own[count + link] += omega;
                    copies[link] += 1.0;
                }
                for (index, value) in own.iter_mut().enumerate() {
                    *value /= copies[index % count];
                }
                own
            },
            move |own| {
                let at = |index: usize| own.get(index).copied().unwrap_or(f64::NAN);
                let angles = back.iter().map(|&(link, angle)| at(link) + angle);
                let rates = back.iter().map(|&(link, _)| at(count + link));
                angles.chain(rates).collect()
            },
        )
    }

    /// Marks the model as one in which small differences act back on the in-phase motion
    /// ([`SmallOde`](type@branched_pendulum::system::SmallOde)). A start is mapped to means and to
    /// differences of these patterns; other differences appear as errors.
    #[must_use]
    pub fn nearly_in_phase(self, patterns: DifferencePatterns) -> Self {
        let back = patterns.clone();
        self.system("SmallOde(&model)").through(
            move |state| patterns.to_small(state),
            move |own| back.to_whole(own),
        )
    }

    /// Sets the order of the links of the model (or of the whole tree of a reduced model), if it
    /// differs from that of the scene: trees built in loops by a rule are ordered generation by
    /// generation, others branch by branch. `places` has, for each link of the scene, its index in
    /// the model; [`link_name`](branched_pendulum::Model::link_name) identifies links.
    #[must_use]
    pub fn ordered(mut self, places: &[usize]) -> Self {
        let mut back = vec![usize::MAX; places.len()];
        for (link, &place) in places.iter().enumerate() {
            if let Some(back) = back.get_mut(place) {
                *back = link;
            }
        }
        let (enter, leave) = (self.enter.take(), self.leave.take());
        let places = places.to_vec();
        self.through(
            move |state| {
                let own = reordered(state, &back);
                enter.as_ref().map_or(own.clone(), |enter| enter(&own))
            },
            move |own| {
                let whole = leave.as_ref().map(|leave| leave(own));
                reordered(whole.as_deref().unwrap_or(own), &places)
            },
        )
    }
}

/// Returns angles and rates in the order of `places`.
fn reordered(state: &[f64], places: &[usize]) -> Vec<f64> {
    let links = places.len();
    let at = |index: usize| state.get(index).copied().unwrap_or(f64::NAN);
    let halves = [0, links].into_iter();
    halves
        .flat_map(|half| places.iter().map(move |place| at(half + place)))
        .collect()
}

/// Converts numbers to another scalar.
pub(crate) fn of_scalar<T: Real>(values: &[f64]) -> Vec<T> {
    values.iter().map(|&value| T::from_f64(value)).collect()
}

impl ModelForm<'_> {
    /// Maps a start of the scene to a start of the model.
    pub(crate) fn entered<T: Real>(&self, start: &State<f64>) -> State<T> {
        let own = self.enter.as_ref().map(|enter| enter(&start.values));
        let values = own.as_deref().unwrap_or(&start.values);
        State::new(T::from_f64(start.time), of_scalar(values))
    }

    /// Maps a state of the model to a state of the scene, and passes it to `visit`.
    pub(crate) fn left(&self, values: &[f64], visit: &mut dyn FnMut(&[f64])) {
        match &self.leave {
            Some(leave) => visit(&leave(values)),
            None => visit(values),
        }
    }

    /// Returns the text of the attribute, if the model has one.
    pub(crate) fn attribute(&self) -> Option<String> {
        let entries = self.entries.as_ref()?.join(", ");
        (!entries.is_empty()).then(|| format!("#[branched_pendulum(…, {entries})]"))
    }
}

impl fmt::Debug for ModelForm<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            name,
            system,
            entries,
            methods,
            enter: _,
            leave: _,
        } = self;
        f.debug_struct("ModelForm")
            .field("name", name)
            .field("system", system)
            .field("entries", entries)
            .field("methods", methods)
            .finish_non_exhaustive()
    }
}
