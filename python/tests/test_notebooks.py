"""The notebooks run from top to bottom; what they assert holds, and each shows pictures."""
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")
pytest.importorskip("pandas")

FOLDER = Path(__file__).parents[1] / "notebooks"


@pytest.mark.parametrize("name", sorted(file.name for file in FOLDER.glob("*.ipynb")))
def test_runs(name, tmp_path, data, monkeypatch):
    notebook = nbformat.read(FOLDER / name, 4)
    assert all(not cell.get("outputs") and cell.get("execution_count") is None for cell in notebook.cells), "clear the outputs"
    client = nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}})
    monkeypatch.setenv("HCI_DATA", str(data.resolve()))
    client.execute()
    pictures = [output for cell in notebook.cells for output in cell.get("outputs", [])
                if "image/png" in output.get("data", {}) or "data:image/png" in str(output.get("data", {}).get("text/html", ""))]
    assert len(pictures) >= 2
