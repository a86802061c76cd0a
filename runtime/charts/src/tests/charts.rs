use super::awkward::awkward;
use crate::arrange::arrange;
use crate::drawing::{Drawing, Mark, Text};
use crate::font::Font;
use crate::{Axis, Chart, ChartError, Panel, compose, style};

type Failure = Result<(), Box<dyn std::error::Error>>;

/// Left, top, right and bottom edge of a text in px.
fn edges(text: &Text, font: &Font) -> [f64; 4] {
    let width = text.label.width(font, text.size);
    let before = width * text.anchor.before();
    // What the font's capitals with accents and its descenders reach.
    let (up, down) = (0.93 * text.size, 0.24 * text.size);
    let (x, y) = text.at;
    if text.upwards {
        [x - up, y - width + before, x + down, y + before]
    } else {
        [x - before, y - up, x - before + width, y + down]
    }
}

fn draw(chart: &Chart) -> Result<(Drawing, Font), ChartError> {
    let font = Font::embedded()?;
    let drawing = compose::draw(chart, &arrange(chart, &font)?);
    Ok((drawing, font))
}

#[test]
fn all_text_lies_inside_the_canvas_and_apart() -> Failure {
    for (name, chart) in awkward() {
        let (drawing, font) = draw(&chart).map_err(|e| format!("{name}: {e}"))?;
        let texts: Vec<(String, [f64; 4])> = drawing
            .marks
            .iter()
            .filter_map(|mark| match mark {
                Mark::Text(text) => Some((text.label.plain(), edges(text, &font))),
                _ => None,
            })
            .collect();
        assert!(!texts.is_empty());
        for (text, [left, top, right, bottom]) in &texts {
            let inside = *left >= 0.0 && *right <= drawing.width;
            let inside = inside && *top >= 0.0 && *bottom <= drawing.height;
            assert!(inside, "{name}: `{text}` leaves the canvas");
        }
        for (index, (a, one)) in texts.iter().enumerate() {
            for (b, other) in &texts[index + 1..] {
                // Line boxes may touch by the room kept for accents.
                let apart = |i: usize, slack: f64| {
                    one[i + 2] <= other[i] + slack || other[i + 2] <= one[i] + slack
                };
                assert!(apart(0, 0.5) || apart(1, 3.0), "{name}: `{a}` on `{b}`");
            }
        }
    }
    Ok(())
}

#[test]
fn lines_stay_in_their_frames() -> Failure {
    let chart = Chart::new("", Axis::linear("t (s)").range(2.0, 3.0)).panel(
        Panel::new(Axis::linear("y (m)").range(-1.0, 1.0))
            .line("steep", &[0.0, 2.5, 4.0], &[-1e300, 0.0, 1e300])
            .points("out", &[1.0, 2.5], &[0.0, 5.0]),
    );
    let font = Font::embedded()?;
    let plan = arrange(&chart, &font)?;
    let frame = plan.panels.first().ok_or("no panel")?.frame;
    let drawing = compose::draw(&chart, &plan);
    let blue = style::automatic(0).0;
    let mut seen = 0;
    for mark in &drawing.marks {
        if let Mark::Lines { lines, color, .. } = mark {
            let data = lines.iter().flatten().filter(|(x, _)| *x < frame.right);
            for point in data.filter(|_| *color == blue) {
                assert!(frame.contains(*point), "{point:?}");
                seen += 1;
            }
        }
    }
    assert!(seen >= 2);
    Ok(())
}

#[test]
fn svg_and_png_are_complete_and_repeatable() -> Failure {
    for (name, chart) in awkward() {
        let svg = chart.to_svg()?;
        assert_eq!(svg, chart.to_svg()?, "{name}");
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    }
    let (_, chart) = awkward().swap_remove(0);
    let png = chart.to_png()?;
    assert_eq!(png, chart.to_png()?);
    let image = tiny_skia::Pixmap::decode_png(&png)?;
    assert_eq!((image.width(), image.height()), (1800, 1120));
    let escaped = Chart {
        title: "a < b & \"c\"".into(),
        ..chart
    }
    .to_svg()?;
    assert!(escaped.contains("<title>a &lt; b &amp; &quot;c&quot;</title>"));
    Ok(())
}

