// The command line of hearth-view.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/animation.h"
#include "runtime/viewer/draw_options.h"

namespace hearth::viewer
{

struct ViewOptions : DrawOptions
{
    AnimationSettings animation; ///< it plays, or stands still at the time that is given
    uint32_t frames = 0;         ///< 0: until the window is closed
    std::string screenshot;      ///< of the last frame; empty: none
};

/// The text of --help.
std::string viewHelp();

/// errors: usage, naming the argument.
Result<ViewOptions> parseViewOptions(std::span<const char* const> arguments);

} // namespace hearth::viewer
