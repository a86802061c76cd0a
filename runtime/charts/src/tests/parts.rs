use crate::clip::{self, Rect};
use crate::decimal::number;
use crate::decimate;
use crate::font::{Font, Outline};
use crate::label::{Label, Level, verbatim};
use crate::scale::Scale;
use crate::ticks::{Ticks, ticks};

type Failure = Result<(), Box<dyn std::error::Error>>;

fn linear(low: f64, high: f64, most: usize) -> Ticks {
    let log = false;
    ticks(&Scale { log, low, high }, most)
}

fn logarithmic(low: f64, high: f64, most: usize) -> Ticks {
    let (low, high) = (low.log10(), high.log10());
    ticks(
        &Scale {
            log: true,
            low,
            high,
        },
        most,
    )
}

fn labels(ticks: &Ticks) -> Vec<&str> {
    ticks.major.iter().map(|tick| tick.label.as_str()).collect()
}

#[test]
fn linear_ticks_are_round_and_written_exactly() {
    let unit = linear(0.0, 1.0, 6);
    assert_eq!(labels(&unit), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    assert_eq!(unit.common, None);
    let angles = linear(-120.0, 110.0, 6);
    assert_eq!(labels(&angles), ["−100", "−50", "0", "50", "100"]);
    let steps = linear(0.0, 70000.0, 5);
    assert_eq!(labels(&steps), ["0", "20000", "40000", "60000"]);
}

#[test]
fn small_and_large_values_share_a_power_of_ten() {
    let small = linear(-1e-12, 1.2e-12, 6);
    assert_eq!(labels(&small), ["−1.0", "−0.5", "0", "0.5", "1.0"]);
    assert_eq!(small.common.as_deref(), Some("×10^{−12}"));
    let large = linear(0.0, 3e5, 4);
    assert_eq!(labels(&large), ["0", "100", "200", "300"]);
    assert_eq!(large.common.as_deref(), Some("×10^{3}"));
}

#[test]
fn values_far_from_zero_share_an_offset() {
    let offset = linear(1000.0001, 1000.0002, 6);
    assert_eq!(labels(&offset), ["0", "20", "40", "60", "80", "100"]);
    assert_eq!(offset.common.as_deref(), Some("×10^{−6} + 1000.0001"));
    let negative = linear(-1000.0002, -1000.0001, 6);
    assert_eq!(labels(&negative), ["0", "20", "40", "60", "80", "100"]);
    assert_eq!(negative.common.as_deref(), Some("×10^{−6} − 1000.0002"));
    let around = linear(1e6 - 1.1e-3, 1e6 + 1.1e-3, 5);
    assert_eq!(
        labels(&around),
        ["−0.0010", "−0.0005", "0", "0.0005", "0.0010"]
    );
    assert_eq!(around.common.as_deref(), Some("+ 10^{6}"));
}

#[test]
fn linear_ticks_lie_inside_and_number_two_to_most() {
    for most in 5..20 {
        for n in 1..400 {
            let low = f64::from(n % 37 - 18) * 0.173;
            let high = low + f64::from(n) * 0.0917;
            let ticks = linear(low, high, most).major;
            assert!((2..=most).contains(&ticks.len()), "{low} {high} {most}");
            assert!(ticks.iter().all(|t| low <= t.at && t.at <= high));
            assert!(ticks.windows(2).all(|t| t[0].at < t[1].at));
        }
    }
}

#[test]
fn log_ticks_fall_on_decades() {
    let few = logarithmic(1e-2, 1e2, 9);
    assert_eq!(labels(&few), ["0.01", "0.1", "1", "10", "100"]);
    assert_eq!(few.minor.len(), 4 * 8);
    let many = logarithmic(1e-14, 1e-2, 8);
    assert_eq!(labels(&many)[0], "10^{−14}");
    assert!(many.major.len() <= 8);
    let one = logarithmic(0.15, 1.4, 8);
    assert_eq!(labels(&one), ["0.2", "0.5", "1"]);
    let none = logarithmic(1.01, 1.05, 6);
    assert_eq!(labels(&none), ["1.01", "1.02", "1.03", "1.04", "1.05"]);
    let whole = logarithmic(5e-324, f64::MAX, 6);
    assert!((2..=6).contains(&whole.major.len()));
}

#[test]
fn numbers_are_written_as_label_markup() {
    assert_eq!(number(25, -2), "0.25");
    assert_eq!(number(-120, 0), "−120");
    assert_eq!(number(2, -5), "2×10^{−5}");
    assert_eq!(number(1000, 5), "10^{8}");
    assert_eq!(number(12345, 15), "1.2345×10^{19}");
}

fn runs(markup: &str) -> Vec<(Level, String)> {
    let label = Label::parse(markup);
    label.runs.into_iter().map(|r| (r.level, r.text)).collect()
}

#[test]
fn label_markup_lowers_and_raises() {
    use Level::{Line, Sub, Super};
    let own = |level: Level, text: &str| (level, text.to_string());
    assert_eq!(runs("θ_d"), [own(Line, "θ"), own(Sub, "d")]);
    assert_eq!(
        runs("f_+ in 10^{−3} Hz"),
        [
            own(Line, "f"),
            own(Sub, "+"),
            own(Line, " in 10"),
            own(Super, "−3"),
            own(Line, " Hz"),
        ]
    );
    assert_eq!(runs(r"a\_b"), [own(Line, "a_b")]);
    for literal in ["a_", "a_{b", "a ^ b", r"\", r"\n"] {
        assert_eq!(runs(literal), [own(Line, literal)]);
    }
    assert_eq!(runs("a\nb\u{0}"), [own(Line, "a b ")]);
    assert_eq!(Label::parse("10^{−3} W_K").plain(), "10−3 WK");
}

#[test]
fn wrapped_lines_keep_every_word_and_the_width() -> Failure {
    let font = Font::embedded()?;
    let text = "words with θ_{sub script} and anunbreakablewordofgreatlength end";
    let label = Label::parse(text);
    for width in [60.0, 120.0, 1000.0] {
        let lines = label.wrap(&font, 13.0, width);
        assert!(lines.iter().all(|line| line.width(&font, 13.0) <= width));
        let squeeze = |text: String| text.replace(' ', "");
        let joined = lines.iter().map(Label::plain).collect::<String>();
        assert_eq!(squeeze(joined), squeeze(label.plain()));
    }
    assert_eq!(label.wrap(&font, 13.0, 1000.0), [label]);
    Ok(())
}

#[test]
fn the_font_has_what_labels_need() -> Failure {
    let font = Font::embedded()?;
    let missing = font.advance('\u{4e00}');
    for character in "θωαΔΣ°±−·×→²³₀₊ħ√∞≈≤ÅéЖ".chars() {
        let mut count = Count(0);
        let text = character.to_string();
        font.outline(&text, (0.0, 0.0), 12.0, &mut count);
        let mut hollow = Count(0);
        font.outline("\u{4e00}", (0.0, 0.0), 12.0, &mut hollow);
        let is_box = font.advance(character) == missing && count.0 == hollow.0;
        assert!(count.0 > 0 && !is_box, "{character}");
    }
    Ok(())
}

/// Counts the corners of outlines.
struct Count(usize);

impl Outline for Count {
    fn move_to(&mut self, _: f32, _: f32) {
        self.0 += 1;
    }
    fn line_to(&mut self, _: f32, _: f32) {
        self.0 += 1;
    }
    fn quad_to(&mut self, _: f32, _: f32, _: f32, _: f32) {
        self.0 += 1;
    }
    fn cubic_to(&mut self, _: f32, _: f32, _: f32, _: f32, _: f32, _: f32) {
        self.0 += 1;
    }
    fn close(&mut self) {}
}

#[test]
fn decimation_keeps_ends_extremes_and_gaps() {
    let wave = |i: usize| (i as f64 * 0.001, (i as f64 * 0.37).sin());
    let mut points: Vec<_> = (0..100_000).map(|i| Some(wave(i))).collect();
    points[50_500] = Some((50.5, 7.0));
    points[70_000] = None;
    let lines = decimate::lines(points.into_iter());
    assert_eq!(lines.len(), 2);
    assert_eq!(lines[0].first(), Some(&wave(0)));
    assert_eq!(lines[1].last(), Some(&wave(99_999)));
    assert!(lines[0].contains(&(50.5, 7.0)));
    assert!(lines.iter().all(|l| l.windows(2).all(|p| p[0].0 < p[1].0)));
    assert!(lines.iter().map(Vec::len).sum::<usize>() <= 4 * 101);
    let sparse = [(0.0, 1.0), (5.0, -1.0), (2.0, 3.0)];
    let same = decimate::lines(sparse.iter().copied().map(Some));
    assert_eq!(same, [sparse.to_vec()]);
}

#[test]
fn lines_are_cut_at_the_frame() {
    let area = Rect {
        left: 0.0,
        top: 0.0,
        right: 10.0,
        bottom: 10.0,
    };
    let tent = [(0.0, 5.0), (10.0, 15.0), (10.0, 5.0)];
    let parts = clip::line(&tent, &area);
    assert_eq!(
        parts,
        [
            vec![(0.0, 5.0), (5.0, 10.0)],
            vec![(10.0, 10.0), (10.0, 5.0)]
        ]
    );
    assert!(clip::line(&[(-5.0, -5.0), (15.0, -1.0)], &area).is_empty());
    let far = clip::line(&[(5.0, 5.0), (5.0, f64::INFINITY)], &area);
    assert_eq!(far, [vec![(5.0, 5.0), (5.0, 10.0)]]);
}

#[test]
fn a_verbatim_label_shows_any_text_as_it_stands() {
    for text in ["left_arm", "x^2", r"a\_b", "{θ_d}", "plain", "_^{}\\"] {
        let label = Label::parse(&verbatim(text));
        assert_eq!(label.plain(), text);
        assert!(
            label.runs.iter().all(|run| run.level == Level::Line),
            "{text}"
        );
    }
}
