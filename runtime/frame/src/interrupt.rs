//! Handling of Ctrl-C: complete files stay, incomplete ones are deleted, and a line of text states
//! where the results are. A program that can end early does so instead, and writes the results that
//! it has.

#[cfg(unix)]
pub(super) use unix::{register, watch};

#[cfg(unix)]
mod unix {
    use std::sync::Arc;

    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    use crate::files::locked;
    use crate::{Ended, Job, messages, say};

    /// Signals that arrive from now on; they wait until [`watch`] handles them. `None` if the system
    /// refuses: then a signal ends the process as usual.
    pub(crate) fn register() -> Option<Signals> {
        Signals::new([SIGINT, SIGTERM]).ok()
    }

    /// Handles signals on a thread until the process ends.
    pub(crate) fn watch(signals: Option<Signals>, job: &Job) {
        let Some(mut signals) = signals else {
            return;
        };
        let (record, ledger) = (Arc::clone(&job.record), Arc::clone(&job.ledger));
        let progress = Arc::clone(&job.progress);
        let interruption = Arc::clone(&job.interruption);
        std::thread::spawn(move || {
            let mut signals = signals.forever();
            let Some(signal) = signals.find(|signal| !interruption.leave(*signal)) else {
                return;
            };
            // A blocked terminal may hold this lock; the line below waits for the terminal as well,
            // but no file does.
            if let Ok(progress) = progress.try_lock() {
                progress.clear();
            }
            let mut record = locked(&record);
            // Holds the lock until the process ends, so that no file is started or renamed.
            let mut ledger = locked(&ledger);
            let left = match record.close(&Ended::Interrupted, &mut ledger) {
                Ok(left) => left,
                Err(failure) => Some(messages(&failure).join(": ")),
            };
            let left = left.map_or(String::new(), |left| format!("; {left}"));
            say(&record.program, &format!("interrupted{left}"));
            std::process::exit(128 + signal)
        });
    }
}

#[cfg(not(unix))]
pub(super) fn register() {}

#[cfg(not(unix))]
pub(super) fn watch((): (), _: &super::Job) {}
