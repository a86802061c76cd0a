//! Outputs that must be right, each with its tolerance.

use std::cell::RefCell;
use std::fmt;

use branched_pendulum::system::{Energy, LinkPoint, Positions, Workspace};

/// Writes the values of an output, computed from the time and the state of the scene.
type WriteOutput<'a> = Box<dyn Fn(f64, &[f64], &mut Vec<f64>) + 'a>;

/// An output that must be right: a function of the state, and the largest error of its values.
pub struct Wanted<'a> {
    pub(crate) name: String,
    pub(crate) unit: &'static str,
    pub(crate) tolerance: f64,
    values: WriteOutput<'a>,
}

impl<'a> Wanted<'a> {
    /// Creates an output from the values that `values(time, state, out)` appends to `out`, the same
    /// number for every state. They must be right to within `tolerance`, given in `unit`.
    pub fn new(
        name: impl Into<String>,
        unit: &'static str,
        tolerance: f64,
        values: impl Fn(f64, &[f64], &mut Vec<f64>) + 'a,
    ) -> Self {
        Self {
            name: name.into(),
            unit,
            tolerance,
            values: Box::new(values),
        }
    }

    /// Creates the output of all angles, or other coordinates: the first half of the state.
    pub fn angles(tolerance: f64) -> Self {
        Self::new("angles", "rad", tolerance, |_, state, out| {
            out.extend_from_slice(state.split_at(state.len() / 2).0);
        })
    }

    /// Creates the output of all components of the state.
    pub fn state(tolerance: f64) -> Self {
        Self::new("state", "", tolerance, |_, state, out| {
            out.extend_from_slice(state);
        })
    }

    /// Creates the output of the energy, for a model in absolute angles.
    pub fn energy(model: &'a impl Energy<f64>, tolerance: f64) -> Self {
        let memory = RefCell::new(Workspace::new());
        Self::new("energy", "J", tolerance, move |_, state, out| {
            let (theta, omega) = state.split_at(state.len() / 2);
            let workspace = &mut *memory.borrow_mut();
            let kinetic = model.kinetic_energy_with(workspace, theta, omega);
            out.push(kinetic + model.potential_energy_with(workspace, theta));
        })
    }

    /// Creates the output of the ends of all links on a screen with this number of pixels per
    /// metre, for a model in absolute angles.
    pub fn pixels(model: &'a impl Positions<f64>, per_metre: f64, tolerance: f64) -> Self {
        Self::new("pixels", "px", tolerance, move |_, state, out| {
            let theta = state.split_at(state.len() / 2).0;
            let mut ends = vec![[0.0; 2]; theta.len()];
            model.points_into(LinkPoint::End, theta, &mut ends);
            out.extend(ends.as_flattened().iter().map(|place| per_metre * place));
        })
    }

    pub(crate) fn values(&self, time: f64, state: &[f64], out: &mut Vec<f64>) {
        (self.values)(time, state, out);
    }
}

impl fmt::Debug for Wanted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            name,
            unit,
            tolerance,
            values: _,
        } = self;
        f.debug_struct("Wanted")
            .field("name", name)
            .field("unit", unit)
            .field("tolerance", tolerance)
            .finish_non_exhaustive()
    }
}
