//! Files of numbers, written and read.

mod malformed;
mod reading;
mod writing;

use branched_pendulum_data::{Table, TableOptions};

fn table(text: &str) -> Table {
    Table::parse("swing.csv", text, &TableOptions::default()).unwrap()
}

/// 2 s of two angles at 100 Hz.
fn swing() -> (Vec<f64>, [Vec<f64>; 2]) {
    let times: Vec<f64> = (0..200).map(|i| 0.01 * f64::from(i)).collect();
    let angles = [0.6, 0.9].map(|size| {
        let angle = |time: &f64| size * (4.0 * time + size).cos();
        times.iter().map(angle).collect()
    });
    (times, angles)
}

/// Camera frames of two links of 0.25 m hung on each other, 1,000 pixels a metre.
fn frames(likelihood: impl Fn(usize) -> f64) -> String {
    let (_, [one, two]) = swing();
    let mut text = String::from("scorer");
    for (row, words) in [
        ("", ["net"; 9]),
        (
            "bodyparts",
            [
                "top", "top", "top", "mid", "mid", "mid", "end", "end", "end",
            ],
        ),
        (
            "coords",
            [
                "x",
                "y",
                "likelihood",
                "x",
                "y",
                "likelihood",
                "x",
                "y",
                "likelihood",
            ],
        ),
    ] {
        text += &format!("{row},{}\n", words.join(","));
    }
    for (index, (one, two)) in one.iter().zip(&two).enumerate() {
        let middle = [300.0 + 250.0 * one.sin(), 100.0 + 250.0 * one.cos()];
        let end = [middle[0] + 250.0 * two.sin(), middle[1] + 250.0 * two.cos()];
        text += &format!(
            "{index},300,100,1,{},{},{},{},{},1\n",
            middle[0],
            middle[1],
            likelihood(index),
            end[0],
            end[1]
        );
    }
    text
}
