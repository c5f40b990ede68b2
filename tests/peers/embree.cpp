// Trees and rays of Embree 3, for `docs/bvh.md` and `docs/cpu.md`. It is compiled and called by `tests/src/embree.rs`.
//
//   embree build   QUALITY SCENE TREE        builds a binary tree with `rtcBuildBVH` and writes it
//   embree trace   QUALITY SCENE RAYS HITS   builds a scene, traces the rays one by one and writes what they hit
//
// QUALITY is `medium`, `high` or, for `trace`, `robust`, which is `high` with every precaution against rays that slip
// through. All on one thread. Both print the CPU seconds of the build, or of the loop over the rays alone.
//
// Files are little endian, counts are u64:
//   SCENE  count, corners of triangles (9 f32 each); count, spheres (centre and radius, 4 f32 each)
//   TREE   counts of nodes and of indices; nodes (lower corner, first, upper corner, count: 32 bytes each); indices.
//          A leaf (count > 0) holds indices from `first`; an inner node has its children at `first` and `first` + 1.
//   RAYS   count; origin, t_min, direction, t_max (8 f32), and a u32 that is 1 if any hit will do
//   HITS   count; distances (f32), -1 for none, 0 for any hit

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>
#if defined(__SSE__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace {

struct Triangle {
    float corners[3][3];
};

struct Sphere {
    float center[3];
    float radius;
};

struct Ray {
    float origin[3];
    float t_min;
    float dir[3];
    float t_max;
    std::uint32_t any;
};

struct Scene {
    std::vector<Triangle> triangles;
    std::vector<Sphere> spheres;
};

double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

template <typename T>
std::vector<T> read(std::ifstream& file) {
    std::uint64_t count = 0;
    file.read(reinterpret_cast<char*>(&count), sizeof count);
    std::vector<T> all(count);
    file.read(reinterpret_cast<char*>(all.data()), count * sizeof(T));
    return all;
}

std::ifstream input(const char* path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(std::string("cannot read ") + path);
    file.exceptions(std::ios::failbit | std::ios::badbit);
    return file;
}

template <typename T>
void write(std::ofstream& file, const std::vector<T>& all) {
    file.write(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(T));
}

void write_count(std::ofstream& file, std::uint64_t count) {
    file.write(reinterpret_cast<const char*>(&count), sizeof count);
}

void fail(void*, RTCError, const char* what) {
    std::cerr << "embree: " << what << '\n';
    std::exit(1);
}

RTCDevice device() {
    RTCDevice device = rtcNewDevice("threads=1");
    rtcSetDeviceErrorFunction(device, fail, nullptr);
    return device;
}

RTCBuildQuality quality(const std::string& name) {
    return name == "medium" ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH;
}

// --- Trees ---

struct Node {
    RTCBounds bounds[2];
    Node* children[2];
    // Of a leaf.
    std::size_t count;
    std::uint32_t* indices;
};

struct Written {
    float lower[3];
    std::uint32_t first;
    float upper[3];
    std::uint32_t count;
};

// Grows from nothing.
struct Box {
    float lower[3] = {INFINITY, INFINITY, INFINITY};
    float upper[3] = {-INFINITY, -INFINITY, -INFINITY};

    void add(const float* point) {
        for (int axis = 0; axis < 3; axis++) {
            lower[axis] = std::min(lower[axis], point[axis]);
            upper[axis] = std::max(upper[axis], point[axis]);
        }
    }

    // What of it is in the bounds of `within`.
    RTCBounds in(const RTCBuildPrimitive& within) const {
        return {std::max(lower[0], within.lower_x), std::max(lower[1], within.lower_y),
                std::max(lower[2], within.lower_z), 0,
                std::min(upper[0], within.upper_x), std::min(upper[1], within.upper_y),
                std::min(upper[2], within.upper_z), 0};
    }
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node{};
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* all, std::size_t count, void*) {
    Node* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node{};
    leaf->count = count;
    leaf->indices = static_cast<std::uint32_t*>(rtcThreadLocalAlloc(allocator, 4 * count, 16));
    for (std::size_t i = 0; i < count; i++) leaf->indices[i] = all[i].primID;
    return leaf;
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; i++) static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; i++) static_cast<Node*>(node)->bounds[i] = *bounds[i];
}

// The bounds of what of a triangle lies on either side of a plane.
void split(const RTCBuildPrimitive* all, unsigned axis, float at, RTCBounds* left, RTCBounds* right, void* scene) {
    const Triangle& triangle = static_cast<const Scene*>(scene)->triangles[all->primID];
    Box below, above;
    for (int i = 0; i < 3; i++) {
        const float* a = triangle.corners[i];
        const float* b = triangle.corners[(i + 1) % 3];
        if (a[axis] <= at) below.add(a);
        if (a[axis] >= at) above.add(a);
        if ((a[axis] < at && at < b[axis]) || (b[axis] < at && at < a[axis])) {
            const float along = (at - a[axis]) / (b[axis] - a[axis]);
            float cut[3];
            for (int k = 0; k < 3; k++) cut[k] = a[k] + along * (b[k] - a[k]);
            cut[axis] = at;
            below.add(cut);
            above.add(cut);
        }
    }
    *left = below.in(*all);
    *right = above.in(*all);
}

