"""Pages and notebooks run as they stand."""

import re
from pathlib import Path

import nbclient
import nbformat
import pytest

PACKAGE = Path(__file__).parents[1]
PAGES = [PACKAGE / "README.md", PACKAGE / "../../docs/tutorials/python.md"]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_listings(page, capsys):
    listings = re.findall(r"^```python\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)
    names = {}
    for listing in listings:
        exec(compile(listing, page.name, "exec"), names)
    assert listings and capsys.readouterr().out


@pytest.mark.parametrize("path", sorted((PACKAGE / "notebooks").glob("*.ipynb")), ids=lambda p: p.name)
def test_notebooks(path):
    notebook = nbformat.read(path, as_version=4)
    # What is committed holds no outputs, and so no names of the machine that made them.
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert cells and not any(cell.outputs for cell in cells)
    resources = {"metadata": {"path": path.parent}}
    nbclient.NotebookClient(notebook, timeout=120, resources=resources).execute()
    kinds = {kind for cell in cells for output in cell.outputs for kind in output.get("data", {})}
    assert "image/png" in kinds
