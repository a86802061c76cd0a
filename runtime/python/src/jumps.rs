//! Jumps of measured angles.

use std::f64::consts::PI;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Fraction of a link's steps above which jumps are not considered single wrong samples.
const JUMPS: f64 = 0.01;

/// Rejects angles that jump by more than half a turn from one time to the next, as angles in
/// degrees or angles reduced to one turn do. Missing angles are left out.
pub(crate) fn refuse_jumps(angles: &[Vec<Option<f64>>]) -> PyResult<()> {
    let links = angles.first().map_or(0, Vec::len);
    for link in 0..links {
        let steps = angles.windows(2).enumerate();
        let jumps = steps.filter_map(|(row, pair)| {
            let step = (pair[1][link]? - pair[0][link]?).abs();
            (step > PI).then_some((row + 1, step))
        });
        let jumps: Vec<(usize, f64)> = jumps.collect();
        let Some((row, step)) = jumps.first() else {
            continue;
        };
        // Turns that are not counted are few, and each of them is a jump of the whole motion.
        let whole = jumps.iter().any(|(_, step)| (step - 2.0 * PI).abs() < 1.0);
        if jumps.len() as f64 > JUMPS * angles.len() as f64 || whole {
            let text = format!(
                "theta[{row}, {link}] is {step:.2} rad away from the angle before it: theta must be in \
                 radians, without jumps of a turn; help: np.radians(theta) if it is in degrees, \
                 np.unwrap(theta, axis=0) if it is kept within a turn"
            );
            return Err(PyValueError::new_err(text));
        }
    }
    Ok(())
}
