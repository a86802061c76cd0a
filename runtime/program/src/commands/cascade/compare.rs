//! Several cascades beside each other: compensated spectra, fluxes, and the equilibrium.
//!
//! Where gravity does not matter, a scale of the energy E_s, of rods of the mass M_s together and
//! the length ℓ_s, has the speed u_s = √(E_s/M_s) and the time ℓ_s/u_s. If it hands on its energy in
//! that time, the flux is Π = E_s u_s/ℓ_s, and so E_s = M_s^{1/3} (Π ℓ_s)^{2/3}: Kolmogorov's
//! two-thirds law for a tree. That is a hypothesis. The compensated spectrum is the energy over
//! this one, level where the law holds. Beside it stands the flatness of W, which grows from scale
//! to scale where a cascade is intermittent.

use std::path::{Path, PathBuf};

use branched_pendulum::analysis::statistics::Estimate;
use branched_pendulum_charts::{Axis, Chart, Panel, Series, verbatim};
use branched_pendulum_data::{Table, TableOptions};

use crate::Failure;
use crate::frame::Job;

/// Deviation of a flux that counts as constant.
const LEVEL: f64 = 0.05;

/// The exponent of Π ℓ_s in the hypothesis.
const KOLMOGOROV: f64 = 2.0 / 3.0;

/// A scale of a finished run.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ScaleOfRun {
    /// Number of the scale.
    scale: usize,
    /// Length of a link, m.
    length: f64,
    /// Mass of all links of the generation, kg.
    mass: f64,
    /// Energy, J.
    energy: Estimate,
    /// Power that friction takes there and below, W.
    flux: f64,
    /// Energy in equilibrium at the same energy of all, J.
    equilibrium: Option<f64>,
    /// Flatness of the density of W into the scale and all younger ones.
    flatness: Option<Estimate>,
}

/// A finished run.
#[derive(Clone, Debug, PartialEq)]
struct FinishedRun {
    name: String,
    rows: Vec<ScaleOfRun>,
}

/// Draws the runs in these folders beside each other, and says where their fluxes are constant
/// and what the energies are there.
///
/// # Errors
/// [`Failure::Reading`] of a folder without a table `scales.csv` of this program,
/// [`Failure::Lacking`] of a run none of whose differences has an average.
pub fn run(folders: &[PathBuf], job: &Job) -> Result<(), Failure> {
    let spectra = folders.iter().map(|folder| FinishedRun::read(folder));
    let spectra = spectra.collect::<Result<Vec<FinishedRun>, Failure>>()?;
    if let Some(short) = spectra.iter().find(|own| own.differences().is_empty()) {
        return Err(Failure::Lacking {
            what: format!(
                "no difference in `{}` has an average energy and flux: run it for longer, by \
                 `--duration`",
                short.name
            ),
        });
    }
    let text = report(&spectra);
    job.print(&text)?;
    job.write("spectrum.md", text.as_bytes())?;
    job.chart("cascade-spectrum", &chart(&spectra))?;
    Ok(())
}

