//! Runs that last, and many of them: checkpoints, shards, engines.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::{command, files, finished, folder, options, text};

/// Killed twenty times on its way and taken up each time, a run leaves the files that it
/// leaves undisturbed, byte for byte.
#[test]
fn a_run_that_is_killed_goes_on_with_the_same_bytes() {
    let (whole, killed) = (folder("whole"), folder("killed"));
    let began = Instant::now();
    finished(&command(&whole, &[]).output().unwrap());
    let time = began.elapsed();
    let mut random = SplitMix64::seed_from_u64(5);
    let mut kills = 0;
    let mut attempts = 0;
    while kills < 20 {
        attempts += 1;
        assert!(attempts < 200, "it never gets on");
        let mut child = command(&killed, &[]).spawn().unwrap();
        // Twenty-one such times are about the time of the whole run.
        let share = random.next_u64() as f64 / u64::MAX as f64;
        std::thread::sleep(time.mul_f64(0.02 + 0.06 * share));
        if child.try_wait().unwrap().is_none() {
            child.kill().unwrap();
            kills += 1;
        } else if files(&killed).contains_key("report.md") {
            // Done too soon: it begins anew.
            fs::remove_dir_all(&killed).unwrap();
        }
        child.wait().unwrap();
    }
    finished(&command(&killed, &[]).output().unwrap());
    let (whole, killed) = (files(&whole), files(&killed));
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&whole), names(&killed));
    for (name, bytes) in whole {
        assert!(killed[&name] == bytes, "{name}");
    }
}

/// A checkpoint that is damaged, or of another run, is refused in words.
#[test]
fn a_checkpoint_of_another_run_is_refused() {
    let folder = folder("foreign");
    let mut child = command(&folder, &["--duration", "100000"]).spawn().unwrap();
    let checkpoint = folder.join("checkpoint");
    while !checkpoint.exists() {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let refused = |more: &[&str], reported: &str| {
        let output = command(&folder, more).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{stderr}");
        assert!(
            stderr.contains("cannot resume from") && stderr.contains(reported),
            "{stderr}"
        );
    };
    refused(
        &["--duration", "100000", "--seed", "2"],
        "the file belongs to another run: branched-pendulum cascade",
    );
    let mut bytes = fs::read(&checkpoint).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&checkpoint, bytes).unwrap();
    refused(&["--duration", "100000"], "damaged");
}

/// A tree is edited while its run is dead: the run does not go on with the other tree.
#[test]
fn a_checkpoint_of_another_tree_is_refused() {
    let folder = folder("edited");
    fs::create_dir_all(&folder).unwrap();
    let tree = folder.join("tree.txt");
    let description = |mass: &str| {
        format!(
            "gravity = 9.81,\narm: generations(count = 3, branching = 2, shape = rod, mass = {mass},\n    \
             length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4)\n"
        )
    };
    fs::write(&tree, description("0.12")).unwrap();
    let results = folder.join("results");
    let tree = tree.to_str().unwrap().to_owned();
    let run = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_branched-pendulum"));
        command.args([
            "cascade",
            "--tree",
            &tree,
            "--starts",
            "4",
            "--threads",
            "1",
        ]);
        command.args(["--duration", "100000", "--checkpoint", "0", "--output"]);
        command
            .arg(&results)
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        command
    };
    let mut child = run().spawn().unwrap();
    let checkpoint = results.join("checkpoint");
    while !checkpoint.exists() {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    for mass in ["0.5", "0.1", "0.121"] {
        fs::write(&tree, description(mass)).unwrap();
        let output = run().output().unwrap();
        let errors = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert!(
            errors.contains("tree.txt` has changed: line 2 was `arm: "),
            "{errors}"
        );
    }
}

/// What 64 shards are cut from.
const STARTS: &[&str] = &["--starts", "64", "--duration", "10"];

