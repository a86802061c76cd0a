#!/usr/bin/env python3
"""Counts words and phrases that make comments, messages and pages hard to read, and checks them against limits.

    docs/words.py                 the count of each rule
    docs/words.py --list RULE     every place of one rule, as file:line: text
    docs/words.py --check         exit 1 if a count is above its limit, with the places

Three kinds of text are read: comments of Rust, Python and JavaScript; string literals of Rust with three words or more
(messages and help texts); prose of the pages. Test code and snapshots are not read, nor is code that the macro emitted.
A limit above zero leaves room for uses in which the word is right: "the two are alike up to rounding".
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from sentences import ROOT, prose  # noqa: E402

# Name of the rule, pattern, limit, remedy.
WORDS = [
    ("told", r"\b(told|tells?)\b", 20, "reports, prints, returns; is given"),
    ("own", r"\bof (its|their|his|our|your|one's) own\b", 30, "its own, or leave it out"),
    ("so-many", r"\bso many\b", 15, "this many, at most N"),
    ("alike", r"\balike\b", 30, "identical, of the same length, both"),
    ("likewise", r"\blikewise\b", 5, "also"),
    ("stands-in", r"\b(stands?|stood) in (the|a|an|this|that|its|their|one|both|all|[`\[A-Z0-9])", 0, "is listed in, is defined in"),
    ("hands-on", r"\bhand(s|ed)? (on|over)\b", 0, "passes, returns"),
    ("whatever", r"\bwhatever\b", 0, "name the thing"),
    ("no-such", r"\b(is|are) no (such )?[a-z]+ (of|that|which)\b|\bno [a-z]+ is such\b", 0, "say what the thing is"),
    ("beside", r"\bbeside\b", 40, "next to, compared with, together with"),
]
# A doc comment begins with a verb or with a noun phrase.
FIRST = r"^(What|Whether|Those|That|Its|Whose|Where|All of|The same)\b"
FIRST_LIMIT = 0
# A message is a sentence for a stranger: the value that is wrong, and what is accepted.
UNSPOKEN = r"(?<![Tt]here )\b(is|are) (no|none|not such)\b|\bsuch\b$"
UNSPOKEN_LIMIT = 0
# Names of other programs, and placeholders of generated names.
OTHERS = {
    "analyze_videos", "analyze_videos_converth5_to_csv", "name_rate", "antiphase_energy_arm_d", "coupling_finger_arm",
    "f_friction_rate", "f_from_momenta", "f_rate_from_momenta", "sector_transfers_amplitude_N", "sector_transfers_angle_N",
}
SKIPPED = re.compile(r"(^|/)(tests|fixtures|snapshots|equations|node_modules|katex|mistakes)/|paper\.rs$|committed/model\.rs$|\.ipynb$|words\.py$")


def tracked():
    try:
        names = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
    except (OSError, subprocess.CalledProcessError):
        names = [str(p.relative_to(ROOT)) for p in ROOT.rglob("*") if p.is_file() and "target" not in p.parts]
    return [n for n in names if n and not SKIPPED.search(n)]


def comments(path, text):
    """Comments of a source file: first line number, marker, text."""
    marker = {".rs": r"\s*(//[/!]?)(?!/) ?(.*)", ".js": r"\s*(//) ?(.*)", ".py": r"\s*(#)(?!!) ?(.*)"}[path.suffix]
    block, start, mark = [], 0, ""
    for number, line in enumerate([*text.split("\n"), ""], 1):
        found = re.match(marker, line)
        if found and (not block or found.group(1) == mark):
            if not block:
                start, mark = number, found.group(1)
            block.append(found.group(2))
        else:
            if block:
                yield start, mark, block
            block = [found.group(2)] if found else []
            if found:
                start, mark = number, found.group(1)


def messages(text):
    """String literals of three words or more, outside of comments."""
    for number, line in enumerate(text.split("\n"), 1):
        if re.match(r"\s*//", line):
            continue
        for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
            if len(re.findall(r"[a-z]{2,}", literal)) >= 3 and " " in literal:
                yield number, literal


def texts():
    """Every line that is read: kind, file, line number, text."""
    for name in tracked():
        path = ROOT / name
        if path.suffix in (".rs", ".js", ".py"):
            text = path.read_text(encoding="utf-8")
            for start, mark, block in comments(path, text):
                for offset, line in enumerate(block):
                    kind = "doc" if offset == 0 and mark in ("///", "//!") else "comment"
                    yield kind, name, start + offset, line
            if path.suffix == ".rs":
                for number, literal in messages(text):
                    yield "message", name, number, literal
        elif path.suffix == ".md":
            for paragraph in prose(path.read_text(encoding="utf-8")):
                yield "page", name, 0, paragraph


def places():
    """Places of every rule."""
    found = {name: [] for name, *_ in WORDS} | {"first-word": [], "message": []}
    for kind, name, number, text in texts():
        for rule, pattern, *_ in WORDS:
            found[rule] += [(name, number, text)] * len(re.findall(pattern, text))
        if kind == "doc" and re.match(FIRST, text):
            found["first-word"].append((name, number, text))
        if kind == "message" and re.search(UNSPOKEN, text):
            found["message"].append((name, number, text))
    return found


def unknown_names():
    """Names in backticks in pages, of functions or other items with an underscore, that no source file has."""
    known, functions = set(), set()
    for name in subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.split("\n"):
        if name.endswith((".rs", ".py", ".pyi", ".js", ".snap", ".sh", ".toml", ".html", ".txt", ".c", ".jl")):
            text = (ROOT / name).read_text(encoding="utf-8", errors="ignore")
            known |= set(re.findall(r"\w+", text))
            functions |= set(re.findall(r"\b(?:fn|def|macro_rules!) (\w+)", text))
    # Names that the grammar of descriptions gives meaning to, and those of other people's programs.
    grammar = set(re.findall(r"\b([a-z]\w*)\(", (ROOT / "codegen/src/description/mod.rs").read_text(encoding="utf-8")))
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")), ROOT / "runtime/src/attribute.md"]:
        text = re.sub(r"\$`[^`]*`\$", "", page.read_text(encoding="utf-8"))
        for number, line in enumerate(text.split("\n"), 1):
            for code in re.findall(r"(?<!`)`([^`]+)`", line):
                called = re.match(r"(?:\w+(?:\.|::))*([a-z]\w*_\w*)\(", code)
                named = re.fullmatch(r"(?:\w+(?:\.|::))*([a-z]\w*_\w*)", code)
                if code != code.lower():
                    continue  # a placeholder such as `budget_NAME`
                if called and called.group(1) not in functions | grammar | OTHERS or named and named.group(1) not in known | OTHERS:
                    yield str(page.relative_to(ROOT)), number, code


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", metavar="RULE")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    found = places()
    limits = {name: (limit, remedy) for name, _, limit, remedy in WORDS}
    limits["first-word"] = (FIRST_LIMIT, "begin with a verb or with a noun phrase")
    limits["message"] = (UNSPOKEN_LIMIT, "say what is wrong, and what is accepted")
    failed = False
    for rule, (limit, remedy) in limits.items():
        over = len(found[rule]) > limit
        failed |= over
        print(f"{len(found[rule]):5} of at most {limit:3}  {rule}: {remedy}")
        if arguments.list == rule or arguments.check and over:
            for name, number, text in found[rule]:
                print(f"       {name}:{number}: {text.strip()[:140]}")
    missing = list(unknown_names())
    print(f"{len(missing):5} of at most   0  names in pages that no source has")
    for name, number, function in missing:
        print(f"       {name}:{number}: {function}")
    return 1 if arguments.check and (failed or missing) else 0


if __name__ == "__main__":
    sys.exit(main())
