//! Folder for files of the compiler that all builds of one user share.

use std::path::PathBuf;

use directories::BaseDirs;

/// Cache folder of the user.
#[derive(Debug)]
pub(crate) enum UserFolder {
    /// The cache folder; it is created if necessary.
    Cache(PathBuf),
    /// The user's home folder is set but does not exist, as in the sandbox of a package manager.
    /// Nothing is created there.
    Homeless,
    /// No home folder is known.
    Unknown,
}

/// Finds the cache folder of the user as Symbolica does.
pub(crate) fn user_folder() -> UserFolder {
    let Some(folders) = BaseDirs::new() else {
        return UserFolder::Unknown;
    };
    let (home, cache) = (folders.home_dir(), folders.cache_dir());
    let is_missing = std::fs::symlink_metadata(home)
        .is_err_and(|error| error.kind() == std::io::ErrorKind::NotFound);
    match is_missing && cache.starts_with(home) {
        true => UserFolder::Homeless,
        false => UserFolder::Cache(cache.to_path_buf()),
    }
}
