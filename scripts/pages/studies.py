# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/studies.md, from study.csv (one row per result) and study-time.csv of bench/study/run."""
from pages.data import between, mean, rows, table, where
from pages.marks import mark

DOCUMENT = "docs/studies.md"


def of(voids, binder):
    """Returns |E*| of a mix for each seed [MPa]."""
    return [r["e_star_mpa"] for r in where(rows("study.csv"), air_voids_percent=voids, binder_percent=binder)]


def values(name):
    return sorted({r[name] for r in rows("study.csv")})


def scatter(found):
    """Returns the standard deviation of the seeds of a mix relative to their mean, pooled over all mixes."""
    spread = [sum((e / mean(es) - 1) ** 2 for e in es) / (len(es) - 1) for es in found]
    return mean(spread) ** 0.5


@mark
def modulus():
    return table(["air voids (%)", *(f"\\|E\\*\\| (MPa) at {b:g} % of binder" for b in values("binder_percent"))],
                 [[f"{v:g}", *(f"{mean(of(v, b)):.0f}" for b in values("binder_percent"))] for v in values("air_voids_percent")],
                 range(5))


@mark
def minutes():
    return f"{rows('study-time.csv')[0]['wall_s'] / 60:.1f}"


@mark
def processor_minutes():
    return f"{rows('study-time.csv')[0]['processor_s'] / 60:.1f}"


@mark
def workers():
    return f"{rows('study-time.csv')[0]['workers']:g}"


@mark
def results():
    return f"{rows('study-time.csv')[0]['results']:g}"


@mark
def particles():
    return between([r["particles"] for r in rows("study.csv")], "{:,.0f}")


@mark
def seeds():
    """Returns the pooled standard deviation of single seeds, %."""
    return f"{100 * scatter([of(v, b) for v in values('air_voids_percent') for b in values('binder_percent')]):.1f}"


@mark
def lost(name):
    """Returns the loss of |E*| from the lowest to the highest value of one factor, averaged over the other, %."""
    other = values("binder_percent" if name == "air_voids_percent" else "air_voids_percent")
    first, last = (mean(mean(of(v, o) if name == "air_voids_percent" else of(o, v)) for o in other)
                   for v in (values(name)[0], values(name)[-1]))
    return f"{100 * (1 - last / first):.0f}"
