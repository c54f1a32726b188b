// The command line of hearth-render.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"
#include "formats/shared/frame.h"
#include "formats/shared/lod_curve.h"
#include "runtime/gpu/shading_pass.h"
#include "runtime/viewer/shadow_options.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::viewer
{

/// What occlusion culling finds of the frame before: the picture is the same, whatever it is.
enum class PyramidStart
{
    previous, ///< what the frame before left, nothing in the first
    none,     ///< nothing in every frame
    noise,    ///< random depths in every frame
};

struct RenderOptions
{
    bool help = false;
    std::string pack;
    std::string output;
    uint32_t width = 1280;
    uint32_t height = 720;
    std::optional<shared::Camera> camera; ///< none: the scene's camera, or fit the scene
    std::optional<uint32_t> scene_camera; ///< index of a camera of the pack
    std::string camera_path;              ///< a file; empty: one picture
    float error_pixels = 1;
    std::vector<shared::LodKnot> lod_curve; ///< checked
    uint32_t view = 0;                      ///< shared::kView*
    ShadowSettings shadows;                 ///< none unless asked for
    gpu::ShadedArea shaded_area = gpu::ShadedArea::automatic;
    uint32_t samples = 1;
    uint32_t frames = 1;
    uint32_t cull_flags = shared::kCullEverything;
    uint64_t geometry_budget = 0; ///< bytes; 0: all geometry is resident
    PyramidStart pyramid = PyramidStart::previous;
    uint32_t noise_seed = 0;
    std::string device;
    std::string stats;
    std::string visibility;
    bool validate = false;
    bool verbose = false;
};

/// The text of --help.
extern const char* const kRenderHelp;

/// errors: usage, naming the argument.
Result<RenderOptions> parseOptions(std::span<const char* const> arguments);

} // namespace hearth::viewer
