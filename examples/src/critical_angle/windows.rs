//! Neighbours among the angles of a scan.

/// Returns first and last angle of each run of neighbours among `angles` for which
/// `inside` holds.
pub fn windows(angles: &[f64], inside: impl Fn(usize) -> bool) -> Vec<[f64; 2]> {
    let mut windows: Vec<[f64; 2]> = Vec::new();
    let mut before = false;
    for (index, &angle) in angles.iter().enumerate() {
        let now = inside(index);
        match windows.last_mut() {
            Some(window) if now && before => window[1] = angle,
            _ if now => windows.push([angle; 2]),
            _ => {}
        }
        before = now;
    }
    windows
}

/// Tells windows in words: `43.4° to 44.8°, 46°, from 46.15°`, where the last reaches
/// the end of the scan.
pub fn words(windows: &[[f64; 2]], end: f64) -> String {
    if windows.is_empty() {
        return "nowhere".to_owned();
    }
    let word = |&[first, last]: &[f64; 2]| match () {
        () if last == end && first < end => format!("from {first}°"),
        () if first == last => format!("{first}°"),
        () => format!("{first}° to {last}°"),
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
        let found = windows(&angles, |index| inside[index]);
        assert_eq!(found, [[1.0, 2.0], [4.0, 4.0], [6.0, 6.0]]);
        assert_eq!(words(&found, 7.0), "1° to 2°, 4°, 6°");
        assert_eq!(words(&[[1.0, 2.0], [4.0, 6.0]], 6.0), "1° to 2°, from 4°");
        assert_eq!(words(&windows(&angles, |_| false), 6.0), "nowhere");
    }
}
