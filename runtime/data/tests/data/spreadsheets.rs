//! Sheets of workbooks: written by openpyxl and odfpy, read as the same numbers in text are.

use branched_pendulum_data::{
    AngleColumns, DecimalMark, Delimiter, Markers, Recording, Table, TableOptions, read_angles,
};

use super::findings::reported;

fn path(name: &str) -> String {
    format!("{}/tests/data/sheets/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn options(sheet: &str) -> TableOptions {
    TableOptions {
        sheet: Some(sheet.to_owned()),
        ..TableOptions::default()
    }
}

fn angles(name: &str, options: &TableOptions) -> Result<Recording, String> {
    let table = Table::read(path(name), options).map_err(|error| error.to_string())?;
    let read = read_angles(&table, &AngleColumns::default(), &Markers::default());
    read.map_err(|error| error.to_string())
}

/// The message of a refusal, without the folder of the file.
fn refusal(name: &str, options: &TableOptions) -> String {
    let message = angles(name, options).unwrap_err();
    message.rsplit_once('/').unwrap().1.to_owned()
}

#[test]
fn sheets_with_notes_titles_and_gaps_are_read() {
    for (name, sheets) in [
        ("swing.xlsx", ", the first of 3 with numbers"),
        ("swing.ods", ""),
    ] {
        let recording = angles(name, &TableOptions::default()).unwrap();
        assert_eq!(recording.times.len(), 60, "{name}");
        let upper = &recording.links[0];
        let lower = &recording.links[1];
        for (row, time) in recording.times.iter().enumerate() {
            assert!((time - row as f64 / 60.0).abs() < 1e-12);
            let expected = (10.0 * (5.0 * time).cos()).to_radians();
            assert!((upper.angle(row).unwrap() - expected).abs() < 1e-12);
        }
        assert_eq!(lower.angle(7), None);
        let sheet = format!("sheet `Angles` of a spreadsheet{sheets}");
        assert!(reported(&recording, &sheet), "{:?}", recording.findings);
        assert!(
            !reported(&recording, "tabs between"),
            "{:?}",
            recording.findings
        );
    }
    let second = angles("swing.xlsx", &options("Second")).unwrap();
    let angle = second.links[1].angle(0).unwrap();
    assert!((angle - 2.0_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn merged_names_of_points_and_decimal_commas_in_text() {
    let table = Table::read(path("tracked.xlsx"), &TableOptions::default()).unwrap();
    let from_pivot = Markers {
        pivot: Some([0.0, 0.0]),
        ..Markers::default()
    };
    let recording = read_angles(&table, &AngleColumns::default(), &from_pivot).unwrap();
    assert_eq!(recording.links.len(), 2);
    for (row, time) in recording.times.iter().enumerate() {
        let expected = [0.3 * (5.0 * time).cos(), -0.2 * (7.0 * time).cos()];
        for (link, expected) in recording.links.iter().zip(expected) {
            // Five decimals of a metre.
            assert!((link.angle(row).unwrap() - expected).abs() < 3e-5);
        }
    }
}

#[test]
fn durations_are_seconds_and_dates_are_refused_with_their_cell() {
    let recording = angles("dated.xlsx", &TableOptions::default()).unwrap();
    let last = recording.times.last().unwrap();
    assert!((last - 29.0 / 25.0).abs() < 1e-6, "{last}");
    assert_eq!(
        refusal("dated.xlsx", &options("Dates")),
        "dated.xlsx, sheet `Dates`, cell A2: `2026-03-12 10:00:00.000` is not a number (a \
         date; write the time in seconds)"
    );
}

#[test]
fn refusals_name_sheet_and_cell() {
    assert_eq!(
        refusal("faulty.xlsx", &TableOptions::default()),
        "faulty.xlsx, sheet `Run 1`, cell C5 (`upper`): `lost?` is not a number"
    );
    assert_eq!(
        refusal("swing.xlsx", &options("angles")),
        "swing.xlsx: there is no sheet `angles` (did you mean `Angles`?); there are: Notes, \
         Angles, Second"
    );
    let separated = TableOptions {
        delimiter: Some(Delimiter::Comma),
        ..TableOptions::default()
    };
    assert_eq!(
        refusal("swing.xlsx", &separated),
        "swing.xlsx: is a spreadsheet, which has no separator of cells; leave the separator out"
    );
    let points = TableOptions {
        decimal: Some(DecimalMark::Point),
        ..TableOptions::default()
    };
    let message = refusal("tracked.xlsx", &points);
    assert!(message.contains("sheet `Tabelle1`, cell B3"), "{message}");
    assert!(message.contains("decimal commas"), "{message}");
    let text = std::env::temp_dir().join(format!("sheet-of-text-{}.csv", std::process::id()));
    std::fs::write(&text, "t [s],a [deg]\n0,1\n1,2\n").unwrap();
    let error = Table::read(&text, &options("Run 1"))
        .unwrap_err()
        .to_string();
    std::fs::remove_file(&text).unwrap();
    assert!(
        error.ends_with("is a file of text, which has no sheets; leave the sheet out"),
        "{error}"
    );
}