impl FinishedRun {
    fn read(folder: &Path) -> Result<Self, Failure> {
        let table = Table::read(folder.join("scales.csv"), &TableOptions::default())?;
        let column = |name: &str| -> Result<Vec<Option<f64>>, Failure> {
            Ok(table.values(table.column(name)?)?.to_vec())
        };
        let scale = column("scale")?;
        let [length, mass] = [column("length")?, column("mass")?];
        let [energy, error] = [column("energy")?, column("error of energy")?];
        let flux = column("flux by dissipation")?;
        let equilibrium = match table.column("energy in equilibrium") {
            Ok(place) => table.values(place)?.to_vec(),
            // The run did not ask for it.
            Err(_) => Vec::new(),
        };
        let [flatness, flatness_error] =
            [column("flatness of W")?, column("error of flatness of W")?];
        let row = |place: usize| {
            let at = |list: &[Option<f64>]| list.get(place).copied().flatten();
            Some(ScaleOfRun {
                scale: at(&scale)? as usize,
                length: at(&length)?,
                mass: at(&mass)?,
                energy: Estimate {
                    value: at(&energy)?,
                    error: at(&error)?,
                },
                flux: at(&flux)?,
                equilibrium: at(&equilibrium),
                flatness: at(&flatness)
                    .zip(at(&flatness_error))
                    .map(|(value, error)| Estimate { value, error }),
            })
        };
        let name = folder.file_name().unwrap_or(folder.as_os_str());
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            rows: (0..table.rows()).filter_map(row).collect(),
        })
    }

    /// Power that friction takes in all scales, W; NaN where it has no average.
    fn input(&self) -> f64 {
        let means = self.rows.first().filter(|row| row.scale == 0);
        means.map_or(f64::NAN, |row| row.flux)
    }

    /// The differences, from scale 1 on.
    fn differences(&self) -> &[ScaleOfRun] {
        let means = self.rows.iter().take_while(|row| row.scale == 0).count();
        self.rows.get(means..).unwrap_or_default()
    }

    /// The longest stretch of differences, one after the other, whose fluxes lie within five per
    /// cent of each other.
    fn inner(&self) -> &[ScaleOfRun] {
        let rows = self.differences();
        let mut longest: &[ScaleOfRun] = &[];
        for first in 0..rows.len() {
            for end in first + 1..=rows.len() {
                let own = &rows[first..end];
                let fluxes = || own.iter().map(|row| row.flux);
                let is_whole = own
                    .windows(2)
                    .all(|pair| pair[1].scale == pair[0].scale + 1);
                let (least, most) = (
                    fluxes().fold(f64::INFINITY, f64::min),
                    fluxes().fold(0.0, f64::max),
                );
                if is_whole && most - least <= LEVEL * most && own.len() > longest.len() {
                    longest = own;
                }
            }
        }
        longest
    }
}

impl ScaleOfRun {
    /// Π ℓ_s, W m.
    fn pushed(&self) -> f64 {
        self.flux * self.length
    }

    /// The energy over that of the hypothesis.
    fn compensated(&self) -> f64 {
        self.energy.value / (self.mass.cbrt() * self.pushed().powf(KOLMOGOROV))
    }
}

/// The exponent a of E_s/M_s^{1/3} ∝ (Π ℓ_s)^a by weighted least squares, with an error bar that
/// grows with the misfit; none of fewer than three scales, and without error bars.
fn exponent(rows: &[ScaleOfRun]) -> Option<Estimate> {
    let measured = rows.iter().all(|row| row.energy.error > 0.0);
    if rows.len() < 3 || !measured {
        return None;
    }
    let points = rows.iter().map(|row| {
        let y = (row.energy.value / row.mass.cbrt()).ln();
        let weight = (row.energy.value / row.energy.error).powi(2);
        (row.pushed().ln(), y, weight)
    });
    let points: Vec<(f64, f64, f64)> = points.collect();
    let sum = |value: &dyn Fn(&(f64, f64, f64)) -> f64| points.iter().map(value).sum::<f64>();
    let total = sum(&|(_, _, w)| *w);
    let (x, y) = (
        sum(&|(x, _, w)| w * x) / total,
        sum(&|(_, y, w)| w * y) / total,
    );
    let spread = sum(&|(own, _, w)| w * (own - x).powi(2));
    let slope = sum(&|(own, value, w)| w * (own - x) * (value - y)) / spread;
    let misfit = sum(&|(own, value, w)| w * (value - y - slope * (own - x)).powi(2));
    let misfit = (misfit / (points.len() - 2) as f64).max(1.0);
    Some(Estimate {
        value: slope,
        error: (misfit / spread).sqrt(),
    })
}

fn report(spectra: &[FinishedRun]) -> String {
    let mut text = format!(
        "| run | flux constant within {:.0} % over scales | flux there and below, parts of the input | \
         exponent of Π ℓ | E_s/E_s in equilibrium there | flatness of W there |\n\
         |---|---|---|---|---|---|\n",
        100.0 * LEVEL
    );
    for spectrum in spectra {
        let inner = spectrum.inner();
        let range = match inner {
            [first, .., last] => format!("{} to {}", first.scale, last.scale),
            _ => "none".to_owned(),
        };
        let input = spectrum.input();
        let listed = |value: &dyn Fn(&ScaleOfRun) -> Option<String>| {
            let values: Vec<String> = inner.iter().filter_map(value).collect();
            values.join(", ")
        };
        let exponent = match exponent(inner) {
            Some(own) => format!("{:.2} ± {:.2}", own.value, own.error),
            None => "–".to_owned(),
        };
        text += &format!(
            "| {} | {range} | {} | {exponent} | {} | {} |\n",
            spectrum.name,
            listed(&|row| Some(format!("{:.3}", row.flux / input))),
            listed(&|row| Some(format!("{:.3}", row.energy.value / row.equilibrium?))),
            listed(&|row| row
                .flatness
                .map(|own| format!("{:.1} ± {:.1}", own.value, own.error))),
        )
        .replace("| -", "| −");
    }
    text += &format!("\nThe two-thirds law has the exponent {KOLMOGOROV:.3}.\n");
    text
}

