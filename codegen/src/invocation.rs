//! Command line of the compiler that runs the attribute.

use std::ffi::OsString;
use std::path::Path;

/// Name of the runtime crate in Rust code.
const RUNTIME: &str = "branched_pendulum";

/// Returns the name that the crate being compiled uses for the runtime, if it has renamed the
/// runtime.
pub(crate) fn renamed_runtime() -> Option<String> {
    renamed_among(std::env::args_os())
}

/// Returns the name of the runtime among the options `--extern NAME=FILE` of a command line; `None`
/// if the runtime is available under its own name.
fn renamed_among(arguments: impl Iterator<Item = OsString>) -> Option<String> {
    let mut renamed = None;
    let mut is_next = false;
    for argument in arguments {
        let text = argument.to_string_lossy();
        let given = match text.strip_prefix("--extern=") {
            _ if is_next => Some(&*text),
            given => given,
        };
        is_next = !is_next && text == "--extern";
        let Some((name, file)) = given.and_then(|given| given.split_once('=')) else {
            // The compiler finds a crate without a file by its name.
            if given.is_some_and(|given| name_of(given) == RUNTIME) {
                return None;
            }
            continue;
        };
        let name = name_of(name);
        if name == RUNTIME {
            return None;
        }
        let file = Path::new(file).file_name().unwrap_or_default();
        let file = file.to_string_lossy();
        let library = file.strip_prefix("lib").unwrap_or(&file);
        let rest = library.strip_prefix(RUNTIME);
        if rest.is_some_and(|rest| rest.starts_with(['-', '.'])) {
            renamed = Some(name.to_owned());
        }
    }
    renamed
}

/// Returns the name in `OPTIONS:NAME`.
fn name_of(text: &str) -> &str {
    text.rsplit_once(':').map_or(text, |(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::renamed_among;

    fn renamed(line: &str) -> Option<String> {
        renamed_among(line.split(' ').map(Into::into))
    }

    #[test]
    fn another_name_of_the_runtime_is_found() {
        let macros = "--extern branched_pendulum_macros=/t/libbranched_pendulum_macros-1.so";
        for line in [
            "rustc a.rs --extern bp=/t/deps/libbranched_pendulum-12ab.rlib -O",
            "rustc a.rs --extern=bp=/t/deps/libbranched_pendulum-12ab.rmeta",
            "rustc a.rs --extern priv:bp=libbranched_pendulum.rlib --extern serde=/t/libserde-1.rlib",
        ] {
            assert_eq!(renamed(line).as_deref(), Some("bp"), "{line}");
            assert_eq!(renamed(&format!("{line} {macros}")).as_deref(), Some("bp"));
            let both = format!("{line} --extern branched_pendulum=/t/libbranched_pendulum-3.rlib");
            assert_eq!(renamed(&both), None);
            assert_eq!(renamed(&format!("{line} --extern branched_pendulum")), None);
        }
        for line in [
            "",
            "rustc a.rs",
            "rustc --extern serde=/t/libserde-1.rlib",
            macros,
        ] {
            assert_eq!(renamed(line), None, "{line}");
        }
    }
}
