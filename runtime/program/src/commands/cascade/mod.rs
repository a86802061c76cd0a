//! Energy cascade in a tree with a driven root and friction: does energy flow down the generations,
//! and how much energy does each scale have?
//!
//! - [`arguments`]: the command line, [`tree`]: the tree and its scales, [`motor`]: the torque,
//! - [`motion`]: all starts, in lanes, window by window, with checkpoints, [`budgets`]: budgets of
//!   states, and sums of them,
//! - [`density`]: histograms of the fluxes, [`structure`]: moments of the amplitudes,
//! - [`equilibrium`]: the same energy without motor and friction,
//! - [`findings`]: averages with errors, [`balance`]: check of the integration, [`report`]: tables,
//!   [`charts`]: charts and a film,
//! - [`compare`]: comparison of several runs, `laws`: exponents of their spectra,
//! - [`onset`]: a tree, sector by sector, from a release almost in phase.

pub mod arguments;
pub mod balance;
pub mod budgets;
pub mod charts;
pub mod compare;
pub mod density;
pub mod equilibrium;
pub mod findings;
mod laws;
pub mod motion;
pub mod motor;
pub mod onset;
pub mod report;
pub mod structure;
pub mod tree;

pub use arguments::Arguments;
pub use balance::Balance;
pub use findings::Findings;

use crate::Failure;
use crate::frame::{Checkpoint, Job, sweep};
use equilibrium::Equilibrium;
use motion::{Followed, film, follow};
use tree::DrivenTree;

/// Number of pictures of the film, and time between two of them, in s.
const FRAMES: usize = 160;
const INTERVAL: f64 = 0.05;

/// Integrates all starts, or those of a shard, or reads the results of all shards; then writes the
/// combined results.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    if !arguments.compare.is_empty() {
        job.has_no_time_charts("--compare")?;
        return compare::run(&arguments.compare, job);
    }
    let subject = arguments.read()?;
    subject.record(job)?;
    if let Some(duration) = arguments.onset {
        let release = onset::Release {
            duration,
            torque: arguments.torque(&subject),
            frequency: arguments.frequency,
            ..onset::Release::new(arguments.start(&subject)?)
        };
        return onset::run(&release, &subject, job);
    }
    let driven = DrivenTree::new(subject)?;
    let count = arguments.starts as usize;
    let starts = sweep::results(job, arguments.sharding, count, |items| {
        follow(arguments, &driven, job, items)
    })?;
    if let Some(starts) = starts {
        write(arguments, &driven, &starts, job)?;
    }
    Checkpoint::new(job, 0.0).discard();
    Ok(())
}

/// Writes the combined results of all starts.
fn write(
    arguments: &Arguments,
    driven: &DrivenTree,
    starts: &[Followed],
    job: &Job,
) -> Result<(), Failure> {
    let findings = Findings::new(driven, starts);
    let equilibrium = match arguments.equilibrium {
        true => Some(Equilibrium::at(arguments, driven, findings.energy(), job)?),
        false => None,
    };
    let equilibrium = equilibrium.as_ref();
    report::write_windows(job, arguments, driven.generations(), starts)?;
    report::write_scales(job, driven, &findings, equilibrium)?;
    let mut text = report::report(arguments, driven, starts, &findings);
    if let Some(equilibrium) = equilibrium {
        text.push_str(&report::equilibrium(driven, &findings, equilibrium));
    }
    job.print(&text)?;
    job.write("report.md", text.as_bytes())?;
    // A tree that hangs still has nothing to show.
    if findings.course.iter().flatten().any(|energy| *energy > 0.0) {
        job.chart_over_time("course", &charts::energy_history(arguments, &findings))?;
        if let Some(chart) = charts::scales(arguments, driven, &findings, equilibrium) {
            job.chart("scales", &chart)?;
        }
        job.chart("densities", &charts::densities(&findings))?;
    }
    if let Some(first) = starts.first() {
        let (states, interval) = film(arguments, driven, first, FRAMES, INTERVAL)?;
        let film = charts::film(driven, &states, interval)?;
        job.write("tree.svg", film.to_svg()?.as_bytes())?;
    }
    job.report("steady", findings.is_steady());
    job.report("balanced", findings.balance() == Balance::Closed);
    Ok(())
}
