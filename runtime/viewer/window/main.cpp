// hearth-view: shows a pack in a window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/program.h"
#include "runtime/viewer/window/options.h"
#include "runtime/viewer/window/viewer.h"

#include <chrono>
#include <cstdio>

namespace hearth::viewer
{

namespace
{

/// Returns the seconds since the last call, 0 the first time.
class StepClock
{
public:
    double step()
    {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> passed = now - last_.value_or(now);
        last_ = now;
        return passed.count();
    }

private:
    std::optional<std::chrono::steady_clock::time_point> last_;
};

/// Save a frame with all the geometry that it needs.
Status takeScreenshot(Viewer& viewer, const std::string& file)
{
    constexpr uint64_t kMaxFrames = 10000; // a scene that has not settled after minutes never does
    const uint64_t first = viewer.serial() + 1;
    while (viewer.isOpen() && !viewer.settledSince(first) && viewer.serial() < first + kMaxFrames)
        HEARTH_TRY(viewer.step(0));
    for (bool saved = false; viewer.isOpen() && !saved;)
    {
        HEARTH_ASSIGN_OR_RETURN(saved, viewer.saveScreenshot(file));
        if (!saved)
            HEARTH_TRY(viewer.step(0));
    }
    return success();
}

Status show(Viewer& viewer, const ViewOptions& options)
{
    StepClock clock;
    uint32_t shown = 0;
    while (viewer.isOpen() && (options.frames == 0 || shown < options.frames))
    {
        HEARTH_ASSIGN_OR_RETURN(const bool drawn, viewer.step(clock.step()));
        shown += drawn ? 1u : 0u;
    }
    return options.screenshot.empty() ? success() : takeScreenshot(viewer, options.screenshot);
}

Status view(const ViewOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<Viewer> viewer, Viewer::create(options));
    const VulkanHost& host = viewer->host();
    if (options.verbose)
        std::fprintf(stderr, "drawing with %s%s\n", host.deviceName().c_str(),
                     host.software() ? " (software)" : "");
    const Status shown = show(*viewer, options);
    const Status validated = host.printMessages();
    return shown.ok() ? validated : shown;
}

} // namespace

int runView(std::span<const char* const> arguments)
{
    return runCommand(parseViewOptions(arguments), viewHelp(), view);
}

} // namespace hearth::viewer

int main(int argc, char** argv)
{
    return hearth::runProgram(
        "hearth-view",
        [&] {
            return hearth::viewer::runView({argv + 1, static_cast<size_t>(argc > 0 ? argc - 1 : 0)});
        });
}
