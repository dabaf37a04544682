"""The error of the grid: what finer sheets still change."""

import matplotlib.pyplot as plt
from matplotlib.ticker import NullLocator

from work_precision import axes as chart
from work_precision import rankings

LOOKS = (("#0b3c8c", "o"), ("#b3282d", "s"), ("#12a594", "D"), ("#c9a008", "^"), ("#5a1e96", "v"), ("#3d8b37", "X"))


def draw(scenes, runs):
    figure, axes = plt.subplots(figsize=(7.2, 5.0))
    figure.subplots_adjust(left=0.13, right=0.97, top=0.92, bottom=0.11)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title("Error of the grid", loc="left")
    for place, scene in enumerate(scenes):
        colour, marker = LOOKS[place % len(LOOKS)]
        good = sorted(rankings.succeeded([run for run in runs if run.scene == scene.scene]), key=lambda run: run.value)
        axes.plot([run.value for run in good], [run.rms_error for run in good], marker=marker, color=colour,
                  label=name(scene, good))
    sides = sorted({run.value for run in runs})
    chart.set_decades(axes)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xticks(sides)
    axes.set_xticklabels(["{:.0f}".format(side) for side in sides])
    chart.number_between_decades(axes.yaxis)
    axes.set_xlabel("nodes a side")
    axes.set_ylabel("RMS error of the positions, m")
    axes.legend(frameon=False)
    return figure


def name(scene, runs):
    found = rankings.slope(runs)
    return scene.scene + (", order {:.2f}".format(-found.slope) if found else "")
