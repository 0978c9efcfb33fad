"""scripts/reference.py: pages hold what the docstrings say, and every link leads somewhere."""

import html
import re

import reference


def words(page):
    return html.unescape(re.sub("<[^>]+>", "", page.read_text(encoding="utf-8")))


def test_pages_of_packages(tmp_path):
    (tmp_path / "gone.html").write_text("of an earlier run")
    missing = reference.write(["plugin_loader", "node_signals", "no_such_package"], tmp_path)
    assert len(missing) == 1 and missing[0].startswith("no_such_package: No module named")
    assert not (tmp_path / "gone.html").exists()
    index = (tmp_path / "index.html").read_text()
    links = re.findall(r'href="([^"]+)"', index)
    assert "node_signals.rates.html" in links and all((tmp_path / link).is_file() for link in links)
    text = words(tmp_path / "node_signals.rates.html")
    assert "class RateGate" in text and "due(time: float) -> bool" in text and "once per opening" in text
    assert "_schedule" not in text and "Any" not in re.findall(r"class (\w+)", text)
    assert "find_plugins(" in words(tmp_path / "plugin_loader.html")
