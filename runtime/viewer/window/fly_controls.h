// Keys and mouse, as they fly the camera.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/window/fly_camera.h"

#include <cstdint>

union SDL_Event;

namespace hearth::viewer
{

/// Knows which keys are held from the events alone.
class FlyControls
{
public:
    /// Which events the panel keeps for itself: what is pressed there does not fly. What is let go always counts.
    struct Kept
    {
        bool keys = false;
        bool mouse = false;
    };

    void handle(const SDL_Event& event, Kept by_panel, FlyCamera& camera);

    /// Fly as the held keys say. seconds >= 0
    void fly(FlyCamera& camera, float seconds) const;

private:
    void letGo();

    uint32_t held_ = 0; ///< bit i: key i
    bool fast_ = false;
    bool looking_ = false;
};

} // namespace hearth::viewer
