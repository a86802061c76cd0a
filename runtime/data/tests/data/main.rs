//! Files of numbers, written and read.

mod exchanges;
mod findings;
mod malformed;
mod reading;
mod writing;
mod wrong_pictures;

use branched_pendulum_data::{Table, TableOptions};

fn table(text: &str) -> Table {
    Table::parse("swing.csv", text, &TableOptions::default()).unwrap()
}

/// Random numbers that are the same every time.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        Self(0x2545_f491_4f6c_dd1d ^ seed)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    /// Between 0 and 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
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
