use crate::drawing::Point;

/// A rectangle of the canvas, in px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Rect {
    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(crate) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(crate) fn corners(&self) -> Vec<Point> {
        vec![
            (self.left, self.bottom),
            (self.left, self.top),
            (self.right, self.top),
            (self.right, self.bottom),
        ]
    }

    pub(crate) fn contains(&self, (x, y): Point) -> bool {
        // A hair of slack: an extreme sample lies on the edge up to rounding.
        let slack = 1e-6;
        (self.left - slack..=self.right + slack).contains(&x)
            && (self.top - slack..=self.bottom + slack).contains(&y)
    }
}

/// Returns the parts of a line inside `area`, as separate lines.
pub(crate) fn line(points: &[Point], area: &Rect) -> Vec<Vec<Point>> {
    if let [only] = points {
        return match area.contains(*only) {
            true => vec![vec![*only]],
            false => Vec::new(),
        };
    }
    let mut parts: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let &[from, to] = pair else { continue };
        let Some((from, to)) = segment(from, to, area) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Returns the part of a segment inside `area`, by the method of Liang and Barsky (ACM Trans.
/// Graphics 3 (1984) 1). Ends that lie inside are returned unchanged.
fn segment(from: Point, to: Point, area: &Rect) -> Option<(Point, Point)> {
    // Nearer than this a point moves by less than a tenth of a pixel where the
    // segment crosses the edge; farther ones could overflow.
    let near = |v: f64| v.clamp(-1e7, 1e7);
    let (from, to) = ((near(from.0), near(from.1)), (near(to.0), near(to.1)));
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (run, room) in [
        (-dx, from.0 - area.left),
        (dx, area.right - from.0),
        (-dy, from.1 - area.top),
        (dy, area.bottom - from.1),
    ] {
        if run == 0.0 {
            // As in `contains`: a flat line on the edge is inside.
            if room < -1e-6 {
                return None;
            }
        } else if run < 0.0 {
            enter = enter.max(room / run);
        } else {
            leave = leave.min(room / run);
        }
    }
    let at = |s: f64| (from.0 + s * dx, from.1 + s * dy);
    (enter <= leave).then(|| {
        (
            if enter > 0.0 { at(enter) } else { from },
            if leave < 1.0 { at(leave) } else { to },
        )
    })
}
