//! Combination tones (sums of multiples of fundamental frequencies), by which spectral lines are
//! named.

/// A sum of integer multiples of fundamental frequencies, such as 2f_+ − f_−.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CombinationTone {
    /// The integer multiple of each fundamental frequency.
    pub multiples: Vec<i32>,
}

impl CombinationTone {
    /// Returns the combination of lowest order, and of that order the nearest, whose frequency is
    /// within `tolerance_hz` (Hz) of a line's; `None` if there is none up to `order`.
    ///
    /// The more orders are allowed, the more combinations lie in any interval. Use a tolerance of
    /// several errors of the line and of the combination, so that few agree by chance.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum_measure::CombinationTone;
    ///
    /// let fundamentals = [0.8731, 1.5826];
    /// let line = CombinationTone::find(2.0 * 0.8731 - 1.5826, &fundamentals, 5, 1e-6).unwrap();
    /// assert_eq!(line.multiples, [2, -1]);
    /// assert_eq!(line.named(&["f_+", "f_−"]), "2f_+ − f_−");
    /// assert_eq!(CombinationTone::find(1.0, &fundamentals, 5, 1e-6), None);
    /// ```
    pub fn find(
        frequency_hz: f64,
        fundamentals_hz: &[f64],
        order: u32,
        tolerance_hz: f64,
    ) -> Option<Self> {
        (1..=order).find_map(|order| {
            let mut nearest: Option<(f64, Vec<i32>)> = None;
            let mut multiples = vec![0; fundamentals_hz.len()];
            each(&mut multiples, 0, order as i32, &mut |multiples| {
                let terms = multiples.iter().zip(fundamentals_hz);
                let sum: f64 = terms.map(|(n, f)| f64::from(*n) * f).sum();
                let distance = (sum - frequency_hz).abs();
                let least = nearest.as_ref().map_or(tolerance_hz, |(least, _)| *least);
                if distance <= least {
                    nearest = Some((distance, multiples.to_vec()));
                }
            });
            nearest.map(|(_, multiples)| Self { multiples })
        })
    }

    /// Returns the order: the sum of the absolute values of the multiples.
    pub fn order(&self) -> u32 {
        self.multiples.iter().map(|n| n.unsigned_abs()).sum()
    }

    /// Returns the frequency of the combination, Hz.
    pub fn frequency_hz(&self, fundamentals_hz: &[f64]) -> f64 {
        let terms = self.multiples.iter().zip(fundamentals_hz);
        terms.map(|(n, f)| f64::from(*n) * f).sum()
    }

    /// Returns the combination as text with these names of the fundamentals, positive terms first.
    pub fn named(&self, names: &[&str]) -> String {
        let terms = || self.multiples.iter().zip(names);
        let positive = terms().filter(|(n, _)| **n > 0);
        let negative = terms().filter(|(n, _)| **n < 0);
        let mut text = String::new();
        for (&n, name) in positive.chain(negative) {
            text += match (text.is_empty(), n > 0) {
                (true, true) => "",
                (true, false) => "−",
                (false, true) => " + ",
                (false, false) => " − ",
            };
            if n.unsigned_abs() > 1 {
                text += &n.unsigned_abs().to_string();
            }
            text += name;
        }
        text
    }
}

/// Calls `visit` with all multiples, from the index `at` on, whose absolute values sum to `order`.
fn each(multiples: &mut [i32], at: usize, order: i32, visit: &mut impl FnMut(&[i32])) {
    if at + 1 >= multiples.len() {
        for last in [order, -order] {
            if let Some(slot) = multiples.last_mut() {
                *slot = last;
                visit(multiples);
            }
            if order == 0 {
                break;
            }
        }
        return;
    }
    for n in -order..=order {
        multiples[at] = n;
        each(multiples, at + 1, order - n.abs(), visit);
    }
}
