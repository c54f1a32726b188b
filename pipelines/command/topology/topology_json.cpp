// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/topology/topology_report.h"

#include <algorithm>

namespace hearth::command
{

namespace
{

Json shellJson(const topology::Shell& shell, Float3 position)
{
    return {{"triangles", shell.triangles},
            {"side", shellSideName(shell.side)},
            {"is_closed", shell.is_closed},
            {"is_orientable", shell.is_orientable},
            {"reversed_triangles", shell.reversed},
            {"doubled_triangles", shell.doubled},
            {"genus", shell.genus ? Json(*shell.genus) : Json()},
            {"area", shell.area},
            {"volume", shell.is_closed && shell.is_orientable ? Json(shell.volume) : Json()},
            {"position", {position.x, position.y, position.z}}};
}

Json shellsJson(const MeshFindings& mesh)
{
    Json list = Json::array();
    for (size_t i = 0; i < std::min(mesh.shells.size(), kMaxListed); ++i)
        list.push_back(shellJson(mesh.shells[i], mesh.shell_positions[i]));
    const auto closed = std::count_if(mesh.shells.begin(), mesh.shells.end(),
                                      [](const topology::Shell& shell) { return shell.is_closed; });
    return {{"count", mesh.shells.size()}, {"closed", closed}, {"list", std::move(list)}};
}

Json meshJson(const MeshFindings& mesh, bool has_intersections)
{
    Json json{{"index", mesh.mesh},          {"name", mesh.name},           {"triangles", mesh.triangles},
              {"vertices", mesh.vertices},   {"positions", mesh.positions}, {"components", mesh.components},
              {"tolerance", mesh.tolerance}, {"shells", shellsJson(mesh)}};
    for (size_t kind = 0; kind < findingKinds().size(); ++kind)
    {
        const auto finding = static_cast<Finding>(kind);
        if (finding == Finding::self_intersections && !has_intersections)
            continue;
        const FindingGroup* const group = findGroup(mesh, finding);
        Json counted{{"count", group == nullptr ? 0 : group->count}};
        if (group != nullptr)
            counted.update(group->json);
        json[findingKinds()[kind].key] = std::move(counted);
    }
    return json;
}

} // namespace

std::string topologyJson(const TopologyReport& report)
{
    Json json{{"schema", "hearth.topology/1"}, {"source", report.source}};
    if (!report.not_checked.empty())
        json["self_intersections_not_checked"] = report.not_checked;
    json["meshes"] = Json::array();
    for (const MeshFindings& mesh : report.meshes)
        json["meshes"].push_back(meshJson(mesh, report.not_checked.empty()));
    return json.dump(1) + "\n";
}

} // namespace hearth::command
