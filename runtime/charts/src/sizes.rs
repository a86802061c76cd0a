//! Sizes of the parts of a chart, in px.

/// Font sizes and line heights, px.
pub(crate) const TITLE_SIZE: f64 = 16.0;
pub(crate) const TITLE_LINE: f64 = 21.0;
pub(crate) const LABEL_SIZE: f64 = 13.5;
pub(crate) const LABEL_LINE: f64 = 18.0;
pub(crate) const TICK_SIZE: f64 = 12.0;
pub(crate) const TICK_LINE: f64 = 16.0;
/// Length of a tick, and gap between it and its label, in px.
pub(crate) const TICK: f64 = 5.0;
pub(crate) const TICK_GAP: f64 = 3.0;
/// Margin between the edge of the canvas and its contents, in px.
pub(crate) const EDGE: f64 = 12.0;
/// Gap between the label of an axis and its tick labels, in px.
pub(crate) const LABEL_GAP: f64 = 7.0;
/// Gaps between panels above each other, between columns of panels, and between panels and the
/// legend below, in px.
pub(crate) const PANEL_GAP: f64 = 18.0;
pub(crate) const COLUMN_GAP: f64 = 20.0;
pub(crate) const LEGEND_GAP: f64 = 10.0;
/// Gap between the common part of the tick labels and the name of a panel, in px.
pub(crate) const NAME_GAP: f64 = 12.0;

pub(crate) const LEAST_SIZE: (f64, f64) = (320.0, 200.0);
/// Smallest legible width and height of a panel, in px.
pub(crate) const LEAST_PANEL: (f64, f64) = (120.0, 100.0);
