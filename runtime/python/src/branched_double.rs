//! The class `BranchedDouble`: the compiled model of the paper.

use std::borrow::Cow;
use std::sync::Arc;

use branched_pendulum::ensemble::{Ensemble, Samples};
use branched_pendulum::integrate::Taylor;
use branched_pendulum::system::{AbsoluteAngles, RatesOnly};
use branched_pendulum::{Transfer, TransferForms};
use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::named;
use crate::arrays::{Numbers, by_state};
use crate::estimates::Coordinates;
use crate::measured_model::{MeasuredModel, Releases};
use crate::pendulum::Pendulum;
use paper::Paper;

/// The paper's scene as committed emitted code; it is a link to one file, which the repository
/// checks to be up to date.
#[allow(dead_code, missing_docs, clippy::wrong_self_convention)]
#[rustfmt::skip]
#[path = "paper.rs"]
mod paper;

/// Number of links; a state has twice as many numbers.
const LINKS: usize = Paper::LINKS;

/// Forms of the energy transfer W that the model can compute.
const FORMS: &[branched_pendulum::TransferForm] = <Paper as TransferForms<f64>>::TRANSFER_FORMS;

/// The paper's branched double pendulum as a compiled model: a parent with two equal children,
/// `parent`, `child_1`, `child_2`, of the published masses (kg), lengths (m) and moments of
/// inertia (kg m²).
///
/// In addition to motions, it computes the energy of the antiphase mode and the energy transfer W
/// into that mode in every form (`FORMS`).
#[pyclass(frozen, extends = Pendulum, module = "branched_pendulum.models")]
pub(crate) struct BranchedDouble {
    model: Paper,
}

impl MeasuredModel for Paper {
    type Series<'a> = RatesOnly<&'a AbsoluteAngles<Self>>;

    fn series(system: &AbsoluteAngles<Self>) -> Self::Series<'_> {
        RatesOnly(system)
    }

    fn mass_rows(&self, theta: &[f64]) -> Vec<Vec<f64>> {
        let rows = |theta: &[f64; LINKS]| self.mass_matrix(theta).map(Vec::from).to_vec();
        theta.try_into().map(rows).unwrap_or_default()
    }

    fn as_tree(&self) -> Result<Cow<'_, PendulumTree>, TreeError> {
        let description = TreeDescription::parse(include_str!("trees/paper.txt"))?;
        Ok(Cow::Owned(description.tree(&[("friction", 0.0)])?))
    }

    fn with_values(&self, values: &[(&str, f64)]) -> Result<Self, String> {
        match values {
            [] => Ok(*self),
            _ => Err("parameters: a compiled model has none, a Tree has them".to_owned()),
        }
    }

    fn series_ensemble(
        _: &Taylor<f64>,
        _: Releases<'_, Self>,
        _: &Ensemble<'_>,
        _: &[f64],
    ) -> Option<Vec<Samples<f64>>> {
        None
    }

    fn link_parents(&self) -> Vec<Option<usize>> {
        vec![None, Some(0), Some(0)]
    }

    fn smoothed_coordinates(&self) -> Coordinates {
        let unit = |column: usize| -> [f64; LINKS] {
            std::array::from_fn(|link| f64::from(u8::from(link == column)))
        };
        let rows = |of: &dyn Fn(&[f64; LINKS]) -> [f64; LINKS]| -> Vec<Vec<f64>> {
            let columns: [[f64; LINKS]; LINKS] = std::array::from_fn(|column| of(&unit(column)));
            let row = |row: usize| columns.iter().map(|column| column[row]).collect();
            (0..LINKS).map(row).collect()
        };
        Coordinates {
            of_links: rows(&|angles| self.to_symmetric(angles)),
            links: rows(&|coordinates| self.from_symmetric(coordinates)),
        }
    }
}

fn halves(state: &[f64]) -> Option<[&[f64; LINKS]; 2]> {
    let (theta, omega) = state.split_at_checked(LINKS)?;
    Some([theta.try_into().ok()?, omega.try_into().ok()?])
}

impl BranchedDouble {
    /// Returns the symmetric coordinates (rad) and their momenta (kg m²/s) of a state.
    fn canonical(&self, state: &[f64]) -> [[f64; LINKS]; 2] {
        let Some([theta, omega]) = halves(state) else {
            return [[f64::NAN; LINKS]; 2];
        };
        let coordinates = self.model.to_symmetric(theta);
        let rates = self.model.to_symmetric(omega);
        [
            coordinates,
            self.model.symmetric_momenta(&coordinates, &rates),
        ]
    }

