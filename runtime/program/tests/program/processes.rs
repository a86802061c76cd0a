//! How the subcommands end: closed pipes, full disks, folders that cannot be
//! written, Ctrl-C at any moment, and runs repeated from their records. Each
//! drives real processes.

use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use signal_hook::consts::SIGINT;

use super::{command, folder, text};

/// A subcommand in a short form.
struct Subcommand {
    name: &'static str,
    arguments: &'static [&'static str],
}

const fn subcommand(name: &'static str, arguments: &'static [&'static str]) -> Subcommand {
    Subcommand { name, arguments }
}

const SUBCOMMANDS: [Subcommand; 8] = [
    subcommand("simulate", &["--start", "40", "--duration", "4"]),
    subcommand("cascade", &["--onset", "1"]),
    subcommand("transfer", &["--start", "40,30,10", "--duration", "4"]),
    subcommand("describe", &["--tree", "y"]),
    subcommand("modes", &["--tree", "triple"]),
    subcommand("methods", &["--start", "40", "--duration", "1"]),
    subcommand("growth", &["--angles", "43,44", "--horizons", "4"]),
    subcommand("map", &["--duration", "2"]),
];

impl Subcommand {
    fn words(&self) -> Vec<&'static str> {
        [&[self.name], self.arguments].concat()
    }

    fn command(&self, folder: &Path) -> Command {
        let mut command = command(&self.words());
        command.arg("--output").arg(folder);
        command
    }
}

fn stderr(output: &Output) -> &str {
    text(&output.stderr)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).map(|entries| {
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.collect()
    });
    let mut names: Vec<String> = entries.unwrap_or_default();
    names.sort();
    names
}

/// Each file is what its name says, to its end, and the record lists them all.
fn assert_whole(folder: &Path, ended: &[&str]) {
    let names = names(folder);
    assert!(
        names.iter().all(|name| !name.ends_with(".part")),
        "{names:?}"
    );
    let mut columns = None;
    for name in &names {
        let bytes = fs::read(folder.join(name)).unwrap();
        match name.rsplit('.').next() {
            Some("csv") => {
                let text = std::str::from_utf8(&bytes).unwrap();
                assert!(text.ends_with('\n'), "{name}");
                let count = |line: &str| line.split(',').count();
                let first = *columns.insert(count(text.lines().next().unwrap()));
                // Names of methods have commas, in quotes.
                let plain = text.lines().filter(|line| !line.contains('"'));
                assert!(plain.map(count).all(|count| count == first), "{name}");
            }
            Some("txt") => assert!(bytes.ends_with(b"\n"), "{name}"),
            Some("svg") => assert!(bytes.trim_ascii_end().ends_with(b"</svg>"), "{name}"),
            Some("pdf") => {
                let is_whole = bytes.trim_ascii_end().ends_with(b"%%EOF");
                assert!(bytes.starts_with(b"%PDF-") && is_whole, "{name}");
            }
            Some("png") => assert!(bytes.ends_with(b"IEND\xaeB`\x82"), "{name}"),
            Some("json") => {
                let record: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
                if name != "run.json" {
                    continue;
                }
                let found = record["ended"].as_str().unwrap();
                assert!(ended.contains(&found), "{found}");
                let listed = record["files"].as_array().unwrap();
                let mut listed: Vec<&str> = listed.iter().map(|f| f.as_str().unwrap()).collect();
                listed.push("run.json");
                listed.sort_unstable();
                assert_eq!(listed, names);
            }
            _ => panic!("{name}"),
        }
    }
}

fn interrupt(child: &Child) {
    let pid = child.id().to_string();
    let sent = Command::new("sh")
        .args(["-c", "kill -INT \"$0\"", &pid])
        .status();
    assert!(sent.unwrap().success());
}

