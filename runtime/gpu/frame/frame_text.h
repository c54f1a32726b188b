// Description of a frame as text for people and as JSON for tools: passes, attachments, bytes a pixel, and
// what the lint found.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_description.h"

#include <string>

namespace hearth::gpu
{

/// Format as a table with one line for each pass and attachment.
std::string formatFrameText(const FrameDescription& frame);

/// Format as JSON; "schema" names the version of its form.
/// more  further members of the object, or nothing
std::string formatFrameJson(const FrameDescription& frame, const std::string& more = {});

} // namespace hearth::gpu
