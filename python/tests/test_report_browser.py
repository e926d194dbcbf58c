# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports in a browser (Chromium without a window). They open without a network and without an error on the console, a
screenshot shows them, and they print on A4."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from macadam.report import report
from report_folders import PROGRAM, make

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
pytestmark = [
    pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM"),
    pytest.mark.skipif(CHROMIUM is None, reason="no Chromium: Debian's package chromium has one"),
]


def browse(tmp_path: Path, page: Path, *options: str) -> str:
    """Opens the page in the browser and returns the browser's log."""
    done = subprocess.run(
        [
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            f"--user-data-dir={tmp_path}/user",
            "--host-resolver-rules=MAP * ~NOTFOUND",
            "--enable-logging=stderr",
            *options,
            page.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=3600,
    )
    assert done.returncode == 0, done.stderr
    return done.stderr


def complaints(log: str) -> list[str]:
    return [line for line in log.splitlines() if "CONSOLE" in line]


def test_errors_would_be_seen(tmp_path: Path) -> None:
    page = tmp_path / "bad.html"
    page.write_text('<meta http-equiv="Content-Security-Policy" content="img-src data:"><img src="x.png">')
    assert complaints(browse(tmp_path, page, f"--screenshot={tmp_path}/bad.png"))


@pytest.mark.parametrize("kinds", [("stepped",), ("recipe",), ("harmonic", "voids", "temperatures", "relaxation")])
def test_report_opens_and_prints_on_a4(kinds: tuple[str, ...], tmp_path: Path) -> None:
    page = report([make(kind) for kind in kinds], tmp_path / "report.html")
    log = browse(tmp_path, page, f"--screenshot={tmp_path}/page.png", "--window-size=900,2200")
    assert not complaints(log), complaints(log)
    picture = imread(tmp_path / "page.png")[..., :3]
    assert picture.shape[:2] == (2200, 900)
    written = picture.min(axis=2) < 0.98
    assert written[:, 100:800].any(axis=1).mean() > 0.5  # most rows of the page show something
    assert not written[:, -20:].any()  # nothing crosses the right edge of the page
    browse(tmp_path, page, f"--print-to-pdf={tmp_path}/page.pdf", "--no-pdf-header-footer")
    pdf = (tmp_path / "page.pdf").read_bytes()
    boxes = re.findall(rb"/MediaBox\s*\[\s*0\s+0\s+([\d.]+)\s+([\d.]+)", pdf)
    assert boxes and all(np.allclose([float(w), float(h)], [595, 842], atol=1.5) for w, h in boxes)
    assert len(boxes) <= 4 + 3 * len(kinds)


def test_every_picture_is_shown(tmp_path: Path) -> None:
    """Asks the browser for the size of each picture: a picture that it cannot read has size 0."""
    page = report(make("harmonic"), tmp_path / "report.html")
    text = page.read_text(encoding="utf-8")
    probe = tmp_path / "probe.html"
    probe.write_text(
        re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", text).replace(
            "</body>",
            "<script>onload = () => document.title = [...document.images].map(i => i.naturalWidth).join()</script>",
        ),
        encoding="utf-8",
    )
    done = subprocess.run(
        [
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            f"--user-data-dir={tmp_path}/user",
            "--dump-dom",
            probe.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=3600,
    )
    widths = re.search(r"<title>([\d,]+)</title>", done.stdout)
    assert widths and all(int(w) > 100 for w in widths[1].split(","))
    assert len(widths[1].split(",")) == text.count("<img ") >= 8


def test_wide_tables_stay_on_the_page(tmp_path: Path) -> None:
    """The statistics of shapes have eight columns. They must fit on A4, because paper cannot be scrolled."""
    page = report(make("shapes"), tmp_path / "report.html")
    probe = tmp_path / "probe.html"
    probe.write_text(
        re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page.read_text(encoding="utf-8")).replace(
            "</body>",
            "<script>onload = () => document.title = [...document.querySelectorAll('.scroll')]"
            ".map(s => s.scrollWidth - s.clientWidth).join()</script>",
        ),
        encoding="utf-8",
    )
    options = ["--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path}/user", "--window-size=794,1000"]
    done = subprocess.run([CHROMIUM, *options, "--dump-dom", probe.as_uri()], capture_output=True, text=True, timeout=3600)
    over = re.search(r"<title>([\d,]+)</title>", done.stdout)  # 794 pixels are 210 mm
    assert over and not any(map(int, over[1].split(","))), over
