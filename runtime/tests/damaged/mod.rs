//! Thousands of damaged texts: each is refused or read as something that can be used, without
//! a panic and without more memory than the text warrants.

use branched_pendulum::integrate::{Checkpoint, Solver, Trajectory};
use branched_pendulum::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::counting::largest_request;
use crate::oscillator;

/// Numbers without an end (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end.max(1) as u64) as usize
    }

    fn one_of<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len())]
    }
}

/// What numbers become.
const NUMBERS: [&str; 19] = [
    "0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "0.5",
    "-0.0",
    "1e300",
    "-1e300",
    "5e-324",
    "1e999",
    "null",
    "65536",
    "4294967296",
    "1099511627776",
    "1152921504606846976",
    "9223372036854775808",
    "18446744073709551615",
];

/// What words become.
const WORDS: [&str; 12] = [
    "\"Alternating\"",
    "\"Bernstein\"",
    "\"Hermite\"",
    "\"Taylor\"",
    "\"Linear\"",
    "\"Two\"",
    "\"Eight\"",
    "\"terms\"",
    "\"Uniform\"",
    "\"PerComponent\"",
    "{\"Collocation\":\"Six\"}",
    "[]",
];

/// Where the pieces of a text begin and end: numbers, words, and single signs.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => 2 + rest[1..].find('"').unwrap_or(rest.len() - 2),
            '-' | '0'..='9' => rest
                .find(|c: char| !matches!(c, '-' | '+' | '.' | 'e' | '0'..='9'))
                .unwrap_or(rest.len()),
            _ => first.len_utf8(),
        };
        let (piece, behind) = rest.split_at(length);
        pieces.push(piece);
        rest = behind;
    }
    pieces
}

/// The text with some damage.
fn damaged(text: &str, random: &mut Random) -> String {
    let mut pieces: Vec<String> = pieces(text).into_iter().map(str::to_owned).collect();
    for _ in 0..1 + random.below(3) {
        let (place, other) = (random.below(pieces.len()), random.below(pieces.len()));
        // A number, so that most texts stay JSON.
        let numbers = |piece: &String| piece.starts_with(|c: char| c == '-' || c.is_ascii_digit());
        let number = pieces
            .iter()
            .skip(place)
            .position(numbers)
            .map(|i| place + i);
        match (random.below(8), number) {
            (0..4, Some(number)) => pieces[number] = random.one_of(&NUMBERS).to_owned(),
            (4, Some(number)) => {
                // One more, or one less.
                let twice = format!("{0},{0}", pieces[number]);
                pieces[number] = twice;
            }
            (5, Some(number)) if pieces.get(number + 1).is_some_and(|piece| piece == ",") => {
                pieces.drain(number..number + 2);
            }
            (6, _) => pieces.swap(place, other),
            _ if pieces[place].starts_with('"') => {
                pieces[place] = random.one_of(&WORDS).to_owned();
            }
            _ => {
                pieces.remove(place);
            }
        }
    }
    pieces.concat()
}

/// Damages a text so many times, and uses what is read. Returns how many were read.
fn damage<V: DeserializeOwned>(text: &str, times: usize, usage: impl Fn(V)) -> usize {
    let mut random = Random(0x9e37_79b9_7f4a_7c15 ^ text.len() as u64);
    let mut read = 0;
    for _ in 0..times {
        let text = damaged(text, &mut random);
        let (bytes, value) = largest_request(|| {
            let value = serde_json::from_str::<V>(&text).ok()?;
            usage(value);
            Some(())
        });
        read += usize::from(value.is_some());
        assert!(
            bytes <= 64 * text.len() + (1 << 14),
            "{bytes} bytes for {text}"
        );
    }
    read
}

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap()
}

fn use_trajectory(motion: Trajectory<f64>) {
    let mut times = motion.times().to_vec();
    times.extend(
        motion
            .times()
            .windows(2)
            .map(|ends| 0.5 * (ends[0] + ends[1])),
    );
    for time in times {
        let state = motion.at(time).unwrap();
        let mut rates = vec![0.0; state.len()];
        let _ = motion.derivative_into(time, &mut rates);
    }
    let _ = (
        motion.at(f64::NAN),
        motion.at(1e9),
        motion.at_into(0.0, &mut []),
    );
}

