// Command line of hearth-view.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/animation.h"
#include "runtime/viewer/draw_options.h"

namespace hearth::viewer
{

struct ViewOptions : DrawOptions
{
    AnimationSettings animation; ///< plays, or is paused at the given time
    uint32_t frames = 0;         ///< 0: until the window is closed
    std::string screenshot;      ///< file for the last frame; empty: none
};

/// Return the text of --help.
std::string viewHelp();

/// errors: usage, naming the argument.
Result<ViewOptions> parseViewOptions(std::span<const char* const> arguments);

} // namespace hearth::viewer
