//! One run at a time in a folder of results: two that mixed their files would leave tables of
//! one beside the record of the other.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::files::is_part;
use crate::failure::Failure;

/// Name of the file that a run holds locked until it has ended.
const LOCK: &str = ".running";

/// The right to write into a folder. The system takes it from a process that has ended, however
/// it ended.
#[derive(Debug)]
pub(super) struct FolderLock {
    path: PathBuf,
    /// None where the file system knows no locks.
    file: Option<File>,
}

impl FolderLock {
    /// Takes the folder for `program`, and takes away what a killed run has left half written.
    ///
    /// # Errors
    /// [`Failure::Busy`] while another run has it; [`Failure::File`].
    pub(super) fn take(folder: &Path, program: &str) -> Result<Self, Failure> {
        let path = folder.join(LOCK);
        let failed = |source| Failure::File {
            path: folder.join(LOCK),
            source,
        };
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(&path).map_err(failed)?;
        match file.try_lock() {
            // The run that had it took it away since it was opened: whoever comes now makes another.
            Ok(()) if !is_at(&file, &path) => return Self::take(folder, program),
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let mut holder = String::new();
                // Empty where it has just begun; some systems let nobody read what is locked.
                let _ = file.read_to_string(&mut holder);
                return Err(Failure::Busy {
                    folder: folder.to_path_buf(),
                    holder,
                });
            }
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {
                super::say(
                    program,
                    &format!(
                        "the file system of {} has no locks: let no other run write there",
                        folder.display()
                    ),
                );
                let _ = fs::remove_file(&path);
                return Ok(Self { path, file: None });
            }
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        let own = format!(" ({program}, process {})", std::process::id());
        file.set_len(0).map_err(failed)?;
        file.write_all(own.as_bytes()).map_err(failed)?;
        for entry in fs::read_dir(folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            if is_part(&entry.file_name().to_string_lossy()) {
                let _ = fs::remove_file(entry.path());
            }
        }
        Ok(Self {
            path,
            file: Some(file),
        })
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // Before the lock itself goes: nobody else holds this file now.
        if self.file.is_some() {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Returns true where `file` is still what `path` names.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let (own, named) = (file.metadata(), fs::metadata(path));
    matches!((own, named), (Ok(a), Ok(b)) if (a.dev(), a.ino()) == (b.dev(), b.ino()))
}

/// What is open has its name until it is closed.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::FolderLock;
    use crate::failure::Failure;
    use std::fs;
    use std::sync::atomic::{AtomicU32, Ordering};

    #[test]
    fn one_holds_a_folder_at_a_time() {
        let folder = std::env::temp_dir().join(format!("one-run-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (within, runs) = (AtomicU32::new(0), AtomicU32::new(0));
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    while runs.load(Ordering::SeqCst) < 200 {
                        match FolderLock::take(&folder, "test") {
                            Ok(lock) => {
                                assert_eq!(within.fetch_add(1, Ordering::SeqCst), 0);
                                runs.fetch_add(1, Ordering::SeqCst);
                                assert_eq!(within.fetch_sub(1, Ordering::SeqCst), 1);
                                drop(lock);
                            }
                            Err(Failure::Busy { .. }) => {}
                            Err(failure) => panic!("{failure:?}"),
                        }
                    }
                });
            }
        });
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn what_a_killed_run_has_left_goes_and_nothing_else() {
        let folder = std::env::temp_dir().join(format!("killed-run-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let others = [
            ".a.csv.part",
            "a.csv.12.part",
            ".a.csv.1x.part",
            ".12.part",
            "notes.txt",
        ];
        for name in others
            .into_iter()
            .chain([".a.csv.12.part", ".checkpoint.345.part"])
        {
            fs::write(folder.join(name), "text").unwrap();
        }
        drop(FolderLock::take(&folder, "test").unwrap());
        let entries = fs::read_dir(&folder).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name()).collect();
        names.sort();
        let mut expected = others;
        expected.sort_unstable();
        assert_eq!(names, expected);
        fs::remove_dir_all(&folder).unwrap();
    }
}
