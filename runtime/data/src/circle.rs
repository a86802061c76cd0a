//! Recognises columns that are coordinates, independently of their names.

use std::f64::consts::PI;

/// Returns the radius of the circle on which pairs of values lie, if they move back and forth on an
/// arc of it, or all around it. They are then the coordinates of a point at a constant distance
/// from a pivot. The angles of two links may lie on an arc for a while, but do not move back on it.
pub(crate) fn radius(xs: &[Option<f64>], ys: &[Option<f64>]) -> Option<f64> {
    /// Largest rms deviation from a circle, relative to its radius.
    const DEVIATION: f64 = 0.01;
    /// Smallest extent of an arc, relative to its radius, at which it can be distinguished from a
    /// straight line. It is measured as the distance of its points from their mean.
    const EXTENT: f64 = 0.3;
    const ROWS: usize = 8;
    let points = xs.iter().zip(ys).filter_map(|(x, y)| Some(((*x)?, (*y)?)));
    let points: Vec<(f64, f64)> = points.collect();
    if points.len() < ROWS {
        return None;
    }
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        points.iter().map(|&(x, y)| of(x, y)).sum::<f64>() / points.len() as f64
    };
    let (x0, y0) = (mean(&|x, _| x), mean(&|_, y| y));
    // The centre by least squares in x² + y², about the mean.
    let moment = |i, j| mean(&move |x, y| (x - x0).powi(i) * (y - y0).powi(j));
    let (xx, xy, yy) = (moment(2, 0), moment(1, 1), moment(0, 2));
    let right = [
        0.5 * (moment(3, 0) + moment(1, 2)),
        0.5 * (moment(0, 3) + moment(2, 1)),
    ];
    let determinant = xx * yy - xy * xy;
    let centre = [
        (right[0] * yy - right[1] * xy) / determinant,
        (right[1] * xx - right[0] * xy) / determinant,
    ];
    let radius = (centre[0].powi(2) + centre[1].powi(2) + xx + yy).sqrt();
    let distance = |x: f64, y: f64| (x - x0 - centre[0]).hypot(y - y0 - centre[1]);
    let deviation = mean(&|x, y| (distance(x, y) - radius).powi(2)).sqrt();
    let extent = points.iter().map(|&(x, y)| (x - x0).hypot(y - y0));
    let extent = extent.fold(0.0, f64::max);
    let is_arc = deviation < DEVIATION * radius && extent > EXTENT * radius;
    // Angles about the centre, from the direction opposite to that of the mean.
    let along = points.iter().map(|&(x, y)| {
        let [x, y] = [x - x0 - centre[0], y - y0 - centre[1]];
        let [down, across] = [
            -x * centre[0] - y * centre[1],
            x * centre[1] - y * centre[0],
        ];
        across.atan2(down)
    });
    (is_arc && goes_back(&along.collect::<Vec<_>>())).then_some(radius)
}

/// Returns true if the angles on the circle move back over half of their range, or complete a full
/// turn.
fn goes_back(angles: &[f64]) -> bool {
    let place = |is_least: bool| {
        let sign = if is_least { -1.0 } else { 1.0 };
        let order =
            |a: &usize, b: &usize| f64::total_cmp(&(sign * angles[*a]), &(sign * angles[*b]));
        (0..angles.len()).max_by(order).unwrap_or(0)
    };
    let [least, most] = [true, false].map(place);
    let range = angles[most] - angles[least];
    let [first, last] = [least.min(most), least.max(most)];
    let is_far = |from: usize| move |angle: &f64| (angle - angles[from]).abs() > 0.5 * range;
    range > 1.5 * PI
        || angles[..first].iter().any(is_far(first))
        || angles[last..].iter().any(is_far(last))
}
