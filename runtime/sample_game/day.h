// Time of day: sun, sky, exposure of the eye, and the lamps that are lit at night.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "check.h"

#include <vector>

namespace game
{

class Day
{
public:
    explicit Day(const hearth::Pack& pack);
    /// Light a frame; it refers to this object until the next call.
    void light(hearth_frame& frame);

    float hour = 17.2f; ///< 0 to 24

private:
    hearth_daylight daylight_{};
    std::vector<hearth_lamp_weight> lamps_; ///< the first is the fire's
};

} // namespace game
