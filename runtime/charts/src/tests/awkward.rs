//! Charts that are hard to lay out.

use crate::{Axis, Chart, Panel, Series};

/// All of them, by name.
pub(super) fn awkward() -> Vec<(&'static str, Chart)> {
    let n = 50;
    let ramp = |low: f64, high: f64| -> Vec<f64> {
        let step = (high - low) / f64::from(n);
        (0..=n).map(|i| low + step * f64::from(i)).collect()
    };
    let (t, y) = (ramp(0.0, 20.0), ramp(-3.0, 5.0));
    let chart = || Chart::new("Title", Axis::linear("t (s)"));
    let panel = || Panel::new(Axis::linear("θ_d (rad)"));
    let long = "a very long text with θ_{sub} that goes on ".repeat(5);
    let many = (0..40).fold(panel(), |p, k| p.line(format!("series {k}"), &t, &y));
    let marked = (0..12).fold(panel().line("", &t, &y), |p, k| {
        p.vertical(0.4 * f64::from(k), format!("f_{{{k}}} = {k}.123 Hz"))
    });
    let log_log = Panel::new(Axis::log("Error")).line("a", &ramp(1e-3, 1e4), &ramp(1e-15, 1.0));
    let (cell_x, cell_y): (Vec<f64>, Vec<f64>) = (0..20)
        .map(|k| (10.0_f64.powi(k % 5 - 3), f64::from(k / 5)))
        .unzip();
    let values: Vec<f64> = (0..20).map(|k| 10.0_f64.powi(k % 7 - 3)).collect();
    vec![
        (
            "shaded",
            chart()
                .colors(Axis::log("growth rate (1/s)").range(0.01, 5.0))
                .panel(
                    panel()
                        .series(Series::shaded(&cell_x, &cell_y, &values))
                        .line("a", &t, &y),
                )
                .panel(panel().series(Series::shaded(&cell_x, &cell_y, &values))),
        ),
        ("plain", chart().panel(panel().line("a", &t, &y))),
        (
            "error bars, and values beyond the range",
            Chart::new("Title", Axis::linear("generation").whole()).panel(
                Panel::new(Axis::log("G").range(0.8, 1e6))
                    .series(Series::points("a", &t, &y).errors(&y).small())
                    .series(Series::line("b", &t, &ramp(1.0, 1e9)).mark_beyond()),
            ),
        ),
        (
            "long",
            Chart::new(&*long, Axis::linear(&*long)).panel(panel().line(&*long, &t, &y)),
        ),
        (
            "long y",
            chart().panel(Panel::new(Axis::linear(&*long)).line("", &t, &y)),
        ),
        (
            "unbreakable",
            Chart::new("x".repeat(300), Axis::linear("")).panel(panel().line(
                "y".repeat(300),
                &t,
                &y,
            )),
        ),
        ("many", chart().panel(many)),
        ("marked", chart().panel(marked.vertical(3.0, &*long))),
        (
            "tiny values",
            chart().panel(
                panel()
                    .line("a", &t, &ramp(-1e-12, 2e-12))
                    .vertical(0.0, "f_+"),
            ),
        ),
        (
            "offset",
            Chart::new("", Axis::linear(long.split_at(60).0)).panel(panel().line(
                "a",
                &ramp(1000.0001, 1000.0002),
                &ramp(-1000.0002, -1000.0001),
            )),
        ),
        (
            "offset beside label",
            Chart::new("", Axis::linear("t (s)")).panel(panel().line(
                "a",
                &ramp(1e9, 1e9 + 1.0),
                &y,
            )),
        ),
        (
            "small",
            chart()
                .size(320.0, 200.0)
                .panel(panel().line("a", &t, &y))
                .panel(panel().line("b", &t, &y)),
        ),
        ("log", Chart::new("", Axis::log("Time (s)")).panel(log_log)),
        (
            "constant",
            chart().panel(panel().line("a", &t, &vec![1e5; t.len()])),
        ),
        (
            "one sample",
            chart().panel(panel().line("a", &[1e-30], &[-1e30])),
        ),
        (
            "huge",
            chart().panel(panel().line("a", &t, &ramp(-1e289, 1e289))),
        ),
        (
            "crowded x",
            Chart::new("", Axis::linear("t (s)"))
                .size(320.0, 240.0)
                .panel(panel().line("series", &ramp(-0.002, -0.00198), &y)),
        ),
        (
            "wide last label",
            Chart::new("", Axis::linear("N (1)")).panel(panel().line("", &ramp(0.0, 60000.0), &y)),
        ),
        (
            "offset above label",
            Chart::new("", Axis::linear(long.split_at(60).0))
                .size(500.0, 300.0)
                .panel(panel().line("", &ramp(1e9, 1e9 + 1.0), &y)),
        ),
        (
            "panels",
            (0..6).fold(chart(), |c, k| {
                c.panel(panel().line(format!("p{k}"), &t, &y))
            }),
        ),
        (
            "columns",
            (0..5).fold(chart().columns(2).size(900.0, 700.0), |chart, k| {
                let low = ramp(-4.0 - f64::from(k), 3.0);
                let panel = panel().band("interval", &t, &low, &y);
                chart.panel(panel.line(format!("line {k}"), &t, &y).vertical(3.0, "f_+"))
            }),
        ),
        (
            "named",
            (0..4).fold(chart().columns(2), |chart, k| {
                let low = ramp(-1e-12, f64::from(k) * 1e-12);
                let panel = panel().name(if k == 2 { &*long } else { "θ_1(0) = 47.8°" });
                chart.panel(panel.line("", &t, &low).vertical(1.0, "f_+"))
            }),
        ),
        (
            "named in a column",
            chart()
                .size(320.0, 200.0)
                .panel(panel().name(&*long).line("", &t, &y).vertical(0.0, "f_+")),
        ),
        (
            "heatmap",
            Chart::new("", Axis::log("amplitude (rad)")).panel(panel().heatmap(
                &cell_x,
                &cell_y,
                &values,
                &[0.01, 1.0, 100.0],
            )),
        ),
    ]
}
