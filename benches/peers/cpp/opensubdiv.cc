// OpenSubdiv: the refiner of its Far layer, whose levels are tables of indices.
#include "peer.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/version.h>

#include <memory>

namespace Far = OpenSubdiv::Far;
using Refiner = std::unique_ptr<Far::TopologyRefiner>;

struct Point {
    double at[3];
    void Clear() { at[0] = at[1] = at[2] = 0; }
    void AddWithWeight(const Point& other, double weight) {
        for (int axis = 0; axis < 3; ++axis) at[axis] += weight * other.at[axis];
    }
};

std::vector<Point> points(const Mesh& mesh) {
    const Point* first = reinterpret_cast<const Point*>(mesh.positions.data());
    return {first, first + mesh.vertices()};
}

struct Built {
    Refiner refiner;
    std::vector<Point> positions;
};

Built build(const Mesh& mesh, const std::vector<int>& threes) {
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = mesh.vertices();
    descriptor.numFaces = mesh.faces();
    descriptor.numVertsPerFace = threes.data();
    descriptor.vertIndicesPerFace = reinterpret_cast<const int*>(mesh.corners.data());
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    OpenSubdiv::Sdc::Options options;
    options.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    Factory::Options scheme(OpenSubdiv::Sdc::SCHEME_LOOP, options);
    return {Refiner(Factory::Create(descriptor, scheme)), points(mesh)};
}

// Every level with its positions; the last one is the result.
void refine(Built& built, int levels) {
    built.refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
    Far::PrimvarRefinerReal<double> primvars(*built.refiner);
    for (int level = 1; level <= levels; ++level) {
        std::vector<Point> finer(built.refiner->GetLevel(level).GetNumVertices());
        primvars.Interpolate(level, built.positions, finer);
        built.positions.swap(finer);
    }
}

template <class Visit>
void around(const Far::TopologyLevel& level, int v, Visit visit) {
    Far::ConstIndexArray edges = level.GetVertexEdges(v);
    for (int k = 0; k < edges.size(); ++k) {
        Far::ConstIndexArray ends = level.GetEdgeVertices(edges[k]);
        visit(ends[0] == v ? ends[1] : ends[0]);
    }
}

int main(int count, char** arguments) {
    std::string version = std::to_string(OPENSUBDIV_VERSION_MAJOR) + "." + std::to_string(OPENSUBDIV_VERSION_MINOR);
    return serve(count, arguments, version, [](Task& task) {
        const Mesh& mesh = task.mesh;
        const std::vector<int> threes(mesh.faces(), 3);
        if (int levels = task.loop_levels()) {
            Built fine = task.timed([&] { return build(mesh, threes); }, [&](Built& built) { refine(built, levels); });
            const double* first = fine.positions.data()->at;
            task.answer(fine.refiner->GetLevel(levels).GetNumFaces(), {first, first + 3 * fine.positions.size()},
                        "Loop: all levels, without making the first; the last has no neighbours");
        } else if (task.name == "build") {
            task.timed([] { return Built(); }, [&](Built& built) { built = build(mesh, threes); });
            task.answer(mesh.faces());
        } else if (task.name == "laplacian") {
            const Built built = build(mesh, threes);
            const Far::TopologyLevel& level = built.refiner->GetLevel(0);
            auto sums = task.timed([&] { return std::vector<Point>(mesh.vertices()); },
                                   [&](std::vector<Point>& sums) {
                                       for (size_t v = 0; v < sums.size(); ++v)
                                           around(level, v, [&](int w) {
                                               sums[v].AddWithWeight(built.positions[w], 1);
                                               sums[v].AddWithWeight(built.positions[v], -1);
                                           });
                                   });
            const double* first = sums.data()->at;
            task.answer(mesh.faces(), {first, first + 3 * sums.size()});
        } else if (task.name == "search") {
            const Built built = build(mesh, threes);
            const Far::TopologyLevel& level = built.refiner->GetLevel(0);
            auto neighbors = [&](uint32_t v, auto visit) { around(level, v, visit); };
            auto search =
                task.timed([&] { return Search(mesh.vertices()); }, [&](Search& search) { search.run(neighbors); });
            task.answer(mesh.faces(), search.result());
        } else if (task.name == "memory") {
            task.start_of_memory();
            const Built built = build(mesh, threes);
            task.end_of_memory();
            task.answer(mesh.faces());
        }
    });
}
