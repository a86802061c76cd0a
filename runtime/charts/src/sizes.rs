//! Sizes of the parts of a chart, px.

/// Font sizes and line heights, px.
pub(crate) const TITLE_SIZE: f64 = 16.0;
pub(crate) const TITLE_LINE: f64 = 21.0;
pub(crate) const LABEL_SIZE: f64 = 13.5;
pub(crate) const LABEL_LINE: f64 = 18.0;
pub(crate) const TICK_SIZE: f64 = 12.0;
pub(crate) const TICK_LINE: f64 = 16.0;
/// Length of a tick, and space between it and its label.
pub(crate) const TICK: f64 = 5.0;
pub(crate) const TICK_GAP: f64 = 3.0;
/// Space between the edge of the canvas and what it holds.
pub(crate) const EDGE: f64 = 12.0;
/// Space between the label of an axis and its tick labels.
pub(crate) const LABEL_GAP: f64 = 7.0;
/// Space between panels above each other, between columns of panels, and between
/// panels and the legend below.
pub(crate) const PANEL_GAP: f64 = 18.0;
pub(crate) const COLUMN_GAP: f64 = 20.0;
pub(crate) const LEGEND_GAP: f64 = 10.0;
/// Space between what is common to the tick labels and the name of a panel.
pub(crate) const NAME_GAP: f64 = 12.0;

pub(crate) const LEAST_SIZE: (f64, f64) = (320.0, 200.0);
/// Least width and height of a panel that can be read.
pub(crate) const LEAST_PANEL: (f64, f64) = (120.0, 100.0);
