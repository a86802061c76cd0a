//! A lock that allows one derivation at a time per user.
//!
//! Symbolica keeps the permit of its free mode in the user's cache folder and aborts a process that
//! finds it taken. The lock is kept in the same folder, so that builds share the lock exactly if
//! they share the permit, independent of their folders for temporary files.

use std::fmt;
use std::fs::{File, TryLockError};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use crate::owned;
use crate::user_folder::{UserFolder, user_folder};

/// Environment variable that sets the longest time to wait for another derivation, in seconds.
const WAIT_VARIABLE: &str = "BRANCHED_PENDULUM_WAIT";

/// Longest time to wait for another derivation if the variable is not set.
const WAIT: Duration = Duration::from_secs(120);

/// Time after which a waiting process prints which process it waits for.
const NOTICE: Duration = Duration::from_secs(2);

/// Time between two attempts to take the lock.
const PAUSE: Duration = Duration::from_millis(20);

/// Reason why the lock of derivations could not be taken.
#[derive(Debug)]
#[non_exhaustive]
pub enum LockError {
    /// The user has no home folder, and so no cache folder.
    NoHome,
    /// The lock file cannot be written or locked.
    File {
        /// Path of the file.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// Another process has held the lock for longer than the limit.
    Held {
        /// Description of the process that holds the lock, written by that process.
        holder: String,
        /// Longest time to wait, in seconds.
        seconds: u64,
    },
}

impl fmt::Display for LockError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoHome => f.write_str(
                "no home folder is known for the lock that separates derivations of one user: \
                 set HOME to a folder that can be written",
            ),
            Self::File { path, source } => write!(
                f,
                "cannot write and lock `{}`, the lock that separates derivations of one user \
                 ({source}): set HOME, or XDG_CACHE_HOME, to a folder that can be written",
                path.display()
            ),
            Self::Held { holder, seconds } => write!(
                f,
                "{holder} has been deriving for more than {seconds} s, and each user can run only \
                 one derivation at a time: end it if it is suspended, or wait longer with \
                 {WAIT_VARIABLE}=<seconds>"
            ),
        }
    }
}

impl std::error::Error for LockError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        // The operating system's error is part of the message.
        None
    }
}

/// The held lock. Dropping it, or the end of the process, releases it.
#[derive(Debug)]
pub(super) struct DerivationLock {
    _file: File,
    /// Cache folder that is used if the user's home folder does not exist.
    pub(super) cache: Option<PathBuf>,
}

impl DerivationLock {
    /// Takes the lock; waits for derivations in other processes of the same user and in other
    /// threads.
    pub(super) fn acquire() -> Result<Self, LockError> {
        let (cache, replaced) = match user_folder() {
            UserFolder::Cache(folder) => (folder, None),
            UserFolder::Homeless => {
                let folder = temporary_cache()?;
                (folder.clone(), Some(folder))
            }
            UserFolder::Unknown => return Err(LockError::NoHome),
        };
        let folder = cache.join("branched-pendulum");
        let path = folder.join("derivation.lock");
        let failed = |source| LockError::File {
            path: path.clone(),
            source,
        };
        std::fs::create_dir_all(&folder).map_err(failed)?;
        let file = open(&path).map_err(failed)?;
        // A separate file: on some systems a locked file cannot be read.
        let note = folder.join("derivation.holder");
        let mut waiting = Waiting::new();
        loop {
            match file.try_lock() {
                Ok(()) => break,
                Err(TryLockError::WouldBlock) => waiting.pause(&note)?,
                Err(TryLockError::Error(source)) => return Err(failed(source)),
            }
        }
        let part = folder.join(format!(".derivation.holder.{}", std::process::id()));
        // Ignored: waiting processes need it only for their message.
        let _ = owned::install(
            &part,
            &note,
            |note| read_note(note).is_some(),
            |file| file.write_all(description().as_bytes()),
        );
        Ok(Self {
            _file: file,
            cache: replaced,
        })
    }
}

/// Creates a cache folder among the temporary files, for a user whose home folder does not exist.
fn temporary_cache() -> Result<PathBuf, LockError> {
    #[cfg(unix)]
    let user = rustix::process::geteuid().as_raw();
    #[cfg(not(unix))]
    let user = 0;
    let path = std::env::temp_dir().join(format!("branched-pendulum-{user}"));
    let failed = |source| LockError::File {
        path: path.clone(),
        source,
    };
    owned::create_folder(&path).map_err(failed)?;
    let data = std::fs::symlink_metadata(&path).map_err(failed)?;
    match data.is_dir() && owned::is_private(&data) {
        true => Ok(path),
        false => Err(failed(io::Error::other("another user may write there"))),
    }
}

/// Opens the lock file, which is always empty, or creates it.
fn open(path: &Path) -> io::Result<File> {
    loop {
        match owned::open(path, true) {
            Ok(file) if file.metadata()?.len() == 0 => return Ok(file),
            Ok(_) => return Err(io::Error::other("the compiler did not write this file")),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
        match owned::create(path) {
            // Another process was faster.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            created => return created,
        }
    }
}

/// Longest description of a process, in bytes.
const MOST_NOTE: u64 = 4096;

/// Reads the description of a process; returns `None` for a file that this crate did not write.
fn read_note(path: &Path) -> Option<String> {
    let mut text = String::new();
    let file = owned::open(path, false).ok()?;
    file.take(MOST_NOTE).read_to_string(&mut text).ok()?;
    text.starts_with("process ").then_some(text)
}

/// Describes this process, for other processes that wait for it. A second line distinguishes
/// several derivations of one process.
fn description() -> String {
    let id = std::process::id();
    let begun = SystemTime::now().duration_since(UNIX_EPOCH);
    let begun = begun.unwrap_or_default().as_nanos();
    match std::env::var("CARGO_PKG_NAME") {
        Ok(package) => format!("process {id} (package `{package}`)\n{begun}"),
        Err(_) => format!("process {id}\n{begun}"),
    }
}

/// State of a process that waits for another derivation.
struct Waiting {
    start: Instant,
    /// Description of the current derivation.
    holder: String,
    /// Time at which that derivation was first seen.
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

    /// Sleeps until the next attempt. Fails once a single derivation has exceeded the limit;
    /// several short ones, one after the other, do not count together.
    fn pause(&mut self, note: &Path) -> Result<(), LockError> {
        let holder = read_note(note).unwrap_or_default();
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
