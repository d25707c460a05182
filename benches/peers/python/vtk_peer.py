"""VTK: its filters for Loop and for modified Butterfly."""

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from peer import serve


def setup(filter_class, levels):
    def make(positions, triangles):
        points = vtk.vtkPoints()
        points.SetData(numpy_to_vtk(positions, deep=True))
        cells = vtk.vtkCellArray()
        offsets = numpy.arange(0, 3 * len(triangles) + 1, 3, dtype=numpy.int64)
        corners = triangles.astype(numpy.int64).ravel()
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(corners, deep=True))
        mesh = vtk.vtkPolyData()
        mesh.SetPoints(points)
        mesh.SetPolys(cells)
        refinement = filter_class()
        refinement.SetNumberOfSubdivisions(levels)
        refinement.SetInputData(mesh)
        return refinement

    return make


def work(refinement):
    refinement.Update()
    return refinement.GetOutput()


def result(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData()), mesh.GetNumberOfPolys()


def task(filter_class, levels):
    return setup(filter_class, levels), work, result


LOOP, BUTTERFLY = vtk.vtkLoopSubdivisionFilter, vtk.vtkButterflySubdivisionFilter
serve(
    vtk.vtkVersion.GetVTKVersion(),
    {"loop4": task(LOOP, 4), "loop1": task(LOOP, 1), "shuffled": task(LOOP, 1), "butterfly4": task(BUTTERFLY, 4)},
)
