//! How wrong is each form of the energy transfer W, at which amplitude of what
//! it takes for small, and what does each form cost?
//!
//! For any tree whose description asks for several forms: the errors are those
//! of [`analysis::truncation`](branched_pendulum::analysis::truncation).
//!
//! - [`arguments`]: the command line,
//! - [`scenes`]: the trees looked at; the place for one more,
//! - [`study`]: errors and costs of one tree,
//! - [`cost`]: time for one evaluation,
//! - [`output`]: how it is shown.

pub mod arguments;
pub mod cost;
pub mod output;
pub mod scenes;
pub mod study;

pub use arguments::Arguments;
pub use cost::Costs;
pub use scenes::Arms;
pub use study::{Settings, Study};

use crate::scenes::BranchedDouble;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Studies all trees; prints and writes what one gives before the next begins.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let progress = job.progress(2 * study::PARTS);
    let paper = Study::of(
        &BranchedDouble::new(),
        scenes::apparatus(arguments.states as usize)?.seeded(arguments.seed),
        &progress,
    )?;
    output::deliver(job, &paper)?;
    let arms = scenes::arms(arguments.states as usize)?.seeded(arguments.seed);
    let arms = Study::of(&Arms::new(), arms, &progress)?;
    output::deliver(job, &arms)
}
