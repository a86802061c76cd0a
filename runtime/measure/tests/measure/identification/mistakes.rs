//! Requests that make no sense, each refused by name and place.

use branched_pendulum_measure::identification::{
    AngleRecord, FamilyOf, Identification, IdentificationError, Shooting,
};

use super::chain::{Chain, REAL, all_unknown, simulated};

fn task() -> Identification<FamilyOf<Chain>> {
    all_unknown(FamilyOf::new(), |value| value)
}

fn message(task: &Identification<FamilyOf<Chain>>, record: &AngleRecord) -> String {
    task.fit(record).unwrap_err().to_string()
}

#[test]
fn names_are_told() {
    let record = simulated([0.5, 0.2], 2.0, 50.0, 0.0, 1);
    let text = message(&task().known("mas_1", 1.0), &record);
    assert!(
        text.starts_with("the model has no parameter `mas_1`; it has `"),
        "{text}"
    );
    let text = message(&task().known("mass_1", 1.0), &record);
    assert_eq!(text, "`mass_1` is given twice");
    let few = Identification::new(FamilyOf::<Chain>::new()).known("gravity", 9.8);
    assert!(matches!(
        few.fit(&record),
        Err(IdentificationError::Missing { .. })
    ));
    let text = message(&task().unknown("gravity", 0.0), &record);
    assert_eq!(text, "`gravity` is given twice");
    let other = AngleRecord::new(&[0.0, 1.0]).with_link("middle", &[Some(0.0); 2], 1e-3);
    let text = message(&task(), &other);
    assert_eq!(
        text,
        "the model has no link `middle`; it has `upper` and `lower`"
    );
}

#[test]
fn numbers_are_told() {
    let good = simulated([0.5, 0.2], 2.0, 50.0, 0.0, 1);
    let heavy = all_unknown(FamilyOf::<Chain>::new(), |value| -value);
    assert!(matches!(
        heavy.fit(&good),
        Err(IdentificationError::Start(_))
    ));
    let record = AngleRecord::new(&[0.0, 1.0, 1.0]).with_link("upper", &[None; 3], 1e-3);
    let text = message(&task(), &record);
    assert!(text.starts_with("time 2 is 1 s"), "{text}");
    let record = AngleRecord::new(&[0.0, 1.0]).with_link("upper", &[Some(f64::NAN); 2], 1e-3);
    let text = message(&task(), &record);
    assert!(text.starts_with("angle 0 of `upper` is NaN"), "{text}");
    let record = AngleRecord::new(&[0.0, 1.0]).with_link("upper", &[Some(0.0)], 1e-3);
    assert_eq!(message(&task(), &record), "1 angles of `upper` for 2 times");
    let record = AngleRecord::new(&[0.0, 1.0]).with_link("upper", &[Some(0.0); 2], 0.0);
    let text = message(&task(), &record);
    assert!(text.starts_with("deviation of `upper` is 0"), "{text}");
    let negative = Shooting {
        first: -1.0,
        ..Shooting::default()
    };
    let text = message(&task().with_shooting(negative), &good);
    assert!(
        text.starts_with("length of the first segments is -1"),
        "{text}"
    );
}

#[test]
fn too_few_data_are_counted() {
    let record = simulated([0.5, 0.2], 0.1, 50.0, 0.0, 1);
    let error = task().fit(&record);
    assert_eq!(
        error,
        Err(IdentificationError::TooFew {
            found: 12,
            needed: 13
        })
    );
    let none = task().fit(&AngleRecord::new(&[]));
    assert!(matches!(
        none,
        Err(IdentificationError::TooFew { found: 0, .. })
    ));
}

#[test]
fn what_is_not_determined_is_told_with_what_it_goes_with() {
    let record = simulated([0.5, 0.2], 6.0, 50.0, 0.0, 1);
    let all = Identification::new(FamilyOf::<Chain>::new()).unknown("gravity", 9.8);
    let all = REAL
        .iter()
        .fold(all, |task, (name, value)| task.unknown(name, *value));
    let fit = all.fit(&record).unwrap();
    // Ratios alone, with gravity as without.
    let found = &fit.identifiability;
    assert_eq!((found.determined(), found.unknown), (6, 10), "{found}");
    let fit = task().fit(&record).unwrap();
    assert_eq!(
        fit.identifiability.determined(),
        6,
        "{}",
        fit.identifiability
    );
    let error = fit.determined("mass_1").unwrap_err();
    let IdentificationError::NotDetermined { name, with } = &error else {
        panic!("{error}");
    };
    assert!(
        name == "mass_1" && with.iter().any(|other| other == "mass_2"),
        "{error}"
    );
    assert!(
        error
            .to_string()
            .starts_with("the data do not determine `mass_1`")
    );
    assert!(matches!(
        fit.determined("weight"),
        Err(IdentificationError::UnknownParameter { .. })
    ));
}
