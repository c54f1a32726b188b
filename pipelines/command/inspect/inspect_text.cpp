// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/image_error.h"
#include "pipelines/command/inspect/inspect.h"
#include "pipelines/command/shell/terminal.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::command
{

using namespace formats;

namespace
{

/// Replace control characters in a name from a file, which could steer a terminal.
std::string printable(std::string_view name)
{
    std::string text(name);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; },
        '?');
    return text;
}

/// Return "E1103 rock.glb|/meshes/0: text".
std::string messageText(const MessageSummary& message)
{
    return fmt::format("{} {}{}{}: {}\n", printable(message.code), printable(message.source),
                       message.where.empty() ? "" : "|", printable(message.where), printable(message.text));
}

std::string headText(const PackView& pack, const PackSummary& summary)
{
    const FileHeader& header = pack.container().header();
    std::string text = fmt::format("{}: {} {}.{}, {}, {} meshes, {} instances\n", printable(pack.name()),
                                   pack.container().kind() == ContainerKind::pack ? "pack" : "part",
                                   header.version_major, header.version_minor, readableSize(header.file_size),
                                   pack.meshes().size(), pack.instances().size());
    for (const SourceSummary& source : summary.meta.sources)
        text += fmt::format("source     {} ({})\n", printable(source.name), readableSize(source.bytes));
    for (const MessageSummary& failure : summary.meta.skipped)
        text += "skipped    " + messageText(failure);
    text += "counts    ";
    for (const auto& [name, count] : summary.meta.counts)
        text += fmt::format(" {} {}", count, printable(name));
    return text + "\n";
}

std::string sceneText(const PackView& pack, const PackSummary& summary)
{
    return fmt::format(
        "scene      {} nodes, {} instances ({} triangles), {} cameras, {} lights, {} materials, "
        "{} images, {} skins, {} joints, {} animations, {} morph targets\n",
        pack.nodes().size(), pack.instances().size(), summary.instanced_triangles, pack.cameras().size(),
        pack.lights().size(), pack.materials().size(), pack.images().size(), pack.skins().size(),
        summary.joint_nodes, pack.animations().size(), summary.morph_targets);
}

/// Format "495 x 310 x 290 m".
std::string sizeText(Float3 size)
{
    return fmt::format("{:.3g} x {:.3g} x {:.3g} m", size.x, size.y, size.z);
}

std::string assetsText(const PackView& pack)
{
    std::string text;
    for (const AssetRecord& asset : pack.assets())
        text +=
            fmt::format("asset      \"{}\": {}, {} meshes, {} instances\n", printable(pack.text(asset.name)),
                        largestSide(asset) > 0 ? sizeText(asset.box_max - asset.box_min) : "draws nothing",
                        asset.meshes.count, asset.instances.count);
    return text;
}

std::string specularText(const PackView& pack)
{
    std::string text;
    for (const SpecularTableRecord& table : pack.specularTables())
        text += fmt::format("specular   table for {} masking, normal lambda {}, spaced by {}\n",
                            table.masking == 0 ? "separable" : "correlated", table.normal_lambda,
                            table.spacing == 0 ? "cosine" : "half sine");
    return text;
}

std::string pointText(Float3 point)
{
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", point.x, point.y, point.z);
}

std::string probesText(const PackView& pack)
{
    std::string text;
    for (const ProbeRecord& probe : pack.probes())
    {
        text += fmt::format("{:<10} {} x {} texels a face, {} mips, {}; mean irradiance ({:.4g}, {:.4g}, "
                            "{:.4g}), greatest value {:.4g} of its luminance\n",
                            (probe.flags & kProbeIsSky) != 0 ? "sky" : "probe", finestProbeSide(probe),
                            finestProbeSide(probe), countProbeMips(probe),
                            readableSize(probe.texels.count * sizeof(uint32_t)), probe.irradiance.x,
                            probe.irradiance.y, probe.irradiance.z, probe.largest);
        if (isLocalProbe(probe))
            text += fmt::format("{:<10} at {}, box {} to {}, lights {} to {}, fades over {:.4g} m\n", "",
                                pointText(probe.position), pointText(probe.box_min), pointText(probe.box_max),
                                pointText(probe.influence_min), pointText(probe.influence_max), probe.fade);
    }
    return text;
}