    fn transfer_by(&self, form: usize, state: &[f64]) -> Transfer<f64> {
        let [coordinates, momenta] = self.canonical(state);
        let mut transfers = [Transfer::default()];
        self.model
            .transfers_into(form, &coordinates, &momenta, &mut transfers);
        let [transfer] = transfers;
        transfer
    }
}

/// Returns the index of a form of W, given its name.
fn form(name: &str) -> PyResult<usize> {
    let names: Vec<String> = FORMS.iter().map(ToString::to_string).collect();
    let found = names.iter().position(|own| own == name);
    found.ok_or_else(|| {
        let names = names.join("`, `");
        PyValueError::new_err(format!(
            "form: there is no form `{name}` of W: there are `{names}`"
        ))
    })
}

#[pymethods]
impl BranchedDouble {
    #[new]
    fn new() -> PyClassInitializer<Self> {
        let model = Paper::new();
        let motions = Arc::new(AbsoluteAngles(model));
        PyClassInitializer::from(Pendulum { motions }).add_subclass(Self { model })
    }

    /// Names of the forms of the energy transfer W.
    #[classattr]
    #[pyo3(name = "FORMS")]
    fn forms() -> Vec<String> {
        FORMS.iter().map(ToString::to_string).collect()
    }

    /// Returns the symmetric coordinates of states and their momenta.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 6)
    ///     States.
    ///
    /// Returns
    /// -------
    /// array, shape (..., 6)
    ///     θ of the parent, mean and half the difference of the children (rad), then p of each
    ///     (kg m²/s).
    ///
    /// Examples
    /// --------
    /// >>> paper = bp.models.BranchedDouble()
    /// >>> paper.canonical_variables([0.5, 0.3, 0.1, 0, 0, 0])[:3].round(12)
    /// array([0.5, 0.2, 0.1])
    fn canonical_variables<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        by_state(py, &y, 2 * LINKS, |state| {
            let [[a, b, c], [p, q, r]] = self.canonical(state);
            [a, b, c, p, q, r]
        })
    }

    /// Returns the energy H_d of the antiphase mode, in which the children move against each other.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 6)
    ///     States.
    ///
    /// Returns
    /// -------
    /// array, shape (...), or float
    ///     Energies, J.
    ///
    /// Examples
    /// --------
    /// >>> paper = bp.models.BranchedDouble()
    /// >>> float(paper.antiphase_energy([0.5, 0.2, 0.2, 0, 0, 0]))
    /// 0.0
    fn antiphase_energy<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        by_state(py, &y, 2 * LINKS, |state| {
            let [coordinates, momenta] = self.canonical(state);
            [self.model.antiphase_energy(&coordinates, &momenta)]
        })
    }

    /// Returns the energy transfer W into the antiphase mode.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 6)
    ///     States.
    /// form : str
    ///     One of `FORMS`: "angle order 1" is the published one, "exact" leaves nothing out.
    ///
    /// Returns
    /// -------
    /// array, shape (...), or float
    ///     W, in W.
    ///
    /// Examples
    /// --------
    /// >>> paper = bp.models.BranchedDouble()
    /// >>> y = [0.5, 0.2, 0.1, 1.0, -2.0, -1.5]
    /// >>> [float(paper.transfer(y, form).round(6)) for form in ("exact", "angle order 1")]
    /// [-0.000139, 3e-05]
    #[pyo3(signature = (y, form = "exact"))]
    fn transfer<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::form)] form: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let form = self::form(form)?;
        by_state(py, &y, 2 * LINKS, |state| {
            [self.transfer_by(form, state).total()]
        })
    }

    /// Returns the parts W_K and W_P of the energy transfer W into the antiphase mode.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 6)
    ///     States.
    /// form : str
    ///     One of `FORMS`.
    ///
    /// Returns
    /// -------
    /// array, shape (..., 2)
    ///     W_K and W_P, in W: from the kinetic and from the potential energy of the rest.
    ///
    /// Examples
    /// --------
    /// >>> paper = bp.models.BranchedDouble()
    /// >>> y = [0.5, 0.2, 0.1, 1.0, -2.0, -1.5]
    /// >>> bool(np.isclose(paper.transfer_parts(y).sum(), paper.transfer(y)))
    /// True
    #[pyo3(signature = (y, form = "exact"))]
    fn transfer_parts<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::form)] form: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let form = self::form(form)?;
        by_state(py, &y, 2 * LINKS, |state| {
            let Transfer { kinetic, potential } = self.transfer_by(form, state);
            [kinetic, potential]
        })
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok()
    }

    fn __hash__(&self) -> u64 {
        LINKS as u64
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let class = py.get_type::<Self>();
        Ok((class, ()).into_pyobject(py)?.into_any())
    }

    fn __repr__(&self) -> String {
        "BranchedDouble()".to_owned()
    }
}
