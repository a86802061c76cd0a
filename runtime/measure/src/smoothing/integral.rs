//! Integrals over time of quantities given at certain times.

/// Number of values through which the polynomial between two times passes.
const NODES: usize = 6;

/// Returns the integral of a quantity from the first time to each: over each interval by Simpson's
/// rule, its middle by the polynomial through the six nearest values. Exact for cubics, with even
/// and uneven times; for cos ω t with steps h, the relative error of the integral is below (ω
/// h)⁴/1400 if ω h ≤ 0.3, like that of the rule itself. If there are more values than times, the
/// rest is ignored.
///
/// # Examples
///
/// ```
/// use branched_pendulum_measure::running_integral;
///
/// let times = [0.0, 0.1, 0.25, 0.3, 0.5];
/// let integral = running_integral(&times, &times.map(|t| 4.0 * t * t * t));
/// assert!((integral[4] - 0.0625).abs() < 1e-15);
/// ```
pub fn running_integral(times: &[f64], values: &[f64]) -> Vec<f64> {
    let count = times.len().min(values.len());
    let mut sum = 0.0;
    let mut integral = Vec::with_capacity(count);
    for index in 0..count {
        if let Some(before) = index.checked_sub(1) {
            let step = times[index] - times[before];
            let first = (before + 1).saturating_sub(NODES / 2);
            let first = first.min(count.saturating_sub(NODES));
            let nodes = first..(first + NODES).min(count);
            let middle = interpolated(
                &times[nodes.clone()],
                &values[nodes],
                times[before] + 0.5 * step,
            );
            sum += step / 6.0 * (values[before] + 4.0 * middle + values[index]);
        }
        integral.push(sum);
    }
    integral
}

/// Returns the polynomial through the points (`times`, `values`) at the time `at`, by Lagrange's
/// formula.
fn interpolated(times: &[f64], values: &[f64], at: f64) -> f64 {
    let weighted = times.iter().zip(values).enumerate();
    let weighted = weighted.map(|(own, (time, value))| {
        let others = times.iter().enumerate().filter(|(other, _)| *other != own);
        let factors = others.map(|(_, other)| (at - other) / (time - other));
        value * factors.product::<f64>()
    });
    weighted.sum()
}
