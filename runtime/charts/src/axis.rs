use crate::cells::Grid;
use crate::description::{Axis, Chart, Panel, Series};
use crate::error::ChartError;
use crate::scale::{RESOLVED, Scale, coordinate, drawable};
use crate::ticks::rounded_outwards;

/// Margin of an axis, relative to its span.
const MARGIN: f64 = 0.05;

impl Scale {
    /// Creates the scale of `axis` that shows the range from `low` to `high`, or the range that was
    /// set for the axis. `margin` is relative to the span.
    fn showing(axis: &Axis, (low, high): (f64, f64), margin: f64) -> Result<Self, ChartError> {
        let given = axis.range.is_some();
        let (low, high) = axis.range.unwrap_or((low, high));
        let error = || ChartError::Range {
            axis: axis.label.clone(),
            low,
            high,
        };
        let valid = drawable(axis.log, low) && drawable(axis.log, high);
        if !valid || (given && low >= high) {
            return Err(error());
        }
        let (mut from, mut to) = (coordinate(axis.log, low), coordinate(axis.log, high));
        if !given {
            let pad = padding(axis.log, from, to, margin);
            (from, to) = (from - pad, to + pad);
            if margin == 0.0 && !axis.log && Self::linear(from, to).is_some() {
                (from, to) = rounded_outwards(from, to);
            }
        }
        if axis.log {
            // Ends as close as this are neighbouring floating-point numbers.
            let distinct = to - from > 1e-12;
            let scale = Self {
                log: true,
                low: from,
                high: to,
            };
            return distinct.then_some(scale).ok_or_else(error);
        }
        Self::linear(from, to).ok_or_else(error)
    }
}

impl Chart {
    /// Shows exactly the range from `low` to `high` of the x axis; what lies outside is cut off.
    /// Each y axis spans the samples in view, unless its range is given.
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x = self.x.range(low, high);
        self
    }

    /// Returns the least and the largest x of the samples that can be drawn; `None` without such a
    /// sample.
    pub fn x_extent(&self) -> Option<(f64, f64)> {
        let mut extent = Extent::default();
        for panel in &self.panels {
            let series = panel.series.iter();
            series
                .flat_map(|series| samples(series, self.x.log, panel.y.log))
                .for_each(|(x, _)| extent.add(x));
        }
        extent.0
    }
}

/// The value at a coordinate.
fn value(log: bool, coordinate: f64) -> f64 {
    if log {
        10.0_f64.powf(coordinate)
    } else {
        coordinate
    }
}

/// Returns the distance by which an axis extends beyond the data. If the data are constant (to the
/// resolution of ticks), they lie in the middle of an axis whose length is a tenth of their
/// magnitude, from -1 to 1, or one decade.
fn padding(log: bool, from: f64, to: f64, margin: f64) -> f64 {
    let magnitude = from.abs().max(to.abs());
    if to - from > RESOLVED * magnitude {
        (to - from) * margin
    } else if log {
        0.5
    } else if magnitude == 0.0 {
        1.0
    } else {
        magnitude * MARGIN
    }
}

/// Returns the scale of the x axis and the scales of all y axes.
pub(crate) fn scales(chart: &Chart) -> Result<(Scale, Vec<Scale>), ChartError> {
    if chart.panels.is_empty() {
        return Err(ChartError::Empty { panel: None });
    }
    let mut x_extent = Extent::default();
    let mut any_symbols = false;
    for (index, panel) in chart.panels.iter().enumerate() {
        check(chart, panel, index)?;
        for series in &panel.series {
            any_symbols |= series.symbols;
            samples(series, chart.x.log, panel.y.log).for_each(|(x, _)| x_extent.add(x));
        }
        panel.verticals.iter().for_each(|(x, _)| x_extent.add(*x));
        if let Some([(low, high), _]) = Grid::of(panel, chart.x.log).extent() {
            x_extent.add(value(chart.x.log, low));
            x_extent.add(value(chart.x.log, high));
        }
    }
    // Lines may touch the frame; symbols would be cut in half.
    let x_margin = if any_symbols { 0.6 * MARGIN } else { 0.0 };
    let x = Scale::showing(&chart.x, x_extent.ends(), x_margin)?;
    let y = chart.panels.iter().map(|panel| y_scale(chart, panel, &x));
    Ok((x, y.collect::<Result<_, _>>()?))
}

