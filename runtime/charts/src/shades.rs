//! Values as colours: the cells of a map.

use crate::areas;
use crate::arrange::{PanelPlan, Plan};
use crate::cells::Grid;
use crate::clip::Rect;
use crate::color_bar::{COLORS, ColorBar};
use crate::description::Series;
use crate::drawing::Mark;
use crate::style::{Fill, ramp};

impl ColorBar {
    /// Adds the cells of a shaded series to `marks`.
    pub(crate) fn cells(
        &self,
        series: &Series,
        values: &[f64],
        (grid, plan, place): (&Grid, &Plan, &PanelPlan),
        marks: &mut Vec<Mark>,
    ) {
        let mut classes = vec![Vec::new(); COLORS];
        let samples = series.x.iter().zip(&series.y).zip(values);
        for ((x, y), value) in samples {
            let cell = areas::cell((*x, *y), grid, plan, place);
            if let Some((class, cell)) = self.class(*value).zip(cell) {
                classes[class].push(cell);
            }
        }
        for (color, cells) in ramp(COLORS).into_iter().zip(classes) {
            marks.push(Mark::Areas {
                polygons: joined(cells).iter().map(Rect::corners).collect(),
                color,
                fill: Fill::Crisp,
            });
        }
    }
}

/// Joins neighbouring cells of a row, which makes the file smaller.
fn joined(mut cells: Vec<Rect>) -> Vec<Rect> {
    cells.sort_by(|a, b| a.top.total_cmp(&b.top).then(a.left.total_cmp(&b.left)));
    let mut joined: Vec<Rect> = Vec::new();
    for cell in cells {
        match joined.last_mut() {
            Some(last) if last.top == cell.top && cell.left - last.right < 1e-6 => {
                last.right = cell.right;
            }
            _ => joined.push(cell),
        }
    }
    joined
}
