// Views of the single assets of a pack, for stepping through them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/stage.h"

#include <optional>
#include <string>

namespace hearth::viewer
{

struct AssetView
{
    std::string name; ///< with the size: "rock, 2.1 m"
    shared::Camera camera;
};

struct AssetViews
{
    /// Assets that draw something; empty if there are fewer than two.
    std::vector<AssetView> list;
    /// Hides all parts but partIndex(choice). None if the assets do not overlap.
    std::optional<Stage> stage;

    /// choice  index in the list; none: the whole scene
    static size_t partIndex(std::optional<size_t> choice) { return choice ? *choice + 1 : 0; }
};

/// player  current pose of the scene
AssetViews makeAssetViews(const formats::PackView& pack, const pack::PosePlayer& player, float aspect);

} // namespace hearth::viewer
