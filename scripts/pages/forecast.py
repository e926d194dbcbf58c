# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/forecast.md: the forecasts of macadam check compared with runs, from forecast.csv of
bench/forecast/run."""
from pages.data import head, rows, table, thousands
from pages.marks import mark

DOCUMENT = "docs/forecast.md"


def cases():
    return rows("forecast.csv")


def ratio(foretold, found):
    return f"{foretold / found:.2f}" if found else ""


@mark
def foretold():
    lines = [(r["scene"], r["method"], thousands(r["particles"]), ratio(r["particles_foretold"], r["particles"]),
              ratio(r["contacts_foretold"], r["contacts"]), ratio(r["steps_foretold"], r["steps"]),
              f"{r['memory_mb']:.0f}", ratio(r["memory_foretold_mb"], r["memory_mb"]), f"{r['processor_s'] / r['threads']:.1f}",
              ratio(r["time_foretold_s"], r["processor_s"] / r["threads"]), f"{r['check_s']:.2f}") for r in cases()]
    return table(["scene", "method", "particles", "their number", "contacts", "steps", "memory (MB)", "memory",
                  "time (s)", "time", "check (s)"], lines, range(2, 11))


@mark
def where_measured():
    first = cases()[0]
    note = head("forecast.csv")[0].partition("; ")[2]
    return f"{first['machine']}, {first['threads']:.0f} threads, {first['date']}; {note}"


@mark
def foretold_large():
    """Returns the table of measured gigabytes and seconds, each followed by its ratio to the forecast."""
    lines = []
    for r in rows("forecast-large.csv"):
        line = [r["scene"], r["method"], r["device"] or f"{r['threads']:.0f} threads", thousands(r["particles"])]
        for found, said, form in ((r["memory_mb"] / 1e3, r["memory_foretold_mb"] / 1e3, "{:.1f}"),
                                  (r["device_mb"] / 1e3, r["device_foretold_mb"] / 1e3, "{:.1f}"), (r["wall_s"], r["time_foretold_s"], "{:.0f}")):
            line += [form.format(found) if found else "", ratio(said, found)]
        lines.append(line)
    return table(["scene", "method", "on", "particles", "memory (GB)", "memory", "of the GPU (GB)", "of the GPU", "time (s)", "time"], lines,
                 range(3, 10))


@mark
def filled_host():
    """Returns the host memory that was predicted for the run with the most GPU memory [GB]."""
    fullest = max(rows("forecast-large.csv"), key=lambda r: r["device_mb"])
    return f"{fullest['memory_foretold_mb'] / 1e3:.0f}"
