// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/wrap_part.h"

#include "cook/json/json.h"
#include "cook/tools/open_part.h"
#include "cook/wrap/thread_time.h"

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <numeric>

namespace hearth::wrap
{

namespace
{

constexpr size_t kMaxListedPairs = 1000;

bool hasMesh(const formats::ContainerReader& part, uint32_t index)
{
    return part.find(formats::kChunkSourceMesh, index) != nullptr;
}

/// Read a mesh, without its triangles if an artist made a proxy for it: it needs no wrap.
Result<mesh::SourceMesh> readMesh(const formats::PackView& part, uint32_t index)
{
    HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh mesh, mesh::readSourceMesh(part.container(), index));
    if (std::ranges::binary_search(part.proxies(), index, {}, &formats::ProxyRecord::mesh))
    {
        mesh.indices.clear();
        mesh.triangle_materials.clear();
    }
    return mesh;
}

/// Meshes of a part that share a wrap: they have the same positions and triangles, in the same order.
struct SharedWraps
{
    std::vector<uint32_t> first_of_mesh; ///< the first mesh of that shape, which may be the mesh itself
    std::vector<uint32_t> last_of_first; ///< the last mesh of the shape of a first mesh
};

Result<SharedWraps> findSharedWraps(const formats::PackView& part)
{
    SharedWraps shared;
    std::map<std::array<uint64_t, 2>, uint32_t> first_of_shape; // by hashes
    for (uint32_t index = 0; hasMesh(part.container(), index); ++index)
    {
        HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh mesh, readMesh(part, index));
        const std::array<uint64_t, 2> shape{formats::hashBytes(std::as_bytes(std::span(mesh.positions))),
                                            formats::hashBytes(std::as_bytes(std::span(mesh.indices)))};
        const uint32_t first = first_of_shape.emplace(shape, index).first->second;
        shared.first_of_mesh.push_back(first);
        shared.last_of_first.push_back(index);
        shared.last_of_first[first] = index;
    }
    return shared;
}

/// Wrap the shape of a mesh. The result has the numbers of source triangles in place of materials, for all
/// meshes of the shape.
Result<mesh::SourceMesh> wrapShape(mesh::SourceMesh& source, uint32_t index, const std::string& file,
                                   const WrapOptions& options)
{
    std::vector<uint32_t> numbers(source.triangleCount());
    std::iota(numbers.begin(), numbers.end(), 0u);
    source.triangle_materials.swap(numbers);
    Result<mesh::SourceMesh> shape = wrapMesh(source, options, file, index);
    source.triangle_materials.swap(numbers);
    return shape;
}

/// Return the wrap of a mesh.
///
/// shape  wrapShape of a mesh of its shape
mesh::SourceMesh makeWrap(const mesh::SourceMesh& shape, const mesh::SourceMesh& source)
{
    mesh::SourceMesh wrap = shape;
    wrap.name = source.name;
    for (uint32_t& material : wrap.triangle_materials)
        material = source.triangle_materials[material];
    return wrap;
}

} // namespace

Result<std::vector<WrapStatistics>> wrapPart(const std::string& import_path, const std::string& output_path,
                                             const WrapOptions& options)
{
    struct Work
    {
        uint32_t index;
        Result<mesh::SourceMesh> source;
        std::optional<Result<mesh::SourceMesh>> shape; ///< of the first mesh of its shape
        double seconds = 0;
    };
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView part, tools::openPart(import_path));
    HEARTH_ASSIGN_OR_RETURN(const SharedWraps shared, findSharedWraps(part));
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerWriter writer,
                            formats::ContainerWriter::create(output_path, formats::ContainerKind::part));
    std::vector<WrapStatistics> statistics;
    std::map<uint32_t, mesh::SourceMesh> shapes; // of first meshes of which copies follow
    Status status = success();
    std::atomic<bool> has_failed = false;
    uint32_t next = 0;
    const auto load = [&](tbb::flow_control& flow) -> std::shared_ptr<Work>
    {
        if (has_failed || next == shared.first_of_mesh.size())
        {
            flow.stop();
            return nullptr;
        }
        const uint32_t index = next++;
        return std::make_shared<Work>(Work{index, readMesh(part, index), {}});
    };
    const auto wrap = [&](std::shared_ptr<Work> work)
    {
        if (work->source.ok() && shared.first_of_mesh[work->index] == work->index)
        {
            const double start = threadSeconds();
            work->shape = wrapShape(work->source.value(), work->index, import_path, options);
            work->seconds = threadSeconds() - start;
        }
        return work;
    };
    const auto writeWrap = [&](Work& work) -> Status
    {
        HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh source, std::move(work.source));
        const uint32_t first = shared.first_of_mesh[work.index];
        if (work.shape)
        {
            HEARTH_ASSIGN_OR_RETURN(shapes[first], *std::move(work.shape));
        }
        const mesh::SourceMesh wrap = makeWrap(shapes.at(first), source);
        if (shared.last_of_first[first] == work.index)
            shapes.erase(first);
        statistics.push_back({.name = source.name,
                              .source_triangles = static_cast<uint32_t>(source.triangleCount()),
                              .triangles = static_cast<uint32_t>(wrap.triangleCount()),
                              .seconds = work.seconds});
        return mesh::writeSourceMesh(writer, work.index, wrap);
    };
    const auto write = [&](const std::shared_ptr<Work>& work)
    {
        if (!has_failed)
            status = writeWrap(*work);
        has_failed = has_failed || !status.ok();
    };
    tbb::parallel_pipeline(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism),
        tbb::make_filter<void, std::shared_ptr<Work>>(tbb::filter_mode::serial_in_order, load) &
            tbb::make_filter<std::shared_ptr<Work>, std::shared_ptr<Work>>(tbb::filter_mode::parallel, wrap) &
            tbb::make_filter<std::shared_ptr<Work>, void>(tbb::filter_mode::serial_in_order, write));
    HEARTH_TRY(std::move(status));
    HEARTH_TRY(writer.finish());
    return statistics;
}

Result<std::string> describeSelfIntersections(const std::string& import_path, double max_seconds)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView part, tools::openPart(import_path));
    const double end = threadSeconds() + max_seconds;
    Json meshes = Json::array();
    for (uint32_t index = 0; hasMesh(part.container(), index); ++index)
    {
        HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh mesh, mesh::readSourceMesh(part.container(), index));
        std::vector<uint32_t> numbers;
        const Surface surface = makeSurface(mesh, &numbers);
        const std::optional<SelfIntersections> found =
            findSelfIntersections(surface, kMaxListedPairs, end - threadSeconds());
        if (!found)
            return Error{Issue::input_too_large, import_path, meshText(index, mesh.name),
                         fmt::format("self-intersections up to it take more than {:g} s of processor time",
                                     max_seconds)};
        Json pairs = Json::array();
        for (const TrianglePair& pair : found->pairs)
            pairs.push_back(Json::array({numbers[pair.a], numbers[pair.b]}));
        meshes.push_back({{"mesh", index},
                          {"name", mesh.name},
                          {"intersecting_triangle_pairs", found->count},
                          {"pairs", std::move(pairs)}});
    }
    return Json{{"meshes", std::move(meshes)}}.dump() + "\n";
}

} // namespace hearth::wrap
