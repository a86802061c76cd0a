//! Figures for a paper: their sizes, the PDF, and colours that all eyes and grey print tell apart.

use crate::{Axis, Chart, Color, Panel};

type Failure = Result<(), Box<dyn std::error::Error>>;

fn chart() -> Chart {
    let x: Vec<f64> = (0..200).map(|sample| 0.05 * f64::from(sample)).collect();
    let sine: Vec<f64> = x.iter().map(|x| x.sin()).collect();
    let [low, high] = [-0.2, 0.2].map(|side| sine.iter().map(|y| y + side).collect::<Vec<_>>());
    let dot = Panel::new(Axis::linear("\u{3b8}\u{307}_{d} (rad/s)"));
    Chart::new("Two panels, with a band", Axis::linear("t (s)"))
        .panel(
            dot.band("95 %", &x, &low, &high)
                .line("estimated", &x, &sine)
                .zero_line(),
        )
        .panel(Panel::new(Axis::linear("H_d (J)")).points("H_d", &x, &high))
}

/// The number behind a word of a file that is text there.
fn numbers(pdf: &[u8], word: &str) -> Vec<f64> {
    let text = String::from_utf8_lossy(pdf);
    let rest = text.split_once(word).map_or("", |(_, rest)| rest);
    let inside = rest.trim_start_matches([' ', '[']);
    let inside = inside.split([']', '/', '>']).next().unwrap_or("");
    inside
        .split_whitespace()
        .filter_map(|number| number.parse().ok())
        .collect()
}

#[test]
fn a_figure_has_its_width_in_all_formats() -> Failure {
    let figure = chart().figure(85.0);
    let svg = figure.to_svg()?;
    assert!(svg.contains("width=\"85mm\""), "{svg:.300}");
    let pdf = figure.to_pdf()?;
    let sides = numbers(&pdf, "/MediaBox");
    assert!((sides[2] - 85.0 / 25.4 * 72.0).abs() < 1e-3, "{sides:?}");
    let png = figure.to_png()?;
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info()?;
    let info = reader.info();
    let dims = info.pixel_dims.ok_or("no size of pixels")?;
    let width = 1e3 * f64::from(info.width) / f64::from(dims.xppu);
    assert!((width - 85.0).abs() < 0.05, "{width}");
    assert!((f64::from(dims.xppu) * 0.0254 - 600.0).abs() < 0.1);
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("no size")?];
    reader.next_frame(&mut pixels)?;
    // Type is 7 points high at ticks whatever the width.
    let size = |width: f64| -> Result<f64, Box<dyn std::error::Error>> {
        let svg = chart().figure(width).to_svg()?;
        let view = svg.split_once("viewBox=\"0 0 ").ok_or("no view")?.1;
        let px: f64 = view.split(' ').next().ok_or("no width")?.parse()?;
        assert!(svg.contains("font-size=\"12\""));
        Ok(12.0 * width / px * 72.0 / 25.4)
    };
    for width in [70.0, 85.0, 180.0] {
        assert!((size(width)? - 7.0).abs() < 1e-3);
    }
    // Too narrow to be read.
    assert!(chart().figure(60.0).to_pdf().is_err());
    Ok(())
}

#[test]
fn a_pdf_is_whole_and_holds_text() -> Failure {
    let pdf = chart().to_pdf()?;
    assert_eq!(pdf, chart().to_pdf()?);
    assert!(pdf.starts_with(b"%PDF-1.7") && pdf.ends_with(b"%%EOF"));
    assert_eq!(numbers(&pdf, "/MediaBox")[2..], [675.0, 420.0]);
    let text = String::from_utf8_lossy(&pdf);
    for part in ["/FontFile2", "/ToUnicode", "/Identity-H", "/Title"] {
        assert!(text.contains(part), "{part}");
    }
    // Theta, and the dot that lies on it.
    assert!(text.contains("<03B8>") && text.contains("<0307>"));
    for (_, awkward) in super::awkward::awkward() {
        let pdf = awkward.to_pdf()?;
        assert!(!String::from_utf8_lossy(&pdf).contains("NaN"));
    }
    Ok(())
}

/// Lightness and the two opponent colours (CIE 1976), as they are or without the green cones
/// (G. M. Machado, M. M. Oliveira and L. A. F. Fernandes, IEEE TVCG 15 (2009) 1291).
fn seen(color: Color, without_green: bool) -> [f64; 3] {
    const MISSING: [[f64; 3]; 3] = [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ];
    const XYZ: [[f64; 3]; 3] = [
        [0.4124 / 0.9505, 0.3576 / 0.9505, 0.1805 / 0.9505],
        [0.2126, 0.7152, 0.0722],
        [0.0193 / 1.089, 0.1192 / 1.089, 0.9505 / 1.089],
    ];
    let times = |rows: [[f64; 3]; 3], v: [f64; 3]| {
        rows.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum::<f64>())
    };
    let mut linear = [color.red, color.green, color.blue].map(|part| {
        let part = f64::from(part) / 255.0;
        match part <= 0.04045 {
            true => part / 12.92,
            false => ((part + 0.055) / 1.055).powf(2.4),
        }
    });
    if without_green {
        linear = times(MISSING, linear).map(|part| part.clamp(0.0, 1.0));
    }
    let [x, y, z] = times(XYZ, linear).map(|part| match part > 0.008856 {
        true => part.cbrt(),
        false => 7.787 * part + 16.0 / 116.0,
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[test]
fn colours_of_series_are_apart_in_grey_and_without_green_cones() {
    let pairs = |count: usize| (0..count).flat_map(move |a| (0..a).map(move |b| (a, b)));
    let least = |count: usize, apart: &dyn Fn(usize, usize) -> f64| {
        pairs(count)
            .map(|(a, b)| apart(a, b))
            .fold(f64::INFINITY, f64::min)
    };
    let grey = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|index| seen(Color::of_series(index), false)[0]);
        (a - b).abs()
    };
    let without_green = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|index| seen(Color::of_series(index), true));
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - b).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    assert!(least(4, &grey) > 16.0 && least(7, &grey) > 9.0);
    assert!(least(4, &without_green) > 34.0 && least(7, &without_green) > 23.0);
    // None is too pale on white.
    assert!((0..7).all(|index| seen(Color::of_series(index), false)[0] < 80.0));
}
