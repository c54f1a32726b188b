// The command line of hearth-render.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/animation.h"
#include "runtime/viewer/draw_options.h"

namespace hearth::viewer
{

/// What occlusion culling finds of the frame before: the picture is the same, whatever it is.
enum class PyramidStart
{
    previous, ///< what the frame before left, nothing in the first
    none,     ///< nothing in every frame
    noise,    ///< random depths in every frame
};

/// Whether the assets of a pack are drawn side by side.
enum class SheetChoice
{
    automatic, ///< where they stand in one place, and nothing says what else to draw
    on,
    off,
};

struct RenderOptions : DrawOptions
{
    std::string output;
    std::string camera_path;      ///< a file; empty: one picture
    std::vector<uint32_t> meshes; ///< a picture of each alone; none: of the scene
    std::vector<Named<uint32_t>>
        views; ///< each picture is drawn in each of these; none: in that of the settings
    SheetChoice sheet = SheetChoice::automatic;
    AnimationSettings animation;
    uint32_t samples = 1;
    uint32_t frames = 1;
    uint32_t gi_frames = 32; ///< of a pack with bricks, before the first picture
    PyramidStart pyramid = PyramidStart::previous;
    uint32_t noise_seed = 0;
    std::string stats;
    std::string visibility;
    bool names_device = false; ///< and does nothing else
};

/// Whether the whole scene is drawn once at rest, from where it fits: what a sheet can stand for.
bool fitsWholeScene(const RenderOptions& options);

/// The text of --help.
std::string renderHelp();

/// errors: usage, naming the argument.
Result<RenderOptions> parseRenderOptions(std::span<const char* const> arguments);

} // namespace hearth::viewer
