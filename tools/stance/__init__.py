"""A trial of how a last stands: the middle of its bottom in the side view, and the ground under it.

It finds heel heights from 0 to 120 mm on two families of lasts (benchmarks/stance.py). The product
does not use it yet: its measure ``heel_height`` reads high heels too low.
"""
