//! The formulas of a scene as a LaTeX document.

use super::Emission;
use crate::description::StructItem;
use crate::mechanics::expression::Expr;
use crate::mechanics::{Mechanics, constant_latex, latex};
use crate::program::Program;
use crate::scene::Scene;

/// Number of terms of a sum on one line.
const TERMS_A_LINE: usize = 4;

/// Page layout on which long terms, which cannot be broken, fit: a line has 1,877 pt, and the
/// longest term of the fixture scenes takes 1,750 pt.
const PAGE: &str = "paperwidth=70cm,paperheight=40cm,margin=2cm";

/// Letters in the equations of one link.
const LETTERS: &str = "\
Link $i$ has mass $m$, moment of inertia $I$ about its centre of mass $(d, e)$, and the torque
$Q$ on it. Subtrees on its pivot $(\\ell, w)$ answer the acceleration $a$ of that pivot with the
force $\\sigma a + \\gamma - N a$; the mass $\\sigma$ is that of subtrees of one link. $J$ is the moment
of inertia that the joint feels, $b$ the first moment, $\\kappa$ the bias torque, $f$ the force
with the joint held. Primed are $N$ and $\\gamma$ of the subtree that the link carries, and the
acceleration of its children's pivot.
";

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
    let line = |left: &str, right: &Expr| aligned(left, &latex(right, symbols));
    let constants = mechanics.constants.iter();
    let constants = constants.map(|constant| {
        let left = &symbols.get(constant.symbol).latex;
        aligned(left, &constant_latex(&constant.value, symbols))
    });
    let mut document = format!(
        "\\documentclass{{article}}\n\\usepackage{{amsmath}}\n\
         \\usepackage[{PAGE}]{{geometry}}\n\\allowdisplaybreaks\n\\begin{{document}}\n\\section*{{{}}}\n",
        escaped(&scene.name)
    );
    document += &section("constants", "", constants.collect());
    if let Some(link) = &mechanics.link {
        let formulas = link.formulas(symbols).into_iter();
        let lines = formulas.map(|formula| line(&formula.left_latex, &formula.right));
        document += &section("equations of one link", LETTERS, lines.collect());
    }
    for entry in &program.entries {
        let formulas = emission.formulas(entry.purpose).into_iter();
        let lines = formulas.map(|formula| line(&formula.left_latex, &formula.right));
        document += &section(&entry.name, "", lines.collect());
    }
    document.push_str("\n\\end{document}\n");
    document
}

/// Returns a section; empty without equations.
fn section(name: &str, introduction: &str, lines: Vec<String>) -> String {
    if lines.is_empty() {
        return String::new();
    }
    let (name, lines) = (escaped(&name.replace('_', " ")), lines.join(" \\\\\n"));
    format!(
        "\n\\subsection*{{{name}}}\n{introduction}\\begin{{align*}}\n{lines}\n\\end{{align*}}\n"
    )
}

/// Returns an equation; a sum of many terms is broken before some of them.
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