/// Return how many meshes have baked visibility.
std::string visibilityText(const PackView& pack)
{
    const auto baked = std::ranges::count_if(pack.meshes(), [](const MeshRecord& mesh)
                                             { return (mesh.attributes & kVertexVisibility) != 0; });
    if (baked == 0)
        return "visibility none: switched off in the cook\n";
    return fmt::format("visibility of {} of {} meshes, light of occluders in {} radiance transfers\n", baked,
                       pack.meshes().size(), pack.radianceTransfers().size());
}

std::string bricksText(const PackView& pack, const MetaSummary& meta)
{
    if (pack.brickGrid().empty())
        return "bricks     none: " +
               (meta.no_bricks.empty() ? "switched off in the cook" : printable(meta.no_bricks)) + "\n";
    std::string text;
    const BricksSummary summary = summarizeBricks(pack);
    for (const BrickGridRecord& grid : pack.brickGrid())
        text += fmt::format(
            "bricks     {} x {} x {} voxels of {} m from ({}, {}, {}): {} solid in {} bricks, {} faces; "
            "{} stored of {}\n",
            grid.voxels[0], grid.voxels[1], grid.voxels[2], grid.voxel_size, grid.origin.x, grid.origin.y,
            grid.origin.z, grid.solid_count, grid.brick_count, grid.face_count,
            readableSize(summary.stored_bytes), readableSize(summary.bytes));
    return text;
}

/// Describe receivers: texels, faces, lamps and rectangles. Nothing where the cook was not asked for them.
std::string receiversText(const PackView& pack, const MetaSummary& meta)
{
    if (pack.receivers().lamps.empty())
        return meta.no_receivers.empty() ? "" : "receivers  none: " + printable(meta.no_receivers) + "\n";
    const ReceiverTables tables = pack.receivers();
    const auto describe = [](const ReceiverAtlasRecord& atlas, const ReceiverBytes& sum, const char* unit)
    {
        const uint32_t count = std::max(atlas.texel_count, 1u);
        return fmt::format("{} stored of {}, {:.1f} bytes a {}\n", readableSize(sum.stored_bytes),
                           readableSize(sum.bytes), static_cast<double>(sum.bytes) / count, unit);
    };
    std::string text =
        fmt::format("receivers  {} x {}, {} texels in {}, {} lamps, {} rectangles; ", tables.atlas.width,
                    tables.atlas.height, tables.atlas.texel_count, receiverCodecName(tables.atlas.codec),
                    tables.lamps.size(), tables.rects.size());
    text += describe(tables.atlas, sumReceiverBytes(pack, kReceiverChunks), "texel");
    if (!pack.faceAtlases().empty())
    {
        const ReceiverAtlasRecord& faces = pack.faceAtlases()[0];
        text +=
            fmt::format("  {} faces of bricks in {}; ", faces.texel_count, receiverCodecName(faces.codec));
        text += describe(faces, sumReceiverBytes(pack, kFaceReceiverChunks), "face");
    }
    for (size_t i = 0; i < tables.lamps.size(); ++i)
    {
        const ReceiverLampSummary lamp = summarizeLamp(pack, tables.lamps[i]);
        const bool is_steady = tables.lamps[i].kind == static_cast<uint32_t>(ReceiverLampKind::steady);
        text += fmt::format("  lamp {}: {}", i, lamp.kind) +
                (is_steady ? "\n" : fmt::format(" {} \"{}\"\n", tables.lamps[i].index, printable(lamp.name)));
    }
    for (const ReceiverRectRecord& rect : tables.rects)
        text += fmt::format("  instance {} \"{}\": {} x {} texels at ({}, {}), UV set {}\n", rect.instance,
                            printable(readInstanceName(pack, rect.instance)), rect.width, rect.height, rect.x,
                            rect.y, rect.uv_set);
    return text;
}

/// Return ", within 0.002 m", or nothing where a proxy's distance is unknown.
std::string distanceText(const ProxyRecord& proxy)
{
    const float distance = std::max(proxy.distance, proxy.mesh_distance);
    return std::isfinite(distance) ? fmt::format(", within {:.3g} m", distance) : "";
}

/// Return " (3 convex)" of a proxy with convex sections; else nothing.
std::string convexText(const PackView& pack, const ProxyRecord& proxy)
{
    const auto is_convex = [](const ProxySectionRecord& section) { return section.is_convex != 0; };
    const auto count = std::ranges::count_if(recordsInRange(pack.proxySections(), proxy.sections), is_convex);
    return count > 0 ? fmt::format(" ({} convex)", count) : "";
}

