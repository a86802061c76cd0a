//! The tree that was measured, as the estimate takes it.

use branched_pendulum::Transfer;
use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::prelude::AbsoluteAngles;
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::{Energy, Model, Workspace};
use branched_pendulum::transfer::{Given, NonConservative, SymmetricTree};
use branched_pendulum_charts::verbatim;
use branched_pendulum_measure::SmoothingError;
use branched_pendulum_trees::PendulumTree;

use crate::Failure;
use crate::smoothed::{AngleRows, Motion, Smoothed, SmoothingEquations};
use crate::subject::Subject;

/// Names of what is told about a tree.
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
    /// The power that is told.
    pub power: &'static str,
    /// Pivots whose friction the equations may lack.
    pub pivots: Vec<String>,
    /// Options that give it.
    pub frictions: Vec<String>,
}

/// Power at a state, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers {
    /// The one that is told.
    pub told: f64,
    /// All that changes the energy.
    pub whole: f64,
}

/// Name by which the energy of the whole tree is asked for.
pub const WHOLE: &str = "whole";

/// A tree in a text whose links were measured: its symmetric coordinates where it has copies, else
/// the angles of its links.
pub struct MeasuredTree {
    tree: PendulumTree,
    /// The tree in numbers with a derivative.
    dual: PendulumTree<Dual<f64, 1>>,
    /// The sector that is told; none for the whole tree.
    told: Option<Told>,
    /// Columns by which links follow from coordinates.
    columns: Vec<Vec<f64>>,
    /// Of the links of each node the rates in their pivots, as combinations of those of links.
    pivots: Vec<Vec<Vec<f64>>>,
    names: Names,
}

/// A sector whose energy is told.
struct Told {
    tree: SymmetricTree<f64>,
    dual: SymmetricTree<Dual<f64, 1>>,
    sector: usize,
}

/// The sector that is asked for; none for the whole tree.
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
    /// The tree, with the sector that is asked for: the first difference, or the whole of a tree
    /// without copies, if none is.
    ///
    /// # Errors
    /// [`Failure::Lacking`] for a sector that there is not, and [`Failure::Tree`] for values that
    /// no pendulum with copies can have.
    pub fn new(described: &Subject, asked: Option<&str>) -> Result<Self, Failure> {
        let tree = described.tree.clone();
        let sector = sector_of(described, asked)?;
        let told = sector.map(|sector| {
            let symmetric = tree
                .symmetric()
                .map_err(|source| Failure::tree(&described.name, source))?;
            let dual = symmetric.cast(Dual::constant);
            Ok::<_, Failure>(Told {
                tree: symmetric,
                dual,
                sector,
            })
        });
        let told = told.transpose()?;
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
            told,
            columns,
        })
    }

    /// The column by which links follow from the first coordinate of the told sector, for a
    /// difference; none otherwise.
    pub fn difference(&self) -> Option<&[f64]> {
        let sector = self.told.as_ref()?.sector;
        (sector > 0).then(|| self.columns[self.names.drawn].as_slice())
    }

    /// Angles and rates of links from those of coordinates.
    fn in_links<T: Scalar>(&self, motion: &[Vec<T>; 2]) -> [Vec<T>; 2] {
        motion.each_ref().map(|own| {
            let mut links = vec![T::from_f64(0.0); own.len()];
            self.tree
                .absolute_from_symmetric(Normalisation::Plain, own, &mut links);
            links
        })
    }
}

