"""Seeds of the fuzzers, and the words of the attribute, out of the repository's own files."""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parents[1]
# What reads tables reads all rows alike: the first ones.
ROWS = 25


def write(folder, texts):
    folder.mkdir(parents=True, exist_ok=True)
    for number, text in enumerate(sorted(set(texts))):
        (folder / f"{number:03}").write_text(text)
    return len(set(texts))


def sources(*patterns):
    paths = (path for pattern in patterns for path in ROOT.glob(pattern))
    return [path.read_text() for path in sorted(paths)]


def attributes(text):
    """What stands between the parentheses of each attribute."""
    for start in re.finditer(r"#\[branched_pendulum\(", text):
        depth, end = 1, start.end()
        while depth and end < len(text):
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        inside = text[start.end() : end - 1]
        # In docs.
        yield re.sub(r"(?m)^\s*//[/!] ?", "", inside).strip()


def descriptions():
    trees = sources("runtime/program/trees/*.txt", "docs/tutorials/swing/*.txt")
    for text in sources(
        "runtime/src/attribute.md", "docs/**/*.md", "tests/fixtures/scenes/*.rs",
        "runtime/src/**/*.rs", "tests/src/*.rs", "examples/src/**/*.rs",
    ):
        trees += attributes(text)
    return [text for text in trees if len(text) < 2000]


def tables():
    found = sources("docs/tutorials/swing/*.csv", "docs/tutorials/swing/tracker.txt", "docs/charts/*.csv")
    found = ["".join(text.splitlines(keepends=True)[:ROWS]) for text in found]
    # Tables in tests stand in strings of one line, or in more.
    for text in sources("runtime/data/tests/data/*.rs", "runtime/data/src/*.rs"):
        for string in re.findall(r'"((?:[^"\\\n]|\\.|\\\n)*)"', text):
            string = re.sub(r"\\\n\s*", "", string)
            string = string.replace("\\n", "\n").replace("\\t", "\t").replace('\\"', '"')
            if string.count("\n") > 1 and any(letter.isdigit() for letter in string):
                found.append(string)
    return found


def words():
    page = (ROOT / "runtime/src/attribute.md").read_text()
    found = sorted(set(re.findall(r"[a-z_0-9]{2,}", " ".join(re.findall(r"`([^`\n]+)`", page)))))
    return [f'"{word}"' for word in found]


def main():
    folder = HERE / "seeds"
    counts = {
        "descriptions": write(folder / "descriptions", descriptions()),
        "tables": write(folder / "tables", tables()),
    }
    (folder / "descriptions.dict").write_text("\n".join(words()) + "\n")
    columns = ["scorer", "bodyparts", "coords", "likelihood", "frame", "time", "mass A", "#multi:"]
    columns += ["[deg]", "[rad]", "[s]", "[ms]", "nan", "inf", "1e999", "theta", "0,5", "x", "y"]
    (folder / "tables.dict").write_text("\n".join(f'"{word}"' for word in columns) + "\n")
    print(", ".join(f"{count} {name}" for name, count in counts.items()), file=sys.stderr)


if __name__ == "__main__":
    main()
