// Sky of a source: the image-based light of its scene, cooked as hearth-probe cooks the image of a sky.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"
#include "formats/base/affine3d.h"
#include "formats/base/result.h"

namespace hearth::import
{

class PartBuilder;

/// Light of distant surroundings.
struct SourceSky
{
    environment::Environment cube; ///< in axes of its own
    Affine3d world_from_cube;      ///< a rotation
};

/// Return the sky as world space has it: a cube of as many texels, each the mean of 16 points in it.
/// The same cube where nothing turns.
environment::Environment turnSky(const SourceSky& sky);

/// Write the probe of the part's sky; nothing if it has none.
/// max_size  largest edge of the sky that the camera sees
/// errors: those of probes::cookProbe and of writing
Status writeSky(PartBuilder& part, uint32_t max_size);

} // namespace hearth::import
