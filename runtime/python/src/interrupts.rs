//! Native work that signals of Python, such as Ctrl-C, can interrupt.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use branched_pendulum::interruption::{Interrupted, interruptible};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;

/// Interval at which pending signals are checked.
const CHECK_INTERVAL: Duration = Duration::from_millis(20);

/// Time for which an interrupted thread is waited for until it ends.
const PATIENCE: Duration = Duration::from_millis(100);

/// Stack size of a separate thread, in bytes; the same as for a main thread.
const STACK: usize = 8 << 20;

/// Runs work on this thread without Python's global lock. The work must check between its steps if
/// it was interrupted (`interruption::look`).
///
/// # Errors
/// The exception that the handler of a signal has raised.
pub(crate) fn detached<R: Send>(py: Python<'_>, work: impl FnOnce() -> R + Send) -> PyResult<R> {
    let raised = Arc::new(Mutex::new(None));
    let kept = raised.clone();
    let is_interrupted = move || {
        let signals = Python::attach(|py| py.check_signals());
        signals
            .map_err(|error| *kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(error))
            .is_err()
    };
    let outcome = py.detach(|| interruptible(is_interrupted, work));
    outcome.map_err(|Interrupted| {
        let error = raised.lock().unwrap_or_else(PoisonError::into_inner).take();
        error.unwrap_or_else(|| PyKeyboardInterrupt::new_err(()))
    })
}

type Outcome<R> = Result<Result<R, Interrupted>, Box<dyn Any + Send>>;

/// Runs work on a separate thread, for work that includes parts (of other libraries) that cannot be
/// interrupted. If it does not end soon after a signal, it is abandoned, and ends after that part.
/// In Pyodide, which has no threads, the work runs on this one.
///
/// # Errors
/// The exception that the handler of a signal has raised, or an error if no thread could be
/// started.
pub(crate) fn on_own_thread<R: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> R + Send + 'static,
) -> PyResult<R> {
    if cfg!(target_os = "emscripten") {
        return detached(py, work);
    }
    let (sender, mut receiver) = channel();
    let is_left = Arc::new(AtomicBool::new(false));
    let is_over = is_left.clone();
    let job = move || {
        let is_over = move || is_over.load(Ordering::Relaxed);
        let outcome = catch_unwind(AssertUnwindSafe(|| interruptible(is_over, work)));
        // An error means that nobody waits any more.
        drop(sender.send(outcome));
    };
    thread::Builder::new().stack_size(STACK).spawn(job)?;
    loop {
        let received;
        (receiver, received) = wait(py, receiver, CHECK_INTERVAL);
        match received {
            Ok(Ok(Ok(result))) => return Ok(result),
            Ok(Err(panic)) => resume_unwind(panic),
            Ok(Ok(Err(_))) | Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(
                    "the computation ended without a result",
                ));
            }
            Err(RecvTimeoutError::Timeout) => {
                if let Err(error) = py.check_signals() {
                    is_left.store(true, Ordering::Relaxed);
                    drop(wait(py, receiver, PATIENCE));
                    return Err(error);
                }
            }
        }
    }
}

fn wait<R: Send>(
    py: Python<'_>,
    receiver: Receiver<Outcome<R>>,
    time: Duration,
) -> (Receiver<Outcome<R>>, Result<Outcome<R>, RecvTimeoutError>) {
    py.detach(move || {
        let received = receiver.recv_timeout(time);
        (receiver, received)
    })
}
