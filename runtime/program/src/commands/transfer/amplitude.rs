//! Errors of the forms of the energy transfer W against the amplitude of the differences, and the
//! cost of each form.

use branched_pendulum::analysis::truncation::{
    AlongTrajectories, Background, ErrorCurve, PhaseAverage, TreeForms, logarithmic,
};
use branched_pendulum::sectors::{Normalisation, Sectors};
use branched_pendulum::system::{State, SymmetricCoordinates};
use branched_pendulum::transfer::SymmetricTree;
use branched_pendulum_charts::{Axis, Chart, Panel, Series, verbatim};
use branched_pendulum_data::{Cell, Column};

use super::cost::Costs;
use super::{Arguments, FORMS};
use crate::Failure;
use crate::frame::Job;
use crate::subject::Subject;

/// Smallest and largest amplitude that is examined, in rad.
const AMPLITUDES: [f64; 2] = [1e-3, 1.5];

/// Number of amplitudes of the phase average, and of bins along trajectories.
const POINTS: usize = 45;

/// Number of initial disturbances, and their range in rad.
const RELEASES: usize = 49;
const DISTURBANCES: [f64; 2] = [1e-4, 1.0];

/// Duration (s) of the motion from which the range of the other coordinates is taken.
const BACKGROUND: f64 = 10.0;

/// Levels of the relative error that the table lists.
const LEVELS: [(&str, f64); 3] = [("1 %", 0.01), ("10 %", 0.1), ("100 %", 1.0)];

/// Range of the relative error in the chart; smaller errors are irrelevant.
const ERRORS: [f64; 2] = [1e-10, 1e1];

/// Computes the errors and costs of all forms and writes them.
///
/// # Errors
/// [`Failure::Truncation`]; [`Failure::Lacking`] if the start is not at rest.
pub(super) fn run(
    arguments: &Arguments,
    job: &Job,
    subject: &Subject,
    symmetric: &SymmetricTree<f64>,
    start: &State<f64>,
) -> Result<(), Failure> {
    job.has_no_time_charts("--against amplitude")?;
    let (theta, omega) = start.values.split_at(symmetric.links());
    if omega.iter().any(|rate| *rate != 0.0) {
        return Err(Failure::Lacking {
            what: "`--against amplitude` compares motions from rest: leave out `--rates`"
                .to_owned(),
        });
    }
    let forms = TreeForms {
        tree: symmetric,
        motion: SymmetricCoordinates(&subject.tree),
        forms: FORMS.to_vec(),
    };
    let mut release = vec![0.0; theta.len()];
    symmetric.symmetric_from_absolute(Normalisation::Plain, theta, &mut release);
    let average = PhaseAverage {
        amplitudes: logarithmic(AMPLITUDES, POINTS),
        states: arguments.states as usize,
        seed: arguments.seed,
        background: Background::visited(&forms, &release, BACKGROUND)?,
    };
    let trajectories = AlongTrajectories {
        release,
        disturbances: logarithmic(DISTURBANCES, RELEASES),
        duration: arguments.duration,
        sampling: arguments.rate,
        amplitudes: AMPLITUDES,
        bins: POINTS,
    };
    let progress = job.progress(3);
    progress.begin("phase average");
    let phase_average = progress.ticking(|| average.curves(&forms))?;
    progress.next();
    progress.begin("trajectories");
    let along = progress.ticking(|| trajectories.curves(&forms))?;
    progress.next();
    progress.begin("cost");
    let costs = Costs::measure(&forms, &average)?;
    progress.next();
    let is_asked = |curve: &ErrorCurve| match &arguments.into {
        Some(name) => curve.receiver == *name,
        None => true,
    };
    let curves = phase_average.into_iter().zip(along);
    let study = AmplitudeStudy {
        arguments,
        name: &subject.name,
        curves: curves.filter(|(average, _)| is_asked(average)).collect(),
        costs,
    };
    job.print(&study.text())?;
    study.write(job)?;
    job.chart("transfer", &study.chart())
}

/// Errors and costs of the forms of W, for one tree.
struct AmplitudeStudy<'a> {
    arguments: &'a Arguments,
    /// Name of the tree.
    name: &'a str,
    /// For each receiving sector, the error curves of the phase average and along motions.
    curves: Vec<(ErrorCurve, ErrorCurve)>,
    costs: Costs,
}

