// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/report/frame_report.h"

#include "formats/gpu_shared/light_cells.h"
#include "formats/gpu_shared/material_tiles.h"
#include "runtime/gpu/statistics/light_statistics_pass.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

namespace hearth::viewer
{

namespace
{

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.3f", value);
    return text;
}

/// Format with six digits, whatever the magnitude.
std::string shortNumber(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.6g", value);
    return text;
}

std::string quotedJson(std::string_view text)
{
    std::string result(1, '"');
    for (const char c : text)
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else
            result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return result + "\"";
}

std::array<std::pair<const char*, uint64_t>, 6> namedCounts(const FrameCounts& counts)
{
    return {{{"drawn_clusters", counts.drawn_clusters},
             {"early_clusters", counts.early_clusters},
             {"dropped_clusters", counts.dropped_clusters},
             {"missing_clusters", counts.missing_clusters},
             {"drawn_triangles", counts.drawn_triangles},
             {"shaded_area_pixels", counts.shaded_area}}};
}

/// Format as a JSON array.
std::string formatFrames(std::span<const FrameCounts> frames)
{
    std::string text;
    for (const FrameCounts& frame : frames)
    {
        std::string members;
        for (const auto& [name, count] : namedCounts(frame))
            members += (members.empty() ? "{\"" : ",\"") + std::string(name) + "\":" + std::to_string(count);
        members += ",\"culling\":" + formatCullReport(frame.culling);
        text += (text.empty() ? "[\n  " : ",\n  ") + members + "}";
    }
    return text + "]";
}

/// Format the position of each asset on the sheet as a JSON object.
std::string formatSheet(const Sheet& sheet)
{
    const SheetLayout& layout = sheet.layout;
    std::string assets;
    for (size_t i = 0; i < sheet.assets.size(); ++i)
        assets +=
            (i == 0 ? "\n  {\"index\":" : ",\n  {\"index\":") + std::to_string(sheet.assets[i]) +
            ",\"name\":" + quotedJson(sheet.names[i]) + ",\"size\":" + shortNumber(double{sheet.sides[i]}) +
            ",\"x\":" + std::to_string(layout.cellX(i)) + ",\"y\":" + std::to_string(layout.cellY(i)) + "}";
    return "{\"columns\":" + std::to_string(layout.columns) + ",\"rows\":" + std::to_string(layout.rows) +
           ",\"cell_width\":" + std::to_string(layout.cell_width) +
           ",\"cell_height\":" + std::to_string(layout.cell_height) + ",\"assets\":[" + assets + "]}";
}

} // namespace

Result<VisibleList> readVisibleList(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene)
{
    VisibleList list;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> counters,
                            host.read(renderer.device(), scene.frame().main.counters));
    std::memcpy(&list.counters, counters.data(), sizeof(list.counters));
    list.slots.resize(list.counters.drawn_clusters - list.counters.dropped_clusters);
    if (list.slots.empty())
        return list;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> slots,
                            host.read(renderer.device(), scene.frame().main.visible));
    HEARTH_ASSERT(slots.size() >= list.slots.size() * sizeof(shared::VisibleCluster));
    std::memcpy(list.slots.data(), slots.data(), list.slots.size() * sizeof(shared::VisibleCluster));
    return list;
}

Result<uint64_t> readShadedArea(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene,
                                VkExtent2D extent, gpu::ShadedArea area)
{
    const bool tiles = gpu::shadesTiles(scene, area);
    HEARTH_ASSIGN_OR_RETURN(
        const std::vector<std::byte> bytes,
        host.read(renderer.device(), tiles ? scene.frame().tile_draws : scene.frame().main.material_draws));
    std::vector<shared::TileDraw> draws(scene.materials.size() + 1);
    HEARTH_ASSERT(bytes.size() >= draws.size() * sizeof(shared::TileDraw));
    std::memcpy(draws.data(), bytes.data(), draws.size() * sizeof(shared::TileDraw));
    const uint64_t whole_image = uint64_t{extent.width} * extent.height;
    uint64_t pixels = tiles ? 0 : whole_image; // tiles: the sky has no indirect draw
    for (const shared::TileDraw& draw : draws)
        pixels += draw.instance_count * (draw.first_vertex == 0 ? whole_image
                                                                : uint64_t{shared::kMaterialTilePixels} *
                                                                      shared::kMaterialTilePixels);
    return pixels;
}

Result<SkinningCounts> readSkinning(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene)
{
    HEARTH_ASSERT(scene.deformation != nullptr);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes,
                            host.read(renderer.device(), scene.deformation->table.copy(scene.tables->frame)));
    shared::DeformationHeader header;
    HEARTH_ASSERT(bytes.size() >= sizeof(header));
    std::memcpy(&header, bytes.data(), sizeof(header));
    const uint32_t clusters = shared::deformedSlots(header);
    return SkinningCounts{clusters, std::min(clusters, header.block_count)};
}

