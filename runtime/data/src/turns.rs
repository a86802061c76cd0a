//! Counting of whole turns of an angle, robust against wrong samples.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use super::sample::Sample;
use super::timing::{Timing, quantile};

/// Number of successive samples that a path may leave out, plus one.
const REACH: usize = 6;
/// Length of a step, in usual intervals, up to which the next angle is predicted from the angle and
/// the rate before.
const NEAR: f64 = REACH as f64 + 0.5;
/// Cost of leaving out a sample, in units of the usual bend (second difference); then its lower and
/// upper bounds in rad. A glitch bends the path by four times its size, or by a turn.
const LEFT_OUT: f64 = 20.0;
const LEAST: f64 = 0.1;
const MOST: f64 = 1.0;
/// Cost factors at the ends of the record, where no other samples help to decide.
const AT_END: f64 = 2.0;
/// Fraction of all bends that are smaller than the usual one; each wrong sample causes three large
/// bends.
const USUAL: f64 = 0.7;
/// Bend (rad) above which another number of turns would fit nearly as well.
const WILD: f64 = FRAC_PI_2;
/// Bend (rad) for which a sample would be left out if leaving out a single one helped.
const DOUBTFUL: f64 = MOST;

/// A series of angles whose whole turns have been counted.
#[derive(Default)]
pub(crate) struct Turns {
    /// Rows on whose angles the count is based.
    pub(crate) followed: Vec<usize>,
    /// Rows from which on another number of turns is added.
    pub(crate) jumps: Vec<usize>,
    /// Rows whose number of turns is uncertain: after a gap that may hide turns, after a sharp
    /// bend, or during fast rotation with fewer than four samples per turn.
    pub(crate) doubtful: Vec<usize>,
    /// Rows behind such a bend.
    pub(crate) bends: Vec<usize>,
    /// Rows that are far from the others for any number of turns.
    pub(crate) strays: Vec<usize>,
}

/// Adds whole turns to the angles such that their path has the smallest bends; samples that would
/// bend the path by more than the cost of leaving them out are skipped. Linear in the number of
/// samples.
pub(crate) fn count(times: &[f64], samples: &mut [Sample], timing: &Timing) -> Turns {
    let measured = |(row, sample): (usize, &Sample)| match sample {
        Sample::Measured(value) => Some((row, *value)),
        _ => None,
    };
    let (rows, values): (Vec<usize>, Vec<f64>) =
        samples.iter().enumerate().filter_map(measured).unzip();
    let at: Vec<f64> = rows.iter().map(|&row| times[row]).collect();
    let path = cheapest_path(&at, &values, timing.interval);
    let steps = steps_along(&path, &at, &values, timing.interval);
    let added = path.iter().zip(&steps);
    let added: Vec<f64> = added
        .map(|(&index, step)| ((step.value - values[index]) / TAU).round())
        .collect();
    let mut turns = Turns {
        followed: path.iter().map(|&index| rows[index]).collect(),
        ..Turns::default()
    };
    turns.judge(times, &path, &steps, timing);
    let jumps = added.windows(2).zip(&turns.followed[1.min(added.len())..]);
    let jumps = jumps.filter(|(pair, _)| pair[0] != pair[1]);
    turns.jumps = jumps.map(|(_, &row)| row).collect();
    turns.strays = place_remaining_rows(times, samples, &turns.followed, &steps);
    turns
}

impl Turns {
    /// Finds the sharp bends and the uncertain rows of a path.
    fn judge(&mut self, times: &[f64], path: &[usize], steps: &[Step], timing: &Timing) {
        let rows = &self.followed;
        let is_long = |from: usize, to: usize| {
            rows[to] > rows[from] + 1 || timing.has_gap(times[rows[from]], times[rows[to]])
        };
        let largest = |of: fn(&Step) -> f64| {
            let usual = (1..steps.len()).filter(|&to| !is_long(to - 1, to));
            usual.map(|to| of(&steps[to]).abs()).fold(0.0, f64::max)
        };
        let (fastest, sharpest) = (largest(|step| step.rate), largest(|step| step.bend));
        let bends = |limit: f64| (0..steps.len()).filter(move |&to| steps[to].bend.abs() > limit);
        // A few samples among others that are left out may be as wrong as they, and the one at a gap by
        // what is not left out.
        let follows = |place: &usize| path[*place] == path[place - 1] + 1;
        let mut firm = Vec::with_capacity(steps.len());
        let mut start = 0;
        while start < steps.len() {
            let end = (start + 1..steps.len()).find(|place| !follows(place));
            let run = start..end.unwrap_or(steps.len());
            start = run.end;
            if run.len() >= REACH {
                firm.extend(run);
            } else {
                let is_at_end = |place: &usize| *place == 0 || place + 1 == steps.len();
                firm.extend(run.filter(is_at_end));
            }
        }
        let uncertain = firm.windows(2).filter(|ends| {
            let (from, to) = (ends[0], ends[1]);
            let time = times[rows[to]] - times[rows[from]];
            let moved = (steps[to].value - steps[from].value).abs();
            if !is_long(from, to) {
                return moved > FRAC_PI_2;
            }
            let intervals = time / timing.interval;
            let is_near = intervals <= NEAR && sharpest * intervals * intervals <= WILD;
            !(is_near || (fastest * time <= PI - MOST && moved <= PI))
        });
        let mut doubtful: Vec<usize> = uncertain.map(|ends| ends[1]).collect();
        doubtful.extend(bends(DOUBTFUL));
        doubtful.sort_unstable();
        doubtful.dedup();
        let rows_of = |places: Vec<usize>| places.iter().map(|&place| rows[place]).collect();
        [self.bends, self.doubtful] = [bends(WILD).collect(), doubtful].map(rows_of);
    }
}

