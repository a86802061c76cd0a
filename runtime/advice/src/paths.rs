//! States of a scene at all times, and the values of outputs.

use crate::wanted::Wanted;
use branched_pendulum::system::State;

/// Relative size of the perturbation of a start that shows the growth of rounding errors. It equals
/// several rounding errors, as they accumulate over many steps.
pub(crate) const MOVE: f64 = 32.0 * f64::EPSILON;

/// States of the scene at all times, start by start.
#[derive(Clone, Debug)]
pub(crate) struct Paths {
    dimension: usize,
    times: usize,
    values: Vec<f64>,
}

impl Paths {
    /// Creates the states, all NaN.
    pub(crate) fn new(dimension: usize, starts: usize, times: usize) -> Self {
        Self {
            dimension,
            times,
            values: vec![f64::NAN; dimension * starts * times],
        }
    }

    pub(crate) fn set(&mut self, start: usize, time: usize, state: &[f64]) {
        let begin = (start * self.times + time) * self.dimension;
        if let Some(room) = self.values.get_mut(begin..begin + self.dimension)
            && room.len() == state.len()
        {
            room.copy_from_slice(state);
        }
    }

    /// Computes the values of an output at all starts and times, in their order.
    pub(crate) fn outputs(&self, wanted: &Wanted<'_>, times: &[f64]) -> OutputValues {
        let mut values = Vec::new();
        let states = self.values.chunks_exact(self.dimension.max(1));
        for (state, &time) in states.zip(times.iter().cycle()) {
            wanted.values(time, state, &mut values);
        }
        let samples = self.values.len() / self.dimension.max(1);
        OutputValues {
            width: values.len() / samples.max(1),
            times: times.len(),
            values,
        }
    }

    /// Returns an estimate of the accumulated rounding errors along the trajectory of a start, with
    /// random signs and in proportion to the largest value of each component. A component that
    /// stays zero has none, and components that stay equal have equal ones.
    pub(crate) fn roundings(&self, start: usize, from: &State<f64>) -> Vec<f64> {
        let length = self.dimension * self.times;
        let own = &self.values[start * length..(start + 1) * length];
        let move_of = |component: usize| {
            let visited = own.iter().skip(component).step_by(self.dimension);
            let all = visited.chain(&from.values[component..=component]);
            let (size, sum) = all.fold((0.0_f64, 0.0), |(size, sum), &value| {
                (size.max(value.abs()), sum + value)
            });
            let bits = f64::to_bits(sum);
            // A bit from the middle of the mantissa serves as a random sign.
            let sign = if (bits >> 20) & 1 == 0 { 1.0 } else { -1.0 };
            sign * MOVE * size
        };
        (0..self.dimension).map(move_of).collect()
    }

    /// Returns the distance between two states, over all their components.
    pub(crate) fn distance(&self, other: &Self, start: usize, time: usize) -> f64 {
        let begin = (start * self.times + time) * self.dimension;
        let range = begin..begin + self.dimension;
        let pairs = self.values[range.clone()].iter().zip(&other.values[range]);
        pairs.map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    }
}

/// Values of one output at all times, start by start.
#[derive(Clone, Debug)]
pub(crate) struct OutputValues {
    pub(crate) width: usize,
    pub(crate) times: usize,
    pub(crate) values: Vec<f64>,
}

impl OutputValues {
    /// Returns the values at a time of a start.
    pub(crate) fn at(&self, start: usize, time: usize) -> &[f64] {
        let begin = (start * self.times + time) * self.width;
        self.values
            .get(begin..begin + self.width)
            .unwrap_or_default()
    }

    /// Returns the largest difference from `other` at a time, over all starts; infinite if one is
    /// NaN.
    pub(crate) fn difference(&self, other: &Self, time: usize) -> f64 {
        let starts = self.values.len() / (self.width * self.times).max(1);
        let mut worst = 0.0_f64;
        for start in 0..starts {
            for (a, b) in self.at(start, time).iter().zip(other.at(start, time)) {
                let difference = (a - b).abs();
                worst = match difference.is_finite() {
                    true => worst.max(difference),
                    false => f64::INFINITY,
                };
            }
        }
        worst
    }
}
