//! Runs are repeated from their records, trees are read from standard input, and completions
//! are written.

use std::io::Write;
use std::process::Stdio;

use super::{Folder, Y, command};

#[test]
fn a_record_repeats_the_run() {
    let folder = Folder::new("repeated");
    let y = folder.file("y.txt", Y);
    let words = [
        "simulate",
        "--tree",
        &y,
        "--duration",
        "1",
        "--start",
        "stem=10,arm_1=3",
    ];
    let others = [
        "--set",
        "stiffness=3",
        "--rates",
        "arm=-20",
        "--figure-width",
        "85mm",
        "--show",
        "0.2:0.6",
    ];
    folder.answer(&[&words[..], &others].concat());
    let first = folder.read("results/motion.csv");
    // Its charts are figures of a paper, in three formats.
    let chart = folder.read("results/motion.svg");
    assert!(chart.contains("width=\"85mm\""), "{chart:.200}");
    // They show a part of the time, of which the table has all.
    assert!(chart.contains(">0.6</text>") && !chart.contains(">0.8</text>"));
    assert!(first.lines().last().unwrap().starts_with("1.0,"));
    for format in ["pdf", "png"] {
        let file = folder.0.join(format!("results/motion.{format}"));
        assert!(std::fs::metadata(file).unwrap().len() > 1000);
    }
    let record = folder.0.join("results/run.json");
    let again = folder.0.join("again");
    let output = command(&["simulate", "--repeat", record.to_str().unwrap(), "--output"])
        .arg(&again)
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert_eq!(first, folder.read("again/motion.csv"));
    assert_eq!(chart, folder.read("again/motion.svg"));
    // A record of another subcommand is none of this one.
    let output = command(&["modes", "--repeat", record.to_str().unwrap()])
        .output()
        .unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(
        text.contains("records a run of branched-pendulum simulate"),
        "{text}"
    );
}

/// Files of a run are changed after it: its record no longer repeats it, and says why.
#[test]
fn a_record_of_other_input_is_refused() {
    const ROD: &str = "gravity = 9.80665,\nrod: rod(mass = 0.2, length = 0.3, friction = c)\n";
    let folder = Folder::new("repeated-input");
    let rows = (0..120).map(|row| {
        let time = f64::from(row) * 0.01;
        format!(
            "{time:.2},{:.6}\n",
            0.2 * (7.0 * time).cos() * (-0.3 * time).exp()
        )
    });
    let table = format!("t [s],rod [rad]\n{}", rows.collect::<String>());
    let tree = folder.file("rod.txt", ROD);
    let constants = folder.file("constants.json", "{\n  \"c\": 0.0003\n}\n");
    let film = folder.file("film.csv", &table);
    let short = ["--start", "20", "--duration", "0.2"];
    let simulate = [
        &["simulate", "--tree", &tree, "--parameters", &constants][..],
        &short,
    ]
    .concat();
    let describe = ["describe", "--tree", &tree, "--parameters", &constants].to_vec();
    let analyse = [
        "analyse",
        &film,
        "--tree",
        &tree,
        "--parameters",
        &constants,
    ]
    .to_vec();
    for (words, changed, before, after, reported) in [
        (
            &simulate,
            "rod.txt",
            ROD.to_owned(),
            ROD.replace("0.2", "0.5"),
            "line 2 was `rod: rod(mass = 0.2",
        ),
        (
            &describe,
            "constants.json",
            "{\"c\": 3e-4}".to_owned(),
            "{\"c\": 4e-4}".to_owned(),
            "line 2 was `\"c\": 0.0003`",
        ),
        (
            &analyse,
            "film.csv",
            table.clone(),
            table.replace("\n0.10,", "\n0.10,1"),
            "line 12 was `0.10,",
        ),
        (
            &analyse,
            "rod.txt",
            ROD.to_owned(),
            ROD.replace("9.80665", "9.81"),
            "line 1 was `gravity = 9.80665,`",
        ),
    ] {
        let _ = std::fs::remove_dir_all(folder.0.join("results"));
        folder.file(changed, &before);
        folder.answer(words);
        let record = folder.0.join("results/run.json");
        let again = folder.0.join("again");
        let repeat = || {
            let mut command = command(&[words[0], "--repeat", record.to_str().unwrap()]);
            command.arg("--output").arg(&again).output().unwrap()
        };
        folder.file(changed, &after);
        let refused = repeat();
        let errors = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(1), "{errors}");
        assert!(
            errors.contains(reported) && errors.contains(changed),
            "{errors}"
        );
        assert!(errors.contains("help: restore the file"), "{errors}");
        assert!(!again.exists());
        folder.file(changed, &before);
        assert!(repeat().status.success());
        std::fs::remove_dir_all(&again).unwrap();
    }
}

#[test]
fn standard_input_is_a_tree() {
    let mut child = command(&["describe", "--tree", "-", "--set", "stiffness=4"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(Y.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("arm_2  stem"), "{text}");
}

#[test]
fn help_names_every_subcommand_and_shells_are_completed() {
    let output = command(&["--help"]).output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    let completed = command(&["completions", "bash"]).output().unwrap();
    let script = String::from_utf8(completed.stdout).unwrap();
    for name in [
        "describe", "simulate", "modes", "growth", "map", "transfer", "methods", "advise",
    ] {
        assert!(help.contains(&format!("\n  {name} ")), "{help}");
        assert!(script.contains(name));
        let own = command(&[name, "--help"]).output().unwrap();
        let own = String::from_utf8(own.stdout).unwrap();
        assert!(
            own.contains(&format!("Usage: branched-pendulum {name}")),
            "{own}"
        );
        assert!(own.contains("--tree <FILE|NAME>") && own.contains("--set <NAME=VALUE"));
    }
    assert!(script.contains("--duration"));
}
