// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/topology/topology_report.h"

#include <cstring>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

/// Append the bytes of values, which are little-endian as all machines that Hearth runs on.
template <typename... Values>
void append(std::string& bytes, Values... values)
{
    const auto add = [&](const auto& value)
    { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    (add(values), ...);
}

/// Rows of a PLY file's elements.
struct Rows
{
    std::string bytes;
    uint32_t count = 0;

    template <typename... Values>
    void add(Values... values)
    {
        append(bytes, values...);
        ++count;
    }
};

} // namespace

std::string topologyPly(const TopologyReport& report, std::optional<Finding> only)
{
    Rows vertices, faces, edges;
    std::vector<uint64_t> counts(findingKinds().size(), 0);
    for (size_t i = 0; i < report.meshes.size(); ++i)
        for (const FindingGroup& group : report.meshes[i].groups)
        {
            if (only && *only != group.finding)
                continue;
            const uint32_t first = vertices.count;
            const auto [red, green, blue] = describeFinding(group.finding).color;
            for (const Float3 position : group.geometry.positions)
            {
                const Float3 p = transformPoint(report.placements[i], position);
                vertices.add(p.x, p.y, p.z, red, green, blue);
            }
            for (const auto& [a, b, c] : group.geometry.faces)
                faces.add(uint8_t{3}, first + a, first + b, first + c, red, green, blue);
            for (const auto& [a, b] : group.geometry.edges)
                edges.add(first + a, first + b, red, green, blue);
            counts[static_cast<size_t>(group.finding)] += group.count;
        }

    std::string text =
        "ply\nformat binary_little_endian 1.0\ncomment findings of hearth inspect --topology\n";
    for (size_t kind = 0; kind < findingKinds().size(); ++kind)
        if (counts[kind] > 0)
        {
            const auto [red, green, blue] = findingKinds()[kind].color;
            text += fmt::format("comment {} {}: colour {} {} {}\n", counts[kind], findingKinds()[kind].words,
                                red, green, blue);
        }
    constexpr std::string_view kColor = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    text += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}",
                        vertices.count, kColor);
    text += fmt::format("element face {}\nproperty list uchar uint vertex_indices\n{}", faces.count, kColor);
    text += fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\n{}end_header\n",
                        edges.count, kColor);
    return text + vertices.bytes + faces.bytes + edges.bytes;
}

} // namespace hearth::command
