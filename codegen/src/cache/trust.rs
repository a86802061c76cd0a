//! Warning about a folder that another user may have written to.

use std::path::Path;
use std::sync::Once;

/// Prints that a folder is not used, and the reason; once per process.
pub(super) fn warn_once(folder: &Path) {
    static WARNED: Once = Once::new();
    WARNED.call_once(|| {
        eprintln!(
            "branched-pendulum: kept expansions in `{}` are not used, since another user may \
             write them: make the folder yours alone (chown, chmod go-w) or remove it, or name \
             another one with {}",
            folder.display(),
            super::VARIABLE,
        );
    });
}
