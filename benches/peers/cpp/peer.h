// What every peer in C++ shares: reading the mesh, timing, searching, answering. See `../rust/native/mod.rs`, which is the
// same in Rust, and `../rust/raw.rs` for the files.
#pragma once

#include <malloc.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

struct Mesh {
    std::vector<double> positions;
    std::vector<uint32_t> corners;

    size_t vertices() const { return positions.size() / 3; }
    size_t faces() const { return corners.size() / 3; }
};

inline Mesh read(const char* path) {
    FILE* file = fopen(path, "rb");
    uint64_t counts[2] = {0, 0};
    bool whole = file && fread(counts, 8, 2, file) == 2;
    Mesh mesh;
    mesh.positions.resize(3 * counts[0]);
    mesh.corners.resize(3 * counts[1]);
    whole = whole && fread(mesh.positions.data(), 24, counts[0], file) == counts[0];
    whole = whole && fread(mesh.corners.data(), 12, counts[1], file) == counts[1];
    if (!whole) {
        fprintf(stderr, "error: %s is no mesh\n", path);
        exit(1);
    }
    fclose(file);
    return mesh;
}

// The structure of a library of half-edges, made from indexed faces.
template <class Vertex, class Surface>
void build(const Mesh& mesh, Surface& surface) {
    surface.reserve(mesh.vertices(), 3 * mesh.faces() / 2, mesh.faces());
    for (size_t v = 0; v < mesh.vertices(); ++v) {
        const double* p = &mesh.positions[3 * v];
        surface.add_vertex(typename Surface::Point(p[0], p[1], p[2]));
    }
    for (size_t f = 0; f < mesh.faces(); ++f) {
        const uint32_t* corner = &mesh.corners[3 * f];
        surface.add_face(Vertex(corner[0]), Vertex(corner[1]), Vertex(corner[2]));
    }
}

template <class Vertex, class Surface>
Surface built(const Mesh& mesh) {
    Surface surface;
    build<Vertex>(mesh, surface);
    return surface;
}

// One request, and the answer to it.
struct Task {
    std::string name;
    Mesh mesh;
    const char* output;
    double seconds;
    std::vector<double> samples = {};
    double held = 0;

    // Times work on a state that is made anew for every sample, until so many seconds were spent in the work. Making a
    // state and dropping it is not timed. Answers with the last state.
    template <class Setup, class Work>
    auto timed(Setup setup, Work work) {
        for (double spent = 0;;) {
            auto state = setup();
            auto start = std::chrono::steady_clock::now();
            work(state);
            std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
            samples.push_back(1e9 * took.count());
            spent += took.count();
            if (spent >= seconds) return state;
        }
    }

    // Bytes held by what was made between the two calls.
    void start_of_memory() { held = heap_bytes(); }
    void end_of_memory() { samples.push_back(heap_bytes() - held); }

    void answer(size_t faces, const std::vector<double>& result = {}, const char* note = "") const {
        FILE* file = fopen(output, "wb");
        if (!file || fwrite(result.data(), 8, result.size(), file) != result.size()) exit(1);
        fclose(file);
        printf("{\"faces\":%zu,\"note\":\"%s\",\"samples\":[", faces, note);
        for (size_t k = 0; k < samples.size(); ++k) printf(k ? ",%.17g" : "%.17g", samples[k]);
        printf("]}\n");
    }

    // How many levels the task asks for, if it is one of Loop; else 0.
    int loop_levels() const {
        if (name == "loop4") return 4;
        return name == "loop1" || name == "shuffled" ? 1 : 0;
    }

    // Samples were taken of so many calls.
    void divide_samples(double calls) {
        for (double& sample : samples) sample /= calls;
    }

    static double heap_bytes() {
        struct mallinfo2 info = mallinfo2();
        return double(info.uordblks) + double(info.hblkhd);
    }
};

// Distances from vertex 0 by a queue. `around(v, visit)` calls `visit` for every neighbour.
struct Search {
    std::vector<uint32_t> distances, queue;

    explicit Search(size_t vertices) : distances(vertices, UINT32_MAX) { queue.reserve(vertices); }

    template <class Around>
    void run(Around around) {
        distances[0] = 0;
        queue.push_back(0);
        for (size_t head = 0; head < queue.size(); ++head) {
            uint32_t next = distances[queue[head]] + 1;
            around(queue[head], [&](uint32_t w) {
                if (distances[w] == UINT32_MAX) {
                    distances[w] = next;
                    queue.push_back(w);
                }
            });
        }
    }

    std::vector<double> result() const { return {distances.begin(), distances.end()}; }
};

// Without arguments a peer tells its version; a task that it does not know it leaves without an answer.
template <class Run>
int serve(int count, char** arguments, const std::string& version, Run run) {
    if (count < 5) {
        puts(version.c_str());
        return 0;
    }
    Task task{arguments[1], read(arguments[2]), arguments[3], atof(arguments[4])};
    run(task);
    return 0;
}
