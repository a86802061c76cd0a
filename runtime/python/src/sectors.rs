//! Sectors (copies in phase, and differences between copies): energies, and transfers W between
//! them.

use branched_pendulum::Transfer;
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{
    EnergyDefinition, NonConservative, Order, SectorBudget, StateInput, SymmetricTree,
};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use crate::arguments::named;
use crate::arrays::{Argument, Numbers, ONE_EACH, Together};
use crate::results;
use crate::tree::Tree;

/// A form of the energy transfer W, selected by name.
#[derive(Clone, Copy)]
enum Form {
    Exact,
    Growth,
    Forcing,
    Through(Order, usize),
}

/// Highest order of a form.
const HIGHEST: usize = 15;

impl Form {
    fn of(name: &str) -> PyResult<Self> {
        let order = |prefix: &str| {
            let order: usize = name.strip_prefix(prefix)?.parse().ok()?;
            (1..=HIGHEST).contains(&order).then_some(order)
        };
        match name {
            "exact" => return Ok(Self::Exact),
            "growth" => return Ok(Self::Growth),
            "forcing" => return Ok(Self::Forcing),
            _ => {}
        }
        let of = |counted, prefix: &str| Some(Self::Through(counted, order(prefix)?));
        let found = of(Order::Angle, "angle order ");
        found
            .or_else(|| of(Order::Amplitude, "amplitude order "))
            .ok_or_else(|| {
                PyValueError::new_err(format!(
                    "form is {name:?}, must be \"exact\", \"growth\", \"forcing\", \"angle order \
                     k\" or \"amplitude order k\", k from 1 to {HIGHEST}"
                ))
            })
    }
}

/// Converts a state (angles, then angular velocities) to the form that evaluations take.
pub(crate) fn given(state: &[f64]) -> StateInput<'_, f64> {
    let (theta, omega) = state.split_at(state.len() / 2);
    StateInput::Absolute { theta, omega }
}

/// Function that computes the energy transfers into all sectors at a state.
type Transfers<'a> = Box<dyn FnMut(&[f64], &mut [Transfer<f64>]) + Send + 'a>;

fn through<const N: usize>(
    tree: &SymmetricTree<f64>,
    counted: Order,
    order: usize,
) -> Transfers<'_> {
    let mut expansion = tree.expansion::<N>(&[]);
    let mut workspace = Workspace::new();
    let mut numbers = [vec![0.0; tree.links()], vec![0.0; tree.links()]];
    Box::new(move |state, transfers| {
        let [coordinates, momenta] = &mut numbers;
        tree.coordinates(&mut workspace, given(state), coordinates);
        tree.momenta(&mut workspace, given(state), momenta);
        expansion.transfers(counted, order, [coordinates, momenta], transfers);
    })
}

fn transfers(tree: &SymmetricTree<f64>, form: Form) -> Transfers<'_> {
    let mut workspace = Workspace::new();
    match form {
        Form::Exact => Box::new(move |state, transfers| {
            tree.exact_transfers(&mut workspace, given(state), transfers);
        }),
        Form::Growth => Box::new(move |state, transfers| {
            tree.growth(&mut workspace, given(state), transfers);
        }),
        Form::Forcing => Box::new(move |state, transfers| {
            tree.forcing(&mut workspace, given(state), transfers);
        }),
        Form::Through(counted, order) => match order {
            ..=2 => through::<3>(tree, counted, order),
            3..=4 => through::<5>(tree, counted, order),
            5..=8 => through::<9>(tree, counted, order),
            _ => through::<16>(tree, counted, order),
        },
    }
}

impl Tree {
    /// Returns the index of a sector, given its name (`None` if all sectors are requested), after
    /// checking that it exists.
    fn sector(&self, tree: &SymmetricTree<f64>, name: Option<&str>) -> PyResult<Option<usize>> {
        let Some(name) = name else { return Ok(None) };
        tree.sector(name).map(Some).ok_or_else(|| {
            let names = tree.sectors().iter().map(|sector| sector.name());
            let names = names.collect::<Vec<_>>().join(", ");
            PyKeyError::new_err(format!("there is no sector `{name}`: there are {names}"))
        })
    }

