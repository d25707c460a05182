"""libigl: matrices."""

from importlib.metadata import version

import igl
import numpy

from peer import serve

NOTE = "Loop with the weights of Warren"


def setup(positions, triangles):
    return positions.copy(), triangles.astype(numpy.int64)


def loop(levels):
    def work(state):
        return igl.loop(*state, levels)

    return setup, work, lambda outcome: (outcome[0], len(outcome[1])), NOTE


serve(version("libigl"), {"loop4": loop(4), "loop1": loop(1), "shuffled": loop(1)})
