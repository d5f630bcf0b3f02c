"""The Python of docs/python.md runs, in the order of the page, and prints what the page shows."""
import os
import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs/python.md"


def test_the_page(data, tmp_path, monkeypatch, capsys):
    pytest.importorskip("pandas")
    if not PAGE.exists():
        pytest.skip("no docs here")
    os.symlink(data.resolve(), tmp_path / "data")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```(python|text)\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    assert len(blocks) >= 6
    space = {}
    for kind, block in blocks:
        if kind == "python":
            capsys.readouterr()
            exec(compile(block, str(PAGE), "exec"), space)
        else:
            assert capsys.readouterr().out == block
