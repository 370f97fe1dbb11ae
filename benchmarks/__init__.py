"""The benchmarks: ratios and accuracies against peers, in one run each (make bench)."""
