//! The progress of a run: a bar on a terminal, a line for each part on a
//! terminal that cannot go back, nothing elsewhere.

use std::io::{IsTerminal, Write};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::files::locked;

/// Steps of the bar in one part.
const STEPS: u64 = 1000;

/// The bar, as wide as the terminal.
const STYLE: &str = "{wide_bar} {percent:>3} %, {eta} left, {msg} ";

/// The progress of a run in parts; copies show the same.
#[derive(Clone, Debug)]
pub struct Progress {
    bar: ProgressBar,
    /// Steps done, with shares of one.
    done: Arc<Mutex<f64>>,
    /// Lines in place of a bar.
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
        // Hides itself where there is no terminal, or one without a cursor.
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

    /// Names the part that begins.
    pub fn begin(&self, what: &str) {
        self.bar.set_message(what.to_owned());
        if self.lines {
            let (done, parts) = (self.bar.position(), self.bar.length().unwrap_or(0));
            let (part, parts) = (done / STEPS + 1, parts / STEPS);
            let _ = writeln!(std::io::stderr(), "{what} ({part} of {parts})");
        }
    }

    /// Shows what has been reached beside the bar.
    pub fn tell(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// Shows that of the part `index` the share `share` is done, 0 to 1.
    pub fn within(&self, index: usize, share: f64) {
        let mut done = locked(&self.done);
        *done = STEPS as f64 * (index as f64 + share.clamp(0.0, 1.0));
        self.bar.set_position(done.round() as u64);
    }

    /// Shows that one part more is done.
    pub fn next(&self) {
        self.advance(1.0);
    }

    /// Shows that `parts` more are done; shares of parts add up to whole ones.
    pub fn advance(&self, parts: f64) {
        let mut done = locked(&self.done);
        *done += parts * STEPS as f64;
        self.bar.set_position(done.round() as u64);
    }

    /// Runs `work` with a clock that moves on: for parts of which nothing is
    /// known until they end.
    pub fn ticking<R>(&self, work: impl FnOnce() -> R) -> R {
        self.bar.enable_steady_tick(Duration::from_millis(200));
        let result = work();
        self.bar.disable_steady_tick();
        result
    }

    /// Takes the bar away for what `print` does.
    pub(super) fn suspend<R>(&self, print: impl FnOnce() -> R) -> R {
        self.bar.suspend(print)
    }

    /// Takes the bar away.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
