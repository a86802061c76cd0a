//! Comparison of several cascades: compensated spectra, fluxes, and the equilibrium.
//!
//! If gravity is negligible, a scale with energy E_s and mass M_s, whose oldest rods have the length
//! ℓ_s, has the speed u_s = √(E_s/M_s) and the time scale ℓ_s/u_s. If it passes its energy in that
//! time, the flux is Π = E_s u_s/ℓ_s, and so E_s = M_s^{1/3} (Π ℓ_s)^{2/3}: Kolmogorov's two-thirds law
//! for a tree. This is a hypothesis. It leaves open which mass M_s is, so that exponents are reported
//! for several definitions.
//!
//! The compensated spectrum is the energy divided by that of the law, with the mass of the oldest rods
//! once for each generation that moves in the scale. It is constant where the law holds. The flatness
//! of W next to it increases from scale to scale if a cascade is intermittent.

use std::path::{Path, PathBuf};

use branched_pendulum::analysis::statistics::Estimate;
use branched_pendulum_charts::{Axis, Chart, Panel, Series, verbatim};
use branched_pendulum_data::{Table, TableOptions};

use super::findings::LEVEL;
use super::laws::{
    KOLMOGOROV, OF_EACH_GENERATION, OF_GENERATION, OF_SUBTREES, ScaleOfRun, compare, exponent,
    families, joint_exponents,
};
use super::structure::level_range;
use crate::Failure;
use crate::frame::Job;

/// Name of the table that a finished run has written.
const TABLE: &str = "scales.csv";

/// A finished run.
#[derive(Clone, Debug, PartialEq)]
struct FinishedRun {
    name: String,
    /// Power that friction removes at all scales, in W; NaN if it has no average.
    input: f64,
    /// Scales whose energy and flux have an average.
    rows: Vec<ScaleOfRun>,
}

