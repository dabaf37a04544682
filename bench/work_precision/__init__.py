"""What plot_work_precision.py and compare_rankings.py make of the runs of cloth_bench."""
