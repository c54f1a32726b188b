// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/wrap_part.h"

#include "cook/json/json.h"
#include "cook/tools/open_part.h"
#include "cook/wrap/thread_time.h"

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <memory>

namespace hearth::wrap
{

namespace
{

constexpr size_t kMaxListedPairs = 1000;

struct Wrapped
{
    Result<mesh::SourceMesh> mesh;
    WrapStatistics statistics;
};

Wrapped wrapOne(const Result<mesh::SourceMesh>& source, uint32_t index, const std::string& file,
                const WrapOptions& options)
{
    if (!source.ok())
        return {source.error(), {}};
    const double start = threadSeconds();
    WrapStatistics statistics{.name = source.value().name,
                              .source_triangles = static_cast<uint32_t>(source.value().triangleCount())};
    Result<mesh::SourceMesh> mesh = wrapMesh(source.value(), options, file, index);
    if (mesh.ok())
        statistics.triangles = static_cast<uint32_t>(mesh.value().triangleCount());
    statistics.seconds = threadSeconds() - start;
    return {std::move(mesh), std::move(statistics)};
}

bool hasMesh(const formats::ContainerReader& part, uint32_t index)
{
    return part.find(formats::kChunkSourceMesh, index) != nullptr;
}

} // namespace

Result<std::vector<WrapStatistics>> wrapPart(const std::string& import_path, const std::string& output_path,
                                             const WrapOptions& options)
{
    struct Work
    {
        uint32_t index;
        Result<mesh::SourceMesh> source;
    };
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView part, tools::openPart(import_path));
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerWriter writer,
                            formats::ContainerWriter::create(output_path, formats::ContainerKind::part));
    std::vector<WrapStatistics> statistics;
    Status status = success();
    std::atomic<bool> has_failed = false;
    uint32_t next = 0;
    const auto load = [&](tbb::flow_control& flow) -> std::shared_ptr<Work>
    {
        if (has_failed || !hasMesh(part.container(), next))
        {
            flow.stop();
            return nullptr;
        }
        const uint32_t index = next++;
        auto work = std::make_shared<Work>(Work{index, mesh::readSourceMesh(part.container(), index)});
        // a mesh for which an artist made a proxy needs no wrap
        if (work->source.ok() &&
            std::ranges::binary_search(part.proxies(), index, {}, &formats::ProxyRecord::mesh))
            work->source.value().indices.clear();
        return work;
    };
    const auto wrap = [&](const std::shared_ptr<Work>& work)
    { return std::make_shared<Wrapped>(wrapOne(work->source, work->index, import_path, options)); };
    const auto write = [&](const std::shared_ptr<Wrapped>& wrapped)
    {
        if (has_failed)
            return;
        status = wrapped->mesh.ok() ? mesh::writeSourceMesh(writer, static_cast<uint32_t>(statistics.size()),
                                                            wrapped->mesh.value())
                                    : Status(wrapped->mesh.error());
        has_failed = !status.ok();
        statistics.push_back(std::move(wrapped->statistics));
    };
    tbb::parallel_pipeline(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism),
        tbb::make_filter<void, std::shared_ptr<Work>>(tbb::filter_mode::serial_in_order, load) &
            tbb::make_filter<std::shared_ptr<Work>, std::shared_ptr<Wrapped>>(tbb::filter_mode::parallel,
                                                                              wrap) &
            tbb::make_filter<std::shared_ptr<Wrapped>, void>(tbb::filter_mode::serial_in_order, write));
    HEARTH_TRY(std::move(status));
    HEARTH_TRY(writer.finish());
    return statistics;
}

Result<std::string> describeSelfIntersections(const std::string& import_path, double max_seconds)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView part, tools::openPart(import_path));
    Json meshes = Json::array();
    for (uint32_t index = 0; hasMesh(part.container(), index); ++index)
    {
        HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh mesh, mesh::readSourceMesh(part.container(), index));
        std::vector<uint32_t> numbers;
        const Surface surface = makeSurface(mesh, &numbers);
        const std::optional<SelfIntersections> found =
            findSelfIntersections(surface, kMaxListedPairs, max_seconds);
        if (!found)
            return Error{
                Issue::input_too_large, import_path, meshText(index, mesh.name),
                fmt::format("its self-intersections take more than {:g} s of processor time", max_seconds)};
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
