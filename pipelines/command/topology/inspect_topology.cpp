// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/topology/inspect_topology.h"

#include "cook/tools/open_part.h"
#include "formats/base/atomic_file.h"
#include "formats/base/temp_directory.h"
#include "pipelines/command/shell/run_programs.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/topology/self_intersections.h"
#include "pipelines/command/topology/topology_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace hearth::command
{

namespace
{

/// True if the file begins as packs and parts do.
bool isContainer(const std::string& path)
{
    std::array<uint8_t, sizeof(formats::kMagic)> bytes{};
    std::FILE* const file = std::fopen(path.c_str(), "rb");
    if (file == nullptr)
        return false;
    const size_t count = std::fread(bytes.data(), 1, bytes.size(), file);
    std::fclose(file);
    return count == bytes.size() && std::memcmp(bytes.data(), formats::kMagic, bytes.size()) == 0;
}

/// Return where each mesh has its first instance.
std::vector<Affine3> findPlacements(const formats::PackView& part, size_t mesh_count)
{
    std::vector<Affine3> placements(mesh_count);
    std::vector<bool> is_placed(mesh_count, false);
    for (const formats::InstanceRecord& instance : part.instances())
        if (instance.mesh < mesh_count && !is_placed[instance.mesh])
        {
            placements[instance.mesh] = instance.world_from_object;
            is_placed[instance.mesh] = true;
        }
    return placements;
}

Result<TopologyReport> makeReport(const std::string& path, const TopologyOptions& options,
                                  const SelfIntersectionCheck& check)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView part, tools::openPart(path));
    TopologyReport report{options.source, check.not_checked, {}, {}};
    for (uint32_t index = 0; part.container().find(formats::kChunkSourceMesh, index) != nullptr; ++index)
    {
        HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh mesh, mesh::readSourceMesh(part.container(), index));
        std::optional<SelfIntersections> intersections;
        if (check.not_checked.empty())
        {
            const auto found = check.meshes.find(index);
            intersections = found == check.meshes.end() ? SelfIntersections{} : found->second;
        }
        report.meshes.push_back(collectFindings(mesh, index, intersections));
        if (options.ply.empty()) // a scene's findings need not be in memory all at once
            for (FindingGroup& group : report.meshes.back().groups)
                group.geometry = {};
    }
    report.placements = findPlacements(part, report.meshes.size());
    return report;
}

/// Write a file for each kind of findings that can be drawn. Files of kinds that are mended are
/// removed, so that the folder shows the source as it is.
Status writePlyFolder(const TopologyReport& report, const std::string& folder)
{
    for (size_t kind = 0; kind < findingKinds().size(); ++kind)
    {
        const auto finding = static_cast<Finding>(kind);
        const std::string path = folder + "/" + std::string(findingKinds()[kind].key) + ".ply";
        const bool is_drawn = std::any_of(report.meshes.begin(), report.meshes.end(),
                                          [&](const MeshFindings& mesh)
                                          {
                                              const FindingGroup* const group = findGroup(mesh, finding);
                                              return group != nullptr && !group->geometry.positions.empty();
                                          });
        std::error_code ignored; // usually there is none
        if (is_drawn)
            HEARTH_TRY(writeText(path, topologyPly(report, finding)));
        else
            std::filesystem::remove(path, ignored);
    }
    return success();
}

Status writePly(const TopologyReport& report, const std::string& output)
{
    std::error_code ignored; // what is no folder is a file to write
    if (std::filesystem::is_directory(output, ignored))
        return writePlyFolder(report, output);
    return writeText(output, topologyPly(report, std::nullopt));
}

} // namespace

int inspectTopology(const TopologyOptions& options)
{
    const std::string& output = options.ply.empty() ? options.source : options.ply;
    const Result<TempDirectory> folder = TempDirectory::create(temporaryFolderOr("/tmp"), output);
    if (!folder.ok())
        return printError(folder.error());
    std::string part = options.source;
    if (!isContainer(options.source))
    {
        part = folder->path() + "/source.import.part";
        if (const auto failure = runPrograms({{"import", options.source, {options.source, "-o", part}}}))
        {
            printMessage(failure->error);
            return failure->exit_code;
        }
    }
    const SelfIntersectionCheck check = findSelfIntersections(part, folder->path(), options.source);
    if (check.is_interrupted)
        return kInterrupted;
    const Result<TopologyReport> report = makeReport(part, options, check);
    if (!report.ok())
        return printError(report.error());
    if (!options.ply.empty())
        if (const Status status = writePly(*report, options.ply); !status.ok())
            return printError(status.error());
    return printResult(options.is_json ? topologyJson(*report) : topologyText(*report));
}

} // namespace hearth::command
