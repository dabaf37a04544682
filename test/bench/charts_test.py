"""The charts: the same runs give the same files, and what is to be seen is there."""

import os
import subprocess
import sys
import tempfile
import unittest

import synthetic_runs as synthetic
from work_precision.runs import read

try:
    import matplotlib
except ImportError as error:
    raise unittest.SkipTest("python3-matplotlib is missing: the charts are not tested") from error
matplotlib.use("Agg")
from matplotlib.colors import to_hex  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

import plot_precision_error  # noqa: E402
from work_precision import axes as chart  # noqa: E402
from work_precision import failures, rankings, solvers  # noqa: E402

PROGRAM = os.path.join(os.path.dirname(__file__), "..", "..", "bench", "plot_work_precision.py")


def plot(csv_folder, out, seed):
    """With dictionaries and sets in another order for each seed."""
    return subprocess.run([sys.executable, "-B", PROGRAM, csv_folder, out], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True, check=False,
                          env=dict(os.environ, PYTHONHASHSEED=str(seed)))


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        scenes = [synthetic.scene(), synthetic.scene(kind="limited"), synthetic.scene(kind="spatial"),
                  synthetic.scene("flag", accepted="no", reason="the references differ")]
        rows = synthetic.all_runs() + synthetic.spatial_runs() + list(
            synthetic.runs_by_step("xpbd", synthetic.LAWS["xpbd"], kind="limited"))
        synthetic.write(cls.folder, scenes, rows)
        cls.outs = [os.path.join(cls.folder, name) for name in ("first", "second")]
        # The folder, and the file in it.
        given = [cls.folder, os.path.join(cls.folder, "runs.csv")]
        cls.done = [plot(path, out, seed) for seed, (path, out) in enumerate(zip(given, cls.outs))]

    def text(self, name):
        with open(os.path.join(self.outs[0], name), encoding="utf-8") as file:
            return file.read()

    def test_are_all_there(self):
        self.assertEqual([(run.returncode, run.stdout) for run in self.done], [(0, "")] * 2)
        pages = ["sheet", "sheet_details", "sheet_limited", "sheet_limited_details", "overview", "spatial_error",
                 "stability_map"]
        self.assertEqual(sorted(os.listdir(self.outs[0])),
                         sorted(["summary.md"] + [page + ending for page in pages for ending in (".png", ".svg")]))

    def test_are_the_same_byte_for_byte(self):
        for name in sorted(os.listdir(self.outs[0])):
            with open(os.path.join(self.outs[0], name), "rb") as first, \
                    open(os.path.join(self.outs[1], name), "rb") as second, self.subTest(name):
                self.assertTrue(first.read() == second.read())

    def test_name_solvers_failures_real_time_and_tolerance(self):
        page = self.text("sheet.svg")
        for words in ("velocity_verlet", "dopri5, tolerance", "cvode_bdf, tolerance", "constraint-based", "real time",
                      "tolerance 1e-3 m", "\u00d7 4 to 16 ms"):
            self.assertIn(words, page)

    def test_show_what_was_refused(self):
        self.assertIn("refused: the references differ", self.text("overview.svg"))

    def test_have_every_method_in_the_stability_map(self):
        page = self.text("stability_map.svg")
        for name in solvers.OURS:
            self.assertIn(name, page)

    def test_name_the_order_of_the_grid(self):
        self.assertIn("sheet in 0.5 s, order 2.0", self.text("spatial_error.svg"))


class Malformed(unittest.TestCase):
    def test_csv_ends_with_its_place_and_without_charts(self):
        with tempfile.TemporaryDirectory() as folder:
            synthetic.write(folder, [synthetic.scene()], [synthetic.run("rk4", "step", "short", status="unstable")])
            done = plot(folder, os.path.join(folder, "out"), 0)
            self.assertEqual(done.returncode, 1)
            self.assertIn("runs.csv, line 2, column value: 'short' is not a finite number", done.stdout)
            self.assertNotIn("Traceback", done.stdout)
            self.assertFalse(os.path.exists(os.path.join(folder, "out")))


