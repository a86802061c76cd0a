//! Faults that nobody marked: leaps of a motion are reported with their times, by smoothness alone.

use super::{Random, table};
use branched_pendulum_data::{AngleColumns, AngleZero, Recording};

/// A swing of a double pendulum in its two modes, with uneven parts and a phase.
fn swing(time: f64, [large, small, phase]: [f64; 3]) -> [f64; 2] {
    let slow = large * (4.6 * time + phase).cos();
    let fast = small * (11.3 * time + 2.0 * phase).cos();
    [slow + fast, 1.4 * slow - 1.3 * fast]
}

/// A record of two links.
struct Record {
    rate: f64,
    rows: Vec<[f64; 2]>,
}

impl Record {
    fn new(rate: f64, noise: f64, random: &mut Random) -> Self {
        let shape = [
            0.3 + random.unit(),
            0.3 * random.unit(),
            6.0 * random.unit(),
        ];
        let count = 200 + random.below(300);
        let mut rows = Vec::with_capacity(count);
        for row in 0..count {
            let angles = swing(row as f64 / rate, shape);
            // Nearly normal.
            let mut normal = || (0..6).map(|_| random.unit() - 0.5).sum::<f64>() * 2.0_f64.sqrt();
            rows.push(angles.map(|angle| angle + noise * normal()));
        }
        Self { rate, rows }
    }

    fn read(&self) -> Recording {
        let mut text = "t (s),a (rad),b (rad)\n".to_owned();
        for (row, [a, b]) in self.rows.iter().enumerate() {
            text += &format!("{:.6},{a:.6},{b:.6}\n", row as f64 / self.rate);
        }
        let columns = AngleColumns {
            zero: Some(AngleZero::Down),
            ..AngleColumns::default()
        };
        columns.read(&table(&text)).unwrap()
    }
}

/// The finding about leaps.
fn leaps(recording: &Recording) -> Option<&str> {
    let texts = recording
        .findings
        .iter()
        .map(|finding| finding.text.as_str());
    texts
        .into_iter()
        .find(|text| text.starts_with("angles leap"))
}

/// Right records of films and encoders show no leap.
#[test]
fn right_records_have_no_leaps() {
    let mut random = Random::new(3);
    let mut wrong = 0;
    for index in 0..200 {
        let rate = [60.0, 120.0, 240.0, 1000.0][index % 4];
        let noise = [1e-4, 1e-3, 5e-3][index % 3];
        let recording = Record::new(rate, noise, &mut random).read();
        if let Some(text) = leaps(&recording) {
            println!("{index}: {rate} Hz, {noise} rad: {text}");
            wrong += 1;
        }
    }
    assert!(wrong <= 2, "{wrong} of 200");
}

/// Steps that stay, signs, zeros and frozen rows of a link that moves are reported at their times,
/// unless the reader takes them for outliers.
#[test]
fn leaps_are_reported_with_their_times() {
    let mut random = Random::new(5);
    let names = ["step", "sign", "zeros", "frozen", "lost rows"];
    for (kind, name) in names.into_iter().enumerate() {
        let mut found = 0;
        for index in 0..20 {
            let rate = [60.0, 120.0, 240.0][index % 3];
            let mut record = Record::new(rate, 1e-3, &mut random);
            let count = record.rows.len();
            // Where the link is far from 0 and moves.
            let moves = |row: &usize| {
                let [before, here] = [row - 1, *row].map(|row| record.rows[row][1]);
                here.abs() > 0.2 && (here - before).abs() * rate > 1.0
            };
            let first = (count / 3..count - 60).find(moves);
            let Some(first) = first else {
                found += 1;
                continue;
            };
            let held = record.rows[first - 1][1];
            let length = if kind == 0 {
                count - first
            } else {
                8 + index % 5
            };
            for row in &mut record.rows[first..first + length] {
                row[1] = match kind {
                    0 => row[1] + 0.3,
                    1 => -row[1],
                    2 => 0.0,
                    3 => held,
                    _ => row[1],
                };
            }
            if kind == 4 {
                record.rows.drain(first..first + length);
            }
            let recording = record.read();
            // A fault ends where it begins, or some rows later.
            let last = if kind == 0 || kind == 4 {
                first
            } else {
                first + length
            };
            let ends = [first, last].map(|row| row as f64 / rate);
            let is_near = |time: f64| ends.iter().any(|end| (time - end).abs() <= 8.0 / rate);
            let numbers = leaps(&recording).map(|text| {
                let words = text.split([' ', ',']);
                words
                    .filter_map(|word| word.parse::<f64>().ok())
                    .collect::<Vec<_>>()
            });
            let is_reported = numbers.is_some_and(|all| all.into_iter().any(is_near));
            let is_marked = recording.links[1].angle(first).is_none();
            found += usize::from(is_reported || is_marked);
        }
        println!("{name}: {found} of 20");
        assert!(found >= 18, "{name}: {found} of 20");
    }
}
