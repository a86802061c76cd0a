//! Checks of available memory before large arrays are allocated.

use std::fs;

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// Number of bytes below which the available memory is not checked.
const SMALL: usize = 64 << 20;

/// Returns how many bytes of memory are available, if the machine reports it.
fn free() -> Option<usize> {
    let number = |text: &str| text.split_whitespace().next()?.parse::<usize>().ok();
    let meminfo = fs::read_to_string("/proc/meminfo").ok()?;
    let available = meminfo
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let machine = number(available)?.checked_mul(1024)?;
    let of_group = |name: &str| number(&fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok()?);
    let group = of_group("memory.max")
        .zip(of_group("memory.current"))
        .map(|(most, used)| most.saturating_sub(used));
    Some(group.map_or(machine, |group| group.min(machine)))
}

/// Checks that a number of bytes of memory is available.
///
/// # Errors
/// MemoryError.
pub(crate) fn need(what: &str, bytes: Option<usize>) -> PyResult<()> {
    let gigabytes = |bytes: usize| bytes as f64 / 1e9;
    let Some(bytes) = bytes else {
        let text = format!("{what} would take more bytes than any machine has");
        return Err(PyMemoryError::new_err(text));
    };
    if bytes < SMALL {
        return Ok(());
    }
    let is_there = free().is_none_or(|free| bytes <= free);
    let mut trial: Vec<u8> = Vec::new();
    if !is_there || trial.try_reserve_exact(bytes).is_err() {
        let text = format!(
            "{what} would take {:.1} GB, more than are free",
            gigabytes(bytes)
        );
        return Err(PyMemoryError::new_err(text));
    }
    Ok(())
}

/// Returns the number of bytes of an array of this shape, multiplied by `times`.
pub(crate) fn bytes(shape: &[usize], times: usize) -> Option<usize> {
    let sizes = shape.iter().copied().chain([times, size_of::<f64>()]);
    sizes.into_iter().try_fold(1_usize, usize::checked_mul)
}

/// Allocates memory for an array of this shape.
///
/// # Errors
/// MemoryError.
pub(crate) fn allocate(shape: &[usize]) -> PyResult<Vec<f64>> {
    let what = format!("an array of shape {}", shown(shape));
    need(&what, bytes(shape, 1))?;
    let mut values = Vec::new();
    let count = shape.iter().product();
    values
        .try_reserve_exact(count)
        .map_err(|_| PyMemoryError::new_err(format!("there is no memory for {what}")))?;
    Ok(values)
}

/// Returns a shape as Python writes it, as in `(3, 4)`.
pub(crate) fn shown(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        axes => {
            let axes: Vec<String> = axes.iter().map(ToString::to_string).collect();
            format!("({})", axes.join(", "))
        }
    }
}
