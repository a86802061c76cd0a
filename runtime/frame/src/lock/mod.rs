//! Lock of a folder of results, so that the files of two runs never mix.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, TryLockError};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::owned::{self, Created, part_name, part_stamp};
use crate::failure::Failure;

/// Name of the file that a run keeps locked until it has ended.
const LOCK: &str = ".running";

/// First line of every lock file.
const HEADER: &str = "branched-pendulum run 1\n";

/// Length of a new lock file. The unused bytes are released if the disk is full when the record is written.
const RESERVE: usize = 1 << 14;

/// Digests of files by name: each is the SHA-256 of a content that a run has written under that name.
pub(super) type KnownDigests = BTreeMap<String, BTreeSet<String>>;

/// Exclusive right to write into a folder. The system releases it when the process ends, for any reason.
#[derive(Debug)]
pub(super) struct FolderLock {
    path: PathBuf,
    /// The open lock file; `None` if the file system has no locks.
    file: Option<File>,
    /// Length in bytes of the lines that identify the run.
    head: u64,
    /// Random name of this run, which is part of the names of its temporary files.
    pub(super) stamp: String,
    /// Files that a killed run had completed.
    pub(super) finished: KnownDigests,
}

/// Content of a lock file: the run that holds the lock, and the files that it has completed.
struct Journal {
    stamp: String,
    /// Program and process in brackets.
    holder: String,
    finished: KnownDigests,
}

impl Journal {
    /// Parses a lock file; returns `None` if it was not written by this project.
    fn parse(text: &str) -> Option<Self> {
        let mut lines = text.strip_prefix(HEADER)?.lines();
        let stamp = lines.next()?.strip_prefix("stamp ")?.to_owned();
        let holder = lines.next()?.strip_prefix("holder")?.to_owned();
        let mut finished = KnownDigests::new();
        // The last line is cut off if the run was killed while writing it.
        for line in lines {
            let entry = line.strip_prefix("file ");
            if let Some((digest, name)) = entry.and_then(|entry| entry.split_once(' ')) {
                let digests = finished.entry(name.to_owned()).or_default();
                digests.insert(digest.to_owned());
            }
        }
        Some(Self {
            stamp,
            holder,
            finished,
        })
    }

    /// Returns the lines of a lock file that identify the run.
    fn head(&self) -> String {
        let Self { stamp, holder, .. } = self;
        format!("{HEADER}stamp {stamp}\nholder{holder}\n")
    }

    fn text(&self) -> String {
        let mut text = self.head();
        let spaces = RESERVE.saturating_sub(text.len() + 1);
        text.extend(std::iter::repeat_n(' ', spaces));
        text.push('\n');
        for (name, digests) in &self.finished {
            for digest in digests {
                text.push_str(&entry(name, digest));
            }
        }
        text
    }
}

/// Returns the line of a lock file for a completed file.
pub(super) fn entry(name: &str, digest: &str) -> String {
    format!("file {digest} {name}\n")
}

/// State of the lock file of a folder.
enum Found {
    /// There is no lock file, or its run has just ended.
    Nothing,
    /// A killed run has left the lock file; this process has locked it now.
    Left(File, Journal),
    /// Another run holds it.
    Held(String),
    /// The file system does not support locks.
    NoLocks,
}

impl FolderLock {
    /// Locks the folder for `program`, and removes temporary files that a killed run has left.
    ///
    /// # Errors
    /// [`Failure::Busy`] if another run has locked the folder; [`Failure::File`], also if a file
    /// with the name of the lock was not written by this project.
    pub(super) fn take(folder: &Path, program: &str) -> Result<Self, Failure> {
        let path = folder.join(LOCK);
        let failed = |source| Failure::File {
            path: folder.join(LOCK),
            source,
        };
        let without_locks = || {
            let shown = folder.display();
            super::say(
                program,
                &format!("the file system of {shown} has no locks: let no other run write there"),
            );
        };
        loop {
            let left = match examine(&path).map_err(failed)? {
                Found::Nothing => None,
                Found::Left(file, journal) => Some((file, journal)),
                Found::Held(holder) => {
                    return Err(Failure::Busy {
                        folder: folder.to_path_buf(),
                        holder,
                    });
                }
                Found::NoLocks => {
                    without_locks();
                    return Ok(Self::none(path));
                }
            };
            let mut journal = Journal {
                stamp: stamp(),
                holder: format!(" ({program}, process {})", std::process::id()),
                finished: KnownDigests::new(),
            };
            let old = left.as_ref().map(|(_, left)| left.stamp.as_str());
            sweep(folder, old).map_err(failed)?;
            if let Some((_, left)) = &left {
                journal.finished = left.finished.clone();
            }
            let part = folder.join(part_name(LOCK, &journal.stamp));
            let created = Created::with(part, journal.text().as_bytes()).map_err(failed)?;
            match created.file().try_lock() {
                Ok(()) => {}
                // Another run takes it for one that was left.
                Err(TryLockError::WouldBlock) => continue,
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {
                    without_locks();
                    return Ok(Self::none(path));
                }
                Err(TryLockError::Error(error)) => return Err(failed(error)),
            }
            let placed = match &left {
                None => created.install_new(&path),
                // The lock of the old file is held until the new one has its name.
                Some(_) => created.install(&path, &owned::has_header(HEADER.as_bytes())),
            };
            match placed {
                Ok(file) => {
                    return Ok(Self {
                        path,
                        file: Some(file),
                        head: journal.head().len() as u64,
                        stamp: journal.stamp,
                        finished: journal.finished,
                    });
                }
                // Another run was faster: it has the lock now, or had it.
                Err(error)
                    if left.is_none()
                        && matches!(
                            error.kind(),
                            ErrorKind::AlreadyExists | ErrorKind::NotFound
                        ) => {}
                Err(error) => return Err(failed(error)),
            }
        }
    }

