//! The program `advise`: finds the cheapest combination of model, method, tolerance or step and
//! scalar type that is right.
//!
//! [`branched_pendulum_advice`] measures; these modules add scenes and the chart of accuracy
//! against cost.
//!
//! - [`arguments`]: the command line,
//! - [`scenes`]: the trees, in all their forms,
//! - [`requests`]: a scene for the advisor,
//! - [`chart`]: accuracy against cost,
//! - [`audit`]: the choices of twelve questions compared with all other candidates.

pub mod arguments;
pub mod audit;
pub mod chart;
pub mod requests;
pub mod scenes;

use branched_pendulum_advice::Advice;
use branched_pendulum_data::{Cell, Column};

pub use arguments::Arguments;
pub use requests::SceneName;

use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Runs the advisor, or draws the chart.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    if arguments.chart {
        return chart::draw(arguments, job);
    }
    if arguments.audit {
        return audit::run(job);
    }
    let progress = job.progress(1);
    progress.begin(arguments.scene.title());
    let advice = progress.ticking(|| {
        requests::with(&arguments.question(), |advisor, candidates| {
            advisor.advise(candidates)
        })
    })?;
    progress.next();
    job.print(&format!("{}\n\n{advice}", arguments.scene.title()))?;
    if let Some(chosen) = advice.chosen() {
        job.report("choice", advice.describe(chosen));
        job.report("error over tolerance", chosen.ratio());
        job.report("seconds", chosen.seconds);
    }
    let columns = Advice::COLUMNS.map(|(name, unit)| Column::new(name, unit));
    job.csv("advice.csv", &columns, |csv| {
        advice.rows::<Cell<'_>>().try_for_each(|row| csv.row(row))
    })
}
