//! The command, run as its users run it, with trees that nobody compiled.

mod answers;
mod cascade;
mod describe;
mod design;
mod differences;
mod flips;
mod frequencies;
mod held_out;
mod identify;
mod measured;
#[cfg(unix)]
mod processes;
mod records;
mod refusals;
mod repeated;
mod rest;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Runs the command with these words to its end.
fn run(words: &[&str]) -> Output {
    command(words).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// A folder for one test that is not there yet.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    path
}

/// Three rods, one below the other.
const TRIPLE: &str = "gravity = 9.80665,
upper: rod(mass = 0.3, length = 0.3) [
    middle: rod(mass = 0.2, length = 0.25) [lower: rod(mass = 0.1, length = 0.2)]
]";

/// Two equal arms on a stem, held up by springs.
const Y: &str = "gravity = -9.80665,
stem: rod(mass = 0.4, length = 0.5, spring = 40) [
    arm: rod(mass = 0.1, length = 0.35, spring = stiffness) * 2
]";

/// Three arms that are not copies of each other, with dry friction.
const UNEQUAL: &str = "gravity = 9.80665,
body: rod(mass = 0.3, length = 0.3, friction(viscous = 1e-4, coulomb = 2e-3, width = 0.05)) [
    one: rod(mass = 0.1, length = 0.2, friction(coulomb = 1e-3, width = 0.05)),
    two: rod(mass = 0.12, length = 0.25),
    three: rod(mass = 0.08, length = 0.15)
]";

/// A folder of a test, which goes when it ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("program-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// A file with this text.
    fn file(&self, name: &str, text: &str) -> String {
        let path = self.0.join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    }

    fn read(&self, name: &str) -> String {
        let path = self.0.join(name);
        std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// Runs the command with these words, its results in this folder.
    fn run(&self, words: &[&str]) -> Output {
        let mut command = command(words);
        command.arg("--output").arg(self.0.join("results"));
        command.output().unwrap()
    }

    /// Runs the command, which has to succeed, and returns what it prints.
    fn answer(&self, words: &[&str]) -> String {
        let output = self.run(words);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{words:?}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Columns of a table of results, whose first line names them.
    fn table(&self, name: &str) -> (Vec<String>, Vec<Vec<f64>>) {
        let text = self.read(&format!("results/{name}"));
        let mut lines = text.lines();
        let names = lines.next().unwrap().split(',').map(str::to_owned);
        let number = |cell: &str| cell.parse().unwrap_or(f64::NAN);
        let rows = lines.map(|line| line.split(',').map(number).collect());
        (names.collect(), rows.collect())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn command(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_branched-pendulum"));
    command.args(words).stdin(Stdio::null());
    command
}