/// Describe the proxies of meshes; nothing where there are none.
std::string proxiesText(const PackView& pack)
{
    std::string text;
    for (size_t i = 0; i < pack.proxies().size(); ++i)
    {
        const ProxyRecord& proxy = pack.proxies()[i];
        // the mesh of a part is in another one
        const std::string_view name = proxy.mesh < pack.meshes().size()
                                          ? pack.text(pack.meshes()[proxy.mesh].name)
                                          : std::string_view();
        text += fmt::format("proxy {} of mesh {} \"{}\": {}, {} triangles in {} sections{}, {}{}{}\n", i,
                            proxy.mesh, printable(name), proxyOriginName(proxy.origin),
                            proxy.indices.count / 3, proxy.sections.count, convexText(pack, proxy),
                            proxy.is_closed != 0 ? "closed" : "open", distanceText(proxy),
                            proxy.bindings.count != 0 ? ", with bindings" : "");
    }
    return text.empty() ? text : "\n" + text;
}

/// Return "  by hand: rock_LOD3.ply (LOD 3)" for an authored level; empty for other levels.
std::string authoredText(const LevelSummary& level)
{
    if (!level.authored)
        return "";
    std::string text = "  by hand";
    if (!level.authored->name.empty())
        text += ": " + printable(level.authored->name);
    return level.authored->number ? text + fmt::format(" (LOD {})", *level.authored->number) : text;
}

std::string meshText(const MeshSummary& mesh, size_t index)
{
    std::string text = fmt::format("\nmesh {} \"{}\": {} triangles, {} vertices, {} faces; {}\n", index,
                                   printable(mesh.name), mesh.source_triangles, mesh.source_vertices,
                                   mesh.source_faces, attributeNames(mesh.attributes));
    if (mesh.degenerate_triangles > 0)
        text += fmt::format("  {} triangles without area are left out\n", mesh.degenerate_triangles);
    if (mesh.skinned || mesh.morph_targets > 0)
        text += fmt::format("  {}{} morph targets, bounds {}\n", mesh.skinned ? "skinned, " : "",
                            mesh.morph_targets, readableSize(mesh.bounds_bytes));
    if (mesh.levels.empty())
        return text + "  no triangles\n";
    text += "  level  clusters   triangles  largest error      positions  normals            UVs\n";
    for (size_t i = 0; i < mesh.levels.size(); ++i)
    {
        const LevelSummary& level = mesh.levels[i];
        text += fmt::format("  {:>5}  {:>8}  {:>10}  {:>13.6g}  {:>13.6g}  {:>6.1f}\u00b0  {:>13.6g}{}\n", i,
                            level.clusters, level.triangles, level.max_error, level.position_error,
                            double{level.normal_error} * 180 / std::numbers::pi, level.uv_error,
                            authoredText(level));
    }
    const double clusters = mesh.clusters == 0 ? 1 : mesh.clusters;
    text += fmt::format(
        "  groups: {}; clusters: {}, on average {:.1f} triangles and {:.1f} vertices ({:.0f} % full)\n",
        mesh.groups, mesh.clusters, static_cast<double>(mesh.triangles) / clusters,
        static_cast<double>(mesh.vertices) / clusters,
        100.0 * static_cast<double>(mesh.triangles) / (clusters * kMaxClusterTriangles));
    return text + fmt::format("  pages: {}, {} stored of {} (vertices {}, indices {}); records {}\n",
                              mesh.pages, readableSize(mesh.stored_page_bytes), readableSize(mesh.page_bytes),
                              readableSize(mesh.vertex_bytes), readableSize(mesh.index_bytes),
                              readableSize(mesh.record_bytes));
}

/// Shorten a text that a line cannot hold, between two characters of UTF-8.
std::string shortened(std::string_view text)
{
    constexpr size_t kMaxBytes = 160;
    if (text.size() <= kMaxBytes)
        return printable(text);
    size_t end = kMaxBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
        --end;
    return printable(text.substr(0, end)) + fmt::format("... ({} bytes)", text.size());
}

/// Describe the layers of each material that has some: clear coat 1 (roughness 0.1), sheen (1, 0, 0) (...).
std::string layersText(const PackView& pack)
{
    const auto color = [](Float3 c) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", c.x, c.y, c.z); };
    std::string text;
    for (const MaterialLayersRecord& layers : pack.materialLayers())
    {
        std::vector<std::string> found;
        if (hasSpecular(layers))
            found.push_back(fmt::format("ior {:.3g}, specular {:.3g} {}", layers.ior, layers.specular,
                                        color(layers.specular_color)));
        if (hasClearcoat(layers))
            found.push_back(fmt::format("clear coat {:.3g} (roughness {:.3g})", layers.clearcoat,
                                        layers.clearcoat_roughness));
        if (hasSheen(layers))
            found.push_back(fmt::format("sheen {} (roughness {:.3g})", color(layers.sheen_color),
                                        layers.sheen_roughness));
        // the material of a damaged part may be missing
        const std::string_view name = layers.material < pack.materials().size()
                                          ? pack.text(pack.materials()[layers.material].name)
                                          : std::string_view();
        text += fmt::format("layers of material {} \"{}\": {}\n", layers.material, printable(name),
                            fmt::join(found, ", "));
    }
    return text.empty() ? text : "\n" + text;
}

