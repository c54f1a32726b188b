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
    struct CapturedInput
    {
        bool keys = false;
        bool mouse = false;
    };

    void handle(const SDL_Event& event, CapturedInput captured, FlyCamera& camera);

    /// Fly by the pressed keys. seconds >= 0
    void fly(FlyCamera& camera, float seconds) const;

private:
    void releaseAll();

    uint32_t pressed_keys_ = 0; ///< bit i: key i
    bool is_fast_ = false;
    bool is_looking_ = false;
};

} // namespace hearth::viewer
