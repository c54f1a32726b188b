// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/report/shadow_report.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace hearth::viewer
{

namespace
{

/// Explain the choice of a scene that asked for 16-bit depths.
std::string explainDepth(const gpu::ShadowDepthChoice& depth)
{
    char text[160];
    std::snprintf(text, sizeof(text), "a step of 16 bits is %.3f texels in a map of light %u, %s %.3g",
                  double{depth.step_texels}, depth.light,
                  depth.depth == gpu::ShadowDepth::d16 ? "no more than" : "above",
                  double{gpu::kMaxDepthStepTexels});
    return text;
}

/// Format the members of a JSON object.
std::string formatMembers(const ShadowCounts& counts)
{
    std::string text;
    const auto add = [&](std::string_view name, uint64_t value)
    { text.append(text.empty() ? "\"" : ",\"").append(name).append("\":").append(std::to_string(value)); };
    add("maps", counts.maps.maps);
    add("drawn_maps", counts.maps.drawn_maps);
    add("unseen_maps", counts.maps.unseen_maps);
    add("dropped_maps", counts.maps.dropped_maps);
    add("shadowed_lights", counts.maps.shadowed_lights);
    add("unshadowed_lights", counts.maps.unshadowed_lights);
    add("caster_clusters", counts.caster_clusters);
    add("dropped_clusters", counts.dropped_clusters);
    add("proxy_triangles", counts.proxy_triangles);
    add("map_bytes", counts.map_bytes);
    add("depth_bits", gpu::depthBits(counts.depth.depth));
    if (counts.depth.light != kInvalidIndex)
        text.append(",\"depth_reason\":\"").append(explainDepth(counts.depth)).append("\"");
    return text;
}

} // namespace

Result<ShadowCounts> countShadows(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene)
{
    const gpu::SceneShadows& shadows = *scene.shadows;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes,
                            host.read(renderer.device(), shadows.casters()));
    std::vector<uint32_t> proxy_triangles(bytes.size() / sizeof(shared::FrameCounters), 0);
    if (scene.proxies_cast)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> words,
                                host.read(renderer.device(), shadows.proxyTriangles()));
        // both buffers are longer than their records: sizes are rounded up
        std::memcpy(proxy_triangles.data(), words.data(),
                    std::min(words.size(), proxy_triangles.size() * sizeof(uint32_t)));
    }
    ShadowCounts counts{
        .maps = shadows.statistics(), .map_bytes = shadows.allocatedBytes(), .depth = shadows.depth()};
    // nothing moves here, so no map has a second layer
    for (const shared::ShadowMap& map : std::span(shadows.plan().block.maps).first(counts.maps.maps))
    {
        shared::FrameCounters layer;
        std::memcpy(&layer, bytes.data() + map.layer * sizeof(layer), sizeof(layer));
        counts.caster_clusters += layer.drawn_clusters;
        counts.dropped_clusters += layer.dropped_clusters;
        counts.proxy_triangles += proxy_triangles[map.layer];
    }
    return counts;
}

std::string formatShadows(std::span<const ShadowCounts> frames)
{
    std::string text = "{";
    text += formatMembers(frames.back());
    if (frames.size() > 1)
    {
        std::string rows;
        for (const ShadowCounts& frame : frames)
            rows.append(rows.empty() ? "\n  {" : ",\n  {").append(formatMembers(frame)).append("}");
        text.append(",\"frames\":[").append(rows).append("]");
    }
    return text + "}";
}

} // namespace hearth::viewer
