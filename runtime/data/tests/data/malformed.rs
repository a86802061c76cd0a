//! Files that are refused, with their places.

use branched_pendulum_data::{AngleColumns, Clock, LinkMarkers, Markers, Table, TableOptions};

use super::{Random, frames, swing, table};

#[test]
fn mutations_never_panic() {
    mutate(900);
}

/// `cargo test -p branched-pendulum-data 10000 -- --ignored`
#[test]
#[ignore = "half a minute"]
fn mutations_never_panic_10000() {
    mutate(10_000);
}

/// Mutations of good files are read or refused in words, and frames are never taken for
/// seconds.
fn mutate(rounds: usize) {
    let (times, [one, two]) = swing();
    let mut wide = "t [s];a [deg];b [deg]\n".to_owned();
    for ((time, one), two) in times.iter().zip(&one).zip(&two).take(30) {
        wide += &format!("{time};{one};{two}\n").replace('.', ",");
    }
    let camera: String = frames(|_| 1.0)
        .lines()
        .take(30)
        .map(|line| format!("{line}\n"))
        .collect();
    let tracker = "#multi:\n\tmass A\t\tmass B\t\t\nt\tx\ty\tx\ty\t\n0\t0\t0\t1\t-1\t\n0.1\t0\t0\t1\t-1\t\n0.2\t0\t0\t1\t-2\t\n";
    let pieces = [
        ",", ";", "\t", "\n", "", "nan", "1e999", "-", "\"", "0,5", "x", "é", "\u{0}", " ",
        "scorer", "coords", "frame", "9e-320",
    ];
    let mut random = Random::new(0);
    let mut random = |end: usize| random.below(end);
    let mut read = 0;
    for round in 0..rounds {
        let mut characters: Vec<char> = [wide.as_str(), camera.as_str(), tracker][round % 3]
            .chars()
            .collect();
        for _ in 0..=random(4) {
            let at = random(characters.len());
            let piece = pieces[random(pieces.len())].chars();
            let end = (at + random(3)).min(characters.len());
            characters.splice(at..end, piece);
        }
        let text: String = characters.into_iter().collect();
        let outcome = Table::parse("a.csv", &text, &TableOptions::default()).and_then(|table| {
            let markers = Markers {
                clock: Clock::FrameRate(60.0),
                ..Markers::default()
            };
            read += usize::from(markers.read(&table).is_ok());
            AngleColumns::default().read(&table)
        });
        match outcome {
            Ok(recording) => {
                read += 1;
                let is_whole = recording.times.iter().all(|time| time.fract() == 0.0);
                assert!(!is_whole, "{text}");
                let angles = recording
                    .links
                    .iter()
                    .flat_map(|link| (0..link.samples.len()).map(|i| link.angle(i)));
                assert!(angles.flatten().all(f64::is_finite));
            }
            Err(error) => assert!(error.to_string().starts_with("a.csv"), "{error}"),
        }
    }
    assert!(
        (rounds / 20..rounds - rounds / 20).contains(&read),
        "{read}"
    );
}

