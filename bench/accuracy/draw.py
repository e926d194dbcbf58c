#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws figures from the CSV of bench/accuracy: `draw.py FILE.csv` writes FILE-*.png. The tables are
made by scripts/documents."""
import csv
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

E_STAR, PHASE = "error_e_star", "error_phase_deg"
OWN = {E_STAR: "own_error_e_star", PHASE: "own_error_phase_deg"}
LABEL = {E_STAR: "error of |E*| (relative)", PHASE: "error of φ (degrees)"}
LIMIT = {E_STAR: 1e-5, PHASE: 0.002}  # errors that a steady start in mixed precision must not exceed
COLOUR = {"double": "tab:blue", "mixed": "tab:orange", "single": "tab:green"}
MARKER = {("condensed", "fixed"): "o", ("condensed", "updated"): "s", ("points", "fixed"): "^",
          ("points", "updated"): "v"}
LINE = matplotlib.lines.Line2D
USUAL = {"frequency_hz": 20.0, "quadrature": "lumped", "strain": 1e-4, "gap_max": "", "area_min": ""}
BELOW = {"fontsize": 8, "loc": "upper center", "bbox_to_anchor": (0.5, -0.14), "ncols": 2}


def read(path):
    about, lines = {}, []
    for line in open(path, encoding="utf-8"):
        if line.startswith("# "):
            key, value = line[2:].strip().split(": ", 1)
            about[key] = value
        else:
            lines.append(line)
    rows = list(csv.DictReader(lines))
    for row in rows:
        for key, value in row.items():
            try:
                row[key] = float(value)
            except ValueError:
                pass
    return about, rows


def select(rows, **wanted):
    return [r for r in rows if all(r[k] == v for k, v in wanted.items())]


def done(rows):
    return [r for r in rows if r["status"] == "done"]


def way(row):
    return row["form"], row["geometry"]


def dot(marker="o", **look):
    return LINE([], [], ls="", marker=marker, **look)


class Drawing:
    def __init__(self, path):
        self.about, self.rows = read(path)
        self.am1 = [r for r in self.rows if r["mix"] == "AM1"]
        self.stem = path.with_suffix("")

    def panels(self, title, count=2, height=5.0):
        figure, axes = plt.subplots(1, count, figsize=(5.6 * count, height), layout="constrained")
        figure.suptitle(title, fontsize=11)
        matplotlib.rcParams["axes.titlesize"] = 10
        for ax in axes:
            ax.grid(True, which="major", alpha=0.3)
        return figure, axes

    def save(self, figure, name):
        note = f"{self.about['machine']}, {self.about['date']}"
        figure.supxlabel(note + (", " + self.about["note"] if "note" in self.about else ""), fontsize=7, color="grey")
        figure.savefig(f"{self.stem}-{name}.png", dpi=120)
        plt.close(figure)

    def front(self, name, mix="AM1"):
        """Draws the error against the run time at 20 Hz. The line connects the best settings: no run is both faster
        and more accurate."""
        rows = [r for r in done(select(self.rows, scene=name, mix=mix, **USUAL))
                if r["study"] in ("front", "tolerance", "backend") and r["backend"] != "reference"
                or r["study"] == "damping" and r["damping_kind"] != "none"
                or r["study"] == "rest" and r["ramp_cycles"] == 1 and r["cycles"] in (3, 5, 10)]
        if len(rows) < 3:
            return

        def steady(r):
            return r["start"] == "steady" and r["damping_kind"] == "none"
        figure, axes = self.panels(f"{name}, {int(rows[0]['contacts']):,} contacts, {mix}, 20 Hz: error against the "
                                   "harmonic solution at true mass, and run time")
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for r in rows:
                colour = COLOUR[r["precision"]] if steady(r) else "0.65"
                ax.plot(r["seconds"], abs(r[error]), MARKER[way(r)], ms=10 if r["backend"] == "cuda" else 6, mec=colour,
                        color=colour if steady(r) else "none", alpha=0.8)
            best, border = math.inf, []
            for r in sorted(rows, key=lambda r: r["seconds"]):
                if steady(r) and r["backend"] == "cpu" and abs(r[error]) < 0.9 * best:
                    best = abs(r[error])
                    border.append((r["seconds"], best))
            ax.plot(*zip(*border), "k-", lw=1, zorder=0)
            ax.set(xscale="log", yscale="log", xlabel="run time of the stepping (s)", ylabel=LABEL[error])
            self.scalings(ax, rows, error)
        other = [what for what, damped in (("from rest (ramp; 3, 5, 10 cycles)", False), ("damped", True))
                 if any(not steady(r) and (r["damping_kind"] != "none") == damped for r in rows)]
        axes[0].legend(**BELOW, handles=[
            *(dot(color=c, label=f"{p}, steady start, 1 cycle") for p, c in COLOUR.items()
              if any(steady(r) and r["precision"] == p for r in rows)),
            *([dot(mfc="none", mec="0.65", label=" or ".join(other))] if other else []),
            LINE([], [], color="k", lw=1, label="best of the steady starts")])
        axes[1].legend(**BELOW, handles=[
            *self.ways(rows), *([dot(ms=10, color="0.3", label="cuda")] if any(r["backend"] == "cuda" for r in rows)
                                else [])])
        self.save(figure, f"front-{name}")

    def front_clusters(self):
        """Draws the error against the run time for clusters and for binder AM2, for the steady start only."""
        groups = {("clusters", "AM1"): "tab:purple", ("clusters", "AM2"): "tab:red", ("seed 101", "AM2"): "tab:brown"}
        found = {group: [r for r in done(select(self.rows, scene=group[0], mix=group[1], **USUAL))
                         if r["study"] in ("front", "tolerance")] for group in groups}
        rows = [r for of in found.values() for r in of]
        if not rows:
            return
        figure, axes = self.panels("Clusters and AM2, 20 Hz: error against the harmonic solution at true mass, and run "
                                   "time (steady start, 1 cycle)")
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for group, of in found.items():
                for r in of:
                    ax.plot(r["seconds"], abs(r[error]), MARKER[way(r)], ms=6, mec=groups[group],
                            color=groups[group] if r["study"] == "front" else "none", alpha=0.8)
            ax.set(xscale="log", yscale="log", xlabel="run time of the stepping (s)", ylabel=LABEL[error])
        axes[0].legend(**BELOW, handles=[
            *(dot(color=groups[group], label=f"{group[0]}, {group[1]}, {int(of[0]['contacts']):,} contacts")
              for group, of in found.items() if of),
            *(dot(mec="0.3", color="0.3" if study == "front" else "none", label=label)
              for study, label in (("front", "mixed, scalings of 10 to 1e5"), ("tolerance", "chosen by a tolerance"))
              if any(r["study"] == study for r in rows))])
        axes[1].legend(**BELOW, handles=self.ways(rows))
        self.save(figure, "front-clusters")

    def ways(self, rows):
        """Returns the legend entries of the forms and geometries that occur in the rows."""
        return [dot(marker=m, color="0.3", label=", ".join(key)) for key, m in MARKER.items()
                if any(way(r) == key for r in rows)]

    def scalings(self, ax, rows, error):
        front = [r for r in rows if r["study"] == "front"]
        for scaling in sorted({r["density_scaling"] for r in front}):
            y = abs(next(r[error] for r in front if r["density_scaling"] == scaling))
            ax.annotate(f"scaling\n{scaling:g}", (1.01, y), xycoords=("axes fraction", "data"), ha="left", va="center",
                        fontsize=7, color="0.3")

    def drift_differences(self):
        """Yields (row, difference from double precision at the same settings). If there is no run in double precision
        at these settings, the difference from the frequency-domain solution is taken instead."""
        rows = done(select(self.rows, study="drift"))
        def key(r):
            return tuple(r[k] for k in ("scene", "mix", "frequency_hz", "density_scaling", "cycles", "geometry"))
        double = {key(r): r for r in rows if r["precision"] == "double"}
        for r in rows:
            if r["precision"] == "double":
                continue
            d = double.get(key(r))
            if d:
                yield r, {E_STAR: r["e_star_pa"] / d["e_star_pa"] - 1, PHASE: r["phase_deg"] - d["phase_deg"]}
            else:
                yield r, {e: r[OWN[e]] for e in (E_STAR, PHASE)}

    def drift(self):
        figure, axes = self.panels("t8, AM1: difference from double precision over the number of steps "
                                   "(from the harmonic solution where double was not run)")
        pairs = [(r, d) for r, d in self.drift_differences() if (r["scene"], r["mix"]) == ("t8", "AM1")]
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for precision in ("single", "mixed"):
                for f, cycles, mark, label in ((20.0, False, "o-", "20 Hz, 1 cycle"),
                                               (2.0, False, "s-", "2 Hz, 1 cycle"),
                                               (20.0, True, "x--", "20 Hz, 2 to 16 cycles")):
                    line = sorted((r["steps"], abs(d[error])) for r, d in pairs
                                  if r["precision"] == precision and r["frequency_hz"] == f and d[error] != 0
                                  and r["geometry"] == "fixed"
                                  and ((r["density_scaling"] == 1e3 and r["cycles"] > 1) if cycles
                                       else r["cycles"] == 1))
                    if line:
                        ax.plot(*zip(*line), mark, color=COLOUR[precision], label=f"{precision}, {label}", ms=5, lw=1)
                updated = [(r["steps"], abs(d[error])) for r, d in pairs
                           if r["precision"] == precision and r["geometry"] == "updated"]
                if updated:
                    ax.plot(*zip(*updated), "D", color=COLOUR[precision], mfc="none", ms=7,
                            label=f"{precision}, updated geometry")
            ax.axhline(LIMIT[error], color="0.4", ls=":", label="limit for mixed precision")
            ax.set(xscale="log", yscale="log", xlabel="steps", ylabel=LABEL[error].replace("error", "difference"))
            bottom, top = ax.get_ylim()
            ax.set_ylim(bottom, max(top, 3 * LIMIT[error]))
        axes[0].legend(**BELOW)
        self.save(figure, "drift")

    def rest(self):
        def drawn(scene, f):
            return (1e4 if scene == "demo" else 1e3) * (100 if f == 2 else 1)
        figure, axes = self.panels("Cycles from rest, AM1: error against the steady state with the inertia of the run")
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for i, scene in enumerate(("t8", "demo")):
                for f, colour in ((20.0, ("tab:blue", "tab:cyan")[i]), (2.0, ("tab:red", "tab:orange")[i])):
                    for ramp, style in ((0.0, "o-"), (1.0, "s--")):
                        line = [(r["cycles"], abs(r[OWN[error]])) for r in
                                    done(select(self.am1, study="rest", scene=scene, frequency_hz=f, start="rest",
                                            ramp_cycles=ramp, density_scaling=drawn(scene, f)))]
                        if line:
                            ax.plot(*zip(*line), style, ms=4, lw=1, color=colour,
                                    label=f"{scene}, {f:g} Hz{', ramp of a cycle' if ramp else ''}")
                    for r in done(select(self.am1, study="rest", scene=scene, frequency_hz=f, start="steady",
                                         density_scaling=drawn(scene, f))):
                        ax.plot(1, abs(r[OWN[error]]), "*", ms=11, color=colour, mec="k", mew=0.5)
            ax.plot([], [], "*", ms=11, color="w", mec="k", label="steady start, one cycle")
            ax.axhline(LIMIT[error], color="0.4", ls=":", label="1e-5 and 0.002°")
            ax.set(xscale="log", yscale="log", xlabel="cycles stepped (two of four or more are fitted, else one)",
                   ylabel=LABEL[error])
            ticks = [1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 30, 40]
            ax.set_xticks([t for t in ticks if t <= ax.get_xlim()[1]], minor=False)
            ax.xaxis.set_major_formatter(matplotlib.ticker.ScalarFormatter())
            ax.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axes[0].legend(**BELOW)
        self.save(figure, "rest")

    def strain(self):
        figure, axes = self.panels("Strain, AM1, 20 Hz: updated geometry against the linear solution")
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for scene, mark, colour in (("t8", "o", "tab:blue"), ("demo", "s", "tab:orange")):
                for cycles, style in ((1.0, "-"), (4.0, "--")):
                    line = [(r["strain"], abs(r[OWN[error]])) for r in
                            done(select(self.am1, study="strain", scene=scene, geometry="updated", cycles=cycles))]
                    if line:
                        ax.plot(*zip(*line), mark + style, color=colour, ms=4, lw=1,
                                label=f"{scene}, {cycles:g} cycle{'s' if cycles > 1 else ''}")
            ax.set(xscale="log", yscale="log", xlabel="strain amplitude",
                   ylabel=LABEL[error].replace("error", "change"))
        axes[0].legend(**BELOW)
        self.save(figure, "strain")

    def damping(self):
        figure, axes = self.panels("Damping, t8, AM1, 20 Hz (local: from rest, viscous: steady start)")
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for scaling, mark in ((1e2, "o-"), (1e4, "s--")):
                for kind, colour in (("local", "tab:blue"), ("viscous", "tab:orange")):
                    line = [(r["damping"], abs(r[error])) for r in
                            done(select(self.am1, study="damping", scene="t8", damping_kind=kind,
                                        density_scaling=scaling))]
                    if line:
                        ax.plot(*zip(*line), mark, color=colour, ms=4, lw=1, label=f"{kind}, scaling {scaling:g}")
            ax.set(xscale="log", yscale="log", xlabel="χ of local damping, β (1/s) of viscous damping",
                   ylabel=LABEL[error])
        axes[0].legend(**BELOW)
        self.save(figure, "damping")


def main():
    drawing = Drawing(Path(sys.argv[1]))
    drawing.front("t8")
    drawing.front("demo")
    drawing.front_clusters()
    for draw in (drawing.drift, drawing.rest, drawing.strain, drawing.damping):
        draw()


if __name__ == "__main__":
    main()
