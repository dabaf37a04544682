"""The summary in words: who wins, what failed, what was refused."""

import os
import tempfile
import unittest

import synthetic_runs as synthetic
from work_precision.runs import read
from work_precision.summary import write_summary


def summary(scenes, rows):
    with tempfile.TemporaryDirectory() as folder:
        synthetic.write(folder, scenes, rows)
        path = os.path.join(folder, "summary.md")
        write_summary(path, *read(folder), "cloth_bench sheet.yaml")
        with open(path, encoding="utf-8") as file:
            return file.read()


def one_run(solver, error, cost, **fields):
    return synthetic.good_run(solver, "step", 1e-3, error, cost, **fields)


class Winners(unittest.TestCase):
    def line(self, tolerance, rows):
        """Of the scene's own section, after the lines over all scenes."""
        text = summary([synthetic.scene()], rows)
        section = text[text.index("### sheet"):]
        return next(line for line in section.splitlines() if line.startswith("- **{}**".format(tolerance)))

    def test_of_known_laws_are_named_with_setting_speed_and_lead(self):
        # rk4: 2e6 h^4 = 1e-6 at h = 0.84 ms, 4e-4/h = 0.4757; velocity_verlet: 80 h^2 = 1e-6, 1.1e-4/h = 0.984;
        # odeint: 5e8 h^5 = 1e-6, 9e-4/h = 0.783.
        self.assertEqual(
            self.line("1e-6 m", synthetic.all_runs()),
            "- **1e-6 m**: rk4 wins with a step of 0.841 ms, 0.48 s a simulated second, 2.1 times as fast as real "
            "time; next is velocity_verlet, 2.1 times the cost; "
            "the best independent solver, odeint_runge_kutta_dopri5 with a step of 1.15 ms, takes 1.65 times the cost.")

    def test_that_are_level_are_said_to_be(self):
        self.assertEqual(
            self.line("1e-3 m", synthetic.all_runs()),
            "- **1e-3 m**: symplectic_euler with a step of 2 ms, 0.05 s a simulated second, 20 times as fast as real "
            "time; velocity_verlet is level; next is rk4, 4 times the cost; "
            "the best independent solver, odeint_runge_kutta_dopri5 with a step of 2 ms, takes 9 times the cost.")

    def test_slower_than_real_time_and_alone(self):
        self.assertEqual(
            self.line("1e-2 m", [one_run("rk4", 1e-3, 3.0)]),
            "- **1e-2 m**: rk4 wins with a step of 1 ms, 3 s a simulated second, slower than real time; "
            "no other of ours got there in the time given; no independent solver got there in the time given.")

    def test_that_are_independent_are_said_to_be(self):
        rows = [one_run("rk4", 1e-3, 3.0), one_run("cvode_adams", 1e-3, 1.5)]
        self.assertIn("cvode_adams with a step of 1 ms, is cheaper: ours takes 2 times its cost.",
                      self.line("1e-2 m", rows))
        self.assertIn("none of our methods got there in the time given; the best independent solver, cvode_adams",
                      self.line("1e-2 m", rows[1:]))

    def test_are_none_where_nobody_is_so_exact(self):
        self.assertEqual(self.line("1e-6 m", [one_run("rk4", 1e-3, 3.0)]), "- **1e-6 m**: no run is that exact.")

    def test_are_counted_over_all_scenes(self):
        scenes = [synthetic.scene(name) for name in ("sheet", "flag", "tent")] + [synthetic.scene("net", "limited")]
        costs = {"sheet": (0.5, 0.55), "flag": (2.0, 4.0), "tent": (3.0, 1.0), "net": (1.0, 3.0)}
        rows = [one_run(solver, 1e-2, cost, scene=scene, kind="limited" if scene == "net" else "trajectory")
                for scene in costs for solver, cost in zip(("rk4", "xpbd"), costs[scene])]
        self.assertIn("- **1e-1 m**: of 3 scenes, cheapest or level with it is rk4 in 2 and xpbd in 2; "
                      "faster than real time in 1.\n", summary(scenes, rows))
        self.assertIn("| sheet | rk4, xpbd 0.5 s |", summary(scenes, rows))


