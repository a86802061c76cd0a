//! A progress bar for a terminal.

use std::io::Write;

const WIDTH: usize = 40;

/// A bar on one line, drawn again whenever it has grown by a per cent.
///
/// What it cannot write it leaves unwritten: a broken bar is no reason to stop.
#[derive(Debug)]
pub struct ProgressBar<W: Write> {
    /// `None`: stay quiet.
    out: Option<W>,
    drawn: Option<usize>,
}

impl<W: Write> ProgressBar<W> {
    /// A bar on `out` if that is a terminal, and nothing otherwise.
    pub fn new(out: W, is_terminal: bool) -> Self {
        Self {
            out: is_terminal.then_some(out),
            drawn: None,
        }
    }

    /// Shows that the part `done` (0 to 1) of all is done, with what is being
    /// worked on.
    pub fn show(&mut self, done: f64, what: &str) {
        let percent = (100.0 * done) as usize;
        let Some(out) = &mut self.out else { return };
        if self.drawn == Some(percent) {
            return;
        }
        self.drawn = Some(percent);
        let filled = WIDTH * percent.min(100) / 100;
        let (full, empty) = ("█".repeat(filled), "░".repeat(WIDTH - filled));
        let _ = write!(out, "\r{full}{empty} {percent:>3} %  {what}\x1b[K");
        let _ = out.flush();
    }

    /// Wipes the bar.
    pub fn clear(&mut self) {
        if let Some(out) = &mut self.out
            && self.drawn.take().is_some()
        {
            let _ = write!(out, "\r\x1b[K");
            let _ = out.flush();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ProgressBar;

    #[test]
    fn draws_each_per_cent_once_and_wipes_itself() {
        let mut text = Vec::new();
        let mut bar = ProgressBar::new(&mut text, true);
        bar.show(0.501, "45°");
        bar.show(0.509, "45°");
        bar.show(1.0, "45°");
        bar.clear();
        bar.clear();
        let text = String::from_utf8(text).unwrap();
        let lines: Vec<&str> = text.split('\r').collect();
        assert_eq!(lines.len(), 4);
        assert_eq!(lines[1].matches('█').count(), 20);
        assert_eq!(lines[1].matches('░').count(), 20);
        assert!(lines[1].contains(" 50 %  45°"));
        assert!(lines[2].contains("100 %"));
        assert_eq!(lines[3], "\x1b[K");
    }

    #[test]
    fn is_quiet_where_there_is_no_terminal() {
        let mut text = Vec::new();
        let mut bar = ProgressBar::new(&mut text, false);
        bar.show(0.5, "45°");
        bar.clear();
        assert!(text.is_empty());
    }
}
