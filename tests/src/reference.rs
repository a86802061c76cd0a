//! Trusted numbers of the folder `fixtures/reference`.

use branched_pendulum_compiler_tests::source::fixture;
use serde_json::Value;

/// Reads a file of the folder.
///
/// # Panics
/// If it is missing, or not JSON.
pub fn read(name: &str) -> Value {
    let path = fixture("reference").join(name);
    let text = std::fs::read_to_string(path).expect("the fixture exists");
    serde_json::from_str(&text).expect("the fixture is JSON")
}

/// Returns a decimal, in radians if the text gives degrees.
///
/// # Panics
/// If it is no text of a decimal.
pub fn number(value: &Value) -> f64 {
    let text = value.as_str().expect("numbers are texts of decimals");
    match text.strip_suffix(" degrees") {
        Some(degrees) => number(&Value::from(degrees)).to_radians(),
        None => text.parse().expect("a decimal"),
    }
}

/// Returns the decimals of a list.
///
/// # Panics
/// If it is no list of texts of decimals.
pub fn numbers(values: &Value) -> Vec<f64> {
    let values = values.as_array().expect("a list");
    values.iter().map(number).collect()
}

/// Returns the starting angles of a reference trajectory, and a function from each of its times to
/// the angles and velocities at this time.
///
/// # Panics
/// If no trajectory has this name. The function panics at other times.
pub fn trajectory(problem: &str) -> ([f64; 3], impl Fn(f64) -> Vec<f64>) {
    let reference = read("trajectories.json")["problems"][problem].clone();
    let theta: [f64; 3] = numbers(&reference["theta_0"])
        .try_into()
        .expect("three angles");
    let expected = move |time: f64| {
        let state = &reference["t"][time.to_string()];
        [numbers(&state["theta"]), numbers(&state["omega"])].concat()
    };
    (theta, expected)
}
