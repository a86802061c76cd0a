//! Display of a run's progress: a bar on a terminal, a line for each part on a terminal without
//! cursor control, nothing otherwise.

use std::io::{IsTerminal, Write};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::files::locked;

/// Number of steps of the progress bar for one part of the run.
const STEPS: u64 = 1000;

/// Format of the progress bar, which is as wide as the terminal.
const STYLE: &str = "{wide_bar} {percent:>3} %, {eta} left, {msg} ";

/// Progress of a run in several parts. All copies of this value show the same bar.
#[derive(Clone, Debug)]
pub struct Progress {
    bar: ProgressBar,
    /// Number of completed parts of the run, including the completed fraction of the current part.
    done: Arc<Mutex<f64>>,
    /// True if lines are printed instead of a bar.
    lines: bool,
}

impl Default for Progress {
    fn default() -> Self {
        Self {
            bar: ProgressBar::hidden(),
            done: Arc::default(),
            lines: false,
        }
    }
}

impl Progress {
    pub(super) fn new(parts: usize) -> Self {
        // Hides itself if there is no terminal, or one without a cursor.
        let target = ProgressDrawTarget::stderr_with_hz(10);
        let lines = target.is_hidden() && std::io::stderr().is_terminal();
        let bar = ProgressBar::with_draw_target(Some(STEPS * parts as u64), target);
        if let Ok(style) = ProgressStyle::with_template(STYLE) {
            bar.set_style(style.progress_chars("█▌░"));
        }
        Self {
            bar,
            done: Arc::default(),
            lines,
        }
    }

    /// Shows the name of the part that begins now.
    pub fn begin(&self, what: &str) {
        self.bar.set_message(what.to_owned());
        if self.lines {
            let (done, parts) = (self.bar.position(), self.bar.length().unwrap_or(0));
            let (part, parts) = (done / STEPS + 1, parts / STEPS);
            let _ = writeln!(std::io::stderr(), "{what} ({part} of {parts})");
        }
    }

    /// Shows a message about the present result next to the progress bar.
    pub fn show_message(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// Shows that the fraction `share` (0 to 1) of part number `index` is completed.
    pub fn within(&self, index: usize, share: f64) {
        let mut done = locked(&self.done);
        *done = STEPS as f64 * (index as f64 + share.clamp(0.0, 1.0));
        self.bar.set_position(done.round() as u64);
    }

    /// Shows that one more part is completed.
    pub fn next(&self) {
        self.advance(1.0);
    }

    /// Shows that `parts` more parts are completed; fractions of parts add up.
    pub fn advance(&self, parts: f64) {
        let mut done = locked(&self.done);
        *done += parts * STEPS as f64;
        self.bar.set_position(done.round() as u64);
    }

    /// Runs `work` while the bar shows the elapsed time, for parts whose progress is unknown.
    pub fn ticking<R>(&self, work: impl FnOnce() -> R) -> R {
        self.bar.enable_steady_tick(Duration::from_millis(200));
        let result = work();
        self.bar.disable_steady_tick();
        result
    }

    /// Hides the progress bar while `print` runs.
    pub(super) fn suspend<R>(&self, print: impl FnOnce() -> R) -> R {
        self.bar.suspend(print)
    }

    /// Removes the bar.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
