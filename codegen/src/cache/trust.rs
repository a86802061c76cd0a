//! Who may have written a folder or a file.

use std::fs::Metadata;
use std::path::Path;
use std::sync::Once;

/// Returns true if only this user writes there. Other systems than Unix do not say so, and
/// all is believed.
pub(super) fn is_private(data: &Metadata) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        /// Write permission of the group and of all.
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

/// Says once for the process that a folder is not used, and why.
pub(super) fn tell(folder: &Path) {
    static TOLD: Once = Once::new();
    TOLD.call_once(|| {
        eprintln!(
            "branched-pendulum: kept expansions in `{}` are not used, since another user may \
             write them: make the folder yours alone (chown, chmod go-w) or remove it, or name \
             another one with {}",
            folder.display(),
            super::VARIABLE,
        );
    });
}
