// Place of a reflection probe as people write it: X,Y,Z[:MIN:MAX[:FADE]].
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/base/result.h"

#include <optional>
#include <string>

namespace hearth::reflections
{

struct ProbePlace
{
    Float3 position;
    std::optional<Box3> box; ///< of the surroundings; none: found by rays
    std::optional<float> fade;
};

/// Parse a place: "1,1.6,2", "1,1.6,2:0,0,0:4,3,5" with two corners of the box, or with a distance
/// behind them.
/// errors: usage, with the text as its place
Result<ProbePlace> parseProbePlace(const std::string& text);

} // namespace hearth::reflections
