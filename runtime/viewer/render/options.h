// Command line of hearth-render.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/animation.h"
#include "runtime/viewer/draw_options.h"

namespace hearth::viewer
{

/// Initial depth pyramid of occlusion culling; the result is the same with each.
enum class PyramidStart
{
    previous, ///< left by the last frame, empty in the first
    none,     ///< empty in every frame
    noise,    ///< random depths in every frame
};

/// Choice of a contact sheet, with the assets of a pack side by side.
enum class SheetChoice
{
    automatic, ///< if the assets overlap, and no option says what else to draw
    on,
    off,
};

/// Form in which the passes of a frame are printed.
enum class PassesFormat
{
    none, ///< an image is drawn instead
    text,
    json,
};

struct RenderOptions : DrawOptions
{
    std::string output;
    PassesFormat passes = PassesFormat::none;
    std::string camera_path;      ///< file; empty: one image
    std::vector<uint32_t> meshes; ///< an image of each mesh alone; none: the scene
    /// Each image is drawn in each of these; none: in the view of the settings.
    std::vector<Named<uint32_t>> views;
    SheetChoice sheet = SheetChoice::automatic;
    AnimationSettings animation;
    uint32_t samples = 4;     ///< of each pixel: 1, 4, 16 or 64
    bool is_filtered = false; ///< by the temporal filter, with one sample of a pixel in each frame
    uint32_t frames = 1;
    PyramidStart pyramid = PyramidStart::previous;
    uint32_t noise_seed = 0;
    std::string stats;
    std::string visibility;
    bool print_device_name = false; ///< only prints the name of the device
};

/// True if the output is an OpenEXR file, which has linear colours.
bool writesLinear(const RenderOptions& options);

/// True if the whole scene is drawn once at rest from a fitted camera, so that a sheet can replace it.
bool fitsWholeScene(const RenderOptions& options);

/// Return the text of --help.
std::string renderHelp();

/// errors: usage, naming the argument.
Result<RenderOptions> parseRenderOptions(std::span<const char* const> arguments);

} // namespace hearth::viewer
