// The assets of a pack as a person goes from one to the other.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/stage.h"

#include <optional>
#include <string>

namespace hearth::viewer
{

struct AssetView
{
    std::string name; ///< with its size: "rock, 2.1 m"
    shared::Camera camera;
};

struct AssetViews
{
    /// Those that draw something; empty where there are fewer than two.
    std::vector<AssetView> list;
    /// Hides what is not looked at, by its part: that of partOf. None where the assets do not stand in one place.
    std::optional<Stage> stage;

    /// choice  of the list; none: the whole scene
    static size_t partOf(std::optional<size_t> choice) { return choice ? *choice + 1 : 0; }
};

/// player  as the scene stands
AssetViews makeAssetViews(const formats::PackView& pack, const pack::PosePlayer& player, float aspect);

} // namespace hearth::viewer