#[test]
fn gaps_break_lines_and_lone_samples_are_dots() -> Failure {
    let y = [0.0, 1.0, f64::NAN, 3.0, f64::INFINITY, 2.0, 1.0];
    let t = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let chart = Chart::new("", Axis::linear("t (s)"))
        .panel(Panel::new(Axis::linear("y (m)")).line("", &t, &y));
    let (drawing, _) = draw(&chart)?;
    let blue = style::automatic(0).0;
    let lines = drawing.marks.iter().find_map(|mark| match mark {
        Mark::Lines { lines, color, .. } if *color == blue => Some(lines.len()),
        _ => None,
    });
    let dots = drawing.marks.iter().find_map(|mark| match mark {
        Mark::Symbols { at, .. } => Some(at.len()),
        _ => None,
    });
    assert_eq!((lines, dots), (Some(2), Some(1)));
    Ok(())
}

#[test]
fn a_long_series_makes_a_small_file() -> Failure {
    let t: Vec<f64> = (0..100_000).map(|i| f64::from(i) * 1e-3).collect();
    let y: Vec<f64> = t.iter().map(|t| (60.0 * t).sin()).collect();
    let chart = Chart::new("", Axis::linear("t (s)"))
        .panel(Panel::new(Axis::linear("y (m)")).line("", &t, &y));
    assert!(chart.to_svg()?.len() < 60_000);
    Ok(())
}

#[test]
fn what_cannot_be_drawn_is_a_typed_error() {
    use ChartError::*;
    let chart = || Chart::new("", Axis::linear("t (s)"));
    let panel = || Panel::new(Axis::linear("y (m)"));
    let log = || Panel::new(Axis::log("y (m)"));
    let error = |chart: Chart| chart.to_svg().err();
    assert!(matches!(error(chart()), Some(Empty { panel: None })));
    assert!(matches!(
        error(chart().panel(panel())),
        Some(Empty { panel: Some(0) })
    ));
    let of = |panel: Panel| error(chart().panel(panel));
    let short = of(panel().line("a", &[1.0, 2.0], &[1.0]));
    assert!(matches!(short, Some(LengthMismatch { x: 2, y: 1, .. })));
    let empty = of(panel().line("a", &[], &[]));
    assert!(matches!(empty, Some(NothingToDraw { samples: 0, .. })));
    let nan = of(panel().line("a", &[1.0], &[f64::NAN]));
    assert!(matches!(nan, Some(NothingToDraw { samples: 1, .. })));
    let negative = of(log().line("a", &[1.0, 2.0], &[0.0, -1.0]));
    assert!(matches!(negative, Some(NothingToDraw { samples: 2, .. })));
    let zero = of(log().line("a", &[1.0], &[1.0]).zero_line());
    assert!(matches!(zero, Some(MarkerLine { .. })));
    let marker = of(panel().line("a", &[1.0], &[1.0]).vertical(f64::NAN, "f"));
    assert!(matches!(marker, Some(MarkerLine { .. })));
    let span = of(panel().line("a", &[1.0, 2.0], &[-f64::MAX, f64::MAX]));
    assert!(matches!(span, Some(Range { .. })));
    for (low, high) in [(1.0, 1.0), (2.0, 1.0), (0.0, f64::NAN), (1.0, 1.0 + 1e-15)] {
        let axis = Axis::linear("y (m)").range(low, high);
        let range = of(Panel::new(axis).line("a", &[1.0], &[1.0]));
        assert!(matches!(range, Some(Range { .. })), "{low} {high}");
    }
    let axis = Axis::log("y (m)").range(0.0, 1.0);
    let range = of(Panel::new(axis).line("a", &[1.0], &[1.0]));
    assert!(matches!(range, Some(Range { .. })));
    let good = || chart().panel(panel().line("a", &[1.0, 2.0], &[1.0, 2.0]));
    for side in [100.0, f64::NAN, 1e9] {
        assert!(matches!(error(good().size(side, 400.0)), Some(Size { .. })));
    }
    for scale in [0.0, -1.0, f64::NAN, 1e6] {
        let png = good().scale(scale).to_png();
        assert!(matches!(png, Err(Size { .. })), "{scale}");
    }
    let tall = Panel::new(Axis::linear("m ".repeat(2000))).line("a", &[1.0], &[1.0]);
    assert!(matches!(of(tall), Some(NoRoom { .. })));
    let nowhere = good().write_svg("/no-such-directory/chart.svg");
    assert!(nowhere.is_err_and(|e| e.to_string().contains("/no-such-directory/chart.svg")));
}

#[test]
fn equal_labels_share_style_and_entry() -> Failure {
    let (t, y) = ([0.0, 1.0], [0.0, 1.0]);
    let panel = || Panel::new(Axis::linear("y (m)")).line("W_K", &t, &y);
    let chart = Chart::new("", Axis::linear("t (s)"))
        .panel(panel())
        .panel(panel().line("W_P", &t, &y));
    let font = Font::embedded()?;
    let plan = arrange(&chart, &font)?;
    assert_eq!(plan.panels[0].styles[0], plan.panels[1].styles[0]);
    assert_ne!(plan.panels[1].styles[0], plan.panels[1].styles[1]);
    let entries: Vec<usize> = plan.legend.lists.iter().map(Vec::len).collect();
    assert_eq!(entries, [1, 1]);
    Ok(())
}

