// Typesets the formulas of a page: ```math fences, and $`…`$ within a line. Code hosts typeset
// both forms too, and Markdown leaves what is between backticks as it is.
"use strict";

(() => {
    const typeset = (source, displayMode) => {
        const formula = document.createElement(displayMode ? "div" : "span");
        formula.className = "formula";
        // A formula that KaTeX refuses stays readable, in red, as `.katex-error`.
        katex.render(source, formula, { displayMode, throwOnError: false });
        return formula;
    };
    const isText = (node) => node?.nodeType === Node.TEXT_NODE;

    for (const code of document.querySelectorAll("main pre > code.language-math")) {
        code.parentElement.replaceWith(typeset(code.textContent, true));
    }
    for (const code of document.querySelectorAll("main :not(pre) > code")) {
        const before = code.previousSibling;
        const after = code.nextSibling;
        if (!isText(before) || !isText(after)) continue;
        const opening = before.data.match(/([^\s$]*)\$$/);
        const closing = after.data.match(/^\$([^\s$]*)/);
        if (!opening || !closing) continue;
        // Browsers would break a line before the comma behind a formula. Breaks are forbidden in
        // the whole piece, and a <wbr> allows them again outside brackets.
        const piece = document.createElement("span");
        piece.className = "formula-piece";
        piece.append(opening[1], typeset(code.textContent, false), closing[1]);
        let depth = 0;
        for (const part of piece.querySelectorAll(".katex-html > .base")) {
            if (depth === 0 && part.previousSibling) part.before(document.createElement("wbr"));
            for (const sign of part.textContent) {
                depth += "([{".includes(sign) - ")]}".includes(sign);
            }
        }
        before.data = before.data.slice(0, -opening[0].length);
        after.data = after.data.slice(closing[0].length);
        code.replaceWith(piece);
    }
})();
