//! Files in a folder of results that this project has created, distinguished from all others. Only
//! this module opens, replaces and removes files there.
//!
//! A file is created only if nothing has its name yet ([`Created`]). An existing file is opened,
//! replaced or removed only if it is a regular file, reached without a link, whose content shows
//! that a program of this project wrote it (a recogniser, such as [`has_header`] or
//! [`has_digest`]). Everything else in the folder stays as it is.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// Message for a file that is in the way and was not written by this project.
const FOREIGN: &str = "this program did not write the file that is there, or it was changed since; \
                       help: move it away, or name another folder by `--output`";

/// Message for a link, a pipe, a folder or a device that is in the way.
const NOT_REGULAR: &str = "a link, a pipe, a folder or a device has this name; \
                           help: move it away, or name another folder by `--output`";

/// Test of an open file for content that a program of this project wrote.
pub(super) type Recogniser<'a> = &'a dyn Fn(&mut File) -> io::Result<bool>;

/// Returns the error for a file that was not written by this project.
pub(super) fn foreign() -> io::Error {
    io::Error::new(ErrorKind::AlreadyExists, FOREIGN)
}

/// Returns a recogniser that accepts files which begin with `header`.
pub(super) fn has_header(header: &[u8]) -> impl Fn(&mut File) -> io::Result<bool> {
    move |file| {
        let mut start = Vec::new();
        file.take(header.len() as u64).read_to_end(&mut start)?;
        Ok(start == header)
    }
}

/// Returns a recogniser that accepts files whose SHA-256 digest is one of `digests`.
pub(super) fn has_digest(digests: &[String]) -> impl Fn(&mut File) -> io::Result<bool> {
    move |file| match digests {
        [] => Ok(false),
        _ => Ok(digests.contains(&digest(file)?)),
    }
}