/// At five moments of each subcommand, from its first instant to its end. The five runs of
/// one go side by side: most of their time is waiting.
#[test]
fn ctrl_c_keeps_what_is_finished_and_leaves_nothing_half_written() {
    // A shell's background jobs ignore Ctrl-C, and so do their children until they take it
    // themselves. A signal that is handled here is one that children begin with.
    let shut_down = Arc::new(AtomicBool::new(true));
    signal_hook::flag::register_conditional_shutdown(SIGINT, 130, shut_down).unwrap();
    let mut random = SplitMix64::seed_from_u64(2026);
    for program in &SUBCOMMANDS {
        std::thread::scope(|scope| {
            for moment in 0..5 {
                // Moments spread over many sizes: subcommands take from 0.1 s to minutes.
                let share = random.next_u64() as f64 / u64::MAX as f64;
                let after = Duration::from_secs_f64(0.02 * 60.0_f64.powf(share));
                scope.spawn(move || interrupted(program, moment, after));
            }
        });
    }
}

/// Runs a subcommand and interrupts it after a time.
fn interrupted(program: &Subcommand, moment: u32, after: Duration) {
    let folder = folder(&format!("interrupted-{}-{moment}", program.name));
    let mut command = program.command(&folder);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    std::thread::sleep(after);
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    let stderr = text(&output.stderr);
    let case = format!("{} {moment}: {stderr}", program.name);
    match (output.status.code(), output.status.signal()) {
        // Done before.
        (Some(0), _) => assert_whole(&folder, &["finished"]),
        // Before it could say anything.
        (None, Some(2)) => assert!(names(&folder).is_empty(), "{case}"),
        (Some(130), _) => {
            assert_eq!(stderr.lines().count(), 1, "{case}");
            let start = format!("branched-pendulum {}: interrupted; ", program.name);
            assert!(stderr.starts_with(&start), "{case}");
            if folder.exists() {
                assert!(names(&folder).contains(&"run.json".to_owned()), "{case}");
                assert!(stderr.contains(folder.to_str().unwrap()), "{case}");
            } else {
                assert!(stderr.contains("no file was finished"), "{case}");
            }
            // It may just have finished.
            assert_whole(&folder, &["interrupted", "finished"]);
        }
        other => panic!("{other:?}: {case}"),
    }
    let _ = fs::remove_dir_all(&folder);
}

/// The subcommands that end within some seconds: the first ones.
fn quick() -> impl Iterator<Item = &'static Subcommand> {
    SUBCOMMANDS.iter().take(3)
}

/// `| head -1`: the first line is read, then the pipe is closed.
#[test]
fn a_closed_pipe_costs_no_file_and_one_line() {
    for program in quick() {
        let folder = folder(&format!("pipe-{}", program.name));
        let mut command = program.command(&folder);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // Closed before anything is written: no pipe holds the whole text then.
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let line = stderr(&output);
        assert_eq!(line.lines().count(), 1, "{line}");
        assert!(line.contains("standard output was closed; "), "{line}");
        assert!(line.contains(folder.to_str().unwrap()), "{line}");
        assert_whole(&folder, &["finished"]);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_told_in_one_line() {
    for program in quick() {
        let folder = folder(&format!("full-{}", program.name));
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = program.command(&folder).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1));
        let line = stderr(&output);
        assert_eq!(line.lines().count(), 1, "{line}");
        assert!(
            line.contains("cannot write to the standard output: No space left on device"),
            "{line}"
        );
        assert!(names(&folder).iter().all(|name| !name.ends_with(".part")));
        let help = File::options().write(true).open("/dev/full").unwrap();
        let mut help = command(&[program.name, "--help"])
            .stdout(help)
            .spawn()
            .unwrap();
        assert_eq!(help.wait().unwrap().code(), Some(1));
    }
}

/// A folder in place of a file: the rename fails, after the part was written.
#[test]
fn a_file_that_cannot_be_written_is_told_and_leaves_no_part() {
    for program in quick() {
        let folder = folder(&format!("taken-{}", program.name));
        let name = match program.name {
            "simulate" => "motion.csv",
            "transfer" => "transfer.csv",
            _ => "onset.csv",
        };
        fs::create_dir_all(folder.join(name)).unwrap();
        let output = program.command(&folder).output().unwrap();
        assert_eq!(output.status.code(), Some(1));
        let line = stderr(&output);
        assert_eq!(line.lines().count(), 1, "{line}");
        assert!(line.contains(&format!("cannot write {}", folder.join(name).display())));
        assert_eq!(names(&folder), [name]);
    }
}

