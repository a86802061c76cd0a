//! The measured tree, in the form that the estimation uses.

use std::ops::Range;

use branched_pendulum::Transfer;
use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::prelude::{AbsoluteAngles, Rk4};
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::{Energy, Model, Workspace};
use branched_pendulum::transfer::{NonConservative, StateInput, SymmetricTree};
use branched_pendulum_charts::verbatim;
use branched_pendulum_measure::{LeapSearch, SmoothingError};
use branched_pendulum_trees::PendulumTree;

use super::frictions::{FrictionCoefficient, coefficients};
use crate::Failure;
use crate::smoothed::{AngleRows, Motion, Smoothed, SmoothingEquations};
use crate::subject::Subject;

/// Names of the reported quantities of a tree.
#[derive(Clone, Debug)]
pub struct Names {
    /// Coordinates, in columns.
    pub coordinates: Vec<String>,
    /// Coordinates, in charts.
    pub symbols: Vec<String>,
    /// The coordinate that is drawn.
    pub drawn: usize,
    /// The coordinate of the spectrogram.
    pub heard: usize,
    /// The energy, in words.
    pub energy_words: String,
    /// The energy, as a symbol.
    pub energy: String,
    /// The reported power.
    pub power: &'static str,
    /// Names of the pivots whose friction the equations may lack.
    pub pivots: Vec<String>,
    /// Friction coefficients that may be missing.
    pub frictions: Vec<FrictionCoefficient>,
}

/// Power at a state, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers {
    /// The reported one.
    pub reported: f64,
    /// All that changes the energy.
    pub whole: f64,
}

/// Name under which the energy of the whole tree is requested.
pub const WHOLE: &str = "whole";

/// A tree whose links were measured. Its symmetric coordinates are used if it has copies, otherwise
/// the angles of its links.
pub struct MeasuredTree {
    tree: PendulumTree,
    /// The tree in numbers that carry a derivative.
    dual: PendulumTree<Dual<f64, 1>>,
    /// The reported sector; `None` if the whole tree is reported.
    reported: Option<ReportedSector>,
    /// Columns of the matrix that converts coordinates to angles of links.
    columns: Vec<Vec<f64>>,
    /// For each node, the angular velocities in the pivots of its links, as combinations of those
    /// of links.
    pivots: Vec<Vec<Vec<f64>>>,
    names: Names,
}

/// Sector whose energy is reported.
struct ReportedSector {
    tree: SymmetricTree<f64>,
    dual: SymmetricTree<Dual<f64, 1>>,
    sector: usize,
}

/// Returns the requested sector; `None` for the whole tree.
fn sector_of(described: &Subject, asked: Option<&str>) -> Result<Option<usize>, Failure> {
    let sectors = described.tree.sectors();
    let names: Vec<&str> = sectors.iter().map(|own| own.name()).collect();
    let sector = match asked {
        Some(WHOLE) => return Ok(None),
        None => 1,
        Some(asked) => {
            let found = names.iter().position(|own| *own == asked);
            found.ok_or_else(|| Failure::Lacking {
                what: format!(
                    "`{}` has no sector `{asked}`: `--sector` is {} or {WHOLE}",
                    described.name,
                    names.join(", ")
                ),
            })?
        }
    };
    Ok((sectors.len() > 1).then_some(sector))
}

impl MeasuredTree {
    /// Creates the tree with the requested sector. By default this is the first difference, or the
    /// whole tree if it has no copies.
    ///
    /// # Errors
    /// [`Failure::Lacking`] if the sector does not exist, and [`Failure::Tree`] for values that are
    /// not physical.
    pub fn new(described: &Subject, asked: Option<&str>) -> Result<Self, Failure> {
        let tree = described.tree.clone();
        let sector = sector_of(described, asked)?;
        let reported = sector.map(|sector| {
            let symmetric = tree
                .symmetric()
                .map_err(|source| Failure::tree(&described.name, source))?;
            let dual = symmetric.cast(Dual::constant);
            Ok::<_, Failure>(ReportedSector {
                tree: symmetric,
                dual,
                sector,
            })
        });
        let reported = reported.transpose()?;
        let parents = described.parents();
        let count = tree.links();
        let unit = |of: usize| -> Vec<f64> {
            let links = 0..count;
            links.map(|link| f64::from(u8::from(link == of))).collect()
        };
        let columns = (0..count).map(|of| {
            let mut links = vec![0.0; count];
            tree.absolute_from_symmetric(Normalisation::Plain, &unit(of), &mut links);
            links
        });
        let columns = columns.collect();
        let relative = |&link: &usize| {
            let mut row = unit(link);
            if let Some(parent) = parents.get(link).copied().flatten() {
                row[parent] = -1.0;
            }
            row
        };
        let nodes = tree.description().nodes();
        let rows = nodes
            .iter()
            .map(|node| node.links.iter().map(relative).collect());
        Ok(Self {
            pivots: rows.collect(),
            names: names_of(described, sector),
            dual: tree.cast(Dual::constant),
            tree,
            reported,
            columns,
        })
    }

