// Memory traffic of a described frame, and the rules of tile-based GPUs that it follows or breaks. Reads the
// description alone: it works for any device, without one.
//
// Rules are from A. Garrard, "Moving mobile graphics: cramming software onto mobile GPUs", SIGGRAPH 2015;
// Arm, "Mali GPU best practices" and its article on multipass; Qualcomm, "Adreno Vulkan developer guide";
// Khronos' Vulkan Samples, "Subpasses" and "Render passes", and the reasons not to merge of
// VK_EXT_subpass_merge_feedback.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_description.h"

#include <string>

namespace hearth::gpu
{

/// Bytes that cross the bus for each pixel of the frame. Texels that are read count once, however often they
/// are fetched. What follows the number of clusters or lights is left out.
struct Traffic
{
    double low = 0;     ///< of images, where subpasses of a render pass merge
    double high = 0;    ///< of images, where none does: each subpass stores what the next one loads
    double buffers = 0; ///< of buffers whose size follows the image's
};

/// Return the traffic of a pass, of a shadow map in bytes a texel.
Traffic measureTraffic(const Pass& pass);

/// Return the sum over all passes of the frame's size.
Traffic measureTraffic(const FrameDescription& frame);

enum class LintRule : uint8_t
{
    undefined_load,   ///< loads what no pass has stored
    useless_store,    ///< stores what nobody reads
    not_transient,    ///< an attachment that never leaves the tile has memory
    unnamed_spill,    ///< stores without naming the step that forces it
    spill,            ///< a pass loads what another stored: the tile was left on the way
    tile_storage,     ///< colours and inputs take more bits than a tile holds
    attachment_count, ///< of a subpass or a pass
    depth_changes,    ///< subpasses of a pass have different depth attachments, or some have none
    not_by_region,    ///< subpasses depend on each other beyond the pixel
    foreign_input,    ///< an input attachment has no content
    clear_command,    ///< a clear command where a load operation can clear
    bubble,           ///< compute work waits for fragments
    diagonal,         ///< full-screen geometry with a long diagonal
    host_race,        ///< the CPU writes what an earlier frame may still read
    restored,         ///< more than one pass stores the finished image
    late_depth,       ///< opaque geometry discards, or its fragments write their depth
    count,
};

/// Names of the rules, as the JSON has them.
const char* ruleName(LintRule rule);

struct LintFinding
{
    LintRule rule;
    bool is_error;    ///< no configuration may have it; otherwise it may, for a reason
    std::string pass; ///< passName
    std::string text; ///< a sentence
};

/// Limits of tile storage. Depth has its own on Mali.
struct LintLimits
{
    uint32_t warning_bits = 128; ///< a pixel: Mali before Valhall
    uint32_t error_bits = 256;   ///< a pixel: later Mali
    uint32_t colors = 4;         ///< of a subpass: Vulkan's minimum
    uint32_t inputs = 4;         ///< of a subpass: Vulkan's minimum
    uint32_t attachments = 8;    ///< of a pass: more are not merged by Mali
};

/// Return what the frame breaks, pass by pass.
std::vector<LintFinding> lint(const FrameDescription& frame, const LintLimits& limits = {});

} // namespace hearth::gpu
