//! Random apparatus: predictions against simulation.

use std::time::{Duration, Instant};

use branched_pendulum::analysis::normal_form::{NormalFormOptions, Tongue, Tongues};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_trees::{DifferenceGrowth, PendulumTree, TreeNormalForm};

use super::{LEAST, grid, snapped};

/// Numbers from 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from * (to / from).powf(self.next())
    }

    /// Returns the properties of a link, with the place of its children or without one.
    fn link(&mut self, name: &str, is_parent: bool) -> String {
        let (mass, com, inertia) = match is_parent {
            true => ([0.1, 0.5], [0.05, 0.25], [1e-3, 8e-3]),
            false => ([0.05, 0.2], [0.03, 0.1], [1e-4, 1e-3]),
        };
        let [mass, com, inertia] = [mass, com, inertia].map(|[from, to]| self.between(from, to));
        let own = format!("{name}(mass = {mass:.6}, com = {com:.6}, inertia = {inertia:.6e}");
        match is_parent {
            true => format!("{own}, joint = {:.6})", self.between(0.15, 0.4)),
            false => format!("{own})"),
        }
    }
}

/// Form of an apparatus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// A parent with two children.
    Paper,
    /// The paper's pendulum below another link.
    Chain,
    /// A parent with two children, each of which carries one link.
    Arms,
}

impl Form {
    fn text(self, random: &mut Random) -> String {
        let parent = random.link("parent", true);
        let child = random.link("child", false);
        let tree = match self {
            Self::Paper => format!("{parent} [ {child} * 2 ]"),
            Self::Chain => {
                let middle = random.link("middle", true);
                format!("{parent} [ {middle} [ {child} * 2 ] ]")
            }
            Self::Arms => {
                let arm = random.link("arm", true);
                format!("{parent} [ {arm} [ {child} ] * 2 ]")
            }
        };
        format!("gravity = 9.80665, {tree}")
    }

    /// Returns the copies, and a release in degrees: of the parent with the link below it, and of
    /// the lowest ones.
    fn copies(self) -> Copies {
        let (parents, groups): (&[Option<usize>], &[&[usize]]) = match self {
            Self::Paper => (&[None, Some(0), Some(0)], &[&[1, 2]]),
            Self::Chain => (&[None, Some(0), Some(1), Some(1)], &[&[2, 3]]),
            Self::Arms => (&[None, Some(0), Some(1), Some(0), Some(3)], &[&[1, 3]]),
        };
        Copies::of_links(parents, groups).unwrap()
    }

    fn release(self, parent: f64, child: f64) -> State<f64> {
        let angles: &[f64] = match self {
            Self::Paper => &[parent, child, child],
            Self::Chain => &[parent, parent, child, child],
            Self::Arms => &[parent, parent, child, parent, child],
        };
        let angles: Vec<f64> = angles.iter().map(|own| own.to_radians()).collect();
        State::at_rest(0.0, &angles)
    }
}

struct Apparatus {
    form: Form,
    text: String,
    tree: PendulumTree,
}

impl Apparatus {
    /// Draws an apparatus: every second one near a resonance of a difference, every fifth one with
    /// a mode near twice or three times another one.
    fn draw(number: u64, random: &mut Random) -> Self {
        let form = match number % 4 {
            0 | 1 => Form::Paper,
            2 => Form::Chain,
            _ => Form::Arms,
        };
        let (is_near, is_internal) = (number / 2 % 2 == 1, number % 5 == 4);
        loop {
            let text = form.text(random);
            let tree = PendulumTree::parse(&text).unwrap();
            let apparatus = Self { form, text, tree };
            let linear = apparatus.normal_form(4);
            let linear = linear.form();
            let frequencies = linear.linear_frequencies_hz();
            let (in_phase, own) = frequencies.split_at(linear.in_phase());
            let pairs = |near: &dyn Fn(f64, f64) -> bool| {
                let later = |place: usize| in_phase[place..].iter();
                in_phase
                    .iter()
                    .enumerate()
                    .any(|(place, one)| later(place).any(|two| near(*one, *two)))
            };
            let meets = own.iter().any(|own| {
                let close = |detuning: f64| detuning.abs() < 0.08 * own;
                pairs(&|one, two| close(2.0 * own - one - two) || close(2.0 * own - two + one))
            });
            let has_internal =
                pairs(&|one, two| [2.0, 3.0].iter().any(|n| (two / one - n).abs() < 0.05 * n));
            if (!is_near || meets) && (!is_internal || has_internal) {
                return apparatus;
            }
        }
    }

