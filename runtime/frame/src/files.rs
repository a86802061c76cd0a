//! Files that are either complete or absent: each is written under a temporary name in the same
//! folder, and renamed when it is complete. A file that was not written by this project is never
//! replaced.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sha2::{Digest, Sha256};

use super::lock::{self, FolderLock, KnownDigests};
use super::owned::{self, Created, Recogniser, has_digest, part_name};

/// Name of the file in a run's folder from which an interrupted run continues.
pub(super) const CHECKPOINT: &str = "checkpoint";

/// Files of a run: those being written, those that are complete, and those left by earlier runs.
#[derive(Debug, Default)]
pub(super) struct Ledger {
    /// Paths of the files being written.
    pub(super) parts: Vec<PathBuf>,
    /// Names of the complete files, in the order in which they were written.
    pub(super) files: Vec<String>,
    /// Random name of the run, which is part of the names of its temporary files.
    pub(super) stamp: String,
    /// Digests of the files of this run and of earlier runs, by name.
    known: KnownDigests,
    /// Lock file of the folder, to which the names of complete files are appended.
    journal: Option<File>,
}

/// Ledger that is shared with the thread that watches for Ctrl-C.
pub(super) type SharedLedger = Arc<Mutex<Ledger>>;

/// Locks a mutex even if another thread panicked while it held the lock; the ledger is consistent
/// after each line that changes it.
pub(super) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the temporary path of the file at `path` while the run with this stamp writes it.
fn part_of(path: &Path, stamp: &str) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(part_name(&name, stamp))
}

/// Writes a file, or replaces one that `is_own` recognises. A reader finds either the old or the
/// new file, even after a power failure.
pub(super) fn replace(
    path: &Path,
    bytes: &[u8],
    stamp: &str,
    is_own: Recogniser<'_>,
) -> io::Result<()> {
    owned::may_install(path, is_own)?;
    let part = Created::with(part_of(path, stamp), bytes)?;
    part.install(path, is_own).map(|_| ())
}

/// Creates a file if none exists; `part` is its temporary path. If several processes do so at the
/// same time, one succeeds.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] for the other processes, which then find the complete file.
pub(super) fn create(path: &Path, bytes: &[u8], part: PathBuf) -> io::Result<()> {
    Created::with(part, bytes)?.install_new(path).map(|_| ())
}

impl Ledger {
    /// Creates the ledger of a run in a folder; `earlier` are the digests of the files there, as
    /// recorded by earlier runs.
    pub(super) fn new(lock: &FolderLock, earlier: BTreeMap<String, String>) -> Self {
        let mut known = lock.finished.clone();
        for (name, digest) in earlier {
            known.entry(name).or_default().insert(digest);
        }
        Self {
            stamp: lock.stamp.clone(),
            journal: lock.journal(),
            known,
            ..Self::default()
        }
    }

    /// Returns the digests that a file with this name has if a run of this project wrote it.
    fn digests_of(&self, name: &str) -> Vec<String> {
        let known = self.known.get(name);
        known.map_or(Vec::new(), |known| known.iter().cloned().collect())
    }

    /// Returns the digests of all files in `folder` that this run and earlier runs have written.
    pub(super) fn digests(&self, folder: &Path) -> BTreeMap<String, String> {
        let mut digests = BTreeMap::new();
        for (name, known) in &self.known {
            let Ok(mut file) = owned::open(&folder.join(name), false) else {
                continue;
            };
            // A killed run may have been about to replace a file: the content decides.
            let digest = match known.len() {
                1 => known.first().cloned(),
                _ => owned::digest(&mut file).ok(),
            };
            if let Some(digest) = digest.filter(|digest| known.contains(digest)) {
                digests.insert(name.clone(), digest);
            }
        }
        digests
    }

    /// Removes the files that this run has completed.
    pub(super) fn remove_files(&mut self, folder: &Path) {
        for name in std::mem::take(&mut self.files) {
            owned::remove(&folder.join(&name), &has_digest(&self.digests_of(&name)));
        }
    }
}

/// File of a folder while it is being written. If it is dropped before [`Part::finish`], it is
/// removed.
#[derive(Debug)]
pub struct Part {
    file: Option<BufWriter<Hashed>>,
    part: PathBuf,
    path: PathBuf,
    ledger: SharedLedger,
}

/// File that computes the digest of the bytes written to it.
#[derive(Debug)]
struct Hashed {
    created: Created,
    hasher: Sha256,
}

impl Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.created.file().write(bytes)?;
        self.hasher.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.created.file().flush()
    }
}