class Rest(unittest.TestCase):
    def test_says_what_made_the_runs(self):
        text = summary([synthetic.scene()], synthetic.all_runs())
        for line in ("- command: `cloth_bench sheet.yaml`", "- machine: a machine", "- compiler: a compiler",
                     "- commit: abc1234"):
            self.assertIn(line + "\n", text)
        self.assertNotIn("do not compare", text)

    def test_warns_of_runs_of_two_commits(self):
        rows = [one_run("rk4", 1e-3, 1.0), one_run("xpbd", 1e-3, 1.0, commit="fff0000")]
        text = summary([synthetic.scene()], rows)
        self.assertIn("- commit: abc1234; fff0000\n", text)
        self.assertIn("the runs are not of one commit: their costs do not compare", text)

    def test_has_the_order_of_every_law(self):
        text = summary([synthetic.scene()], synthetic.all_runs())
        self.assertIn("| velocity_verlet | 2 | 2.00 | 7, 0.0312 ms to 2 ms |", text)
        self.assertIn("| tr_bdf2 | 2 | 2.00 | 10, 0.0312 ms to 16 ms |", text)
        self.assertIn("\n\nNowhere three steps in a row on one slope: explicit_euler.\n", text)

    def test_names_who_met_none_of_the_errors(self):
        rows = [one_run("rk4", 1e-3, 1.0), synthetic.run("xpbd", "step", 1e-3, status="too_slow")]
        self.assertIn("| rk4 | **1** | **1** | **1** | - | - |\n\n"
                      "Not as exact as any of these in the time given: xpbd.\n", summary([synthetic.scene()], rows))

    def test_lists_every_failure_with_its_settings(self):
        rows = [synthetic.run("rk4", "step", 8e-3, status="unstable"),
                synthetic.run("rk4", "step", 4e-3, status="unstable"),
                synthetic.run("rk4", "step", 1e-7, status="too_slow"), one_run("rk4", 1e-3, 1.0),
                synthetic.run("projective", "iterations", 5, status="not_converged")]
        text = summary([synthetic.scene()], rows)
        failures = text[text.index("## Failures"):text.index("## Scenes that were refused")].strip().splitlines()
        self.assertEqual(failures[4:], ["| sheet | rk4 | too slow | a step of 0.1 us |",
                                        "| sheet | rk4 | unstable | steps of 4 ms and 8 ms |",
                                        "| sheet | projective | not converged | 5 iterations |"])

    def test_lists_refused_scenes_with_the_reason(self):
        scenes = [synthetic.scene(), synthetic.scene("flag", accepted="no", reason="the references differ by 3e-4 m")]
        text = summary(scenes, [one_run("rk4", 1e-3, 1.0)])
        self.assertTrue(text.endswith("- flag (trajectory): The references differ by 3e-4 m.\n"))
        self.assertNotIn("### flag", text)

    def test_has_scenes_with_a_strain_limit_apart(self):
        scenes = [synthetic.scene(), synthetic.scene("net", "limited")]
        rows = [one_run("rk4", 1e-3, 1.0), one_run("rk4", 1e-3, 1.0, scene="net", kind="limited")]
        text = summary(scenes, rows)
        apart = text.index("## With the strain limit")
        self.assertLess(text.index("### sheet"), apart)
        self.assertLess(apart, text.index("### net"))

    def test_has_the_error_of_the_grid_and_its_order(self):
        text = summary([synthetic.scene(kind="spatial")], synthetic.spatial_runs())
        self.assertIn("- sheet in 0.5 s: 0.073 m with 17, 0.015 m with 33 nodes down the sheet; order 2.0.\n", text)

    def test_says_what_the_own_grid_of_a_scene_costs(self):
        rows = [one_run("rk4", 1e-3, 1.0, nodes=33 ** 2)] + synthetic.spatial_runs()
        text = summary([synthetic.scene(), synthetic.scene(kind="spatial")], rows)
        self.assertIn("; a finer grid is 0.015 m off in 0.5 s.", text)


if __name__ == "__main__":
    unittest.main()
