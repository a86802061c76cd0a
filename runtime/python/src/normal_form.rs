//! Resonant normal forms: `Tree.normal_form`.

use branched_pendulum::analysis::normal_form::{NormalFormOptions, Prediction, Refusal};
use branched_pendulum::system::State;
use branched_pendulum_trees::TreeNormalForm;
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::named;
use crate::arrays::{Numbers, Row, by_state, whole};
use crate::growth::copies;
use crate::interrupts::on_own_thread;
use crate::motions::Motions;
use crate::results::result;
use crate::tree::Tree;

#[pymethods]
impl Tree {
    /// Derives the normal form of the motion in which all copies are in phase, with a small
    /// difference between two links, about the equilibrium nearest to zero angles.
    ///
    /// Friction and drive are neglected. Nothing is simulated: the Hamiltonian is expanded and
    /// normalised.
    ///
    /// Parameters
    /// ----------
    /// pair : two names
    ///     Links that are copies of each other.
    /// degree : int
    ///     Degree of the Hamiltonian: 4, 6, 8, 10 or 12. The results for the degree below are their
    ///     error.
    /// bound : float
    ///     Largest mismatch at which resonances of order 4 are kept, relative to the lowest frequency
    ///     of a difference.
    ///
    /// Returns
    /// -------
    /// NormalForm
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree(bp.examples.PAPER, friction=0)
    /// >>> form = tree.normal_form(["child_1", "child_2"])
    /// >>> form.resonances
    /// ['f_1 + f_2 = 2 d_1']
    /// >>> release = np.radians([30, 19, 19])
    /// >>> float(form.growth_rate([*release, 0, 0, 0]).round(4))
    /// 0.0693
    #[pyo3(signature = (pair, degree = 8, bound = 0.15))]
    fn normal_form(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named::pair)] pair: Vec<String>,
        #[pyo3(from_py_with = named::degree)] degree: i128,
        #[pyo3(from_py_with = named::bound)] bound: f64,
    ) -> PyResult<PyNormalForm> {
        let system = self.system();
        let copies = copies(system, &[pair], &[])?;
        let (tree, dimension) = (system.0.clone(), Motions::dimension(system));
        let options = NormalFormOptions {
            degree: whole("degree", degree, 4)?,
            bound,
            ..NormalFormOptions::default()
        };
        let form = on_own_thread(py, move || {
            let form = tree.normal_form(&copies, options);
            form.map_err(|error| error.to_string())
        })?;
        Ok(PyNormalForm {
            dimension,
            form: form.map_err(PyValueError::new_err)?,
        })
    }
}

/// The resonant normal form of a tree next to the motion of its copies in phase; made by
/// `Tree.normal_form`.
#[pyclass(frozen, name = "NormalForm", module = "branched_pendulum")]
pub(crate) struct PyNormalForm {
    form: TreeNormalForm,
    dimension: usize,
}

impl PyNormalForm {
    fn refused(refusal: &Refusal) -> PyErr {
        PyValueError::new_err(refusal.to_string())
    }

    fn predicted(&self, state: &[f64]) -> Result<Prediction, Refusal> {
        self.form.predict(&State::new(0.0, state.to_vec()))
    }
}

#[pymethods]
impl PyNormalForm {
    /// Frequencies (Hz) of small motions in phase, and then of the differences.
    #[getter]
    fn linear_frequencies<'py>(&self, py: Python<'py>) -> Row<'py> {
        self.form.form().linear_frequencies_hz().into_pyarray(py)
    }

    /// Resonances whose terms are kept, as equations between the frequencies.
    #[getter]
    fn resonances(&self) -> Vec<String> {
        let all = self.form.form().resonances().iter();
        all.map(ToString::to_string).collect()
    }

    /// Returns the actions (J s) of the modes in phase through a state of shape (2 n,).
    fn actions<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Row<'py>> {
        let state = State::new(0.0, y.row("y", self.dimension)?);
        let actions = self.form.actions(&state);
        let actions: Vec<f64> = actions.iter().map(|own| own.value).collect();
        Ok(actions.into_pyarray(py))
    }

    /// Returns the frequencies (Hz) of the modes in phase with these actions (J s), one for each
    /// mode.
    fn frequencies<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::actions)] actions: Numbers<'py>,
    ) -> PyResult<Row<'py>> {
        let form = self.form.form();
        let frequencies = form.frequencies_hz(&actions.row("actions", form.in_phase())?);
        let frequencies: Vec<f64> = frequencies.iter().map(|own| own.value).collect();
        Ok(frequencies.into_pyarray(py))
    }

    /// Predicts the frequencies of the motion from a state of shape (2 n,), and the growth of the
    /// difference.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     The series gives no answer at this state; the message has the reason.
    fn predict<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let state = y.row("y", self.dimension)?;
        let own = self.predicted(&state).map_err(|own| Self::refused(&own))?;
        let all = [&own.frequencies_hz, &own.difference_frequencies_hz];
        let [frequencies, differences] = all.map(|all| {
            let values: Vec<f64> = all.iter().map(|one| one.value).collect();
            let errors: Vec<f64> = all.iter().map(|one| one.error()).collect();
            [values, errors].map(|own| own.into_pyarray(py).into_any())
        });
        let ([frequencies, errors], [differences, difference_errors]) = (frequencies, differences);
        let number = |value: f64| value.into_pyobject(py).map(Bound::into_any);
        let fields = [
            ("frequencies", frequencies),
            ("frequency_errors", errors),
            ("difference_frequencies", differences),
            ("difference_errors", difference_errors),
            ("growth_rate", number(own.growth_rate.value)?),
            ("growth_error", number(own.growth_rate.error())?),
            (
                "resonance",
                own.resonance.map(|own| own.to_string()).into_pyobject(py)?,
            ),
        ];
        result(py, "Prediction", &fields)
    }

    /// Returns the growth rates (1/s) of the difference along the motions from these states, of
    /// shape (…, 2 n): 0 where it does not grow, NaN where the series gives no answer.
    fn growth_rate<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        by_state(py, &y, self.dimension, |state| {
            [match self.predicted(state) {
                Ok(prediction) => prediction.growth_rate.value,
                Err(_) => f64::NAN,
            }]
        })
    }
}
