"""What every peer in Python shares: reading the mesh, timing, answering. See `../rust/native/mod.rs`, the same in Rust."""

import json
import sys
import time

import numpy


def read(path):
    """The positions and the triangles of a file as `../rust/raw.rs` describes it."""
    data = open(path, "rb").read()
    vertices, faces = numpy.frombuffer(data, "<u8", 2)
    positions = numpy.frombuffer(data, "<f8", 3 * vertices, 16).reshape(-1, 3)
    triangles = numpy.frombuffer(data, "<u4", 3 * faces, 16 + 24 * int(vertices)).reshape(-1, 3)
    return positions, triangles


def serve(version, tasks):
    """Tells the version without arguments; else does one task of `tasks`, or says nothing if it is none of them.

    A task is three functions: `setup(positions, triangles)` makes a state that is not timed, `work(state)` is timed,
    `result(outcome)` makes positions and the number of faces of what the work answered. A note may follow.
    """
    if len(sys.argv) == 1:
        print(version)
        return
    name, source, target, seconds = sys.argv[1:]
    if name not in tasks:
        return
    setup, work, result, *notes = tasks[name]
    positions, triangles = read(source)
    samples = []
    while sum(samples) < float(seconds) * 1e9:
        state = setup(positions, triangles)
        start = time.perf_counter_ns()
        outcome = work(state)
        samples.append(time.perf_counter_ns() - start)
    refined, faces = result(outcome)
    numpy.ascontiguousarray(refined, "<f8").tofile(target)
    print(json.dumps({"faces": int(faces), "samples": samples, "note": "".join(notes)}))
