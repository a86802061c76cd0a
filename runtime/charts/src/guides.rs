use crate::clip::Rect;
use crate::description::Panel;
use crate::font::Font;
use crate::label::{Label, widest};
use crate::scale::Scale;

/// Font size and line height of the labels of marker lines, in px.
pub(crate) const SIZE: f64 = 12.5;
pub(crate) const LINE: f64 = 16.0;

/// A vertical marker line with its label above the panel.
pub(crate) struct Guide {
    /// Value at which the line is drawn.
    pub(crate) x: f64,
    /// Middle of the label.
    pub(crate) text_x: f64,
    /// Row of the label's last line; row 0 is next to the panel.
    pub(crate) row: usize,
    pub(crate) lines: Vec<Label>,
}

/// Arranges the labels of a panel's marker lines in rows so that none overlap. `reserved` has, for
/// each row, the width in px at its left that another text takes. Returns the marker lines in view
/// and the number of rows.
pub(crate) fn place(
    panel: &Panel,
    scale: &Scale,
    frame: &Rect,
    font: &Font,
    reserved: &[f64],
) -> (Vec<Guide>, usize) {
    // Row and horizontal extent of what is placed.
    let rows = reserved.iter().enumerate();
    let mut taken: Vec<(usize, f64, f64)> = rows
        .map(|(row, width)| (row, f64::NEG_INFINITY, frame.left + width))
        .collect();
    let mut guides: Vec<Guide> = Vec::new();
    for (value, label) in &panel.verticals {
        let place = scale.fraction(*value).unwrap_or(f64::NAN);
        if !(-1e-9..=1.0 + 1e-9).contains(&place) {
            continue;
        }
        let x = frame.left + place * frame.width();
        let lines = Label::parse(label).wrap(font, SIZE, frame.width());
        let half = widest(&lines, font, SIZE) / 2.0;
        let text_x = x.min(frame.right - half).max(frame.left + half);
        let (from, to) = (text_x - half - 5.0, text_x + half + 5.0);
        let free = |row: usize| {
            let rows = row..row + lines.len();
            !taken
                .iter()
                .any(|(r, a, b)| rows.contains(r) && *a < to && from < *b)
        };
        // There is always a free row above all that is placed.
        let above = taken.iter().map(|(row, ..)| row + 1).max().unwrap_or(0);
        let row = (0..above).find(|row| free(*row)).unwrap_or(above);
        taken.extend((row..row + lines.len()).map(|row| (row, from, to)));
        guides.push(Guide {
            x,
            text_x,
            row,
            lines,
        });
    }
    let rows = taken.iter().map(|(row, ..)| row + 1).max().unwrap_or(0);
    (guides, rows)
}