BrickCounts countBricks(const gpu::Scene& scene, const gpu::FrameTargets& targets)
{
    HEARTH_ASSERT(scene.bricks != nullptr);
    const gpu::SceneBricks& bricks = *scene.bricks;
    BrickCounts counts{.bricks = bricks.grid.brick_count,
                       .faces = bricks.grid.face_count,
                       .lit_faces = bricks.share.face_count,
                       .period = bricks.period,
                       .rays = bricks.rays,
                       .tiles = targets.gather().tiles().width * targets.gather().tiles().height};
    for (const gpu::Buffer* buffer : {&bricks.groups, &bricks.bricks, &bricks.places, &bricks.opacity,
                                      &bricks.surfaces, &bricks.lighting, &bricks.fresh})
        counts.bytes += buffer->size;
    return counts;
}

ReceiverCounts countReceivers(const gpu::Scene& scene)
{
    HEARTH_ASSERT(scene.receivers != nullptr);
    const gpu::SceneReceivers& receivers = *scene.receivers;
    constexpr uint32_t kAll = (1u << shared::kReceiverGroups) - 1;
    const uint32_t groups = receivers.updatedGroups();
    return {.texels = receivers.cost(kAll).texels,
            .faces = receivers.faceCost(kAll).texels,
            .groups = static_cast<uint32_t>(std::popcount(groups)),
            .cost = receivers.cost(groups),
            .face_cost = receivers.faceCost(receivers.updatedFaceGroups())};
}

std::array<double, gpu::kTimestampCount> medianPassTimes(const std::vector<std::vector<double>>& frames)
{
    std::array<double, gpu::kTimestampCount> medians{};
    for (size_t pass = 0; pass < medians.size(); ++pass)
    {
        std::vector<double> times;
        for (const std::vector<double>& stamps : frames)
            times.push_back(pass == 0 ? stamps.back() : stamps[pass] - stamps[pass - 1]);
        std::sort(times.begin(), times.end());
        medians[pass] = times.empty() ? 0 : times[times.size() / 2];
    }
    return medians;
}

uint64_t countTriangles(const formats::PackView& pack, std::span<const shared::VisibleCluster> slots)
{
    uint64_t triangles = 0;
    for (const shared::VisibleCluster& slot : slots)
        triangles += pack.clusters()[slot.cluster].triangle_count;
    return triangles;
}

namespace
{

std::string formatLights(const LightCounts& lights)
{
    const shared::LightListCounts& c = lights.counts;
    const auto join = [](uint32_t low, uint32_t high) { return std::to_string(uint64_t{high} << 32 | low); };
    return "{\"method\":" + quotedJson(gpu::lightMethodFacts(lights.method).name) +
           ",\"unranged\":" + std::to_string(c.unranged) + ",\"ranged\":" + std::to_string(c.ranged) +
           ",\"cells\":" + std::to_string(c.cells) + ",\"indices\":" + std::to_string(c.indices) +
           ",\"overflows\":" + std::to_string(c.overflows) + ",\"pixels\":" + std::to_string(c.pixels) +
           ",\"evaluated\":" + join(c.evaluated_low, c.evaluated_high) +
           ",\"reaching\":" + join(c.reaching_low, c.reaching_high) +
           ",\"longest\":" + std::to_string(c.longest) + ",\"shadowed\":" + std::to_string(lights.shadowed) +
           ",\"unshadowed\":" + std::to_string(lights.unshadowed) + "}";
}

std::string formatReceivers(const ReceiverCounts& receivers)
{
    return "{\"texels\":" + std::to_string(receivers.texels) +
           ",\"faces\":" + std::to_string(receivers.faces) +
           ",\"updated_groups\":" + std::to_string(receivers.groups) +
           ",\"updated_texels\":" + std::to_string(receivers.cost.texels) +
           ",\"updated_faces\":" + std::to_string(receivers.face_cost.texels) +
           ",\"read_bytes\":" + std::to_string(receivers.cost.read_bytes + receivers.face_cost.read_bytes) +
           ",\"written_bytes\":" +
           std::to_string(receivers.cost.written_bytes + receivers.face_cost.written_bytes) + "}";
}

} // namespace

