//! Command line program that writes the JavaScript module of a compiled WebAssembly file: `bindings
//! FILE FOLDER`.

use std::error::Error;
use std::fs;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, folder] = &arguments[..] else {
        return Err("usage: bindings FILE FOLDER".into());
    };
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(file)
        .web(true)?
        .typescript(false)
        .omit_default_module_path(true)
        .remove_name_section(true)
        .remove_producers_section(true);
    bindgen.generate(folder)?;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "js") {
            fs::write(&path, without_comments(&fs::read_to_string(&path)?))?;
        }
    }
    Ok(())
}

/// Removes lines that contain only a comment, which nobody reads in a browser.
fn without_comments(module: &str) -> String {
    let mut is_inside = false;
    let mut kept = String::with_capacity(module.len());
    for line in module.lines() {
        let text = line.trim();
        let begins = text.starts_with("/*");
        if !(is_inside || begins || text.starts_with("//")) {
            kept.push_str(line);
            kept.push('\n');
        }
        is_inside = (is_inside || begins) && !text.ends_with("*/");
    }
    kept
}