impl Part {
    pub(super) fn create(folder: &Path, name: &str, ledger: &SharedLedger) -> io::Result<Self> {
        let path = folder.join(name);
        // Known as soon as it is there: Ctrl-C removes it from then on.
        let mut own = locked(ledger);
        owned::may_install(&path, &has_digest(&own.digests_of(name)))?;
        let created = Created::new(part_of(&path, &own.stamp))?;
        let part = created.path().to_path_buf();
        own.parts.push(part.clone());
        drop(own);
        let hashed = Hashed {
            created,
            hasher: Sha256::new(),
        };
        Ok(Self {
            file: Some(BufWriter::new(hashed)),
            part,
            path,
            ledger: Arc::clone(ledger),
        })
    }

    /// Completes the file and gives it its final name.
    ///
    /// # Errors
    /// An error if the remaining bytes cannot be written, or if the file cannot be renamed.
    pub fn finish(mut self) -> io::Result<()> {
        let Some(file) = self.file.take() else {
            return Ok(());
        };
        let Hashed { created, hasher } =
            file.into_inner().map_err(io::IntoInnerError::into_error)?;
        let digest = owned::hexadecimal(hasher);
        let name = self.path.file_name().unwrap_or_default();
        let name = name.to_string_lossy().into_owned();
        let mut ledger = locked(&self.ledger);
        // Before the file has its name: a killed run has listed all of its files.
        if let Some(journal) = &mut ledger.journal {
            journal.write_all(lock::entry(&name, &digest).as_bytes())?;
        }
        created.install(&self.path, &has_digest(&ledger.digests_of(&name)))?;
        ledger.known.insert(name.clone(), BTreeSet::from([digest]));
        if !ledger.files.contains(&name) {
            ledger.files.push(name);
        }
        Ok(())
    }

    fn file(&mut self) -> io::Result<&mut BufWriter<Hashed>> {
        let file = self.file.as_mut();
        file.ok_or_else(|| io::Error::other("the file is finished"))
    }
}

impl Write for Part {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file()?.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file()?.flush()
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            // What is buffered is not written any more.
            drop(file.into_parts().0);
        }
        locked(&self.ledger).parts.retain(|part| *part != self.part);
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, SharedLedger, create, locked, replace};
    use crate::owned::{has_header, part_stamp};
    use std::fs;
    use std::io::Write;

    #[test]
    fn of_several_that_create_a_file_one_does() {
        let folder = std::env::temp_dir().join(format!("made-once-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.json");
        let create = |bytes| create(&path, bytes, folder.join(".a.json.part"));
        create(b"own first").unwrap();
        let second = create(b"own second").unwrap_err();
        assert_eq!(second.kind(), std::io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read(&path).unwrap(), b"own first");
        replace(&path, b"own third", "0", &has_header(b"own ")).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"own third");
        replace(&path, b"fourth", "0", &has_header(b"other ")).unwrap_err();
        assert_eq!(fs::read(&path).unwrap(), b"own third");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_is_whole_or_absent() {
        let folder = std::env::temp_dir().join(format!("whole-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let ledger = SharedLedger::default();
        locked(&ledger).stamp = "0123456789abcdef".to_owned();
        let names = || {
            let entries = fs::read_dir(&folder).unwrap();
            entries.map(|e| e.unwrap().file_name()).collect::<Vec<_>>()
        };
        let mut part = Part::create(&folder, "a.csv", &ledger).unwrap();
        part.write_all(b"half").unwrap();
        let [only] = &names()[..] else {
            panic!("one file is written");
        };
        assert!(part_stamp(&only.to_string_lossy()).is_some(), "{only:?}");
        drop(part);
        assert!(names().is_empty() && locked(&ledger).parts.is_empty());
        // Its own file is replaced, one that was changed since is not.
        for text in ["whole", "another"] {
            let mut part = Part::create(&folder, "a.csv", &ledger).unwrap();
            part.write_all(text.as_bytes()).unwrap();
            part.finish().unwrap();
            assert_eq!(names(), ["a.csv"]);
            assert_eq!(fs::read_to_string(folder.join("a.csv")).unwrap(), text);
            assert_eq!(locked(&ledger).files, ["a.csv"]);
            assert!(locked(&ledger).parts.is_empty());
        }
        fs::write(folder.join("a.csv"), "edited").unwrap();
        Part::create(&folder, "a.csv", &ledger).unwrap_err();
        assert_eq!(fs::read_to_string(folder.join("a.csv")).unwrap(), "edited");
        fs::remove_dir_all(&folder).unwrap();
        assert!(Part::create(&folder, "a.csv", &ledger).is_err());
        assert!(locked(&ledger).parts.is_empty());
    }
}