    /// Returns, if the reported sector is a difference, the column that converts its first
    /// coordinate to angles of links; otherwise `None`.
    pub fn difference(&self) -> Option<&[f64]> {
        let sector = self.reported.as_ref()?.sector;
        (sector > 0).then(|| self.columns[self.names.drawn].as_slice())
    }

    /// Converts coordinates and their rates to angles and angular velocities of links.
    fn in_links<T: Scalar>(&self, motion: &[Vec<T>; 2]) -> [Vec<T>; 2] {
        motion.each_ref().map(|own| {
            let mut links = vec![T::from_f64(0.0); own.len()];
            self.tree
                .absolute_from_symmetric(Normalisation::Plain, own, &mut links);
            links
        })
    }
}

fn names_of(described: &Subject, reported: Option<usize>) -> Names {
    let tree = &described.tree;
    let sectors = tree.sectors();
    let all: Vec<&str> = sectors
        .iter()
        .flat_map(|sector| sector.coordinates())
        .map(|own| own.name())
        .collect();
    let name = |of: usize| all.get(of).copied().unwrap_or_default();
    let links = tree.links();
    let symbol = |of: usize| match name(of).strip_prefix("theta_") {
        Some(index) => format!("θ_{{{index}}}"),
        None => verbatim(name(of)),
    };
    let counts: Vec<usize> = sectors.iter().map(|own| own.coordinates().len()).collect();
    let before = |sector: usize| counts.iter().take(sector).sum::<usize>();
    // The last of those in phase: means of leaves.
    let heard = before(1).saturating_sub(1);
    let sector = reported.and_then(|reported| Some((reported, sectors.get(reported)?.name())));
    let description = tree.description();
    let nodes = description.nodes();
    let pivots = nodes.iter().map(|node| match node.links.len() {
        1 => format!("the pivot of `{}`", node.name),
        _ => format!("the pivots of `{}`", node.name),
    });
    Names {
        coordinates: (0..links).map(|of| name(of).to_owned()).collect(),
        symbols: (0..links).map(symbol).collect(),
        drawn: match sector {
            Some((reported, _)) => before(reported),
            None => links.saturating_sub(1),
        },
        heard,
        energy_words: match sector {
            Some((0, _)) => "Energy of the motion in phase".to_owned(),
            Some((_, name)) => format!("Energy of the difference {name}"),
            None => format!("Energy of {}", described.name),
        },
        energy: match sector {
            Some((_, name)) => format!("H_{name}"),
            None => "H".to_owned(),
        },
        power: if sector.is_some() { "W" } else { "P" },
        pivots: pivots.collect(),
        frictions: coefficients(tree),
    }
}

/// Returns a motion that begins to change, in numbers that carry the derivative.
fn along(motion: &Motion, change: &Motion) -> [Vec<Dual<f64, 1>>; 2] {
    [0, 1].map(|part| {
        let both = motion[part].iter().zip(&change[part]);
        let both = both.map(|(&value, &change)| Dual {
            value,
            tangents: [change],
        });
        both.collect()
    })
}

/// Returns the energy of a sector, given coordinates and their rates.
fn sector_energy<T: Scalar>(
    tree: &SymmetricTree<T>,
    sector: usize,
    [coordinates, rates]: &[Vec<T>; 2],
) -> T {
    let mut energies = vec![[T::from_f64(0.0); 2]; tree.sectors().len()];
    let given = StateInput::Rates { coordinates, rates };
    tree.energies(&mut Workspace::new(), given, &mut energies);
    let [kinetic, potential] = energies[sector];
    kinetic + potential
}

impl MeasuredTree {
    /// Names of the reported quantities.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// Converts angles or angular velocities of links to the smoothed coordinates.
    pub fn coordinates(&self, links: &[f64]) -> Vec<f64> {
        let mut coordinates = vec![0.0; links.len()];
        self.tree
            .symmetric_from_absolute(Normalisation::Plain, links, &mut coordinates);
        coordinates
    }

