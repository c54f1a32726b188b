// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/compare_part.h"

#include "tests/import_values/compare_meshes.h"

#include <exception>
#include <map>

namespace hearth::test
{

namespace
{

/// Return the source mesh of each mesh of the part; levels of detail have none.
std::map<uint32_t, size_t> mapMeshes(const SourceModel& source, const formats::PackView& part,
                                     Comparison& comparison)
{
    std::map<uint32_t, size_t> source_of_part;
    for (size_t mesh = 0; mesh < source.model.meshes.size(); ++mesh)
        source_of_part[static_cast<uint32_t>(mesh)] = mesh;
    for (size_t node = 0; node < source.model.nodes.size() && node < part.nodes().size(); ++node)
    {
        const int mesh = source.model.nodes[node].mesh;
        const uint32_t in_part = part.nodes()[node].mesh;
        comparison.checkEqual(mesh >= 0 ? 1 : 0, in_part != kInvalidIndex ? 1 : 0, "mesh of node", node);
        if (mesh >= 0 && in_part != kInvalidIndex)
            comparison.checkEqual(
                mesh,
                static_cast<long long>(
                    source_of_part.try_emplace(in_part, static_cast<size_t>(mesh)).first->second),
                "mesh of node", node);
    }
    return source_of_part;
}

uint32_t countMeshes(const formats::PackView& part)
{
    uint32_t count = 0;
    while (part.container().find(formats::kChunkSourceMesh, count) != nullptr)
        ++count;
    return count;
}

/// True if a node draws the mesh of the part by a skin.
bool isSkinned(const formats::PackView& part, uint32_t mesh)
{
    for (const formats::NodeRecord& node : part.nodes())
        if (node.mesh == mesh && node.skin != kInvalidIndex)
            return true;
    return false;
}

} // namespace

void compareMeshes(const SourceModel& source, const formats::PackView& part, Comparison& comparison)
{
    const std::map<uint32_t, size_t> source_of_part = mapMeshes(source, part, comparison);
    const bool has_levels = part.container().find(formats::kChunkAuthoredLods) != nullptr;
    std::map<size_t, std::vector<SourcePiece>> pieces_of_mesh;
    const uint32_t count = countMeshes(part);
    for (uint32_t mesh = 0; mesh < count; ++mesh)
    {
        const auto found = source_of_part.find(mesh);
        const auto read = mesh::readSourceMesh(part.container(), mesh);
        if (!read.ok())
            return comparison.fail("mesh " + std::to_string(mesh) + " of the part cannot be read");
        if (has_levels && (found == source_of_part.end() || read->triangleCount() == 0))
        {
            comparison.exclude(Exclusion::generated_level);
            continue;
        }
        if (found == source_of_part.end())
            return comparison.fail("mesh " + std::to_string(mesh) + " of the part is of no source mesh");
        if (!pieces_of_mesh.contains(found->second))
            pieces_of_mesh[found->second] = readPieces(source, source.model.meshes[found->second]);
        compareMesh(pieces_of_mesh[found->second], *read, isSkinned(part, mesh), comparison);
    }
    comparison.checkEqual(1, count >= source.model.meshes.size() ? 1 : 0, "meshes of the part", 0);
}

Comparison comparePart(const std::string& source_path, const std::string& part_path, const std::string& name)
{
    Comparison comparison(name);
    const SourceModel source = readSourceModel(source_path);
    if (!source.error.empty())
    {
        comparison.fail(source.error);
        return comparison;
    }
    auto reader = formats::ContainerReader::open(part_path);
    auto part = reader.ok() ? formats::PackView::read(std::move(reader).value())
                            : Result<formats::PackView>(reader.error());
    if (!part.ok())
    {
        comparison.fail("the part cannot be read");
        return comparison;
    }
    try
    {
        compareMeshes(source, *part, comparison);
        compareNodes(source, *part, comparison);
        compareInstances(source, *part, comparison);
        compareSkins(source, *part, comparison);
        compareAnimations(source, *part, comparison);
        compareMaterials(source, *part, comparison);
    }
    catch (const std::exception& exception)
    {
        comparison.fail(std::string("the source cannot be read: ") + exception.what());
    }
    return comparison;
}

} // namespace hearth::test
