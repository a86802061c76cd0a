//! Files that the compiler has created. Only this module opens, replaces and removes them, and it
//! never touches other files (`runtime/frame/src/owned.rs` does the same for the programs).
//!
//! A file is created only if its name is not yet in use. An existing file is opened only if it is a
//! regular file, reached without a link; its content has to show that the compiler wrote it before
//! it is replaced or removed.

use std::fs::{self, DirBuilder, File, Metadata, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// Opens a regular file for reading, and for writing if `writes`. Follows no link and never waits for the other end
/// of a pipe.
///
/// # Errors
/// [`io::ErrorKind::NotFound`]; [`io::ErrorKind::InvalidInput`] for anything but a regular file.
pub(crate) fn open(path: &Path, writes: bool) -> io::Result<File> {
    let not_regular = || io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file");
    if !fs::symlink_metadata(path)?.is_file() {
        return Err(not_regular());
    }
    let mut options = OpenOptions::new();
    options.read(true).write(writes);
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt as _;
        // The path may have changed since it was examined.
        let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK;
        options.custom_flags(flags.bits() as i32);
    }
    let file = options.open(path)?;
    match file.metadata()?.is_file() {
        true => Ok(file),
        false => Err(not_regular()),
    }
}

/// Creates a file to which only the user can write.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] if the name is in use.
pub(crate) fn create(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    // Exclusive creation follows no link.
    options.read(true).write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)
}

/// Creates a folder to which only the user can write, with all folders above it.
///
/// # Errors
/// The system's error.
pub(crate) fn create_folder(path: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(path)
}

/// Writes a file: creates it under the temporary name `part`, and renames it to `path`, where nothing may be except a
/// file that `is_own` recognises.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] if anything else is there; the system's error.
pub(crate) fn install(
    part: &Path,
    path: &Path,
    is_own: impl Fn(&Path) -> bool,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<()> {
    if fs::symlink_metadata(path).is_ok() && !is_own(path) {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    let mut file = create(part)?;
    let written = write(&mut file).and_then(|()| file.flush());
    drop(file);
    let placed = written.and_then(|()| fs::rename(part, path));
    if placed.is_err() {
        let _ = fs::remove_file(part);
    }
    placed
}

/// Removes a file that `is_own` recognises.
pub(crate) fn remove(path: &Path, is_own: impl Fn(&Path) -> bool) {
    if is_own(path) {
        let _ = fs::remove_file(path);
    }
}

/// Returns true if only this user can write to the file or folder. On systems other than Unix the
/// permissions are unknown, and the result is always true.
pub(crate) fn is_private(data: &Metadata) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        /// Permission bits that let the group or all users write.
        const OTHERS_WRITE: u32 = 0o022;
        let own = rustix::process::geteuid().as_raw();
        data.uid() == own && data.mode() & OTHERS_WRITE == 0
    }
    #[cfg(not(unix))]
    {
        let _ = data;
        true
    }
}
