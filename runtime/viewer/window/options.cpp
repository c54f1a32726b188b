// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/options.h"

namespace hearth::viewer
{

std::string viewHelp()
{
    return std::string("Usage: hearth-view PACK [options]\n"
                       "Fly through a pack in a window.\n"
                       "\n") +
           drawHelp() +
           "      --animation CLIP    play a clip, by its name or number\n"
           "      --time SECONDS      pause at this time of it, and of flickering lights; beyond its keys it "
           "holds\n"
           "                          the last\n"
           "      --frames N          end after N frames\n"
           "      --screenshot FILE   at the end of --frames: the image without the panel, PNG; with "
           "--budget "
           "it\n"
           "                          waits for all that it wants\n"
           "\n"
           "W A S D fly, Q E down and up, Shift is fast; right mouse button: look around, wheel: speed\n"
           "1 ... 0 the views in the order above; R back to the start, C prints --camera as it is, Tab hides "
           "the "
           "panel,\n"
           "the space bar stops a clip and lets it go on, Esc ends\n"
           "Exit codes: 0, 2 usage, 65 malformed pack, 66 missing, 70 no display, no device or a defect, 73 "
           "cannot\n"
           "write, 74 I/O\n";
}

Result<ViewOptions> parseViewOptions(std::span<const char* const> arguments)
{
    ViewOptions options;
    CommandLine command_line;
    addDrawOptions(command_line, options);
    addClipOptions(command_line, options.animation);
    command_line.addValue("--frames",
                          [&](std::string_view text) { return parseFrames(text, options.frames); });
    command_line.addText("--screenshot", options.screenshot);
    HEARTH_TRY(command_line.parse(arguments, options.pack));
    if (options.help)
        return options;
    if (options.pack.empty())
        return usageError("no pack is named");
    HEARTH_TRY(checkDrawOptions(options));
    if (!options.screenshot.empty() && options.frames == 0)
        return usageError("--screenshot needs --frames: it is taken at their end");
    return options;
}

} // namespace hearth::viewer
