//! Tables: sectors, closure of the budgets, who gave what to whom.

use branched_pendulum::analysis::SectorModes;
use branched_pendulum_data::Column;

use super::Release;
use super::run::{DEFINITIONS, Onset, PARSEVAL};
use super::scene::{Level, SECTORS, by_level, sectors};
use branched_pendulum_program::Failure;
use branched_pendulum_program::frame::Job;

/// Everything that is printed, as Markdown.
pub fn report(release: &Release, modes: &SectorModes, run: &Onset) -> String {
    let Release {
        duration,
        torque,
        frequency,
        difference,
        tolerance,
    } = release;
    let mut text = format!(
        "Fifteen rods, released from rest with differences of {difference} rad; torque\n\
         {torque} N m · cos(2π {frequency} Hz t) on the root; {duration} s, Dop853 at {tolerance:e}: \
         {} steps,\n{} evaluations.\n\n",
        run.account.accepted, run.account.evaluations
    );
    text.push_str(&sector_table(modes, run));
    text.push('\n');
    text.push_str(&matrix_table(run));
    text
}

/// Sectors with their sizes, frequencies and closures.
fn sector_table(modes: &SectorModes, run: &Onset) -> String {
    let mut text = format!(
        "Sectors: size, eigenfrequencies, and how well each budget closes, as the\n\
         largest |∫(W+P) dt − ΔE| over the largest energy of all sectors. Entries between\n\
         blocks: {:.0e} of the mass matrix, {:.0e} of the stiffness matrix.\n\n",
        modes.mass_off_block, modes.stiffness_off_block
    );
    text.push_str("| sector | size | frequencies (Hz) |");
    for name in DEFINITIONS {
        text += &format!(" {name} |");
    }
    text.push_str("\n|---|---|---|---|---|---|---|\n");
    let closures: [_; DEFINITIONS.len()] = std::array::from_fn(|index| run.closure(index));
    for (sector, block) in modes.blocks.iter().enumerate() {
        let frequencies = block.modes.frequencies_hz.iter();
        let frequencies: Vec<String> = frequencies.map(|f| format!("{f:.4}")).collect();
        text += &format!(
            "| `{}` | {} | {} |",
            block.name,
            block.coordinates.len(),
            frequencies.join(", ")
        );
        for closure in &closures {
            text += &format!(" {:.0e} |", closure[sector]);
        }
        text.push('\n');
    }
    text
}

/// The time-averaged transfer matrix, with the power of friction and drive.
fn matrix_table(run: &Onset) -> String {
    let Some(last) = run.samples.last() else {
        return String::new();
    };
    let mut text =
        "Mean transfer matrix (mW), energies by Parseval: what the sector of the column\n\
        gave that of the row; then the mean power of friction and drive and the mean\n\
        rate of its energy.\n\n|  |"
            .to_owned();
    for sector in sectors() {
        text += &format!(" `{}` |", sector.name());
    }
    text.push_str(" friction, drive | dE/dt |\n|---|");
    text.push_str(&"---:|".repeat(SECTORS + 2));
    text.push('\n');
    let mean = |energy: f64| milli(energy / last.time);
    for (row, sector) in sectors().iter().enumerate() {
        text += &format!("| `{}` |", sector.name());
        for column in 0..SECTORS {
            let cell = if column == row {
                "–".to_owned()
            } else {
                mean(last.transfers[row][column])
            };
            text += &format!(" {cell} |");
        }
        let gained = last.flowed[PARSEVAL][row];
        text += &format!(" {} | {} |\n", mean(last.power[row]), mean(gained));
    }
    text
}

/// A power in mW to three decimals; none is shown without a minus sign.
fn milli(watts: f64) -> String {
    let text = format!("{:.3}", 1e3 * watts);
    if text == "-0.000" {
        "0.000".to_owned()
    } else {
        text.replace('-', "−")
    }
}

/// Writes energies by Parseval, what friction and drive gave, and what each
/// level got from the others, as CSV.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write_samples(job: &Job, run: &Onset) -> Result<(), Failure> {
    let mut columns = vec![Column::new("time", "s")];
    for quantity in ["energy", "given by friction and drive", "given by sectors"] {
        let names = sectors().iter().map(|sector| sector.name());
        columns.extend(names.map(|name| Column::new(format!("{quantity} {name}"), "J")));
    }
    job.csv("onset.csv", &columns, |file| {
        for sample in &run.samples {
            let mut row = vec![sample.time];
            row.extend(sample.energies[PARSEVAL]);
            row.extend(sample.power);
            let given = sample.transfers.iter();
            row.extend(given.map(|given| given.iter().sum::<f64>()));
            file.row(&row)?;
        }
        Ok(())
    })
}

/// Energy that each level has given each other one by the end: rows receive,
/// J, in the order of [`Level::ALL`].
pub fn level_matrix(transfers: &[[f64; SECTORS]; SECTORS]) -> [[f64; 4]; 4] {
    let mut sums = [[0.0; 4]; 4];
    for (row, given) in transfers.iter().enumerate() {
        let given = by_level(given);
        for (sum, given) in sums[Level::of(row) as usize].iter_mut().zip(given) {
            *sum += given;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::{level_matrix, milli};
    use crate::cascade::onset::scene::SECTORS;

    #[test]
    fn levels_sum_their_sectors() {
        let mut transfers = [[0.0; SECTORS]; SECTORS];
        // The sectors of one half of the tree follow each other: 2 and 5 part
        // at the second branchings.
        transfers[2][1] = 3.0;
        transfers[5][1] = 4.0;
        transfers[7][0] = 5.0;
        let levels = level_matrix(&transfers);
        assert_eq!(levels[2], [0.0, 7.0, 0.0, 0.0]);
        assert_eq!(levels[3], [5.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn no_negative_zero_is_shown() {
        assert_eq!(milli(-1e-9), "0.000");
        assert_eq!(milli(-0.0125), "−12.500");
    }
}
