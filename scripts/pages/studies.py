# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/studies.md: from bench/study/run's study.csv, a row a result, and study-time.csv."""
from pages.data import between, mean, rows, table, where
from pages.marks import mark

DOCUMENT = "docs/studies.md"


def of(voids, binder):
    """|E*| of the seeds of a mix, MPa."""
    return [r["e_star_mpa"] for r in where(rows("study.csv"), air_voids_percent=voids, binder_percent=binder)]


def values(name):
    return sorted({r[name] for r in rows("study.csv")})


def scatter(found):
    """Standard deviation of the seeds of each mix over their mean, pooled."""
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
    """Pooled standard deviation of single seeds, %."""
    return f"{100 * scatter([of(v, b) for v in values('air_voids_percent') for b in values('binder_percent')]):.1f}"


@mark
def lost(name):
    """|E*| from the least to the most of one factor, the mean over the other, %."""
    other = values("binder_percent" if name == "air_voids_percent" else "air_voids_percent")
    first, last = (mean(mean(of(v, o) if name == "air_voids_percent" else of(o, v)) for o in other)
                   for v in (values(name)[0], values(name)[-1]))
    return f"{100 * (1 - last / first):.0f}"
