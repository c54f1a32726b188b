// Command-line options shared by the programs that draw a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/scene/daylight.h"
#include "runtime/pack/pose_player.h"
#include "runtime/viewer/command_line.h"
#include "runtime/viewer/frame_settings.h"
#include "runtime/viewer/lamp_options.h"
#include "runtime/viewer/shadow_options.h"

#include <optional>
#include <string>

namespace hearth::viewer
{

struct DrawOptions
{
    bool help = false;
    std::string pack;
    uint32_t width = 1280; ///< pixels
    uint32_t height = 720;
    std::optional<shared::Camera> camera; ///< none: the scene's camera, or fit the scene
    std::optional<uint32_t> scene_camera; ///< index of a camera of the pack
    FrameSettings settings;               ///< checked
    ShadowSettings shadows;               ///< on by default
    std::vector<LampSetting> lamps;
    std::optional<shared::Daylight> daylight; ///< checked; none: sky and sun of the pack
    uint64_t memory_budget = 0;               ///< bytes; 0: all geometry is resident
    std::string device;
    bool validate = false;
    bool verbose = false;
};

/// Return the help lines of these options.
std::string drawHelp();

/// Add the options; they outlive the command line, which writes to them.
void addDrawOptions(CommandLine& command_line, DrawOptions& options);

/// Checks that need all options. errors: usage.
Status checkDrawOptions(const DrawOptions& options);

/// Checks that need the pack. errors: usage.
Status checkPack(const DrawOptions& options, const formats::PackView& pack);

/// Parse 1 to 10000 frames. errors: usage, naming the option --frames.
Status parseFrames(std::string_view text, uint32_t& frames);

/// Return the camera of the options, in a scene in the player's pose. errors: usage if the pack has no such
/// camera.
Result<shared::Camera> chooseCamera(const DrawOptions& options, const formats::PackView& pack,
                                    const pack::PosePlayer& player);

} // namespace hearth::viewer
