//! Simulated films with faults.

use std::f64::consts::PI;
use std::fmt::Write;

use rand_distr::{Distribution, StandardNormal, Uniform};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::super::super::{Arguments, Source};
use super::super::tree;
use crate::frame::command_line::parse_line;

/// A fault of a film, or of what is known of the pendulum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Fault {
    /// y grows downwards, and nothing says so.
    Y,
    /// Angles are degrees, or radians, and an option says the other.
    Unit,
    /// Angles count from a horizontal axis.
    Side,
    /// The camera is not plumb.
    Tilt,
    /// A dot is lost for some pictures, and has a mark or stays.
    Lost,
    /// Two dots have each other's name.
    Swapped,
    /// The links hang, are lifted, and are held before they are released.
    Late,
    /// The friction is not known.
    Friction,
}

impl Fault {
    const OF_DOTS: [Self; 6] = [
        Self::Y,
        Self::Tilt,
        Self::Lost,
        Self::Swapped,
        Self::Late,
        Self::Friction,
    ];
    const OF_COLUMNS: [Self; 5] = [
        Self::Unit,
        Self::Side,
        Self::Tilt,
        Self::Late,
        Self::Friction,
    ];

    /// Whether an option mends it.
    pub(super) fn is_mended_by(self, option: &str) -> bool {
        let options: &[&str] = match self {
            Self::Y => &["--y-down"],
            Self::Unit => &["--unit"],
            Self::Side | Self::Tilt => &["--tilt"],
            Self::Lost => &["--leave-out"],
            Self::Swapped => &["--leave-out", "--dots"],
            Self::Late => &["--from"],
            Self::Friction => &["--set"],
        };
        options.iter().any(|own| option.starts_with(own))
    }
}

/// A film: a table, the options by which it is read, and its faults.
pub(super) struct Film {
    pub(super) text: String,
    pub(super) options: Vec<String>,
    pub(super) faults: Vec<Fault>,
    pub(super) words: String,
}

/// Random numbers of one film.
struct Numbers(Xoshiro256PlusPlus);

impl Numbers {
    fn between(&mut self, from: f64, to: f64) -> f64 {
        Uniform::new(from, to).unwrap().sample(&mut self.0)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.between(0.0, count as f64) as usize).min(count - 1)
    }

    fn is(&mut self) -> bool {
        self.below(2) == 0
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }
}

/// Two faults at most that go together.
fn faults(numbers: &mut Numbers, of_dots: bool) -> Vec<Fault> {
    let all: &[Fault] = match of_dots {
        true => &Fault::OF_DOTS,
        false => &Fault::OF_COLUMNS,
    };
    let one = all[numbers.below(all.len())];
    let other = all[numbers.below(all.len())];
    let mut faults = vec![one, other];
    faults.sort_unstable();
    faults.dedup();
    // A side is a tilt of a right angle.
    if faults == [Fault::Side, Fault::Tilt] {
        faults.pop();
    }
    faults
}

/// Times and angles of the links.
type Rows = Vec<(f64, Vec<f64>)>;

pub(super) fn film(number: u64) -> Film {
    let mut numbers = Numbers(Xoshiro256PlusPlus::seed_from_u64(1000 + number));
    let (of_dots, is_chain) = (numbers.below(3) > 0, numbers.is());
    let faults = faults(&mut numbers, of_dots);
    let has = |fault| faults.contains(&fault);
    let rate = [60.0, 100.0, 120.0][numbers.below(3)];
    let friction = [numbers.between(2e-4, 6e-4), numbers.between(5e-5, 2e-4)];
    let known = format!(
        "viscous_1={:.4e},viscous_2={:.4e}",
        friction[0], friction[1]
    );
    let (name, start) = match is_chain {
        true => ("double-pendulum", {
            let start = [numbers.between(0.6, 2.0), numbers.between(-1.5, 1.5)];
            format!("{},{}", start[0].to_degrees(), start[1].to_degrees())
        }),
        false => (
            "apparatus",
            format!("parent={}", numbers.between(30.0, 75.0)),
        ),
    };
    let line = format!(
        "--tree {name} --set {known} --start {start} --difference 0.05 --duration 4 --rate {rate}"
    );
    let arguments: Arguments = parse_line(&line).unwrap();
    let (real, _) = tree(&arguments);
    let truth = Source::simulate(&arguments, &real).unwrap().truth;
    let rows = truth
        .iter()
        .map(|sample| (sample.time, sample.links.clone()));
    let mut rows: Rows = rows.collect();
    if has(Fault::Late) {
        rows = held_before(&mut numbers, rows, rate);
    }
    let tilt = match has(Fault::Tilt) {
        true => numbers.between(2.0, 12.0) * if numbers.is() { 1.0 } else { -1.0 },
        false => 0.0,
    };
    for (_, angles) in &mut rows {
        angles
            .iter_mut()
            .for_each(|angle| *angle += tilt.to_radians());
    }
    let assumed = match has(Fault::Friction) {
        true => "viscous_1=0,viscous_2=0".to_owned(),
        false => known,
    };
    let mut options = vec![format!("--tree {name}"), format!("--set {assumed}")];
    let text = match of_dots {
        true => dots(&mut numbers, &rows, is_chain, &faults, &mut options),
        false => columns(&mut numbers, &rows, &faults, &mut options),
    };
    Film {
        text,
        options,
        words: format!("{number:>3} {name} {rate} Hz dots {of_dots} {faults:?}"),
        faults,
    }
}

