// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_gltf.h"

#include "pipelines/command/extract/open_pack.h"

#include <fmt/format.h>

namespace hearth::command
{

using gltf_export::ExportSummary;
using namespace formats;

namespace
{

/// Append "3 meshes" if there are any.
void appendCount(std::string& text, size_t count, std::string_view singular, std::string_view plural)
{
    if (count > 0)
        text +=
            fmt::format("{}{} {}", text.ends_with(' ') ? "" : ", ", count, count == 1 ? singular : plural);
}

std::string describe(const ExportSummary& summary, const std::string& output)
{
    std::string text = output + ": ";
    appendCount(text, summary.nodes, "node", "nodes");
    appendCount(text, summary.meshes, "mesh", "meshes");
    appendCount(text, summary.triangles, "triangle", "triangles");
    appendCount(text, summary.materials, "material", "materials");
    appendCount(text, summary.images, "image", "images");
    appendCount(text, summary.skins, "skin", "skins");
    appendCount(text, summary.animations, "clip", "clips");
    appendCount(text, summary.lights, "light", "lights");
    appendCount(text, summary.cameras, "camera", "cameras");
    text += '\n';
    if (!summary.omissions.empty())
        text += "not in the glTF file:\n";
    for (const std::string& line : summary.omissions)
        text += fmt::format("  {}\n", line);
    return text;
}

} // namespace

bool isGltfName(const std::string& output)
{
    return output.ends_with(".glb");
}

Result<std::string> extractGltf(const std::string& path, const gltf_export::ExportOptions& options,
                                const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView pack, openPack(path));
    if (options.mesh)
        HEARTH_TRY(checkMesh(pack, path, *options.mesh));
    HEARTH_ASSIGN_OR_RETURN(const ExportSummary summary, gltf_export::exportGltf(pack, options, output));
    return describe(summary, output);
}

} // namespace hearth::command
