//! Ctrl-C: what is finished stays, what is half written goes, and one line says
//! where the results are. A program that can end early does so instead, with the
//! results that it has.

#[cfg(unix)]
pub(super) fn watch(job: &super::Job) {
    use std::sync::Arc;

    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    use super::Ended;
    use super::files::locked;

    // Without a watcher, Ctrl-C ends the process as it does any other.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else {
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
        // A terminal that takes no text holds this lock; the line below waits for
        // the terminal as well, but no file does.
        if let Ok(progress) = progress.try_lock() {
            progress.clear();
        }
        let mut record = locked(&record);
        // Kept until the process has ended: no file begins or takes its name now.
        let mut ledger = locked(&ledger);
        let left = match record.close(&Ended::Interrupted, &mut ledger) {
            Ok(left) => left,
            Err(failure) => Some(super::messages(&failure).join(": ")),
        };
        let left = left.map_or(String::new(), |left| format!("; {left}"));
        super::say(&record.program, &format!("interrupted{left}"));
        std::process::exit(128 + signal)
    });
}

#[cfg(not(unix))]
pub(super) fn watch(_: &super::Job) {}