/// Returns the SHA-256 digest of the remaining bytes of `source`, as hexadecimal digits.
pub(super) fn digest(source: &mut impl Read) -> io::Result<String> {
    let mut hasher = Sha256::new();
    let mut block = vec![0; 1 << 16];
    loop {
        match source.read(&mut block) {
            Ok(0) => return Ok(hexadecimal(hasher)),
            Ok(count) => hasher.update(&block[..count]),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// Returns a finished digest as hexadecimal digits.
pub(super) fn hexadecimal(hasher: Sha256) -> String {
    use std::fmt::Write;
    let mut text = String::new();
    for byte in hasher.finalize() {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// Opens a regular file for reading, and for writing if `writes`. Follows no link and never waits for the other end
/// of a pipe.
///
/// # Errors
/// [`ErrorKind::NotFound`]; an error that names what is there, if it is not a regular file; the
/// system's error.
pub(super) fn open(path: &Path, writes: bool) -> io::Result<File> {
    if !fs::symlink_metadata(path)?.is_file() {
        return Err(io::Error::other(NOT_REGULAR));
    }
    let mut options = OpenOptions::new();
    options.read(true).write(writes);
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt;
        // The path may have changed since it was examined.
        let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK;
        options.custom_flags(flags.bits() as i32);
    }
    let file = options.open(path)?;
    match file.metadata()?.is_file() {
        true => Ok(file),
        false => Err(io::Error::other(NOT_REGULAR)),
    }
}

/// Reads a regular file that `is_own` recognises as written by this project.
///
/// # Errors
/// Errors of [`open`]; an error for a file that is not recognised.
pub(super) fn read(path: &Path, is_own: Recogniser<'_>) -> io::Result<Vec<u8>> {
    let mut file = recognised(path, is_own)?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Opens a file that `is_own` recognises, positioned at its start.
fn recognised(path: &Path, is_own: Recogniser<'_>) -> io::Result<File> {
    let mut file = open(path, false)?;
    if !is_own(&mut file)? {
        return Err(foreign());
    }
    file.rewind()?;
    Ok(file)
}

/// Returns true if `path` is a regular file that `is_own` recognises.
pub(super) fn is_own(path: &Path, is_own: Recogniser<'_>) -> bool {
    recognised(path, is_own).is_ok()
}

/// Checks that a file may be placed at `path`: nothing is there, or a file that `is_own` recognises.
///
/// # Errors
/// An error that says what is in the way, otherwise.
pub(super) fn may_install(path: &Path, is_own: Recogniser<'_>) -> io::Result<()> {
    match recognised(path, is_own) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        found => found.map(|_| ()),
    }
}

/// Removes the file at `path` if `is_own` recognises it. Returns true if it did.
pub(super) fn remove(path: &Path, is_own: Recogniser<'_>) -> bool {
    match recognised(path, is_own) {
        Ok(file) => is_at(&file, path) && fs::remove_file(path).is_ok(),
        Err(_) => false,
    }
}

/// Removes a temporary file that this process has created but not yet placed.
pub(super) fn remove_created(part: &Path) {
    if fs::symlink_metadata(part).is_ok_and(|data| data.is_file()) {
        let _ = fs::remove_file(part);
    }
}

/// Removes `folder` if it is empty.
pub(super) fn remove_empty_folder(folder: &Path) {
    let _ = fs::remove_dir(folder);
}

/// Truncates a file that this process has locked to `length` bytes, which frees space on a full
/// disk.
pub(super) fn shorten(file: &File, length: u64) -> io::Result<()> {
    file.set_len(length)
}

/// Returns true if the open `file` still has the name `path`.
#[cfg(unix)]
pub(super) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let (own, named) = (file.metadata(), fs::symlink_metadata(path));
    matches!((own, named), (Ok(a), Ok(b)) if (a.dev(), a.ino()) == (b.dev(), b.ino()))
}

/// Returns true if `path` exists. On systems other than Unix this suffices, because an open file
/// keeps its name.
#[cfg(not(unix))]
pub(super) fn is_at(_: &File, path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// Returns the temporary name of the file `name` while the run with this stamp writes it.
pub(super) fn part_name(name: &str, stamp: &str) -> String {
    format!(".{name}.{stamp}.part")
}

/// Returns the stamp contained in a temporary name made by [`part_name`]; `None` for other names.
pub(super) fn part_stamp(name: &str) -> Option<&str> {
    let inner = name.strip_prefix('.')?.strip_suffix(".part")?;
    let (name, stamp) = inner.rsplit_once('.')?;
    (!name.is_empty() && stamp.len() == 16).then_some(stamp)
}

/// New file with a temporary name. It is removed if it is dropped before it is placed.
#[derive(Debug)]
pub(super) struct Created {
    file: File,
    path: PathBuf,
    placed: bool,
}

impl Created {
    /// Creates the file at `path`, where nothing may be.
    ///
    /// # Errors
    /// [`ErrorKind::AlreadyExists`] if anything has the name; the system's error.
    pub(super) fn new(path: PathBuf) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        // Exclusive creation follows no link.
        let file = options
            .read(true)
            .write(true)
            .create_new(true)
            .open(&path)?;
        Ok(Self {
            file,
            path,
            placed: false,
        })
    }

    /// Creates a file with this content, which has been written to disk when this function returns.
    pub(super) fn with(path: PathBuf, bytes: &[u8]) -> io::Result<Self> {
        let mut created = Self::new(path)?;
        created.file.write_all(bytes)?;
        created.file.sync_all()?;
        Ok(created)
    }

    /// The open file.
    pub(super) fn file(&self) -> &File {
        &self.file
    }

    /// Temporary path of the file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Renames the file to `path`; fails if anything is there.
    ///
    /// # Errors
    /// [`ErrorKind::AlreadyExists`] if anything is there; the system's error.
    pub(super) fn install_new(mut self, path: &Path) -> io::Result<File> {
        match fs::hard_link(&self.path, path) {
            // The temporary name goes when `self` is dropped.
            Ok(()) => return self.file.try_clone(),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(error),
            // File systems without hard links.
            Err(_) => {}
        }
        match fs::symlink_metadata(path) {
            Ok(_) => Err(ErrorKind::AlreadyExists.into()),
            Err(error) if error.kind() == ErrorKind::NotFound => self.renamed(path),
            Err(error) => Err(error),
        }
    }

    /// Renames the file to `path`; a file that is there is replaced if `is_own` recognises it.
    ///
    /// # Errors
    /// An error that says what is in the way; the system's error.
    pub(super) fn install(mut self, path: &Path, is_own: Recogniser<'_>) -> io::Result<File> {
        may_install(path, is_own)?;
        self.renamed(path)
    }

    fn renamed(&mut self, path: &Path) -> io::Result<File> {
        fs::rename(&self.path, path)?;
        self.placed = true;
        self.file.try_clone()
    }
}

impl Drop for Created {
    fn drop(&mut self) {
        if !self.placed {
            let _ = fs::remove_file(&self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Created, has_digest, has_header, is_own, may_install, open, read, remove};
    use super::{part_name, part_stamp};
    use std::fs;
    use std::io::ErrorKind;

    #[test]
    fn only_recognised_files_are_read_replaced_and_removed() {
        let folder = std::env::temp_dir().join(format!("owned-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a");
        let own = has_header(b"own\n");
        let part = || Created::with(folder.join("part"), b"own\nnew").unwrap();
        for foreign in ["", "ow", "other\n"] {
            fs::write(&path, foreign).unwrap();
            assert_eq!(
                part().install(&path, &own).unwrap_err().kind(),
                ErrorKind::AlreadyExists
            );
            assert_eq!(
                part().install_new(&path).unwrap_err().kind(),
                ErrorKind::AlreadyExists
            );
            assert!(read(&path, &own).is_err() && !remove(&path, &own));
            assert_eq!(fs::read_to_string(&path).unwrap(), foreign);
        }
        fs::remove_file(&path).unwrap();
        part().install_new(&path).unwrap();
        part().install(&path, &own).unwrap();
        assert_eq!(read(&path, &own).unwrap(), b"own\nnew");
        assert!(!folder.join("part").exists());
        let digests = [super::digest(&mut &b"own\nnew"[..]).unwrap()];
        assert!(is_own(&path, &has_digest(&digests)) && !is_own(&path, &has_digest(&[])));
        assert!(remove(&path, &own) && may_install(&path, &own).is_ok());
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn stamps_are_read_from_names() {
        let stamp = "0123456789abcdef";
        assert_eq!(part_stamp(&part_name("a.csv", stamp)), Some(stamp));
        assert_eq!(part_stamp(&part_name(".running", stamp)), Some(stamp));
        for other in [
            ".a.csv.12.part",
            "a.csv.0123456789abcdef.part",
            ".0123456789abcdef.part",
            ".a.0123456789abcdef.parts",
            ".a.0123456789abcdef",
        ] {
            assert_eq!(part_stamp(other), None, "{other}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_pipes_and_folders_are_never_opened() {
        let folder = std::env::temp_dir().join(format!("owned-links-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let target = folder.join("target");
        fs::write(&target, "own\n").unwrap();
        let own = has_header(b"own\n");
        let pipe = folder.join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        let link = folder.join("link");
        std::os::unix::fs::symlink(&target, &link).unwrap();
        for path in [&pipe, &link, &folder] {
            assert!(open(path, true).is_err() && !remove(path, &own));
            let created = Created::with(folder.join("part"), b"own\n").unwrap();
            assert!(created.install(path, &own).is_err());
            assert!(fs::symlink_metadata(path).is_ok());
        }
        assert_eq!(fs::read_to_string(&target).unwrap(), "own\n");
        fs::remove_dir_all(&folder).unwrap();
    }
}
