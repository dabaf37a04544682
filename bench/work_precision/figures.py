"""Style and files of the charts.

The same runs give the same files, byte for byte: without date and version, and with fixed names inside the SVG.
"""

import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

ENDINGS = ("png", "svg")


def set_style():
    plt.rcParams.update({
        "font.size": 9,
        "axes.titlesize": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.axisbelow": True,
        "lines.linewidth": 1.3,
        "lines.markersize": 4.5,
        "svg.hashsalt": "work_precision",
    })


def save(figure, folder, name):
    """Returns the names of the files."""
    files = ["{}.{}".format(name, ending) for ending in ENDINGS]
    for file, ending in zip(files, ENDINGS):
        metadata = {"Date": None, "Creator": None} if ending == "svg" else {"Software": None}
        figure.savefig(os.path.join(folder, file), dpi=130, metadata=metadata)
    plt.close(figure)
    return files
