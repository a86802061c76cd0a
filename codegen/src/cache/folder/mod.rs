//! Folder of stored expansions: finds, reads and writes it (atomically), and limits its size.

use super::entry::{CacheEntry, HEAD};
use super::trust;
use crate::owned;
use crate::user_folder::{UserFolder, user_folder};
use std::ffi::OsString;
use std::fs::{self, File, Metadata};
use std::io::{self, Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::SystemTime;

/// Limit of the total size of the folder's files, in bytes. The paper's pendulum takes 0.1 MB; an
/// energy budget of 31 links in all forms takes 10 MB.
const MOST_BYTES: u64 = 256 << 20;

/// Limit of the number of files in the folder.
const MOST_FILES: usize = 512;

/// Name of the cache's folder inside the target folder or the user's cache folder.
const NAME: &str = "branched-pendulum";

/// Files that identify Cargo's target folder: its tag, which copies of the folder may lack, and
/// Cargo's notes about the compiler.
const MARKS: [&str; 2] = ["CACHEDIR.TAG", ".rustc_info.json"];

/// Returns the cache folder for the build of this process: in Cargo's target folder, or otherwise
/// in the user's cache folder. `None` if neither is known.
pub(super) fn of_this_build() -> Option<PathBuf> {
    let output = output_folder(std::env::args_os());
    let target = output.as_deref().and_then(target_folder);
    target
        .map(|target| target.join(NAME))
        .or_else(|| match user_folder() {
            UserFolder::Cache(folder) => Some(folder.join(NAME).join("expansions")),
            UserFolder::Homeless | UserFolder::Unknown => None,
        })
}

/// Returns the output folder (`--out-dir`) among the compiler's command-line arguments.
fn output_folder(mut arguments: impl Iterator<Item = OsString>) -> Option<PathBuf> {
    while let Some(argument) = arguments.next() {
        if argument == "--out-dir" {
            return arguments.next().map(PathBuf::from);
        }
        let text = argument.to_string_lossy();
        if let Some(path) = text.strip_prefix("--out-dir=") {
            return Some(path.into());
        }
    }
    None
}

/// Returns the target folder that contains the folder `inside`.
fn target_folder(inside: &Path) -> Option<&Path> {
    let mut above = inside.ancestors();
    above.find(|folder| MARKS.iter().any(|mark| folder.join(mark).is_file()))
}

/// A folder of cache files. Any of them can vanish at any time, and files of other programs may be
/// among them.
#[derive(Debug, Clone)]
pub(super) struct Folder {
    path: PathBuf,
    /// Limits of the number and of the total bytes of the cache's files.
    most: (usize, u64),
}

impl Folder {
    pub(super) fn new(path: PathBuf) -> Self {
        let most = (MOST_FILES, MOST_BYTES);
        Self { path, most }
    }

    /// Reads the text of a file, and marks the file as just used. Returns `None` if the file cannot
    /// be read or was not written by this cache.
    pub(super) fn read(&self, name: &str) -> Option<String> {
        let path = self.trusted()?.join(name);
        let mut text = String::new();
        own_file(&path)?.read_to_string(&mut text).ok()?;
        // The least recently used files are deleted first. A file whose time cannot be set is read
        // all the same.
        if let Ok(file) = owned::open(&path, true) {
            let _ = file.set_modified(SystemTime::now());
        }
        Some(text)
    }

    /// Writes a file atomically, so that no reader sees a part of it. If it cannot be written, the
    /// next build derives the expansion again.
    pub(super) fn write(&self, name: &str, text: &str) {
        let (_, most) = self.most;
        if text.len() as u64 <= most {
            let _ = self.try_write(name, text);
            let _ = self.remove_oldest();
        }
    }

    /// Returns the path of the folder, if it exists and only this user can write to it.
    fn trusted(&self) -> Option<&Path> {
        let private = owned::is_private(&fs::metadata(&self.path).ok()?);
        if !private {
            trust::warn_once(&self.path);
        }
        private.then_some(&self.path)
    }

    fn try_write(&self, name: &str, text: &str) -> io::Result<()> {
        static WRITTEN: AtomicU64 = AtomicU64::new(0);
        owned::create_folder(&self.path)?;
        let Some(path) = self.trusted() else {
            return Ok(());
        };
        let number = WRITTEN.fetch_add(1, Ordering::Relaxed);
        let part = path.join(CacheEntry::part_name(name, std::process::id(), number));
        owned::install(&part, &path.join(name), is_own, |file| {
            file.write_all(text.as_bytes())?;
            // Set the time explicitly, as for files in use: clocks of file systems are coarser than
            // the system clock.
            let _ = file.set_modified(SystemTime::now());
            Ok(())
        })
    }

    /// Removes the least recently used files of the cache until the rest is within the limits.
    fn remove_oldest(&self) -> io::Result<()> {
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.path)? {
            let entry = entry?;
            // Other processes remove files too.
            if CacheEntry::is_name(&entry.file_name())
                && let Some(file) = own_file(&entry.path())
                && let Ok(data) = file.metadata()
            {
                files.push((data.modified()?, data.len(), entry.path()));
            }
        }
        files.sort();
        let (most_files, most_bytes) = self.most;
        let mut bytes: u64 = files.iter().map(|(_, length, _)| length).sum();
        let mut count = files.len();
        for (_, length, path) in files {
            if bytes <= most_bytes && count <= most_files {
                break;
            }
            owned::remove(&path, is_own);
            bytes -= length;
            count -= 1;
        }
        Ok(())
    }
}

/// Opens a file only if its first bytes show that this cache wrote it. Anything but a regular file
/// is skipped: opening a pipe would wait for a writer.
fn own_file(path: &Path) -> Option<File> {
    let is_plain = |data: &Metadata| data.is_file() && owned::is_private(data);
    let mut file = owned::open(path, false).ok()?;
    file.metadata().ok().filter(is_plain)?;
    let mut head = [0; HEAD];
    file.read_exact(&mut head).ok()?;
    file.rewind().ok()?;
    CacheEntry::is_head(&head).then_some(file)
}

/// Returns true for a file that this cache wrote.
fn is_own(path: &Path) -> bool {
    own_file(path).is_some()
}

#[cfg(test)]
mod tests;
