# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/choose-settings.md on `[solver] tolerance`: the error asked for, predicted and achieved."""
import math

from pages.accuracy_rows import E, PHI, TRUE_E, TRUE_PHI, done, scene, scenes, study, tried
from pages.data import downto, listed, minus, plain, power, span, table, thousands, upto
from pages.marks import mark


def asked():
    return study("tolerance")


def achieved(r):
    return max(abs(r[TRUE_E]), abs(math.radians(r[TRUE_PHI])))


def off(r):
    """Returns the difference between achieved and predicted result; the prediction is the harmonic solution with the
    inertia of the run."""
    predicted = (1 + r[TRUE_E]) / (1 + r[E]) - 1
    return max(abs(r[TRUE_E] - predicted), math.radians(abs(r[PHI])))


@mark
def tolerance():
    lines, runs = [], tried("tolerance")
    for name in scenes(runs):
        for value in sorted({r["tolerance"] for r in runs if scene(r) == name}, reverse=True):
            of = [r for r in asked() if scene(r) == name and r["tolerance"] == value]
            if not of:
                lines.append((name, minus(power(value, 1)), "none: all failed", *["–"] * 5))
                continue
            hand = [r["seconds"] / r["seconds_by_hand"] for r in of if r["seconds_by_hand"]
                    and math.isfinite(r["seconds_by_hand"])]
            at = ", ".join(f"{f:g}" for f in sorted({r["frequency_hz"] for r in of}))
            lines.append((name, minus(power(value, 1)), at,
                          plain(upto(max(achieved(r) for r in of) / value, 3), 3),
                          minus(power(upto(max(off(r) for r in of)))), span([r["steps"] for r in of], thousands),
                          span([r["seconds"] for r in of], plain),
                          f"{downto(min(hand)):.1f} … {upto(max(hand)):.1f}" if hand else "–"))
    return table(["scene", "asked", "f (Hz)", "largest error achieved / asked",
                  "largest difference from the prediction", "steps",
                  "stepping (s, one thread)", "time / fastest found by trial"], lines)


@mark
def tolerance_kept():
    kept, runs = [r for r in asked() if achieved(r) <= r["tolerance"]], tried("tolerance")
    failed = len(runs) - len(done(runs))
    return (f"in all {len(runs)} runs" if len(kept) == len(runs) else
            f"in {len(kept)} of {len(runs)} runs" + (f"; {failed} failed" if failed else ""))


@mark
def by_hand_worst():
    of = [r["seconds"] / r["seconds_by_hand"] for r in asked() if r["seconds_by_hand"]]
    return plain(upto(max(of)))


def prediction_off(of):
    """Returns the largest difference from the prediction, in % of the tolerance asked for."""
    return plain(100 * upto(max(off(r) / r["tolerance"] for r in of))) + " %"


@mark
def predictions():
    values = sorted({r["tolerance"] for r in asked()}, reverse=True)
    return listed(f"{prediction_off([r for r in asked() if r['tolerance'] == v])} of {minus(power(v, 1))}"
                  for v in values)


@mark
def chosen():
    ways = sorted({f"{r['precision']} precision, {r['geometry']} geometry" for r in asked()})
    return "; ".join(ways)