fn chart(spectra: &[FinishedRun]) -> Chart {
    let mut compensated = Panel::new(Axis::log("E / E by the two-thirds law"));
    let mut flux = Panel::new(Axis::linear("flux into the scale / input").range(0.0, 1.1));
    let most = spectra.iter().map(|own| own.rows.len()).max().unwrap_or(1);
    let mut beside = Panel::new(Axis::log("E / E in equilibrium"));
    beside = beside.line("equilibrium", &[0.0, most as f64 - 1.0], &[1.0; 2]);
    let mut wild = Panel::new(Axis::log("flatness of W"));
    wild = wild.line("normal", &[1.0, most as f64 - 1.0], &[3.0; 2]);
    for spectrum in spectra {
        let line =
            |panel: Panel, rows: &[ScaleOfRun], value: &dyn Fn(&ScaleOfRun) -> Option<f64>| {
                let points = rows
                    .iter()
                    .filter_map(|row| Some((row.scale as f64, value(row)?)));
                let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
                match x.is_empty() {
                    true => panel,
                    false => {
                        panel.series(Series::line(verbatim(&spectrum.name), &x, &y).with_symbols())
                    }
                }
            };
        let input = spectrum.input();
        let differences = spectrum.differences();
        compensated = line(compensated, differences, &|row| Some(row.compensated()));
        flux = line(flux, differences, &|row| Some(row.flux / input));
        beside = line(beside, &spectrum.rows, &|row| {
            Some(row.energy.value / row.equilibrium?)
        });
        wild = line(wild, differences, &|row| Some(row.flatness?.value));
    }
    let title = "Cascades: by the two-thirds law the upper left panel would be level";
    let scale = "generation in which the branches differ";
    Chart::new(title, Axis::linear(scale))
        .columns(2)
        .size(1100.0, 900.0)
        .panel(compensated)
        .panel(flux)
        .panel(beside)
        .panel(wild)
}

#[cfg(test)]
mod tests {
    use super::{FinishedRun, ScaleOfRun, exponent};
    use branched_pendulum::analysis::statistics::Estimate;

    fn row(scale: usize, energy: f64, flux: f64) -> ScaleOfRun {
        ScaleOfRun {
            scale,
            length: 0.7_f64.powi(scale as i32),
            mass: 0.1 * 0.8_f64.powi(scale as i32),
            energy: Estimate {
                value: energy,
                error: 0.01 * energy,
            },
            flux,
            equilibrium: None,
            flatness: None,
        }
    }

    #[test]
    fn a_spectrum_of_the_two_thirds_law_is_level() {
        let rows = (0..6).map(|scale| {
            let own = row(scale, 1.0, 0.2);
            let energy = 3.0 * own.mass.cbrt() * own.pushed().powf(2.0 / 3.0);
            row(scale, energy, 0.2)
        });
        let rows: Vec<ScaleOfRun> = rows.collect();
        for own in &rows {
            assert!((own.compensated() - 3.0).abs() < 1e-12);
        }
        let found = exponent(&rows).unwrap();
        assert!((found.value - 2.0 / 3.0).abs() < 1e-12 && found.error > 0.0);
        assert!(exponent(&rows[..2]).is_none());
    }

    #[test]
    fn the_inner_scales_are_the_longest_level_stretch() {
        let fluxes = [1.0, 0.8, 0.79, 0.78, 0.7, 0.69];
        let rows = fluxes.iter().enumerate();
        let rows = rows.map(|(scale, flux)| row(scale, 1.0, *flux)).collect();
        let name = String::new();
        let spectrum = FinishedRun { name, rows };
        let inner: Vec<usize> = spectrum.inner().iter().map(|row| row.scale).collect();
        assert_eq!(inner, [1, 2, 3]);
        // A scale that has no average ends a stretch.
        let mut torn = spectrum.clone();
        torn.rows.remove(2);
        assert_eq!(torn.inner().len(), 2);
        assert!(torn.inner().iter().all(|row| row.scale > 3));
    }
}
