// Draws the finest level of a pack with rays and the material model of glTF 2.0, appendix B, written from that text.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/scene/animation.h"
#include "runtime/frame/frame.h"
#include "tests/reference/pack_geometry.h"
#include "tests/reference/png_image.h"
#include "tests/reference/tracer/sky_tracer.h"

namespace hearth::reference
{

struct ReferenceOptions
{
    shared::Camera camera;
    const formats::ScenePose* pose = nullptr; ///< of the pack; null: at rest
    uint32_t width = 512;
    uint32_t height = 512;
    uint32_t samples_per_side = 4; ///< rays per pixel: its square
    bool shadows = false;          ///< of suns and spots, as hearth-render --shadows has them
    SkyTracing sky = {}; ///< whether what stands in front of the sky counts; its `shadows` is the one above
};

/// errors: those of reading pages and images.
Result<Picture> renderReference(const formats::PackView& view, const ReferenceOptions& options);

} // namespace hearth::reference
