"""Two runs of cloth_bench against each other."""

import os
import subprocess
import sys
import tempfile
import unittest

import synthetic_runs as synthetic

PROGRAM = os.path.join(os.path.dirname(__file__), "..", "..", "bench", "compare_rankings.py")


def compare(first, second):
    with tempfile.TemporaryDirectory() as folder:
        folders = [os.path.join(folder, name) for name in ("first", "second")]
        for place, rows in zip(folders, (first, second)):
            os.mkdir(place)
            synthetic.write(place, [synthetic.scene()], rows)
        done = subprocess.run([sys.executable, "-B", PROGRAM] + folders, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, check=False)
        return done.returncode, done.stdout


def runs(**costs):
    return [synthetic.good_run(solver, "step", 1e-3, 0.05, cost) for solver, cost in costs.items()]


class Comparison(unittest.TestCase):
    def test_the_same_order_agrees(self):
        status, said = compare(runs(rk4=1.0, xpbd=2.0), runs(rk4=1.5, xpbd=2.0))
        self.assertEqual((status, said), (0, "1 pairs that differ by more than 20 %, 0 disagreements\n"))

    def test_another_order_disagrees(self):
        status, said = compare(runs(rk4=1.0, xpbd=2.0), runs(rk4=2.0, xpbd=1.9))
        self.assertEqual(status, 1)
        self.assertIn(
            "sheet (trajectory), 1e-1 m: xpbd costs 2 times rk4 in the first run, 0.95 times in the second\n", said)

    def test_another_order_of_what_is_level_is_no_disagreement(self):
        status, said = compare(runs(rk4=1.0, xpbd=1.1), runs(rk4=1.1, xpbd=1.0))
        self.assertEqual((status, said), (0, "0 pairs that differ by more than 20 %, 0 disagreements\n"))

    def test_who_gets_there_in_one_run_only_ranks_last_in_the_other(self):
        for first, second in ((runs(rk4=2.0, xpbd=1.0), runs(rk4=2.0)), (runs(rk4=2.0), runs(rk4=2.0, xpbd=1.0))):
            status, said = compare(first, second)
            self.assertEqual(status, 1)
            self.assertIn("1e-1 m: rk4 costs 2 times xpbd in one run, and xpbd does not get there in the other", said)

    def test_who_is_last_may_get_there_in_one_run_only(self):
        status, said = compare(runs(rk4=1.0, xpbd=2.0), runs(rk4=1.0))
        self.assertEqual((status, said), (0, "1 pairs that differ by more than 20 %, 0 disagreements\n"))

    def test_a_malformed_file_is_named(self):
        status, said = compare(runs(rk4=1.0), [dict(runs(rk4=1.0)[0], seconds_per_second="soon")])
        self.assertEqual(status, 2)
        self.assertIn("second/runs.csv, line 2, column seconds_per_second: 'soon' is not a finite number", said)


if __name__ == "__main__":
    unittest.main()
