// Keyboard and mouse controls of the fly camera.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/window/fly_camera.h"

#include <cstdint>

union SDL_Event;

namespace hearth::viewer
{

/// Tracks the pressed keys from events alone.
class FlyControls
{
public:
    /// Events that the panel captures: presses there do not fly. Releases always count.
    struct Kept
    {
        bool keys = false;
        bool mouse = false;
    };

    void handle(const SDL_Event& event, Kept by_panel, FlyCamera& camera);

    /// Fly by the pressed keys. seconds >= 0
    void fly(FlyCamera& camera, float seconds) const;

private:
    void letGo();

    uint32_t held_ = 0; ///< bit i: key i
    bool fast_ = false;
    bool looking_ = false;
};

} // namespace hearth::viewer