    fn normal_form(&self, degree: u32) -> TreeNormalForm {
        let options = NormalFormOptions {
            degree,
            ..NormalFormOptions::default()
        };
        self.tree.normal_form(&self.form.copies(), options).unwrap()
    }

    /// Returns simulated growth rates: roughly at every second place, and again over a long time at
    /// those near the limit and in the predicted tongues.
    fn rates(&self, parent: f64, children: &[f64], found: &Tongues) -> Vec<f64> {
        let second: Vec<f64> = children.iter().step_by(2).copied().collect();
        let rough = self.rates_within(parent, &second, ROUGH);
        let at = |place: usize| rough[place.div_ceil(2)..].first().or(rough.last());
        let mut rates: Vec<f64> = (0..children.len())
            .map(|place| at(place).copied().unwrap_or(f64::NAN))
            .collect();
        let is_predicted = |child: f64| {
            let mut tongues = found.tongues.iter();
            tongues.any(|own| {
                let [from, to] = own.edges.map(|edge| edge.value);
                from - 1.0 <= child && child <= to + 1.0
            })
        };
        let is_near = |place: usize| {
            let own = &rates[place.saturating_sub(2)..(place + 3).min(rates.len())];
            // Not a number is no certain answer.
            let is_clear = own.iter().all(|rate| *rate < 0.25 * LEAST)
                || own.iter().all(|rate| *rate > 2.0 * LEAST);
            let is_quiet = own.iter().any(|rate| *rate < 2.0 * LEAST);
            !is_clear || is_quiet && is_predicted(children[place])
        };
        let near: Vec<usize> = (0..children.len())
            .filter(|place| is_near(*place))
            .collect();
        let again: Vec<f64> = near.iter().map(|place| children[*place]).collect();
        let again = self.rates_within(parent, &again, FINE);
        for (place, rate) in near.into_iter().zip(again) {
            rates[place] = rate;
        }
        rates
    }

    /// Returns growth rates over a time in seconds, with a tolerance.
    fn rates_within(&self, parent: f64, children: &[f64], [time, tolerance]: [f64; 2]) -> Vec<f64> {
        let growth = DifferenceGrowth::new(&self.tree, &self.form.copies(), vec![time], tolerance);
        let starts = children
            .iter()
            .map(|child| self.form.release(parent, *child));
        let starts: Vec<State<f64>> = starts.collect();
        let grown = growth.unwrap().in_lanes(&Ensemble::new(), &starts).unwrap();
        let rates = grown
            .into_iter()
            .map(|own| own.map_or(f64::NAN, |own| own.rate.value));
        rates.collect()
    }
}

/// Time (s) and tolerance of a first look at a rate, and of its measurement. Rates are those by a
/// hundredth of the tolerance. The time is long: a second difference that does not grow hides the
/// growth of the first one for some hundred seconds.
const ROUGH: [f64; 2] = [60.0, 1e-4];
const FINE: [f64; 2] = [480.0, 1e-5];

/// An interval of a grid in which simulated differences grow.
#[derive(Clone, Copy, Debug)]
struct Window {
    edges: [f64; 2],
    rate: f64,
}

fn windows(children: &[f64], rates: &[f64]) -> Vec<Window> {
    let mut windows: Vec<Window> = Vec::new();
    // Not a number is no growth either.
    let growing = children
        .iter()
        .zip(rates)
        .filter(|(_, rate)| **rate >= LEAST);
    for (child, rate) in growing {
        match windows.last_mut() {
            Some(own) if child - own.edges[1] < 0.6 => {
                own.edges[1] = *child;
                own.rate = own.rate.max(*rate);
            }
            _ => windows.push(Window {
                edges: [*child; 2],
                rate: *rate,
            }),
        }
    }
    windows
}

/// Counts of the study.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    confirmed: usize,
    wrong: usize,
    spurious: usize,
    seen: usize,
    met: usize,
    missed_where_refused: usize,
    asked: usize,
    refused: usize,
}