/// Each malformed file is refused where it is wrong, and says why.
#[test]
fn malformed_files_name_their_place() {
    let angles = AngleColumns::default();
    let whole = |name: &str| {
        format!(
            "a.csv: column `{name}` holds whole numbers and names no unit; give the frame rate, or \
             the name of the column with its unit, as in `{name} [ms]` (frames are never taken for \
             seconds)"
        )
    };
    let cases: [(&str, &str); 40] = [
        ("", "a.csv: is empty"),
        (" \n\n\t\n", "a.csv: is empty"),
        (
            "hello\nworld\n",
            "a.csv: has no row with numbers in at least two columns",
        ),
        (
            "1\n2\n3\n",
            "a.csv: has no row with numbers in at least two columns",
        ),
        (
            "t,a\n",
            "a.csv: has no row with numbers in at least two columns",
        ),
        (
            "t,a\n0.0,1\n",
            "a.csv: has 1 row of numbers; at least 3 rows are needed",
        ),
        (
            "t,a\n0.0,1\n0.1,x1\n0.2,3\n",
            "a.csv, line 3, column 2 (`a`): `x1` is not a number",
        ),
        (
            "t,a\n\n\n0.0,1\n0.1,1.234.5\n0.2,3\n",
            "a.csv, line 5, column 2 (`a`): `1.234.5` is not a number (are thousands separated?)",
        ),
        (
            "t;a\n0,0;1,5\n0,1;1.5\n0,2;1,5\n",
            "a.csv, line 3, column 2 (`a`): `1.5` is not a number (decimal points in a file of decimal commas?)",
        ),
        (
            "t;a\n0.0;1.5\n0.1;1,5\n0.2;1.5\n",
            "a.csv, line 3, column 2 (`a`): `1,5` is not a number (decimal commas in a file of decimal points?)",
        ),
        (
            "t,a\n0.0,1\n0.1,inf\n0.2,1\n",
            "a.csv, line 3, column 2 (`a`): `inf` is not finite; leave the cell of a missing value empty",
        ),
        (
            "t,a\n0.0,1\n0.1,1e999\n0.2,1\n",
            "a.csv, line 3, column 2 (`a`): `1e999` is not finite; leave the cell of a missing value empty",
        ),
        (
            "t,a\n0.0,1\n0.1\n0.2,1\n",
            "a.csv, line 3: the row has 1 cell, but the table has 2 columns",
        ),
        (
            "t,a\n0.0,1\n0.1,1,7\n0.2,1\n",
            "a.csv, line 3: the row has 3 cells, but the table has 2 columns",
        ),
        (
            "t,a,b\n0.0,1\n0.1,1\n0.2,1\n",
            "a.csv, line 1: 3 names above rows of 2 cells",
        ),
        (
            "t\n0.0,1\n0.1,1\n0.2,1\n",
            "a.csv, line 1: 1 names above rows of 2 cells",
        ),
        (
            "t,a,a\n0.0,1,1\n0.1,1,1\n0.2,1,1\n",
            "a.csv, line 1, column 3: two columns are called `a`",
        ),
        (
            "t,a\n0.0,1\n,1\n0.2,1\n",
            "a.csv, line 3, column 1 (`t`): the time is missing",
        ),
        (
            "t,a\n0.0,1\n0.2,1\n0.1,1\n",
            "a.csv, line 4, column 1 (`t`): time 0.1 s does not come after 0.2 s; correct this time, or remove the row",
        ),
        (
            "t,a\n0.0,1\n0.2,1\n0.2,1\n",
            "a.csv, line 4, column 1 (`t`): time 0.2 s does not come after 0.2 s; say which row of one time counts, the first or the last",
        ),
        ("t,a\n0,1\n1,1\n2,1\n", &whole("t")),
        // One frame lost, every second one, and a file without names.
        ("t,a\n0,1\n1,1\n3,1\n", &whole("t")),
        ("time;a\n100;1,5\n102;1,5\n104;1,5\n", &whole("time")),
        ("0,1\n1,1\n2,1\n", &whole("column 1")),
        (
            "frame,a\n0,1\n1,1\n2,1\n",
            "a.csv: column `frame` counts frames; give the frame rate (frames are never taken for seconds)",
        ),
        (
            "x,a\n0.0,1\n0.1,1\n0.2,1\n",
            "a.csv: found no column of times; name the column of the time, or give the frame rate",
        ),
        (
            "t [h],a\n0.0,1\n0.1,1\n0.2,1\n",
            "a.csv: column `t` is in `h`, which is not a unit of time",
        ),
        (
            "t,a [m]\n0.0,1\n0.1,1\n0.2,1\n",
            "a.csv: column `a` is in `m`, which is not a unit of an angle",
        ),
        (
            "t,a [deg],b [rad]\n0.0,1,1\n0.1,1,1\n0.2,1,1\n",
            "a.csv: columns of angles in degrees and in radians",
        ),
        (
            "t,a,b\n0.0,1,1\n0.1,-40,1\n0.2,1,1\n",
            "a.csv: column `a` names no unit, and its values, up to 40, may be degrees or radians; give the unit",
        ),
        (
            "t,frame\n0.0,1\n0.1,1\n0.2,1\n",
            "a.csv: no columns are left for angles",
        ),
        (
            "t,a [rad]\n0.0,1\n0.1,1e9\n0.2,1\n",
            "a.csv, line 3: an angle of `a` is 1000000000 rad; at most ±1e6 rad is accepted: check the \
             unit of the column",
        ),
        (
            "scorer,n,n\ncoords,x,y\n0,1,1\n1,1,1\n",
            "a.csv, line 1: DeepLabCut's header has no row `bodyparts`",
        ),
        (
            "scorer,n,n\nbodyparts,a,a\n0,1,1\n1,1,1\n",
            "a.csv, line 1: DeepLabCut's header has no row `coords`",
        ),
        (
            "scorer,n,n\nbodyparts,a\ncoords,x,y\n0,1,1\n1,1,1\n",
            "a.csv, line 2: 2 names above rows of 3 cells",
        ),
        (
            "scorer,n,n\nbodyparts,a,a\ncoords,x,x\n0,1,1\n1,1,1\n",
            "a.csv, line 3, column 3: two columns are called `a x`",
        ),
        (
            "t,a\n0.0,1\n0.1,\"1\n0.2,1\n",
            "a.csv, line 3, column 2 (`a`): `\"1…` is not a number (a quotation mark that is not closed?)",
        ),
        (
            "t,a\n0.0,1\nnan,1\n0.2,1\n",
            "a.csv, line 3, column 1 (`t`): the time is missing",
        ),
        (
            "t,a\n0.0,1\n0.1,0x1F\n0.2,1\n",
            "a.csv, line 3, column 2 (`a`): `0x1F` is not a number",
        ),
        (
            "t [s],a [rad]\n0.0,1\n1e400,1\n0.2,1\n",
            "a.csv, line 3, column 1 (`t`): `1e400` is not finite; leave the cell of a missing value empty",
        ),
    ];
    for (text, expected) in cases {
        let found =
            Table::parse("a.csv", text, &TableOptions::default()).and_then(|t| angles.read(&t));
        assert_eq!(
            found.map(|_| ()).unwrap_err().to_string(),
            expected,
            "{text:?}"
        );
    }
}

