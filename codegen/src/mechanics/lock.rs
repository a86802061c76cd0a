//! One derivation at a time for each user.
//!
//! Symbolica keeps the permit of its free mode in the user's cache folder and
//! aborts the process that finds it taken. The lock of derivations is therefore
//! kept in the same folder: builds share it exactly where they share the permit,
//! whatever their folders for temporary files are.

use std::fmt;
use std::fs::{File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use directories::BaseDirs;

/// Environment variable with the longest time to wait for one derivation, in seconds.
const WAIT_VARIABLE: &str = "BRANCHED_PENDULUM_WAIT";

/// Longest time to wait for one derivation where the variable is not set.
const WAIT: Duration = Duration::from_secs(120);

/// Time after which a waiting process says for whom it waits.
const NOTICE: Duration = Duration::from_secs(2);

/// Time between two attempts.
const PAUSE: Duration = Duration::from_millis(20);

/// Reason for which a derivation could not be kept apart from others.
#[derive(Debug)]
#[non_exhaustive]
pub enum LockError {
    /// The user has no home folder, and so no cache folder.
    NoHome,
    /// The lock file cannot be written or locked.
    File {
        /// Path of the file.
        path: PathBuf,
        /// Reason given by the system.
        source: io::Error,
    },
    /// Another process has held the lock for longer than the limit.
    Held {
        /// Process that holds it, as it described itself.
        holder: String,
        /// Limit, in seconds.
        seconds: u64,
    },
}

impl fmt::Display for LockError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoHome => f.write_str(
                "derivations of one user are kept apart by a lock in the user's cache folder, \
                 but no home folder is known: set HOME to a folder that can be written",
            ),
            Self::File { path, source } => write!(
                f,
                "cannot write and lock `{}`, which keeps derivations of one user apart \
                 ({source}): set HOME, or XDG_CACHE_HOME, to a folder that can be written",
                path.display()
            ),
            Self::Held { holder, seconds } => write!(
                f,
                "{holder} has been deriving for more than {seconds} s, and one user can derive \
                 once at a time: end it if it is suspended, or wait longer with \
                 {WAIT_VARIABLE}=<seconds>"
            ),
        }
    }
}

impl std::error::Error for LockError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        // The system's reason is part of the message.
        None
    }
}

/// Lock of the derivation that runs. Dropping it, or the end of the process,
/// unlocks it.
#[derive(Debug)]
pub(super) struct DerivationLock {
    _file: File,
}

impl DerivationLock {
    /// Waits for derivations of the same user in other processes, and for those of
    /// other threads.
    pub(super) fn acquire() -> Result<Self, LockError> {
        let folder = BaseDirs::new().ok_or(LockError::NoHome)?;
        let folder = folder.cache_dir().join("branched-pendulum");
        let path = folder.join("derivation.lock");
        let failed = |source| LockError::File {
            path: path.clone(),
            source,
        };
        std::fs::create_dir_all(&folder).map_err(failed)?;
        let file = open(&path).map_err(failed)?;
        // Beside the lock file: some systems let nobody read a locked file.
        let note = folder.join("derivation.holder");
        let mut waiting = Waiting::new();
        loop {
            match file.try_lock() {
                Ok(()) => break,
                Err(TryLockError::WouldBlock) => waiting.pause(&note)?,
                Err(TryLockError::Error(source)) => return Err(failed(source)),
            }
        }
        // Waiting processes can do without it.
        let _ = std::fs::write(&note, description());
        Ok(Self { _file: file })
    }
}

fn open(path: &Path) -> io::Result<File> {
    OpenOptions::new()
        .create(true)
        .truncate(false)
        .write(true)
        .open(path)
}

/// Description of this process for those that wait for it, and a second line that tells its
/// derivations apart.
fn description() -> String {
    let id = std::process::id();
    let begun = SystemTime::now().duration_since(UNIX_EPOCH);
    let begun = begun.unwrap_or_default().as_nanos();
    match std::env::var("CARGO_PKG_NAME") {
        Ok(package) => format!("process {id} (package `{package}`)\n{begun}"),
        Err(_) => format!("process {id}\n{begun}"),
    }
}

/// A process that waits for others.
struct Waiting {
    start: Instant,
    /// Description of the derivation that runs.
    holder: String,
    /// Time since which it has been seen.
    since: Instant,
    limit: Duration,
    noticed: bool,
}

impl Waiting {
    fn new() -> Self {
        let seconds = std::env::var(WAIT_VARIABLE).ok();
        let seconds = seconds.and_then(|text| text.trim().parse().ok());
        let start = Instant::now();
        Self {
            start,
            holder: String::new(),
            since: start,
            limit: seconds.map_or(WAIT, Duration::from_secs),
            noticed: false,
        }
    }

    /// Sleeps until the next attempt. Fails once one derivation took the limit: a process of
    /// many is not suspended.
    fn pause(&mut self, note: &Path) -> Result<(), LockError> {
        let holder = std::fs::read_to_string(note).unwrap_or_default();
        if holder != self.holder {
            (self.holder, self.since) = (holder, Instant::now());
        }
        let holder = self.holder.lines().next().unwrap_or("another process");
        if self.since.elapsed() > self.limit {
            return Err(LockError::Held {
                holder: holder.to_owned(),
                seconds: self.limit.as_secs(),
            });
        }
        if self.start.elapsed() > NOTICE && !self.noticed {
            self.noticed = true;
            eprintln!("branched-pendulum: waiting for the derivation of {holder}");
        }
        std::thread::sleep(PAUSE);
        Ok(())
    }
}
