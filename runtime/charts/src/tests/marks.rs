//! Error bars, marks of values beyond a range, whole numbers, and prefixes of units.

use crate::arrange::{PanelPlan, arrange};
use crate::drawing::{Drawing, Mark, Point};
use crate::font::Font;
use crate::scale::Scale;
use crate::ticks::labelled;
use crate::{Axis, Chart, ChartError, Color, Panel, Series, compose};

type Failure = Result<(), Box<dyn std::error::Error>>;

const RED: Color = Color::rgb(200, 10, 10);

/// The only panel of a chart with the marks of the series in red.
fn red(chart: &Chart) -> Result<(PanelPlan, Vec<Mark>), ChartError> {
    let mut plan = arrange(chart, &Font::embedded()?)?;
    let Drawing { marks, .. } = compose::draw(chart, &plan);
    let own = marks.into_iter().filter(|mark| match mark {
        Mark::Lines { color, .. } | Mark::Symbols { color, .. } | Mark::Areas { color, .. } => {
            *color == RED
        }
        Mark::Text(_) => false,
    });
    Ok((plan.panels.remove(0), own.collect()))
}

fn lines(marks: &[Mark]) -> Vec<&Vec<Point>> {
    let lines = marks.iter().filter_map(|mark| match mark {
        Mark::Lines { lines, .. } => Some(lines),
        Mark::Symbols { .. } | Mark::Areas { .. } | Mark::Text(_) => None,
    });
    lines.flatten().collect()
}

fn symbols(marks: &[Mark]) -> Vec<Point> {
    let symbols = marks.iter().filter_map(|mark| match mark {
        Mark::Symbols { at, .. } => Some(at),
        Mark::Lines { .. } | Mark::Areas { .. } | Mark::Text(_) => None,
    });
    symbols.flatten().copied().collect()
}

#[test]
fn every_sample_has_its_error_bar_in_view() -> Failure {
    let (x, y) = ([0.0, 1.0, 2.0], [-1.0, 40.0, 3.0]);
    let errors = [6.8, 0.5, f64::NAN];
    let series = Series::points("", &x, &y).errors(&errors).color(RED);
    let chart =
        Chart::new("", Axis::linear("x")).panel(Panel::new(Axis::linear("y")).series(series));
    let (panel, marks) = red(&chart)?;
    assert!(panel.scale.low <= -7.8 && panel.scale.high >= 40.5);
    let value = |at: f64| {
        let part = (panel.frame.bottom - at) / panel.frame.height();
        panel.scale.low + part * (panel.scale.high - panel.scale.low)
    };
    let bars = lines(&marks);
    let bars: Vec<[f64; 2]> = bars
        .iter()
        .filter(|line| line[0].0 == line[1].0)
        .map(|line| [value(line[0].1), value(line[1].1)])
        .collect();
    assert_eq!(bars.len(), 2, "none without an error");
    for ([low, high], [expected_low, expected_high]) in bars.iter().zip([[-7.8, 5.8], [39.5, 40.5]])
    {
        assert!((low - expected_low).abs() < 1e-9 && (high - expected_high).abs() < 1e-9);
    }
    let short = Series::points("a", &x, &y).errors(&errors[1..]);
    let short =
        Chart::new("", Axis::linear("x")).panel(Panel::new(Axis::linear("y")).series(short));
    let error = short.to_svg();
    assert!(matches!(
        error,
        Err(ChartError::LengthMismatch { x: 3, y: 2, .. })
    ));
    Ok(())
}

#[test]
fn a_bar_that_reaches_zero_goes_to_the_end_of_a_logarithmic_axis() -> Failure {
    let series = Series::points("", &[1.0, 2.0], &[1e-3, 1.0]).errors(&[2e-3, 0.1]);
    let axis = Axis::log("y").range(1e-4, 10.0);
    let chart = Chart::new("", Axis::linear("x")).panel(Panel::new(axis).series(series.color(RED)));
    let (panel, marks) = red(&chart)?;
    let bars = lines(&marks);
    assert_eq!(bars[0][0].1, panel.frame.bottom);
    assert!(
        bars.iter()
            .flat_map(|line| line.iter())
            .all(|point| point.1 <= panel.frame.bottom)
    );
    Ok(())
}

