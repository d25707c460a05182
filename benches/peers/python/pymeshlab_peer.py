"""PyMeshLab: the filters of MeshLab."""

from importlib.metadata import version

import pymeshlab

from peer import serve

# Edges of any length are split.
EVERY = pymeshlab.PercentageValue(0)


def setup(positions, triangles):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(positions, triangles.astype("int32")))
    return meshes


def result(meshes):
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix(), mesh.face_number()


def loop(levels):
    def work(meshes):
        meshes.meshing_surface_subdivision_loop(loopweight="Loop", iterations=levels, threshold=EVERY)
        return meshes

    return setup, work, result


def butterfly(levels):
    def work(meshes):
        meshes.meshing_surface_subdivision_butterfly(iterations=levels, threshold=EVERY)
        return meshes

    return setup, work, result, "Butterfly as it was before it was modified"


serve(
    version("pymeshlab"),
    {"loop4": loop(4), "loop1": loop(1), "shuffled": loop(1), "butterfly4": butterfly(4)},
)
