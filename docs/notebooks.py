#!/usr/bin/env python3
"""Pages of the book from the notebooks of the Python package, as they are stored: with outputs.

    docs/notebooks.py            writes docs/notebooks/: a page for each notebook, and its pictures
    docs/notebooks.py --check    exit 1 where a page or a picture is not that of its notebook
    docs/notebooks.py --execute  executes the notebooks first, and stores their outputs

The first two need Python alone; `--execute` needs the package with its notebooks' requirements, and
takes names of notebooks, where it is not to be all: `--execute cascade solvers`.
"""

import argparse
import base64
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "runtime/python/notebooks"
PAGES = ROOT / "docs/notebooks"
# Of a picture, in bytes.
LARGEST = 100_000


def text(parts):
    """Text of a notebook: a string, or a list of lines."""
    return parts if isinstance(parts, str) else "".join(parts)


def formulas(markdown):
    """Formulas between dollars as the book has them: between dollars and backticks."""
    pieces = re.split(r"(`[^`]*`)", markdown)
    pieces[::2] = [re.sub(r"\$([^$\n]+)\$", r"$`\1`$", piece) for piece in pieces[::2]]
    return "".join(pieces)


def fenced(language, content):
    return f"```{language}\n{content.rstrip()}\n```"


def page(path):
    """The page of a notebook: its Markdown, and its pictures by name."""
    notebook = json.loads(path.read_text())
    blocks, pictures, heading = [], {}, path.stem
    for cell in notebook["cells"]:
        source = text(cell["source"])
        if cell["cell_type"] == "markdown":
            blocks.append(formulas(source))
            headings = re.findall(r"^#+ (.*)$", source, re.MULTILINE)
            heading = headings[-1] if headings else heading
            continue
        blocks.append(fenced("python", source))
        for output in cell["outputs"]:
            if output["output_type"] == "stream":
                blocks.append(fenced("text", text(output["text"])))
                continue
            data = output["data"]
            for kind, ending in [("image/svg+xml", "svg"), ("image/png", "png")]:
                if kind in data:
                    name = f"{path.stem}-{len(pictures) + 1}.{ending}"
                    content = text(data[kind])
                    is_text = ending == "svg"
                    pictures[name] = content.encode() if is_text else base64.b64decode(content)
                    blocks.append(f"![{heading.replace('$', '')}]({name})")
                    break
            else:
                blocks.append(fenced("text", text(data["text/plain"])))
    where = f"../../runtime/python/notebooks/{path.name}"
    title, *rest = blocks[0].split("\n", 1)
    note = f"This page is the notebook [`{path.name}`]({where}) with its outputs, as it is stored."
    blocks[0] = "\n".join([title, "", note, *rest])
    return "\n\n".join(blocks) + "\n", pictures


def pages():
    """Contents of all files of the pages by name."""
    files = {}
    for path in sorted(NOTEBOOKS.glob("*.ipynb")):
        markdown, pictures = page(path)
        files[f"{path.stem}.md"] = markdown.encode()
        files.update(pictures)
    return files


def execute(path):
    """Executes a notebook, and stores it with its outputs and nothing of the machine."""
    import nbclient
    import nbformat

    notebook = nbformat.read(path, as_version=4)
    resources = {"metadata": {"path": path.parent}}
    client = nbclient.NotebookClient(
        notebook, timeout=600, resources=resources, record_timing=False, coalesce_streams=True
    )
    client.execute()
    notebook.metadata = {
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"},
    }
    nbformat.write(notebook, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--execute", nargs="*", metavar="NAME")
    arguments = parser.parse_args()
    if arguments.execute is not None:
        for path in sorted(NOTEBOOKS.glob("*.ipynb")):
            if not arguments.execute or path.stem in arguments.execute:
                execute(path)
    files = pages()
    large = [name for name, content in files.items() if len(content) > LARGEST]
    if large:
        sys.exit(f"larger than {LARGEST // 1000} kB: {', '.join(large)}")
    there = {path.name: path.read_bytes() for path in PAGES.glob("*")} if PAGES.is_dir() else {}
    if arguments.check:
        wrong = sorted(name for name in {*files, *there} if files.get(name) != there.get(name))
        if wrong:
            sys.exit(f"not as the notebooks are: {', '.join(wrong)}; docs/notebooks.py writes them")
        return
    PAGES.mkdir(exist_ok=True)
    for name in there.keys() - files.keys():
        (PAGES / name).unlink()
    for name, content in files.items():
        if there.get(name) != content:
            (PAGES / name).write_bytes(content)


if __name__ == "__main__":
    main()
