//! Rows in which tracking lost a dot: programs then write a mark, or repeat the previous position.

use branched_pendulum_data::Table;

use crate::measured_file::MeasuredFile;

/// Positions that programs write for a lost dot.
const MARKS: [[f64; 2]; 2] = [[0.0, 0.0], [-1.0, -1.0]];
/// Number of successive rows with the same position that do not occur by chance.
const STAYS: usize = 3;
/// Largest number of rows between two intervals that are joined.
const BETWEEN: usize = 2;
/// Largest number of intervals, and largest fraction of the record that they may cover.
const STRETCHES: usize = 60;
const PART: f64 = 0.4;

/// Returns the time intervals (s) in which a dot of the table is lost; `None` if there are none.
pub(super) fn lost(table: &Table, file: &MeasuredFile) -> Option<Vec<[f64; 2]>> {
    let rows = table.rows();
    let mut is_lost = vec![false; rows];
    for track in table.tracks() {
        let [x, y] = [table.values(track.x).ok()?, table.values(track.y).ok()?];
        let places: Vec<Option<[f64; 2]>> =
            x.iter().zip(y).map(|(x, y)| Some([(*x)?, (*y)?])).collect();
        let own = of_dot(&places);
        is_lost
            .iter_mut()
            .zip(own)
            .for_each(|(all, own)| *all |= own);
    }
    let count = is_lost.iter().filter(|lost| **lost).count();
    if count == 0 || count as f64 > PART * rows as f64 {
        return None;
    }
    let times = file.times(table)?;
    let mut stretches: Vec<[usize; 2]> = Vec::new();
    for row in (0..rows).filter(|row| is_lost[*row]) {
        match stretches.last_mut() {
            Some([_, last]) if row - *last <= BETWEEN + 1 => *last = row,
            _ => stretches.push([row, row]),
        }
    }
    // Rounded outwards, so that an option names them in few digits.
    let ends = |[first, last]: &[usize; 2]| {
        let (from, to) = (1e4 * times[*first], 1e4 * times[*last]);
        [from.floor() / 1e4, to.ceil() / 1e4]
    };
    let found = stretches.iter().map(ends).collect();
    (stretches.len() <= STRETCHES).then_some(found)
}

/// Returns, for each row, true if the dot has a mark or repeats its previous position. A dot that
/// never moves is a pivot.
fn of_dot(places: &[Option<[f64; 2]>]) -> Vec<bool> {
    let mut is_lost = vec![false; places.len()];
    let first = places.iter().flatten().next();
    let mut others = places.iter().flatten();
    if others.all(|place| Some(place) == first) {
        return is_lost;
    }
    for (lost, place) in is_lost.iter_mut().zip(places) {
        *lost = place.is_some_and(|place| MARKS.contains(&place));
    }
    let mut start = 0;
    for row in 1..=places.len() {
        let stays = places.get(row).is_some_and(|place| *place == places[start]);
        if stays {
            continue;
        }
        if row - start >= STAYS && places[start].is_some() {
            // The first row is the last at which the dot was seen.
            is_lost[start + 1..row].fill(true);
        }
        start = row;
    }
    is_lost
}

#[cfg(test)]
mod tests {
    use super::of_dot;

    #[test]
    fn marks_and_dots_that_stay_are_lost() {
        let row = |x: f64| Some([x, 1.0 - 0.1 * x]);
        let moving: Vec<_> = (0..12).map(|x| row(f64::from(x) + 1.0)).collect();
        assert!(!of_dot(&moving).contains(&true));
        for mark in [[0.0, 0.0], [-1.0, -1.0]] {
            let mut places = moving.clone();
            (places[4], places[9]) = (Some(mark), Some(mark));
            let lost = of_dot(&places);
            let rows: Vec<usize> = (0..12).filter(|row| lost[*row]).collect();
            assert_eq!(rows, [4, 9]);
        }
        let mut places = moving.clone();
        (places[6], places[7], places[8]) = (places[5], places[5], places[5]);
        let lost = of_dot(&places);
        let rows: Vec<usize> = (0..12).filter(|row| lost[*row]).collect();
        assert_eq!(rows, [6, 7, 8]);
        // A pivot in the origin is no lost dot, and a gap is none that stays.
        assert!(!of_dot(&[Some([0.0, 0.0]); 12]).contains(&true));
        assert!(!of_dot(&[row(1.0), None, None, None, row(2.0)]).contains(&true));
    }
}
