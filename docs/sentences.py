#!/usr/bin/env python3
"""Lengths of the sentences of the book, in words: median and ninth decile, page by page and in all.

    docs/sentences.py              figures of README.md, docs/ and the attribute's page
    docs/sentences.py --longest 5  and the five longest sentences of each page
    docs/sentences.py --check      exit 1 where the whole book is over the limits

Prose alone counts: no listings, tables, headings, or formulas on lines of their own. A link counts as its text, code
between backticks as one word.
"""

import argparse
import re
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MEDIAN, NINTH_DECILE = 18, 32


def prose(text):
    """Paragraphs and list items without what is no prose."""
    text = re.sub(r"(?ms)^ *```.*?^ *```", "", text)
    text = re.sub(r"(?ms)^ *\$\$.*?\$\$", "", text)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    paragraphs, lines = [], []
    for line in text.splitlines():
        stripped = line.strip()
        begins = re.match(r"([-*]|\d+\.) ", stripped)
        if not stripped or stripped.startswith(("|", "#", "<")) or begins:
            paragraphs.append(" ".join(lines))
            lines = []
        if stripped and not stripped.startswith(("|", "#", "<")):
            lines.append(re.sub(r"^([-*]|\d+\.) ", "", stripped))
    return [p for p in [*paragraphs, " ".join(lines)] if p]


def sentences(paragraph):
    """Sentences of a paragraph, code as one word."""
    paragraph = re.sub(r"`[^`]*`", "code", paragraph)
    for sentence in re.split(r"(?<=[.!?:])\s+(?=[A-Z“\"(*_0-9])", paragraph):
        words = re.findall(r"[^\W_][\w'’./%°·−^+-]*", sentence)
        if len(words) > 2:
            yield len(words), sentence


def decile(lengths):
    return statistics.quantiles(lengths, n=10)[8] if len(lengths) > 1 else lengths[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--longest", type=int, default=0, metavar="N")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")), ROOT / "runtime/src/attribute.md"]
    everything = []
    for page in pages:
        found = [s for p in prose(page.read_text(encoding="utf-8")) for s in sentences(p)]
        if not found:
            continue
        lengths = [length for length, _ in found]
        everything += lengths
        print(f"{statistics.median(lengths):5.1f} {decile(lengths):5.1f} {len(lengths):5}  {page.relative_to(ROOT)}")
        for length, sentence in sorted(found, reverse=True)[: arguments.longest]:
            print(f"      {length}: {sentence}")
    median, ninth = statistics.median(everything), decile(everything)
    print(f"{median:5.1f} {ninth:5.1f} {len(everything):5}  in all (median, ninth decile, sentences)")
    if arguments.check and (median > MEDIAN or ninth > NINTH_DECILE):
        print(f"at most {MEDIAN} and {NINTH_DECILE} words", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
