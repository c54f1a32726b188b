// Opens the sky that lights a scene, for the cookers of the whole scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/scene/scene_lighting.h"

#include <optional>
#include <string>

namespace hearth::bricks
{

/// Sky of a scene, valid as long as the scene.
class SceneSky
{
public:
    /// Open the sky of a probe part, or else find the one that a source brings along.
    /// probe  path of the part; empty: none
    /// errors: those of tools::openPart and tools::findSourceSky
    static Result<SceneSky> open(const StaticScene& scene, const std::string& probe);

    /// Return the probe of the sky; no probe for the default sky.
    shared::SceneProbes probes() const;

private:
    std::optional<formats::PackView> part_;
    const formats::PackView* source_ = nullptr; ///< import part
};

} // namespace hearth::bricks
