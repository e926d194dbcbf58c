#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures and tables from the CSV of bench/accuracy: draw.py FILE.csv writes FILE-*.png, FILE-*.svg, FILE-tables.md."""
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

    def table(self, title, heads, lines):
        text = [f"## {title}", "", "| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
        return "\n".join(text + ["| " + " | ".join(str(x) for x in line) + " |" for line in lines]) + "\n"

    def tables(self):
        scaled = lambda r: f"{r['density_scaling']:g}"  # noqa: E731
        errors = lambda r, which=lambda e: e: (f"{r[which(E_STAR)]:+.1e}", f"{r[which(PHASE)]:+.1e}")  # noqa: E731
        cost = lambda r: (int(r["steps"]), f"{r['seconds']:.3g}", f"{1e6 * r['seconds'] / r['steps']:.3g}",  # noqa: E731
                          f"{r['bytes'] / 1024:.0f}")
        of = lambda study: done(select(self.rows, study=study))  # noqa: E731
        name = lambda r: r["scene"] + ("" if r["mix"] == "AM1" else f", {r['mix']}")  # noqa: E731
        parts = [f"# Tables of {self.stem.name}.csv\n\n{self.about['machine']}, {self.about['date']}, "
                 f"list {self.about['list']}. {self.about.get('note', '')}\n"]
        parts.append(self.table("Error against run time, steady start, one cycle", [
            "scene", "f", "scaling", "form", "precision", "geometry", "\\|E\\*\\|", "φ (°)", "steps", "s", "µs a step",
            "KiB"], [(name(r), f"{r['frequency_hz']:g}", scaled(r), r["form"], r["precision"], r["geometry"],
                      *errors(r), *cost(r)) for r in of("front")]))
        parts.append(self.table("Drift: difference from double", ["scene", "f", "scaling", "cycles", "steps", "precision",
                                                                  "\\|E\\*\\|", "φ (°)"],
                                [(name(r), f"{r['frequency_hz']:g}", scaled(r), int(r["cycles"]), int(r["steps"]),
                                  r["precision"], f"{d[E_STAR]:+.1e}", f"{d[PHASE]:+.1e}")
                                 for r, d in self.drift_differences()]))
        lines = []
        for scene in ("t8", "demo"):
            for f in (20.0, 2.0):
                rest = done(select(self.rows, study="rest", scene=scene, frequency_hz=f, start="rest"))
                for scaling, ramp in sorted({(r["density_scaling"], r["ramp_cycles"]) for r in rest}):
                    rows = select(rest, ramp_cycles=ramp, density_scaling=scaling)

                    def needed(e_star, phase):
                        bad = [r["cycles"] for r in rows
                               if abs(r[OWN[E_STAR]]) > e_star or abs(r[OWN[PHASE]]) > phase]
                        after = [r["cycles"] for r in rows if r["cycles"] > max(bad, default=0)]
                        return f"{after[0]:g}" if after else f"> {rows[-1]['cycles']:g}"
                    lines.append((scene, f"{f:g}", f"{scaling:g}", f"{ramp:g}",
                                  *(needed(t, math.degrees(t)) for t in (1e-2, 1e-3, 1e-4)),
                                  needed(1e-5, 0.002)))
        parts.append(self.table("Cycles from rest until the error stays below", ["scene", "f", "scaling", "ramp", "1e-2", "1e-3",
                                                                                 "1e-4", "1e-5 and 0.002°"], lines))
        parts.append(self.table("Strain, updated geometry, against the linear solution",
                                ["scene", "strain", "cycles", "\\|E\\*\\|", "φ (°)"],
                                [(r["scene"], f"{r['strain']:g}", int(r["cycles"]), *errors(r, OWN.get))
                                 for r in of("strain") if r["geometry"] == "updated"]))
        parts.append(self.table("Step as a share of the computed critical one, against the same inertia",
                                ["scene", "start", "share", "\\|E\\*\\|", "φ (°)"],
                                [(r["scene"], r["start"], f"{r['step_share']:.2f}",
                                  *(errors(r, OWN.get) if r["status"] == "done" else (r["status"], "")))
                                 for r in select(self.rows, study="step_share")]))
        parts.append(self.table("Damping, against true mass undamped", ["scaling", "damping", "value", "start",
                                                                        "\\|E\\*\\|", "φ (°)"],
                                [(scaled(r), r["damping_kind"], f"{r['damping']:g}", r["start"], *errors(r))
                                 for r in of("damping")]))
        base = {(r["scene"]): r["contacts"] for r in select(self.rows, study="filter", gap_max="", area_min="")}
        parts.append(self.table("Quadrature and filters: change of the model, and error against its own solution",
                                ["scene", "f", "quadrature", "gap_max", "area_min", "contacts dropped",
                                 "\\|E\\*\\| model", "φ model (°)", "\\|E\\*\\| own", "φ own (°)", "µs a step"],
                                [(name(r), f"{r['frequency_hz']:g}", r["quadrature"], r["gap_max"], r["area_min"],
                                  int(base[r["scene"]] - r["contacts"]), f"{r['model_e_star']:+.2e}",
                                  f"{r['model_phase_deg']:+.2e}", *errors(r, OWN.get), cost(r)[2])
                                 if r["status"] == "done" else
                                 (name(r), f"{r['frequency_hz']:g}", r["quadrature"], r["gap_max"], r["area_min"],
                                  r["status"][:60], "", "", "", "", "")
                                 for r in self.rows if r["study"] in ("quadrature", "filter")]))
        parts.append(self.table("Backends", ["scene", "backend", "scaling", "precision", "form", "\\|E\\*\\| own",
                                             "φ own (°)", "steps", "s", "µs a step", "KiB"],
                                [(r["scene"], r["backend"], scaled(r), r["precision"], r["form"], *errors(r, OWN.get),
                                  *cost(r)) for r in of("backend")]))
        parts.append(self.table("`[solver] tolerance`", ["scene", "f", "asked", "scaling", "precision", "geometry",
                                                         "\\|E\\*\\| predicted", "\\|E\\*\\| achieved",
                                                         "φ achieved (rad)", "steps", "s", "planning s", "s / by hand"],
                                [(name(r), f"{r['frequency_hz']:g}", f"{r['tolerance']:g}", scaled(r),
                                  r["precision"], r["geometry"],
                                  f"{(1 + r[E_STAR]) / (1 + r[OWN[E_STAR]]) - 1:+.3e}", f"{r[E_STAR]:+.3e}",
                                  f"{math.radians(r[PHASE]):+.2e}", int(r["steps"]), f"{r['seconds']:.3g}",
                                  f"{r['seconds_harmonic']:.2g}",
                                  f"{r['seconds'] / r['seconds_by_hand']:.2f}" if math.isfinite(r["seconds_by_hand"])
                                  else "none found") for r in of("tolerance")]))
        Path(f"{self.stem}-tables.md").write_text("\n".join(parts), encoding="utf-8")


def main():
    drawing = Drawing(Path(sys.argv[1]))
    matplotlib.rcParams["svg.hashsalt"] = "macadam"
    for draw in (drawing.front, drawing.drift, drawing.rest, drawing.step_share, drawing.strain_and_damping,
                 drawing.tables):
        draw()


if __name__ == "__main__":
    main()
