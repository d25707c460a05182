// OpenMesh: half-edges.
#include "peer.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Adaptive/Composite/CompositeT.hh>
#include <OpenMesh/Tools/Subdivider/Adaptive/Composite/RulesT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>

#include <algorithm>
#include <memory>

struct Double : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
};
struct CompositeDouble : OpenMesh::Subdivider::Adaptive::CompositeTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
using Surface = OpenMesh::TriMesh_ArrayKernelT<Double>;
using CompositeSurface = OpenMesh::TriMesh_ArrayKernelT<CompositeDouble>;
using Vertex = OpenMesh::VertexHandle;

template <class Subdivider>
void refine(Task& task, int levels) {
    const Surface coarse = built<Vertex, Surface>(task.mesh);
    Surface fine = task.timed([&] { return coarse; },
                              [&](Surface& surface) {
                                  Subdivider subdivider;
                                  subdivider.attach(surface);
                                  subdivider(levels);
                                  subdivider.detach();
                              });
    std::vector<double> result;
    for (auto v : fine.vertices()) result.insert(result.end(), fine.point(v).begin(), fine.point(v).end());
    task.answer(fine.n_faces(), result);
}

// A mesh with the states that its adaptive subdivider keeps.
struct Composite {
    CompositeSurface surface;
    OpenMesh::Subdivider::Adaptive::CompositeT<CompositeSurface> subdivider{surface};

    explicit Composite(const Mesh& mesh) {
        using namespace OpenMesh::Subdivider::Adaptive;
        build<Vertex>(mesh, surface);
        // The rules of Loop, as the library's uniform composite has them.
        subdivider.add<Tvv4<CompositeSurface>>();
        subdivider.add<VdE<CompositeSurface>>();
        subdivider.add<EVc<CompositeSurface>>();
        subdivider.add<VdE<CompositeSurface>>();
        subdivider.add<EVc<CompositeSurface>>();
        subdivider.initialize();
    }

    // Refines the faces whose corners all lie within three edges of a vertex, except those that a face before has refined.
    void refine_around(Vertex center) {
        std::vector<Vertex> disk{center};
        auto in_disk = [&](Vertex v) { return std::find(disk.begin(), disk.end(), v) != disk.end(); };
        for (size_t radius = 0, start = 0; radius < 3; ++radius) {
            size_t end = disk.size();
            for (; start < end; ++start)
                for (auto w : surface.vv_range(disk[start]))
                    if (!in_disk(w)) disk.push_back(w);
        }
        std::vector<OpenMesh::FaceHandle> faces;
        for (Vertex v : disk)
            for (auto f : surface.vf_range(v)) {
                bool inside = std::find(faces.begin(), faces.end(), f) == faces.end();
                for (auto w : surface.fv_range(f)) inside = inside && in_disk(w);
                if (inside) faces.push_back(f);
            }
        for (auto f : faces)
            if (surface.data(f).state() == 0) subdivider.refine(f);
    }
};

int main(int count, char** arguments) {
    std::string version = std::to_string(OM_GET_VER) + "." + std::to_string(OM_GET_MAJ);
    return serve(count, arguments, version, [](Task& task) {
        const Mesh& mesh = task.mesh;
        if (int levels = task.loop_levels()) {
            refine<OpenMesh::Subdivider::Uniform::LoopT<Surface>>(task, levels);
        } else if (task.name == "butterfly4") {
            refine<OpenMesh::Subdivider::Uniform::ModifiedButterflyT<Surface>>(task, 4);
        } else if (task.name == "build") {
            task.timed([] { return Surface(); }, [&](Surface& surface) { build<Vertex>(mesh, surface); });
            task.answer(mesh.faces());
        } else if (task.name == "laplacian") {
            const Surface surface = built<Vertex, Surface>(mesh);
            auto sums = task.timed([&] { return std::vector<double>(mesh.positions.size()); },
                                   [&](std::vector<double>& sums) {
                                       for (auto v : surface.vertices()) {
                                           OpenMesh::Vec3d sum(0.0), here = surface.point(v);
                                           for (auto w : surface.vv_range(v)) sum += surface.point(w) - here;
                                           for (int axis = 0; axis < 3; ++axis) sums[3 * v.idx() + axis] = sum[axis];
                                       }
                                   });
            task.answer(mesh.faces(), sums);
        } else if (task.name == "search") {
            const Surface surface = built<Vertex, Surface>(mesh);
            auto around = [&](uint32_t v, auto visit) {
                for (auto w : surface.vv_range(Vertex(v))) visit(w.idx());
            };
            auto search = task.timed([&] { return Search(mesh.vertices()); }, [&](Search& search) { search.run(around); });
            task.answer(mesh.faces(), search.result());
        } else if (task.name == "local") {
            // As many steps, at the same places, as `../rust/task.rs` says.
            const size_t calls = 50;
            auto step = [&](Composite& composite, size_t k) {
                composite.refine_around(Vertex(k * 2654435761 % mesh.vertices()));
            };
            auto composite = task.timed(
                [&] {
                    auto composite = std::make_unique<Composite>(mesh);
                    step(*composite, 0);
                    return composite;
                },
                [&](std::unique_ptr<Composite>& composite) {
                    for (size_t k = 1; k <= calls; ++k) step(*composite, k);
                });
            task.divide_samples(calls);
            task.answer(composite->surface.n_faces(), {}, "local: the adaptive composite of Loop");
        } else if (task.name == "validity") {
            Surface surface = built<Vertex, Surface>(mesh);
            bool valid = task.timed([] { return false; }, [&](bool& valid) {
                OpenMesh::Utils::MeshCheckerT<Surface> checker(surface);
                valid = checker.check(OpenMesh::Utils::MeshCheckerT<Surface>::CHECK_ALL, std::cerr);
            });
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
