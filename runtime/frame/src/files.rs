//! Files that are whole or absent: written under another name beside, and
//! renamed when they are complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Name of the file in a run's folder from which the run goes on.
pub(super) const CHECKPOINT: &str = "checkpoint";

/// The parts being written, and the names of the files that are complete.
#[derive(Debug, Default)]
pub(super) struct Ledger {
    pub(super) parts: Vec<PathBuf>,
    pub(super) files: Vec<String>,
}

/// A ledger that the watcher of Ctrl-C sees, too.
pub(super) type SharedLedger = Arc<Mutex<Ledger>>;

/// Locks what another thread may have left by a panic: the ledger is right
/// after each line that changes it.
pub(super) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Path of the file `path` while this process writes it.
fn part_of(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

/// Returns true for the name of a file that some process writes, or has left half written.
pub(super) fn is_part(name: &str) -> bool {
    let inner = name
        .strip_prefix('.')
        .and_then(|name| name.strip_suffix(".part"));
    let number = |(name, process): (&str, &str)| {
        !name.is_empty() && !process.is_empty() && process.bytes().all(|b| b.is_ascii_digit())
    };
    inner
        .and_then(|inner| inner.rsplit_once('.'))
        .is_some_and(number)
}

/// Replaces a file by these bytes: whoever reads it finds the old one or the new one,
/// even after the power has failed.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    whole(path, bytes, |part| fs::rename(part, path))
}

/// Makes a file of these bytes where there is none: of several processes that do so at once, one does.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] for the others, which then find the whole file.
pub(super) fn create(path: &Path, bytes: &[u8]) -> io::Result<()> {
    whole(path, bytes, |part| {
        fs::hard_link(part, path)?;
        fs::remove_file(part)
    })
}

/// Writes a part as a whole and gives it its name.
fn whole(path: &Path, bytes: &[u8], name: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let part = part_of(path);
    let written = File::create(&part).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()?;
        name(&part)
    });
    if written.is_err() {
        let _ = fs::remove_file(&part);
    }
    written
}

/// A file of a folder while it is being written. Dropped before [`Part::finish`],
/// it leaves nothing.
#[derive(Debug)]
pub struct Part {
    file: BufWriter<File>,
    part: PathBuf,
    path: PathBuf,
    ledger: SharedLedger,
    finished: bool,
}

impl Part {
    pub(super) fn create(folder: &Path, name: &str, ledger: &SharedLedger) -> io::Result<Self> {
        let path = folder.join(name);
        let part = part_of(&path);
        // Known as soon as it is there: who ends the process now removes it.
        let mut parts = locked(ledger);
        let file = File::create(&part)?;
        parts.parts.push(part.clone());
        drop(parts);
        Ok(Self {
            file: BufWriter::new(file),
            part,
            path,
            ledger: Arc::clone(ledger),
            finished: false,
        })
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// If the rest of it cannot be written, or if it cannot be renamed.
    pub fn finish(mut self) -> io::Result<()> {
        self.file.flush()?;
        let mut ledger = locked(&self.ledger);
        fs::rename(&self.part, &self.path)?;
        ledger.parts.retain(|part| *part != self.part);
        let name = self.path.file_name().unwrap_or_default();
        let name = name.to_string_lossy().into_owned();
        if !ledger.files.contains(&name) {
            ledger.files.push(name);
        }
        drop(ledger);
        self.finished = true;
        Ok(())
    }
}

impl Write for Part {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if !self.finished {
            let _ = fs::remove_file(&self.part);
            locked(&self.ledger).parts.retain(|part| *part != self.part);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, SharedLedger, create, is_part, locked, replace};
    use std::fs;
    use std::io::Write;

    #[test]
    fn of_several_that_make_a_file_one_does() {
        let folder = std::env::temp_dir().join(format!("made-once-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.json");
        create(&path, b"first").unwrap();
        let second = create(&path, b"second").unwrap_err();
        assert_eq!(second.kind(), std::io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read(&path).unwrap(), b"first");
        replace(&path, b"third").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"third");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_is_whole_or_absent() {
        let folder = std::env::temp_dir().join(format!("whole-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let ledger = SharedLedger::default();
        let names = || {
            let entries = fs::read_dir(&folder).unwrap();
            entries.map(|e| e.unwrap().file_name()).collect::<Vec<_>>()
        };
        let mut part = Part::create(&folder, "a.csv", &ledger).unwrap();
        part.write_all(b"half").unwrap();
        let [only] = &names()[..] else {
            panic!("one file is written");
        };
        assert!(is_part(&only.to_string_lossy()), "{only:?}");
        drop(part);
        assert!(names().is_empty() && locked(&ledger).parts.is_empty());
        let mut part = Part::create(&folder, "a.csv", &ledger).unwrap();
        part.write_all(b"whole").unwrap();
        part.finish().unwrap();
        assert_eq!(names(), ["a.csv"]);
        assert_eq!(fs::read(folder.join("a.csv")).unwrap(), b"whole");
        assert_eq!(locked(&ledger).files, ["a.csv"]);
        fs::remove_dir_all(&folder).unwrap();
        assert!(Part::create(&folder, "a.csv", &ledger).is_err());
        assert!(locked(&ledger).parts.is_empty());
    }
}
