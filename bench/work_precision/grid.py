"""The error of the grid: each grid of a scene is compared with the one that is twice as fine as the finest of them."""

import math

from work_precision import rankings, words

LEAST_ORDER = 0.5  # less is no convergence that one could count on


def grids(scene_name, runs):
    """The runs on the grids of a scene, coarsest first."""
    return sorted((run for run in rankings.succeeded(runs) if (run.scene, run.kind) == (scene_name, "spatial")),
                  key=lambda run: run.value)


def own_grid(scene, runs):
    """The run that says how far a scene's own grid is from the finest; None where there is none."""
    nodes = {run.nodes for run in runs if (run.scene, run.kind) == (scene.scene, scene.kind)}
    found = [run for run in grids(scene.scene, runs) if run.nodes in nodes]
    return found[0] if found and scene.kind == "trajectory" else None


def horizon_in_words(run):
    return "in {} s".format(words.rounded(run.horizon)) if run.horizon else ""


def order(found):
    """From the two finest grids, or None where there is only one or where the error shrinks too little to tell.

    With n cells a side and an error C n^-p, a grid differs from that of 4n cells by C (1 - 4^-p) n^-p, and the one of
    2n cells by C (2^-p - 4^-p) n^-p. The former is 2^p + 1 times the latter.
    """
    if len(found) < 2:
        return None
    ratio = found[-2].rms_error / found[-1].rms_error
    return math.log2(ratio - 1.0) if ratio > 2.0 else None


def order_in_words(found):
    if len(found) < 2:
        return ""
    value = order(found)
    return "no order yet" if value is None or value < LEAST_ORDER else "order {:.1f}".format(value)