    fn none(path: PathBuf) -> Self {
        Self {
            path,
            file: None,
            head: 0,
            stamp: stamp(),
            finished: KnownDigests::new(),
        }
    }

    /// Returns the lock file, to which the names of completed files are appended.
    pub(super) fn journal(&self) -> Option<File> {
        self.file.as_ref().and_then(|file| file.try_clone().ok())
    }

    /// Releases the unused bytes of the lock file on a full disk.
    pub(super) fn shrink(&self) {
        if let Some(file) = &self.file {
            let _ = owned::shorten(file, self.head);
        }
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // While the lock is held: no other run has this file now.
        if self.file.is_some() {
            owned::remove(&self.path, &owned::has_header(HEADER.as_bytes()));
        }
    }
}

/// Examines the lock file of a folder, and locks it if no run has locked it.
fn examine(path: &Path) -> io::Result<Found> {
    let mut file = match owned::open(path, true) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Found::Nothing),
        opened => opened?,
    };
    let mut text = String::new();
    match file.try_lock() {
        // The run that held it has removed it since it was opened.
        Ok(()) if !owned::is_at(&file, path) => Ok(Found::Nothing),
        Ok(()) => {
            file.read_to_string(&mut text).or_else(not_text)?;
            match Journal::parse(&text) {
                Some(journal) => Ok(Found::Left(file, journal)),
                None => Err(owned::foreign()),
            }
        }
        Err(TryLockError::WouldBlock) => {
            // Some systems let nobody read a locked file.
            let _ = file.read_to_string(&mut text);
            match Journal::parse(&text) {
                Some(journal) => Ok(Found::Held(journal.holder)),
                // Its run has just released what it does not need.
                None if HEADER.starts_with(&text) => Ok(Found::Held(String::new())),
                None => Err(owned::foreign()),
            }
        }
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {
            Ok(Found::NoLocks)
        }
        Err(TryLockError::Error(error)) => Err(error),
    }
}

/// Converts the error for bytes that are not text to an empty text.
fn not_text(error: io::Error) -> io::Result<usize> {
    match error.kind() {
        ErrorKind::InvalidData => Ok(0),
        _ => Err(error),
    }
}

/// Removes the temporary files of the killed run with the stamp `killed` (no other file has this
/// stamp in its name), and lock files of runs that were killed before they had locked the folder.
fn sweep(folder: &Path, killed: Option<&str>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let Some(stamp) = part_stamp(&name) else {
            continue;
        };
        if Some(stamp) == killed || is_left_lock(&entry.path(), &name, stamp) {
            owned::remove_created(&entry.path());
        }
    }
    Ok(())
}

/// Returns true for a new lock file that its run, which has been killed, did not put in place.
fn is_left_lock(path: &Path, name: &str, stamp: &str) -> bool {
    let read = || {
        let mut file = owned::open(path, true).ok()?;
        file.try_lock().ok()?;
        let mut text = String::new();
        file.read_to_string(&mut text).ok()?;
        Journal::parse(&text)
    };
    name == part_name(LOCK, stamp) && read().is_some_and(|journal| journal.stamp == stamp)
}

/// Returns a random name for a run.
fn stamp() -> String {
    let random = RandomState::new().hash_one(std::process::id());
    format!("{random:016x}")
}

#[cfg(test)]
mod tests;
