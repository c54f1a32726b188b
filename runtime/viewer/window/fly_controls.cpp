// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/fly_controls.h"

#include <SDL.h>
#include <algorithm>
#include <iterator>

namespace hearth::viewer
{

namespace
{

struct FlyKey
{
    SDL_Scancode key; // position on the keyboard, independent of the layout
    Float3 push;
};

constexpr FlyKey kFlyKeys[] = {
    {SDL_SCANCODE_W, {0, 0, 1}},  {SDL_SCANCODE_S, {0, 0, -1}}, {SDL_SCANCODE_D, {1, 0, 0}},
    {SDL_SCANCODE_A, {-1, 0, 0}}, {SDL_SCANCODE_E, {0, 1, 0}},  {SDL_SCANCODE_Q, {0, -1, 0}},
};

constexpr float kRadiansPerPixel = 0.003f; // half a turn for a thousand pixels
constexpr float kFast = 4;

/// Return the bit of a fly key, or 0 for other keys.
uint32_t bitOf(SDL_Scancode key)
{
    const auto* found =
        std::find_if(std::begin(kFlyKeys), std::end(kFlyKeys), [&](const FlyKey& k) { return k.key == key; });
    return found == std::end(kFlyKeys) ? 0u : 1u << (found - std::begin(kFlyKeys));
}

bool isShift(SDL_Scancode key)
{
    return key == SDL_SCANCODE_LSHIFT || key == SDL_SCANCODE_RSHIFT;
}

} // namespace

void FlyControls::handle(const SDL_Event& event, Kept by_panel, FlyCamera& camera)
{
    switch (event.type)
    {
    case SDL_KEYDOWN:
        if (!by_panel.keys)
            held_ |= bitOf(event.key.keysym.scancode);
        fast_ = fast_ || isShift(event.key.keysym.scancode);
        break;
    case SDL_KEYUP:
        held_ &= ~bitOf(event.key.keysym.scancode);
        fast_ = fast_ && !isShift(event.key.keysym.scancode);
        break;
    case SDL_MOUSEBUTTONDOWN:
        looking_ = looking_ || (event.button.button == SDL_BUTTON_RIGHT && !by_panel.mouse);
        SDL_SetRelativeMouseMode(looking_ ? SDL_TRUE : SDL_FALSE);
        break;
    case SDL_MOUSEBUTTONUP:
        looking_ = looking_ && event.button.button != SDL_BUTTON_RIGHT;
        SDL_SetRelativeMouseMode(looking_ ? SDL_TRUE : SDL_FALSE);
        break;
    case SDL_MOUSEMOTION:
        if (looking_)
            camera.look(static_cast<float>(event.motion.xrel) * kRadiansPerPixel,
                        -static_cast<float>(event.motion.yrel) * kRadiansPerPixel);
        break;
    case SDL_MOUSEWHEEL:
        if (!by_panel.mouse)
            camera.changeSpeed(static_cast<float>(event.wheel.y));
        break;
    case SDL_WINDOWEVENT:
        if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST)
            letGo();
        break;
    default:
        break;
    }
}

/// Release all keys: a window without the focus gets no key-up events.
void FlyControls::letGo()
{
    held_ = 0;
    fast_ = false;
    looking_ = false;
    SDL_SetRelativeMouseMode(SDL_FALSE);
}

void FlyControls::fly(FlyCamera& camera, float seconds) const
{
    Float3 push;
    for (size_t i = 0; i < std::size(kFlyKeys); ++i)
        if ((held_ >> i & 1u) != 0)
            push += kFlyKeys[i].push;
    camera.fly(push, fast_ ? seconds * kFast : seconds);
}

} // namespace hearth::viewer
