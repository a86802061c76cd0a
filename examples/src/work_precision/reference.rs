//! The reference trajectories, `tests/fixtures/reference/trajectories.json`.

/// The file, as it was when the program was built.
const FILE: &str = include_str!("../../../tests/fixtures/reference/trajectories.json");

/// A motion from rest and where it is at a given time.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Name, as the charts show it.
    pub name: &'static str,
    /// Angles at the start, rad.
    pub start: [f64; 3],
    /// The time, s.
    pub end: f64,
    /// Angles (rad) and velocities (rad/s) then.
    pub expected: Vec<f64>,
}

/// The problems: regular motion for a short and a long time, and motion near
/// the threshold for as long as `f64` can follow it well.
pub fn problems() -> Vec<Problem> {
    let regular = [0.3, 1e-3, -1e-3];
    let threshold = [47.8_f64.to_radians(), 1e-3, -1e-3];
    let problem = |name, key, start, time: &str| Problem {
        name,
        start,
        end: time.parse().unwrap_or(f64::NAN),
        expected: ["theta", "omega"]
            .into_iter()
            .flat_map(|quantity| numbers(FILE, &[key, "t", time, quantity]))
            .collect(),
    };
    vec![
        problem("regular, 10 s", "regular", regular, "10"),
        problem("regular, 100 s", "regular", regular, "100"),
        problem("near threshold, 10 s", "near-threshold", threshold, "10"),
    ]
}

/// The numbers of the array under the last of `keys`, each key looked for
/// behind the one before; none if one is missing. The file writes its numbers
/// as strings.
fn numbers(text: &str, keys: &[&str]) -> Vec<f64> {
    let behind = keys.iter().try_fold(text, |text, key| {
        let quoted = format!("\"{key}\":");
        text.find(&quoted).map(|at| &text[at + quoted.len()..])
    });
    let array = behind.and_then(|text| text.split_once(']'));
    array.map_or_else(Vec::new, |(array, _)| {
        let parts = array.split('"');
        parts.filter_map(|part| part.parse().ok()).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::problems;

    #[test]
    fn all_problems_are_there() {
        for problem in problems() {
            assert_eq!(problem.expected.len(), 6, "{problem:?}");
            assert!(problem.end >= 10.0);
        }
        // By eye, from the file.
        assert_eq!(problems()[0].expected[0], -0.13514683809607428);
        assert_eq!(problems()[2].expected[5], -8.352998681130677);
    }
}