fn same_tables(whole: &Path, merged: &Path) {
    for name in [
        "windows.csv",
        "scales.csv",
        "report.md",
        "tree.svg",
        "course.svg",
    ] {
        let read = |folder: &Path| fs::read(folder.join(name)).unwrap();
        assert!(read(whole) == read(merged), "{name}");
    }
}

#[test]
fn shards_make_the_tables_of_one_process() {
    shards("64-shards", 64, STARTS);
}

#[test]
#[ignore = "a thousand processes: cargo test --test program -- --ignored a_thousand"]
fn a_thousand_shards_make_the_tables_of_one_process() {
    let starts = &["--starts", "1000", "--duration", "10"];
    shards("1000-shards", 1000, starts);
}

/// Two workers take shards from a queue; one of them is killed halfway with its shard, which
/// is computed again. The merged tables are those of one process.
fn shards(name: &str, count: u32, starts: &[&str]) {
    let (whole, swept) = (folder(&format!("{name}-whole")), folder(name));
    finished(&command(&whole, starts).output().unwrap());
    let next = AtomicU32::new(0);
    let part = |option: &str, value: &str| command(&swept, &[starts, &[option, value]].concat());
    let shard = |index: u32| part("--shard", &format!("{index}/{count}"));
    let killed = count / 2;
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        break;
                    }
                    if index == killed {
                        let mut child = shard(index).spawn().unwrap();
                        std::thread::sleep(Duration::from_millis(5));
                        child.kill().unwrap();
                        child.wait().unwrap();
                        // Its work is lost; the other one goes on.
                        break;
                    }
                    finished(&shard(index).output().unwrap());
                }
            });
        }
    });
    let merge = || part("--merge", &count.to_string()).output().unwrap();
    if !swept
        .join(format!("shard-{killed}-of-{count}/results.bin"))
        .exists()
    {
        let refused = merge();
        let reported = format!("1 of {count} shards are not finished: {killed}");
        assert!(text(&refused.stderr).contains(&reported));
    }
    finished(&shard(killed).output().unwrap());
    // What is there is not computed again.
    assert!(text(&shard(7).output().unwrap().stdout).contains("is there"));
    finished(&merge());
    same_tables(&whole, &swept);
}

/// The same by an engine, HyperQueue's workers in one Python process, where Python has it
/// (`pip install hyperqueue`); a machine that promises it says so by `HYPERQUEUE`.
#[test]
fn hyperqueue_makes_the_tables_of_one_process() {
    let python = |arguments: &[&str]| {
        let mut command = Command::new("python3");
        command.args(arguments).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    };
    let has = python(&["-c", "import hyperqueue"]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        assert!(std::env::var_os("HYPERQUEUE").is_none(), "no hyperqueue");
        println!("skipped: python3 has no hyperqueue");
        return;
    }
    let (whole, swept) = (folder("one-process-hq"), folder("hyperqueue"));
    finished(&command(&whole, STARTS).output().unwrap());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/sweep/hyperqueue_sweep.py");
    let swept_path = swept.to_str().unwrap();
    let mut words = vec![
        script,
        "64",
        "--workers",
        "2",
        "--",
        env!("CARGO_BIN_EXE_branched-pendulum"),
        "cascade",
    ];
    words.extend(options(STARTS));
    words.extend(["--output", swept_path]);
    // Killed halfway, engine, workers and all, and started again.
    let mut engine = python(&words).spawn().unwrap();
    let count = || {
        (0..64)
            .filter(|index| {
                swept
                    .join(format!("shard-{index}-of-64/results.bin"))
                    .exists()
            })
            .count()
    };
    while count() < 20 {
        if let Some(status) = engine.try_wait().unwrap() {
            panic!("it ended too soon: {status}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    engine.kill().unwrap();
    engine.wait().unwrap();
    let done = count();
    finished(&python(&words).output().unwrap());
    println!("killed after {done} of 64 shards");
    same_tables(&whole, &swept);
}