class Lines(unittest.TestCase):
    def setUp(self):
        with tempfile.TemporaryDirectory() as folder:
            synthetic.write(folder, [synthetic.scene()], synthetic.all_runs())
            self.runs = read(folder)[1]
        self.axes = Figure().add_subplot()
        self.names = {run.solver for run in self.runs}
        self.limits = chart.cost_limits(self.runs)

    def points(self, colour):
        return [list(zip(*line.get_data())) for line in self.axes.get_lines() if to_hex(line.get_color()) == colour]

    def test_follow_the_pareto_front(self):
        chart.draw_front(self.axes, self.runs)
        band, halos = self.points(chart.FRONT)
        self.assertEqual(halos, rankings.pareto_front(
            [(run.seconds_per_second, run.rms_error) for run in self.runs if run.status == "ok"]))
        for cost, error in band:
            self.assertAlmostEqual(cost / rankings.ranking(self.runs, error)[0].cost, 1.0, places=12)

    def test_mark_real_time_and_the_tolerance(self):
        chart.draw_work_precision(self.axes, self.runs, self.limits, self.names)
        self.assertEqual(self.points(chart.REAL_TIME), [[(1, 0), (1, 1)]])
        self.assertEqual(self.points(chart.TOLERANCE)[0], [(0, 1e-3), (1, 1e-3)])

    def test_have_every_good_run_and_no_other(self):
        chart.draw_ladders(self.axes, self.runs, "seconds_per_second", "rms_error", self.names)
        drawn = {point for line in self.axes.get_lines() for point in zip(*line.get_data()) if point[0] == point[0]}
        self.assertEqual(drawn, {(run.seconds_per_second, run.rms_error) for run in self.runs if run.status == "ok"})

    def test_show_the_spread_of_repeats(self):
        run = self.runs[-1]
        chart.draw_spread(self.axes, [run], self.names)
        (line,) = self.axes.get_lines()
        self.assertEqual(list(line.get_xdata()), [run.seconds_per_second_low, run.seconds_per_second_high])

    def test_have_a_mark_for_every_failure_at_its_cost(self):
        failed = [run for run in self.runs if run.status != "ok"]
        failures.draw(self.axes, failed, self.runs, self.limits, self.names)
        marks = [line for line in self.axes.get_lines() if line.get_marker() == failures.MARKERS["unstable"]]
        self.assertEqual(len(marks), len(failed))
        verlet = synthetic.LAWS["velocity_verlet"]
        costs = sorted(mark.get_xdata()[0] for mark in marks
                       if mark.get_ydata()[0] == failures.failing(failed).index("velocity_verlet"))
        for cost, step in zip(costs, synthetic.STEPS):
            self.assertAlmostEqual(cost / (verlet.cost / step), 1.0, places=9)


class ErrorsOfBothPrecisions(unittest.TestCase):
    ROWS = {16: [(2e-3, 4e-3, 5e-3, 3e-4), (1e-3, 1e-3, 2e-3, 1e-4)], 64: [(2e-3, 2e-2, 3e-2, 1e-3)]}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "errors.csv")
        with open(self.path, "w", encoding="utf-8") as file:
            file.write("nodes_a_side,substep,double,mixed,apart\n")
            for nodes, rows in self.ROWS.items():
                for row in rows:
                    file.write("{},{},{},{},{}\n".format(nodes, *row))

    def test_are_all_drawn(self):
        sheets = plot_precision_error.read_errors(self.path)
        self.assertEqual(list(sheets), list(self.ROWS))
        for nodes, rows in sheets.items():
            axes = Figure().subplots()
            plot_precision_error.draw_errors(axes, rows)
            drawn = {line.get_label(): list(zip(*line.get_data())) for line in axes.get_lines()}
            for label, column in (("in doubles", 1), ("mixed", 2), ("from each other", 3)):
                self.assertEqual(drawn[label], [(row[0], row[column]) for row in self.ROWS[nodes]])

    def test_give_the_same_picture_again(self):
        pictures = []
        for name in ("first", "second"):
            out = os.path.join(os.path.dirname(self.path), name)
            plot_precision_error.draw(self.path, out)
            with open(out + ".png", "rb") as file:
                pictures.append(file.read())
        self.assertEqual(pictures[0], pictures[1])


if __name__ == "__main__":
    unittest.main()
