"""The strip above a chart in which the runs stand that failed."""

import math

from matplotlib.ticker import NullFormatter, NullLocator

from work_precision import solvers, words

MARKERS = {"unstable": "x", "not_converged": "o", "too_slow": ">"}


def draw(axes, failed, runs, limits, all_names):
    """A row a solver, each failure at its cost, and in words the range of its settings."""
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
        axes.plot([within(cost(run, runs), limits)], [names.index(run.solver)],
                  **marker_style(run.status, solvers.look_up(run.solver, all_names).colour))
    for row, name in enumerate(names):
        axes.text(1.01, row, in_words([run for run in failed if run.solver == name]), fontsize=7, va="center",
                  transform=axes.get_yaxis_transform(), color=solvers.look_up(name, all_names).colour)


def failing(failed):
    return solvers.in_order(run.solver for run in failed)


def marker_style(status, colour):
    return {"marker": MARKERS[status], "color": colour, "markerfacecolor": "none", "markersize": 5,
            "markeredgewidth": 1.3, "linestyle": "none"}


def within(own_cost, limits):
    """On the rim where a cost is not known."""
    return max(own_cost or 0.0, 1.08 * limits[0])


def cost(run, runs):
    """As measured; else, of a step or of iterations, in proportion from the solver's nearest run that has a cost."""
    if run.seconds_per_second:
        return run.seconds_per_second
    power = {"step": -1.0, "iterations": 1.0}.get(run.setting)
    peers = [peer for peer in runs if (peer.solver, peer.setting) == (run.solver, run.setting) and peer.seconds_per_second]
    if power is None or not peers:
        return None
    nearest = min(peers, key=lambda peer: abs(math.log(peer.value / run.value)))
    return nearest.seconds_per_second * (run.value / nearest.value) ** power


def in_words(failed):
    """Of one solver's: what happened, at which settings."""
    groups = {}
    for run in failed:
        groups.setdefault((run.status, run.setting), []).append(run.value)
    return "{}: {}".format(failed[0].solver, "; ".join(
        "{} at {}".format(words.STATUS_WORDS[status], words.setting_range(setting, values))
        for (status, setting), values in sorted(groups.items())))