/// Compares the predictions on a line with the simulated windows.
fn compare(
    found: &Tongues,
    windows: &[Window],
    children: &[f64],
    counts: &mut Counts,
    label: &str,
) {
    let is_out = |child: f64| {
        let mut refused = found.refused.iter();
        refused.any(|([from, to], _)| *from - 0.5 <= child && child <= *to + 0.5)
    };
    counts.asked += children.len();
    let out = |child: &&f64| {
        found
            .refused
            .iter()
            .any(|([from, to], _)| *from <= **child && **child <= *to)
    };
    counts.refused += children.iter().filter(out).count();
    for (range, refusal) in &found.refused {
        println!("  {label}: refused {range:?} {refusal}");
    }
    let touches = |tongue: &Tongue, own: &Window| {
        let predicted = snapped(tongue);
        let slack = 0.5 + tongue.edge_error();
        own.edges[0] <= predicted[1] + slack && predicted[0] <= own.edges[1] + slack
    };
    for tongue in &found.tongues {
        let own = snapped(tongue);
        let meets = windows.iter().find(|own| touches(tongue, own));
        let allowed = |side: usize| 0.5 + tongue.edges[side].error() + 1e-9;
        // Beyond an edge that is cut the tongue may go on.
        let agrees = meets.is_some_and(|window| {
            let beyond = [own[0] - window.edges[0], window.edges[1] - own[1]];
            [0, 1].iter().all(|side| {
                beyond[*side] >= -allowed(*side)
                    && (tongue.is_cut[*side] || beyond[*side] <= allowed(*side))
            })
        });
        let verdict = match (meets, agrees) {
            (None, _) if own[1] < own[0] => "between samples",
            (None, _) => {
                counts.spurious += 1;
                "SPURIOUS"
            }
            (Some(_), true) => {
                counts.confirmed += 1;
                "confirmed"
            }
            (Some(_), false) => {
                counts.wrong += 1;
                "WRONG EDGES"
            }
        };
        println!(
            "  {label}: {verdict} {:.2} to {:.2} ± {:.2} rate {:.4} ± {:.4} {} simulated {meets:?}",
            tongue.edges[0].value,
            tongue.edges[1].value,
            tongue.edge_error(),
            tongue.largest.growth_rate.value,
            tongue.largest.growth_rate.error(),
            tongue
                .resonance()
                .map_or(String::new(), ToString::to_string),
        );
    }
    for window in windows {
        counts.seen += 1;
        if found.tongues.iter().any(|own| touches(own, window)) {
            counts.met += 1;
        } else if is_out(window.edges[0]) || is_out(window.edges[1]) {
            counts.missed_where_refused += 1;
            println!("  {label}: in a refused part {window:?}");
        } else {
            println!("  {label}: MISSED {window:?}");
        }
    }
}

fn number(name: &str, other: u64) -> u64 {
    let own = std::env::var(name).ok();
    own.and_then(|own| own.parse().ok()).unwrap_or(other)
}

/// Random apparatus of two and three generations. `APPARATUS` is their number, `FIRST` the first of
/// them and `SEED` the seed.
#[test]
#[ignore = "takes seconds of processor time for each apparatus"]
fn random_apparatus() {
    let (seed, first) = (number("SEED", 1), number("FIRST", 0));
    let mut counts = Counts::default();
    let (mut deriving, mut predicting, mut simulating) =
        (Duration::ZERO, Duration::ZERO, Duration::ZERO);
    for place in first..first + number("APPARATUS", 10) {
        let mut random = Random((seed << 32 | (place + 1)).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let apparatus = Apparatus::draw(place, &mut random);
        let clock = Instant::now();
        let form = apparatus.normal_form(8);
        deriving += clock.elapsed();
        let resonances = form.form().resonances().iter().map(ToString::to_string);
        println!(
            "{place}: {} {:.4?} {}",
            apparatus.text,
            form.form().linear_frequencies_hz(),
            resonances.collect::<Vec<_>>().join(", ")
        );
        let children = grid(-30.0, 30.0);
        for parent in [15.0, 30.0] {
            let clock = Instant::now();
            let found = Tongues::along(&children, LEAST, |child| {
                form.predict(&apparatus.form.release(parent, child))
            });
            predicting += clock.elapsed();
            let clock = Instant::now();
            let rates = apparatus.rates(parent, &children, &found);
            simulating += clock.elapsed();
            compare(
                &found,
                &windows(&children, &rates),
                &children,
                &mut counts,
                &format!("{parent}"),
            );
        }
        println!(
            "so far: {counts:?}; deriving {deriving:.1?}, predicting {predicting:.1?}, simulating {simulating:.1?}"
        );
    }
}