    /// Converts coordinates or their rates to angles or angular velocities of links.
    pub fn links(&self, coordinates: &[f64]) -> Vec<f64> {
        let [links, _] = self.in_links(&[coordinates.to_vec(), Vec::new()]);
        links
    }

    /// The reported energy, J.
    pub fn energy(&self, motion: &Motion) -> f64 {
        match &self.reported {
            Some(reported) => sector_energy(&reported.tree, reported.sector, motion),
            None => {
                let [theta, omega] = self.in_links(motion);
                self.tree.energy_of(&theta, &omega)
            }
        }
    }

    /// Returns the change of the energy caused by a change of the motion, to first order.
    pub fn energy_along(&self, motion: &Motion, change: &Motion) -> f64 {
        let changing = along(motion, change);
        let energy = match &self.reported {
            Some(reported) => sector_energy(&reported.dual, reported.sector, &changing),
            None => {
                let [theta, omega] = self.in_links(&changing);
                self.dual.energy_of(&theta, &omega)
            }
        };
        let [slope] = energy.tangents;
        slope
    }

    /// Returns the powers at a time (s). `friction` is the additional friction in the pivots that
    /// is reported (N m s, one number each, or empty).
    pub fn powers(&self, time: f64, motion: &Motion, friction: &[f64]) -> Powers {
        let [theta, omega] = self.in_links(motion);
        // Torques of the reported friction.
        let mut torques = vec![0.0; theta.len()];
        let rows = self.pivots.iter().zip(friction);
        for (row, coefficient) in rows.flat_map(|(rows, c)| rows.iter().map(move |row| (row, c))) {
            let rate: f64 = row.iter().zip(&omega).map(|(part, rate)| part * rate).sum();
            for (torque, part) in torques.iter_mut().zip(row) {
                *torque -= coefficient * rate * part;
            }
        }
        let Some(ReportedSector { tree, sector, .. }) = &self.reported else {
            // All that acts is in the accelerations: the power is the derivative of the energy
            // along the motion, with any law of friction.
            let alpha = self.tree.accelerations(time, &theta, &omega);
            let change = [&omega, &alpha].map(|part| self.coordinates(part));
            let own = self.energy_along(motion, &change);
            let lost: f64 = torques.iter().zip(&omega).map(|(q, rate)| q * rate).sum();
            let whole = own + lost;
            return Powers {
                reported: whole,
                whole,
            };
        };
        let [coordinates, rates] = motion;
        let given = StateInput::Rates { coordinates, rates };
        let (mut workspace, count) = (Workspace::new(), tree.sectors().len());
        let mut transfers = vec![Transfer::default(); count];
        tree.exact_transfers(&mut workspace, given, &mut transfers);
        let reported = transfers[*sector].total();
        let mut whole = reported;
        let drive = self.tree.drive(time).map(NonConservative::Drive);
        let acting = [
            Some(NonConservative::Friction),
            drive,
            Some(NonConservative::Torques(&torques)),
        ];
        for acting in acting.into_iter().flatten() {
            let mut powers = vec![0.0; count];
            tree.powers(&mut workspace, acting, given, &mut powers);
            whole += powers[*sector];
        }
        Powers { reported, whole }
    }

    /// Smooths a record by the equations of motion, starting from a given motion of the links.
    /// Forces that the model lacks act on each coordinate, that is, on copies together and against
    /// each other.
    ///
    /// # Errors
    /// As [`SmoothingEquations::smooth`].
    pub fn by_model(
        &self,
        record: AngleRows<'_>,
        guess: &[Motion],
    ) -> Result<Smoothed, SmoothingError> {
        let equations = SmoothingEquations {
            system: &linearised(AbsoluteAngles(&self.tree)),
            mass_matrix: &|theta| self.tree.mass_matrix(theta),
            disturbances: &self.columns,
            frictions: &self.pivots,
        };
        equations.smooth(record, guess)
    }

    /// Returns the ranges of rows in which a record violates the equations for a moment.
    ///
    /// # Errors
    /// As [`LeapSearch::find`].
    pub fn leaps(&self, record: AngleRows<'_>) -> Result<Vec<Range<usize>>, SmoothingError> {
        let method = Rk4::new(LeapSearch::LONGEST_STEP);
        let system = linearised(AbsoluteAngles(&self.tree));
        LeapSearch::default().find(&method, &system, record.times, record.angles)
    }
}
