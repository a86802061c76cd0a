//! Newton's search for angles at which a tree stays at rest.

use alloc::vec::Vec;

/// Most steps of a search.
pub(crate) const MOST_STEPS: usize = 100;

/// Longest step of an angle, rad: beyond, the stiffness says nothing.
const LONGEST_STEP: f64 = 0.5;

/// Changes angles by what `step` says until that no longer shrinks, and returns the largest
/// change of the last step if it is not small after [`MOST_STEPS`]. The angles are those of the
/// last call.
///
/// # Errors
///
/// Errors of `step`.
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
        // Rounding is reached where steps no longer shrink.
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