/// Rest, lift and hold before a motion.
fn held_before(numbers: &mut Numbers, motion: Rows, rate: f64) -> Rows {
    let spans = [
        numbers.between(0.6, 1.5),
        numbers.between(0.4, 0.8),
        numbers.between(0.4, 1.0),
    ];
    let [rest, lift, _] = spans;
    let count = (rate * spans.iter().sum::<f64>()).round() as usize;
    let start = motion[0].1.clone();
    let before = (0..count).map(|row| {
        let time = row as f64 / rate;
        let share = ((time - rest) / lift).clamp(0.0, 1.0);
        let part = 0.5 * (1.0 - (PI * share).cos());
        (time, start.iter().map(|angle| part * angle).collect())
    });
    let after = motion
        .iter()
        .map(|(time, angles)| (time + count as f64 / rate, angles.clone()));
    before.chain(after).collect()
}

fn columns(
    numbers: &mut Numbers,
    rows: &Rows,
    faults: &[Fault],
    options: &mut Vec<String>,
) -> String {
    let has = |fault| faults.contains(&fault);
    let in_degrees = numbers.is();
    let is_said = in_degrees != has(Fault::Unit);
    options.push(format!("--unit {}", if is_said { "deg" } else { "rad" }));
    if !has(Fault::Side) {
        options.push("--zero down".to_owned());
    }
    let side = match (has(Fault::Side), numbers.is()) {
        (false, _) => 0.0,
        (true, true) => -0.5 * PI,
        (true, false) => 0.5 * PI,
    };
    let links = rows[0].1.len();
    let names: Vec<String> = (1..=links).map(|link| format!("theta{link}")).collect();
    let mut text = format!("t (s),{}\n", names.join(","));
    for (time, angles) in rows {
        let cells = angles.iter().map(|angle| {
            let angle = angle + side + 1e-3 * numbers.normal();
            match in_degrees {
                true => format!("{:.4}", angle.to_degrees()),
                false => format!("{angle:.6}"),
            }
        });
        writeln!(text, "{time:.5},{}", cells.collect::<Vec<_>>().join(",")).unwrap();
    }
    text
}

/// Dots of a chain from its pivot on, or two dots for each link of a tree, m.
fn dots(
    numbers: &mut Numbers,
    rows: &Rows,
    is_chain: bool,
    faults: &[Fault],
    options: &mut Vec<String>,
) -> String {
    let has = |fault| faults.contains(&fault);
    let names: &[&str] = match is_chain {
        true => &["p", "m", "n"],
        false => &["top", "mid", "left_a", "left_b", "right_a", "right_b"],
    };
    let noise = numbers.between(1e-4, 4e-4);
    let mut tracks: Vec<Vec<[f64; 2]>> = vec![Vec::new(); names.len()];
    for (_, angles) in rows {
        let end = |from: [f64; 2], length: f64, angle: f64| {
            [
                from[0] + length * angle.sin(),
                from[1] - length * angle.cos(),
            ]
        };
        let pivot = [0.7, 1.1];
        let first = end(pivot, 0.3, angles[0]);
        let places: Vec<[f64; 2]> = match angles[..] {
            [_, second] => vec![pivot, first, end(first, 0.26, second)],
            _ => {
                let others = angles[1..].iter();
                let children = others.flat_map(|angle| [first, end(first, 0.25, *angle)]);
                [pivot, first].into_iter().chain(children).collect()
            }
        };
        for (track, place) in tracks.iter_mut().zip(places) {
            track.push(place.map(|x| x + noise * numbers.normal()));
        }
    }
    if has(Fault::Y) {
        for track in &mut tracks {
            track.iter_mut().for_each(|place| place[1] = 2.2 - place[1]);
        }
    }
    if has(Fault::Swapped) {
        swap(numbers, &mut tracks, is_chain);
    }
    if has(Fault::Lost) {
        lose(numbers, &mut tracks);
    }
    if is_chain {
        options.push("--dots p:m,m:n".to_owned());
    }
    let heads: Vec<String> = names
        .iter()
        .map(|name| format!("{name}_x,{name}_y"))
        .collect();
    let mut text = format!("t (s),{}\n", heads.join(","));
    for (row, (time, _)) in rows.iter().enumerate() {
        let cells = tracks
            .iter()
            .map(|track| format!("{:.5},{:.5}", track[row][0], track[row][1]));
        writeln!(text, "{time:.5},{}", cells.collect::<Vec<_>>().join(",")).unwrap();
    }
    text
}

/// Exchanges two dots: for some pictures, or the ends of a link in all of them.
fn swap(numbers: &mut Numbers, tracks: &mut [Vec<[f64; 2]>], is_chain: bool) {
    let count = tracks[0].len();
    if !is_chain && numbers.is() {
        tracks.swap(4, 5);
        return;
    }
    let (one, other) = if is_chain { (1, 2) } else { (3, 5) };
    let length = 6 + numbers.below(15);
    let first = count / 2 + numbers.below(count / 2 - length - 5);
    let rows = first..first + length;
    let [one, other] = tracks.get_disjoint_mut([one, other]).unwrap();
    one[rows.clone()].swap_with_slice(&mut other[rows]);
}

/// Loses a dot in some stretches.
fn lose(numbers: &mut Numbers, tracks: &mut [Vec<[f64; 2]>]) {
    let count = tracks[0].len();
    let lost = 1 + numbers.below(tracks.len() - 1);
    let mark = [Some([0.0, 0.0]), Some([-1.0, -1.0]), None][numbers.below(3)];
    for stretch in 0..2 + numbers.below(3) {
        let length = 4 + numbers.below(8);
        // Later stretches do not overlap with earlier ones.
        let first = count / 4 + stretch * count / 8 + numbers.below(count / 8 - length - 1);
        let last_seen = tracks[lost][first - 1];
        tracks[lost][first..first + length].fill(mark.unwrap_or(last_seen));
    }
}