std::string extrasText(const PackView& pack)
{
    std::string text;
    for (const ExtrasRecord& record : pack.extras())
        text += fmt::format("extras of {} {} \"{}\": {}\n", extrasOwnerName(record.owner), record.index,
                            printable(readOwnerName(pack, record)), shortened(pack.text(record.json)));
    return text.empty() ? text : "\n" + text;
}

/// Return the role of an encoded image, and its loss beside the target: ", color, 39.4 dB (target 39.0)".
/// Smooth areas are mentioned only where they miss their target.
std::string encodingText(const ImageRecord& image)
{
    const auto role = static_cast<ImageRole>(image.role);
    if (role == ImageRole::none)
        return "";
    std::string text = fmt::format(", {}, {}", imageRoleName(image.role),
                                   imageErrorText(role, double{image.error}, double{image.target}));
    if (image.target_smooth != 0 && image.error_smooth > image.target_smooth)
        text +=
            ", smooth areas " + imageErrorText(role, double{image.error_smooth}, double{image.target_smooth});
    return text;
}

std::string imagesText(const PackView& pack, const PackSummary& summary)
{
    std::string text;
    uint64_t gpu_bytes = 0;
    for (uint32_t i = 0; i < pack.images().size(); ++i)
    {
        const ImageRecord& image = pack.images()[i];
        const ChunkEntry* data = pack.container().find(kChunkImageData, i);
        gpu_bytes += data == nullptr ? 0 : data->size;
        text += fmt::format("image {} \"{}\": {} x {}, {} mips, {}, {} on the GPU, {} stored{}{}\n", i,
                            printable(pack.text(image.name)), image.width, image.height, image.mip_count,
                            texelFormatName(image.format), readableSize(data == nullptr ? 0 : data->size),
                            readableSize(data == nullptr ? 0 : data->stored_size), encodingText(image),
                            (image.flags & kImagePlaceholder) != 0 ? ", placeholder" : "");
    }
    if (const uint64_t budget = summary.meta.texture_budget; budget != 0)
        text += fmt::format("images: {} on the GPU of a budget of {}\n", readableSize(gpu_bytes),
                            readableSize(budget));
    return text.empty() ? text : "\n" + text;
}

std::string messagesText(const MetaSummary& meta)
{
    std::string text;
    for (const MessageSummary& message : meta.messages)
        text += messageText(message);
    return text.empty() ? text : "\n" + text;
}

/// List the types of chunks with their numbers and bytes.
std::string chunksText(const PackView& pack)
{
    struct Kind
    {
        uint64_t count = 0;
        uint64_t size = 0;
        uint64_t stored = 0;
    };
    std::map<std::string, Kind> kinds;
    for (const ChunkEntry& entry : pack.container().chunks())
    {
        Kind& kind = kinds[chunkName(entry.type, entry.index).substr(6, 4)];
        ++kind.count;
        kind.size += entry.size;
        kind.stored += entry.stored_size;
    }
    std::string text = "\nchunk  count        stored       decoded\n";
    for (const auto& [name, kind] : kinds)
        text += fmt::format("{:<5}  {:>5}  {:>12}  {:>12}\n", name, kind.count, readableSize(kind.stored),
                            readableSize(kind.size));
    return text;
}

} // namespace

std::string inspectText(const PackView& pack, const PackSummary& summary)
{
    std::string text = headText(pack, summary) + sceneText(pack, summary) + assetsText(pack) +
                       visibilityText(pack) + specularText(pack) + probesText(pack) +
                       bricksText(pack, summary.meta) + receiversText(pack, summary.meta);
    for (size_t i = 0; i < summary.meshes.size(); ++i)
        text += meshText(summary.meshes[i], i);
    return text + proxiesText(pack) + layersText(pack) + imagesText(pack, summary) + extrasText(pack) +
           messagesText(summary.meta) + chunksText(pack);
}

} // namespace hearth::command