/// Trajectories and checkpoints of a method.
fn method<O: Ode<f64>>(ode: impl Fn() -> O, method: &impl Integrator<f64, O>) {
    let start = State::at_rest(0.0, &[1.0]);
    let motion = method.trajectory(&ode(), &start, 0.3).unwrap();
    let read = damage(&json(&motion), 800, use_trajectory);
    // Both happen: numbers of a state may be any.
    assert!((40..760).contains(&read), "{read}");
    let mut stepper = method.start(ode(), &start).unwrap();
    for _ in 0..2 {
        stepper.step().unwrap();
    }
    let checkpoint = json(&stepper.checkpoint().unwrap());
    let read = damage(&checkpoint, 400, |checkpoint: Checkpoint<f64>| {
        if let Ok(mut stepper) = method.resume(ode(), &checkpoint) {
            for _ in 0..3 {
                if stepper.step().is_err() {
                    break;
                }
            }
            let _ = stepper.checkpoint().map(|checkpoint| json(&checkpoint));
        }
    });
    assert!((20..380).contains(&read), "{read}");
}

#[test]
fn motions() {
    let options = Options {
        max_step: Some(0.1),
        ..Options::with_tolerance(1e-6)
    };
    method(oscillator, &Dopri5::new(options.clone()));
    method(oscillator, &Dop853::new(options.clone()));
    method(oscillator, &Verner98::new(options));
    method(oscillator, &Rk4::new(0.1));
    for solver in [Solver::FixedPoint, Solver::Newton] {
        let gauss = Gauss {
            solver,
            ..Gauss::new(GaussOrder::Six, 0.1)
        };
        method(oscillator, &gauss);
    }
}

#[test]
fn series() {
    let text = r#"{"dimension":2,"times":[0.0,1.0,3.0],"steps":[
        {"form":"Taylor","length":1.0,"first":2,"terms":[8,0]},
        {"form":"Taylor","length":2.0,"first":14,"terms":[6,0]}],
        "numbers":[1,2,3,4,5,6,7,8,9,1,2,3,4,5,6,7,8,9,1,2,3,4,5,6]}"#;
    let read = damage(text, 2000, use_trajectory);
    assert!((100..1900).contains(&read), "{read}");
}

/// What a method is asked for, and states: any numbers are read, and runs refuse them.
#[test]
fn methods_and_options() {
    let ode = oscillator();
    fn step<O: Ode<f64>>(method: &impl Integrator<f64, O>, ode: O, start: &State<f64>) {
        if let Ok(mut stepper) = method.start(ode, start) {
            for _ in 0..3 {
                if stepper.step().is_err() {
                    break;
                }
            }
        }
    }
    let start = State::at_rest(0.0, &[1.0]);
    let options = Options {
        absolute: branched_pendulum::integrate::Tolerance::PerComponent(vec![1e-6, 1e-7]),
        initial_step: Some(0.01),
        max_step: Some(0.5),
        ..Options::with_tolerance(1e-6)
    };
    let read = damage(&json(&options), 1000, |options: Options<f64>| {
        step(&Dop853::new(options), &ode, &start);
    });
    assert!(read > 100, "{read}");
    let read = damage(&json(&start), 1000, |start: State<f64>| {
        step(&Dopri5::new(Options::with_tolerance(1e-6)), &ode, &start);
    });
    assert!(read > 100, "{read}");
    let read = damage(
        &json(&Gauss::new(GaussOrder::Four, 0.1)),
        1000,
        |mut method: Gauss<f64>| {
            // A million iterations take long, and no memory.
            method.iteration_limit = method.iteration_limit.min(100);
            step(&method, &ode, &start);
        },
    );
    assert!(read > 100, "{read}");
    let read = damage(&json(&Rk4::new(0.1)), 500, |method: Rk4<f64>| {
        step(&method, &ode, &start);
    });
    assert!(read > 50, "{read}");
    let series = Taylor::new(Options::with_tolerance(1e-6)).with_order(20);
    let read = damage(&json(&series), 500, |method: Taylor<f64>| {
        let _ = (method.order(), method.options().validate(2));
    });
    assert!(read > 50, "{read}");
    let run = Solution {
        state: start.clone(),
        report: *Rk4::new(0.1).start(&ode, &start).unwrap().report(),
    };
    let read = damage(&json(&run), 500, |run: Solution<f64>| {
        let _ = (run.report.to_string(), json(&run));
    });
    assert!(read > 50, "{read}");
}