/// Requests for what is not there, and bytes that are no text.
#[test]
fn wrong_requests_name_what_there_is() {
    let table = table("t,upper,lower,p x,p y\n0.0,1,1,0,0\n0.1,1,1,0,0\n0.2,1,1,0,0\n");
    let refused = |columns: AngleColumns| columns.read(&table).unwrap_err().to_string();
    let named = |name: &str| AngleColumns {
        columns: vec![name.to_owned()],
        ..AngleColumns::default()
    };
    assert_eq!(
        refused(named("uper")),
        "swing.csv: there is no column `uper` (did you mean `upper`?); there are: t, upper, lower, p x, p y"
    );
    let rate = |rate| AngleColumns {
        clock: Clock::FrameRate(rate),
        ..named("upper")
    };
    assert_eq!(
        refused(rate(-1.0)),
        "swing.csv: the frame rate is -1 Hz; it must be finite and positive"
    );
    let parents = |parents: &[Option<usize>]| AngleColumns {
        relative_to: parents.to_vec(),
        ..named("upper")
    };
    assert_eq!(
        refused(parents(&[Some(0)])),
        "swing.csv: link 0 is measured from one that is not before it"
    );
    assert_eq!(
        refused(parents(&[None, None])),
        "swing.csv: 2 links to measure from for 1 angles"
    );
    let markers = |upper: &str, lower: &str| Markers {
        links: vec![LinkMarkers {
            upper: upper.to_owned(),
            lower: lower.to_owned(),
        }],
        ..Markers::default()
    };
    let refused = |markers: Markers| markers.read(&table).unwrap_err().to_string();
    assert_eq!(
        refused(markers("p", "q")),
        "swing.csv: there is no track `q`; there are: p"
    );
    assert_eq!(
        refused(markers("p", "p")),
        "swing.csv, line 2, column 4 (`p x`): `p` and `p` are at one place"
    );
    assert_eq!(
        refused(Markers::default()),
        "swing.csv: 1 track; a link needs two, from its pivot outwards: name those of each, or give the place of the pivot"
    );
    let folder =
        std::env::temp_dir().join(format!("branched-pendulum-reading-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let files: [(&str, &[u8], &str); 4] = [
        (
            "utf16.csv",
            b"\xff\xfet\0",
            "is not text but UTF-16; save it as text (UTF-8)",
        ),
        (
            "sheet.xlsx",
            b"PK\x03\x04....",
            match cfg!(feature = "spreadsheets") {
                true => {
                    "is not text but an archive or a document that is not a spreadsheet; save it as text (UTF-8)"
                }
                false => "is not text but a zip archive (a spreadsheet?); save it as text (UTF-8)",
            },
        ),
        (
            "net.h5",
            b"\x89HDF\r\n",
            "is not text but HDF5; save it as text (UTF-8)",
        ),
        (
            "raw.bin",
            b"1,2\0",
            "is not text but binary data; save it as text (UTF-8)",
        ),
    ];
    for (name, bytes, expected) in files {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        let error = Table::read(&path, &TableOptions::default())
            .unwrap_err()
            .to_string();
        assert_eq!(error, format!("{}: {expected}", path.display()));
    }
    let path = folder.join("latin.csv");
    std::fs::write(&path, b"t [s];Winkel [\xb0]\n0;1\n1;2\n2;3\n").unwrap();
    let table = Table::read(&path, &TableOptions::default()).unwrap();
    assert_eq!(table.columns()[1].unit, "°");
    let missing = Table::read(folder.join("none.csv"), &TableOptions::default()).unwrap_err();
    assert!(missing.to_string().ends_with("none.csv: cannot be read"));
    assert!(std::error::Error::source(&missing).is_some());
    std::fs::remove_dir_all(&folder).unwrap();
}
