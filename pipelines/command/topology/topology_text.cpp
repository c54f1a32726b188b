// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/topology/topology_report.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>

namespace hearth::command
{

namespace
{

/// Replace control characters in a name from a file, which could steer a terminal.
std::string printable(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; },
        '?');
    return text;
}

/// Return "3 shells (2 open, 1 outward of genus 1)".
std::string shellsText(const std::vector<topology::Shell>& shells)
{
    std::map<std::string, uint32_t> counts; // in the order of the alphabet: it repeats
    for (const topology::Shell& shell : shells)
    {
        std::string words = shellSideName(shell.side);
        if (shell.genus)
            words += fmt::format(" of genus {}", *shell.genus);
        ++counts[words];
    }
    std::string text = fmt::format("{} {}", shells.size(), shells.size() == 1 ? "shell" : "shells");
    std::string_view separator = " (";
    for (const auto& [words, count] : counts)
    {
        text += fmt::format("{}{} {}", separator, count, words);
        separator = ", ";
    }
    return counts.empty() ? text : text + ")";
}

std::string meshText(const MeshFindings& mesh)
{
    std::string text =
        fmt::format("\nmesh {} \"{}\": {} triangles, {} vertices at {} positions; {} {}, {}\n", mesh.mesh,
                    printable(mesh.name), mesh.triangles, mesh.vertices, mesh.positions, mesh.components,
                    mesh.components == 1 ? "component" : "components", shellsText(mesh.shells));
    for (const FindingGroup& group : mesh.groups)
        text += fmt::format("{:>10}  {}{}{}\n", group.count, describeFinding(group.finding).words,
                            group.detail.empty() ? "" : ": ", group.detail);
    return text;
}

/// True if the findings of a mesh are worse: of a worse kind first, then more of them.
bool isWorse(const MeshFindings& a, const MeshFindings& b)
{
    const auto key = [](const FindingGroup& group) { return std::pair(group.finding, ~group.count); };
    return std::lexicographical_compare(a.groups.begin(), a.groups.end(), b.groups.begin(), b.groups.end(),
                                        [&](const FindingGroup& x, const FindingGroup& y)
                                        { return key(x) < key(y); });
}

std::string adviceText(const std::vector<const MeshFindings*>& meshes)
{
    std::string text;
    for (size_t kind = 0; kind < findingKinds().size(); ++kind)
        if (std::any_of(meshes.begin(), meshes.end(),
                        [&](const MeshFindings* mesh)
                        { return findGroup(*mesh, static_cast<Finding>(kind)) != nullptr; }))
            text += fmt::format("  {}: {}\n", findingKinds()[kind].words, findingKinds()[kind].advice);
    return text.empty() ? "" : "\nadvice\n" + text;
}

} // namespace

std::string topologyText(const TopologyReport& report)
{
    std::vector<const MeshFindings*> faulty;
    for (const MeshFindings& mesh : report.meshes)
        if (!mesh.groups.empty())
            faulty.push_back(&mesh);
    std::stable_sort(faulty.begin(), faulty.end(),
                     [](const MeshFindings* a, const MeshFindings* b) { return isWorse(*a, *b); });
    std::string text =
        fmt::format("{}: {} {}, {} with findings. Vertices at equal positions count as one, copies of "
                    "triangles are left out of all other findings\n",
                    printable(report.source), report.meshes.size(),
                    report.meshes.size() == 1 ? "mesh" : "meshes", faulty.size());
    for (const MeshFindings* mesh : faulty)
        text += meshText(*mesh);
    // A mesh without findings has its line too: shells and genus are of interest.
    for (const MeshFindings& mesh : report.meshes)
        if (mesh.groups.empty())
            text += meshText(mesh);
    text += adviceText(faulty);
    if (!report.not_checked.empty())
        text += fmt::format("\nself-intersections were not checked: {}\n", printable(report.not_checked));
    return text;
}

} // namespace hearth::command
