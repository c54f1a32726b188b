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
constexpr float kFastFactor = 4;

/// Return the bit of a fly key, or 0 for other keys.
uint32_t keyBit(SDL_Scancode key)
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

void FlyControls::handle(const SDL_Event& event, CapturedInput captured, FlyCamera& camera)
{
    switch (event.type)
    {
    case SDL_KEYDOWN:
        if (!captured.keys)
            pressed_keys_ |= keyBit(event.key.keysym.scancode);
        is_fast_ = is_fast_ || isShift(event.key.keysym.scancode);
        break;
    case SDL_KEYUP:
        pressed_keys_ &= ~keyBit(event.key.keysym.scancode);
        is_fast_ = is_fast_ && !isShift(event.key.keysym.scancode);
        break;
    case SDL_MOUSEBUTTONDOWN:
        is_looking_ = is_looking_ || (event.button.button == SDL_BUTTON_RIGHT && !captured.mouse);
        SDL_SetRelativeMouseMode(is_looking_ ? SDL_TRUE : SDL_FALSE);
        break;
    case SDL_MOUSEBUTTONUP:
        is_looking_ = is_looking_ && event.button.button != SDL_BUTTON_RIGHT;
        SDL_SetRelativeMouseMode(is_looking_ ? SDL_TRUE : SDL_FALSE);
        break;
    case SDL_MOUSEMOTION:
        if (is_looking_)
            camera.look(static_cast<float>(event.motion.xrel) * kRadiansPerPixel,
                        -static_cast<float>(event.motion.yrel) * kRadiansPerPixel);
        break;
    case SDL_MOUSEWHEEL:
        if (!captured.mouse)
            camera.changeSpeed(static_cast<float>(event.wheel.y));
        break;
    case SDL_WINDOWEVENT:
        if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST)
            releaseAll();
        break;
    default:
        break;
    }
}

/// Release all keys: a window without the focus gets no key-up events.
void FlyControls::releaseAll()
{
    pressed_keys_ = 0;
    is_fast_ = false;
    is_looking_ = false;
    SDL_SetRelativeMouseMode(SDL_FALSE);
}

void FlyControls::fly(FlyCamera& camera, float seconds) const
{
    Float3 push;
    for (size_t i = 0; i < std::size(kFlyKeys); ++i)
        if ((pressed_keys_ >> i & 1u) != 0)
            push += kFlyKeys[i].push;
    camera.fly(push, is_fast_ ? seconds * kFastFactor : seconds);
}

} // namespace hearth::viewer
