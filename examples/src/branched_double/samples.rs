//! Samples as CSV, one file for each initial angle.

use branched_pendulum_data::Column;

use super::apparatus::{FORMS, Sample};
use super::experiment::Run;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Writes the samples of a run.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write(job: &Job, run: &Run) -> Result<(), Failure> {
    let name = format!("samples-{:?}deg.csv", run.angle_deg);
    job.csv(&name, &columns(), |file| {
        let mut samples = run.samples.iter();
        samples.try_for_each(|sample| file.row(row(sample)))
    })
}

/// Returns the columns of the file, in the order of [`row`].
fn columns() -> Vec<Column> {
    let mut columns = vec![Column::new("time", "s")];
    let mut add = |names: &[&str], unit: &str| {
        columns.extend(names.iter().map(|name| Column::new(*name, unit)));
    };
    add(
        &["theta_1", "theta_2", "theta_3", "theta_m", "theta_d"],
        "rad",
    );
    add(
        &["omega_1", "omega_2", "omega_3", "omega_m", "omega_d"],
        "rad/s",
    );
    add(&["p_1", "p_m", "p_d"], "kg m^2/s");
    add(&["H_d", "H"], "J");
    for form in FORMS {
        let form = form.replace(' ', "_");
        for part in ["W_K", "W_P", "W"] {
            add(&[&format!("{part}_{form}")], "W");
        }
    }
    add(&["friction_power_on_H_d", "friction_power"], "W");
    columns
}

fn row(sample: &Sample) -> Vec<f64> {
    let Sample {
        time,
        theta,
        omega,
        coordinates: [_, theta_m, theta_d],
        rates: [_, omega_m, omega_d],
        momenta,
        antiphase_energy,
        energy,
        flow,
    } = sample;
    let mut row = vec![*time];
    row.extend(theta);
    row.extend([theta_m, theta_d]);
    row.extend(omega);
    row.extend([omega_m, omega_d]);
    row.extend(momenta);
    row.extend([antiphase_energy, energy]);
    for transfer in flow.transfer {
        row.extend([transfer.kinetic, transfer.potential, transfer.total()]);
    }
    row.extend([flow.antiphase_friction, flow.friction]);
    row
}

#[cfg(test)]
mod tests {
    use super::{columns, row};
    use crate::branched_double::{Apparatus, Friction};

    #[test]
    fn every_column_has_its_value() {
        let apparatus = Apparatus::new(Friction {
            root: 1e-3,
            children: 2e-3,
        })
        .unwrap();
        let sample = apparatus.measure(0.5, [0.3, 0.2, 0.1], [1.0, 2.0, 3.0]);
        let (columns, row) = (columns(), row(&sample));
        assert_eq!(columns.len(), row.len());
        let value = |name: &str| {
            let column = columns.iter().position(|column| column.name == name);
            row[column.unwrap()]
        };
        assert_eq!(value("time"), 0.5);
        assert_eq!(value("theta_2"), 0.2 + 0.1);
        assert_eq!(value("omega_3"), 2.0 - 3.0);
        assert_eq!(value("omega_d"), 3.0);
        assert_eq!(value("p_d"), sample.momenta[2]);
        assert_eq!(value("H"), sample.energy);
        assert_eq!(value("W_P_exact"), sample.flow.transfer[2].potential);
        assert_eq!(value("W_angle_1"), sample.flow.transfer[0].total());
        assert_eq!(value("friction_power"), sample.flow.friction);
    }
}
