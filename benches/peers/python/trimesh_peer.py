"""trimesh: arrays of numpy."""

import numpy
import scipy  # Without it the refinement fails only when it is asked for.
import trimesh

from peer import serve


def setup(positions, triangles):
    return positions.copy(), triangles.astype(numpy.int64)


def loop(levels):
    def work(state):
        return trimesh.remesh.subdivide_loop(*state, iterations=levels)

    return setup, work, lambda outcome: (outcome[0], len(outcome[1]))


serve(trimesh.__version__, {"loop4": loop(4), "loop1": loop(1), "shuffled": loop(1)})
