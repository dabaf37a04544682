"""The error of the grid: how far each is from the finest."""

import matplotlib.pyplot as plt
from matplotlib.ticker import NullLocator

from work_precision import axes as chart
from work_precision import grid

LOOKS = (("#0b3c8c", "o"), ("#b3282d", "s"), ("#12a594", "D"), ("#c9a008", "^"), ("#5a1e96", "v"), ("#3d8b37", "X"),
         ("#c2298c", "*"), ("#666666", "P"))


def draw(scenes, runs):
    figure, axes = plt.subplots(figsize=(7.2, 5.0))
    figure.subplots_adjust(left=0.14, right=0.97, top=0.92, bottom=0.11)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title("Error of the grid: against one twice as fine as the finest shown", loc="left")
    sides = set()
    for place, scene in enumerate(scenes):
        colour, marker = LOOKS[place % len(LOOKS)]
        found = grid.grids(scene.scene, runs)
        sides.update(run.value for run in found)
        axes.plot([run.value for run in found], [run.rms_error for run in found], marker=marker, color=colour,
                  label=label(scene, found))
    chart.set_decades(axes)
    chart.number_between_decades(axes.yaxis)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xticks(sorted(sides))
    axes.set_xticklabels(["{:.0f}".format(side) for side in sorted(sides)])
    axes.set_xlabel("nodes down the sheet")
    axes.set_ylabel("RMS error of the positions, m")
    axes.legend(frameon=False, fontsize=8)
    return figure


def label(scene, found):
    horizon = grid.horizon_in_words(found[0]) if found else ""
    return ", ".join(filter(None, ("{} {}".format(scene.scene, horizon).strip(), grid.order_in_words(found))))
