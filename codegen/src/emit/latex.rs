//! The formulas of a scene as a document.

use super::Emission;
use crate::description::StructItem;
use crate::mechanics::{Mechanics, latex};
use crate::program::Program;
use crate::scene::Scene;

/// Terms of a sum on one line.
const TERMS_A_LINE: usize = 4;

/// Writes the constants and the formulas of each function as a LaTeX document.
pub fn latex_document(
    item: &StructItem,
    scene: &Scene,
    mechanics: &Mechanics,
    program: &Program,
) -> String {
    let emission = Emission {
        item,
        scene,
        mechanics,
        program,
    };
    let symbols = &mechanics.symbols;
    let constants = mechanics.constants.iter();
    let constants: Vec<String> = constants
        .map(|constant| {
            let left = &symbols.get(constant.symbol).latex;
            aligned(left, &latex(&constant.value, symbols))
        })
        .collect();
    let mut sections = vec![("constants".to_owned(), constants)];
    for entry in &program.entries {
        let formulas = emission.formulas(entry.purpose).into_iter();
        let lines =
            formulas.map(|formula| aligned(&formula.left_latex, &latex(&formula.right, symbols)));
        sections.push((entry.name.clone(), lines.collect()));
    }
    let mut document = format!(
        "\\documentclass{{article}}\n\\usepackage{{amsmath}}\n\\allowdisplaybreaks\n\
         \\begin{{document}}\n\\section*{{{}}}\n",
        escaped(&scene.name)
    );
    for (name, lines) in sections.iter().filter(|(_, lines)| !lines.is_empty()) {
        let name = escaped(&name.replace('_', " "));
        let lines = lines.join(" \\\\\n");
        document.push_str(&format!(
            "\n\\subsection*{{{name}}}\n\\begin{{align*}}\n{lines}\n\\end{{align*}}\n"
        ));
    }
    document.push_str("\n\\end{document}\n");
    document
}

/// An equation, broken before terms of its sum where there are many.
fn aligned(left: &str, right: &str) -> String {
    let mut line = format!("{left} &= ");
    let (mut depth, mut terms) = (0_i32, 0);
    for (place, letter) in right.char_indices() {
        depth += match letter {
            '{' | '(' | '[' => 1,
            '}' | ')' | ']' => -1,
            _ => 0,
        };
        let begins = depth == 0 && matches!(letter, '+' | '-') && right[..place].ends_with(' ');
        if begins {
            terms += 1;
            if terms % TERMS_A_LINE == 0 {
                line.push_str("\\\\\n&\\quad ");
            }
        }
        line.push(letter);
    }
    line
}

fn escaped(name: &str) -> String {
    name.replace('_', "\\_")
}
