# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports in a browser (Chromium without a window). They open without a network and without an error on the console, a
screenshot shows them, and they print on A4."""

from __future__ import annotations

import http.server
import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from macadam.report import report, specimen
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


# Measures the fraction of blue pixels of the view, for each position of the cut, and posts the fractions.
PROBE = """<script>
const post = (body) => fetch("http://127.0.0.1:PORT/", { method: "POST", mode: "no-cors", body });
onerror = (message) => post(JSON.stringify(String(message)));
const measure = async () => {
  if (!document.documentElement.dataset.ready) { setTimeout(measure, 50); return; }
  const view = await K3DInstance, cut = document.getElementById("cut"), found = [];
  for (cut.value of [0, 0.9]) {
    cut.dispatchEvent(new Event("input"));
    const canvas = await view.getScreenshot(1, true);
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    let blue = 0;
    for (let k = 0; k < pixels.length; k += 4) blue += pixels[k + 2] > pixels[k] + 38 && pixels[k + 2] > pixels[k + 1] + 25;
    found.push(blue / (pixels.length / 4));
  }
  post(JSON.stringify(found));
};
measure();
</script></body>"""


class Answer(http.server.BaseHTTPRequestHandler):
    """Keeps what the page posts."""

    def do_POST(self) -> None:
        self.server.answer = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *arguments: object) -> None:
        pass


def test_the_view_in_three_dimensions_is_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A software renderer draws the view. The mastic is blue; a cut that leaves a tenth of the specimen removes blue."""
    pytest.importorskip("k3d", reason="no package k3d: pip install 'macadam[view]'")
    monkeypatch.setattr(specimen, "MOST", 0)
    report(make("harmonic"), tmp_path / "r.html", view=True)
    page = (tmp_path / "r-3d.html").read_text(encoding="utf-8")
    with http.server.HTTPServer(("127.0.0.1", 0), Answer) as server:
        server.answer = None
        server.timeout = 3600
        probe = tmp_path / "probe.html"
        without_policy = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
        probe.write_text(without_policy.replace("</body>", PROBE.replace("PORT", str(server.server_port))), encoding="utf-8")
        line = [CHROMIUM, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                f"--user-data-dir={tmp_path}/user", "--window-size=900,700", "--remote-debugging-port=0", probe.as_uri()]  # fmt: skip
        browser = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            server.handle_request()
        finally:
            browser.terminate()
            browser.wait()
    # the specimen covers a third of the window, and most of what is seen of it is mastic
    assert isinstance(server.answer, list), server.answer
    assert server.answer[0] > 0.1 and server.answer[1] < 0.7 * server.answer[0], server.answer


def test_the_view_in_three_dimensions_asks_for_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("k3d", reason="no package k3d: pip install 'macadam[view]'")
    monkeypatch.setattr(specimen, "MOST", 0)
    report(make("harmonic"), tmp_path / "r.html", view=True)
    log = browse(tmp_path, tmp_path / "r-3d.html", f"--screenshot={tmp_path}/view.png")
    # K3D reports its start, and the browser that K3D may not look for fonts beside the page. The browser draws nothing
    # here, because it runs without WebGL.
    blocked = [line for line in complaints(log) if "Content Security Policy" in line and "Loading the font 'file:" not in line]
    assert not blocked and "http" not in "".join(complaints(log)).replace("http-equiv", ""), complaints(log)