/// Returns the scale of colours; `None` without a shaded series.
pub(crate) fn color_scale(chart: &Chart) -> Result<Option<Scale>, ChartError> {
    let axis = chart.colors.clone().unwrap_or_else(|| Axis::linear(""));
    let series = chart.panels.iter().flat_map(|panel| &panel.series);
    let mut shaded = series
        .filter_map(|series| series.shades.as_ref())
        .peekable();
    if shaded.peek().is_none() {
        return Ok(None);
    }
    let mut extent = Extent::default();
    let values = shaded.flatten().filter(|value| drawable(axis.log, **value));
    values.for_each(|value| extent.add(*value));
    Scale::showing(&axis, extent.ends(), 0.0).map(Some)
}

/// Returns the scale of a panel's y axis, which spans the samples in view, or all samples if none
/// is in view.
fn y_scale(chart: &Chart, panel: &Panel, x: &Scale) -> Result<Scale, ChartError> {
    let mut extents = [Extent::default(), Extent::default()];
    for series in &panel.series {
        for (at, y) in samples(series, chart.x.log, panel.y.log) {
            let place = x.fraction(at).unwrap_or(f64::NAN);
            extents[0].add(y);
            if (-1e-9..=1.0 + 1e-9).contains(&place) {
                extents[1].add(y);
            }
        }
    }
    let [all, view] = extents;
    let mut extent = if view.any() { view } else { all };
    if panel.zero_line {
        extent.add(0.0);
    }
    // Cells fill their panel.
    let mut margin = MARGIN;
    if let Some([_, (low, high)]) = Grid::of(panel, chart.x.log).extent() {
        extent.add(value(panel.y.log, low));
        extent.add(value(panel.y.log, high));
        margin = 0.0;
    }
    Scale::showing(&panel.y, extent.ends(), margin)
}

fn check(chart: &Chart, panel: &Panel, index: usize) -> Result<(), ChartError> {
    if panel.series.is_empty() {
        return Err(ChartError::Empty { panel: Some(index) });
    }
    for series in &panel.series {
        let (low, shades) = (series.low.as_ref(), series.shades.as_ref());
        let others = [Some(&series.y), low, shades, series.errors.as_ref()];
        for y in others.into_iter().flatten() {
            if series.x.len() != y.len() {
                return Err(ChartError::LengthMismatch {
                    series: series.label.clone(),
                    x: series.x.len(),
                    y: y.len(),
                });
            }
        }
        if samples(series, chart.x.log, panel.y.log).next().is_none() {
            return Err(ChartError::NothingToDraw {
                series: series.label.clone(),
                samples: series.x.len(),
            });
        }
    }
    for (value, label) in &panel.verticals {
        if !drawable(chart.x.log, *value) {
            return Err(ChartError::MarkerLine {
                label: label.clone(),
                value: *value,
            });
        }
    }
    if panel.zero_line && panel.y.log {
        return Err(ChartError::MarkerLine {
            label: panel.y.label.clone(),
            value: 0.0,
        });
    }
    Ok(())
}

/// Returns the samples that the axes can show, with both edges of a band and both ends of error
/// bars.
fn samples(series: &Series, x_log: bool, y_log: bool) -> impl Iterator<Item = (f64, f64)> {
    let low = series.low.iter().flatten();
    let high = series.x.iter().zip(&series.y);
    let pairs = high.chain(series.x.iter().zip(low));
    let ends = series.errors.iter().flatten();
    let ends = ends.zip(series.x.iter().zip(&series.y));
    let ends = ends.flat_map(|(error, (x, y))| [(*x, y - error), (*x, y + error)]);
    let pairs = pairs.map(|(x, y)| (*x, *y)).chain(ends);
    pairs.filter(move |(x, y)| drawable(x_log, *x) && drawable(y_log, *y))
}

/// Least and largest of some values.
#[derive(Clone, Copy, Default)]
struct Extent(Option<(f64, f64)>);

impl Extent {
    fn add(&mut self, value: f64) {
        let (low, high) = self.0.unwrap_or((value, value));
        self.0 = Some((low.min(value), high.max(value)));
    }

    fn any(&self) -> bool {
        self.0.is_some()
    }

    /// Returns the ends; NaN, which no axis accepts, if there was no value.
    fn ends(&self) -> (f64, f64) {
        self.0.unwrap_or((f64::NAN, f64::NAN))
    }
}