/// Two runs with other arguments, started together with one folder: what is there at the end is
/// one of them as it is alone, and who was refused says who had it.
#[test]
fn two_runs_never_mix_in_a_folder() {
    const ANGLES: [&str; 2] = ["20", "30"];
    let run = |angle: &str, folder: &Path| {
        let mut command = command(&["simulate", "--duration", "1", "--start", angle]);
        command.arg("--output").arg(folder);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command
    };
    let contents = |folder: &Path| {
        let read = |name: String| (fs::read(folder.join(&name)).unwrap(), name);
        names(folder).into_iter().map(read).collect::<Vec<_>>()
    };
    let alone = ANGLES.map(|angle| {
        let folder = folder(&format!("alone-{angle}"));
        assert!(run(angle, &folder).status().unwrap().success());
        contents(&folder)
    });
    assert!(alone[0] != alone[1]);
    let mut refusals = 0;
    for pair in 0..20 {
        let folder = folder(&format!("together-{pair}"));
        let started = ANGLES.map(|angle| run(angle, &folder).spawn().unwrap());
        let [first, second] = started.map(|child| child.wait_with_output().unwrap());
        let found = contents(&folder);
        let kept = match [&first, &second].map(|output| output.status.code()) {
            [Some(0), Some(1)] => &alone[0],
            [Some(1), Some(0)] => &alone[1],
            // One had ended before the other began, and left its own files there as well.
            [Some(0), Some(0)] => {
                let record = found.iter().find(|(_, name)| name == "run.json").unwrap();
                let last = alone.iter().find(|run| run.contains(record));
                assert!(last.unwrap().iter().all(|file| found.contains(file)));
                continue;
            }
            other => panic!("{other:?}: {} {}", stderr(&first), stderr(&second)),
        };
        assert!(found == *kept);
        refusals += 1;
        let refused = [&first, &second].map(stderr).concat();
        assert!(refused.contains(": another run"), "{refused}");
        assert!(refused.contains("--output"), "{refused}");
        assert_eq!(refused.lines().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }
    assert!(refusals > 0, "no two runs met");
}

/// A run that was killed leaves its folder free, and what it had half written goes.
#[test]
fn a_killed_run_gives_its_folder_back() {
    let folder = folder("killed");
    let mut command = SUBCOMMANDS[0].command(&folder);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    while !folder.join(".running").exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let output = SUBCOMMANDS[0].command(&folder).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert_whole(&folder, &["finished"]);
}

#[test]
fn a_run_is_repeated_from_its_record() {
    for program in quick() {
        repeated(program);
    }
    let first = Path::new(env!("CARGO_TARGET_TMPDIR")).join("first-simulate/run.json");
    let other = command(&["cascade", "--repeat"]).arg(first).output();
    let other = other.unwrap();
    assert_eq!(other.status.code(), Some(2));
    assert!(stderr(&other).contains("records a run of branched-pendulum simulate"));
}

/// Repeats a run: same bytes in every file, the record included.
fn repeated(program: &Subcommand) {
    let (first, again) = (
        folder(&format!("first-{}", program.name)),
        folder(&format!("again-{}", program.name)),
    );
    let record = first.join("run.json");
    let output = program.command(&first).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let repeat = |more: &[&str]| {
        let mut command = command(&[program.name, "--repeat"]);
        command.arg(&record).arg("--output").arg(&again);
        command.args(more).output().unwrap()
    };
    let option = program.arguments[0];
    let refused = repeat(&[option, program.arguments[1]]);
    assert_eq!(refused.status.code(), Some(2));
    let named = format!("`--repeat` takes the value of `{}`", &option[2..]);
    assert!(stderr(&refused).contains(&named), "{}", stderr(&refused));
    let output = repeat(&[]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(names(&first), names(&again));
    for name in names(&first) {
        let read = |folder: &Path| fs::read(folder.join(&name)).unwrap();
        assert!(read(&first) == read(&again), "{name}");
    }
}
