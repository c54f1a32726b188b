// Renders a scene with Blender's Cycles: hands over camera, sky, sun and exposure of Hearth, and keeps the
// images until anything that they depend on changes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/picture/radiance_image.h"
#include "tests/reference/tracer/scene_lighting.h"

namespace hearth::picture
{

/// Everything that a reference draws a scene from.
struct SceneSetup
{
    std::string source; ///< glTF file
    shared::Camera camera;
    reference::SceneLighting lighting;
    bool has_lights = false;    ///< the source has lights; else the sun is Hearth's own
    uint32_t full_samples = 16; ///< of both halves, for each pixel of an oversampled image
};

/// Images of a reference, oversampled.
struct ReferenceImages
{
    RadianceImage open;
    RadianceImage full[2]; ///< halves of the samples
};

struct CyclesSettings
{
    std::string blender = "blender";
    std::string scripts; ///< folder of this bench's scripts
    uint32_t open_samples = 16;
};

/// Check Cycles beside closed forms. Report what it said, line by line, in a file. errors: child_failed.
Status checkCycles(const CyclesSettings& settings, const std::string& report);

/// prefix  path to which the names of files are appended
/// errors: as for running programs and reading images.
Result<ReferenceImages> renderWithCycles(const SceneSetup& setup, const CyclesSettings& settings,
                                         const std::string& prefix);

} // namespace hearth::picture
