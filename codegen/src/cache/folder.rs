//! The folder of kept expansions: found, read, written whole, kept small.

use directories::BaseDirs;
use std::ffi::OsString;
use std::fs;
use std::io;
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

/// A folder of files that may vanish at any time.
#[derive(Debug, Clone)]
pub(super) struct Folder {
    path: PathBuf,
}

impl Folder {
    pub(super) fn new(path: PathBuf) -> Self {
        Self { path }
    }

    /// The text of a file, if it can be read. The file counts as used now.
    pub(super) fn read(&self, name: &str) -> Option<String> {
        let path = self.path.join(name);
        let text = fs::read_to_string(&path).ok()?;
        // Old files go first; one that cannot be marked as used is only read again.
        if let Ok(file) = fs::File::options().append(true).open(path) {
            let _ = file.set_modified(SystemTime::now());
        }
        Some(text)
    }

    /// Writes a file, so that nobody ever reads half of it. Whoever cannot write
    /// derives again the next time.
    pub(super) fn write(&self, name: &str, text: &str) {
        if text.len() as u64 <= MOST_BYTES {
            let _ = self.try_write(name, text);
            let _ = self.make_room();
        }
    }

    fn try_write(&self, name: &str, text: &str) -> io::Result<()> {
        static WRITTEN: AtomicU64 = AtomicU64::new(0);
        fs::create_dir_all(&self.path)?;
        let number = WRITTEN.fetch_add(1, Ordering::Relaxed);
        let id = std::process::id();
        let whole = self.path.join(name);
        let part = self.path.join(format!("{name}.{id}-{number}"));
        let written = fs::write(&part, text).and_then(|()| fs::rename(&part, &whole));
        if written.is_err() {
            let _ = fs::remove_file(&part);
        }
        written
    }

    /// Removes the files that have not been used for longest, until the rest is
    /// within the limits.
    fn make_room(&self) -> io::Result<()> {
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.path)? {
            let entry = entry?;
            // Others remove files too.
            if let Ok(data) = entry.metadata()
                && data.is_file()
            {
                files.push((data.modified()?, data.len(), entry.path()));
            }
        }
        files.sort();
        let mut bytes: u64 = files.iter().map(|(_, length, _)| length).sum();
        let mut count = files.len();
        for (_, length, path) in files {
            if bytes <= MOST_BYTES && count <= MOST_FILES {
                break;
            }
            let _ = fs::remove_file(path);
            bytes -= length;
            count -= 1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_target_folder_is_told_by_the_compilers_arguments() {
        let root = std::env::temp_dir().join(format!("target-{}", std::process::id()));
        let deps = root.join("debug/deps");
        fs::create_dir_all(&deps).unwrap();
        for arguments in [
            vec!["rustc".into(), "--out-dir".into(), deps.clone().into()],
            vec![
                "rustc".into(),
                format!("--out-dir={}", deps.display()).into(),
            ],
        ] {
            let output = output_folder(arguments.into_iter());
            assert_eq!(output.as_deref(), Some(deps.as_path()));
        }
        assert_eq!(target_folder(&deps), None);
        for mark in MARKS {
            fs::write(root.join(mark), "").unwrap();
            assert_eq!(target_folder(&deps), Some(root.as_path()));
            fs::remove_file(root.join(mark)).unwrap();
        }
        fs::remove_dir_all(root).unwrap();
    }

    #[test]
    fn files_that_were_used_last_stay() {
        let path = std::env::temp_dir().join(format!("room-{}", std::process::id()));
        let folder = Folder::new(path.clone());
        folder.write("first", "a");
        for number in 0..MOST_FILES + 20 {
            folder.write(&format!("{number}"), "b");
            assert_eq!(folder.read("first").as_deref(), Some("a"));
        }
        assert_eq!(fs::read_dir(&path).unwrap().count(), MOST_FILES);
        assert_eq!(folder.read("0"), None);
        fs::remove_dir_all(path).unwrap();
    }
}
