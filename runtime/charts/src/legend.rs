use crate::description::{Chart, Series};
use crate::font::Font;
use crate::label::{Label, widest};
use crate::style::{DOT, Dash, Fill, RADIUS, Style, automatic};

/// Font size, line height, and sizes of the sample in front of the text, in px.
pub(crate) const SIZE: f64 = 12.5;
pub(crate) const LINE: f64 = 16.0;
pub(crate) const SAMPLE: f64 = 30.0;
pub(crate) const GAP: f64 = 7.0;
/// Vertical and horizontal gap between entries, in px.
pub(crate) const ROW_GAP: f64 = 4.0;
pub(crate) const COLUMN_GAP: f64 = 22.0;
/// Gap between a panel and the legend to its right, in px.
pub(crate) const SIDE_GAP: f64 = 14.0;

/// Largest fraction of the chart's width that a legend on the right may take.
const WIDEST_SIDE: f64 = 0.3;
/// Least width (px) of a chart whose legend is next to its panels.
const LEAST_WIDTH: f64 = 500.0;

/// The legend, which explains the series, with its position.
pub(crate) struct Legend {
    /// Entries, one list for each panel if the legend is to the right of the panels; otherwise a
    /// single list.
    pub(crate) lists: Vec<Vec<Entry>>,
    pub(crate) below: bool,
    /// Width of the widest entry.
    pub(crate) cell: f64,
}

pub(crate) struct Entry {
    pub(crate) style: Style,
    class: usize,
    pub(crate) lines: Vec<Label>,
}

impl Entry {
    pub(crate) fn height(&self) -> f64 {
        self.lines.len() as f64 * LINE + ROW_GAP
    }
}

impl Legend {
    /// Plans the legend of panels of these heights. It is to the right if the panels are in one
    /// column, it is narrow enough and no panel's entries are higher than the panel; otherwise it
    /// is below.
    pub(crate) fn plan(
        chart: &Chart,
        styles: &[Vec<Style>],
        font: &Font,
        width: f64,
        heights: &[f64],
    ) -> Self {
        let at_right = Self::with_text_width(chart, styles, font, f64::INFINITY);
        let fits =
            at_right.lists.iter().zip(heights).all(|(list, height)| {
                list.iter().map(Entry::height).sum::<f64>() <= *height + ROW_GAP
            });
        let shaded = panels_shaded(chart);
        let is_narrow = at_right.cell <= WIDEST_SIDE * chart.width && chart.width >= LEAST_WIDTH;
        if chart.columns == 1 && !shaded && fits && is_narrow {
            return at_right;
        }
        let text_width = width - SAMPLE - GAP;
        let below = Self::with_text_width(chart, styles, font, text_width);
        let mut list: Vec<Entry> = below.lists.into_iter().flatten().collect();
        // A panel may lack classes that a later one has.
        list.sort_by_key(|entry| entry.class);
        Self {
            lists: vec![list],
            below: true,
            cell: below.cell,
        }
    }

    /// Creates one entry for each distinct label, in the first panel that has it.
    fn with_text_width(chart: &Chart, styles: &[Vec<Style>], font: &Font, text_width: f64) -> Self {
        let mut seen: Vec<&str> = vec![""];
        let mut lists = Vec::new();
        let mut cell: f64 = 0.0;
        for (panel, styles) in chart.panels.iter().zip(styles) {
            let mut list = Vec::new();
            for (series, style) in panel.series.iter().zip(styles) {
                if seen.contains(&series.label.as_str()) {
                    continue;
                }
                seen.push(&series.label);
                let lines = Label::parse(&series.label).wrap(font, SIZE, text_width);
                cell = cell.max(SAMPLE + GAP + widest(&lines, font, SIZE));
                list.push(Entry {
                    style: *style,
                    class: series.class,
                    lines,
                });
            }
            lists.push(list);
        }
        Self {
            lists,
            below: false,
            cell,
        }
    }

    /// Returns the width that the legend takes from the panels.
    pub(crate) fn side_width(&self) -> f64 {
        if self.below || self.cell == 0.0 {
            0.0
        } else {
            self.cell + SIDE_GAP
        }
    }

    /// Returns the rows of a legend below the panels, for a width of `width` px.
    pub(crate) fn rows(&self, width: f64) -> Vec<&[Entry]> {
        let columns = (width + COLUMN_GAP) / (self.cell + COLUMN_GAP);
        let columns = (columns.floor() as usize).max(1);
        let list = self.lists.first().filter(|_| self.below);
        list.map_or(&[][..], Vec::as_slice)
            .chunks(columns)
            .collect()
    }
}

/// Returns true if a colour bar is to the right of the panels.
fn panels_shaded(chart: &Chart) -> bool {
    let mut series = chart.panels.iter().flat_map(|panel| &panel.series);
    series.any(|series| series.shades.is_some())
}

pub(crate) fn row_height(row: &[Entry]) -> f64 {
    row.iter().map(Entry::height).fold(0.0, f64::max)
}

/// Returns the style of each series of each panel. Distinct labels are counted through all panels,
/// so that a legend for the whole chart is unambiguous; each series without a label counts as one
/// more.
pub(crate) fn styles(chart: &Chart) -> Vec<Vec<Style>> {
    let mut known: Vec<&str> = Vec::new();
    let mut style = |series| automatic_for(series, &mut known);
    let panels = chart.panels.iter();
    panels
        .map(|panel| panel.series.iter().map(&mut style).collect())
        .collect()
}

fn automatic_for<'a>(series: &'a Series, known: &mut Vec<&'a str>) -> Style {
    let label = series.label.as_str();
    let before = known.iter().position(|l| *l == label && !label.is_empty());
    let index = before.unwrap_or(known.len());
    if before.is_none() {
        known.push(label);
    }
    let (color, dash, symbol) = automatic(index);
    Style {
        color: series.color.unwrap_or(color),
        dash: series.joined.then(|| {
            let dash = if is_noisy(series) { Dash::Solid } else { dash };
            series.dash.unwrap_or(dash)
        }),
        symbol: series.symbols.then(|| series.symbol.unwrap_or(symbol)),
        radius: if series.small { DOT } else { RADIUS },
        fill: match series {
            Series { cells: true, .. } => Some(Fill::Crisp),
            Series { low: Some(_), .. } => Some(Fill::Sheer),
            _ => None,
        },
    }
}

/// Returns true if a line turns so often that dashes could not be seen: about once in 4 px of a
/// panel of usual width.
fn is_noisy(series: &Series) -> bool {
    let turns = series.y.windows(3).filter(|y| match y {
        [a, b, c] => (a < b && b > c) || (a > b && b < c),
        _ => false,
    });
    turns.count() > 200
}
