use super::*;

#[test]
fn the_target_folder_is_told_by_the_compilers_arguments() {
    let root = std::env::temp_dir().join(format!("target-{}", std::process::id()));
    let deps = root.join("debug/deps");
    fs::create_dir_all(&deps).unwrap();
    for arguments in [
        vec!["rustc".into(), "--out-dir".into(), deps.clone().into()],
        vec![
            "rustc".into(),
            format!("--out-dir={}", deps.display()).into(),
        ],
    ] {
        let output = output_folder(arguments.into_iter());
        assert_eq!(output.as_deref(), Some(deps.as_path()));
    }
    assert_eq!(target_folder(&deps), None);
    for mark in MARKS {
        fs::write(root.join(mark), "").unwrap();
        assert_eq!(target_folder(&deps), Some(root.as_path()));
        fs::remove_file(root.join(mark)).unwrap();
    }
    fs::remove_dir_all(root).unwrap();
}

/// Name and text of a cache file.
fn own(number: usize) -> (String, String) {
    let question = number.to_string();
    let entry = CacheEntry {
        question: &question,
        expansion: "b",
    };
    (CacheEntry::file_name(&question), entry.to_string())
}

#[test]
fn files_that_were_used_last_stay() {
    let path = std::env::temp_dir().join(format!("room-{}", std::process::id()));
    let folder = Folder::new(path.clone());
    let (first, text) = own(0);
    folder.write(&first, &text);
    for number in 1..=MOST_FILES + 20 {
        let (name, text) = own(number);
        folder.write(&name, &text);
        assert_eq!(folder.read(&first).as_ref(), Some(&own(0).1));
    }
    assert_eq!(fs::read_dir(&path).unwrap().count(), MOST_FILES);
    assert_eq!(folder.read(&own(1).0), None);
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn names_and_heads_are_told_from_others() {
    let (name, text) = own(1);
    let part = CacheEntry::part_name(&name, 4711, 12);
    for own in [&name, &part] {
        assert!(CacheEntry::is_name(own.as_ref()), "{own}");
    }
    let code = &name[..16];
    for other in [
        String::new(),
        ".expansion".into(),
        "diary-7.txt".into(),
        name.to_uppercase(),
        format!("{name}.bak"),
        format!("{name}~"),
        format!("{name}.1-"),
        format!("{name}.-1"),
        format!("{name}.1-2.3"),
        format!("0{name}"),
        format!("{}.expansion", &code[1..]),
        format!("{code}.expansions"),
        format!("g{}.expansion", &code[1..]),
        format!("{code}.txt.expansion"),
    ] {
        assert!(!CacheEntry::is_name(other.as_ref()), "{other}");
    }
    let head = |text: &str| text.as_bytes()[..HEAD].try_into().unwrap();
    assert!(CacheEntry::is_head(&head(&text)));
    for wrong in [
        text.replacen("branched", "Branched", 1),
        text.replacen("expansion ", "expansion: ", 1),
        text.replacen('\n', " ", 1),
        "x".repeat(HEAD),
    ] {
        assert!(!CacheEntry::is_head(&head(&wrong)), "{wrong}");
    }
}

#[cfg(unix)]
mod foreign;
