// Compares the pictures of a scene in all settings of Hearth with those of a reference.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/picture/cycles.h"
#include "tests/picture/scenes.h"
#include "tests/picture/surface_figures.h"

#include <string>
#include <vector>

namespace hearth::picture
{

/// Pictures of Hearth, one for each setting.
using DrawnPictures = std::array<reference::Image, kSettings.size()>;

/// A picture with its difference from another.
struct Difference
{
    double flip = 0; ///< mean
    reference::Image heat;
};

struct Comparison
{
    std::string reference;       ///< its name
    reference::Image open, full; ///< of the reference
    double noise = 0;            ///< FLIP between two halves of the samples of `full`
    Difference open_open;        ///< setting `open` beside the reference without occlusion
    Difference plain_open;
    Difference plain_full;
    Difference full_full;
    /// Light on walls that no lamp reaches, setting `full` over the reference; none without such walls.
    std::optional<double> walls = {};
};

Comparison compare(std::string reference, const ReferenceImages& images, const DrawnPictures& drawn);

/// Two references of one scene.
struct Agreement
{
    double open = 0; ///< mean FLIP
    double full = 0;
};

struct SceneResult
{
    std::string name;
    DrawnPictures drawn;
    std::vector<Comparison> comparisons; ///< one for each reference
    std::optional<Agreement> agreement;  ///< of two references
    reference::Image drawn_occlusion;    ///< baked ambient occlusion
    OcclusionError occlusion;
};

/// Return the head of the table of all figures.
std::string_view tableHead();

/// Return the rows of a scene.
std::string describe(const SceneResult& result);

} // namespace hearth::picture
