//! Windows (runs of neighbouring angles) in a scan.

/// Returns the first and the last index of each run of neighbours, among the indices below `count`,
/// for which `inside` returns true.
pub fn windows(count: usize, inside: impl Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let mut windows: Vec<[usize; 2]> = Vec::new();
    for index in (0..count).filter(|index| inside(*index)) {
        match windows.last_mut() {
            Some([_, last]) if *last + 1 == index => *last = index,
            _ => windows.push([index; 2]),
        }
    }
    windows
}

/// Formats windows of angles (degrees) as text: `43.4° to 44.8°, 46°, from 46.15°`; the last one
/// here extends to the end of the scan.
pub fn words(windows: &[[usize; 2]], angles: &[f64]) -> String {
    if windows.is_empty() {
        return "nowhere".to_owned();
    }
    let word = |&[first, last]: &[usize; 2]| match (angles[first], angles[last]) {
        (from, to) if from == to => format!("{from}°"),
        (from, _) if last + 1 == angles.len() => format!("from {from}°"),
        (from, to) => format!("{from}° to {to}°"),
    };
    windows.iter().map(word).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::{windows, words};

    #[test]
    fn neighbours_make_a_window() {
        let angles = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let inside = [true, true, false, true, false, true];
        let found = windows(6, |index| inside[index]);
        assert_eq!(found, [[0, 1], [3, 3], [5, 5]]);
        assert_eq!(words(&found, &angles), "1° to 2°, 4°, 6°");
        assert_eq!(words(&[[0, 1], [3, 5]], &angles), "1° to 2°, from 4°");
        assert_eq!(words(&windows(6, |_| false), &angles), "nowhere");
    }
}