/// Sets the angles of the rows on the path, and of each other row the angle with the nearest number
/// of turns. Returns the measured rows among the others that are far from the path nevertheless.
fn place_remaining_rows(
    times: &[f64],
    samples: &mut [Sample],
    followed: &[usize],
    steps: &[Step],
) -> Vec<usize> {
    let mut far = Vec::new();
    let mut next = 0;
    for (row, sample) in samples.iter_mut().enumerate() {
        if followed.get(next) == Some(&row) {
            *sample = Sample::Measured(steps[next].value);
            next += 1;
            continue;
        }
        let around = [next.checked_sub(1), Some(next)].map(|place| {
            let place = place?;
            Some((times[*followed.get(place)?], steps[place].value))
        });
        // At an end only one side is known, and it gives no more than the half turn.
        let (expected, far_from) = match around {
            [Some((start, from)), Some((end, to))] => {
                let part = (times[row] - start) / (end - start);
                (from + (to - from) * part, FRAC_PI_4)
            }
            [Some((_, value)), None] | [None, Some((_, value))] => (value, FRAC_PI_2),
            [None, None] => continue,
        };
        let is_measured = matches!(sample, Sample::Measured(_));
        if let Sample::Measured(value) | Sample::Outlier(value) | Sample::Unlikely(value) = sample {
            *value = nearest(*value, expected);
            if is_measured && (*value - expected).abs() > far_from {
                far.push(row);
            }
        }
    }
    far
}

/// Returns the angle nearest to `expected` that differs from `value` by whole turns.
fn nearest(value: f64, expected: f64) -> f64 {
    value + ((expected - value) / TAU).round() * TAU
}

/// A sample of a path, with its turns counted.
#[derive(Clone, Copy)]
struct Step {
    value: f64,
    /// Angular velocity; NaN if it is not known yet, at the start and after gaps.
    rate: f64,
    /// Distance from the angle predicted by the previous angular velocity.
    bend: f64,
}

impl Step {
    fn first(value: f64) -> Self {
        let (rate, bend) = (f64::NAN, 0.0);
        Self { value, rate, bend }
    }

    /// Returns the step to the next sample, `interval` usual intervals later. For a short step the
    /// angular velocity changes only partly, because much of its change is noise.
    fn next(&self, value: f64, time: f64, interval: f64) -> Self {
        let intervals = time / interval;
        let is_near = intervals <= NEAR;
        let ahead = if is_near && self.rate.is_finite() {
            self.rate * time
        } else {
            0.0
        };
        let expected = self.value + ahead;
        let value = nearest(value, expected);
        let rate = (value - self.value) / time;
        let is_first = !self.rate.is_finite();
        Self {
            value,
            bend: if is_first || !is_near {
                0.0
            } else {
                value - expected
            },
            rate: match (is_near, is_first) {
                (false, _) => f64::NAN,
                (true, true) => rate,
                (true, false) => self.rate + (rate - self.rate) * intervals.min(1.0),
            },
        }
    }

    /// Returns the cost of a step from another sample: its bend, and the excess over half a turn
    /// per interval.
    fn price(&self, from: &Self, intervals: f64) -> f64 {
        let beyond = (self.value - from.value).abs() - PI * intervals.max(1.0);
        self.bend.abs() + beyond.max(0.0)
    }
}

fn steps_along(path: &[usize], times: &[f64], values: &[f64], interval: f64) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::with_capacity(path.len());
    steps.extend(path.first().map(|&index| Step::first(values[index])));
    for pair in path.windows(2) {
        let time = times[pair[1]] - times[pair[0]];
        steps.extend(
            steps
                .last()
                .map(|last| last.next(values[pair[1]], time, interval)),
        );
    }
    steps
}

/// The best path to a sample from a certain sample before it.
#[derive(Clone, Copy)]
struct BestPath {
    step: Step,
    cost: f64,
}