    /// Computes results for each state, for all sectors or for a single one.
    fn by_sector<'py>(
        &self,
        py: Python<'py>,
        y: &Numbers<'py>,
        sector: Option<&str>,
        width: usize,
        mut of: impl FnMut(&[f64], &mut [f64]) + Send,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tree = self.symmetric(py)?;
        let (count, chosen) = (tree.sectors().len(), self.sector(tree, sector)?);
        let together = Together::of(&[("y", y, 2 * tree.links())])?;
        let mut all = vec![0.0; count * width];
        let mut shape = match chosen {
            None => vec![count],
            Some(_) => Vec::new(),
        };
        if width > 1 {
            shape.push(width);
        }
        together.each(py, &shape, |given, out| {
            of(given[0], &mut all);
            let from = width * chosen.unwrap_or(0);
            out.copy_from_slice(&all[from..from + out.len()]);
        })
    }
}

#[pymethods]
impl Tree {
    /// Names of the sectors: first the sector of the means, then the differences between copies.
    #[getter]
    fn sectors(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let sectors = self.symmetric(py)?.sectors().iter();
        Ok(sectors.map(|sector| sector.name().to_owned()).collect())
    }

    /// Returns the energy of each sector by itself; for the antiphase mode it is the paper's H_d.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 2 n)
    ///     States.
    /// sector : str
    ///     One of `sectors`; all, if none is named.
    ///
    /// Returns
    /// -------
    /// array, shape (..., s), or (...) of one sector
    ///     Energies (J), kinetic by the sector's momenta, and potential.
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree(bp.examples.PAPER, friction=0)
    /// >>> tree.sectors
    /// ['in_phase', 'd']
    /// >>> float(tree.sector_energies([0.5, 0.2, 0.2, 0, 0, 0], "d"))
    /// 0.0
    #[pyo3(signature = (y, sector = None))]
    fn sector_energies<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::sector)] sector: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tree = self.symmetric(py)?;
        let (mut workspace, mut both) = (Workspace::new(), vec![[0.0; 2]; tree.sectors().len()]);
        self.by_sector(py, &y, sector, 1, |state, out| {
            tree.energies(&mut workspace, given(state), &mut both);
            for (out, [kinetic, potential]) in out.iter_mut().zip(&both) {
                *out = kinetic + potential;
            }
        })
    }

    /// Returns the energy transfers W into sectors.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 2 n)
    ///     States of a tree with copies.
    /// form : str
    ///     "exact" leaves nothing out: it is dE/dt of the sector without friction and drive;
    ///     "angle order 1" is the published form, "amplitude order 2" and so on are truncated in
    ///     the amplitude of all differences, orders up to 15. Of copies that differ, `each(...)`,
    ///     "growth" is what the tree of equal copies gives and "forcing" what their differences
    ///     add.
    /// into : str
    ///     One of `sectors`; all, if none is named.
    ///
    /// Returns
    /// -------
    /// array, shape (..., s), or (...) of one sector
    ///     Transfers, W.
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree(bp.examples.PAPER, friction=0)
    /// >>> y = [0.5, 0.2, 0.1, 1.0, -2.0, -1.5]
    /// >>> float(tree.transfer(y, into="d").round(6)) == float(
    /// ...     bp.models.BranchedDouble().transfer(y).round(6))
    /// True
    #[pyo3(signature = (y, form = "exact", into = None))]
    fn transfer<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::form)] form: &str,
        #[pyo3(from_py_with = named::into)] into: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tree = self.symmetric(py)?;
        let mut of = transfers(tree, Form::of(form)?);
        let mut all = vec![Transfer::default(); tree.sectors().len()];
        self.by_sector(py, &y, into, 1, |state, out| {
            of(state, &mut all);
            for (out, transfer) in out.iter_mut().zip(&all) {
                *out = transfer.total();
            }
        })
    }

    /// Returns the parts W_K and W_P of the energy transfers into sectors.
    ///
    /// Parameters
    /// ----------
    /// y, form, into
    ///     As those of `transfer`.
    ///
    /// Returns
    /// -------
    /// array, shape (..., s, 2), or (..., 2) of one sector
    ///     W_K and W_P, in W: from the kinetic and from the potential energy of the rest.
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree(bp.examples.PAPER, friction=0)
    /// >>> y = [0.5, 0.2, 0.1, 1.0, -2.0, -1.5]
    /// >>> bool(np.isclose(tree.transfer_parts(y, into="d").sum(), tree.transfer(y, into="d")))
    /// True
    #[pyo3(signature = (y, form = "exact", into = None))]
    fn transfer_parts<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::form)] form: &str,
        #[pyo3(from_py_with = named::into)] into: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tree = self.symmetric(py)?;
        let mut of = transfers(tree, Form::of(form)?);
        let mut all = vec![Transfer::default(); tree.sectors().len()];
        self.by_sector(py, &y, into, 2, |state, out| {
            of(state, &mut all);
            for (out, transfer) in out.chunks_exact_mut(2).zip(&all) {
                out.copy_from_slice(&[transfer.kinetic, transfer.potential]);
            }
        })
    }

    /// Returns energies of sectors, energy transfers from other sectors, and powers of friction and
    /// drive: dE/dt = transfer + power.
    ///
    /// Parameters
    /// ----------
    /// y : array, shape (..., 2 n)
    ///     States of a tree with copies.
    /// t : float or array, shape (...)
    ///     Times of the drive, s.
    /// definition : {"canonical", "rest", "parseval", "velocity"}
    ///     Kinetic energy of a sector: from its momenta and the mass matrix at the configuration
    ///     (H_d) or at rest, from the centres of mass by Parseval (energies then sum to K + U), or
    ///     from its velocities.
    ///
    /// Returns
    /// -------
    /// SectorBudget
    ///
    /// Examples
    /// --------
    /// >>> tree = bp.Tree(bp.examples.PAPER, friction=1e-4)
    /// >>> y = [0.5, 0.2, 0.1, 1.0, -2.0, -1.5]
    /// >>> budget = tree.sector_budget(y, definition="parseval")
    /// >>> bool(np.isclose(budget.energies.sum(), tree.energy(y)))
    /// True
    #[pyo3(signature = (y, t = None, definition = "canonical"))]
    fn sector_budget<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named::y)] y: Numbers<'py>,
        #[pyo3(from_py_with = named::t)] t: Option<Numbers<'py>>,
        #[pyo3(from_py_with = named::definition)] definition: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let definition = match definition {
            "canonical" => EnergyDefinition::Canonical,
            "rest" => EnergyDefinition::Rest,
            "parseval" => EnergyDefinition::Parseval,
            "velocity" => EnergyDefinition::Velocity,
            _ => {
                return Err(PyValueError::new_err(format!(
                    "definition is {definition:?}, must be \"canonical\", \"rest\", \"parseval\" \
                     or \"velocity\""
                )));
            }
        };
        let (tree, pendulum) = (self.symmetric(py)?, self.tree());
        let count = tree.sectors().len();
        let mut arguments: Vec<Argument<'_, '_>> = vec![("y", &y, 2 * tree.links())];
        arguments.extend(t.as_ref().map(|times| ("t", times, ONE_EACH)));
        let together = Together::of(&arguments)?;
        let (mut workspace, mut budget) = (Workspace::new(), SectorBudget::new());
        let all = together.each(py, &[3, count], |values, out| {
            let time = values.get(1).map_or(0.0, |time| time[0]);
            let mut acting = vec![NonConservative::Friction];
            acting.extend(pendulum.drive(time).map(NonConservative::Drive));
            tree.budget(
                &mut workspace,
                definition,
                &acting,
                given(values[0]),
                &mut budget,
            );
            let parts = [&budget.energies, &budget.transfers, &budget.powers];
            for (out, part) in out.chunks_exact_mut(count.max(1)).zip(parts) {
                out.copy_from_slice(part);
            }
        })?;
        let take = all.getattr("take")?;
        let part = |index: usize| take.call1((index, -2));
        let fields = [
            ("energies", part(0)?),
            ("transfers", part(1)?),
            ("powers", part(2)?),
            ("sectors", self.sectors(py)?.into_pyobject(py)?.into_any()),
        ];
        results::result(py, "SectorBudget", &fields)
    }
}
