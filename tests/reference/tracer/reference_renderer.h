// Renders the finest level of a pack with rays and the material model of glTF 2.0, appendix B, written from
// the specification.
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
    const formats::ScenePose* pose = nullptr; ///< of the pack; null: rest pose
    uint32_t width = 512;
    uint32_t height = 512;
    uint32_t samples_per_side = 4; ///< the number of rays per pixel is its square
    bool shadows = false;          ///< of the lights, as with hearth-render --shadows
    SkyTracing sky = {};           ///< sky occlusion; its `shadows` is replaced by the one above
    /// Paths of each pixel, with all that they meet, in place of the rays above; 0: no paths. The sky of an
    /// image needs them.
    uint32_t paths = 0;
    std::shared_ptr<const SkyMap> sky_map{}; ///< in place of the pack's sky, with paths
};

/// errors: as for reading pages and images.
Result<Image> renderReference(const formats::PackView& view, const ReferenceOptions& options);

} // namespace hearth::reference
