//! Length of the frames at whose ends the outputs of a scene lie.

use branched_pendulum::system::State;

/// Largest difference between the lengths of frames, as a fraction of a frame.
const AWAY: f64 = 1e-6;

/// Returns the length of the frames (s) at whose ends all times lie; `None` if the times are spaced
/// unevenly, or if the motions start at different times.
pub(crate) fn frame(starts: &[State<f64>], times: &[f64]) -> Option<f64> {
    let begin = starts.first()?.time;
    let frame = times.first()? - begin;
    let is_end = |(time, number): (&f64, u32)| {
        let frames = (time - begin) / frame;
        (frames - f64::from(number)).abs() <= AWAY
    };
    let are_ends = frame > 0.0 && times.iter().zip(1..).all(is_end);
    let began = starts.iter().all(|start| start.time == begin);
    (are_ends && began).then_some(frame)
}

#[cfg(test)]
mod tests {
    use super::frame;
    use branched_pendulum::system::State;

    #[test]
    fn frames_are_those_at_whose_ends_all_times_are() {
        let starts = [State::at_rest(1.0, &[0.1])];
        let frame = |times: &[f64]| frame(&starts, times);
        assert_eq!(frame(&[1.5, 2.0, 2.5]), Some(0.5));
        assert_eq!(frame(&[1.5, 2.0, 2.6]), None);
        assert_eq!(frame(&[0.5, 0.0]), None);
        assert_eq!(frame(&[]), None);
    }
}