std::vector<RTCBuildPrimitive> primitives(const std::vector<Triangle>& triangles) {
    std::vector<RTCBuildPrimitive> all;
    for (std::uint32_t i = 0; i < triangles.size(); i++) {
        Box box;
        for (const auto& corner : triangles[i].corners) box.add(corner);
        all.push_back({box.lower[0], box.lower[1], box.lower[2], 0, box.upper[0], box.upper[1], box.upper[2], i});
    }
    return all;
}

Node* build(RTCBVH tree, const Scene& scene, const std::string& name, std::vector<RTCBuildPrimitive>& all) {
    const bool splits = quality(name) == RTC_BUILD_QUALITY_HIGH;
    const std::size_t count = all.size();
    all.reserve(splits ? count * 3 / 2 : count);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = quality(name);
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = 64;
    arguments.sahBlockSize = 1;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = 8;
    arguments.traversalCost = 1;
    arguments.intersectionCost = 1;
    arguments.bvh = tree;
    arguments.primitives = all.data();
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = all.capacity();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.splitPrimitive = splits ? split : nullptr;
    arguments.userPtr = const_cast<Scene*>(&scene);
    return static_cast<Node*>(rtcBuildBVH(&arguments));
}

Written with_bounds(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, 0, {b.upper_x, b.upper_y, b.upper_z}, 0};
}

void write_tree(const Node* root, const char* path) {
    std::vector<Written> nodes;
    std::vector<std::uint32_t> indices;
    struct Waiting {
        const Node* node;
        std::size_t at;
    };
    // Nobody looks at the box of the root.
    nodes.push_back({});
    std::vector<Waiting> waiting{{root, 0}};
    while (!waiting.empty()) {
        const auto [node, at] = waiting.back();
        waiting.pop_back();
        if (node->count > 0) {
            nodes[at].first = indices.size();
            nodes[at].count = node->count;
            indices.insert(indices.end(), node->indices, node->indices + node->count);
            continue;
        }
        const std::size_t first = nodes.size();
        nodes[at].first = first;
        for (int i = 0; i < 2; i++) nodes.push_back(with_bounds(node->bounds[i]));
        for (int i = 1; i >= 0; i--) waiting.push_back({node->children[i], first + i});
    }
    std::ofstream file(path, std::ios::binary);
    write_count(file, nodes.size());
    write_count(file, indices.size());
    write(file, nodes);
    write(file, indices);
}

// --- Rays ---

void attach(RTCScene into, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(into, geometry);
    rtcReleaseGeometry(geometry);
}

RTCScene commit(RTCDevice device, const Scene& scene, const std::string& name) {
    RTCScene into = rtcNewScene(device);
    rtcSetSceneBuildQuality(into, quality(name));
    if (name == "robust") rtcSetSceneFlags(into, RTC_SCENE_FLAG_ROBUST);
    if (const std::size_t count = scene.triangles.size()) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* corners = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * count));
        std::copy(scene.triangles.begin(), scene.triangles.end(), corners);
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, count));
        for (std::uint32_t i = 0; i < 3 * count; i++) indices[i] = i;
        attach(into, geometry);
    }
    if (const std::size_t count = scene.spheres.size()) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        auto* spheres = static_cast<Sphere*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, count));
        std::copy(scene.spheres.begin(), scene.spheres.end(), spheres);
        attach(into, geometry);
    }
    rtcCommitScene(into);
    return into;
}

float trace(RTCScene scene, RTCIntersectContext& context, const Ray& ray) {
    RTCRayHit asked;
    asked.ray = {ray.origin[0], ray.origin[1], ray.origin[2], ray.t_min, ray.dir[0], ray.dir[1], ray.dir[2], 0,
                 ray.t_max, 0xffffffffu, 0, 0};
    if (ray.any) {
        rtcOccluded1(scene, &context, &asked.ray);
        return asked.ray.tfar < 0 ? 0 : -1;
    }
    asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &asked);
    return asked.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : asked.ray.tfar;
}

int run(int n, char** arguments) {
    const std::string task = n > 1 ? arguments[1] : "";
    if (!(task == "build" && n == 5) && !(task == "trace" && n == 6)) {
        std::cerr << "usage: embree build QUALITY SCENE TREE | embree trace QUALITY SCENE RAYS HITS\n";
        return 2;
    }
    const std::string name = arguments[2];
    std::ifstream file = input(arguments[3]);
    Scene scene{read<Triangle>(file), read<Sphere>(file)};
    RTCDevice embree = device();
    if (task == "build") {
        std::vector<RTCBuildPrimitive> all = primitives(scene.triangles);
        RTCBVH tree = rtcNewBVH(embree);
        const double start = cpu_seconds();
        const Node* root = build(tree, scene, name, all);
        std::cout << "cpu " << cpu_seconds() - start << '\n';
        write_tree(root, arguments[4]);
        return 0;
    }
    RTCScene committed = commit(embree, scene, name);
    std::ifstream asked = input(arguments[4]);
    const std::vector<Ray> rays = read<Ray>(asked);
    std::vector<float> hits(rays.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const double start = cpu_seconds();
    for (std::size_t i = 0; i < rays.size(); i++) hits[i] = trace(committed, context, rays[i]);
    std::cout << "cpu " << cpu_seconds() - start << '\n';
    std::ofstream answers(arguments[5], std::ios::binary);
    write_count(answers, hits.size());
    write(answers, hits);
    return 0;
}

}  // namespace

int main(int n, char** arguments) {
#if defined(__SSE__)
    // As Embree's manual advises.
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
    try {
        return run(n, arguments);
    } catch (const std::exception& error) {
        std::cerr << "embree: " << error.what() << '\n';
        return 1;
    }
}