/// Draws the runs in these folders in one chart, and reports where their fluxes are constant and
/// the energies there.
///
/// # Errors
/// [`Failure::Reading`] if a folder has no table `scales.csv` of this program, [`Failure::Lacking`]
/// if no scale of differences of a run has an average.
pub fn run(folders: &[PathBuf], job: &Job) -> Result<(), Failure> {
    let spectra = folders.iter().map(|folder| FinishedRun::read(folder));
    let spectra = spectra.collect::<Result<Vec<FinishedRun>, Failure>>()?;
    for folder in folders {
        job.input_file(&folder.join(TABLE))?;
    }
    if let Some(short) = spectra.iter().find(|own| own.differences().is_empty()) {
        return Err(Failure::Lacking {
            what: format!(
                "no scale of differences in `{}` has an average energy and flux: run it for a \
                 longer time by `--duration`",
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
        let table = Table::read(folder.join(TABLE), &TableOptions::default())?;
        let column = |name: &str| -> Result<Vec<Option<f64>>, Failure> {
            Ok(table.values(table.column(name)?)?.to_vec())
        };
        let scale = column("scale")?;
        let [length, mass] = [column("length")?, column("mass")?];
        let subtrees = column("mass of subtrees")?;
        let [energy, error] = [column("energy")?, column("error of energy")?];
        let [flux, flux_error] = [
            column("flux by dissipation")?,
            column("error of flux by dissipation")?,
        ];
        let equilibrium = match table.column("energy in equilibrium") {
            Ok(place) => table.values(place)?.to_vec(),
            // The run did not ask for it.
            Err(_) => Vec::new(),
        };
        let [flatness, flatness_error] =
            [column("flatness of W")?, column("error of flatness of W")?];
        let row = |place: usize| {
            let at = |list: &[Option<f64>]| list.get(place).copied().flatten();
            let scale = at(&scale)? as usize;
            Some(ScaleOfRun {
                scale,
                generations: table.rows().saturating_sub(scale),
                length: at(&length)?,
                mass: at(&mass)?,
                subtrees: at(&subtrees)?,
                energy: Estimate {
                    value: at(&energy)?,
                    error: at(&error)?,
                },
                flux: at(&flux)?,
                flux_error: at(&flux_error)?,
                equilibrium: at(&equilibrium),
                flatness: at(&flatness)
                    .zip(at(&flatness_error))
                    .map(|(value, error)| Estimate { value, error }),
            })
        };
        let name = folder.file_name().unwrap_or(folder.as_os_str());
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            input: flux.first().copied().flatten().unwrap_or(f64::NAN),
            rows: (0..table.rows()).filter_map(row).collect(),
        })
    }

    /// Returns the scales of differences, from scale 1 on.
    fn differences(&self) -> &[ScaleOfRun] {
        let means = self.rows.iter().take_while(|row| row.scale == 0).count();
        self.rows.get(means..).unwrap_or_default()
    }

    /// Returns the longest range of successive scales of differences whose fluxes lie within five
    /// per cent of each other.
    fn inner(&self) -> &[ScaleOfRun] {
        let rows = self.differences();
        let scales = rows.last().map_or(0, |last| last.scale + 1);
        // A scale without an average has no number.
        let mut fluxes = vec![f64::NAN; scales];
        for row in rows {
            if let Some(flux) = fluxes.get_mut(row.scale) {
                *flux = row.flux;
            }
        }
        let range = level_range(&fluxes, LEVEL);
        let before = rows
            .iter()
            .take_while(|row| row.scale < range.start)
            .count();
        rows.get(before..before + range.len()).unwrap_or_default()
    }
}

fn report(spectra: &[FinishedRun]) -> String {
    let mut text = format!(
        "| run | flux constant within {:.0} % over scales | flux there and below, parts of the input | \
         exponent of Π ℓ, {} | the same, {} | the same, {} | E_s/E_s in equilibrium there | flatness of W there |\n\
         |---|---|---|---|---|---|---|---|\n",
        100.0 * LEVEL,
        OF_SUBTREES.0,
        OF_GENERATION.0,
        OF_EACH_GENERATION.0,
    );
    for spectrum in spectra {
        let inner = spectrum.inner();
        let range = match inner {
            [first, .., last] => format!("{} to {}", first.scale, last.scale),
            _ => "none".to_owned(),
        };
        let input = spectrum.input;
        let listed = |value: &dyn Fn(&ScaleOfRun) -> Option<String>| {
            let values: Vec<String> = inner.iter().filter_map(value).collect();
            values.join(", ")
        };
        let masses = [OF_SUBTREES, OF_GENERATION, OF_EACH_GENERATION];
        let exponents = masses.map(|mass| match exponent(inner, mass) {
            Some(own) => shown(own),
            None => "–".to_owned(),
        });
        text += &format!(
            "| {} | {range} | {} | {} | {} | {} |\n",
            spectrum.name,
            listed(&|row| Some(format!("{:.3}", row.flux / input))),
            exponents.join(" | "),
            listed(&|row| Some(format!("{:.3}", row.energy.value / row.equilibrium?))),
            listed(&|row| row
                .flatness
                .map(|own| format!("{:.1} ± {:.1}", own.value, own.error))),
        )
        .replace("| -", "| −");
    }
    text += &format!("\nThe two-thirds law has the exponent {KOLMOGOROV:.3}.\n");
    text += &between(spectra);
    let ranges: Vec<&[ScaleOfRun]> = spectra.iter().map(FinishedRun::inner).collect();
    for own in [OF_SUBTREES, OF_EACH_GENERATION] {
        if let Some([mass, flux]) = joint_exponents(&ranges, own) {
            let fit = format!(
                "\nAll runs together, E ∝ M^a (Π ℓ)^b with {}: a = {}, b = {}; the law has 1/3 and 2/3.\n",
                own.0,
                shown(mass),
                shown(flux),
            );
            text += &fit;
        }
    }
    text
}

/// Returns the exponents between runs of one family of trees with different numbers of generations,
/// and those of all families together; empty if there are none.
fn between(spectra: &[FinishedRun]) -> String {
    let mut rows = String::new();
    let mut pairs = Vec::new();
    for (index, first) in spectra.iter().enumerate() {
        for second in &spectra[index + 1..] {
            let Some(pair) = compare(first.inner(), second.inner()) else {
                continue;
            };
            let generations: Vec<String> = pair.generations.iter().map(usize::to_string).collect();
            rows += &format!(
                "| {} | {} | {} | {} |\n",
                first.name,
                second.name,
                generations.join(", "),
                shown(pair.exponent),
            );
            pairs.push(pair);
        }
    }
    if rows.is_empty() {
        return rows;
    }
    let mut text = format!(
        "\n| from | to | generations from the scale on | exponent of ℓ between them |\n\
         |---|---|---|---|\n{rows}"
    );
    if let Some(own) = families(&pairs) {
        text += &format!(
            "\n{} families, by the pair of each with the smallest error bar: the exponent of ℓ is {} if \
             that of m is 1/3; fitted together that of m is {} and that of ℓ is {}, with a χ² of {:.1}.\n",
            own.count,
            shown(own.length_alone),
            shown(own.mass),
            shown(own.length),
            own.chi_squared,
        );
    }
    text
}

/// Returns a number with its error bar.
fn shown(own: Estimate) -> String {
    format!("{:.3} ± {:.3}", own.value, own.error).replace('-', "−")
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
        let input = spectrum.input;
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
    use super::FinishedRun;
    use crate::commands::cascade::laws::tests::row;

    #[test]
    fn the_inner_scales_are_the_longest_level_stretch() {
        let fluxes = [1.0, 0.8, 0.79, 0.78, 0.7, 0.69];
        let rows = fluxes.iter().enumerate();
        let rows = rows.map(|(scale, flux)| row(scale, 1.0, *flux)).collect();
        let name = String::new();
        let spectrum = FinishedRun {
            name,
            input: 1.0,
            rows,
        };
        let inner: Vec<usize> = spectrum.inner().iter().map(|row| row.scale).collect();
        assert_eq!(inner, [1, 2, 3]);
        // A scale that has no average ends a stretch.
        let mut torn = spectrum.clone();
        torn.rows.remove(2);
        assert_eq!(torn.inner().len(), 2);
        assert!(torn.inner().iter().all(|row| row.scale > 3));
    }
}
