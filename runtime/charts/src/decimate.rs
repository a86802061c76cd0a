use std::collections::BTreeSet;

use crate::drawing::Point;

/// Reduces a line to its visible points: of consecutive points in one column of pixels, the first,
/// the lowest, the highest and the last are kept, in their order. `None` separates lines. Takes
/// time proportional to the number of points. Points may be in any order of x, but only consecutive
/// points in the same column are thinned out.
pub(crate) fn lines(points: impl Iterator<Item = Option<Point>>) -> Vec<Vec<Point>> {
    let mut lines = Vec::new();
    let mut line = Vec::new();
    let mut column: Option<Column> = None;
    for point in points {
        let Some(point) = point else {
            flush(&mut column, &mut line);
            if !line.is_empty() {
                lines.push(std::mem::take(&mut line));
            }
            continue;
        };
        match &mut column {
            Some(current) if current.holds(point) => current.add(point),
            _ => {
                flush(&mut column, &mut line);
                column = Some(Column::starting(point));
            }
        }
    }
    flush(&mut column, &mut line);
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// Consecutive points in one column of pixels, each with its index.
struct Column {
    first: Point,
    low: (usize, Point),
    high: (usize, Point),
    last: (usize, Point),
}

impl Column {
    fn starting(point: Point) -> Self {
        Self {
            first: point,
            low: (0, point),
            high: (0, point),
            last: (0, point),
        }
    }

    fn holds(&self, point: Point) -> bool {
        self.first.0.floor() == point.0.floor()
    }

    fn add(&mut self, point: Point) {
        self.last = (self.last.0 + 1, point);
        if point.1 < self.low.1.1 {
            self.low = self.last;
        }
        if point.1 > self.high.1.1 {
            self.high = self.last;
        }
    }
}

fn flush(column: &mut Option<Column>, line: &mut Vec<Point>) {
    let Some(column) = column.take() else { return };
    let mut points = [(0, column.first), column.low, column.high, column.last];
    points.sort_by_key(|(rank, _)| *rank);
    let mut previous = None;
    for (rank, point) in points {
        if previous != Some(rank) {
            line.push(point);
        }
        previous = Some(rank);
    }
}

/// Reduces symbols to the first one in each pixel.
pub(crate) fn symbols(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut taken = BTreeSet::new();
    points
        .filter(|(x, y)| taken.insert((x.floor() as i64, y.floor() as i64)))
        .collect()
}