LightCounts countLights(const gpu::Scene& scene, gpu::LightMethod method)
{
    LightCounts counts{.method = method, .counts = gpu::readLightCounts(scene)};
    const std::span<const shared::Light> lights = scene.lights->lights();
    if (scene.shadows != nullptr)
    {
        counts.shadowed = scene.shadows->statistics().shadowed_lights;
        counts.unshadowed = scene.shadows->statistics().unshadowed_lights;
    }
    else
        counts.unshadowed = static_cast<uint32_t>(std::count_if(lights.begin(), lights.end(),
                                                                [](const shared::Light& light)
                                                                { return !shared::isLightOff(light); }));
    return counts;
}

std::string formatReport(const FrameReport& report, const formats::PackView& pack)
{
    uint64_t source_triangles = 0;
    for (const formats::InstanceRecord& instance : pack.instances())
    {
        const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
        source_triangles += mesh.source_triangles - mesh.degenerate_triangles;
    }
    std::string text = "{\"schema\":\"hearth.frame/1\"";
    const auto add = [&](std::string_view name, const std::string& value)
    { text += ",\n \"" + std::string(name) + "\":" + value; };
    add("device", quotedJson(report.device));
    add("width", std::to_string(report.width));
    add("height", std::to_string(report.height));
    if (report.sheet)
        add("sheet", formatSheet(*report.sheet));
    add("error_pixels", number(double{report.error_pixels}));
    add("instances", std::to_string(pack.instances().size()));
    add("materials", std::to_string(pack.materials().size()));
    add("source_triangles", std::to_string(source_triangles));
    for (const auto& [name, count] : namedCounts(report.frames.back()))
        add(name, std::to_string(count));
    add("culling", formatCullReport(report.frames.back().culling));
    add("dropped_lights", std::to_string(report.dropped_lights));
    add("lights", formatLights(report.lights));
    add("scene_bytes", std::to_string(report.scene_bytes));
    add("target_bytes", std::to_string(report.target_bytes));
    add("memory", formatMemoryJson(report.memory));
    if (report.frames.size() > 1)
        add("frames", formatFrames(report.frames));
    if (!report.streaming.empty())
        add("streaming", formatStreaming(report.streaming));
    if (!report.shadows.empty())
        add("shadows", formatShadows(report.shadows));
    if (report.skinning)
        add("skinning", "{\"clusters\":" + std::to_string(report.skinning->clusters) +
                            ",\"in_scratch\":" + std::to_string(report.skinning->in_scratch) + "}");
    if (report.bricks)
        add("bricks", "{\"bytes\":" + std::to_string(report.bricks->bytes) +
                          ",\"bricks\":" + std::to_string(report.bricks->bricks) +
                          ",\"faces\":" + std::to_string(report.bricks->faces) +
                          ",\"lit_faces\":" + std::to_string(report.bricks->lit_faces) +
                          ",\"period\":" + std::to_string(report.bricks->period) +
                          ",\"rays\":" + std::to_string(report.bricks->rays) +
                          ",\"tiles\":" + std::to_string(report.bricks->tiles) + "}");
    if (report.receivers)
        add("receivers", formatReceivers(*report.receivers));
    add("milliseconds",
        "{\"frame\":" + number(report.milliseconds[0]) +
            ",\"shadows\":" + number(report.milliseconds[gpu::kTimestampShadows]) +
            ",\"cull\":" + number(report.milliseconds[gpu::kTimestampCull]) +
            ",\"early_visibility\":" + number(report.milliseconds[gpu::kTimestampEarlyVisibility]) +
            ",\"pyramid\":" + number(report.milliseconds[gpu::kTimestampPyramid]) +
            ",\"late_cull\":" + number(report.milliseconds[gpu::kTimestampLateCull]) +
            ",\"visibility\":" + number(report.milliseconds[gpu::kTimestampVisibility]) +
            ",\"material_tiles\":" + number(report.milliseconds[gpu::kTimestampMaterialTiles]) +
            ",\"shading\":" + number(report.milliseconds[gpu::kTimestampShading]) + "}");
    return text + "}\n";
}

std::vector<std::byte> formatVisibility(const VisibleList& list, std::span<const std::byte> pixels,
                                        uint32_t width, uint32_t height)
{
    const uint32_t header[] = {formats::fourCC("HVIS"), width, height,
                               static_cast<uint32_t>(list.slots.size())};
    const std::span<const std::byte> parts[] = {std::as_bytes(std::span(header)),
                                                std::as_bytes(std::span(list.slots)), pixels};
    std::vector<std::byte> out(parts[0].size() + parts[1].size() + parts[2].size());
    size_t at = 0;
    for (const std::span<const std::byte> part : parts)
    {
        std::copy(part.begin(), part.end(), out.begin() + static_cast<ptrdiff_t>(at));
        at += part.size();
    }
    return out;
}

} // namespace hearth::viewer
