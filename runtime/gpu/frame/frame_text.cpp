// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_text.h"

#include "runtime/gpu/frame/frame_lint.h"

#include <algorithm>
#include <cstdio>

namespace hearth::gpu
{

namespace
{

constexpr const char* kWayNames[] = {"merged", "separate", "one-set"};
constexpr const char* kOcclusionNames[] = {"off", "last-frame", "two-phase"};
constexpr const char* kMaterialTestNames[] = {"depth", "id"};
constexpr const char* kLightPathNames[] = {"materials",  "surfaces-on-tile",   "surfaces",  "light-sums",
                                           "joint-sums", "encoded-joint-sums", "light-bits"};
constexpr const char* kLoadNames[] = {"none", "clear", "load"};
constexpr const char* kKindNames[] = {"compute", "render", "transfer"};

template <typename Enum, size_t kCount>
const char* enumName(const char* const (&names)[kCount], Enum value)
{
    return names[static_cast<size_t>(value)];
}

/// Four digits, for JSON.
std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.4g", value);
    return text;
}

/// Two digits after the point, for people.
std::string rounded(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.2f", value);
    return text;
}

std::string padRight(std::string text, size_t width)
{
    text.resize(std::max(text.size() + 1, width), ' ');
    return text;
}

std::string padLeft(const std::string& text, size_t width)
{
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

/// Format bytes a pixel, low and high, in two columns.
std::string columns(const Traffic& traffic)
{
    return padLeft(rounded(traffic.low), 8) + padLeft(rounded(traffic.high), 8) +
           padLeft(rounded(traffic.buffers), 9);
}

std::string describeAttachment(const AttachmentUse& use)
{
    std::string text = enumName(kLoadNames, use.load);
    if (use.load == LoadOperation::none)
        text = "not loaded";
    text += use.store ? std::string(", stored for ") + use.reader : ", not stored";
    return text;
}

/// A list of strings as JSON.
template <typename Range, typename Text>
std::string jsonList(const Range& range, const Text& text)
{
    std::string list = "[";
    for (const auto& item : range)
        list += (list.size() > 1 ? "," : "") + text(item);
    return list + "]";
}

/// Names and sentences of this library: they have neither quotes nor backslashes.
std::string quoted(const std::string& text)
{
    return '"' + text + '"';
}

std::string jsonBytes(const Traffic& traffic)
{
    return "{\"low\":" + number(traffic.low) + ",\"high\":" + number(traffic.high) + "}";
}

std::string jsonAttachment(const AttachmentUse& use)
{
    return "{\"name\":" + quoted(resourceFacts(use.resource).name) +
           ",\"load\":" + quoted(enumName(kLoadNames, use.load)) +
           ",\"store\":" + (use.store ? "true" : "false") +
           ",\"reader\":" + (use.reader == nullptr ? "null" : quoted(use.reader)) + "}";
}

std::string jsonUse(const ResourceUse& use)
{
    return "{\"name\":" + quoted(resourceFacts(use.resource).name) +
           ",\"writes\":" + (isWrite(use.access) ? "true" : "false") +
           ",\"share\":" + number(double{use.share}) + "}";
}

std::string jsonPass(const Pass& pass)
{
    const Traffic traffic = measureTraffic(pass);
    return "{\"name\":" + quoted(passName(pass)) + ",\"kind\":" + quoted(enumName(kKindNames, pass.kind)) +
           ",\"per\":" + (hasOwnSize(pass) ? "\"texel of a map\"" : "\"pixel\"") +
           ",\n   \"bytes_per_pixel\":" + jsonBytes(traffic) +
           ",\"buffer_bytes_per_pixel\":" + number(traffic.buffers) + ",\n   \"subpasses\":" +
           jsonList(pass.steps, [](FrameStep step) { return quoted(stepName(step)); }) +
           ",\n   \"attachments\":" + jsonList(pass.attachments, jsonAttachment) +
           ",\n   \"uses\":" + jsonList(pass.uses, jsonUse) + "}";
}

std::string jsonFinding(const LintFinding& finding)
{
    return "\n  {\"rule\":" + quoted(ruleName(finding.rule)) + ",\"pass\":" + quoted(finding.pass) +
           ",\"text\":" + quoted(finding.text) + "}";
}

std::string jsonConfiguration(const FrameConfiguration& c)
{
    const auto boolean = [](bool value) { return value ? "true" : "false"; };
    return std::string("{\"way\":") + quoted(enumName(kWayNames, c.way)) +
           ",\"occlusion\":" + quoted(enumName(kOcclusionNames, c.occlusion)) +
           ",\"materials\":" + quoted(enumName(kMaterialTestNames, c.materials)) +
           ",\"material_tiles\":" + boolean(c.material_tiles) +
           ",\"gathers_light\":" + boolean(c.gathers_light) + ",\"in_parts\":" + boolean(c.in_parts) +
           ",\"keeps_visibility\":" + boolean(c.keeps_visibility) +
           ",\"keeps_depth\":" + boolean(c.keeps_depth) + ",\"shows_overdraw\":" + boolean(c.shows_overdraw) +
           ",\"shadows\":" + boolean(c.has_shadows) + ",\"light_lists\":" + boolean(c.lists_lights) +
           ",\"slot_lights\":" + boolean(c.lists_slots) + ",\"visible_lights\":" + boolean(c.lists_visible) +
           ",\"bricks\":" + boolean(c.lights_bricks) + ",\"final_pass\":" + boolean(c.has_final_pass) +
           ",\"automatic_exposure\":" + boolean(c.adapts_exposure) + ",\"bloom\":" + boolean(c.blooms) +
           ",\"lights\":" + quoted(enumName(kLightPathNames, c.light_path)) + "}";
}

} // namespace

std::string formatFrameText(const FrameDescription& frame)
{
    constexpr size_t kName = 40;
    std::string text = padRight("bytes a pixel, merged and unmerged; of buffers", kName + 9) +
                       padLeft("low", 8) + padLeft("high", 8) + padLeft("buffers", 9) + "\n";
    for (const Pass& pass : frame.passes)
    {
        text += padRight(passName(pass), kName) +
                padRight(hasOwnSize(pass) ? "a texel" : enumName(kKindNames, pass.kind), 9) +
                columns(measureTraffic(pass)) + "\n";
        for (const AttachmentUse& use : pass.attachments)
            if (use.load != LoadOperation::none || use.store)
                text +=
                    "  " + padRight(resourceFacts(use.resource).name, 14) + describeAttachment(use) + "\n";
    }
    text += padRight("frame", kName + 9) + columns(measureTraffic(frame)) + "\n";
    if (!frame.transient.empty())
    {
        text += "never leave the tile:";
        for (const FrameResource resource : frame.transient)
            text += std::string(" ") + resourceFacts(resource).name;
        text += "\n";
    }
    for (const LintFinding& finding : lint(frame))
        text += std::string("warning: ") + (finding.pass.empty() ? "" : finding.pass + ": ") + finding.text +
                " [" + ruleName(finding.rule) + "]\n";
    return text;
}

std::string formatFrameJson(const FrameDescription& frame, const std::string& more)
{
    const Traffic traffic = measureTraffic(frame);
    return "{\"schema\":\"hearth.passes/1\",\n \"configuration\":" + jsonConfiguration(frame.configuration) +
           ",\n \"bytes_per_pixel\":" + jsonBytes(traffic) +
           ",\n \"buffer_bytes_per_pixel\":" + number(traffic.buffers) + ",\n \"transient\":" +
           jsonList(frame.transient, [](FrameResource r) { return quoted(resourceFacts(r).name); }) +
           ",\n \"passes\":" + jsonList(frame.passes, [](const Pass& p) { return "\n  " + jsonPass(p); }) +
           ",\n \"warnings\":" + jsonList(lint(frame), jsonFinding) + (more.empty() ? "" : ",\n " + more) +
           "}\n";
}

} // namespace hearth::gpu