/// Returns the samples of the path with the lowest cost, in order, by dynamic programming: the
/// state is a pair of successive samples of the path. Samples are left out only near bends.
fn cheapest_path(times: &[f64], values: &[f64], interval: f64) -> Vec<usize> {
    let count = values.len();
    if count < 3 {
        return (0..count).collect();
    }
    let bends = bends(times, values, interval);
    let price = (LEFT_OUT * quantile(bends.clone(), USUAL)).clamp(LEAST, MOST);
    let rough = near_bends(&bends, price / 4.0);
    if !rough.contains(&true) {
        return (0..count).collect();
    }
    // `ways[index % REACH][back - 1]` comes from `index - back`, or from the start.
    let mut ways = [[None::<BestPath>; REACH]; REACH];
    let mut sources = vec![[0_u8; REACH]; count];
    let mut best: Option<(f64, usize, usize)> = None;
    for index in 0..count {
        let mut own = [None::<BestPath>; REACH];
        for back in 1..=REACH.min(index + 1) {
            let between = index + 1 - back..index;
            if !between.clone().all(|left_out| rough[left_out]) {
                break;
            }
            let left_out = between.len() as f64;
            let Some(from) = index.checked_sub(back) else {
                let step = Step::first(values[index]);
                let cost = AT_END * price * left_out;
                own[back - 1] = Some(BestPath { step, cost });
                break;
            };
            let time = times[index] - times[from];
            for (source, way) in ways[from % REACH].iter().enumerate() {
                let Some(way) = way else { continue };
                let step = way.step.next(values[index], time, interval);
                let cost = way.cost + price * left_out + step.price(&way.step, time / interval);
                if own[back - 1].is_none_or(|other| cost < other.cost) {
                    own[back - 1] = Some(BestPath { step, cost });
                    sources[index][back - 1] = source as u8;
                }
            }
        }
        ways[index % REACH] = own;
        if count - index <= REACH && (index + 1..count).all(|left_out| rough[left_out]) {
            let rest = AT_END * price * (count - 1 - index) as f64;
            for (back, way) in own.iter().enumerate() {
                let Some(way) = way else { continue };
                let cost = way.cost + rest;
                if best.is_none_or(|(least, ..)| cost < least) {
                    best = Some((cost, index, back));
                }
            }
        }
    }
    match best {
        Some((_, index, back)) => path_to(index, back, &sources),
        None => Vec::new(),
    }
}

/// Returns the path that ends with sample `index` and the sample `back` + 1 before it, from the
/// predecessors of all pairs.
fn path_to(mut index: usize, mut back: usize, sources: &[[u8; REACH]]) -> Vec<usize> {
    let mut path = Vec::with_capacity(sources.len());
    loop {
        path.push(index);
        let source = usize::from(sources[index][back]);
        let Some(from) = index.checked_sub(back + 1) else {
            break;
        };
        (index, back) = (from, source);
    }
    path.reverse();
    path
}

/// Returns the costs of the steps to each sample, from the third on, if no sample is left out.
fn bends(times: &[f64], values: &[f64], interval: f64) -> Vec<f64> {
    let bend = |last: usize| {
        let steps = steps_along(&[last - 2, last - 1, last], times, values, interval);
        steps[2].price(&steps[1], (times[last] - times[last - 1]) / interval)
    };
    (2..values.len()).map(bend).collect()
}

/// Marks samples near three successive samples between which the slope changes by more than a
/// limit.
fn near_bends(bends: &[f64], limit: f64) -> Vec<bool> {
    let mut rough = vec![false; bends.len() + 2];
    let mut marked = 0;
    for (first, bend) in bends.iter().enumerate() {
        if *bend > limit {
            let end = (first + 2 + REACH).min(rough.len());
            let begin = (first + 1).saturating_sub(REACH).max(marked);
            rough[begin..end].fill(true);
            marked = end;
        }
    }
    rough
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::{bends, cheapest_path};

    /// Returns times whose intervals are the given multiples of the usual one, in turn.
    fn spaced(parts: &[f64]) -> Vec<f64> {
        let all = parts.iter().cycle().take(60);
        let times = all.scan(0.0, |time, part| {
            *time += part;
            Some(*time)
        });
        times.collect()
    }

    /// Checks that a uniform rotation has no bends, however its rows are spaced: with jitter, and
    /// with rows closer than the usual interval, in which a link may turn by more than its share of
    /// half a turn.
    #[test]
    fn close_rows_of_a_whirl_cost_nothing() {
        for (parts, rate) in [
            (&[1.0, 1.0, 1.0][..], 0.9 * PI),
            (&[0.7, 1.2, 1.0, 0.9, 1.1], 0.75 * PI),
            (&[0.3, 0.3, 0.6, 0.3], 1.6 * PI),
            (&[0.1, 0.2, 0.15, 0.1], 4.0 * PI),
            (&[0.05, 0.05, 0.15, 0.05], -6.0 * PI),
        ] {
            let times = spaced(parts);
            let wrap = |angle: f64| angle - TAU * (angle / TAU).round();
            let values = times.iter().map(|time| wrap(rate * time));
            let values: Vec<f64> = values.collect();
            let largest = bends(&times, &values, 1.0).into_iter().fold(0.0, f64::max);
            assert!(largest < 1e-9, "{parts:?} {rate}: {largest}");
            let path: Vec<usize> = (0..times.len()).collect();
            assert_eq!(cheapest_path(&times, &values, 1.0), path);
        }
    }
}
