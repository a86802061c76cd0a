//! `branched-pendulum identify --frequency`: inertias from frequencies, alone and beside a record.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::identify::{measured, tree};
use super::{folder, run, text};

/// Runs `identify` with results in a folder; its exit code and what it prints.
fn identify(output: &Path, words: &str) -> (Option<i32>, String) {
    let mut all = vec!["identify", "--output", output.to_str().unwrap()];
    all.extend(words.split_whitespace());
    let done = run(&all);
    let printed = format!("{}{}", text(&done.stdout), text(&done.stderr));
    (done.status.code(), printed)
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The three frequencies of the paper's apparatus (Hz) by its moments of inertia, by hand: those
/// of the matrices of the motion in phase, and √(G_2/M_2) of the difference.
fn by_hand([i_1, i_2]: [f64; 2]) -> [f64; 3] {
    let (g, l, d_1, d_2, m_1, m_2) = (9.80665, 0.27, 0.084, 0.043, 0.12880, 0.10531);
    let a = i_1 + m_1 * d_1 * d_1 + 2.0 * m_2 * l * l;
    let b = i_2 + m_2 * d_2 * d_2;
    let mu = m_2 * l * d_2;
    let (g_1, g_2) = (g * (m_1 * d_1 + 2.0 * m_2 * l), g * m_2 * d_2);
    let p = 2.0 * a * b - 4.0 * mu * mu;
    let q = 2.0 * (g_1 * b + g_2 * a);
    let root = (q * q - 8.0 * p * g_1 * g_2).sqrt();
    let squares = [(q - root) / (2.0 * p), g_2 / b, (q + root) / (2.0 * p)];
    squares.map(|square| square.sqrt() / TAU)
}

/// Least squares by hand, all errors alike: the inertias and their deviations.
fn least_squares(data: [f64; 3], error: f64) -> [[f64; 2]; 2] {
    let mut inertias = [1.88e-3, 0.516e-3];
    let mut deviations = [0.0; 2];
    for _ in 0..20 {
        let slope = |index: usize| {
            let step = 1e-5 * inertias[index];
            let moved = |side: f64| {
                let mut inertias = inertias;
                inertias[index] += side * step;
                by_hand(inertias)
            };
            let (above, below) = (moved(1.0), moved(-1.0));
            [0, 1, 2].map(|mode: usize| (above[mode] - below[mode]) / (2.0 * step))
        };
        let [u, v] = [slope(0), slope(1)];
        let found = by_hand(inertias);
        let rest = [0, 1, 2].map(|mode: usize| data[mode] - found[mode]);
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (a, b, c) = (dot(u, u), dot(u, v), dot(v, v));
        let (x, y) = (dot(u, rest), dot(v, rest));
        let determinant = a * c - b * b;
        inertias[0] += (c * x - b * y) / determinant;
        inertias[1] += (a * y - b * x) / determinant;
        deviations = [c, a].map(|part| error * (part / determinant).sqrt());
    }
    [inertias, deviations]
}

#[test]
fn inertias_of_the_paper_follow_from_its_frequencies() {
    let output = folder("identify-paper").join("found");
    let words = "--tree apparatus --unknown inertia_1=1e-3,inertia_2=1e-3 \
                 --frequency 1.58:0.005 --frequency 0.88:0.005,1.26:0.005";
    let (code, printed) = identify(&output, words);
    assert_eq!(code, Some(0), "{printed}");
    for words in [
        "Sum of squares of what they are above: 2.11, where 1 ± 1.4 is expected",
        "Parameters by frequencies alone",
        "The data determine 2 combinations of 2 unknowns.",
    ] {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    // Another pair than the published one has all three to their last digit.
    let digits = |inertias| by_hand(inertias).map(|hertz| (1e2 * hertz).round());
    assert_eq!(digits([1.702e-3, 0.5188e-3]), [88.0, 126.0, 158.0]);
    assert_eq!(digits([1.88e-3, 0.516e-3]), [87.0, 126.0, 158.0]);
    let [inertias, deviations] = least_squares([0.88, 1.26, 1.58], 0.005);
    let published = [1.88e-3, 0.516e-3];
    let found = json(&output.join("parameters.json"));
    let record = json(&output.join("run.json"));
    let estimates = &record["report"]["by_frequencies"]["parameters"];
    for (index, name) in ["inertia_1", "inertia_2"].into_iter().enumerate() {
        let value = found[name].as_f64().unwrap();
        assert!(
            (value / inertias[index] - 1.0).abs() < 1e-6,
            "{name} {value}"
        );
        let own = &estimates[index];
        assert_eq!(own["name"], name);
        let deviation = own["deviation"].as_f64().unwrap();
        let ratio = deviation / deviations[index];
        assert!((ratio - 1.0).abs() < 1e-3, "{name} {deviation}");
        // The published inertias are a deviation away at most.
        assert!(
            (value - published[index]).abs() < deviation,
            "{name} {value}"
        );
    }
    let table = fs::read_to_string(output.join("frequencies.csv")).unwrap();
    assert!(
        table.starts_with("mode,measured [Hz],error [Hz],model [Hz]\n3,1.58,0.005,1.5827"),
        "{table}"
    );
    // The run is repeated from its record.
    let again = output.with_file_name("again");
    let (code, printed) = identify(
        &again,
        &format!("--repeat {}", output.join("run.json").display()),
    );
    assert_eq!(code, Some(0), "{printed}");
    assert_eq!(json(&again.join("parameters.json")), found);
}

/// A bent link swings about the place where it hangs, and dry friction does not change how fast.
#[test]
fn frequencies_are_those_about_the_place_of_rest() {
    let folder = folder("identify-bent");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("bent.txt");
    let bent = "gravity = 9.81, arm(mass = 0.2, com = (0.1, 0.08), inertia = i,
        friction(viscous = 0, coulomb = 2e-3, width = 0.05))";
    fs::write(&file, bent).unwrap();
    // ω² = m g r/(I + m r²).
    let square = 0.1_f64.powi(2) + 0.08_f64.powi(2);
    let rate = 0.2 * 9.81 * square.sqrt() / (1e-3 + 0.2 * square);
    let hertz = rate.sqrt() / TAU;
    let words = format!(
        "--tree {} --unknown i=2e-3 --frequency {hertz}:1e-4",
        file.display()
    );
    let output = folder.join("found");
    let (code, printed) = identify(&output, &words);
    assert_eq!(code, Some(0), "{printed}");
    let found = json(&output.join("parameters.json"))["i"].as_f64().unwrap();
    assert!((found / 1e-3 - 1.0).abs() < 1e-6, "{found}");
}

/// Frequencies by the matrices of the true tree, beside its motion.
#[test]
fn frequencies_stand_beside_a_record() {
    let (description, file) = measured("frequencies");
    let modes = tree().modes(&[0.0; 3]).unwrap().frequencies_hz;
    let frequencies = modes.iter().enumerate();
    let frequencies = frequencies.map(|(index, hertz)| format!("{hertz}:2e-4@{}", index + 1));
    let frequencies = frequencies.collect::<Vec<_>>().join(",");
    let words = format!(
        "{} --tree {} --to 4 --laws coulomb --frequency {frequencies} \
         --unknown upper_length=0.33,lower_mass=0.085,viscous=3e-4,coulomb",
        file.display(),
        description.display(),
    );
    let output = file.with_file_name("output");
    let (code, printed) = identify(&output, &words);
    assert_eq!(code, Some(0), "{printed}");
    assert!(printed.contains("and by how many errors"), "{printed}");
    let record = json(&output.join("run.json"));
    let fit = &record["report"]["and Coulomb"]["by_one_motion"];
    let (mut number, mut least) = (0, f64::INFINITY);
    for own in fit["frequencies"].as_array().unwrap() {
        let above = own["model"].as_f64().unwrap() - own["measured"].as_f64().unwrap();
        assert!(above.abs() < 3.0 * 2e-4, "{own}");
        number += 1;
        least = f64::min(least, above.abs());
    }
    assert_eq!(number, 3);
    // Noise of the angles moves them: they are weighed, and not met.
    assert!(least > 0.0);
    let found = fit["parameters"].as_array().unwrap();
    let mass = found
        .iter()
        .find(|own| own["name"] == "lower_mass")
        .unwrap();
    let off = (mass["value"].as_f64().unwrap() - 0.1).abs();
    assert!(off < 4.0 * mass["deviation"].as_f64().unwrap(), "{mass}");
    let table = fs::read_to_string(output.join("frequencies.csv")).unwrap();
    assert_eq!(table.lines().count(), 4, "{table}");
}

#[test]
fn frequencies_that_make_no_sense_are_refused() {
    let output = folder("identify-no-frequencies");
    let inertias = "--tree apparatus --unknown inertia_1,inertia_2";
    for (words, code, message) in [
        (
            "--frequency 0.88:0.005@1",
            1,
            "1 data for 2 unknown numbers or more: give more data, or leave fewer unknown",
        ),
        (
            "--frequency 0.88:0.005@1,1.58:0.005@4",
            1,
            "a frequency of mode 4, but 3 modes oscillate about rest: they have the numbers from 1 on",
        ),
        (
            "--frequency 0.88:0.005@0,1.58:0.005@3",
            1,
            "a frequency of mode 0, but 3 modes oscillate",
        ),
        (
            "--frequency 0.88:0.005,1.58:0.005",
            1,
            "2 frequencies without the numbers of their modes, where 3 modes oscillate about rest: \
             give the number of each one's mode",
        ),
        (
            "--frequency 0.88:0.005@1,1.58:0.005",
            1,
            "1 of 2 frequencies have no number of a mode",
        ),
        (
            "--frequency=-0.88:0.005",
            2,
            "`-0.88:0.005` is not a frequency with its standard error",
        ),
        ("--frequency 0.88:0", 2, "write `0.88:0.005`"),
        ("--frequency 0.88:-0.01", 2, "write `0.88:0.005`"),
        ("--frequency 0.88", 2, "write `0.88:0.005`"),
        ("--frequency 0.88:0.005@slow", 2, "`0.88:0.005@1`"),
        // Nothing turns a link back.
        (
            "--set gravity=0 --frequency 0.88:0.005@1,1.58:0.005@2",
            1,
            "a frequency of mode 1, but 0 modes oscillate",
        ),
        (
            "--frequency 0.88:0.005@1 --noise 1e-3",
            2,
            "--noise applies to a record of the motion, but --frequency replaces the record: name \
             the file of a record, or leave out --noise",
        ),
        (
            "--frequency 0.88:0.005@1 --fit 3",
            2,
            "--fit applies to a record",
        ),
        (
            "--frequency 0.88:0.005@1 --columns a,b",
            2,
            "--columns applies to a file of measurements, but no file is given",
        ),
    ] {
        let (ended, printed) = identify(&output, &format!("{inertias} {words}"));
        assert_eq!(ended, Some(code), "{words}: {printed}");
        // Lines are broken in the messages of the command line.
        let reported = printed.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(reported.contains(message), "{words}: {printed}");
    }
}
