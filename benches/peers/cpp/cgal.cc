// CGAL: Surface_mesh, half-edges.
#define CGAL_DISABLE_GMP 1
#include "peer.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <CGAL/version.h>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Vector = CGAL::Simple_cartesian<double>::Vector_3;
using Surface = CGAL::Surface_mesh<Point>;
using Vertex = Surface::Vertex_index;

int main(int count, char** arguments) {
    return serve(count, arguments, CGAL_VERSION_STR, [](Task& task) {
        const Mesh& mesh = task.mesh;
        if (int levels = task.loop_levels()) {
            const Surface coarse = built<Vertex, Surface>(mesh);
            Surface fine = task.timed([&] { return coarse; }, [&](Surface& surface) {
                auto parameters = CGAL::parameters::number_of_iterations(levels);
                CGAL::Subdivision_method_3::Loop_subdivision(surface, parameters);
            });
            std::vector<double> result;
            for (Vertex v : fine.vertices())
                for (int axis = 0; axis < 3; ++axis) result.push_back(fine.point(v)[axis]);
            task.answer(fine.number_of_faces(), result);
        } else if (task.name == "build") {
            task.timed([] { return Surface(); }, [&](Surface& surface) { build<Vertex>(mesh, surface); });
            task.answer(mesh.faces());
        } else if (task.name == "laplacian") {
            const Surface surface = built<Vertex, Surface>(mesh);
            auto sums = task.timed([&] { return std::vector<double>(mesh.positions.size()); },
                                   [&](std::vector<double>& sums) {
                                       for (Vertex v : surface.vertices()) {
                                           Vector sum(0, 0, 0);
                                           for (Vertex w : surface.vertices_around_target(surface.halfedge(v)))
                                               sum += surface.point(w) - surface.point(v);
                                           for (int axis = 0; axis < 3; ++axis) sums[3 * v.idx() + axis] = sum[axis];
                                       }
                                   });
            task.answer(mesh.faces(), sums);
        } else if (task.name == "search") {
            const Surface surface = built<Vertex, Surface>(mesh);
            auto around = [&](uint32_t v, auto visit) {
                for (Vertex w : surface.vertices_around_target(surface.halfedge(Vertex(v)))) visit(w.idx());
            };
            auto search = task.timed([&] { return Search(mesh.vertices()); }, [&](Search& search) { search.run(around); });
            task.answer(mesh.faces(), search.result());
        } else if (task.name == "validity") {
            const Surface surface = built<Vertex, Surface>(mesh);
            bool valid = task.timed([] { return false; },
                                    [&](bool& valid) { valid = CGAL::is_valid_polygon_mesh(surface); });
            if (!valid) exit(1);
            task.answer(mesh.faces());
        } else if (task.name == "memory") {
            task.start_of_memory();
            const Surface surface = built<Vertex, Surface>(mesh);
            task.end_of_memory();
            task.answer(mesh.faces());
        }
    });
}
