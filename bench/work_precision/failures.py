"""The strip above a chart in which the runs stand that failed."""

import math

from matplotlib.ticker import NullFormatter, NullLocator

from work_precision import solvers, words

MARKERS = {"unstable": "x", "not_converged": "o", "too_slow": ">"}
GLYPHS = {"unstable": "\N{MULTIPLICATION SIGN}", "not_converged": "\N{WHITE CIRCLE}",
          "too_slow": "\N{WHITE RIGHT-POINTING TRIANGLE}"}


def draw(axes, failed, runs, limits, all_names):
    """A row a solver, each failure at its cost, and in short the range of its settings."""
    names = failing(failed)
    axes.set_xscale("log")
    axes.set_xlim(limits)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_facecolor("#f4f4f4")
    for side in ("bottom", "left"):
        axes.spines[side].set_visible(False)
    axes.tick_params(which="both", bottom=False, labelbottom=False, left=False, labelleft=False)
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_locator(NullLocator())
    axes.axvline(1.0, color="#3d7a2b", linewidth=1.0)
    for run in failed:
        axes.plot([place(run, runs, limits)], [names.index(run.solver)],
                  **marker_style(run.status, solvers.look_up(run.solver, all_names).colour))
    for row, name in enumerate(names):
        style = {"fontsize": 7, "va": "center", "color": solvers.look_up(name, all_names).colour,
                 "transform": axes.get_yaxis_transform()}
        axes.text(-0.01, row, name, ha="right", **style)
        axes.text(1.01, row, in_short([run for run in failed if run.solver == name]), **style)


def failing(failed):
    return solvers.in_order(run.solver for run in failed)


def marker_style(status, colour):
    return {"marker": MARKERS[status], "color": colour, "markerfacecolor": "none", "markersize": 5,
            "markeredgewidth": 1.3, "linestyle": "none"}


def place(run, runs, limits):
    """Where a cost is not known, on the rim: of what is too slow, the right one."""
    left, right = 1.08 * limits[0], limits[1] / 1.08
    return cost(run, runs) or (right if run.status == "too_slow" else left)


def cost(run, runs):
    """As measured; else, of a step or of iterations, in proportion from the solver's nearest run that has a cost."""
    if run.seconds_per_second:
        return run.seconds_per_second
    power = {"step": -1.0, "iterations": 1.0}.get(run.setting)
    ladder = (run.solver, run.setting)
    peers = [peer for peer in runs if (peer.solver, peer.setting) == ladder and peer.seconds_per_second]
    if power is None or not peers:
        return None
    nearest = min(peers, key=lambda peer: abs(math.log(peer.value / run.value)))
    return nearest.seconds_per_second * (run.value / nearest.value) ** power


def in_short(failed):
    """Of one solver's: what happened, at which settings."""
    ranges = {}
    for run in failed:
        ranges.setdefault(run.status, {}).setdefault(run.setting, []).append(run.value)
    parts = []
    for status, glyph in GLYPHS.items():
        if status in ranges:
            settings = [words.setting_range(*group) for group in sorted(ranges[status].items())]
            parts.append("{} {}".format(glyph, ", ".join(settings)))
    return "  ".join(parts)