fn names_of(described: &Subject, told: Option<usize>) -> Names {
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
    let sector = told.and_then(|told| Some((told, sectors.get(told)?.name())));
    let description = tree.description();
    let nodes = description.nodes();
    let pivots = nodes.iter().map(|node| match node.links.len() {
        1 => format!("the pivot of `{}`", node.name),
        _ => format!("the pivots of `{}`", node.name),
    });
    let frictions = nodes.iter().map(|node| match &node.friction[..] {
        [] => format!("friction of `{}` in the description", node.name),
        parameters => format!("--set {}", parameters.join(", ")),
    });
    Names {
        coordinates: (0..links).map(|of| name(of).to_owned()).collect(),
        symbols: (0..links).map(symbol).collect(),
        drawn: match sector {
            Some((told, _)) => before(told),
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
        frictions: frictions.collect(),
    }
}

/// A motion that begins to change.
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

/// Energy of a sector at coordinates and rates.
fn sector_energy<T: Scalar>(
    tree: &SymmetricTree<T>,
    sector: usize,
    [coordinates, rates]: &[Vec<T>; 2],
) -> T {
    let mut energies = vec![[T::from_f64(0.0); 2]; tree.sectors().len()];
    let given = Given::Rates { coordinates, rates };
    tree.energies(&mut Workspace::new(), given, &mut energies);
    let [kinetic, potential] = energies[sector];
    kinetic + potential
}

impl MeasuredTree {
    /// Names of what is told.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// Coordinates that are smoothed, from angles of links or from rates.
    pub fn coordinates(&self, links: &[f64]) -> Vec<f64> {
        let mut coordinates = vec![0.0; links.len()];
        self.tree
            .symmetric_from_absolute(Normalisation::Plain, links, &mut coordinates);
        coordinates
    }

    /// Angles or rates of links from coordinates.
    pub fn links(&self, coordinates: &[f64]) -> Vec<f64> {
        let [links, _] = self.in_links(&[coordinates.to_vec(), Vec::new()]);
        links
    }

    /// The energy that is told, J.
    pub fn energy(&self, motion: &Motion) -> f64 {
        match &self.told {
            Some(told) => sector_energy(&told.tree, told.sector, motion),
            None => {
                let [theta, omega] = self.in_links(motion);
                self.tree.energy_of(&theta, &omega)
            }
        }
    }

    /// Change of the energy by a change of the motion, to first order about it.
    pub fn energy_along(&self, motion: &Motion, change: &Motion) -> f64 {
        let changing = along(motion, change);
        let energy = match &self.told {
            Some(told) => sector_energy(&told.dual, told.sector, &changing),
            None => {
                let [theta, omega] = self.in_links(&changing);
                self.dual.energy_of(&theta, &omega)
            }
        };
        let [slope] = energy.tangents;
        slope
    }

    /// Returns the powers at a time (s), with friction in the pivots that is told beside the
    /// tree's own: a coefficient (N m s) for each, or none.
    pub fn powers(&self, time: f64, motion: &Motion, friction: &[f64]) -> Powers {
        let [theta, omega] = self.in_links(motion);
        // Torques of the friction that is told.
        let mut torques = vec![0.0; theta.len()];
        let rows = self.pivots.iter().zip(friction);
        for (row, coefficient) in rows.flat_map(|(rows, c)| rows.iter().map(move |row| (row, c))) {
            let rate: f64 = row.iter().zip(&omega).map(|(part, rate)| part * rate).sum();
            for (torque, part) in torques.iter_mut().zip(row) {
                *torque -= coefficient * rate * part;
            }
        }
        let Some(Told { tree, sector, .. }) = &self.told else {
            // All that acts is in the accelerations: the power is the derivative of the energy
            // along the motion, whatever the law of friction.
            let alpha = self.tree.accelerations(time, &theta, &omega);
            let change = [&omega, &alpha].map(|part| self.coordinates(part));
            let own = self.energy_along(motion, &change);
            let lost: f64 = torques.iter().zip(&omega).map(|(q, rate)| q * rate).sum();
            let whole = own + lost;
            return Powers { told: whole, whole };
        };
        let [coordinates, rates] = motion;
        let given = Given::Rates { coordinates, rates };
        let (mut workspace, count) = (Workspace::new(), tree.sectors().len());
        let mut transfers = vec![Transfer::default(); count];
        tree.exact_transfers(&mut workspace, given, &mut transfers);
        let told = transfers[*sector].total();
        let mut whole = told;
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
        Powers { told, whole }
    }

    /// Smooths by the equations of motion, beginning from a motion of the links. Forces that the
    /// model lacks act on each coordinate: on copies together and against each other.
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
}
