//! Tables of the onset: sectors, closure of their energy budgets, and energy transfers between
//! them.

use std::fmt::Write;

use branched_pendulum::analysis::SectorModes;
use branched_pendulum::sectors::Sectors;
use branched_pendulum_data::Column;

use super::Release;
use super::run::{DEFINITIONS, Onset, PARSEVAL};
use crate::Failure;
use crate::frame::Job;
use crate::subject::Subject;

/// Returns the printed report, as Markdown.
pub fn report(release: &Release, driven: &Subject, modes: &SectorModes, run: &Onset) -> String {
    let Release {
        start: _,
        duration,
        torque,
        frequency,
        difference,
        tolerance,
    } = release;
    let drive = match torque {
        0.0 => "no torque but that of the description".to_owned(),
        torque => format!("torque {torque} N m · cos(2π {frequency} Hz t) on the root"),
    };
    let mut text = format!(
        "{}, released with differences of {difference} rad; {drive};\n{duration} s, Dop853 at \
         {tolerance:e}: {} steps, {} evaluations.\n\n",
        driven.name, run.account.accepted, run.account.evaluations
    );
    text.push_str(&sector_table(modes, run));
    text.push('\n');
    text.push_str(&matrix_table(driven, run));
    text
}

/// Returns the table of the sectors, with their sizes, frequencies and the closures of their
/// budgets.
fn sector_table(modes: &SectorModes, run: &Onset) -> String {
    let mut text = format!(
        "Sectors: size, eigenfrequencies, and how well each budget closes, as the\n\
         largest |∫(W+P) dt − ΔE| over the largest energy of all sectors. Entries between\n\
         blocks: {:.0e} of the mass matrix, {:.0e} of the stiffness matrix.\n\n",
        modes.mass_off_block, modes.stiffness_off_block
    );
    text.push_str("| sector | size | frequencies (Hz) |");
    // Writing to a string cannot fail.
    for (_, name) in DEFINITIONS {
        let _ = write!(text, " {name} |");
    }
    text.push_str("\n|---|---|---|---|---|---|---|\n");
    let closures: [_; DEFINITIONS.len()] = std::array::from_fn(|index| run.closure(index));
    for (sector, block) in modes.blocks.iter().enumerate() {
        let frequencies = block.modes.frequencies_hz.iter();
        let frequencies: Vec<String> = frequencies.map(|f| format!("{f:.4}")).collect();
        let _ = write!(
            text,
            "| `{}` | {} | {} |",
            block.name,
            block.coordinates.len(),
            frequencies.join(", ")
        );
        for closure in &closures {
            let gap = closure.get(sector).copied().unwrap_or(f64::NAN);
            let _ = write!(text, " {gap:.0e} |");
        }
        text.push('\n');
    }
    text
}

/// Returns the table of the time-averaged energy transfers between sectors, with the powers of
/// friction and drive.
fn matrix_table(driven: &Subject, run: &Onset) -> String {
    let Some(last) = run.samples.last() else {
        return String::new();
    };
    let sectors = driven.tree.sectors();
    let mut text =
        "Mean transfer matrix (mW), energies by Parseval: what the sector of the column\n\
        gave that of the row; then the mean power of friction and drive and the mean\n\
        rate of its energy.\n\n|  |"
            .to_owned();
    // Writing to a string cannot fail.
    for sector in sectors {
        let _ = write!(text, " `{}` |", sector.name());
    }
    text.push_str(" friction, drive | dE/dt |\n|---|");
    text.push_str(&"---:|".repeat(sectors.len() + 2));
    text.push('\n');
    let mean = |energy: f64| milli(energy / last.time);
    let rows = last.flowed.transfers.chunks_exact(sectors.len());
    let sums = last.flowed.power.iter().zip(&last.flowed.given[PARSEVAL]);
    for (row, ((sector, given), (power, gained))) in sectors.iter().zip(rows).zip(sums).enumerate()
    {
        let _ = write!(text, "| `{}` |", sector.name());
        for (column, given) in given.iter().enumerate() {
            let cell = if column == row {
                "–".to_owned()
            } else {
                mean(*given)
            };
            let _ = write!(text, " {cell} |");
        }
        let _ = writeln!(text, " {} | {} |", mean(*power), mean(*gained));
    }
    text
}

/// Formats a power (given in W) in mW with three decimals; zero is written without a minus sign.
fn milli(watts: f64) -> String {
    let text = format!("{:.3}", 1e3 * watts);
    if text == "-0.000" {
        "0.000".to_owned()
    } else {
        text.replace('-', "−")
    }
}

/// Writes a CSV table of the sectors' energies (by Parseval's identity), of the energy received
/// from friction and drive, and of the energy received from other sectors.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write_samples(job: &Job, driven: &Subject, run: &Onset) -> Result<(), Failure> {
    let sectors = driven.tree.sectors();
    let mut columns = vec![Column::new("time", "s")];
    for quantity in ["energy", "given by friction and drive", "given by sectors"] {
        let names = sectors.iter().map(|sector| sector.name());
        columns.extend(names.map(|name| Column::new(format!("{quantity} {name}"), "J")));
    }
    job.csv("onset.csv", &columns, |file| {
        for sample in &run.samples {
            let mut row = vec![sample.time];
            row.extend(&sample.energies[PARSEVAL]);
            row.extend(&sample.flowed.power);
            let given = sample.flowed.transfers.chunks_exact(sectors.len());
            row.extend(given.map(|given| given.iter().sum::<f64>()));
            file.row(&row)?;
        }
        Ok(())
    })
}

/// Returns the sum of the values over the sectors of each scale.
pub fn by_scale(scales: &[usize], values: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; 1 + scales.iter().max().unwrap_or(&0)];
    for (&scale, value) in scales.iter().zip(values) {
        sums[scale] += value;
    }
    sums
}

/// Returns the energy (J) that each scale has received from each other scale, row by row; the row
/// is the receiver.
pub fn matrix_by_scale(scales: &[usize], transfers: &[f64]) -> Vec<f64> {
    let count = 1 + scales.iter().max().unwrap_or(&0);
    let mut sums = vec![0.0; count * count];
    for (&scale, given) in scales
        .iter()
        .zip(transfers.chunks_exact(scales.len().max(1)))
    {
        let row = sums.iter_mut().skip(scale * count);
        for (sum, given) in row.zip(by_scale(scales, given)) {
            *sum += given;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::{matrix_by_scale, milli};

    #[test]
    fn scales_sum_their_sectors() {
        // Seven links: the means, the first branching, and two second ones.
        let scales = [0, 1, 2, 2];
        let mut transfers = [0.0; 16];
        transfers[2 * 4 + 1] = 3.0;
        transfers[3 * 4 + 1] = 4.0;
        transfers[3 * 4] = 5.0;
        let sums = matrix_by_scale(&scales, &transfers);
        assert_eq!(sums, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 5.0, 7.0, 0.0]);
    }

    #[test]
    fn no_negative_zero_is_shown() {
        assert_eq!(milli(-1e-9), "0.000");
        assert_eq!(milli(-0.0125), "−12.500");
    }
}
