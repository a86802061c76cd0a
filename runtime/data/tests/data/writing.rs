//! CSV files read back as they were meant.

use std::error::Error;
use std::path::PathBuf;

use branched_pendulum_data::{Column, CsvError, CsvWriter};

fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("branched-pendulum-{}-{name}", std::process::id()))
}

#[test]
fn numbers_read_back_bit_for_bit() {
    let path = scratch("numbers.csv");
    let values = [
        0.1,
        -1.0 / 3.0,
        f64::MIN_POSITIVE,
        f64::MAX,
        1e-300,
        -0.0,
        12345678.9,
    ];
    let columns: Vec<Column> = (0..7).map(|i| Column::new(format!("x{i}"), "")).collect();
    let mut csv = CsvWriter::create(&path, &columns).unwrap();
    csv.row(values).unwrap();
    assert_eq!(csv.rows(), 1);
    csv.finish().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x0,x1,x2,x3,x4,x5,x6"));
    let row = lines.next().unwrap();
    assert!(row.len() < 120, "no row of zeros: {row}");
    let read: Vec<u64> = row
        .split(',')
        .map(|x| x.parse::<f64>().unwrap().to_bits())
        .collect();
    assert_eq!(read, values.map(f64::to_bits));
    assert_eq!(lines.next(), None);
}

#[test]
fn header_and_values_that_need_care() {
    let path = scratch("header.csv");
    let columns = [Column::new("W, \"exact\"", "W"), Column::new("θ_m", "rad")];
    let mut csv = CsvWriter::create(&path, &columns).unwrap();
    csv.row([f64::NAN, f64::NEG_INFINITY]).unwrap();
    assert_eq!(csv.empty_cells(), 2);
    csv.finish().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert_eq!(text, "\"W, \"\"exact\"\" [W]\",θ_m [rad]\n,\n");
}

#[test]
fn refusals_name_the_file() {
    let path = scratch("refusals.csv");
    let error = CsvWriter::create(&path, &[]).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("the table for {} has no columns", path.display())
    );
    assert!(!path.exists());

    let mut csv = CsvWriter::create(&path, &[Column::new("a", "m")]).unwrap();
    csv.row([1.0]).unwrap();
    let error = csv.row([1.0, 2.0]).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "row 1 of {} has 2 values, but the table has 1 columns",
            path.display()
        )
    );
    csv.finish().unwrap();
    std::fs::remove_file(&path).unwrap();

    let nowhere = scratch("no-such-folder").join("file.csv");
    let error = CsvWriter::create(&nowhere, &[Column::new("a", "m")]).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("cannot create {}", nowhere.display())
    );
    assert!(matches!(
        &error,
        CsvError::Io {
            action: "create",
            ..
        }
    ));
    assert!(error.source().is_some());
}