/// Polygons of the areas of a drawing.
fn polygons(drawing: &Drawing) -> Vec<&[(f64, f64)]> {
    let areas = drawing.marks.iter().filter_map(|mark| match mark {
        Mark::Areas { polygons, .. } => Some(polygons),
        _ => None,
    });
    areas.flatten().map(Vec::as_slice).collect()
}

/// Cells of a full grid cover their panel once, whatever class they are in.
#[test]
fn cells_fill_the_panel() -> Failure {
    let x: Vec<f64> = (0..12).map(|k| 10.0_f64.powi(k % 4)).collect();
    let y: Vec<f64> = (0..12).map(|k| f64::from(k / 4)).collect();
    let values: Vec<f64> = (0..12).map(f64::from).collect();
    let panel = Panel::new(Axis::linear("y").range(-0.5, 2.5));
    let chart = Chart::new("", Axis::log("x")).panel(panel.heatmap(&x, &y, &values, &[3.0, 8.0]));
    let font = Font::embedded()?;
    let plan = arrange(&chart, &font)?;
    let (drawing, _) = draw(&chart)?;
    let area = |polygon: &[(f64, f64)]| match polygon {
        [a, _, c, _] => ((c.0 - a.0) * (c.1 - a.1)).abs(),
        _ => f64::NAN,
    };
    let all = polygons(&drawing);
    // The samples of the legend, and the cells.
    let legend = 3;
    assert_eq!(all.len(), 12 + legend);
    let cells = all.iter().copied().filter(|polygon| {
        let frame = &plan.panels[0].frame;
        polygon.iter().all(|point| frame.contains(*point))
    });
    let covered: f64 = cells.map(area).sum();
    let frame = plan.panels[0].frame;
    let whole = frame.width() * frame.height();
    assert!((covered / whole - 1.0).abs() < 1e-9, "{covered} {whole}");
    let labels = chart.panels[0]
        .series
        .iter()
        .map(|series| series.label.as_str());
    assert_eq!(labels.collect::<Vec<_>>(), ["below 3", "3 to 8", "from 8"]);
    Ok(())
}

#[test]
fn a_band_has_a_piece_between_gaps_and_its_lower_edge_counts() -> Failure {
    let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    let (low, high) = ([-5.0, -5.0, f64::NAN, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0, 1.0]);
    let chart = Chart::new("", Axis::linear("x"))
        .panel(Panel::new(Axis::linear("y")).band("", &x, &low, &high));
    let (drawing, font) = draw(&chart)?;
    assert_eq!(polygons(&drawing).len(), 2);
    let plan = arrange(&chart, &font)?;
    assert!(plan.panels[0].scale.low <= -5.0 && plan.panels[0].scale.high >= 1.0);
    let short = Chart::new("", Axis::linear("x")).panel(Panel::new(Axis::linear("y")).band(
        "b",
        &x,
        &low[..4],
        &high,
    ));
    assert!(matches!(
        short.to_svg(),
        Err(ChartError::LengthMismatch { x: 5, y: 4, .. })
    ));
    Ok(())
}

#[test]
fn a_span_of_the_x_axis_is_shown_with_what_is_in_view() -> Failure {
    let (x, y) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 300.0]);
    let panel =
        Panel::new(Axis::linear("y"))
            .line("", &x, &y)
            .line("", &[f64::NAN, 4.0], &[1.0, 2.0]);
    let chart = Chart::new("", Axis::linear("t (s)")).panel(panel);
    assert_eq!(chart.x_extent(), Some((0.0, 4.0)));
    assert_eq!(Chart::new("", Axis::linear("")).x_extent(), None);
    let largest_tick = |chart: &Chart| -> Result<f64, ChartError> {
        let (drawing, _) = draw(chart)?;
        let numbers = drawing.marks.iter().filter_map(|mark| match mark {
            Mark::Text(text) => text.label.plain().parse().ok(),
            _ => None,
        });
        Ok(numbers.fold(0.0, f64::max))
    };
    assert!(largest_tick(&chart)? >= 250.0);
    let part = largest_tick(&chart.x_range(0.5, 2.5))?;
    assert!((2.0..=2.5).contains(&part), "{part}");
    Ok(())
}