impl AmplitudeStudy<'_> {
    fn text(&self) -> String {
        let samples = self.curves.first().map_or(0, |(_, along)| {
            along.points.iter().map(|point| point.states).sum::<u64>()
        });
        let [low, high] = AMPLITUDES;
        let [least, most] = DISTURBANCES;
        let mut text = format!(
            "{}: W by each form.\n\
             Relative error: rms of (W − W exact) over rms of W exact.\n\
             Phase average: {} random states at each amplitude.\n\
             Trajectories: {RELEASES} disturbances from {least} to {most} rad, {} s each;\n\
             {samples} samples have an amplitude from {low} to {high} rad.\n",
            self.name, self.arguments.states, self.arguments.duration,
        );
        for (average, along) in &self.curves {
            text += &format!(
                "\nAmplitude, rad, at which the error of W into `{}` passes\n\n\
                 {:20}  {:^23}   {:>20}\n{:20}",
                average.receiver, "", "phase average", "along trajectories", "form",
            );
            for gap in ["", " "] {
                text.push_str(gap);
                for (level, _) in LEVELS {
                    text += &format!(" {level:>7}");
                }
                text.push(' ');
            }
            text.push_str("    cost\n");
            for (form, (name, ratio)) in average.forms.iter().zip(&self.costs.ratios).enumerate() {
                text += &format!("{:20}", name.to_string());
                for (gap, curve) in [("", average), (" ", along)] {
                    text.push_str(gap);
                    for (_, level) in LEVELS {
                        let crossing = curve.crossing(form, level);
                        let crossing =
                            crossing.map_or("-".to_owned(), |crossing| crossing.to_string());
                        text += &format!(" {crossing:>7}");
                    }
                    text.push(' ');
                }
                text += &format!(" {ratio:7.2}\n");
            }
        }
        text += &format!(
            "\nCost: time for one evaluation from coordinates and momenta of W into all sectors, over\n\
             that of the exact form, {:.0} ns here (median, one state after the other).\n",
            self.costs.exact_ns
        );
        text
    }

    fn write(&self, job: &Job) -> Result<(), Failure> {
        let mut columns = vec![
            Column::new("sector", ""),
            Column::new("average", ""),
            Column::new("amplitude", "rad"),
            Column::new("states", ""),
        ];
        let forms = self.curves.first().into_iter();
        let forms = forms.flat_map(|(average, _)| &average.forms);
        columns.extend(forms.map(|form| Column::new(format!("relative error {form}"), "")));
        job.csv("transfer.csv", &columns, |csv| {
            for (average, along) in &self.curves {
                for (kind, curve) in [("phase", average), ("trajectories", along)] {
                    for point in &curve.points {
                        let own = [Cell::from(curve.receiver.as_str()), Cell::from(kind)];
                        let numbers = [Cell::from(point.amplitude), Cell::from(point.states)];
                        let errors = point.errors.iter().map(Cell::from);
                        csv.row(own.into_iter().chain(numbers).chain(errors))?;
                    }
                }
            }
            Ok(())
        })
    }

    fn chart(&self) -> Chart {
        let panel = |name: &str, curve: &ErrorCurve| {
            let [low, high] = ERRORS;
            let receiver = verbatim(&curve.receiver);
            let axis = Axis::log(format!("{name}, into {receiver}")).range(low, high);
            let amplitudes: Vec<f64> = curve.points.iter().map(|point| point.amplitude).collect();
            let forms = curve.forms.iter().zip(&self.costs.ratios).enumerate();
            forms.fold(Panel::new(axis), |panel, (form, (name, cost))| {
                // Cost and error are in one table.
                let label = format!("{name}, cost {cost:.1}");
                panel.series(Series::line(label, &amplitudes, &curve.errors(form)))
            })
        };
        let [low, high] = AMPLITUDES;
        let axis = Axis::log("amplitude of the differences (rad)").range(low, high);
        let title = format!(
            "{}: relative error of W (rms over rms)",
            verbatim(self.name)
        );
        let panels = self.curves.iter();
        let panels = panels
            .flat_map(|(average, along)| [("phase average", average), ("trajectories", along)]);
        // A sector may take part in no motion.
        let panels: Vec<_> = panels
            .filter(|(_, curve)| !curve.points.is_empty())
            .collect();
        let height = 120.0 + 290.0 * panels.len() as f64;
        let chart = Chart::new(title, axis).size(900.0, height);
        panels.into_iter().fold(chart, |chart, (name, curve)| {
            chart.panel(panel(name, curve))
        })
    }
}
