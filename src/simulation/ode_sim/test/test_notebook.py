"""The notebook of the examples, run as Jupyter runs it, and what its reader sees."""

import base64
import io
import math
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
FILE = Path(__file__).resolve().parents[4] / "docs/examples/notebook/pendulum.ipynb"
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def outputs(tmp_path_factory):
    """Of all cells, in their order."""
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(FILE, 4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(notebook, timeout=200, kernel_name="python3").execute(cwd=str(tmp_path_factory.mktemp("elsewhere")))
    return [output for cell in notebook.cells for output in cell.get("outputs", [])]


def printed(outputs):
    return "".join(output["text"] for output in outputs if output["output_type"] == "stream" and output["name"] == "stdout")


def colours(picture):
    """Shares of pixels that are blue and orange."""
    red, green, blue = np.moveaxis(np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), float), 2, 0)
    return np.mean(blue > 1.5 * red + 20), np.mean((red > 2 * blue + 20) & (green > blue))


def test_it_is_kept_without_what_came_out():
    notebook = nbformat.read(FILE, 4)
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in notebook.cells)


def test_nothing_fails_and_nothing_is_complained_about(outputs):
    assert not [output for output in outputs if output["output_type"] == "error"]
    assert not [output for output in outputs if output.get("name") == "stderr"]


def test_its_numbers(outputs):
    measured, said = map(float, re.search(r"measured (\S+) s, on paper (\S+) s", printed(outputs)).groups())
    assert said == pytest.approx(2 * math.pi * math.sqrt(5 * 0.5 / (3 * 9.8)), abs=1e-4)
    assert measured == pytest.approx(said, rel=0.002)  # at 0.05 rad a period is 0.00016 longer
    off = [float(number) for number in re.findall(r"'(-?\d\.\d+)'", printed(outputs))]
    assert len(off) == 2 and max(map(abs, off)) < 0.02
    assert "the same bits: True" in printed(outputs)


def test_its_plot_and_its_film(outputs):
    data = [output["data"] for output in outputs if "data" in output]
    assert any("image/png" in each for each in data)
    film = next(each["text/html"] for each in data if "text/html" in each)
    frames = [base64.b64decode(text.replace("\\\n", "")) for text in re.findall(r'data:image/png;base64,([^"]*)"', film)]
    assert len(frames) == 40 and len(set(frames)) > 10  # it moves
    for frame in (frames[0], frames[-1]):  # by projection a rod of 0.5 m by 0.04 m is 38 by 3 pixels, of 90000
        assert all(0.0008 < share < 0.004 for share in colours(frame)), colours(frame)
