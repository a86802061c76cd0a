//! The folder of kept expansions: found, read, written whole, kept small.

use super::entry::{CacheEntry, HEAD};
use super::trust;
use directories::BaseDirs;
use std::ffi::OsString;
use std::fs::{self, DirBuilder, File, Metadata, OpenOptions};
use std::io::{self, Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::SystemTime;

/// Most bytes that a folder holds. The paper's pendulum takes 0.1 MB, a budget of
/// 31 links in all forms 10 MB.
const MOST_BYTES: u64 = 256 << 20;

/// Most files that a folder holds.
const MOST_FILES: usize = 512;

/// Name of the folder inside others.
const NAME: &str = "branched-pendulum";

/// Files by which cargo's target folder is known: its mark, which copies of the folder
/// may lack, and what it notes about the compiler.
const MARKS: [&str; 2] = ["CACHEDIR.TAG", ".rustc_info.json"];

/// The folder for the build of this process: in cargo's target folder, else in
/// the user's cache folder. `None` if neither is known.
pub(super) fn of_this_build() -> Option<PathBuf> {
    let output = output_folder(std::env::args_os());
    let target = output.as_deref().and_then(target_folder);
    target.map(|target| target.join(NAME)).or_else(|| {
        let folders = BaseDirs::new()?;
        Some(folders.cache_dir().join(NAME).join("expansions"))
    })
}

/// The folder that the compiler writes to, by its arguments.
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

/// The target folder that a folder is in.
fn target_folder(inside: &Path) -> Option<&Path> {
    let mut above = inside.ancestors();
    above.find(|folder| MARKS.iter().any(|mark| folder.join(mark).is_file()))
}

/// A folder of files that may vanish at any time, among others that are not the cache's.
#[derive(Debug, Clone)]
pub(super) struct Folder {
    path: PathBuf,
    /// Most files and bytes of the cache's own.
    most: (usize, u64),
}

impl Folder {
    pub(super) fn new(path: PathBuf) -> Self {
        let most = (MOST_FILES, MOST_BYTES);
        Self { path, most }
    }

    /// The text of a file, if it is the cache's and can be read. The file counts as used
    /// now.
    pub(super) fn read(&self, name: &str) -> Option<String> {
        let path = self.trusted()?.join(name);
        let mut text = String::new();
        own_file(&path)?.read_to_string(&mut text).ok()?;
        // Old files go first; one that cannot be marked as used is only read again.
        if let Ok(file) = File::options().append(true).open(path) {
            let _ = file.set_modified(SystemTime::now());
        }
        Some(text)
    }

    /// Writes a file, so that nobody ever reads half of it. Whoever cannot write
    /// derives again the next time.
    pub(super) fn write(&self, name: &str, text: &str) {
        let (_, most) = self.most;
        if text.len() as u64 <= most {
            let _ = self.try_write(name, text);
            let _ = self.make_room();
        }
    }

    /// The folder, if there is one that this user alone writes.
    fn trusted(&self) -> Option<&Path> {
        let private = trust::is_private(&fs::metadata(&self.path).ok()?);
        if !private {
            trust::tell(&self.path);
        }
        private.then_some(&self.path)
    }

    fn try_write(&self, name: &str, text: &str) -> io::Result<()> {
        static WRITTEN: AtomicU64 = AtomicU64::new(0);
        private_folder().create(&self.path)?;
        let Some(path) = self.trusted() else {
            return Ok(());
        };
        let whole = path.join(name);
        if fs::symlink_metadata(&whole).is_ok() && own_file(&whole).is_none() {
            // Somebody else's.
            return Ok(());
        }
        let number = WRITTEN.fetch_add(1, Ordering::Relaxed);
        let part = path.join(CacheEntry::part_name(name, std::process::id(), number));
        let mut file = private_file().open(&part)?;
        let written = file.write_all(text.as_bytes());
        // Clocks of file systems are coarser than this one, by which others are marked as used.
        let _ = file.set_modified(SystemTime::now());
        drop(file);
        let written = written.and_then(|()| fs::rename(&part, &whole));
        if written.is_err() {
            let _ = fs::remove_file(&part);
        }
        written
    }

    /// Removes those of the cache's files that have not been used for longest, until the
    /// rest is within the limits.
    fn make_room(&self) -> io::Result<()> {
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.path)? {
            let entry = entry?;
            // Others remove files too.
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
            let _ = fs::remove_file(path);
            bytes -= length;
            count -= 1;
        }
        Ok(())
    }
}

/// Opens a file that the cache has written and nobody else, known by its head. What is no
/// plain file is not opened: a pipe would wait for a writer.
fn own_file(path: &Path) -> Option<File> {
    let is_plain = |data: &Metadata| data.is_file() && trust::is_private(data);
    fs::symlink_metadata(path).ok().filter(is_plain)?;
    let mut file = File::open(path).ok()?;
    file.metadata().ok().filter(is_plain)?;
    let mut head = [0; HEAD];
    file.read_exact(&mut head).ok()?;
    file.rewind().ok()?;
    CacheEntry::is_head(&head).then_some(file)
}

/// What makes a folder that only its user writes, whatever others may by default.
fn private_folder() -> DirBuilder {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder
}

/// What makes a new file that only its user writes.
fn private_file() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options
}

#[cfg(test)]
mod tests;
