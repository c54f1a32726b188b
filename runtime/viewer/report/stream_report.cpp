// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/report/stream_report.h"

#include <cstdio>
#include <cstring>

namespace hearth::viewer
{

namespace
{

/// Format the members of a JSON object.
std::string formatMembers(const StreamCounts& counts)
{
    const pack::StreamStatistics& s = counts.statistics;
    std::string text;
    const auto add = [&](std::string_view name, std::string_view value)
    { text.append(text.empty() ? "\"" : ",\"").append(name).append("\":").append(value); };
    char scale[32];
    std::snprintf(scale, sizeof(scale), "%.3f", double{s.error_scale});
    add("converged", counts.pages_missing + counts.mips_missing == 0 ? "true" : "false");
    add("frame", std::to_string(counts.frame));
    add("budget_bytes", std::to_string(s.budget_bytes));
    add("bytes_in_use", std::to_string(s.bytes_in_use));
    add("bytes_resident", std::to_string(s.bytes_resident));
    add("bytes_streamed", std::to_string(s.bytes_streamed));
    add("pages_resident", std::to_string(s.pages_resident));
    add("pages_wanted", std::to_string(counts.pages_wanted));
    add("pages_missing", std::to_string(counts.pages_missing));
    add("failures", std::to_string(s.failures));
    add("error_scale", scale);
    if (!counts.textures)
        return text;
    const gpu::TextureStatistics& t = *counts.textures;
    std::snprintf(scale, sizeof(scale), "%.3f", double{t.error_scale});
    add("texture_budget_bytes", std::to_string(t.budget_bytes));
    add("texture_bytes_in_use", std::to_string(t.bytes_in_use));
    add("texture_bytes_on_device", std::to_string(t.bytes_on_device));
    add("texture_bytes_streamed", std::to_string(t.bytes_streamed));
    add("texture_failures", std::to_string(t.failures));
    add("mips_missing", std::to_string(counts.mips_missing));
    add("texture_error_scale", scale);
    return text;
}

} // namespace

Result<StreamCounts> countStreaming(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene,
                                    uint64_t serial)
{
    const pack::PageStream& pages = scene.stream->pages();
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes,
                            host.read(renderer.device(), scene.frame().page_requests));
    const uint32_t page_count = pages.residency().graph().pageCount();
    std::vector<uint32_t> requests(page_count + scene.materials.size());
    std::memcpy(requests.data(), bytes.data(), requests.size() * sizeof(uint32_t));
    StreamCounts counts{.statistics = pages.statistics(), .frame = serial};
    if (scene.textures != nullptr)
    {
        counts.textures = scene.textures->statistics();
        counts.mips_missing = scene.textures->countMissing(std::span(requests).subspan(page_count));
    }
    for (uint32_t page = 0; page < page_count; ++page)
        if (requests[page] != 0)
        {
            ++counts.pages_wanted;
            counts.pages_missing += pages.residency().isResident(page) ? 0u : 1u;
        }
    return counts;
}

std::string formatStreaming(std::span<const StreamCounts> frames)
{
    std::string text = "{";
    text += formatMembers(frames.back());
    if (frames.size() > 1)
    {
        std::string rows;
        for (const StreamCounts& frame : frames)
            rows.append(rows.empty() ? "\n  {" : ",\n  {").append(formatMembers(frame)).append("}");
        text.append(",\"frames\":[").append(rows).append("]");
    }
    return text + "}";
}

} // namespace hearth::viewer
