//! Newton's search for angles at which a tree stays at rest.

use alloc::vec::Vec;

/// Largest number of steps of a search.
pub(crate) const MOST_STEPS: usize = 100;

/// Largest change of an angle in one step, in rad. For larger changes the stiffness does not
/// predict the torques.
const LONGEST_STEP: f64 = 0.5;

/// Repeatedly adds the changes returned by `step` to the angles (rad) until they no longer become
/// smaller, and then returns `None`. After [`MOST_STEPS`] steps it returns the largest change in
/// the last step instead. `step` was last called at the final angles.
///
/// # Errors
///
/// Returns the errors of `step`.
pub(crate) fn come_to_rest<E>(
    angles: &mut [f64],
    mut step: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<Option<f64>, E> {
    let mut size = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let changes = step(angles)?;
        let before = size;
        let sizes = changes.iter().map(|change| change.abs());
        size = sizes.fold(0.0, f64::max);
        // Steps that no longer shrink have reached the level of rounding.
        if size == 0.0 || (size < 1e-9 && size >= 0.5 * before) {
            return Ok(None);
        }
        let factor = f64::min(LONGEST_STEP / size, 1.0);
        for (angle, change) in angles.iter_mut().zip(changes) {
            *angle += factor * change;
        }
    }
    Ok(Some(size))
}