#[test]
fn what_leaves_a_range_is_marked_on_the_edge() -> Failure {
    let x: Vec<f64> = (0..10).map(f64::from).collect();
    let y = [
        1.0,
        1e7,
        f64::INFINITY,
        2.0,
        f64::NAN,
        1e-3,
        3.0,
        1e9,
        f64::NAN,
        1e9,
    ];
    let axis = Axis::log("G").range(0.8, 1e6);
    let series = Series::line("", &x, &y).color(RED);
    let chart = |series: Series| {
        Chart::new("", Axis::linear("x")).panel(Panel::new(axis.clone()).series(series))
    };
    let (_, plain) = red(&chart(series.clone()))?;
    let (panel, marks) = red(&chart(series.mark_beyond()))?;
    let known = symbols(&plain);
    let own: Vec<Point> = symbols(&marks)
        .into_iter()
        .filter(|point| !known.contains(point))
        .collect();
    let step = panel.frame.width() / 9.0;
    let place = |point: &Point| {
        (
            (point.0 - panel.frame.left) / step,
            point.1 < panel.frame.top + 20.0,
        )
    };
    let mut places: Vec<(f64, bool)> = own.iter().map(place).collect();
    places.sort_by(|one, other| one.0.total_cmp(&other.0));
    let expected = [(1.5, true), (5.0, false), (7.0, true), (9.0, true)];
    assert_eq!(places.len(), expected.len(), "{places:?}");
    for ((at, above), (expected, is_above)) in places.iter().zip(expected) {
        assert!(
            (at - expected).abs() < 1e-9 && *above == is_above,
            "{places:?}"
        );
    }
    assert!(own.iter().all(|point| panel.frame.contains(*point)));
    Ok(())
}

#[test]
fn axes_of_indices_have_whole_numbers() {
    let scale = |low: f64, high: f64| Scale {
        log: false,
        low,
        high,
    };
    for (low, high, expected) in [
        (-0.03, 1.03, vec!["0", "1"]),
        (0.0, 4.0, vec!["0", "1", "2", "3", "4"]),
        (-0.2, 0.2, vec!["0"]),
    ] {
        let (ticks, _) = labelled(&Axis::linear("generation").whole(), &scale(low, high), 9);
        let labels: Vec<&str> = ticks.major.iter().map(|tick| tick.label.as_str()).collect();
        assert_eq!(labels, expected);
    }
    let (ticks, _) = labelled(&Axis::linear("generation").whole(), &scale(0.0, 60.0), 9);
    assert_eq!(ticks.major.len(), 7);
}

#[test]
fn units_have_the_prefix_of_what_ticks_share() {
    let label = |label: &str, high: f64| {
        let scale = Scale {
            log: false,
            low: 0.0,
            high,
        };
        let (ticks, label) = labelled(&Axis::linear(label), &scale, 6);
        (label, ticks.common)
    };
    assert_eq!(
        label("closure (J)", 3e-7),
        ("closure (nJ)".to_owned(), None)
    );
    assert_eq!(label("W (W)", 3e-5), ("W (µW)".to_owned(), None));
    assert_eq!(label("θ_d (rad)", 4e-12), ("θ_d (prad)".to_owned(), None));
    assert_eq!(label("f (Hz)", 4e6), ("f (MHz)".to_owned(), None));
    assert_eq!(label("energy (J)", 0.3), ("energy (J)".to_owned(), None));
    // Units that have no prefix, or have one, keep the power of ten.
    for own in [
        "t (s)",
        "rate (1/s)",
        "energy (mJ)",
        "growth",
        "residuals (mrad)",
    ] {
        let (kept, common) = label(own, 3e6);
        assert_eq!(
            (kept.as_str(), common.as_deref()),
            (own, Some("×10^{6}")),
            "{own}"
        );
    }
    let offset = Scale {
        log: false,
        low: 1000.0001,
        high: 1000.0002,
    };
    let (ticks, kept) = labelled(&Axis::linear("energy (J)"), &offset, 6);
    assert_eq!(kept, "energy (J)");
    assert!(ticks.common.is_some());
}
