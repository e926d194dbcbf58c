#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures from the CSV of bench/accuracy: draw.py FILE.csv writes FILE-*.png and FILE-*.svg. scripts/documents makes the
tables."""
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
LIMIT = {E_STAR: 1e-5, PHASE: 0.002}  # what a steady start and mixed precision must keep
COLOUR = {"double": "tab:blue", "mixed": "tab:orange", "single": "tab:green"}

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


class Drawing:
    def __init__(self, path):
        self.about, self.rows = read(path)
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
        for kind in ("png", "svg"):
            figure.savefig(f"{self.stem}-{name}.{kind}", dpi=120, metadata={"Date": None} if kind == "svg" else {})
        plt.close(figure)

    def front(self):
        """Error against run time at 20 Hz; the lower left border is the best that can be had."""
        undamped = lambda r: r["start"] == "steady" and r["damping_kind"] == "none"  # noqa: E731
        steady_on_cpu = lambda r: undamped(r) and r["backend"] == "cpu"  # noqa: E731
        for scene in ("t8", "demo", "full"):
            rows = [r for r in done(select(self.rows, scene=scene, frequency_hz=20.0, quadrature="lumped", strain=1e-4,
                                           gap_max="", area_min=""))
                    if r["study"] in ("front", "tolerance", "backend", "damping") and r["backend"] != "reference"
                    or r["study"] == "rest" and r["ramp_cycles"] == 1 and r["cycles"] in (3, 5, 10)]
            if len(rows) < 3:
                continue
            count = int(rows[0]["contacts"])
            figure, axes = self.panels(f"{scene}, {count:,} contacts, 20 Hz: error against the harmonic solution at "
                                       "true mass, and run time")
            marker = {("condensed", "fixed"): "o", ("condensed", "updated"): "s", ("points", "fixed"): "^",
                      ("points", "updated"): "v"}
            for ax, error in zip(axes, (E_STAR, PHASE)):
                for r in rows:
                    steady, gpu = undamped(r), r["backend"] == "cuda"
                    ax.plot(r["seconds"], abs(r[error]), marker[(r["form"], r["geometry"])], ms=10 if gpu else 6,
                            color=COLOUR[r["precision"]] if steady else "none",
                            mec=COLOUR[r["precision"]] if steady else "0.65", alpha=0.8)
                best, border = math.inf, []
                for r in sorted(rows, key=lambda r: r["seconds"]):
                    if steady_on_cpu(r) and abs(r[error]) < 0.9 * best:
                        best = abs(r[error])
                        border.append((r["seconds"], best))
                ax.plot(*zip(*border), "k-", lw=1, zorder=0)
                ax.set(xscale="log", yscale="log", xlabel="run time of the stepping (s)", ylabel=LABEL[error])
                for scaling in sorted({r["density_scaling"] for r in rows if r["study"] == "front"}):
                    y = abs(next(r[error] for r in rows
                                 if r["study"] == "front" and r["density_scaling"] == scaling))
                    ax.annotate(f"scaling\n{scaling:g}", (1.01, y), xycoords=("axes fraction", "data"), ha="left",
                                va="center", fontsize=7, color="0.3")
            line = matplotlib.lines.Line2D
            axes[0].legend(**BELOW, handles=[
                *(line([], [], ls="", marker="o", color=c, label=f"{p}, steady start, 1 cycle")
                  for p, c in COLOUR.items()),
                line([], [], ls="", marker="o", mfc="none", mec="0.65", label="from rest (ramp; 3, 5, 10 cycles) or damped"),
                line([], [], color="k", lw=1, label="best of the steady starts")])
            axes[1].legend(**BELOW, handles=[
                *(line([], [], ls="", marker=m, color="0.3", label=f"{form}, {geometry}")
                  for (form, geometry), m in marker.items()),
                *([line([], [], ls="", marker="o", ms=10, color="0.3", label="cuda")]
                  if any(r["backend"] == "cuda" for r in rows) else [])])
            self.save(figure, f"front-{scene}")

    def drift_differences(self):
        """(row, difference from double) at the same settings; from the harmonic solution where double was not run."""
        rows = done(select(self.rows, study="drift"))
        key = lambda r: (r["scene"], r["mix"], r["frequency_hz"], r["density_scaling"], r["cycles"], r["geometry"])  # noqa: E731
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
        figure, axes = self.panels("t8: what rounding leaves after so many steps (difference from double precision, which is that from the "
                                   "harmonic solution)")
        pairs = [(r, d) for r, d in self.drift_differences() if r["scene"] == "t8"]
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for precision in ("single", "mixed"):
                for f, cycles, mark, label in ((20.0, False, "o-", "20 Hz, 1 cycle"), (2.0, False, "s-", "2 Hz, 1 cycle"),
                                               (20.0, True, "x--", "20 Hz, 1 to 16 cycles")):
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
                    ax.plot(*zip(*updated), "D", color=COLOUR[precision], mfc="none", ms=7, label=f"{precision}, updated")
            ax.axhline(LIMIT[error], color="0.4", ls=":", label="asked of mixed")
            ax.set(xscale="log", yscale="log", xlabel="steps", ylabel=LABEL[error].replace("error", "difference"))
            bottom, top = ax.get_ylim()
            ax.set_ylim(bottom, max(top, 3 * LIMIT[error]))
        axes[0].legend(**BELOW)
        self.save(figure, "drift")

    def rest(self):
        drawn = lambda scene, f: (1e4 if scene == "demo" else 1e3) * (100 if f == 2 else 1)  # noqa: E731
        figure, axes = self.panels("Cycles from rest: error against the steady state with the inertia of the run")
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for i, scene in enumerate(("t8", "demo")):
                for f, colour in ((20.0, ("tab:blue", "tab:cyan")[i]), (2.0, ("tab:red", "tab:orange")[i])):
                    for ramp, style in ((0.0, "o-"), (1.0, "s--")):
                        line = [(r["cycles"], abs(r[OWN[error]])) for r in
                                    done(select(self.rows, study="rest", scene=scene, frequency_hz=f, start="rest",
                                            ramp_cycles=ramp, density_scaling=drawn(scene, f)))]
                        if line:
                            ax.plot(*zip(*line), style, ms=4, lw=1, color=colour,
                                    label=f"{scene}, {f:g} Hz{', ramp of a cycle' if ramp else ''}")
                    for r in done(select(self.rows, study="rest", scene=scene, frequency_hz=f, start="steady",
                                         density_scaling=drawn(scene, f))):
                        ax.plot(1, abs(r[OWN[error]]), "*", ms=11, color=colour, mec="k", mew=0.5)
            ax.plot([], [], "*", ms=11, color="w", mec="k", label="steady start, one cycle")
            ax.axhline(LIMIT[error], color="0.4", ls=":")
            ax.set(xscale="log", yscale="log", xlabel="cycles stepped (two of four or more are fitted, else one)",
                   ylabel=LABEL[error])
            ticks = [1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 30, 40]
            ax.set_xticks([t for t in ticks if t <= ax.get_xlim()[1]], minor=False)
            ax.xaxis.set_major_formatter(matplotlib.ticker.ScalarFormatter())
            ax.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axes[0].legend(**BELOW)
        self.save(figure, "rest")

    def step_share(self):
        figure, axes = self.panels("Time step: error against the harmonic solution with the inertia of the run, 20 Hz")
        rows = select(self.rows, study="step_share")
        for ax, error in zip(axes, (E_STAR, PHASE)):
            for scene, start, style in (("t8", "steady", "o-"), ("demo", "steady", "s-"), ("t8", "rest", "^--")):
                some = sorted(select(rows, scene=scene, start=start), key=lambda r: r["step_share"])
                label = f"{scene}, " + ("steady start, 1 cycle" if start == "steady" else "from rest without ramp, 5 cycles")
                if some:
                    line, = ax.plot([r["step_share"] for r in done(some)], [abs(r[OWN[error]]) for r in done(some)],
                                    style, ms=5, lw=1, label=label)
                    unstable = [r["step_share"] for r in some if r["status"] == "diverged"]
                    if unstable:
                        ax.axvline(min(unstable), color=line.get_color(), ls=":", lw=1)
            if any(r["status"] == "diverged" for r in rows):
                ax.plot([], [], ":", color="0.4", label="first step that diverges")
            ax.set(yscale="log", xlabel="step / computed critical step", ylabel=LABEL[error])
        axes[0].legend(**BELOW)
        self.save(figure, "step-share")

    def strain_and_damping(self):
        figure, axes = self.panels("20 Hz: what strain, and what damping, do to |E*| and φ")
        ax = axes[0]
        for scene, mark in (("t8", "o"), ("demo", "s")):
            for error, colour, unit in ((E_STAR, "tab:blue", "|E*| (relative)"), (PHASE, "tab:red", "φ (degrees)")):
                for cycles, style in ((1.0, "-"), (4.0, "--")):
                    line = [(r["strain"], abs(r[OWN[error]])) for r in
                            done(select(self.rows, study="strain", scene=scene, geometry="updated", cycles=cycles))]
                    if line:
                        ax.plot(*zip(*line), mark + style, color=colour, ms=4, lw=1,
                                label=f"{scene}, {unit}, {cycles:g} cycle{'s' if cycles > 1 else ''}")
        ax.set(xscale="log", yscale="log", xlabel="strain amplitude", title="strain: updated against fixed geometry",
               ylabel="difference from the linear solution")
        ax.legend(**BELOW)
        ax = axes[1]
        for scaling, mark in ((1e2, "o"), (1e4, "s")):
            for kind, colour in (("local", "tab:blue"), ("viscous", "tab:green")):
                for error, style in ((E_STAR, "-"), (PHASE, "--")):
                    line = [(r["damping"], abs(r[error])) for r in
                            done(select(self.rows, study="damping", damping_kind=kind, density_scaling=scaling))]
                    if line:
                        ax.plot(*zip(*line), mark + style, color=colour, ms=4, lw=1,
                                label=f"{kind}, scaling {scaling:g}, " + ("|E*|" if error == E_STAR else "φ (degrees)"))
        ax.set(xscale="log", yscale="log", xlabel="χ of local damping, β (1/s) of viscous", title="damping, t8 (local: from rest, viscous: steady start)",
               ylabel="error against true mass, undamped")
        ax.legend(**BELOW)
        self.save(figure, "strain-damping")


def main():
    drawing = Drawing(Path(sys.argv[1]))
    matplotlib.rcParams["svg.hashsalt"] = "macadam"
    for draw in (drawing.front, drawing.drift, drawing.rest, drawing.step_share, drawing.strain_and_damping):
        draw()


if __name__ == "__main__":
    main()
